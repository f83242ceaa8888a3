# SPDX-License-Identifier: Apache-2.0
"""Sliding, rolling, pivoting, resting: motion of a ball that keeps touching the ground.

On flat ground everything is in closed form (see braked.py). With k the moment of inertia over
m r^2, slip u obeys u' = g_t - (1 + 1/k) mu N u/|u|, rolling v' = g_t/(1 + k) - a v/|v|, and a ball
slides as v = v0 + g_t t/(1 + k) + k/(1 + k) (u - u0).
"""
from math import inf

from ._compile import kernel, shared
from . import braked
from .effects import pull
from .ground import surface
from .impulse import slip
from .path import lay, position, velocity as speed_at
from .state import BALL_STOPS, FLIGHT, REST, ROLL, SLIDE, SLIP_STOPS, STEP
from .vector import ZERO, add, along, cross, dot, length, put, scale, sub, unit, vector

STILL = 1e-9  # m/s: slower than this is not moving
LONGEST = 10.0  # s of one piece


@kernel
def stand_on(land, ball, part, normal):
    """Let the ball stand on `part`, or on nothing (NO_PART). Writes support, material, normal."""
    ball['support'] = part
    ball['material'] = surface.material_of(land.ground, part)
    put(ball['normal'], normal)


@kernel
def material_under(land, ball):
    """Row of the material that the ball touches."""
    return land.materials[ball['material']]


@kernel
def in_tail(ball, now):
    """Whether the ball's last, tiny bounces are still going on."""
    return ball['tail_end'] > now


@kernel
def brake(material, press, downhill, inertia):
    """Deceleration of a rolling ball: what rolling resistance asks for and grip can give.

    Friction must brake, and turn the ball as it speeds up downhill, with k/(1 + k) of that pull. So a
    ball holds where (5/7) tan <= rolling resistance and tan <= static friction.
    """
    grip = material['static_friction'] * press - inertia / (1.0 + inertia) * length(downhill)
    return min(material['rolling_resistance'] * press, max(grip, 0.0))


@shared
def settle(land, ball, now):
    """Decide whether a ball in contact slides, rolls, pivots or rests. Writes phase and motion.

    A ball that rolls goes on rolling while its contact grips; any other must lose its slip first.
    """
    normal = vector(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surface.slope(pull(land.effects, vector(ball['position'])), normal)
    v = along(vector(ball['velocity']), -dot(vector(ball['velocity']), normal), normal)
    k = land.ball.inertia
    turning = dot(vector(ball['spin']), normal)
    grips = k / (1.0 + k) * length(downhill) <= material['static_friction'] * press
    put(ball['velocity'], v)
    sliding = slip(v, vector(ball['spin']), normal, land.ball.radius)
    if not grips or ball['phase'] != ROLL and length(sliding) > STILL:
        ball['phase'] = SLIDE
        return
    ball['phase'] = ROLL
    holds = length(downhill) / (1.0 + k) <= brake(material, press, downhill, k)
    if length(v) <= STILL and holds and not in_tail(ball, now):
        v = ZERO
        put(ball['velocity'], v)
        if material['pivot_friction'] == 0.0 or abs(turning) * land.ball.radius <= STILL:
            ball['phase'] = REST
    put(ball['spin'], along(scale(1.0 / land.ball.radius, cross(normal, v)), turning, normal))


@shared
def flat_piece(land, ball, now):
    """Lay the next piece of sliding or rolling on a plane, up to a stop or as far as it is exact."""
    normal = vector(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surface.slope(pull(land.effects, vector(ball['position'])), normal)
    tail = in_tail(ball, now)
    load = press * ball['tail_press'] if tail else press
    k = land.ball.inertia
    v = vector(ball['velocity'])
    drift = scale(1.0 / (1.0 + k), downhill)
    if ball['phase'] == SLIDE:
        u = slip(v, vector(ball['spin']), normal, land.ball.radius)
        if length(u) <= STILL:  # where it turns back, or it would turn back for ever
            u = ZERO
        motion = braked.braked(u, downhill, (1.0 + 1.0 / k) * material['dynamic_friction'] * load, normal)
        coast = (along(v, -k / (1.0 + k), u), drift, k / (1.0 + k))
    else:
        motion = braked.braked(v, drift, 0.0 if tail else brake(material, press, downhill, k), normal)
        coast = (ZERO, ZERO, 1.0)
    unwinding = material['pivot_friction'] * press / (k * land.ball.radius * land.ball.radius)
    turning = dot(vector(ball['spin']), normal)
    horizon = LONGEST
    if abs(turning) * land.ball.radius <= STILL:
        turning = 0.0
    if tail:  # single impacts do not brake a pivoting ball, nor does their sum
        unwinding = 0.0
        horizon = min(horizon, ball['tail_end'] - now)
    if unwinding > 0.0 and turning != 0.0:
        horizon = min(horizon, abs(turning) / unwinding)
    end = reach(motion, horizon)
    while True:
        lay_glide(land, ball, motion, coast, end, turning, unwinding)
        middle = braked.half_way(motion, end)
        if off_path(ball, motion, coast, middle) <= land.limits.path:
            break
        end = middle
    ball['ending'] = STEP
    if end == inf:
        ball['ending'] = SLIP_STOPS if ball['phase'] == SLIDE else BALL_STOPS


@kernel
def reach(motion, horizon):
    """Parameter at the stop, if it comes within `horizon`, else at `horizon`."""
    if braked.stops(motion) and braked.after(motion, inf)[0] <= horizon:
        return inf
    return braked.parameter_at(motion, horizon)


@kernel
def glided(motion, coast, q):
    """Time, way, velocity and slip (or rolling velocity) at the parameter `q`."""
    time, u, way = braked.after(motion, q)
    start, drift, share = coast
    velocity = along(along(start, time, drift), share, u)
    travelled = along(along(scale(time, start), 0.5 * time * time, drift), share, way)
    return time, travelled, velocity, u


@kernel
def off_path(ball, motion, coast, q):
    """Distance of the piece's curve from the closed form at the parameter `q`."""
    time, way, _, _ = glided(motion, coast, q)
    return length(sub(sub(position(ball, time), vector(ball['origin'])), way))


@kernel
def lay_glide(land, ball, motion, coast, q, turning, unwinding):
    """Lay the piece of a glide that ends at the parameter `q`. Writes the ball's curve."""
    normal = vector(ball['normal'])
    r = land.ball.radius
    time, way, v1, u1 = glided(motion, coast, q)
    u0 = braked.after(motion, 0.0)[1]
    v0 = vector(ball['velocity'])
    du0 = braked.rate(motion, u0)
    du1 = braked.rate(motion, u1)
    _, drift, share = coast
    a0 = along(drift, share, du0)
    a1 = along(drift, share, du1)
    # Where it slides, the spin follows velocity minus slip; where it rolls there is no slip.
    keep = 1.0 if ball['phase'] == SLIDE else 0.0
    left = max(abs(turning) - unwinding * time, 0.0)
    if abs(turning) - unwinding * time <= 1e-12 * abs(turning):
        left = 0.0
    sign = 1.0 if turning > 0.0 else -1.0
    winding = scale(-sign * unwinding if turning != 0.0 else 0.0, normal)
    ball['span'] = time
    put(ball['origin'], vector(ball['position']))
    put(ball['twist'][3], along(scale(1.0 / r, cross(normal, along(v1, -keep, u1))), sign * left, normal))
    lay(ball, way, (v0, v1), (a0, a1),
        (add(scale(1.0 / r, cross(normal, along(a0, -keep, du0))), winding),
         add(scale(1.0 / r, cross(normal, along(a1, -keep, du1))), winding)))


@shared
def bent_rates(land, ball, place, velocity, spin):
    """Acceleration, rate of spin, press, and grip needed, of a ball that follows ground which is not flat.

    With n' the rate of the normal: staying on the surface demands v' n = -v n', so the ground
    presses with -(g n + v n') per mass. Grip also turns spin about the normal, w_n, into motion:
    (1 + k) v'_t = g_t + k r w_n (n x n'). A sliding ball feels dynamic friction against its slip
    instead, or, where it only begins to slip, along the grip that it lacks.
    """
    r = land.ball.radius
    k = land.ball.inertia
    _, normal = surface.nearest(land.ground, ball['support'], place)
    turn = normal_rate(land, ball, place, velocity)
    press, downhill = surface.slope(pull(land.effects, place), normal)
    material = material_under(land, ball)
    press = max(press - dot(velocity, turn), 0.0)
    about = dot(spin, normal)
    free = scale(1.0 / (1.0 + k), along(downhill, k * r * about, cross(normal, turn)))
    if length(velocity) > STILL:
        free = along(free, -brake(material, press, downhill, k) / length(velocity), velocity)
    friction = sub(free, downhill)
    needed = length(friction)
    if ball['phase'] == SLIDE:
        against = scale(-1.0, slip(velocity, spin, normal, r))
        if length(against) <= STILL:
            against = friction
        friction = scale(material['dynamic_friction'] * press, unit(against, ZERO))
    force = along(add(downhill, friction), -dot(velocity, turn), normal)
    return force, scale(-1.0 / (k * r), cross(normal, friction)), press, needed


@kernel
def normal_rate(land, ball, place, velocity):
    """Rate of change of the normal under a ball that moves on at `velocity`."""
    speed = length(velocity)
    if speed == 0.0:
        return ZERO
    dt = 1e-5 * land.ball.radius / speed
    _, here = surface.nearest(land.ground, ball['support'], place)
    _, next_one = surface.nearest(land.ground, ball['support'], along(place, dt, velocity))
    return scale(1.0 / dt, sub(next_one, here))


@shared
def bent_piece(land, ball):
    """Lay a short piece around an edge by the midpoint rule; lift off where the press is gone."""
    x0 = vector(ball['position'])
    v0 = vector(ball['velocity'])
    w0 = vector(ball['spin'])
    _, _, press, needed = bent_rates(land, ball, x0, v0, w0)
    if press <= 0.0:
        ball['phase'] = FLIGHT
        ball['step'] = 0.0
        return
    if ball['phase'] == ROLL and needed > material_under(land, ball)['static_friction'] * press:
        ball['phase'] = SLIDE
    ball['ending'] = STEP
    h = min(1e-3, 0.02 * land.ball.radius / max(length(v0), 1e-3))
    bent_step(land, ball, h)
    if ball['phase'] == SLIDE:
        before = slip(v0, w0, vector(ball['normal']), land.ball.radius)
        after = slip_at_end(land, ball)
        if length(before) > STILL and dot(before, after) <= 0.0:
            bent_step(land, ball, h * length(before) / (length(before) + length(after)))
            ball['ending'] = SLIP_STOPS


@kernel
def slip_at_end(land, ball):
    """Slip of the ball at the end of its piece."""
    place = position(ball, ball['span'])
    _, normal = surface.nearest(land.ground, ball['support'], place)
    return slip(speed_at(ball, ball['span']), vector(ball['twist'][3]), normal, land.ball.radius)


@shared
def bent_step(land, ball, h):
    """Lay a piece of `h` seconds by the midpoint rule. Writes the ball's curve."""
    r = land.ball.radius
    x0 = vector(ball['position'])
    v0 = vector(ball['velocity'])
    w0 = vector(ball['spin'])
    a0, dw0, _, _ = bent_rates(land, ball, x0, v0, w0)
    am, dwm, _, _ = bent_rates(land, ball, along(x0, 0.5 * h, v0), along(v0, 0.5 * h, a0),
                               along(w0, 0.5 * h, dw0))
    x1 = along(x0, h, along(v0, 0.5 * h, a0))
    distance, n1 = surface.nearest(land.ground, ball['support'], x1)
    x1 = along(x1, r - distance, n1)
    v1 = along(v0, h, am)
    v1 = along(v1, -dot(v1, n1), n1)
    w1 = along(w0, h, dwm)
    if ball['phase'] == ROLL:
        w1 = along(scale(1.0 / r, cross(n1, v1)), dot(w1, n1), n1)
    a1, dw1, _, _ = bent_rates(land, ball, x1, v1, w1)
    ball['span'] = h
    put(ball['origin'], x0)
    put(ball['twist'][3], w1)
    lay(ball, sub(x1, x0), (v0, v1), (a0, a1), (dw0, dw1))
