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

"""Moreau time stepping of balls in lasting contact with balls: piles, racks, two balls in a bowl.

Event by event their impacts would follow each other ever faster (Zeno). Such balls are
time-stepped: they move in small steps, all at the same instants, at each of which their contacts
are solved together (contact_solver.py). A ball without contact returns to flight, one with contact
to the ground alone to sliding or rolling. A ball that has been still for a while falls asleep; it
wakes when it is touched or when what it rests on moves: sleeping is each ball's, not an island's.

The velocity of a time-stepped ball is that half-way through its step (leapfrog), so that a step in
free fall is exact; one that has only just joined has its velocity at the start.
"""

from math import floor

import numpy as np

from .contact_set import add_to_set, synchronize
from .contact_solver import (
    add_ground_contacts,
    add_resting_contact,
    contact_reach,
    correct_positions,
    count_support,
    gap_rate,
    limit_speed,
    neighbours_within,
    solve_contacts,
    TIME_STEP,
    write_back,
)
from .wedged_ball import is_wedged, MANY_RAPID_IMPACTS
from ..collision import ball_interactions
from ..collision.ball_gap import position_at
from ..collision.broad_phase import next_node
from ..collision.ground_contact import RESTING_GAP
from ..collision.workspace import CONTACTS, INVOLVED, MultiBallWorkspace
from ..contact.contact_state import touch_down
from ..effects import gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, SceneRecord, WorkRecord
from ..mechanics.vector import add_scaled, length, load, scale, store, sub, ZERO
from ..state.ball import HOLED, JOINED, NO_PART, REST, STEP_END, STEPPED
from ..state.transitions import come_to_rest, take_off
from ..trajectory.segment import fit_segment
from ..trajectory.shot_record import mark_moved_by_ball

WAKING_APPROACH = 1e-3  # m/s: normal relative velocity, of either sign, that wakes a sleeper
# m/s: slower balls of a pile are damped, for the sweeps never converge completely
DAMPED_SPEED = 0.02
DAMPING = 0.9  # factor of the velocity a step
STILL_SPEED = 4e-3  # m/s, of velocity and of spin times radius: slower counts as still
STEPS_TO_SLEEP = 50  # still steps after which a ball falls asleep: a tenth of a second
FREE_SPEED = 2.0  # m/s: a faster ball returns to events


@kernel
def next_step_time(now: float) -> float:
    """Next instant of time stepping after `now`."""
    return (floor(now / TIME_STEP) + 1.0) * TIME_STEP


@kernel
def is_step_time(now: float) -> bool:
    """Whether `now` is an instant of time stepping; exact, for the step is a power of two."""
    return floor(now / TIME_STEP) * TIME_STEP == now


@kernel
def begin_time_stepping(ball: BallRecord) -> None:
    """Switch a ball from events to time stepping.

    Writes phase, stepping, step, moved_by_ball, struck_at.
    """
    mark_moved_by_ball(ball)
    ball['sleeps_on_ball'] = 0
    ball['time_stepping'] = JOINED
    ball['rapid_impacts'] = MANY_RAPID_IMPACTS + 1
    take_off(ball)
    ball['still_steps'] = 0
    ball['stored_count'] = 0


@kernel
def return_to_events(ball: BallRecord) -> None:
    """Switch a ball from time stepping back to events. Writes time_stepping, rapid_impacts."""
    ball['time_stepping'] = 0
    ball['rapid_impacts'] = 0


@kernel
def straight_segment(ball: BallRecord, span: float) -> None:
    """Plan a straight segment of `span` seconds. Writes curve, ending."""
    v = load(ball['velocity'])
    ball['span'] = span
    ball['ending'] = STEP_END
    store(ball['origin'], load(ball['position']))
    store(ball['spin_coefficients'][3], load(ball['spin']))
    fit_segment(ball, scale(span, v), (v, v), (ZERO, ZERO), (ZERO, ZERO))


@shared
def touches_ball(balls: np.ndarray, work: WorkRecord, i: int, radius: float, now: float) -> bool:
    """Whether another ball is within RESTING_GAP of ball `i`."""
    here = load(balls[i]['position'])
    low, high = surfaces.around(here, radius + RESTING_GAP)
    at = next_node(work.tree, 0, low, high)
    while at >= 0:
        j = work.tree.nodes[at]['ball']
        if (
            j != i
            and balls[j]['phase'] != HOLED
            and (length(sub(here, position_at(balls[j], now))) - 2.0 * radius <= RESTING_GAP)
        ):
            return True
        at = next_node(work.tree, at + 1, low, high)
    return False


@ball_interactions.step_together.register(MultiBallWorkspace)
def _step_together(
    work: MultiBallWorkspace, land: SceneRecord, balls: np.ndarray, i: int, now: float
) -> bool:
    if balls[i]['time_stepping']:
        if is_step_time(now):
            solve_time_step(land, balls, now, work)
        return True
    if is_wedged(balls[i]) and touches_ball(balls, work, i, land.ball.radius, now):
        begin_time_stepping(balls[i])
        return True
    return False


@ball_interactions.wake.register(MultiBallWorkspace)
def _wake(work: MultiBallWorkspace, balls: np.ndarray, radius: float, now: float) -> None:
    if not work.asleep[0]:
        return
    for k in range(work.counts[INVOLVED]):
        i = work.involved[k]
        if balls[i]['phase'] == REST:
            continue
        here = load(balls[i]['position'])
        low, high = surfaces.around(here, radius + 2.0 * RESTING_GAP)
        at = next_node(work.tree, 0, low, high)
        while at >= 0:
            j = work.tree.nodes[at]['ball']
            at = next_node(work.tree, at + 1, low, high)
            other = balls[j]
            if (
                work.involved_index[j] < 0
                and other['phase'] == REST
                and other['sleeps_on_ball']
                and (
                    length(sub(here, load(other['position']))) - 2.0 * radius <= 2.0 * RESTING_GAP
                )
            ):
                add_to_set(work, j)
                begin_time_stepping(other)


@shared
def solve_time_step(land: SceneRecord, balls: np.ndarray, now: float, work: WorkRecord) -> None:
    """Solve one time step of all time-stepped balls that are due. Writes ball, work."""
    for i in range(len(balls)):
        if (
            balls[i]['time_stepping']
            and work.segment_ends[i] == now
            and work.involved_index[i] < 0
        ):
            add_to_set(work, i)
            synchronize(balls[i], now)
    # Gravity first: contacts have to hold a ball against it.
    for k in range(work.counts[INVOLVED]):
        apply_gravity(land, balls, work, work.involved[k])
    collect_resting_contacts(land, balls, work, now)
    correct_positions(balls, work)
    solve_contacts(land, balls, work)
    for k in range(work.counts[INVOLVED]):
        write_back(balls[work.involved[k]], work, work.involved[k])
    for n in range(work.counts[CONTACTS]):
        count_support(land, balls, work.contacts[n])
    for k in range(work.counts[INVOLVED]):
        choose_after_step(land, balls[work.involved[k]], now, work)


@kernel
def apply_gravity(land: SceneRecord, balls: np.ndarray, work: WorkRecord, i: int) -> None:
    """Apply gravity to a ball up to half-way through its next step.

    Writes solved_motion, time_stepping.

    Leapfrog: a ball that has only just joined gets half a step of it.
    """
    ball = balls[i]
    time = TIME_STEP if ball['time_stepping'] == STEPPED else 0.5 * TIME_STEP
    ball['time_stepping'] = STEPPED
    weight = gravity_at(land.effects, load(ball['position']))
    store(work.solver.solved_motion[i, 0:3], add_scaled(load(ball['velocity']), time, weight))
    store(work.solver.solved_motion[i, 3:6], load(ball['spin']))


@shared
def collect_resting_contacts(
    land: SceneRecord, balls: np.ndarray, work: WorkRecord, now: float
) -> None:
    """Collect the contacts of the involved balls within reach; sleepers that they push join.

    Writes contacts, involved, neighbours, solved_motion, stepping, phase, step, struck_at,
    moved_by_ball.
    """
    reach = contact_reach(work)
    k = 0
    while k < work.counts[INVOLVED]:
        i = work.involved[k]
        add_ground_contacts(land, balls[i], i, work, reach)
        found, close_by = neighbours_within(balls, work, i, reach, land.ball.radius, now)
        balls[i]['contact_reach'] = reach
        balls[i]['watches_neighbours'] = close_by
        for n in range(found):
            j = work.solver.neighbours[n]
            if 0 <= work.involved_index[j] < k:
                continue  # ball j has added this contact already
            if work.involved_index[j] < 0:
                if balls[j]['phase'] != REST:
                    continue  # it moves from event to event: its impact is an event of its own
                rate = gap_rate(balls, i, j, now)
                if (
                    rate < -WAKING_APPROACH
                    or balls[j]['sleeps_on_ball']
                    and rate > WAKING_APPROACH
                ):
                    begin_time_stepping(balls[j])
                    add_to_set(work, j)
                    apply_gravity(land, balls, work, j)
            add_resting_contact(land, balls, work, i, j, now)
        k += 1


@kernel
def choose_after_step(land: SceneRecord, ball: BallRecord, now: float, work: WorkRecord) -> None:
    """Choose after a time step whether a ball sleeps, slides, flies, or stays time-stepped.

    Writes motion, phase, step, material, stepping, asleep.
    """
    speed = length(load(ball['velocity']))
    left = max(speed - ball['rolling_loss'], 0.0)
    # Not with a single contact with the ground: there a closed form stops the ball.
    if left < DAMPED_SPEED and ball['held_by'] > 1:
        left *= DAMPING
    limit_speed(ball, left)
    turning = land.ball.radius * length(load(ball['spin']))
    is_still = left + turning < STILL_SPEED and ball['held_by'] > 0
    ball['still_steps'] = ball['still_steps'] + 1 if is_still else 0
    take_off(ball)
    if ball['still_steps'] > STEPS_TO_SLEEP:
        ball['sleeps_on_ball'] = 1 if ball['held_by'] > 1 else 0
        work.asleep[0] |= ball['sleeps_on_ball']
        return_to_events(ball)
        come_to_rest(ball)
    elif (
        ball['held_by'] == 0
        or speed > FREE_SPEED
        or ball['held_by'] == 1
        and ball['support'] != NO_PART
    ):
        return_to_events(ball)
        # Back from half-way through the step (leapfrog) to the velocity at its start.
        weight = gravity_at(land.effects, load(ball['position']))
        store(ball['velocity'], add_scaled(load(ball['velocity']), -0.5 * TIME_STEP, weight))
        if ball['held_by'] == 1 and ball['support'] != NO_PART:
            touch_down(land, ball, now)
