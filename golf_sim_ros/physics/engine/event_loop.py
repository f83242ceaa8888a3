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

"""Event-driven engine on one page: detect, evolve, resolve.

Every ball has a segment that is safe until its end. The event loop takes the ball whose segment
ends first, brings it there, resolves the event that ended it, and plans its next segment; at last
every ball is read at the time asked for. Nothing ever steps to a tick, so paths do not depend on
ticks.
"""

from typing import NamedTuple

import numpy as np

from .planner import (
    apply_air_to_micro_bounces,
    launch,
    LONGEST_SHOT,
    plan_next_segment,
    read_segment,
    stop_slip,
)
from ..collision import ball_gap, ball_interactions  # noqa: F401  (ball_gap registers laws)
from ..collision.workspace import INVOLVED, next_event_ball
from ..contact.contact_state import choose_contact_mode
from ..effects import at_time, protocol, set_drift
from ..geometry import surfaces
from ..geometry.surfaces import Ground
from ..jit import borrowed, cycles, entry, kernel, literal_unroll, shared
from ..kernel_types import BallRecord, Effects, ModelRecord, SceneRecord, Vector, WorkRecord
from ..mechanics.vector import load, store, unit, ZERO
from ..response import ball_impact, time_stepping  # noqa: F401  (they register laws)
from ..response.collision_log import log_out_of_bounds
from ..response.contact_set import add_to_set, clear_set
from ..response.ground_impact import cross_border, resolve_ground_impact
from ..response.water_impact import has_ended_in_water, leave_water, resolve_water_impact
from ..response.wedged_ball import is_wedged, step_wedged
from ..state.ball import (
    BALL_IMPACT,
    BALL_STOPS,
    BORDER_CROSSING,
    ENDED,
    FLIGHT,
    GROUND_IMPACT,
    LAUNCH,
    moves,
    OUT,
    REST,
    SLIP_STOPS,
    STEP_END,
    TIME_LIMIT,
    WATER,
    WATER_ENTRY,
)
from ..state.events import Log, LOST, SHOT_ENDS
from ..state.transitions import hole_out, leave_bounds, sink
from ..trajectory.equations_of_motion import go_on_from_kept, kept_surface
from ..trajectory.shot_record import (
    begin_shot,
    check_segment,
    copy_result,
    end_shot,
    fail,
    is_finite,
    NOT_FINITE,
    update_apex,
)

DONE, LOG_FULL = range(2)
STAGES = 'flight', 'contact', 'broad phase'
IN_FLIGHT, IN_CONTACT, IN_BROAD_PHASE = range(3)
# m along x and y between the air of two shots of a batch: each meets other eddies
EDDIES_APART = 173.2, 91.6
EVENTS_A_BALL = 3  # events that one segment's end can log, beside impacts of balls


@entry
def advance(
    model: ModelRecord, balls: np.ndarray, until: float, work: WorkRecord, log: Log
) -> int:
    """Advance `balls` to the time `until` [s]. Writes balls, work and log.

    Returns DONE, or LOG_FULL when `log` must be emptied before going on: it is full, or a shot has
    ended, which is to be reported before anything else happens to its ball.
    """
    return run_events(borrowed(model), borrowed(balls), until, borrowed(work), borrowed(log))


@shared
def run_events(
    model: ModelRecord, balls: np.ndarray, until: float, work: WorkRecord, log: Log
) -> int:
    """`advance`, with borrowed records. Writes balls, work, log."""
    for i in range(len(balls)):
        work.segment_ends[i] = balls[i]['end']
    ball_interactions.prepare_broad_phase(work, balls, model.land.ball.radius)
    since = count_cycles(work, IN_BROAD_PHASE, cycles() if len(work.spent) else 0)
    while True:
        i = next_event_ball(work, until)
        if i < 0:
            break
        # half of it: one event can log many impacts
        if log.count[1] or 2 * log.count[0] > len(log.events):
            return LOG_FULL
        now = balls[i]['end']
        since = count_cycles(work, IN_BROAD_PHASE, since)
        stage = IN_CONTACT if balls[i]['ending'] == GROUND_IMPACT else stage_of(balls[i])
        add_to_set(work, i)
        resolve(model, balls, i, work, log)
        since = count_cycles(work, stage, since)
        for k in range(work.counts[INVOLVED]):
            end_if_over(model, balls[work.involved[k]], work.involved[k], now, log)
            plan_or_fail(model, balls[work.involved[k]], work.involved[k], now, log)
            since = note_segment(balls, work.involved[k], model.land.ball.radius, work, since)
        # All involved balls are planned before any is tested against others, whose segments must
        # be current.
        for k in range(work.counts[INVOLVED]):
            limit_by_balls(balls, work.involved[k], model.land.ball.radius, now, work)
        clear_set(work)
    for i in range(len(balls)):
        read_segment(balls[i], until)
    return DONE


@kernel
def resolve(model: ModelRecord, balls: np.ndarray, i: int, work: WorkRecord, log: Log) -> None:
    """Bring ball `i` to the end of its segment and resolve the event there. Writes ball, work.

    Other balls that this moves become involved. Impacts are logged.
    """
    ball = balls[i]
    now = ball['end']
    at_time(model.effects, now)
    ending = ball['ending']
    if ending != LAUNCH:
        update_apex(ball)
        read_segment(ball, now)
        if ball['water'] > 0:
            leave_water(model.land, ball)
    if ending == LAUNCH:
        launch(model, ball, now)
        ball_interactions.wake(work, balls, model.land.ball.radius, now)
    elif ending == WATER_ENTRY:
        resolve_water_impact(model.land, ball, i, now, log)
    elif ball['water'] > 0 and ending == GROUND_IMPACT:  # no bounces under water
        sink(ball)
    elif ending == GROUND_IMPACT:
        before = ball['micro_bounce_end']
        resolve_ground_impact(model.land, balls, i, now, work, log)
        if ball['micro_bounce_end'] > max(before, now):  # micro-bounces have begun, by this impact
            apply_air_to_micro_bounces(model, ball, now)
    elif ending == BALL_IMPACT:
        ball_interactions.resolve_ball_impact(work, model.land, balls, i, now, log)
        ball_interactions.wake(work, balls, model.land.ball.radius, now)
    elif ending == BORDER_CROSSING:
        cross_border(model.land, ball, now)
    elif ball_interactions.step_together(work, model.land, balls, i, now):
        pass
    elif is_wedged(ball):
        step_wedged(model.land, balls, i, now, work)
    elif ball['phase'] != FLIGHT:
        go_on_in_contact(model, ball, now)


@kernel
def go_on_in_contact(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Resolve the end of a step of a ball in contact. Writes motion, normal, phase, stages."""
    whole = has_whole_step(model.land, ball)
    store(ball['normal'], normal_at_end(model.land, ball, whole))
    if ball['ending'] == SLIP_STOPS:
        stop_slip(model, ball)
    elif ball['ending'] == BALL_STOPS:
        store(ball['velocity'], ZERO)
    choose_contact_mode(model.land, ball, now)
    if whole and load(ball['velocity']) != ZERO:
        go_on_from_kept(ball, now)


@kernel
def has_whole_step(land: SceneRecord, ball: BallRecord) -> bool:
    """Whether the segment ends where a step on a smooth surface does, which is kept.

    A segment that was cut ends elsewhere; older records keep nothing.
    """
    return (
        surfaces.goes_on(land.ground, ball['support'], ball['support'])
        and ball['end'] == ball['begin'] + ball['span']
        and kept_surface(ball)[1] != ZERO
    )


@kernel
def normal_at_end(land: SceneRecord, ball: BallRecord, whole: bool) -> Vector:
    """Compute the normal under a ball in contact at the end of its segment.

    ``whole``: `has_whole_step`.
    """
    if whole:
        return kept_surface(ball)[1]
    ahead = unit(load(ball['velocity']), ZERO)
    return surfaces.under(land.ground, ball['support'], load(ball['position']), ahead)[1]


@kernel
def end_if_over(model: ModelRecord, ball: BallRecord, number: int, now: float, log: Log) -> None:
    """End the shot of a ball that has stopped, is lost, or is over time. Logs it.

    Writes motion, phase, shot.
    """
    if not is_finite(ball):
        fail(ball, number, now, NOT_FINITE, log)
    before = ball['phase']
    if moves(before) and is_below_ground(model.land.ground, ball, model.land.ball.radius):
        leave_bounds(ball)
    elif has_ended_in_water(model.land, ball):
        sink(ball)
    elif before == REST and is_in_hole(model, ball):
        # No speed of capture: it is holed once it rests there.
        hole_out(ball)
    if is_out(model.land.ground, ball, model.land.ball.radius):
        leave_bounds(ball)
    if ball['phase'] == OUT and before != OUT:
        log_out_of_bounds(ball, number, now, log)
    # A ball set off by another has no shot and so no result: only its loss is logged.
    is_lost = ball['phase'] == OUT or ball['phase'] == WATER
    if is_lost and ball['moved_by_ball'] and not ball['shot_active']:
        ball['moved_by_ball'] = 0
        end_shot(ball, number, now, LOST, log)
    if ball['shot_active'] and (not moves(ball['phase']) or ball['ending'] == TIME_LIMIT):
        end_shot(ball, number, now, SHOT_ENDS, log)


@kernel
def plan_or_fail(model: ModelRecord, ball: BallRecord, number: int, now: float, log: Log) -> None:
    """Plan the ball's next segment, or fail its shot if it can't go on.

    Writes segment, integrator, contact, on_flat, phase, motion, shot; logs a failure.
    """
    plan_next_segment(model, ball, now)
    if moves(ball['phase']):
        why = check_segment(ball, now)
        if why:
            fail(ball, number, now, why, log)
            plan_next_segment(model, ball, now)  # at rest


@kernel
def note_segment(balls: np.ndarray, i: int, radius: float, work: WorkRecord, since: int) -> int:
    """Enter ball `i`'s new segment into the workspace. Writes segment_ends, tree, spent.

    Takes and returns cycles as `count_cycles` does.
    """
    since = count_cycles(work, stage_of(balls[i]), since)
    work.segment_ends[i] = balls[i]['end']
    ball_interactions.update_tree(work, balls, i, radius)
    return count_cycles(work, IN_BROAD_PHASE, since)


@kernel
def stage_of(ball: BallRecord) -> int:
    """Stage that a ball's motion belongs to."""
    return IN_FLIGHT if ball['phase'] == FLIGHT else IN_CONTACT


@kernel
def count_cycles(work: WorkRecord, stage: int, since: int) -> int:
    """Cycles now; those from `since` on are added to a stage, if cycles are measured.

    Writes spent.
    """
    if len(work.spent) == 0:
        return since
    now = cycles()
    work.spent[stage] += now - since
    return now


@entry
def cycles_now() -> int:
    """Cycles of the processor so far, as in `count_cycles`."""
    return cycles()


@kernel
def limit_by_balls(balls: np.ndarray, i: int, radius: float, now: float, work: WorkRecord) -> None:
    """End ball `i`'s segment where it hits another ball.

    Writes end, ending, target, segment_ends, tree.

    A ball at rest ends the segments of others instead.
    """
    ball = balls[i]
    if moves(ball['phase']):
        time, other, hit = ball_interactions.first_ball_contact(work, balls, i, radius, now)
        if time < ball['end'] or hit:
            ball['end'] = time
            ball['ending'] = BALL_IMPACT if hit else STEP_END
            ball['target'] = other
            work.segment_ends[i] = time
            ball_interactions.update_tree(work, balls, i, radius)
    elif ball['phase'] == REST:
        ball_interactions.interrupt_segments(work, balls, i, radius, now)


@kernel
def is_below_ground(ground: Ground, ball: BallRecord, radius: float) -> bool:
    """Whether the ball fell below all ground."""
    return ball['water'] == 0 and ball['position'][2] < ground.lowest - 10.0 * radius


@kernel
def is_out(ground: Ground, ball: BallRecord, radius: float) -> bool:
    """Whether a ball that was struck, or set off by another, has come to rest out of bounds.

    It is out if all of it is (Rules of Golf 18.2a(2)); one that is still moving may come back.
    """
    if (
        not (ball['shot_active'] or ball['moved_by_ball'])
        or ball['phase'] != REST
        and ball['phase'] != WATER
    ):
        return False
    return surfaces.out_of_bounds(ground, ball['position'][0], ball['position'][1]) >= radius


@kernel
def is_in_hole(model: ModelRecord, ball: BallRecord) -> bool:
    """Whether the ball's centre is in the hole."""
    hole = model.land.ground.hole
    return len(hole) > 0 and surfaces.in_cup(hole, load(ball['position']))


class Schedule(NamedTuple):
    """What changes during a shot: a live parameter of the effects of ``records``.

    ``rows``: a time since the strike [s], the first 0, and the values from then on. The records
    are of the model, or share its arrays.
    """

    records: Effects
    rows: np.ndarray


@entry
def play_all(
    model: ModelRecord,
    ball: BallRecord,
    strikes: np.ndarray,
    schedule: Schedule,
    work: WorkRecord,
    log: Log,
) -> np.ndarray:
    """Play shots one after the other, each from the state in `ball`; their ends, an `ENDED` array.

    `ball` is an array of one; rows of `strikes` are velocity, spin and the shot's number. Writes
    work, log.
    """
    model = borrowed(model)
    work = borrowed(work)
    log = borrowed(log)
    strikes = borrowed(strikes)
    schedule = borrowed(schedule)
    rows = schedule.rows
    ends = np.empty(len(strikes), ENDED)
    played = ball.copy()
    one = borrowed(played)
    for i in range(len(strikes)):
        played[0] = ball[0]
        store(one[0]['velocity'], load(strikes[i, 0:3]))
        store(one[0]['spin'], load(strikes[i, 3:6]))
        begin_shot(one[0], 0.0)
        follow(schedule.records, model.effects, 0.0, rows[0, 1:])
        apart = strikes[i, 6]
        set_drift(model.effects, (EDDIES_APART[0] * apart, EDDIES_APART[1] * apart, 0.0))
        row = 1
        while one[0]['shot_active']:
            log.count[:] = 0
            # After the last row up to a time by which every shot has ended.
            until = rows[row, 0] if row < len(rows) else LONGEST_SHOT + 1.0
            if run_events(model, one, until, work, log) == DONE and row < len(rows):
                follow(schedule.records, model.effects, until, rows[row, 1:])
                end_now(one[0], until)
                row += 1
        copy_result(one[0], ends[i])
    return ends


@kernel
def follow(records: Effects, effects: Effects, now: float, value: np.ndarray) -> None:
    """Set the live parameter of `records`, some of the `effects`, at a time `now`.

    Writes records and effects.
    """
    at_time(effects, now)
    for record in literal_unroll(records):
        protocol.set_live(record, value)


@kernel
def end_now(ball: BallRecord, now: float) -> None:
    """End a moving ball's segment at `now`, since its surroundings have changed.

    Writes end, ending, last_stage_time. The last stage holds rates in the old surroundings.
    """
    if moves(ball['phase']):
        ball['end'] = now
        ball['ending'] = STEP_END
        ball['last_stage_time'] = -1.0
