# SPDX-License-Identifier: Apache-2.0
"""Water: a level surface over a polygon in plan. It is not ground: nothing stands on it.

A ball is in water if its centre is. So a ball that lies in a puddle plays on, and one that rolls down a bank
is in the water where it is half under.
"""
from typing import NamedTuple

import numpy as np

from ..jit import kernel
from .polygon import Regions, beside_region, regions


class Water(NamedTuple):
    """Pond: corners (x, y) of its `polygon`, height [m] of its surface, the `level`.

    The polygon may reach into the banks: where ground is higher than the level, there is no water. `cut`
    holds polygons within, islands, where there is none at any level.
    """

    polygon: tuple
    level: float
    cut: tuple = ()


class Waters(NamedTuple):
    """All waters of a course: outlines in plan, and the ``levels`` [m] of their surfaces."""

    outlines: Regions
    levels: np.ndarray


def waters(ponds):
    """`Waters` of `Water` records."""
    return Waters(regions([pond.polygon for pond in ponds], [pond.cut for pond in ponds]),
                  np.array([pond.level for pond in ponds], float))


@kernel
def water_at(waters, place):
    """Number, from 1, of the water that a ball with its centre at `place` is in; 0: none."""
    for i in range(len(waters.levels)):
        if place[2] < waters.levels[i] and beside_region(waters.outlines, i, place[0], place[1]) == 0.0:
            return i + 1
    return 0
