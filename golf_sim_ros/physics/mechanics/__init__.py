# SPDX-License-Identifier: Apache-2.0
"""Mechanics of vectors, of one frictional impact, and of Coulomb friction on a slope."""
