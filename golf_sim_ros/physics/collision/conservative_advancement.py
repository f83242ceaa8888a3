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

"""Conservative advancement: continuous collision detection that can't tunnel.

A part of the ground is convex, so the gap to it is a convex function of position. Along a path of
acceleration at most A it therefore stays above the parabola

    gap(t + s) >= gap(t) + gap'(t) s - A s^2 / 2

and it is safe to advance to that parabola's root. It is Newton's method from the safe side:
convergence is quadratic, and the time of impact is never overstepped. (Mirtich, Impulse-based
dynamic simulation of rigid body systems, 1996, introduced the name.)
"""

from math import sqrt

from ..jit import kernel
from ..kernel_types import BallRecord, Box, Vector
from ..trajectory.segment import extent_along, greatest_acceleration, position

TOUCH = 1e-11  # m: gaps below count as contact; 300 m have a rounding error of 6e-14 m
TANGENTIAL = 1e-9  # m/s: a gap whose rate is smaller counts as constant
# m/s: more than the rounding error of a rate, and less than what a nanosecond's gravity gives
RISING = 1e-12
PLAIN_APPROACH = 0.01  # m/s: a faster approach from a microsecond away is sure to be an impact
NEVER = 1e300  # s: of a gap that does not close
MOST_ADVANCES = 200  # then the ball stops where it is safe, and looks again from there
SHORT_BOX = 4.0  # radii: a stretch with a box no longer than this is not worth halving


@kernel
def advancement_bound(gap: float, rate: float, bend: float) -> float:
    """Safe time [s] within which a `gap` of that `rate` can't close.

    The rate falls by at most `bend` a second. The time is the positive root of
    gap + rate s - bend s^2 / 2, in the form without cancellation.
    """
    gap = max(gap, 0.0)
    if bend <= 0.0:
        return gap / -rate if rate < 0.0 else NEVER
    root = sqrt(rate * rate + 2.0 * bend * gap)
    if rate < 0.0:
        return 2.0 * gap / (root - rate)
    return (rate + root) / bend


@kernel
def swept_box(ball: BallRecord, begin: float, end: float, radius: float) -> Box:
    """Swept box of the ball on its segment from `begin` to `end`."""
    if begin == 0.0 and end >= 0.5 * ball['span']:  # the control points bound the segment
        x = extent_along(ball, 0)
        y = extent_along(ball, 1)
        z = extent_along(ball, 2)
        return (
            (x[0] - radius, y[0] - radius, z[0] - radius),
            (x[1] + radius, y[1] + radius, z[1] + radius),
        )
    a = position(ball, begin)
    b = position(ball, end)
    # A path of acceleration at most A strays from its chord by at most A t^2 / 8.
    room = radius + 0.125 * greatest_acceleration(ball) * (end - begin) * (end - begin)
    return (
        (min(a[0], b[0]) - room, min(a[1], b[1]) - room, min(a[2], b[2]) - room),
        (max(a[0], b[0]) + room, max(a[1], b[1]) + room, max(a[2], b[2]) + room),
    )


@kernel
def is_long(low: Vector, high: Vector, size: float) -> bool:
    """Whether the box from `low` to `high` is longer than `size` in any direction."""
    return high[0] - low[0] > size or high[1] - low[1] > size or high[2] - low[2] > size
