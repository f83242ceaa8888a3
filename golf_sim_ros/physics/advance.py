# SPDX-License-Identifier: Apache-2.0
"""The engine on one page: detect, evolve, resolve.

Every ball has a piece of path that is safe until its end. Advancing takes the ball whose piece
ends first, brings it there, resolves what ended it, and lays its next piece; at last every ball is
read at the time asked for. Nothing ever steps to a tick, so paths do not depend on ticks.
"""
from math import inf

import numpy as np

from ._compile import borrowed, entry, kernel
from . import path
from .contact import STILL, bent_piece, flat_piece, settle, stand_on
from .detect import IN_THE_AIR, ON_EDGE, ON_FLAT, first_border, first_contact
from .ground import surface
from .impact import MANY_STALLS, cross_border, meet
from .integrators import step
from .state import (BALL_STOPS, BORDER, FLIGHT, HIT, LAUNCH, OUT, REST, ROLL, SHOT_ENDS, SLIDE, SLIP_STOPS,
                    STEP, TIME_LIMIT)
from .vector import ZERO, along, cross, dot, length, put, scale, vector

LONGEST_SHOT = 300.0  # s
DONE, LOG_FULL = range(2)
EVENTS_A_BALL = 2  # that one piece's end can log
CAUGHT_STEP = 1e-4  # s in which a ball caught between surfaces moves freely


@entry
def advance(model, balls, until, log):
    """Advance `balls` to the time `until` [s]. Writes balls and log.

    Returns DONE, or LOG_FULL when `log` must be emptied before going on.
    """
    model = borrowed(model)
    balls = borrowed(balls)
    log = borrowed(log)
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
    if moves(ball['phase']) and now > ball['begin']:
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
    if ending != LAUNCH:
        keep_highest(ball)
        read(ball, now)
    if ending == LAUNCH:
        launch(model, ball, now)
    elif ending == HIT:
        note_landing(ball, now)
        meet(model.land, ball, number, now, log)
    elif ending == BORDER:
        cross_border(model.land, ball, now)
    elif ball['phase'] != FLIGHT:
        if ending == SLIP_STOPS:
            stop_slip(model, ball)
        elif ending == BALL_STOPS:
            put(ball['velocity'], ZERO)
        settle(model.land, ball, now)
    if is_out(model, ball):
        ball['phase'] = OUT
    if ball['playing'] and (not moves(ball['phase']) or ending == TIME_LIMIT):
        end_shot(ball, number, now, log)


@kernel
def stop_slip(model, ball):
    """Give the ball the spin of rolling. Writes spin."""
    normal = vector(ball['normal'])
    turning = dot(vector(ball['spin']), normal)
    rolling = scale(1.0 / model.land.ball.radius, cross(normal, vector(ball['velocity'])))
    put(ball['spin'], along(rolling, turning, normal))
    ball['phase'] = ROLL


@kernel
def is_out(model, ball):
    """Whether the ball fell below all ground, or is on the ground outside the bounds."""
    if not ball['position'][2] >= model.land.ground.lowest - 10.0 * model.land.ball.radius:
        return True  # not a number, too: whatever went wrong, the shot is over
    on_ground = ball['phase'] != FLIGHT or ball['ending'] == HIT
    return on_ground and not surface.in_bounds(model.land.ground, ball['position'][0], ball['position'][1])


@kernel
def end_shot(ball, number, now, log):
    """Log the end of the ball's shot. Writes playing, ended."""
    ball['ended'] = now
    if moves(ball['phase']):
        ball['over_time'] = 1
        ball['phase'] = REST
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
    ball['playing'] = 0
    event = log.events[log.count[0]]
    log.count[0] += 1
    event['time'] = now
    event['ball'] = number
    event['kind'] = SHOT_ENDS


@kernel
def lay_next(model, ball, now):
    """Lay the ball's next piece, from its state at `now`. Writes piece, begin, end, ending."""
    ball['begin'] = now
    if not moves(ball['phase']):
        path.stay(ball)
        ball['end'] = inf
        return
    on = lay_contact(model, ball, now) if ball['phase'] != FLIGHT else IN_THE_AIR
    if not moves(ball['phase']):  # it came to rest across a border: an event at once
        path.stay(ball)
        ball['end'] = now
        ball['ending'] = STEP
        return
    if ball['phase'] == FLIGHT:
        on = IN_THE_AIR
        step(model.method, model, ball)
    until = ball['span']
    if ball['stalled'] > MANY_STALLS:
        until = min(until, CAUGHT_STEP)
    else:
        until, part, hit = first_contact(model.land.ground, ball, model.land.ball.radius, until, on)
        if hit:
            ball['ending'] = HIT
            ball['target'] = part
    if on == ON_FLAT:
        until, crosses = first_border(model.land.ground, ball, model.land.ball.radius, until)
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
    if leaves_support(model.land, ball):
        cross_border(model.land, ball, now)
        if not moves(ball['phase']) or ball['phase'] == FLIGHT:
            return IN_THE_AIR
    _, normal = surface.nearest(model.land.ground, ball['support'], vector(ball['position']))
    put(ball['normal'], normal)
    if surface.flat_under(model.land.ground, ball['support'], vector(ball['position'])):
        flat_piece(model.land, ball, now)
        return ON_FLAT
    bent_piece(model.land, ball)
    return ON_EDGE


@kernel
def leaves_support(land, ball):
    """Whether the flat ground under the ball ends right where it is heading."""
    place = vector(ball['position'])
    if not surface.flat_under(land.ground, ball['support'], place):
        return False
    speed = length(vector(ball['velocity']))
    if speed == 0.0:
        return False
    ahead = along(place, surface.LOOK_AHEAD / speed, vector(ball['velocity']))
    return not (surface.flat_under(land.ground, ball['support'], ahead)
                and surface.touchable(land.ground, ball['support'], ahead))


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
    """Decide how a ball sets off from its state: in the air, or along the ground under it."""
    ball['step'] = 0.0
    ball['stalled'] = 0
    ball['tail_end'] = now
    ball['phase'] = FLIGHT
    lift = dot(vector(ball['velocity']), vector(ball['normal']))
    if ball['support'] >= 0 and abs(lift) <= STILL:
        ball['phase'] = SLIDE
        settle(model.land, ball, now)


@entry
def put_down(model, ball, position, depth):
    """Put a ball down at `position`, lowered along z by at most `depth` until it touches.

    Writes position, support and normal; the ball is at rest. Returns whether it touches anything,
    and how deep [m] it lies in the ground.
    """
    put(ball['position'], position)
    put(ball['velocity'], ZERO)
    put(ball['spin'], ZERO)
    if depth > 0.0:
        way = (0.0, 0.0, -depth)
        ball['span'] = 1.0
        put(ball['origin'], position)
        path.lay(ball, way, (way, way), (ZERO, ZERO), (ZERO, ZERO))
        time, part, hit = first_contact(model.land.ground, ball, model.land.ball.radius, 1.0, IN_THE_AIR)
        if hit:
            put(ball['position'], path.position(ball, time))
    part, normal = surface.touched(model.land.ground, vector(ball['position']), model.land.ball.radius, ZERO)
    stand_on(model.land, ball, part, normal)
    return part >= 0, surface.depth(model.land.ground, vector(ball['position']), model.land.ball.radius)


@entry
def play_all(model, ball, velocities, spins, log):
    """Play shots one after the other, each from the state in `ball`. Returns the balls at the end.

    `ball` is an array of one, `velocities` and `spins` are (n, 3); `log` is scratch.
    """
    n = len(velocities)
    ends = np.empty(n, ball.dtype)
    for i in range(n):
        ends[i] = ball[0]
        one = ends[i:i + 1]
        put(one[0]['velocity'], vector(velocities[i]))
        put(one[0]['spin'], vector(spins[i]))
        tee_off(one[0], 0.0)
        one[0]['shot'] = i + 1
        while one[0]['playing']:
            log.count[0] = 0
            advance(model, one, LONGEST_SHOT + 1.0, log)
    return ends


@entry
def tee_off(ball, now):
    """Begin a shot with the ball's velocity and spin at `now`. Writes what is kept of a shot."""
    ball['playing'] = 1
    ball['struck'] = now
    ball['end'] = now
    ball['ending'] = LAUNCH
    ball['highest'] = ball['position'][2]
    put(ball['struck_at'], vector(ball['position']))
    put(ball['launch'], vector(ball['velocity']))
    put(ball['launch_spin'], vector(ball['spin']))
    ball['flew'] = 0
    ball['landed'] = 0
    ball['bounces'] = 0
    ball['over_time'] = 0
