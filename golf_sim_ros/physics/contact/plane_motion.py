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

"""Closed form of sliding and rolling, and of pivoting, on flat ground (coulomb_deceleration.py).

With k the moment of inertia over m r^2 and N the press, slip u obeys
u' = g_t - (1 + 1/k) mu N u/|u|, the velocity of rolling v' = g_t/(1 + k) - a v/|v|, and that of
sliding is v = v0 + g_t t/(1 + k) + k/(1 + k) (u - u0).

Resistance that grows with speed has a closed form on level ground only (straight_rolling.py).
Where little of it is left it is taken as constant; before that, the equations are integrated
(curved_motion.py): see `resists_evenly`.
"""

from math import inf

from .contact_state import in_micro_bounces
from ..effects import gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, SceneRecord, Vector
from ..mechanics import coulomb_deceleration
from ..mechanics.impulse import slip
from ..mechanics.vector import (
    add,
    add_scaled,
    cross,
    dot,
    length,
    load,
    scale,
    store,
    sub,
    unit,
    ZERO,
)
from ..state.ball import BALL_STOPS, SLIDE, SLIP_STOPS, STEP_END
from ..trajectory.equations_of_motion import (
    growing_needs,
    growth_rate,
    LEAST_SPEED,
    material_under,
    micro_bounce_forces,
    rolling_deceleration,
    rolling_needs,
)
from ..trajectory.segment import fit_segment, position

LONGEST_SEGMENT = 10.0  # s
# s: a shorter segment must be more exact, for velocity errs by position's error over time
UNHURRIED = 0.1
# m/s: by more than this no preset lets it err where friction turns, or the ball would gain energy
VELOCITY_ERROR = 1e-5
LEAST_BRAKE = 1e-3  # m/s^2: a ball that is braked less is as good as never stopped
EVENLY = 6.0  # of a steadily growing acceleration: its rate times time^3 over the way
# No curve is asked to be nearer to a closed form than LEAST_PATH_ERROR, or than a share of
# RELATIVE_ROUNDING of its distance from the origin.
LEAST_PATH_ERROR = 1e-12  # m
RELATIVE_ROUNDING = 1e-15

# Velocity at the start, less the share of slip; acceleration; share of slip in the velocity.
Coast = tuple[Vector, Vector, float]


@kernel
def resists_evenly(land: SceneRecord, ball: BallRecord, now: float) -> bool:
    """Whether the ball's resistance changes so little that it may be taken as constant.

    That of a ball that slides up to the end of its slip, that of one that rolls up to its stop:
    the change of the deceleration over that time moves it by less than a path may be off.
    """
    material = material_under(land, ball)
    if material['resistance_growth'] * material['rolling_resistance'] == 0.0 or in_micro_bounces(
        ball, now
    ):
        return True
    normal = load(ball['normal'])
    press, downhill = surfaces.slope(gravity_at(land.effects, load(ball['position'])), normal)
    k = land.ball.inertia
    v = load(ball['velocity'])
    growth = growth_rate(material, press)
    if ball['phase'] == SLIDE:
        braking = material['dynamic_friction'] * press
        u = slip(v, load(ball['spin']), normal, land.ball.radius)
        growth *= 1.0 + k
        # Where its slip ends, it is faster or slower: in between no faster than at both ends.
        fastest = max(length(v), length(add_scaled(v, -k / (1.0 + k), u)))
        # What grows with speed brakes the centre alone, and so drives slip: where friction can't
        # hold it, slip does not end, or begins anew the other way.
        losing = (1.0 + 1.0 / k) * braking - growth * fastest * fastest - length(downhill)
        if losing < LEAST_BRAKE:
            return False
        time = length(u) / losing
        fastest += length(downhill) / (1.0 + k) * time
        pull = braking + growth * fastest * fastest + length(downhill)
        change = 2.0 * growth * pull * fastest * time
    else:
        needed = rolling_needs(material, press, downhill, v, k)
        if needed > material['static_friction'] * press:
            return False
        resistance = rolling_deceleration(material, press, needed)
        braking = resistance - length(downhill) / (1.0 + k)
        fastest = length(v)
        if fastest < braking * LONGEST_SEGMENT:
            time = fastest / braking
        else:  # a slope may drive it
            time = LONGEST_SEGMENT
            fastest -= min(braking, 0.0) * time
        grip = growing_needs(material, press, (fastest, 0.0, 0.0), k) * fastest
        change = max(growth * fastest * fastest, grip)
    return change * time * time <= EVENLY * land.limits.path


@kernel
def even_growth(land: SceneRecord, ball: BallRecord, press: float, v: Vector) -> float:
    """Deceleration [m/s^2] that stands for what grows with speed until slip, or motion, ends.

    Of a ball that slides its value half-way, of one that rolls its mean over the way.
    """
    material = material_under(land, ball)
    k = land.ball.inertia
    growth = growth_rate(material, press)
    if ball['phase'] == SLIDE:
        u = slip(v, load(ball['spin']), load(ball['normal']), land.ball.radius)
        half_way = add_scaled(v, -0.5 * k / (1.0 + k), u)
        return (1.0 + k) * growth * length(half_way) * length(half_way)
    return 0.5 * growth * dot(v, v)


@shared
def plane_segment(land: SceneRecord, ball: BallRecord, now: float) -> None:
    """Plan a segment of sliding or rolling on a plane.

    It goes up to a stop, or as far as a Bezier curve is exact. Writes curve, ending.
    """
    normal = load(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surfaces.slope(gravity_at(land.effects, load(ball['position'])), normal)
    micro_bouncing = in_micro_bounces(ball, now)
    pressing = press
    if micro_bouncing:
        pressing, downhill = micro_bounce_forces(ball, normal, press, downhill)
    k = land.ball.inertia
    v = load(ball['velocity'])
    growing = 0.0 if micro_bouncing else even_growth(land, ball, press, v)
    if ball['phase'] == SLIDE and growing > 0.0:
        downhill = add_scaled(downhill, -growing, unit(v, ZERO))
    drift = scale(1.0 / (1.0 + k), downhill)
    if ball['phase'] == SLIDE:
        u = slip(v, load(ball['spin']), normal, land.ball.radius)
        # slip turns round here: else rounding would end a segment here for ever
        if length(u) <= LEAST_SPEED:
            u = ZERO
        friction = (1.0 + 1.0 / k) * material['dynamic_friction'] * pressing
        motion = coulomb_deceleration.decelerated(u, downhill, friction, normal)
        coast = (add_scaled(v, -k / (1.0 + k), u), drift, k / (1.0 + k))
    else:
        needed = rolling_needs(material, press, downhill, ZERO, k)
        resistance = growing + (
            0.0 if micro_bouncing else rolling_deceleration(material, press, needed)
        )
        motion = coulomb_deceleration.decelerated(v, drift, resistance, normal)
        coast = (ZERO, ZERO, 1.0)
    unwinding = material['pivot_friction'] * press / (k * land.ball.radius * land.ball.radius)
    turning = dot(load(ball['spin']), normal)
    horizon = LONGEST_SEGMENT
    if abs(turning) * land.ball.radius <= LEAST_SPEED:
        turning = 0.0
    if micro_bouncing:  # single impacts do not brake a pivoting ball, nor does their sum
        unwinding = 0.0
        horizon = min(horizon, ball['micro_bounce_end'] - now)
    if unwinding > 0.0 and turning != 0.0:
        horizon = min(horizon, abs(turning) / unwinding)
    end = glide_end(motion, horizon)
    # The closed form is exact, its quintic interpolant is not: the segment is halved until it errs
    # by less than a path may.
    while True:
        fit_glide(land, ball, motion, coast, end, (turning, unwinding))
        middle = coulomb_deceleration.half_way(motion, end)
        if not glide_error(ball, motion, coast, middle) > allowed_error(land, ball):
            break
        end = middle
    ball['ending'] = STEP_END
    if end == inf:
        ball['ending'] = SLIP_STOPS if ball['phase'] == SLIDE else BALL_STOPS


@kernel
def allowed_error(land: SceneRecord, ball: BallRecord) -> float:
    """Distance [m] by which the segment's curve may be off its closed form."""
    x = ball['position']
    rounding = RELATIVE_ROUNDING * (abs(x[0]) + abs(x[1]) + abs(x[2]))
    allowed = land.limits.path * min(1.0, ball['span'] / UNHURRIED)
    if ball['phase'] == SLIDE:
        allowed = min(allowed, VELOCITY_ERROR * ball['span'])
    return max(allowed, LEAST_PATH_ERROR, rounding)


@kernel
def glide_end(motion: coulomb_deceleration.CoulombMotion, horizon: float) -> float:
    """Parameter at the stop, if it comes within `horizon` [s], else at `horizon`."""
    if (
        coulomb_deceleration.stops(motion)
        and coulomb_deceleration.after(motion, inf)[0] <= horizon
    ):
        return inf
    return coulomb_deceleration.parameter_at(motion, horizon)


@kernel
def glide_at(
    motion: coulomb_deceleration.CoulombMotion, coast: Coast, q: float
) -> tuple[float, Vector, Vector, Vector]:
    """Time, displacement, velocity and slip (or rolling velocity) at the parameter `q`."""
    time, u, way = coulomb_deceleration.after(motion, q)
    start, drift, share = coast
    velocity = add_scaled(add_scaled(start, time, drift), share, u)
    travelled = add_scaled(add_scaled(scale(time, start), 0.5 * time * time, drift), share, way)
    return time, travelled, velocity, u


@kernel
def glide_error(
    ball: BallRecord, motion: coulomb_deceleration.CoulombMotion, coast: Coast, q: float
) -> float:
    """Distance of the segment's curve from the closed form at the parameter `q`."""
    time, way, _, _ = glide_at(motion, coast, q)
    return length(sub(sub(position(ball, time), load(ball['origin'])), way))


@kernel
def fit_glide(
    land: SceneRecord,
    ball: BallRecord,
    motion: coulomb_deceleration.CoulombMotion,
    coast: Coast,
    q: float,
    pivot: tuple[float, float],
) -> None:
    """Fit the segment to the closed form up to the parameter `q`. Writes curve.

    `pivot` is the spin about the normal, and its deceleration.
    """
    turning, unwinding = pivot
    normal = load(ball['normal'])
    r = land.ball.radius
    time, way, v1, u1 = glide_at(motion, coast, q)
    u0 = coulomb_deceleration.after(motion, 0.0)[1]
    v0 = load(ball['velocity'])
    du0 = coulomb_deceleration.rate(motion, u0)
    du1 = coulomb_deceleration.rate(motion, u1)
    _, drift, share = coast
    a0 = add_scaled(drift, share, du0)
    a1 = add_scaled(drift, share, du1)
    # A sliding ball's spin is that of rolling at velocity minus slip; a rolling ball has no slip.
    keep = 1.0 if ball['phase'] == SLIDE else 0.0
    left = max(abs(turning) - unwinding * time, 0.0)
    # rounding must not leave it turning
    if abs(turning) - unwinding * time <= 1e-12 * abs(turning):
        left = 0.0
    sign = 1.0 if turning > 0.0 else -1.0
    winding = scale(-sign * unwinding if turning != 0.0 else 0.0, normal)
    ball['span'] = time
    store(ball['origin'], load(ball['position']))
    store(
        ball['spin_coefficients'][3],
        add_scaled(scale(1.0 / r, cross(normal, add_scaled(v1, -keep, u1))), sign * left, normal),
    )
    fit_segment(
        ball,
        way,
        (v0, v1),
        (a0, a1),
        (
            add(scale(1.0 / r, cross(normal, add_scaled(a0, -keep, du0))), winding),
            add(scale(1.0 / r, cross(normal, add_scaled(a1, -keep, du1))), winding),
        ),
    )
