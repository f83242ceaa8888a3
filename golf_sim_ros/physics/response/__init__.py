# SPDX-License-Identifier: Apache-2.0
"""Collision response: impulses at impacts, and time stepping of balls with several contacts."""
