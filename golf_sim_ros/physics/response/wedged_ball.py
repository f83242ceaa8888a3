# SPDX-License-Identifier: Apache-2.0
"""A ball that several surfaces hold at once: in a groove, a corner, a slot, or blown against a wall.

There impacts follow each other ever faster. After some it is wedged: it moves in small steps of
time, and at each step's end whatever it touches takes away what drives it in, with friction
(Moreau's time stepping, see contact_solver.py), and pushes it out.
"""
from math import sqrt

from ..collision.conservative_advancement import TOUCH
from ..collision.ground_contact import HOLDING_GAP
from ..collision.workspace import CONTACTS
from ..contact.contact_state import choose_contact_mode
from ..jit import kernel, shared
from ..mechanics.vector import ZERO, add, length, store, load
from ..state.ball import FLIGHT, NO_PART, REST, SLIDE
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.segment import greatest_acceleration
from .contact_solver import (write_back, add_ground_contacts, count_support, sweep_impulses, sweep_positions,
                             limit_speed)

RAPID = 1e-6  # s between impacts: of a ball that is being wedged they are less
MANY_RAPID_IMPACTS = 20
WEDGED_STEP = 2e-4  # s at most
STEP_PENETRATION = 2e-7  # m: by so much may acceleration drive a ball in, in a step
WEDGED_SWEEPS = 50
REST_SPEED = 1e-4  # m/s after a step: far less than the 2e-3 that gravity gives in one


@kernel
def is_wedged(ball):
    """Whether the ball moves in small steps, held by what it touches."""
    return ball['rapid_impacts'] > MANY_RAPID_IMPACTS


@kernel
def wedged_step_length(ball):
    """Length [s] of the next small step of a ball on a segment of flight."""
    return min(WEDGED_STEP, sqrt(2.0 * STEP_PENETRATION / max(greatest_acceleration(ball), 1e-3)))


@shared
def step_wedged(land, balls, i, now, work):
    """Let what ball `i` touches hold it. Writes position, motion, phase and contact.

    A ball left with one surface to lie on, or none, is wedged no more.
    """
    ball = balls[i]
    store(work.solved_motion[i, 0:3], load(ball['velocity']))
    store(work.solved_motion[i, 3:6], load(ball['spin']))
    work.count[CONTACTS] = 0
    add_ground_contacts(land, ball, i, work, HOLDING_GAP)
    store(work.position_change[i], ZERO)
    for sweep in range(WEDGED_SWEEPS):
        if sweep_impulses(land, work, sweep % 2 == 1) <= 0.01 * LEAST_SPEED:
            break
    for sweep in range(WEDGED_SWEEPS):
        if sweep_positions(work, sweep % 2 == 1) <= TOUCH:
            break
    store(ball['position'], add(load(ball['position']), load(work.position_change[i])))
    write_back(ball, work, i)
    for n in range(work.count[CONTACTS]):
        count_support(land, balls, work.contacts[n])
    left = max(length(load(ball['velocity'])) - ball['rolling_loss'], 0.0)
    limit_speed(ball, left)
    ball['phase'] = FLIGHT
    # What is held does not hop: else the rounding of its rise would decide the next step's length.
    ball['step'] = WEDGED_STEP if ball['held_by'] > 0 else 0.0
    ball['last_stage_time'] = -1.0
    if ball['held_by'] == 0:
        ball['rapid_impacts'] = 0
    elif left < REST_SPEED and ball['support'] != NO_PART:
        store(ball['velocity'], ZERO)
        store(ball['spin'], ZERO)
        ball['phase'] = REST
    elif ball['held_by'] == 1 and ball['support'] != NO_PART:
        ball['rapid_impacts'] = 0
        ball['phase'] = SLIDE
        choose_contact_mode(land, ball, now)
