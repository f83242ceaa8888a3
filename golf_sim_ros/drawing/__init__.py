# SPDX-License-Identifier: Apache-2.0
"""A play as a picture: from the side, from above, over time, and in numbers. Needs matplotlib, no ROS."""
from .picture import draw, picture
from .recorded import recorded
from .shots import DrawnShot, drawn

__all__ = ['DrawnShot', 'draw', 'drawn', 'picture', 'recorded']
