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

"""Coulomb deceleration of a particle on a slope, in closed form: u' = G ex - a u/|u|.

The closed form of sliding and rolling is this, with friction and rolling resistance. In parabolic
coordinates, u = (P^2 - Q^2) ex + 2 P Q ey with speed s = P^2 + Q^2, and with dt = s dq instead of
time, the motion is linear: P' = -(a - G)/2 P, Q' = -(a + G)/2 Q. So speed, direction, time and
displacement are sums of exponentials of q; q grows without bound as the particle stops, and the
stop itself is one of its values: q = inf. (Levi-Civita's regularization of the Kepler problem is
the same substitution.) A particle that starts from rest goes straight down the slope; there q is
the time itself.
"""

from math import exp, expm1, inf, log, sqrt
from typing import NamedTuple

from .vector import add, add_scaled, cross, dot, length, scale, unit
from ..jit import kernel
from ..kernel_types import Vector

MOST_EXPONENT = 690.0  # of exp in double precision
UNREACHED = 1e300
MOST_ROUNDS = 200
FAR_TOO_LONG = 4.0  # ratio of times beyond which Newton's method is slow, and bisection takes over
# of the parameter: after so small a correction, which squares the error, only rounding is left
EXACT = 1e-9


class CoulombMotion(NamedTuple):
    """Initial state of a decelerated motion.

    Squares of P and Q, both unit vectors, slope G and brake a.
    """

    pp: float
    qq: float
    down: Vector
    side: Vector
    slope: float
    brake: float


@kernel
def decelerated(u: Vector, pull: Vector, brake: float, normal: Vector) -> CoulombMotion:
    """`CoulombMotion` motion from velocity `u` [m/s] under `pull` [m/s^2] against `brake` [m/s^2].

    `u` and `pull` lie in the plane of `normal`. At rest it heads down the slope.
    """
    # P^2 or Q^2 as (s +- u_x) / 2 cancels where the other is large: it is found from u_y = 2 P Q
    # instead.
    slope = length(pull)
    speed = length(u)
    down = unit(pull, unit(u, (1.0, 0.0, 0.0)))
    side = cross(normal, down)
    pp = 0.5 * (speed + dot(u, down))
    if dot(u, down) > 0.0:
        across = dot(u, side)
        qq = 0.25 * across * across / pp
    else:
        qq = 0.5 * (speed - dot(u, down))
        across = dot(u, side)
        pp = 0.25 * across * across / qq if qq > 0.0 else 0.0
    if dot(u, side) < 0.0:
        side = scale(-1.0, side)
    return CoulombMotion(pp, qq, down, side, slope, brake)


@kernel
def _sum(weight: float, rate: float, q: float) -> float:
    """Integral of `weight` exp(-`rate` q) from 0 to q."""
    if weight == 0.0 or q == 0.0:
        return 0.0
    if rate == 0.0:
        return weight * q
    if rate * q < -MOST_EXPONENT:
        return UNREACHED
    return -weight * expm1(-rate * q) / rate


@kernel
def _shrunk(weight: float, rate: float, q: float) -> float:
    """Value of `weight` exp(-`rate` q), without overflow or infinity times zero."""
    if weight == 0.0 or (q == inf and rate > 0.0):
        return 0.0
    if rate * q < -MOST_EXPONENT:
        return UNREACHED
    return weight * exp(-rate * q)


@kernel
def starts_at_rest(motion: CoulombMotion) -> bool:
    """Whether the particle is at rest at the start."""
    return motion.pp + motion.qq == 0.0


@kernel
def stops(motion: CoulombMotion) -> bool:
    """Whether the particle comes to a stop."""
    if starts_at_rest(motion):
        return False
    if motion.pp > 0.0:
        return motion.brake > motion.slope
    return motion.brake + motion.slope > 0.0


@kernel
def after(motion: CoulombMotion, q: float) -> tuple[float, Vector, Vector]:
    """Time, velocity and displacement at the parameter `q`."""
    slower = motion.brake - motion.slope
    faster = motion.brake + motion.slope
    if starts_at_rest(motion):
        gain = max(-slower, 0.0) * q
        return q, scale(gain, motion.down), scale(0.5 * gain * q, motion.down)
    pp = _shrunk(motion.pp, slower, q)
    qq = _shrunk(motion.qq, faster, q)
    cross_now = 2.0 * sqrt(pp * qq)
    time = _sum(motion.pp, slower, q) + _sum(motion.qq, faster, q)
    velocity = add(scale(pp - qq, motion.down), scale(cross_now, motion.side))
    ahead = _sum(motion.pp * motion.pp, 2.0 * slower, q) - _sum(
        motion.qq * motion.qq, 2.0 * faster, q
    )
    pq = 2.0 * sqrt(motion.pp * motion.qq)
    sideways = _sum(pq * motion.pp, slower + motion.brake, q) + _sum(
        pq * motion.qq, faster + motion.brake, q
    )
    return time, velocity, add(scale(ahead, motion.down), scale(sideways, motion.side))


@kernel
def rate(motion: CoulombMotion, velocity: Vector) -> Vector:
    """Acceleration at `velocity`.

    At rest the limit with which the particle comes to rest or leaves it.
    """
    # A braked particle comes to rest moving straight down the slope, or straight up it where P is
    # zero.
    speed = length(velocity)
    pull = scale(motion.slope, motion.down)
    if speed > 0.0:
        return add_scaled(pull, -motion.brake / speed, velocity)
    if starts_at_rest(motion):
        return scale(max(motion.slope - motion.brake, 0.0), motion.down)
    last = motion.down if motion.pp > 0.0 else scale(-1.0, motion.down)
    return add_scaled(pull, -motion.brake, last)


@kernel
def half_way(motion: CoulombMotion, q: float) -> float:
    """Parameter at about half the time to `q`, or, where that is infinite, at half the speed."""
    if q < inf:
        return 0.5 * q
    slowing = (
        motion.pp * (motion.brake - motion.slope) + motion.qq * (motion.brake + motion.slope)
    ) / (motion.pp + motion.qq)
    if slowing > 0.0:
        return log(2.0) / slowing
    return 1.0 / (motion.brake + motion.slope)


@kernel
def parameter_at(motion: CoulombMotion, time: float) -> float:
    """Parameter q at `time` [s], which must lie before the stop.

    Newton's method, safeguarded by a bracket. From far beyond, where time grows exponentially, it
    would come back by no more than a unit of the exponent an iteration: there the bracket is
    bisected.
    """
    if starts_at_rest(motion):
        return time
    low = 0.0
    high = inf
    q = time / (motion.pp + motion.qq)
    for _ in range(MOST_ROUNDS):
        passed = after(motion, q)
        if passed[0] < time:
            low = q
        else:
            high = q
        following = q + (time - passed[0]) / max(length(passed[1]), 1e-300)
        is_far = passed[0] > FAR_TOO_LONG * time
        if not is_far and abs(following - q) <= EXACT * q:
            return following
        if is_far or not low < following < high:
            following = 0.5 * (low + high) if high < inf else 2.0 * low
        q = following
    return q
