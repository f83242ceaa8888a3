# SPDX-License-Identifier: Apache-2.0
"""Input of a simulation: a course and an accuracy preset, and the record that kernels get of them."""
