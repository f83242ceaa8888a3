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

"""Time at which a ball in contact crosses a border in plan, of a surface or of a zone."""

import numpy as np

from .conservative_advancement import advancement_bound, MOST_ADVANCES, TOUCH
from ..geometry import surfaces
from ..geometry.surfaces import Ground
from ..jit import kernel, shared
from ..kernel_types import BallRecord, StructRecord, Vector
from ..mechanics.vector import add, add_scaled, dot, length, load, sub
from ..trajectory.segment import (
    extent_along,
    greatest_acceleration,
    least_acceleration,
    position,
    velocity,
)

BEYOND = 1e-9  # m past a border, much more than TOUCH


@shared
def first_border_crossing(
    ground: Ground, ball: BallRecord, radius: float, until: float
) -> tuple[float, bool]:
    """First time, at most `until`, at which the segment crosses a border in plan; whether it does.

    Where it crosses none, the time is that up to which it was searched. What crosses is the ball's
    foot, its lowest point along the normal: there it is supported.
    """
    best = until
    crosses = False
    bend = greatest_acceleration(ball)
    x = extent_along(ball, 0)
    y = extent_along(ball, 1)
    # From the centre to the foot, by the normal at the segment's start.
    dx = -radius * ball['normal'][0]
    dy = -radius * ball['normal'][1]
    low = (x[0] + dx, y[0] + dy)
    high = (x[1] + dx, y[1] + dy)
    for k in range(len(ground.border_lines)):
        line = ground.border_lines[k]
        if not meets_in_plan(low, high, line['low'], line['high']):
            continue
        for i in range(line['first'], line['last']):
            border = ground.borders[i]
            if is_beside(border, low, high):
                continue
            before = best
            best, at_border = border_crossing_time(border, ball, (dx, dy, 0.0), bend, best)
            crosses = at_border or crosses and best == before
    for i in range(surfaces.limits(ground, ball['support'])):
        point, inward = surfaces.limit(ground, ball['support'], i)
        before = best
        at = add_scaled(point, radius, load(ball['normal']))
        best, at_border = limit_crossing_time(ball, at, inward, best)
        crosses = at_border or crosses and best == before
    return best, crosses


@kernel
def meets_in_plan(
    low: tuple[float, float], high: tuple[float, float], least: np.ndarray, greatest: np.ndarray
) -> bool:
    """Whether a rectangle in plan from `low` to `high` overlaps one from `least` to `greatest`."""
    return not (
        high[0] < least[0] or low[0] > greatest[0] or high[1] < least[1] or low[1] > greatest[1]
    )


@kernel
def is_beside(border: StructRecord, low: tuple[float, float], high: tuple[float, float]) -> bool:
    """Whether the rectangle in plan from `low` to `high` lies beside that around a border."""
    end_x = border['start'][0] + border['length'] * border['direction'][0]
    end_y = border['start'][1] + border['length'] * border['direction'][1]
    room = border['radius']
    return (
        high[0] < min(border['start'][0], end_x) - room
        or low[0] > max(border['start'][0], end_x) + room
        or high[1] < min(border['start'][1], end_y) - room
        or low[1] > max(border['start'][1], end_y) + room
    )


@kernel
def limit_crossing_time(
    ball: BallRecord, point: Vector, inward: Vector, until: float
) -> tuple[float, bool]:
    """First time before `until` at which the segment leaves through the line at `point`.

    And whether it leaves; if not, the time up to which it was searched.
    """
    time = 0.0
    bend = max(0.0, -least_acceleration(ball, inward))
    for _ in range(MOST_ADVANCES):
        gap = dot(sub(position(ball, time), point), inward)
        rate = dot(velocity(ball, time), inward)
        if gap <= TOUCH:
            if rate < 0.0:  # on the line from the start: far enough past it to tell what is there
                past = time if time > 0.0 else 2.0 * surfaces.LOOK_AHEAD / -rate
                return min(past, until), past < until
            gap = TOUCH
        time += max(advancement_bound(gap, rate, bend), 1e-12)
        if time >= until:
            return until, False
    return time, False


@kernel
def is_told(ball: BallRecord, time: float, nearing: float) -> bool:
    """Whether LOOK_AHEAD tells what is across a border that the ball nears at a speed [m/s]."""
    return nearing * surfaces.LOOK_AHEAD > BEYOND * length(velocity(ball, time))


@kernel
def border_crossing_time(
    border: StructRecord, ball: BallRecord, shift: Vector, bend: float, until: float
) -> tuple[float, bool]:
    """First time before `until` at which the segment, moved by `shift`, is across `border`.

    And whether it crosses; if not, the time up to which it was searched. Where it crosses so
    obliquely that LOOK_AHEAD does not tell what is there, the time is that at which it is BEYOND
    the border. A segment that starts on the border has crossed it already, unless it nears it so.
    """
    time = 0.0
    start = add(position(ball, 0.0), shift)
    gap, direction = surfaces.distance_in_plan(border, start[0], start[1])
    if gap <= 2 * TOUCH:
        nearing = -dot(direction, velocity(ball, 0.0))
        if nearing > 0.0 and not is_told(ball, 0.0, nearing):  # still on its near side
            across = BEYOND / nearing
            return (across, True) if across < until else (until, False)
        # Some 10 nm past the border, or the next segment would end on it again, and so on without
        # end.
        speed = length(velocity(ball, 0.0))
        time = 1e-8 / (speed + 1e-8)
        if time >= until:
            return until, False
    rate = 0.0
    for _ in range(MOST_ADVANCES):
        place = add(position(ball, time), shift)
        gap, direction = surfaces.distance_in_plan(border, place[0], place[1])
        if gap <= TOUCH:  # on the line there is no direction from it: the approach decides
            if rate >= 0.0:
                return until, False
            if is_told(ball, time, -rate):
                return time, True
            across = time + BEYOND / -rate
            return across if across < until else time, True
        rate = dot(direction, velocity(ball, time))
        time += advancement_bound(gap, rate, bend)
        if time >= until:
            return until, False
    return time, False
