# SPDX-License-Identifier: Apache-2.0
"""Time at which a ball's centre enters water, along a segment, by conservative advancement.

A ball is in water if its centre is below the level and inside the outline in plan. Advancing is safe as long
as either condition must still fail.
"""
from ..geometry.polygon import beside_region
from ..jit import kernel, shared
from ..mechanics.vector import UP, length
from ..trajectory.segment import greatest_acceleration, least_acceleration, position, extent_along, velocity
from .conservative_advancement import MOST_ADVANCES, TANGENTIAL, TOUCH, advancement_bound


@shared
def first_water_entry(waters, ball, until):
    """First time, at most `until`, at which the segment enters water; number of the water, from 1, or 0."""
    best = until
    who = 0
    lowest, _ = extent_along(ball, 2)
    for i in range(len(waters.levels)):
        if lowest < waters.levels[i]:  # else its control points, and so the curve, are above
            time, dips = water_entry_time(waters, i, ball, best)
            if dips:
                best = time
                who = i + 1
    return best, who


@kernel
def water_entry_time(waters, i, ball, until):
    """First time before `until` at which the segment enters water `i`, and whether it does."""
    bend = greatest_acceleration(ball)
    falling = max(0.0, -least_acceleration(ball, UP))
    time = 0.0
    for _ in range(MOST_ADVANCES):
        place = position(ball, time)
        # The later of two safe times: both conditions have to hold at once.
        sure = max(time_above(place[2] - waters.levels[i], velocity(ball, time)[2], falling),
                   time_outside(beside_region(waters.outlines, i, place[0], place[1]),
                                length(velocity(ball, time)), bend))
        if sure <= 0.0:
            return time, True
        time += max(sure, 1e-12)
        if time >= until:
            break
    return until, False


@kernel
def time_above(gap, rate, falling):
    """Safe time [s] for which a centre `gap` over the level stays above; 0 below, or on it and sinking."""
    if gap < -TOUCH or gap <= TOUCH and rate < -TANGENTIAL:
        return 0.0
    return advancement_bound(gap, max(rate, 0.0) if gap <= TOUCH else rate, falling)


@kernel
def time_outside(away, speed, bend):
    """Safe time [s] for which a centre `away` [m] from the outline in plan stays outside at that `speed`."""
    return advancement_bound(away, -speed, bend) if away > TOUCH else 0.0
