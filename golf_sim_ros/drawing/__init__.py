# SPDX-License-Identifier: Apache-2.0
"""A play as a picture: from the side, from above, over time, and in numbers. No ROS.

Pictures need matplotlib, which is imported when one is asked for. Triangles of the ground, which RViz and
pages use as well, need numpy alone.
"""
from importlib import import_module

_FROM = {'draw': 'play_picture', 'picture': 'play_picture', 'recorded': 'recorded_shots',
         'DrawnShot': 'shots', 'drawn': 'shots'}

__all__ = ['DrawnShot', 'draw', 'drawn', 'picture', 'recorded']


def __getattr__(name):
    """What this package offers, from the module that has it."""
    if name not in _FROM:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    return getattr(import_module(f'.{_FROM[name]}', __name__), name)
