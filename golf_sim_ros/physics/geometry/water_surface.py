# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Water: a level surface over a polygon in plan. It is not ground: nothing stands on it.

A ball is in water if its centre is. So a ball that lies in a puddle plays on, and one that rolls
down a bank is in the water where it is half under.
"""

from typing import NamedTuple, Sequence

import numpy as np

from .polygon import beside_region, Outline, Regions, regions
from ..jit import kernel
from ..kernel_types import Vector


class Water(NamedTuple):
    """Pond: corners (x, y) of its `polygon`, height [m] of its surface, the `level`.

    The polygon may reach into the banks: where ground is higher than the level, there is no water.
    `cut` holds polygons within, islands, where there is none at any level.
    """

    polygon: Outline
    level: float
    cut: tuple[Outline, ...] = ()


class Waters(NamedTuple):
    """All waters of a course: outlines in plan, and the ``levels`` [m] of their surfaces."""

    outlines: Regions
    levels: np.ndarray


def waters(ponds: Sequence[Water]) -> Waters:
    """`Waters` of `Water` records."""
    return Waters(
        regions([pond.polygon for pond in ponds], [pond.cut for pond in ponds]),
        np.array([pond.level for pond in ponds], float),
    )


@kernel
def water_at(waters: Waters, place: Vector) -> int:
    """Find the number, from 1, of the water that a ball's centre at `place` is in; 0: none."""
    for i in range(len(waters.levels)):
        if (
            place[2] < waters.levels[i]
            and beside_region(waters.outlines, i, place[0], place[1]) == 0.0
        ):
            return i + 1
    return 0
