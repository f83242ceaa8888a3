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

"""Time at which a ball's centre enters water, along a segment, by conservative advancement.

A ball is in water if its centre is below the level and inside the outline in plan. Advancing is
safe as long as either condition must still fail.
"""

from .conservative_advancement import advancement_bound, MOST_ADVANCES, TANGENTIAL, TOUCH
from ..geometry.polygon import beside_region
from ..geometry.water_surface import Waters
from ..jit import kernel, shared
from ..kernel_types import BallRecord
from ..mechanics.vector import length, UP
from ..trajectory.segment import (
    extent_along,
    greatest_acceleration,
    least_acceleration,
    position,
    velocity,
)


@shared
def first_water_entry(waters: Waters, ball: BallRecord, until: float) -> tuple[float, int]:
    """First time, at most `until`, at which the segment enters water, and the water's number.

    That counts from 1; 0 is none.
    """
    best = until
    who = 0
    lowest, _ = extent_along(ball, 2)
    for i in range(len(waters.levels)):
        # else its control points, and so the curve, are above, or beside
        if lowest < waters.levels[i] and passes_outline(waters, i, ball):
            time, enters = water_entry_time(waters, i, ball, best)
            if enters:
                best = time
                who = i + 1
    return best, who


@kernel
def passes_outline(waters: Waters, i: int, ball: BallRecord) -> bool:
    """Whether the control points of the segment and water `i` have boxes in plan that meet."""
    box = waters.outlines.outlines.boxes[i]
    for axis in range(2):
        low, high = extent_along(ball, axis)
        if high < box[axis] or box[axis + 2] < low:
            return False
    return True


@kernel
def water_entry_time(waters: Waters, i: int, ball: BallRecord, until: float) -> tuple[float, bool]:
    """First time before `until` at which the segment enters water `i`, and whether it does."""
    bend = greatest_acceleration(ball)
    falling = max(0.0, -least_acceleration(ball, UP))
    time = 0.0
    for _ in range(MOST_ADVANCES):
        place = position(ball, time)
        # The later of two safe times: both conditions have to hold at once.
        sure = max(
            time_above(place[2] - waters.levels[i], velocity(ball, time)[2], falling),
            time_outside(
                beside_region(waters.outlines, i, place[0], place[1]),
                length(velocity(ball, time)),
                bend,
            ),
        )
        if sure <= 0.0:
            return time, True
        time += max(sure, 1e-12)
        if time >= until:
            break
    return until, False


@kernel
def time_above(gap: float, rate: float, falling: float) -> float:
    """Safe time [s] for which a centre `gap` over the level stays above.

    It is 0 below, or on it and sinking.
    """
    if gap < -TOUCH or gap <= TOUCH and rate < -TANGENTIAL:
        return 0.0
    return advancement_bound(gap, max(rate, 0.0) if gap <= TOUCH else rate, falling)


@kernel
def time_outside(away: float, speed: float, bend: float) -> float:
    """Safe time [s] for which a centre stays outside of an outline in plan.

    It is `away` [m] from it, of that `speed`.
    """
    return advancement_bound(away, -speed, bend) if away > TOUCH else 0.0
