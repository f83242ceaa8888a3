# SPDX-License-Identifier: Apache-2.0
"""Following ground which is not flat: around an edge, over a crest, across a green.

The integrator of flight steps the equations of contact as well; at a step's end the ball is put back on
the ground, with a velocity along it and, where it rolls, the spin of rolling. A step ends early where
the ground ceases to press, where slip ends and where the ball stops: there the equations change.
"""
from math import inf

from ._compile import kernel, shared
from .ground import surface
from .impulse import slip
from .integrators import step
from .motion import STILL, following_rates, material_under
from .path import lay
from .state import BALL_STOPS, FLIGHT, ROLL, SLIDE, SLIP_STOPS, STEP
from .vector import along, cross, dot, length, put, scale, sub, vector

MOST_TURN = 0.1  # rad of the normal in a step
FIRST_STEP = 0.02  # s
LEAST_STEP = 1e-7  # s
CORRECTIONS = 12  # of a step's length
LIFTS = 1e-6  # of the press at the start: a ground that pulls by more lets the ball go before


@shared
def bent_piece(model, ball):
    """Lay a step along ground that is not flat; lift off where the press is gone. Writes the curve."""
    land = model.land
    place = vector(ball['position'])
    v = vector(ball['velocity'])
    w = vector(ball['spin'])
    force, _, press, needed = following_rates(land, ball, place, v, w)
    if press <= 0.0:
        ball['phase'] = FLIGHT
        ball['step'] = 0.0
        return
    if ball['phase'] == ROLL and needed > material_under(land, ball)['static_friction'] * press:
        ball['phase'] = SLIDE
    turning = length(surface.turn(land.ground, ball['support'], place, v))
    h = FIRST_STEP if ball['step'] == 0.0 else ball['step']
    h = min(h, MOST_TURN / max(turning, 1e-3))
    h = max(min(h, time_to_change(land, ball, force, press)), LEAST_STEP)
    normal = vector(ball['normal'])
    slipping = slip(v, w, normal, land.ball.radius)
    for _ in range(CORRECTIONS):
        ball['step'] = h
        step(model, ball)
        following = ball['step']
        h = ball['span']
        pressing = put_on_ground(land, ball)
        left = share_left(land, ball, v, slipping, press, pressing)
        if left == 1.0 or h * left <= LEAST_STEP:
            break
        h *= left
    ball['step'] = following
    ball['ending'] = what_ends(land, ball, v, slipping)


@kernel
def time_to_change(land, ball, force, press):
    """About how long [s] until slip ends, or until a braked ball stops."""
    v = vector(ball['velocity'])
    material = material_under(land, ball)
    if ball['phase'] == SLIDE:
        u = slip(v, vector(ball['spin']), vector(ball['normal']), land.ball.radius)
        losing = (1.0 + 1.0 / land.ball.inertia) * material['dynamic_friction'] * press
        return length(u) / losing if losing > 0.0 and length(u) > STILL else inf
    slowing = -dot(force, v)
    if material['rolling_resistance'] > 0.0 and slowing > 0.0 and length(v) > STILL:
        return dot(v, v) / slowing
    return inf


@kernel
def share_left(land, ball, v, slipping, press, pressing):
    """Share of the step after which the equations change, or 1."""
    if pressing < -LIFTS * press:
        return max(press / (press - pressing), 0.01)
    if ball['phase'] == SLIDE:
        after = slip_at_end(land, ball)
        before = length(slipping)
        if before > STILL and dot(slipping, after) < 0.0 and length(after) > 1e-6 * before + STILL:
            return before / (before + length(after))
        return 1.0
    after = end_velocity(ball)
    if (material_under(land, ball)['rolling_resistance'] > 0.0 and length(v) > STILL and dot(v, after) < 0.0
            and length(after) > 1e-6 * length(v) + STILL):
        return length(v) / (length(v) + length(after))
    return 1.0


@kernel
def what_ends(land, ball, v, slipping):
    """What is at the end of the step: STEP, SLIP_STOPS or BALL_STOPS."""
    if ball['phase'] == SLIDE:
        before = length(slipping)
        after = slip_at_end(land, ball)
        if before > STILL and (dot(slipping, after) <= 0.0 or length(after) <= 1e-6 * before):
            return SLIP_STOPS
        return STEP
    if material_under(land, ball)['rolling_resistance'] > 0.0 and length(v) > STILL:
        after = end_velocity(ball)
        if dot(v, after) <= 0.0 or length(after) <= 1e-6 * length(v):
            return BALL_STOPS
    return STEP


@kernel
def put_on_ground(land, ball):
    """Put the end of the piece on the ground, moving along it. Writes the curve; returns the press there."""
    r = land.ball.radius
    x0 = vector(ball['position'])
    end = along(x0, 1.0, vector(ball['path'][5]))
    distance, normal = surface.nearest(land.ground, ball['support'], end)
    end = along(end, r - distance, normal)
    velocity = end_velocity(ball)
    velocity = along(velocity, -dot(velocity, normal), normal)
    spin = vector(ball['twist'][3])
    if ball['phase'] == ROLL:
        spin = along(scale(1.0 / r, cross(normal, velocity)), dot(spin, normal), normal)
    put(ball['twist'][3], spin)
    force, torque, press, _ = following_rates(land, ball, end, velocity, spin)
    first = ball['stages'][0]
    lay(ball, sub(end, x0), (vector(ball['velocity']), velocity), (vector(first[3:6]), force),
        (vector(first[6:9]), torque))
    return press


@kernel
def end_velocity(ball):
    """Velocity at the end of the piece."""
    w = ball['path']
    return scale(5.0 / ball['span'], sub(vector(w[5]), vector(w[4])))


@kernel
def slip_at_end(land, ball):
    """Slip of the ball at the end of its piece."""
    place = along(vector(ball['origin']), 1.0, vector(ball['path'][5]))
    _, normal = surface.nearest(land.ground, ball['support'], place)
    return slip(end_velocity(ball), vector(ball['twist'][3]), normal, land.ball.radius)
