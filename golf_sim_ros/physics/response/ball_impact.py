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

"""Impacts of balls with balls."""

import numpy as np

from . import contact_set, simultaneous_impact
from .collision_log import log_impact, NOT_A_PART
from .time_stepping import begin_time_stepping, return_to_events
from ..collision import ball_interactions
from ..collision.ball_gap import gap_between
from ..collision.ground_contact import GENTLE_APPROACH
from ..collision.workspace import CONTACTS, INVOLVED, MultiBallWorkspace
from ..contact.contact_state import contact_material_number, touch_down
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import SceneRecord, Vector, WorkRecord
from ..mechanics.vector import dot, length, load, store
from ..state.ball import FLIGHT, moves
from ..state.events import BALL_HIT, BOUNCE, Log
from ..state.transitions import take_off
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.shot_record import mark_moved_by_ball

RAPID_BALL_IMPACT = 1e-4  # s between impacts: shorter where balls are coming to rest on each other
MANY_BALL_IMPACTS = 8
# m/s of approach: slower impacts are neither logged nor counted as bounces
LEAST_LOGGED_APPROACH = 0.1


@ball_interactions.resolve_ball_impact.register(MultiBallWorkspace)
def _resolve_ball_impact(
    work: MultiBallWorkspace, land: SceneRecord, balls: np.ndarray, i: int, now: float, log: Log
) -> None:
    collide_balls(land, balls, i, now, work, log)


@shared
def collide_balls(
    land: SceneRecord, balls: np.ndarray, i: int, now: float, work: WorkRecord, log: Log
) -> None:
    """Resolve the impact of ball `i` with its target, and with all that touches; it is logged.

    Impacts that follow each other ever faster hand the balls over to time stepping. Writes ball,
    work.
    """
    j = balls[i]['target']
    contact_set.add_to_set(work, j)
    contact_set.synchronize(balls[j], now)
    gap, rate, _ = gap_between(balls[i], balls[j], land.ball.radius, now)
    if gap > contact_set.SIMULTANEOUS_GAP:
        return  # the other ball has been given another segment since this impact was found
    stalls = now - balls[i]['begin'] < RAPID_BALL_IMPACT
    is_stepped = balls[i]['time_stepping'] or balls[j]['time_stepping']
    if is_stepped:
        # A pile passes the impulse on in its next time step: only this pair collides now.
        contact_set.add_ball_contact(land, balls, i, j, work, now)
    else:
        contact_set.collect_contacts(land, balls, work, now, 0)
    resolve_contact_set(land, balls, now, work, 0, log)
    resume_motion(land, balls, now, work, 0)
    for ball in (balls[i], balls[j]):
        if ball['time_stepping']:
            # a hard impact goes on at once instead of at the next time step
            if rate <= -GENTLE_APPROACH:
                return_to_events(ball)
            continue
        ball['rapid_impacts'] = ball['rapid_impacts'] + 1 if stalls else 0
        joins = is_stepped and rate > -GENTLE_APPROACH or ball['rapid_impacts'] > MANY_BALL_IMPACTS
        if moves(ball['phase']) and joins:
            begin_time_stepping(ball)


@shared
def resolve_contact_set(
    land: SceneRecord, balls: np.ndarray, now: float, work: WorkRecord, first: int, log: Log
) -> None:
    """Resolve the impact of the involved balls at all their contacts.

    Logs the impacts; with the ground, those of contacts from row `first` on. Writes velocity,
    spin, bounces, moved_by_ball, struck_at, contacts, contact_counts, velocity_change,
    motion_before.
    """
    for k in range(work.counts[INVOLVED]):
        mark_moved_by_ball(balls[work.involved[k]])
    store_motion_before(balls, work)
    simultaneous_impact.solve_reflections(land, balls, work)
    ball_interactions.log_ball_impacts(work, balls, now, log)
    for n in range(first, work.counts[CONTACTS]):
        row = work.contacts[n]
        if row['b'] < 0 and row['approach_speed'] > LEAST_LOGGED_APPROACH:
            ball = balls[row['a']]
            ball['bounces'] += 1
            normal = load(row['normal'])
            material = contact_material_number(land, ball, row['part'], normal)
            hit = BOUNCE, material, surfaces.sort(land.ground, row['part']), normal
            log_impact(
                ball,
                (now, row['a']),
                hit,
                motion_before(work, row['a']),
                load(row['impulse']),
                log,
            )


@ball_interactions.log_ball_impacts.register(MultiBallWorkspace)
def _log_ball_impacts(work: MultiBallWorkspace, balls: np.ndarray, now: float, log: Log) -> None:
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        if row['b'] >= 0 and row['approach_speed'] > LEAST_LOGGED_APPROACH:
            hit = BALL_HIT, row['b'], NOT_A_PART, load(row['normal'])
            log_impact(
                balls[row['a']],
                (now, row['a']),
                hit,
                motion_before(work, row['a']),
                load(row['impulse']),
                log,
            )


@kernel
def store_motion_before(balls: np.ndarray, work: WorkRecord) -> None:
    """Store the involved balls' velocity and spin before the impact, for the log.

    Writes motion_before.
    """
    for k in range(work.counts[INVOLVED]):
        i = work.involved[k]
        store(work.impact.motion_before[i, 0:3], load(balls[i]['velocity']))
        store(work.impact.motion_before[i, 3:6], load(balls[i]['spin']))


@kernel
def motion_before(work: WorkRecord, i: int) -> tuple[Vector, Vector]:
    """Velocity and spin of ball `i` before the impact."""
    return load(work.impact.motion_before[i, 0:3]), load(work.impact.motion_before[i, 3:6])


@kernel
def resume_motion(
    land: SceneRecord, balls: np.ndarray, now: float, work: WorkRecord, first: int
) -> None:
    """Choose phase and contact of the involved balls, from `first` on, after an impact.

    Writes phase, step, material, velocity, spin, micro_bounce_end, sleeps_on_ball.
    """
    for k in range(first, work.counts[INVOLVED]):
        ball = balls[work.involved[k]]
        if not moves(ball['phase']):
            if length(load(ball['velocity'])) + length(load(ball['spin'])) == 0.0:
                continue
            ball['micro_bounce_end'] = now
            ball['sleeps_on_ball'] = 0
        # A ball that the impact does not lift off its support keeps sliding or rolling there.
        lift = dot(load(ball['velocity']), load(ball['normal']))
        if (
            not ball['time_stepping']
            and ball['phase'] != FLIGHT
            and ball['support'] >= 0
            and (abs(lift) <= LEAST_SPEED)
        ):
            ball['step'] = 0.0
            touch_down(land, ball, now)
        else:
            take_off(ball)
