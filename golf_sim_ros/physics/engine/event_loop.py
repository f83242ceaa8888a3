# SPDX-License-Identifier: Apache-2.0
"""The engine on one page: detect, evolve, resolve.

Every ball has a piece of path that is safe until its end. Advancing takes the ball whose piece
ends first, brings it there, resolves what ended it, and lays its next piece; at last every ball is
read at the time asked for. Nothing ever steps to a tick, so paths do not depend on ticks.
"""
import numpy as np

from ..collision import ball_gap, ball_interactions  # noqa: F401  (they say what balls do to each other)
from ..collision.workspace import MEMBERS, first_due
from ..contact.contact_state import settle
from ..effects import blow
from ..geometry import surfaces
from ..jit import borrowed, cycles, entry, kernel, shared
from ..mechanics.vector import ZERO, put, unit, vector
from ..response import ball_impact, time_stepping  # noqa: F401  (they say what balls do to each other)
from ..response.contact_set import disperse, enlist
from ..response.ground_impact import cross_border, meet
from ..response.water_impact import drown, emerge, is_over, splash
from ..response.wedged_ball import hold, is_caught
from ..state.ball import (BALL_STOPS, BORDER, ENDED, FLIGHT, HIT, HOLED, LAUNCH, MEETING, OUT, REST,
                          SLIP_STOPS, SPLASH, STEP, TIME_LIMIT, WATER, moves)
from ..state.events import LOST, SHOT_ENDS
from ..trajectory.shot_record import (NOT_FINITE, end_shot, fail, fault, is_finite, keep_end, keep_highest,
                                      tee_off, tell_gone)
from .planner import LONGEST_SHOT, drift, launch, lay_next, read, stop_slip

DONE, LOG_FULL = range(2)
STAGES = 'flight', 'contact', 'broad phase'
IN_FLIGHT, IN_CONTACT, NEIGHBOURS = range(3)
EVENTS_A_BALL = 3  # that one piece's end can log, but for impacts of balls


@entry
def advance(model, balls, until, crowd, log):
    """Advance `balls` to the time `until` [s]. Writes balls, crowd and log.

    Returns DONE, or LOG_FULL when `log` must be emptied before going on: it is full, or a shot has ended,
    which is to be told before anything else happens to its ball.
    """
    return run(borrowed(model), borrowed(balls), until, borrowed(crowd), borrowed(log))


@shared
def run(model, balls, until, crowd, log):
    """`advance`, of borrowed records."""
    for i in range(len(balls)):
        crowd.ends[i] = balls[i]['end']
    ball_interactions.prepare(crowd, balls, model.land.ball.radius)
    since = book(crowd, NEIGHBOURS, cycles() if len(crowd.spent) else 0)
    while True:
        i = first_due(crowd, until)
        if i < 0:
            break
        if log.count[1] or 2 * log.count[0] > len(log.events):
            return LOG_FULL
        now = balls[i]['end']
        since = book(crowd, NEIGHBOURS, since)
        stage = IN_CONTACT if balls[i]['ending'] == HIT else stage_of(balls[i])
        enlist(crowd, i)
        resolve(model, balls, i, crowd, log)
        since = book(crowd, stage, since)
        for k in range(crowd.count[MEMBERS]):
            finish(model, balls[crowd.members[k]], crowd.members[k], now, log)
            lay(model, balls[crowd.members[k]], crowd.members[k], now, log)
            since = note(balls, crowd.members[k], model.land.ball.radius, crowd, since)
        for k in range(crowd.count[MEMBERS]):
            look_out(balls, crowd.members[k], model.land.ball.radius, now, crowd)
        disperse(crowd)
    for i in range(len(balls)):
        read(balls[i], until)
    return DONE


@kernel
def resolve(model, balls, i, crowd, log):
    """Bring ball `i` to the end of its piece and let happen what ends it.

    Other balls that this moves become members of the crowd.
    """
    ball = balls[i]
    now = ball['end']
    ending = ball['ending']
    if ending != LAUNCH:
        keep_highest(ball)
        read(ball, now)
        if ball['water'] > 0:
            emerge(model.land, ball)
    if ending == LAUNCH:
        launch(model, ball, now)
        ball_interactions.rouse(crowd, balls, model.land.ball.radius, now)
    elif ending == SPLASH:
        splash(model.land, ball, i, now, log)
    elif ball['water'] > 0 and ending == HIT:
        drown(ball)
    elif ending == HIT:
        before = ball['tail_end']
        meet(model.land, balls, i, now, crowd, log)
        if ball['tail_end'] > max(before, now):
            drift(model, ball, now)
    elif ending == MEETING:
        ball_interactions.bump(crowd, model.land, balls, i, now, log)
        ball_interactions.rouse(crowd, balls, model.land.ball.radius, now)
    elif ending == BORDER:
        cross_border(model.land, ball, now)
    elif ball_interactions.lean(crowd, model.land, balls, i, now):
        pass
    elif is_caught(ball):
        hold(model.land, balls, i, now, crowd)
    elif ball['phase'] != FLIGHT:
        ahead = unit(vector(ball['velocity']), ZERO)
        _, normal = surfaces.under(model.land.ground, ball['support'], vector(ball['position']), ahead)
        put(ball['normal'], normal)
        if ending == SLIP_STOPS:
            stop_slip(model, ball)
        elif ending == BALL_STOPS:
            put(ball['velocity'], ZERO)
        settle(model.land, ball, now)


@kernel
def finish(model, ball, number, now, log):
    """End the shot of a ball that has stopped, is lost, or has been on its way for too long."""
    if not is_finite(ball):
        fail(ball, number, now, NOT_FINITE, log)
    before = ball['phase']
    if moves(before) and is_below(model.land.ground, ball, model.land.ball.radius):
        ball['phase'] = OUT
    elif is_over(model.land, ball):
        drown(ball)
    elif before == REST and is_in_hole(model, ball):
        ball['phase'] = HOLED
    if is_out(model.land.ground, ball, model.land.ball.radius):
        ball['phase'] = OUT
    if ball['phase'] == OUT and before != OUT:
        tell_gone(ball, number, now, log)
    is_lost = ball['phase'] == OUT or ball['phase'] == WATER
    if is_lost and ball['knocked'] and not ball['playing']:
        ball['knocked'] = 0
        end_shot(ball, number, now, LOST, log)
    if ball['playing'] and (not moves(ball['phase']) or ball['ending'] == TIME_LIMIT):
        end_shot(ball, number, now, SHOT_ENDS, log)


@kernel
def lay(model, ball, number, now, log):
    """Lay the ball's next piece; if it can't go on, its shot fails. Writes piece."""
    lay_next(model, ball, now)
    if moves(ball['phase']):
        why = fault(ball, now)
        if why:
            fail(ball, number, now, why, log)
            lay_next(model, ball, now)


@kernel
def note(balls, i, radius, crowd, since):
    """Take note of ball `i`'s new piece. Writes crowd. Returns the cycles at its end; see `book`."""
    since = book(crowd, stage_of(balls[i]), since)
    crowd.ends[i] = balls[i]['end']
    ball_interactions.note(crowd, balls, i, radius)
    return book(crowd, NEIGHBOURS, since)


@kernel
def stage_of(ball):
    """Stage that a ball's motion belongs to."""
    return IN_FLIGHT if ball['phase'] == FLIGHT else IN_CONTACT


@kernel
def book(crowd, stage, since):
    """Book the cycles from `since` until now on a stage, if somebody asks. Returns now. Writes spent."""
    if len(crowd.spent) == 0:
        return since
    now = cycles()
    crowd.spent[stage] += now - since
    return now


@entry
def cycles_now():
    """Cycles of the processor so far, as in `book`."""
    return cycles()


@kernel
def look_out(balls, i, radius, now, crowd):
    """End ball `i`'s piece where it meets another ball. Writes end, ending, target."""
    ball = balls[i]
    if moves(ball['phase']):
        time, other, hit = ball_interactions.meeting(crowd, balls, i, radius, now)
        if time < ball['end'] or hit:
            ball['end'] = time
            ball['ending'] = MEETING if hit else STEP
            ball['target'] = other
            crowd.ends[i] = time
            ball_interactions.note(crowd, balls, i, radius)
    elif ball['phase'] == REST:
        ball_interactions.stand_in_the_way(crowd, balls, i, radius, now)


@kernel
def is_below(ground, ball, radius):
    """Whether the ball fell below all ground."""
    return ball['water'] == 0 and ball['position'][2] < ground.lowest - 10.0 * radius


@kernel
def is_out(ground, ball, radius):
    """Whether a ball that was struck, or set off by another, has come to rest out of bounds.

    It is out if all of it is (Rules of Golf 18.2a(2)); one that is still moving may come back.
    """
    if not (ball['playing'] or ball['knocked']) or ball['phase'] != REST and ball['phase'] != WATER:
        return False
    return surfaces.out_of_bounds(ground, ball['position'][0], ball['position'][1]) >= radius


@kernel
def is_in_hole(model, ball):
    """Whether the ball's centre is in the hole."""
    hole = model.land.ground.hole
    return len(hole) > 0 and surfaces.in_cup(hole, vector(ball['position']))


@entry
def play_all(model, ball, strikes, gusts, crowd, log):
    """Play shots one after the other, each from the state in `ball`. Returns their ends, an `ENDED` array.

    `ball` is an array of one; rows of `strikes` are velocity and spin; rows of `gusts` a time since
    the strike, the first 0, and the wind from then on; `crowd` and `log` are scratch.
    """
    model = borrowed(model)
    crowd = borrowed(crowd)
    log = borrowed(log)
    strikes = borrowed(strikes)
    gusts = borrowed(gusts)
    ends = np.empty(len(strikes), ENDED)
    played = ball.copy()
    one = borrowed(played)
    for i in range(len(strikes)):
        played[0] = ball[0]
        put(one[0]['velocity'], vector(strikes[i, 0:3]))
        put(one[0]['spin'], vector(strikes[i, 3:6]))
        tee_off(one[0], 0.0)
        blow(model.effects, vector(gusts[0, 1:4]))
        gust = 1
        while one[0]['playing']:
            log.count[:] = 0
            until = gusts[gust, 0] if gust < len(gusts) else LONGEST_SHOT + 1.0
            if run(model, one, until, crowd, log) == DONE and gust < len(gusts):
                blow(model.effects, vector(gusts[gust, 1:4]))
                end_now(one[0], until)
                gust += 1
        keep_end(one[0], ends[i])
    return ends


@kernel
def end_now(ball, now):
    """End a flying ball's piece at `now`: its surroundings have changed. Writes end, ending."""
    if ball['phase'] == FLIGHT:
        ball['end'] = now
        ball['ending'] = STEP
        ball['rated'] = -1.0
