# SPDX-License-Identifier: Apache-2.0
"""Collision detection: broad phase, and time of impact of segments with ground, water and balls."""
