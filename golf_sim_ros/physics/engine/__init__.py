# SPDX-License-Identifier: Apache-2.0
"""The event loop, the planner of segments, and the two engines that run them."""
