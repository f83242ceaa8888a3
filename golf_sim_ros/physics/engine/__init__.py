# SPDX-License-Identifier: Apache-2.0
"""Event loop, planner of segments, and the two engines that run them, Python and compiled."""
