# SPDX-License-Identifier: Apache-2.0
"""Lasting contact of one ball with the ground: sliding, rolling, pivoting, resting."""
