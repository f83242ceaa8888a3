# SPDX-License-Identifier: Apache-2.0
"""Balls that lean on balls for good: piles, racks, two balls in a bowl.

There impacts follow each other ever faster. Such balls are piled: they move in small steps of time, all at
the same instants, at each of which their contacts are solved together (contact_solver.py). A ball that
nothing holds any more flies on, one that only the ground holds rolls on. What has been calm for a while falls
asleep, and awakes when it is touched or when what it leans on sets off.

The velocity of a ball of a pile is that half-way through its step, so that a step in free fall is exact; one
that has just joined has its own.
"""
from math import floor

from ..collision import ball_interactions
from ..collision.ball_gap import place_at
from ..collision.broad_phase import next_node
from ..collision.ground_contact import PILE_NEAR
from ..collision.workspace import ASLEEP, CONTACTS, Crowd, MEMBERS
from ..contact.contact_state import settle
from ..effects import pull
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.vector import ZERO, along, length, put, scale, sub, vector
from ..state.ball import FLIGHT, HOLED, JOINED, NO_PART, PILED, REST, SLIDE, STEP
from ..trajectory.segment import lay
from ..trajectory.shot_record import keep_launch
from .contact_set import bring, enlist
from .contact_solver import (PILE_STEP, ball_contact, closing, far_reach, follow, ground_contacts, hold_up,
                             neighbours, part_overlaps, press, slow_down)
from .wedged_ball import MANY_STALLS, is_caught

PUSHED = 1e-3  # m/s of approach wake a sleeper
CREEP = 0.02  # m/s: what moves slower in a pile is damped, for the sweeps never quite end
DAMPED = 0.9
CALM = 4e-3  # m/s
CALM_STEPS = 50
FREE = 2.0  # m/s: faster than this a ball flies on its own


@kernel
def next_instant(now):
    """The next instant at which piles are solved."""
    return (floor(now / PILE_STEP) + 1.0) * PILE_STEP


@kernel
def is_instant(now):
    """Whether piles are solved at `now`."""
    return floor(now / PILE_STEP) * PILE_STEP == now


@kernel
def pile_up(ball):
    """Make a ball one of a pile."""
    keep_launch(ball)
    ball['leans'] = 0
    ball['piled'] = JOINED
    ball['stalled'] = MANY_STALLS + 1
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    ball['calm'] = 0
    ball['pressing'] = 0


@kernel
def leave(ball):
    """Let a ball be no longer one of a pile."""
    ball['piled'] = 0
    ball['stalled'] = 0


@kernel
def go_straight(ball, span):
    """Lay a straight piece of `span` seconds. Writes curve and ending."""
    v = vector(ball['velocity'])
    ball['span'] = span
    ball['ending'] = STEP
    put(ball['origin'], vector(ball['position']))
    put(ball['twist'][3], vector(ball['spin']))
    lay(ball, scale(span, v), (v, v), (ZERO, ZERO), (ZERO, ZERO))


@shared
def leans_on_a_ball(balls, crowd, i, radius, now):
    """Whether another ball is within PILE_NEAR of ball `i`."""
    here = vector(balls[i]['position'])
    low, high = surfaces.around(here, radius + PILE_NEAR)
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        if j != i and balls[j]['phase'] != HOLED and (
                length(sub(here, place_at(balls[j], now))) - 2.0 * radius <= PILE_NEAR):
            return True
        at = next_node(crowd, at + 1, low, high)
    return False


@ball_interactions.lean.register(Crowd)
def _lean(crowd, land, balls, i, now):
    if balls[i]['piled']:
        if is_instant(now):
            hold_pile(land, balls, now, crowd)
        return True
    if is_caught(balls[i]) and leans_on_a_ball(balls, crowd, i, land.ball.radius, now):
        pile_up(balls[i])
        return True
    return False


@ball_interactions.rouse.register(Crowd)
def _rouse(crowd, balls, radius, now):
    if not crowd.count[ASLEEP]:
        return
    for k in range(crowd.count[MEMBERS]):
        i = crowd.members[k]
        if balls[i]['phase'] == REST:
            continue
        here = vector(balls[i]['position'])
        low, high = surfaces.around(here, radius + 2.0 * PILE_NEAR)
        at = next_node(crowd, 0, low, high)
        while at >= 0:
            j = crowd.nodes[at]['ball']
            at = next_node(crowd, at + 1, low, high)
            other = balls[j]
            if crowd.places[j] < 0 and other['phase'] == REST and other['leans'] and (
                    length(sub(here, vector(other['position']))) - 2.0 * radius <= 2.0 * PILE_NEAR):
                enlist(crowd, j)
                pile_up(other)


@shared
def hold_pile(land, balls, now, crowd):
    """Solve all contacts of the piled balls that are due: the members. Writes motion and phases."""
    for i in range(len(balls)):
        if balls[i]['piled'] and crowd.ends[i] == now and crowd.places[i] < 0:
            enlist(crowd, i)
            bring(balls[i], now)
    for k in range(crowd.count[MEMBERS]):
        speed_up(land, balls, crowd, crowd.members[k])
    find_contacts(land, balls, crowd, now)
    part_overlaps(balls, crowd)
    press(land, balls, crowd)
    for k in range(crowd.count[MEMBERS]):
        follow(balls[crowd.members[k]], crowd, crowd.members[k])
    for n in range(crowd.count[CONTACTS]):
        hold_up(land, balls, crowd.contacts[n])
    for k in range(crowd.count[MEMBERS]):
        let_go(land, balls[crowd.members[k]], now, crowd)


@kernel
def speed_up(land, balls, crowd, i):
    """Let gravity act on member `i` up to half-way through its next step. Writes before and piled."""
    ball = balls[i]
    time = PILE_STEP if ball['piled'] == PILED else 0.5 * PILE_STEP
    ball['piled'] = PILED
    weight = pull(land.effects, vector(ball['position']))
    put(crowd.before[i, 0:3], along(vector(ball['velocity']), time, weight))
    put(crowd.before[i, 3:6], vector(ball['spin']))


@shared
def find_contacts(land, balls, crowd, now):
    """Contacts of the members with all that they may reach. Writes contacts, members and their reach."""
    reach = far_reach(crowd)
    k = 0
    while k < crowd.count[MEMBERS]:
        i = crowd.members[k]
        ground_contacts(land, balls[i], i, crowd, reach)
        found, watch = neighbours(balls, crowd, i, reach, land.ball.radius, now)
        balls[i]['reach'] = reach
        balls[i]['watch'] = watch
        for n in range(found):
            j = crowd.near[n]
            if 0 <= crowd.places[j] < k:
                continue  # has this contact already
            if crowd.places[j] < 0:
                if balls[j]['phase'] != REST:
                    continue  # it comes by itself
                rate = closing(balls, i, j, now)
                if rate < -PUSHED or balls[j]['leans'] and rate > PUSHED:
                    pile_up(balls[j])
                    enlist(crowd, j)
                    speed_up(land, balls, crowd, j)
            ball_contact(land, balls, crowd, i, j, now)
        k += 1


@kernel
def let_go(land, ball, now, crowd):
    """Let a member rest, roll away, fly away, or stay in the pile. Writes motion and phase."""
    speed = length(vector(ball['velocity']))
    left = max(speed - ball['braking'], 0.0)
    if left < CREEP and ball['held'] > 1:
        left *= DAMPED
    slow_down(ball, left)
    turning = land.ball.radius * length(vector(ball['spin']))
    ball['calm'] = ball['calm'] + 1 if left + turning < CALM and ball['held'] > 0 else 0
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    if ball['calm'] > CALM_STEPS:
        ball['leans'] = 1 if ball['held'] > 1 else 0
        crowd.count[ASLEEP] |= ball['leans']
        leave(ball)
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST
    elif ball['held'] == 0 or speed > FREE or ball['held'] == 1 and ball['support'] != NO_PART:
        leave(ball)
        weight = pull(land.effects, vector(ball['position']))
        put(ball['velocity'], along(vector(ball['velocity']), -0.5 * PILE_STEP, weight))
        if ball['held'] == 1 and ball['support'] != NO_PART:
            ball['phase'] = SLIDE
            settle(land, ball, now)
