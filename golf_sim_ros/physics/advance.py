# SPDX-License-Identifier: Apache-2.0
"""The engine on one page: detect, evolve, resolve.

Every ball has a piece of path that is safe until its end. Advancing takes the ball whose piece
ends first, brings it there, resolves what ended it, and lays its next piece; at last every ball is
read at the time asked for. Nothing ever steps to a tick, so paths do not depend on ticks.
"""
from math import inf

from ._compile import kernel
from . import path
from .contact import bent_piece, flat_piece, settle
from .detect import IN_THE_AIR, ON_EDGE, ON_FLAT, first_border, first_contact
from .ground import surface
from .impact import MANY_STALLS, cross_border, meet
from .integrators import step
from .state import (BALL_STOPS, BORDER, FLIGHT, HIT, OUT, REST, ROLL, SHOT_ENDS, SLIDE, SLIP_STOPS,
                    STEP, TIME_LIMIT)
from .vector import ZERO, along, cross, dot, put, scale, vector

LONGEST_SHOT = 300.0  # s
DONE, LOG_FULL = range(2)
EVENTS_A_BALL = 2  # that one piece's end can log
CAUGHT_STEP = 1e-4  # s in which a ball caught between surfaces moves freely


@kernel
def advance(model, balls, until, log):
    """Advance `balls` to the time `until` [s]. Writes balls and log.

    Returns DONE, or LOG_FULL when `log` must be emptied before going on.
    """
    while True:
        i = first_due(balls, until)
        if i < 0:
            break
        if log.count[0] + EVENTS_A_BALL > len(log.events):
            return LOG_FULL
        resolve(model, balls[i], i, log)
        lay_next(model, balls[i], balls[i]['end'])
    for i in range(len(balls)):
        read(balls[i], until)
    return DONE


@kernel
def first_due(balls, until):
    """Ball whose piece ends first, at `until` at the latest, or -1."""
    who = -1
    first = until
    for i in range(len(balls)):
        if balls[i]['end'] < first or who < 0 and balls[i]['end'] == first:
            first = balls[i]['end']
            who = i
    return who


@kernel
def read(ball, now):
    """Write the ball's position, velocity and spin at `now`, on its present piece."""
    if moves(ball['phase']):
        time = now - ball['begin']
        put(ball['position'], path.position(ball, time))
        put(ball['velocity'], path.velocity(ball, time))
        put(ball['spin'], path.spin(ball, time))


@kernel
def moves(phase):
    """Whether a ball in `phase` moves."""
    return phase == FLIGHT or phase == SLIDE or phase == ROLL


@kernel
def resolve(model, ball, number, log):
    """Bring the ball to the end of its piece and let happen what ends it."""
    now = ball['end']
    ending = ball['ending']
    keep_highest(ball)
    read(ball, now)
    if ending == HIT:
        note_landing(ball, now)
        meet(model, ball, number, now, log)
    elif ending == BORDER:
        cross_border(model, ball, now)
    elif ball['phase'] != FLIGHT:
        if ending == SLIP_STOPS:
            stop_slip(model, ball)
        elif ending == BALL_STOPS:
            put(ball['velocity'], ZERO)
        settle(model, ball, now)
    if is_out(model, ball):
        ball['phase'] = OUT
    if ball['playing'] and (not moves(ball['phase']) or ending == TIME_LIMIT):
        end_shot(ball, number, now, log)


@kernel
def stop_slip(model, ball):
    """Give the ball the spin of rolling. Writes spin."""
    normal = vector(ball['normal'])
    turning = dot(vector(ball['spin']), normal)
    rolling = scale(1.0 / model.ball.radius, cross(normal, vector(ball['velocity'])))
    put(ball['spin'], along(rolling, turning, normal))
    ball['phase'] = ROLL


@kernel
def is_out(model, ball):
    """Whether the ball fell below all ground, or is on the ground outside the bounds."""
    if ball['position'][2] < model.ground.lowest - 10.0 * model.ball.radius:
        return True
    on_ground = ball['phase'] != FLIGHT or ball['ending'] == HIT
    return on_ground and not surface.in_bounds(model.ground, ball['position'][0], ball['position'][1])


@kernel
def end_shot(ball, number, now, log):
    """Log the end of the ball's shot. Writes playing."""
    if moves(ball['phase']):
        ball['phase'] = REST
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
    ball['playing'] = 0
    event = log.events[log.count[0]]
    log.count[0] += 1
    event['time'] = now
    event['ball'] = number
    event['kind'] = SHOT_ENDS
    event['material'] = ball['ending']


@kernel
def lay_next(model, ball, now):
    """Lay the ball's next piece, from its state at `now`. Writes piece, begin, end, ending."""
    ball['begin'] = now
    if not moves(ball['phase']):
        path.stay(ball)
        ball['end'] = inf
        return
    on = lay_contact(model, ball, now) if ball['phase'] != FLIGHT else IN_THE_AIR
    if ball['phase'] == FLIGHT:
        on = IN_THE_AIR
        step(model.method, model, ball)
    until = ball['span']
    if ball['stalled'] > MANY_STALLS:
        until = min(until, CAUGHT_STEP)
    else:
        until, part, hit = first_contact(model.ground, ball, model.ball.radius, until, on)
        if hit:
            ball['ending'] = HIT
            ball['target'] = part
    if on == ON_FLAT:
        until, crosses = first_border(model.ground, ball, model.ball.radius, until)
        if crosses:
            ball['ending'] = BORDER
    if until < ball['span'] and ball['ending'] != HIT and ball['ending'] != BORDER:
        ball['ending'] = STEP
    ball['end'] = now + until
    if ball['playing'] and ball['end'] > ball['struck'] + LONGEST_SHOT:
        ball['end'] = ball['struck'] + LONGEST_SHOT
        ball['ending'] = TIME_LIMIT


@kernel
def lay_contact(model, ball, now):
    """Lay a piece of a ball in contact, and say what it is on; it may turn out to lift off."""
    _, normal = surface.nearest(model.ground, ball['support'], vector(ball['position']))
    put(ball['normal'], normal)
    if surface.flat_under(model.ground, ball['support'], vector(ball['position'])):
        flat_piece(model, ball, now)
        return ON_FLAT
    bent_piece(model, ball)
    return ON_EDGE


@kernel
def keep_highest(ball):
    """Keep the greatest height that the ball reaches on its piece of flight. Writes highest."""
    if ball['phase'] != FLIGHT:
        return
    ball['flew'] = 1
    time = ball['end'] - ball['begin']
    start = path.position(ball, 0.0)[2]
    ball['highest'] = max(ball['highest'], max(start, path.position(ball, time)[2]))
    if path.span_along(ball, 2)[1] <= ball['highest']:
        return
    low = 0.0
    high = time
    if path.velocity(ball, low)[2] <= 0.0 or path.velocity(ball, high)[2] >= 0.0:
        return
    for _ in range(50):
        middle = 0.5 * (low + high)
        if path.velocity(ball, middle)[2] > 0.0:
            low = middle
        else:
            high = middle
    ball['highest'] = max(ball['highest'], path.position(ball, low)[2])


@kernel
def note_landing(ball, now):
    """Keep where and how a struck ball first touches the ground. Writes landing."""
    if ball['playing'] and not ball['landed'] and ball['phase'] == FLIGHT:
        ball['landed'] = 1
        ball['landing'] = now
        put(ball['landed_at'], vector(ball['position']))
        put(ball['landing_velocity'], vector(ball['velocity']))


@kernel
def launch(model, ball, now):
    """Set a ball going from its state at `now`: in the air, or along the ground under it."""
    normal = vector(ball['normal'])
    ball['step'] = 0.0
    ball['stalled'] = 0
    ball['tail_end'] = now
    lift = dot(vector(ball['velocity']), normal)
    if ball['support'] >= 0 and abs(lift) <= 1e-9:
        ball['phase'] = SLIDE
        settle(model, ball, now)
    else:
        ball['phase'] = FLIGHT
    lay_next(model, ball, now)


@kernel
def interrupt(model, balls, now):
    """Begin new pieces at `now` for the balls in flight: their surroundings have changed."""
    for i in range(len(balls)):
        if balls[i]['phase'] == FLIGHT:
            read(balls[i], now)
            lay_next(model, balls[i], now)


@kernel
def lower(model, ball, x, y, height, depth):
    """Lower a ball along z from `height` by at most `depth` until it touches. Writes contact.

    Returns whether it touched anything.
    """
    put(ball['position'], (x, y, height))
    put(ball['origin'], (x, y, height))
    put(ball['velocity'], ZERO)
    put(ball['spin'], ZERO)
    ball['span'] = 1.0
    down = (0.0, 0.0, -depth)
    path.lay(ball, down, (down, down), (ZERO, ZERO), (ZERO, ZERO))
    time, part, hit = first_contact(model.ground, ball, model.ball.radius, 1.0, IN_THE_AIR)
    if hit:
        put(ball['position'], (x, y, height - depth * time))
        stand(model, ball)
    return hit


@kernel
def stand(model, ball):
    """Find out what a ball at its position touches. Writes support and normal."""
    part, normal = surface.touched(model.ground, vector(ball['position']), model.ball.radius, ZERO)
    ball['support'] = part
    put(ball['normal'], normal)
