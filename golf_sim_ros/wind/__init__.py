# SPDX-License-Identifier: Apache-2.0
"""Wind generators: numpy only, no ROS."""
from .gusts import GustSettings, Gusts

__all__ = ['Gusts', 'GustSettings']
