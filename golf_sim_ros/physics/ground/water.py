# SPDX-License-Identifier: Apache-2.0
"""Water: a level surface over a polygon in plan."""
from typing import NamedTuple


class Water(NamedTuple):
    """A pond: corners (x, y) of its `polygon`, height [m] of its surface, the `level`.

    The polygon may reach into the banks: where ground is higher than the level, there is no water.
    """

    polygon: tuple
    level: float
