# SPDX-License-Identifier: Apache-2.0
"""A ball that several surfaces hold at once: in a groove, a corner, a slot, or blown against a wall.

There impacts follow each other ever faster. After some it is caught: it moves in small steps of
time, and at each step's end whatever it touches takes away what drives it in, with friction
(Moreau's time stepping, see contact_solver.py), and pushes it out.
"""
from math import sqrt

from ..collision.conservative_advancement import TOUCH
from ..collision.ground_contact import NEAR
from ..collision.workspace import CONTACTS
from ..contact.contact_state import settle
from ..jit import kernel, shared
from ..mechanics.vector import ZERO, add, length, put, vector
from ..state.ball import FLIGHT, NO_PART, REST, SLIDE
from ..trajectory.equations_of_motion import STILL
from ..trajectory.segment import greatest_acceleration
from .contact_solver import follow, ground_contacts, hold_up, press_once, shift_once, slow_down

STALL = 1e-6  # s between impacts: of a ball that is being caught they are less
MANY_STALLS = 20
CAUGHT_STEP = 2e-4  # s at most
SINK = 2e-7  # m: by so much may acceleration drive a ball in, in a step
SWEEPS = 50
AT_REST = 1e-4  # m/s after a step: far less than the 2e-3 that gravity gives in one


@kernel
def is_caught(ball):
    """Whether the ball moves in small steps, held by what it touches."""
    return ball['stalled'] > MANY_STALLS


@kernel
def caught_step(ball):
    """Length [s] of the next small step of a ball on a piece of flight."""
    return min(CAUGHT_STEP, sqrt(2.0 * SINK / max(greatest_acceleration(ball), 1e-3)))


@shared
def hold(land, balls, i, now, crowd):
    """Let what ball `i` touches hold it. Writes position, motion, phase and contact.

    A ball left with one surface to lie on, or none, is caught no more.
    """
    ball = balls[i]
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
    follow(ball, crowd, i)
    for n in range(crowd.count[CONTACTS]):
        hold_up(land, balls, crowd.contacts[n])
    left = max(length(vector(ball['velocity'])) - ball['braking'], 0.0)
    slow_down(ball, left)
    ball['phase'] = FLIGHT
    # What is held does not hop: else the rounding of its rise would decide the next step's length.
    ball['step'] = CAUGHT_STEP if ball['held'] > 0 else 0.0
    ball['rated'] = -1.0
    if ball['held'] == 0:
        ball['stalled'] = 0
    elif left < AT_REST and ball['support'] != NO_PART:
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST
    elif ball['held'] == 1 and ball['support'] != NO_PART:
        ball['stalled'] = 0
        ball['phase'] = SLIDE
        settle(land, ball, now)
