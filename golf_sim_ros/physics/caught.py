# SPDX-License-Identifier: Apache-2.0
"""A ball that several surfaces hold at once: in a groove, a corner, a slot, or blown against a wall.

There impacts follow each other ever faster. After some it is caught: it moves in small steps of
time, and at each step's end whatever it touches takes away what drives it in, with friction
(Moreau's time stepping, see pressing.py), and pushes it out.
"""
from math import sqrt

from ._compile import kernel, shared
from .contact import settle, stand_on
from .crowd import CONTACTS
from .detect import NEAR, TOUCH
from .effects import pull
from .ground import surface
from .motion import STILL
from .path import greatest_acceleration
from .pressing import ground_contacts, press_once, shift_once
from .state import FLIGHT, NO_PART, REST, SLIDE
from .vector import ZERO, add, dot, length, put, scale, vector

STALL = 1e-6  # s between impacts: of a ball that is being caught they are less
MANY_STALLS = 20
CAUGHT_STEP = 2e-4  # s at most
SINK = 2e-7  # m: by so much may acceleration drive a ball in, in a step
SWEEPS = 50
AT_REST = 1e-4  # m/s after a step: far less than the 2e-3 that gravity gives in one
WALL = 1e-3  # least part of gravity that must press for a ball to come to rest on a surface


@kernel
def is_caught(ball):
    """Whether the ball moves in small steps, held by what it touches."""
    return ball['stalled'] > MANY_STALLS


@kernel
def caught_step(ball):
    """Length [s] of the next small step of a ball on a piece of flight."""
    return min(CAUGHT_STEP, sqrt(2.0 * SINK / max(greatest_acceleration(ball), 1e-3)))


@kernel
def presses(land, ball, normal):
    """Whether gravity presses the ball against what has `normal`, rather than lets it lean on it."""
    weight = pull(land.effects, vector(ball['position']))
    return -dot(weight, normal) > WALL * length(weight)


@shared
def hold(land, ball, i, now, crowd):
    """Let what ball `i` touches hold it. Writes position, motion, phase and contact.

    A ball left with one surface to lie on, or none, is caught no more.
    """
    put(crowd.before[i, 0:3], vector(ball['velocity']))
    put(crowd.before[i, 3:6], vector(ball['spin']))
    crowd.count[CONTACTS] = 0
    ground_contacts(land, ball, i, crowd, NEAR)
    put(crowd.flow[i], ZERO)
    for sweep in range(SWEEPS):
        if press_once(land, crowd, sweep % 2 == 1) <= 0.01 * STILL:
            break
    for sweep in range(SWEEPS):
        if shift_once(crowd, sweep % 2 == 1) <= TOUCH:
            break
    put(ball['position'], add(vector(ball['position']), vector(crowd.flow[i])))
    braking = stand(land, ball, crowd)
    speed = length(vector(crowd.before[i, 0:3]))
    left = max(speed - braking, 0.0)
    share = left / speed if speed > 0.0 else 1.0
    put(ball['velocity'], scale(share, vector(crowd.before[i, 0:3])))
    put(ball['spin'], scale(share, vector(crowd.before[i, 3:6])))
    surfaces = crowd.count[CONTACTS]
    ball['phase'] = FLIGHT
    # What is held does not hop: else the rounding of its rise would decide the next step's length.
    ball['step'] = CAUGHT_STEP if surfaces > 0 else 0.0
    ball['rated'] = -1.0
    if surfaces == 0:
        ball['stalled'] = 0
    elif left < AT_REST and ball['support'] != NO_PART:
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST
    elif surfaces == 1 and ball['support'] != NO_PART:
        ball['stalled'] = 0
        ball['phase'] = SLIDE
        settle(land, ball, now)


@kernel
def stand(land, ball, crowd):
    """Let the ball stand on what presses most. Writes contact; returns what resistance takes [m/s]."""
    put(ball['normal'], ZERO)
    ball['support'] = NO_PART
    braking = 0.0
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        normal = vector(row['normal'])
        braking += row['shared'] * row['push']
        if presses(land, ball, normal) and normal[2] > ball['normal'][2]:
            stand_on(land, ball, surface.support_of(land.ground, row['part']), normal)
    return braking
