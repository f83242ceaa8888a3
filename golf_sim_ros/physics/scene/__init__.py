# SPDX-License-Identifier: Apache-2.0
"""What a caller gives: a course, and how exact; and the record that kernels get of it."""
