# SPDX-License-Identifier: Apache-2.0
"""When two balls touch: the gap between them is convex in their relative position, as with ground."""
from math import sqrt

from ..jit import kernel, shared
from ..mechanics.vector import ZERO, add, dot, length, sub, unit, vector
from ..state.ball import HOLED, MEETING, PILED, REST, STEP, moves
from ..trajectory import segment
from . import ball_interactions
from .broad_phase import next_node
from .conservative_advancement import MOST_STEPS, SHORT, TANGENTIAL, TOUCH, box, is_long, safe_advance
from .ground_contact import PILE_NEAR
from .workspace import Crowd

UP = (0.0, 0.0, 1.0)
MANY = 6  # balls: so many in the box around a stretch of path are worth a shorter stretch
STEADY = 0.02  # m/s of approach: so much gravity gives in a step of a pile


@kernel
def place_at(ball, now):
    """Where the ball is at `now`, on its present piece."""
    return segment.position(ball, now - ball['begin']) if moves(ball['phase']) else vector(ball['position'])


@kernel
def velocity_at(ball, now):
    """Velocity of the ball at `now`, on its present piece."""
    return segment.velocity(ball, now - ball['begin']) if moves(ball['phase']) else ZERO


@kernel
def gap_between(a, b, radius, now):
    """Gap between two balls at `now`, its rate, and the direction from `b` to `a`."""
    apart = sub(place_at(a, now), place_at(b, now))
    normal = unit(apart, UP)
    rate = dot(normal, sub(velocity_at(a, now), velocity_at(b, now)))
    return length(apart) - 2.0 * radius, rate, normal


@kernel
def usual_bend(ball):
    """Acceleration as the ball's piece begins, and how far it strays from that, at most."""
    usual = segment.bend(ball, 0) if moves(ball['phase']) else ZERO
    return usual, strays_from(ball, usual)


@kernel
def strays_from(ball, acceleration):
    """How far the ball's acceleration on its piece is from another, at most."""
    if not moves(ball['phase']):
        return length(acceleration)
    most = 0.0
    for i in range(4):
        off = sub(segment.bend(ball, i), acceleration)
        most = max(most, dot(off, off))
    return sqrt(most)


@kernel
def stays_clear(here, other, bend, radius, now, until):
    """Whether a ball whose place and velocity are `here` can't touch another one from `now` to `until`.

    The gap stays above a parabola (see conservative_advancement.py), lowest at its ends. Without a division:
    it is asked of all that come near, and is true of nearly all.
    """
    place, velocity = here
    apart = sub(place, place_at(other, now))
    size = length(apart)
    time = until - now
    room = size - 2.0 * radius
    closing = dot(apart, sub(velocity, velocity_at(other, now)))
    return room > TOUCH and size * (room - 0.5 * bend * time * time) + time * closing > 0.0


@kernel
def part_from(a, b, radius, now, until):
    """Time at which two balls that touch without approach are clear of each other, or `now` if they press."""
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
def first_touch_of(a, b, bend, radius, begin, until):
    """Time from `begin` to `until` up to which two balls do not touch; whether they do then.

    `bend` bounds the acceleration of one against the other: of two that fly alike it is nearly none.
    """
    now = begin
    for _ in range(MOST_STEPS):
        gap, rate, _ = gap_between(a, b, radius, now)
        if gap <= TOUCH:
            if rate < -TANGENTIAL or now > begin and rate <= 0.0:
                return now, True
            if rate <= TANGENTIAL:
                now = part_from(a, b, radius, now, until)
                if now == begin:
                    return now, True
                if now >= until:
                    return until, False
                continue
        now += safe_advance(gap, rate, bend)
        if now >= until:
            return until, False
    return now, False


@kernel
def is_held(ball, other, radius, now):
    """Whether the contact of a piled ball with another one is left to the pile."""
    if ball['piled'] == PILED and other['piled'] == PILED:
        return True
    gap, rate, _ = gap_between(ball, other, radius, now)
    return gap < PILE_NEAR and (other['phase'] == REST or other['piled'] and rate > -STEADY)


@kernel
def stays_in_reach(ball):
    """Whether a ball of a pile touches nothing on its piece but what its contacts hold it off."""
    return ball['piled'] == PILED and length(vector(ball['path'][5])) <= ball['reach']


@ball_interactions.meeting.register(Crowd)
def _meeting(crowd, balls, i, radius, now):
    return first_meeting(crowd, balls, i, radius, now)


@ball_interactions.stand_in_the_way.register(Crowd)
def _stand_in_the_way(crowd, balls, i, radius, now):
    end_at(crowd, balls, i, radius, now)


@shared
def end_at(crowd, balls, i, radius, now):
    """End pieces that others were laid through ball `i`, which rests now. Writes end, ending, target, ends.

    They were laid while it still moved, and looked no further than to the end of its piece.
    """
    ball = balls[i]
    place = vector(ball['position'])
    usual, stray = usual_bend(ball)
    reach = (radius, radius, radius)
    low = sub(place, reach)
    high = add(place, reach)
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        other = balls[j]
        if moves(other['phase']) and other['end'] > now and not (other['piled']
                                                                 and is_held(other, ball, radius, now)):
            bend = stray + strays_from(other, usual)
            time, touches = first_touch_of(other, ball, bend, radius, now, other['end'])
            if touches or time < other['end']:
                other['end'] = time
                other['ending'] = MEETING if touches else STEP
                other['target'] = i
                crowd.ends[j] = time
        at = next_node(crowd, at + 1, low, high)


@kernel
def is_over_a_pile(crowd, balls, low, high):
    """Whether many balls of a pile come into the box from `low` to `high`."""
    found = 0
    at = next_node(crowd, 0, low, high)
    while at >= 0 and found < MANY:
        found += balls[crowd.nodes[at]['ball']]['piled'] == PILED
        at = next_node(crowd, at + 1, low, high)
    return found == MANY


@shared
def first_meeting(crowd, balls, i, radius, now):
    """First time at which ball `i`'s piece touches another ball, which, and whether it really does."""
    ball = balls[i]
    until = ball['end']
    if stays_in_reach(ball) and not ball['watch']:
        return until, -1, False
    low, high = box(ball, 0.0, until - now, radius)
    while is_long(low, high, SHORT * radius) and is_over_a_pile(crowd, balls, low, high):
        until = now + 0.5 * (until - now)
        low, high = box(ball, 0.0, until - now, radius)
    usual, stray = usual_bend(ball)
    here = place_at(ball, now), velocity_at(ball, now)
    best = until
    who = -1
    hit = False
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        # What is in one pile, or asleep beside it, is held by its contacts.
        other = balls[j]
        if j != i and other['phase'] != HOLED and not (ball['piled'] and is_held(ball, other, radius, now)):
            last = min(best, other['end'])
            bend = stray + strays_from(other, usual)
            if last >= now and not stays_clear(here, other, bend, radius, now, last):
                time, touches = first_touch_of(ball, other, bend, radius, now, last)
                if touches and (time < best or not hit) or time < last:
                    best = time
                    who = j
                    hit = touches
        at = next_node(crowd, at + 1, low, high)
    return best, who, hit
