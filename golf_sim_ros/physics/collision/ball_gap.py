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

"""Narrow phase of balls: time of impact of two. Their gap is convex in their relative place."""

from math import sqrt

import numpy as np

from . import ball_interactions
from .broad_phase import next_node
from .conservative_advancement import (
    advancement_bound,
    is_long,
    MOST_ADVANCES,
    SHORT_BOX,
    swept_box,
    TANGENTIAL,
    TOUCH,
)
from .ground_contact import RESTING_GAP
from .workspace import MultiBallWorkspace
from ..jit import kernel, shared
from ..kernel_types import BallRecord, Vector, WorkRecord
from ..mechanics.vector import add, dot, length, load, sub, unit, UP, ZERO
from ..state.ball import BALL_IMPACT, HOLED, moves, REST, STEP_END, STEPPED
from ..trajectory import segment

MANY_STEPPED = 6  # time-stepped balls in a swept box that make it worth halving the segment
RESTING_APPROACH = 0.02  # m/s of approach: what gravity gives in a time step


@kernel
def position_at(ball: BallRecord, now: float) -> Vector:
    """Position of the ball at `now`, on its present segment."""
    return (
        segment.position(ball, now - ball['begin'])
        if moves(ball['phase'])
        else load(ball['position'])
    )


@kernel
def velocity_at(ball: BallRecord, now: float) -> Vector:
    """Velocity of the ball at `now`, on its present segment."""
    return segment.velocity(ball, now - ball['begin']) if moves(ball['phase']) else ZERO


@kernel
def gap_between(
    a: BallRecord, b: BallRecord, radius: float, now: float
) -> tuple[float, float, Vector]:
    """Gap between two balls at `now`, its rate, and the contact normal from `b` to `a`."""
    apart = sub(position_at(a, now), position_at(b, now))
    normal = unit(apart, UP)
    rate = dot(normal, sub(velocity_at(a, now), velocity_at(b, now)))
    return length(apart) - 2.0 * radius, rate, normal


@kernel
def acceleration_at_start(ball: BallRecord) -> tuple[Vector, float]:
    """Acceleration at the start of the ball's segment, and a bound on how far it deviates."""
    usual = segment.acceleration_coefficient(ball, 0) if moves(ball['phase']) else ZERO
    return usual, acceleration_deviation(ball, usual)


@kernel
def acceleration_deviation(ball: BallRecord, acceleration: Vector) -> float:
    """Bound on how far the ball's acceleration strays from another, over its segment."""
    if not moves(ball['phase']):
        return length(acceleration)
    most = 0.0
    for i in range(4):
        off = sub(segment.acceleration_coefficient(ball, i), acceleration)
        most = max(most, dot(off, off))
    return sqrt(most)


@kernel
def cannot_touch(
    here: tuple[Vector, Vector],
    other: BallRecord,
    bend: float,
    radius: float,
    now: float,
    until: float,
) -> bool:
    """Whether a ball can't touch another one from `now` to `until`.

    Its position and velocity are `here`. The gap stays above a concave parabola (see
    conservative_advancement.py), lowest at one of its ends. Without a division: this runs for
    every pair of the broad phase, and is true of nearly all.
    """
    place, velocity = here
    apart = sub(place, position_at(other, now))
    size = length(apart)
    time = until - now
    room = size - 2.0 * radius
    closing = dot(apart, sub(velocity, velocity_at(other, now)))
    return room > TOUCH and size * (room - 0.5 * bend * time * time) + time * closing > 0.0


@kernel
def separation_time_of_balls(
    a: BallRecord, b: BallRecord, radius: float, now: float, until: float
) -> float:
    """Time by which two balls in contact without approach have separated.

    It is `now` if they press on.
    """
    wait = 1e-9
    while now + wait < until and wait < 1e-2:
        gap, rate, _ = gap_between(a, b, radius, now + wait)
        if gap < -TOUCH:
            return now
        if gap > 10 * TOUCH and rate > 0.0:
            return now + wait
        wait *= 4.0
    return min(now + wait, until)


@kernel
def time_of_impact_of_balls(
    a: BallRecord, b: BallRecord, bend: float, radius: float, begin: float, until: float
) -> tuple[float, bool]:
    """Time of impact of two balls between `begin` and `until`, or a safe time; and which it is.

    `bend` bounds their relative acceleration: gravity cancels, so of two balls in flight it is
    small.
    """
    now = begin
    for _ in range(MOST_ADVANCES):
        gap, rate, _ = gap_between(a, b, radius, now)
        if gap <= TOUCH:
            if rate < -TANGENTIAL or now > begin and rate <= 0.0:
                return now, True
            if rate <= TANGENTIAL:  # the parabola says nothing here: rounding has either sign
                now = separation_time_of_balls(a, b, radius, now, until)
                if now == begin:
                    return now, True
                if now >= until:
                    return until, False
                continue
        now += advancement_bound(gap, rate, bend)
        if now >= until:
            return until, False
    return now, False


@kernel
def is_left_to_time_stepping(
    ball: BallRecord, other: BallRecord, radius: float, now: float
) -> bool:
    """Whether the contact of a time-stepped ball with another ball is left to time stepping."""
    if not ball['time_stepping']:
        return False
    # One that has only just joined is in no contact of the solver before its first time step.
    if ball['time_stepping'] == STEPPED and other['time_stepping'] == STEPPED:
        return True
    gap, rate, _ = gap_between(ball, other, radius, now)
    rests = other['phase'] == REST or other['time_stepping'] and rate > -RESTING_APPROACH
    return gap < RESTING_GAP and rests


@kernel
def within_contact_reach(ball: BallRecord) -> bool:
    """Whether a time-stepped ball stays within its contact margin.

    There it hits only its contacts.
    """
    if ball['time_stepping'] != STEPPED:
        return False
    return length(load(ball['position_coefficients'][5])) <= ball['contact_reach']


@ball_interactions.first_ball_contact.register(MultiBallWorkspace)
def _first_ball_contact(
    work: MultiBallWorkspace, balls: np.ndarray, i: int, radius: float, now: float
) -> tuple[float, int, bool]:
    return first_ball_impact(work, balls, i, radius, now)


@ball_interactions.interrupt_segments.register(MultiBallWorkspace)
def _interrupt_segments(
    work: MultiBallWorkspace, balls: np.ndarray, i: int, radius: float, now: float
) -> None:
    interrupt_segments_at(work, balls, i, radius, now)


@shared
def interrupt_segments_at(
    work: WorkRecord, balls: np.ndarray, i: int, radius: float, now: float
) -> None:
    """End the segments of other balls that hit ball `i`, which rests now.

    They were planned while it still moved, and tested against it only up to the end of its
    segment. Writes end, ending, target, segment_ends.
    """
    ball = balls[i]
    place = load(ball['position'])
    usual, stray = acceleration_at_start(ball)
    reach = (radius, radius, radius)
    low = sub(place, reach)
    high = add(place, reach)
    at = next_node(work.tree, 0, low, high)
    while at >= 0:
        j = work.tree.nodes[at]['ball']
        other = balls[j]
        is_under_way = moves(other['phase']) and other['end'] > now
        if is_under_way and not is_left_to_time_stepping(other, ball, radius, now):
            bend = stray + acceleration_deviation(other, usual)
            time, touches = time_of_impact_of_balls(other, ball, bend, radius, now, other['end'])
            if touches or time < other['end']:
                other['end'] = time
                other['ending'] = BALL_IMPACT if touches else STEP_END
                other['target'] = i
                work.segment_ends[j] = time
        at = next_node(work.tree, at + 1, low, high)


@kernel
def is_over_many_stepped(work: WorkRecord, balls: np.ndarray, low: Vector, high: Vector) -> bool:
    """Whether MANY_STEPPED or more time-stepped balls overlap the box from `low` to `high`."""
    found = 0
    at = next_node(work.tree, 0, low, high)
    while at >= 0 and found < MANY_STEPPED:
        found += balls[work.tree.nodes[at]['ball']]['time_stepping'] == STEPPED
        at = next_node(work.tree, at + 1, low, high)
    return found == MANY_STEPPED


@shared
def first_ball_impact(
    work: WorkRecord, balls: np.ndarray, i: int, radius: float, now: float
) -> tuple[float, int, bool]:
    """Time of impact of ball `i`'s segment with another ball, or a safe time.

    Also the other ball, and whether they hit.
    """
    ball = balls[i]
    until = ball['end']
    if within_contact_reach(ball) and not ball['watches_neighbours']:
        return until, -1, False
    # Over a pile the segment is cut short, or its box would overlap all of the pile.
    low, high = swept_box(ball, 0.0, until - now, radius)
    while is_long(low, high, SHORT_BOX * radius) and is_over_many_stepped(work, balls, low, high):
        until = now + 0.5 * (until - now)
        low, high = swept_box(ball, 0.0, until - now, radius)
    # Found once for all pairs: of each other ball only its deviation from that acceleration is
    # needed.
    usual, stray = acceleration_at_start(ball)
    here = position_at(ball, now), velocity_at(ball, now)
    best = until
    who = -1
    hit = False
    at = next_node(work.tree, 0, low, high)
    while at >= 0:
        j = work.tree.nodes[at]['ball']
        # Contacts of balls that are stepped together, or with a sleeper, belong to the contact
        # solver.
        other = balls[j]
        is_there = j != i and other['phase'] != HOLED
        if is_there and not is_left_to_time_stepping(ball, other, radius, now):
            # What comes after the end of the other's segment is tested when that has its next one.
            last = min(best, other['end'])
            bend = stray + acceleration_deviation(other, usual)
            if last >= now and not cannot_touch(here, other, bend, radius, now, last):
                time, touches = time_of_impact_of_balls(ball, other, bend, radius, now, last)
                # At equal times an impact has precedence over a safe time.
                if touches and (time < best or not hit) or time < last:
                    best = time
                    who = j
                    hit = touches
        at = next_node(work.tree, at + 1, low, high)
    return best, who, hit
