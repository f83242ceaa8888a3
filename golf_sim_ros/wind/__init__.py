# SPDX-License-Identifier: Apache-2.0
"""Where wind comes from: numpy only, no ROS."""
from .gusts import Gusts, GustSettings

__all__ = ['Gusts', 'GustSettings']
