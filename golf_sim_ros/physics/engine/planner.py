# SPDX-License-Identifier: Apache-2.0
"""Laying a ball's next piece of path: how it moves on, and up to where that is safe."""
from math import inf

from ..collision.ball_gap import stays_in_reach
from ..collision.border_crossing import first_border
from ..collision.ground_contact import CAUGHT, IN_THE_AIR, ON_CURVE, ON_EDGE, ON_FLAT, first_contact
from ..collision.water_entry import first_dip
from ..contact.contact_state import heading, material_number, settle, stand_on, take_slip
from ..contact.curved_motion import bent_piece
from ..contact.plane_motion import flat_piece
from ..effects import flight_rates, pull
from ..geometry import surfaces
from ..geometry.water_surface import water_at
from ..integrators import step
from ..jit import borrowed, entry, kernel, shared
from ..mechanics.vector import ZERO, along, cross, dot, length, put, scale, sub, tangential, unit, vector
from ..response.ground_impact import cross_border
from ..response.time_stepping import go_straight, next_instant
from ..response.wedged_ball import caught_step, is_caught
from ..state.ball import BORDER, FLIGHT, HIT, NO_PART, PILED, ROLL, SLIDE, SPLASH, STEP, TIME_LIMIT, moves
from ..trajectory import segment
from ..trajectory.equations_of_motion import STILL

LONGEST_SHOT = 300.0  # s
ENDLESS = 100  # pieces of no length, one after the other: every second one is let go for a MOMENT,
MOMENT = 1e-9  # s, and if that goes on for longer and longer ones, up to what a path may be off
LEAST_STRAY = 1.5e-7  # m: or this
LEAST_PRESS = 0.1  # of its weight: what lift leaves of it, at least, while a ball's last bounces go on
SINKING_STEP = 0.02  # s: so often a sinking ball is asked whether it has come far enough


@kernel
def lay_next(model, ball, now):
    """Lay the ball's next piece, from its state at `now`. Writes piece, begin, end, ending."""
    ball['begin'] = now
    if not moves(ball['phase']):
        segment.stay(ball)
        ball['end'] = inf
        return
    on = lay_contact(model, ball, now) if ball['phase'] != FLIGHT else IN_THE_AIR
    if not moves(ball['phase']):  # it came to rest across a border: an event at once
        segment.stay(ball)
        ball['end'] = now
        ball['ending'] = STEP
        return
    if ball['phase'] == FLIGHT:
        on = IN_THE_AIR
        if ball['piled'] == PILED:
            go_straight(ball, next_instant(now) - now)
        else:
            step(model, ball)
    until = ball['span']
    if ball['piled']:
        on = CAUGHT
        until = min(until, next_instant(now) - now)
    elif is_caught(ball):
        on = CAUGHT
        until = min(until, caught_step(ball))
    # Borders first: on a mesh the next one is near, and contacts beyond it need not be looked for.
    crosses = False
    if on == ON_FLAT or on == ON_CURVE:
        until, crosses = first_border(model.land.ground, ball, model.land.ball.radius, until)
    border = until
    part, hit = NO_PART, False
    if not stays_in_reach(ball):
        until, part, hit = first_contact(model.land.ground, ball, model.land.ball.radius, until, on)
    if hit:
        ball['ending'] = HIT
        ball['target'] = part
    elif crosses and until == border:
        ball['ending'] = BORDER
    if until < ball['span'] and ball['ending'] != HIT and ball['ending'] != BORDER:
        ball['ending'] = STEP
    if ball['water'] > 0:
        if until > SINKING_STEP:
            until = SINKING_STEP
            ball['ending'] = STEP
    else:
        until, water = first_dip(model.land.ground.waters, ball, until)
        if water > 0:
            ball['ending'] = SPLASH
            ball['target'] = water
    end_piece(model, ball, now, until)


@kernel
def end_piece(model, ball, now, until):
    """Let the piece end after `until`, or when time ends it. Writes end, ending, stuck."""
    ball['end'] = now + max(until, 0.0)
    if ball['piled'] and ball['ending'] == STEP and ball['end'] > next_instant(now) - 1e-9:
        ball['end'] = next_instant(now)  # the same number for all
    ball['stuck'] = ball['stuck'] + 1 if ball['end'] <= now else 0
    if ball['stuck'] > ENDLESS and ball['stuck'] % 2 == 0:
        times = ball['stuck'] - ENDLESS
        most = max(model.land.limits.path, LEAST_STRAY) / (length(vector(ball['velocity'])) + 1e-3)
        ball['end'] = now + min(MOMENT * times * times, most, ball['span'])
        ball['ending'] = STEP
    if ball['playing'] and ball['end'] > ball['struck'] + LONGEST_SHOT:
        ball['end'] = ball['struck'] + LONGEST_SHOT
        ball['ending'] = TIME_LIMIT


@shared
def lay_contact(model, ball, now):
    """Lay a piece of a ball in contact, and say what it is on; it may turn out to lift off."""
    land = model.land
    is_flat = surfaces.flat_under(land.ground, ball['support'], vector(ball['position']))
    if is_flat and not goes_on(land, ball):
        cross_border(land, ball, now)
        if not moves(ball['phase']) or ball['phase'] == FLIGHT:
            return IN_THE_AIR
    ahead = unit(vector(ball['velocity']), ZERO)
    _, normal = surfaces.under(land.ground, ball['support'], vector(ball['position']), ahead)
    put(ball['normal'], normal)
    if goes_on(land, ball):
        flat_piece(land, ball, now)
        return ON_FLAT
    ball['material'] = material_number(land, ball, ball['support'], normal)
    bent_piece(model, ball, now)
    return ON_CURVE if surfaces.goes_on(land.ground, ball['support'], ball['support']) else ON_EDGE


@shared
def drift(model, ball, now):
    """Let the air act on bounces too small to follow. Writes tail and spin.

    It brakes and turns all the while; where it lifts, the bounces last longer and press less.
    """
    place = vector(ball['position'])
    normal = vector(ball['normal'])
    weight = pull(model.effects, place)
    force, torque = flight_rates(model.effects, model.land.ground, place, vector(ball['velocity']),
                                 vector(ball['spin']))
    press = -dot(weight, normal)
    longer = press / max(-dot(force, normal), LEAST_PRESS * press)
    time = longer * (ball['tail_end'] - now)
    ball['tail_end'] = now + time
    ball['tail_press'] /= longer
    put(ball['tail_air'], tangential(sub(force, weight), normal))
    put(ball['spin'], along(vector(ball['spin']), time, torque))
    if ball['phase'] == ROLL:
        take_slip(model.land, ball)


@kernel
def goes_on(land, ball):
    """Whether flat ground goes on under the ball right where it is heading."""
    ahead = along(vector(ball['position']), surfaces.LOOK_AHEAD, heading(land, ball))
    return (surfaces.flat_under(land.ground, ball['support'], ahead)
            and surfaces.touchable(land.ground, ball['support'], ahead))


@kernel
def launch(model, ball, now):
    """Decide how a ball sets off from its state: in the air, or along the ground under it."""
    ball['step'] = 0.0
    ball['stalled'] = 0
    ball['piled'] = ball['leans'] = 0
    ball['water'] = 0
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
    how deep [m] it lies in the ground, and whether it is in water.
    """
    model = borrowed(model)
    put(ball['position'], position)
    put(ball['velocity'], ZERO)
    put(ball['spin'], ZERO)
    if depth > 0.0:
        way = (0.0, 0.0, -depth)
        ball['span'] = 1.0
        put(ball['origin'], position)
        segment.lay(ball, way, (way, way), (ZERO, ZERO), (ZERO, ZERO))
        time, part, hit = first_contact(model.land.ground, ball, model.land.ball.radius, 1.0, IN_THE_AIR)
        if hit:
            put(ball['position'], segment.position(ball, time))
    part, normal = surfaces.touched(model.land.ground, vector(ball['position']), model.land.ball.radius, ZERO)
    stand_on(model.land, ball, part, normal)
    place = vector(ball['position'])
    return (part >= 0, surfaces.depth(model.land.ground, place, model.land.ball.radius),
            water_at(model.land.ground.waters, place) > 0)


@kernel
def read(ball, now):
    """Write the ball's position, velocity and spin at `now`, on its present piece."""
    if moves(ball['phase']) and now > ball['begin']:
        time = now - ball['begin']
        put(ball['position'], segment.position(ball, time))
        put(ball['velocity'], segment.velocity(ball, time))
        put(ball['spin'], segment.spin(ball, time))


@kernel
def stop_slip(model, ball):
    """Give the ball the spin of rolling. Writes spin."""
    normal = vector(ball['normal'])
    turning = dot(vector(ball['spin']), normal)
    rolling = scale(1.0 / model.land.ball.radius, cross(normal, vector(ball['velocity'])))
    put(ball['spin'], along(rolling, turning, normal))
    ball['phase'] = ROLL
