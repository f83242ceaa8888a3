# SPDX-License-Identifier: Apache-2.0
"""Golf as a physics simulation on ROS 2: strike a ball with one message, watch it fly, bounce and roll."""

__version__ = '0.2.0'
