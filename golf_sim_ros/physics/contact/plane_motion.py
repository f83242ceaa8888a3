# SPDX-License-Identifier: Apache-2.0
"""Sliding, rolling, pivoting, resting: motion of a ball that keeps touching flat ground.

Everything is in closed form (see coulomb_deceleration.py). With k the moment of inertia over
m r^2, slip u obeys u' = g_t - (1 + 1/k) mu N u/|u|, rolling v' = g_t/(1 + k) - a v/|v|, and a ball
slides as v = v0 + g_t t/(1 + k) + k/(1 + k) (u - u0).
"""
from math import inf

from ..effects import pull
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics import coulomb_deceleration
from ..mechanics.impulse import slip
from ..mechanics.vector import ZERO, add, along, cross, dot, length, put, scale, sub, vector
from ..state.ball import BALL_STOPS, SLIDE, SLIP_STOPS, STEP
from ..trajectory.equations_of_motion import STILL, between_bounces, brake, material_under, rolling_needs
from ..trajectory.segment import lay, position
from .contact_state import in_tail

LONGEST = 10.0  # s of one piece
UNHURRIED = 0.1  # s: a shorter piece must be the more exact, as velocity errs by a path's error over its time
ROUNDING = 1e-12  # m: no curve is nearer than this to a closed form,
RELATIVE_ROUNDING = 1e-15  # or than this share of how far away it is


@shared
def flat_piece(land, ball, now):
    """Lay the next piece of sliding or rolling on a plane, up to a stop or as far as it is exact."""
    normal = vector(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surfaces.slope(pull(land.effects, vector(ball['position'])), normal)
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
        friction = (1.0 + 1.0 / k) * material['dynamic_friction'] * load
        motion = coulomb_deceleration.braked(u, downhill, friction, normal)
        coast = (along(v, -k / (1.0 + k), u), drift, k / (1.0 + k))
    else:
        resistance = 0.0 if tail else brake(material, press, rolling_needs(downhill, k))
        motion = coulomb_deceleration.braked(v, drift, resistance, normal)
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
        middle = coulomb_deceleration.half_way(motion, end)
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
    if coulomb_deceleration.stops(motion) and coulomb_deceleration.after(motion, inf)[0] <= horizon:
        return inf
    return coulomb_deceleration.parameter_at(motion, horizon)


@kernel
def glided(motion, coast, q):
    """Time, way, velocity and slip (or rolling velocity) at the parameter `q`."""
    time, u, way = coulomb_deceleration.after(motion, q)
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
    u0 = coulomb_deceleration.after(motion, 0.0)[1]
    v0 = vector(ball['velocity'])
    du0 = coulomb_deceleration.rate(motion, u0)
    du1 = coulomb_deceleration.rate(motion, u1)
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
