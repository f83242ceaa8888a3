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

"""Rolling on level ground whose rolling resistance grows with speed, in closed form.

The ball rolls straight on, and v' = -(a + c v^2) is that of a falling body in quadratic drag,
upwards: with an angle p, v = sqrt(a/c) tan p, which falls by sqrt(a c) a second, and the way is
log(cos p1 / cos p0) / c. Of static friction S, slowing the spin takes N v^2, and constant
resistance has only what is left: then a = S, and c is less by N.
"""

from math import atan, cos, log, sqrt, tan

from .contact_state import in_micro_bounces
from .plane_motion import allowed_error, LONGEST_SEGMENT
from ..effects import gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, SceneRecord, Vector
from ..mechanics.vector import add_scaled, cross, dot, length, load, scale, store, sub, unit, ZERO
from ..state.ball import BALL_STOPS, ROLL, STEP_END
from ..trajectory.equations_of_motion import (
    growing_needs,
    growth_rate,
    LEAST_SPEED,
    material_under,
    unwinding,
)
from ..trajectory.segment import fit_segment, position

LEAST_GROWTH = 1e-6  # of the growth of resistance: a closed form with less is not exact
SAME_GRIP = 1e-9  # of the resistance: grip that falls short by less is taken as enough

# Deceleration at rest [m/s^2], and its growth with the square of the speed [1/m].
Braking = tuple[float, float]


@kernel
def rolls_straight(land: SceneRecord, ball: BallRecord, now: float) -> bool:
    """Whether the ball rolls on level ground, braked, gripping and without micro-bounces."""
    if ball['phase'] != ROLL or in_micro_bounces(ball, now):
        return False
    weight = gravity_at(land.effects, load(ball['position']))
    press, downhill = surfaces.slope(weight, load(ball['normal']))
    if dot(downhill, downhill) > 0.0:
        return False
    (even, growing), grip, _ = level_braking(land, ball, press)
    # Where hardly anything grows, rounding would be all of it.
    least = LEAST_GROWTH * growth_rate(material_under(land, ball), press)
    return grip >= 0.0 and even > 0.0 and growing > least


@kernel
def level_braking(
    land: SceneRecord, ball: BallRecord, press: float
) -> tuple[Braking, float, float]:
    """Braking of the ball on level ground, grip that slowing its spin leaves, and a speed.

    The grip is in m/s^2. The braking holds from the ball's speed down to that speed [m/s]. Where
    much of the grip is needed to slow the spin, constant resistance has what is left: see
    `rolling_deceleration`.
    """
    material = material_under(land, ball)
    v = load(ball['velocity'])
    growth = growth_rate(material, press)
    even = material['rolling_resistance'] * press
    most = material['static_friction'] * press
    needed = growing_needs(material, press, v, land.ball.inertia) * length(v)
    if (1.0 - SAME_GRIP) * even <= most - needed or needed == 0.0:
        return (min(even, most), growth), most - needed, 0.0
    spinning = needed / dot(v, v)
    return (most, growth - spinning), most - needed, sqrt(max(most - even, 0.0) / spinning)


@shared
def rolling_segment(land: SceneRecord, ball: BallRecord) -> None:
    """Plan a segment up to the stop, or as far as a Bezier curve is exact.

    Writes curve, ending.
    """
    normal = load(ball['normal'])
    material = material_under(land, ball)
    press, _ = surfaces.slope(gravity_at(land.effects, load(ball['position'])), normal)
    braking, _, slowest = level_braking(land, ball, press)
    turning = dot(load(ball['spin']), normal)
    losing = unwinding(material, press, land.ball.radius, land.ball.inertia)
    end = LONGEST_SEGMENT
    if abs(turning) * land.ball.radius <= LEAST_SPEED:
        turning = losing = 0.0
    if losing > 0.0:
        end = min(end, abs(turning) / losing)
    pivot = (turning, losing if turning > 0.0 else -losing)
    per_speed = sqrt(braking[1] / braking[0])
    turn = atan(per_speed * length(load(ball['velocity']))) - atan(per_speed * slowest)
    stop = turn / sqrt(braking[0] * braking[1])
    ball['ending'] = BALL_STOPS if stop <= end and slowest == 0.0 else STEP_END
    end = min(end, stop)
    while True:
        fit_straight(land, ball, braking, end, pivot)
        _, way = rolled_on(ball, braking, 0.5 * end)
        off = sub(sub(position(ball, 0.5 * end), load(ball['origin'])), way)
        if not length(off) > allowed_error(land, ball):
            break
        end *= 0.5
        ball['ending'] = STEP_END


@kernel
def rolled_on(ball: BallRecord, braking: Braking, time: float) -> tuple[Vector, Vector]:
    """Velocity and displacement of the ball after `time`, which is not after its stop."""
    a, c = braking
    v = load(ball['velocity'])
    ahead = unit(v, ZERO)
    begin = atan(length(v) * sqrt(c / a))
    now = max(begin - sqrt(a * c) * time, 0.0)
    return scale(sqrt(a / c) * tan(now), ahead), scale(log(cos(now) / cos(begin)) / c, ahead)


@kernel
def fit_straight(
    land: SceneRecord, ball: BallRecord, braking: Braking, time: float, pivot: tuple[float, float]
) -> None:
    """Fit the segment to the motion up to `time`. Writes curve.

    `pivot` is the spin about the normal, and what it loses a second.
    """
    normal = load(ball['normal'])
    turning, losing = pivot
    v0 = load(ball['velocity'])
    v1, way = rolled_on(ball, braking, time)
    ahead = unit(v0, ZERO)
    a0 = scale(-braking[0] - braking[1] * dot(v0, v0), ahead)
    a1 = scale(-braking[0] - braking[1] * dot(v1, v1), ahead)
    left = turning - losing * time
    if abs(left) <= 1e-12 * abs(turning):  # rounding must not leave it turning
        left = 0.0
    ball['span'] = time
    store(ball['origin'], load(ball['position']))
    rolling = scale(1.0 / land.ball.radius, cross(normal, v1))
    store(ball['spin_coefficients'][3], add_scaled(rolling, left, normal))
    rates = (
        add_scaled(scale(1.0 / land.ball.radius, cross(normal, a0)), -losing, normal),
        add_scaled(scale(1.0 / land.ball.radius, cross(normal, a1)), -losing, normal),
    )
    fit_segment(ball, way, (v0, v1), (a0, a1), rates)
