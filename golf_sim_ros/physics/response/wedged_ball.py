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

"""Wedged balls, held by several surfaces at once.

In a groove, a corner, a slot, or blown against a wall. Event by event their impacts would follow
each other ever faster (Zeno). After MANY_RAPID_IMPACTS the ball is wedged: it moves in small time
steps, at whose ends all its contacts are solved together with friction (Moreau's time stepping,
see contact_solver.py), and penetration is corrected.
"""

from math import sqrt

import numpy as np

from .contact_solver import (
    add_ground_contacts,
    count_support,
    limit_speed,
    sweep_impulses,
    sweep_positions,
    write_back,
)
from ..collision.conservative_advancement import TOUCH
from ..collision.ground_contact import HOLDING_GAP
from ..collision.workspace import CONTACTS
from ..contact.contact_state import touch_down
from ..jit import kernel, shared
from ..kernel_types import BallRecord, SceneRecord, WorkRecord
from ..mechanics.vector import add, length, load, store, ZERO
from ..state.ball import NO_PART
from ..state.transitions import come_to_rest, take_off
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.segment import greatest_acceleration

RAPID = 1e-6  # s between impacts: shorter for a ball that is being wedged
MANY_RAPID_IMPACTS = 20  # after so many in a row a ball is wedged
WEDGED_STEP = 2e-4  # s: longest time step
STEP_PENETRATION = 2e-7  # m: penetration that acceleration may cause in a step
WEDGED_SWEEPS = 50  # over impulses, and over penetrations
REST_SPEED = 1e-4  # m/s after a step: far less than the 2e-3 that gravity gives in one


@kernel
def is_wedged(ball: BallRecord) -> bool:
    """Whether several surfaces hold the ball, so that it moves in small time steps."""
    return ball['rapid_impacts'] > MANY_RAPID_IMPACTS


@kernel
def wedged_step_length(ball: BallRecord) -> float:
    """Length [s] of the next time step of a wedged ball on a segment of flight."""
    return min(WEDGED_STEP, sqrt(2.0 * STEP_PENETRATION / max(greatest_acceleration(ball), 1e-3)))


@shared
def step_wedged(
    land: SceneRecord, balls: np.ndarray, i: int, now: float, work: WorkRecord
) -> None:
    """Solve the contacts of the wedged ball `i` at a time step's end.

    A ball with one support left, or none, is no longer wedged. Writes motion, phase, contact,
    integrator, stepping, contacts, solved_motion, position_change.
    """
    ball = balls[i]
    store(work.solver.solved_motion[i, 0:3], load(ball['velocity']))
    store(work.solver.solved_motion[i, 3:6], load(ball['spin']))
    work.counts[CONTACTS] = 0
    add_ground_contacts(land, ball, i, work, HOLDING_GAP)
    store(work.solver.position_change[i], ZERO)
    for sweep in range(WEDGED_SWEEPS):
        if sweep_impulses(land, work, sweep % 2 == 1) <= 0.01 * LEAST_SPEED:
            break
    for sweep in range(WEDGED_SWEEPS):
        if sweep_positions(work, sweep % 2 == 1) <= TOUCH:
            break
    store(ball['position'], add(load(ball['position']), load(work.solver.position_change[i])))
    write_back(ball, work, i)
    for n in range(work.counts[CONTACTS]):
        count_support(land, balls, work.contacts[n])
    left = max(length(load(ball['velocity'])) - ball['rolling_loss'], 0.0)
    limit_speed(ball, left)
    take_off(ball)
    # a fixed first step: the estimate of a hop's length would follow rounding
    if ball['held_by'] > 0:
        ball['step'] = WEDGED_STEP
    ball['last_stage_time'] = -1.0
    if ball['held_by'] == 0:
        ball['rapid_impacts'] = 0
    elif left < REST_SPEED and ball['support'] != NO_PART:
        come_to_rest(ball)
    elif ball['held_by'] == 1 and ball['support'] != NO_PART:
        ball['rapid_impacts'] = 0
        touch_down(land, ball, now)
