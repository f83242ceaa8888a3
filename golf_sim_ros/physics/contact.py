# SPDX-License-Identifier: Apache-2.0
"""Sliding, rolling, pivoting, resting: motion of a ball that keeps touching flat ground.

Everything is in closed form (see braked.py). With k the moment of inertia over
m r^2, slip u obeys u' = g_t - (1 + 1/k) mu N u/|u|, rolling v' = g_t/(1 + k) - a v/|v|, and a ball
slides as v = v0 + g_t t/(1 + k) + k/(1 + k) (u - u0).
"""
from math import inf

from .jit import kernel, shared
from . import braked
from .effects import pull
from .ground import surface
from .impulse import slip
from .motion import STILL, between_bounces, brake, material_under, rolling_needs
from .path import lay, position
from .state import BALL_STOPS, REST, ROLL, SLIDE, SLIP_STOPS, STEP
from .vector import ZERO, add, along, cross, dot, length, put, scale, sub, unit, vector

LONGEST = 10.0  # s of one piece
UNHURRIED = 0.1  # s: a shorter piece must be the more exact, as velocity errs by a path's error over its time
ROUNDING = 1e-12  # m: no curve is nearer than this to a closed form,
RELATIVE_ROUNDING = 1e-15  # or than this share of how far away it is


@kernel
def stand_on(land, ball, part, normal):
    """Let the ball stand on `part`, or on nothing (NO_PART). Writes support, material, normal."""
    ball['support'] = part
    ball['material'] = material_number(land, ball, part, normal)
    put(ball['normal'], normal)


@kernel
def material_number(land, ball, part, normal):
    """Number of the material of `part` where the ball touches it with `normal`."""
    foot = along(vector(ball['position']), -land.ball.radius, normal)
    return surface.material_of(land.ground, part, foot)


@kernel
def material_of(land, ball, part, normal):
    """Row of the material of `part` where the ball touches it with `normal`."""
    return land.materials[material_number(land, ball, part, normal)]


@kernel
def take_slip(land, ball):
    """Let grip take all slip at once, as an impulse. Writes velocity and spin."""
    normal = vector(ball['normal'])
    r = land.ball.radius
    k = land.ball.inertia
    push = scale(-k / (1.0 + k), slip(vector(ball['velocity']), vector(ball['spin']), normal, r))
    put(ball['velocity'], add(vector(ball['velocity']), push))
    put(ball['spin'], along(vector(ball['spin']), -1.0 / (k * r), cross(normal, push)))


@kernel
def in_tail(ball, now):
    """Whether the ball's last, tiny bounces are still going on."""
    return ball['tail_end'] > now


@kernel
def heading(land, ball):
    """Unit vector to where the ball moves, or, where it stands, to where friction and weight drive it."""
    v = vector(ball['velocity'])
    if length(v) > 0.0:
        return unit(v, ZERO)
    normal = vector(ball['normal'])
    press, driven = surface.slope(pull(land.effects, vector(ball['position'])), normal)
    if ball['phase'] == SLIDE:
        sliding = unit(slip(v, vector(ball['spin']), normal, land.ball.radius), ZERO)
        driven = along(driven, -material_under(land, ball)['dynamic_friction'] * press, sliding)
    return unit(driven, ZERO)


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
    needed = rolling_needs(downhill, k)
    grips = needed <= material['static_friction'] * press
    put(ball['velocity'], v)
    sliding = slip(v, vector(ball['spin']), normal, land.ball.radius)
    if not grips or ball['phase'] != ROLL and length(sliding) > STILL:
        ball['phase'] = SLIDE
        return
    ball['phase'] = ROLL
    holds = length(downhill) / (1.0 + k) <= brake(material, press, needed)
    if length(v) <= STILL and holds and not in_tail(ball, now):
        v = ZERO
        put(ball['velocity'], v)
        if abs(turning) * land.ball.radius <= STILL:
            turning = 0.0
        if material['pivot_friction'] == 0.0 or turning == 0.0:
            ball['phase'] = REST
    put(ball['spin'], along(scale(1.0 / land.ball.radius, cross(normal, v)), turning, normal))


@shared
def flat_piece(land, ball, now):
    """Lay the next piece of sliding or rolling on a plane, up to a stop or as far as it is exact."""
    normal = vector(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surface.slope(pull(land.effects, vector(ball['position'])), normal)
    tail = in_tail(ball, now)
    load = press
    if tail:
        load, downhill = between_bounces(ball, normal, press, downhill)
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
        resistance = 0.0 if tail else brake(material, press, rolling_needs(downhill, k))
        motion = braked.braked(v, drift, resistance, normal)
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
    x = ball['position']
    rounding = RELATIVE_ROUNDING * (abs(x[0]) + abs(x[1]) + abs(x[2]))
    while True:
        lay_glide(land, ball, motion, coast, end, turning, unwinding)
        middle = braked.half_way(motion, end)
        allowed = max(land.limits.path * min(1.0, ball['span'] / UNHURRIED), ROUNDING, rounding)
        if not off_path(ball, motion, coast, middle) > allowed:
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
