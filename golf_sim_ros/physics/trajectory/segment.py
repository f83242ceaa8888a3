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

"""Segment of a path: a Bezier curve, dense output for every integrator and closed form.

Position is of degree five: it interpolates position, velocity and acceleration at both ends
(quintic Hermite), so it serves every integrator whose step ends with the rates there. Spin is of
degree three (cubic Hermite). Coefficients are Bernstein's, relative to the start: the curve lies
within their convex hull, which gives bounds for nothing, and short segments keep full precision.

::

    w1 ---- w2 .            w0 = 0, w1 = h v0 / 5, w2 = w1 + (h v0 / 5 + h^2 a0 / 20)
    /         ` . w3        w5 = d, w4 = d - h v1 / 5, w3 = ...
   w0             w4 w5
"""

from math import sqrt

from ..jit import kernel
from ..kernel_types import BallRecord, Heights, Vector
from ..mechanics.vector import add, add_scaled, dot, load, store, sub


@kernel
def fit_segment(
    ball: BallRecord,
    way: Vector,
    velocity: tuple[Vector, Vector],
    rate: tuple[Vector, Vector],
    spin_rate: tuple[Vector, Vector],
) -> None:
    """Fit the segment's Hermite curves. Writes position_coefficients, spin_coefficients.

    `way` is the displacement over ``ball['span']``; `velocity`, `rate` (acceleration) and
    `spin_rate` are pairs (at the start, at the end); the spin at the start is the ball's own, that
    at the end stands in the fourth coefficient already.
    """
    h = ball['span']
    w = ball['position_coefficients']
    w1 = add_scaled((0.0, 0.0, 0.0), h / 5.0, velocity[0])
    w4 = add_scaled(way, -h / 5.0, velocity[1])
    store(w[0], (0.0, 0.0, 0.0))
    store(w[1], w1)
    store(w[2], add_scaled(add_scaled(w1, h / 5.0, velocity[0]), h * h / 20.0, rate[0]))
    store(w[3], add_scaled(add_scaled(w4, -h / 5.0, velocity[1]), h * h / 20.0, rate[1]))
    store(w[4], w4)
    store(w[5], way)
    s = ball['spin_coefficients']
    store(s[0], load(ball['spin']))
    store(s[1], add_scaled(load(ball['spin']), h / 3.0, spin_rate[0]))
    store(s[2], add_scaled(load(s[3]), -h / 3.0, spin_rate[1]))


@kernel
def position(ball: BallRecord, time: float) -> Vector:
    """Position `time` after the start of the segment."""
    t = time / ball['span']
    s = 1.0 - t
    w = ball['position_coefficients']
    b1 = 5.0 * s * s * s * s * t
    b2 = 10.0 * s * s * s * t * t
    b3 = 10.0 * s * s * t * t * t
    b4 = 5.0 * s * t * t * t * t
    b5 = t * t * t * t * t
    o = ball['origin']
    return (
        o[0] + (b1 * w[1, 0] + b2 * w[2, 0] + b3 * w[3, 0] + b4 * w[4, 0] + b5 * w[5, 0]),
        o[1] + (b1 * w[1, 1] + b2 * w[2, 1] + b3 * w[3, 1] + b4 * w[4, 1] + b5 * w[5, 1]),
        o[2] + (b1 * w[1, 2] + b2 * w[2, 2] + b3 * w[3, 2] + b4 * w[4, 2] + b5 * w[5, 2]),
    )


@kernel
def velocity(ball: BallRecord, time: float) -> Vector:
    """Velocity `time` after the start of the segment."""
    t = time / ball['span']
    s = 1.0 - t
    w = ball['position_coefficients']
    k = 5.0 / ball['span']
    c0 = k * s * s * s * s
    c1 = k * 4.0 * s * s * s * t
    c2 = k * 6.0 * s * s * t * t
    c3 = k * 4.0 * s * t * t * t
    c4 = k * t * t * t * t
    return (
        c0 * w[1, 0]
        + c1 * (w[2, 0] - w[1, 0])
        + c2 * (w[3, 0] - w[2, 0])
        + c3 * (w[4, 0] - w[3, 0])
        + c4 * (w[5, 0] - w[4, 0]),
        c0 * w[1, 1]
        + c1 * (w[2, 1] - w[1, 1])
        + c2 * (w[3, 1] - w[2, 1])
        + c3 * (w[4, 1] - w[3, 1])
        + c4 * (w[5, 1] - w[4, 1]),
        c0 * w[1, 2]
        + c1 * (w[2, 2] - w[1, 2])
        + c2 * (w[3, 2] - w[2, 2])
        + c3 * (w[4, 2] - w[3, 2])
        + c4 * (w[5, 2] - w[4, 2]),
    )


@kernel
def spin(ball: BallRecord, time: float) -> Vector:
    """Spin `time` after the start of the segment."""
    t = time / ball['span']
    s = 1.0 - t
    w = ball['spin_coefficients']
    b0 = s * s * s
    b1 = 3.0 * s * s * t
    b2 = 3.0 * s * t * t
    b3 = t * t * t
    return (
        b0 * w[0, 0] + b1 * w[1, 0] + b2 * w[2, 0] + b3 * w[3, 0],
        b0 * w[0, 1] + b1 * w[1, 1] + b2 * w[2, 1] + b3 * w[3, 1],
        b0 * w[0, 2] + b1 * w[1, 2] + b2 * w[2, 2] + b3 * w[3, 2],
    )


@kernel
def acceleration_coefficient(ball: BallRecord, i: int) -> Vector:
    """Bernstein coefficient `i` (0 to 3) of the segment's acceleration."""
    w = ball['position_coefficients']
    k = 20.0 / (ball['span'] * ball['span'])
    second = sub(sub(load(w[i + 2]), load(w[i + 1])), sub(load(w[i + 1]), load(w[i])))
    return k * second[0], k * second[1], k * second[2]


@kernel
def greatest_acceleration(ball: BallRecord) -> float:
    """Upper bound on the magnitude of the acceleration over the segment."""
    most = 0.0
    for i in range(4):
        a = acceleration_coefficient(ball, i)
        most = max(most, dot(a, a))
    return sqrt(most)


@kernel
def greatest_speed(ball: BallRecord) -> float:
    """Upper bound on the speed over the segment."""
    w = ball['position_coefficients']
    most = 0.0
    for i in range(5):
        step = sub(load(w[i + 1]), load(w[i]))
        most = max(most, dot(step, step))
    return 5.0 / ball['span'] * sqrt(most)


@kernel
def least_acceleration(ball: BallRecord, direction: Vector) -> float:
    """Lower bound on the acceleration along `direction` over the segment."""
    least = dot(acceleration_coefficient(ball, 0), direction)
    for i in range(1, 4):
        least = min(least, dot(acceleration_coefficient(ball, i), direction))
    return least


@kernel
def extent_along(ball: BallRecord, axis: int) -> tuple[float, float]:
    """Bounds on the segment's coordinate along `axis`, least and greatest."""
    low = 0.0
    high = 0.0
    w = ball['position_coefficients']
    for i in range(1, 6):
        low = min(low, w[i, axis])
        high = max(high, w[i, axis])
    return ball['origin'][axis] + low, ball['origin'][axis] + high


@kernel
def plane_gap_coefficients(ball: BallRecord, normal: Vector, first: float) -> Heights:
    """Bernstein coefficients of the segment's height over a plane of `normal`.

    It is `first` at its start.
    """
    w = ball['position_coefficients']
    return (
        first,
        first + dot(load(w[1]), normal),
        first + dot(load(w[2]), normal),
        first + dot(load(w[3]), normal),
        first + dot(load(w[4]), normal),
        first + dot(load(w[5]), normal),
    )


@kernel
def plane_gap(g: Heights, span: float, time: float) -> tuple[float, float]:
    """Height of Bernstein coefficients `g`, and its rate, on a segment of `span`.

    At `time` after its start.
    """
    t = time / span
    s = 1.0 - t
    ss = s * s
    tt = t * t
    k = 5.0 / span
    return (
        ss * ss * (s * g[0] + 5.0 * t * g[1])
        + 10.0 * ss * tt * (s * g[2] + t * g[3])
        + tt * tt * (5.0 * s * g[4] + t * g[5]),
        k
        * (
            ss * ss * (g[1] - g[0])
            + 4.0 * s * t * (ss * (g[2] - g[1]) + tt * (g[4] - g[3]))
            + 6.0 * ss * tt * (g[3] - g[2])
            + tt * tt * (g[5] - g[4])
        ),
    )


@kernel
def acceleration_bounds(g: Heights, span: float) -> tuple[float, float]:
    """Bounds on how fast the rate of a height with coefficients `g` falls, and rises.

    Over a segment of `span`.
    """
    a = g[2] - 2.0 * g[1] + g[0]
    b = g[3] - 2.0 * g[2] + g[1]
    c = g[4] - 2.0 * g[3] + g[2]
    d = g[5] - 2.0 * g[4] + g[3]
    k = 20.0 / (span * span)
    return max(0.0, -k * min(a, b, c, d)), max(0.0, k * max(a, b, c, d))


@kernel
def stay_in_place(ball: BallRecord) -> None:
    """Plan a segment at rest, with the ball's spin. Writes curve."""
    ball['span'] = 1.0
    store(ball['origin'], load(ball['position']))
    ball['position_coefficients'][:, :] = 0.0
    for i in range(4):
        store(ball['spin_coefficients'][i], load(ball['spin']))


@kernel
def control_point(ball: BallRecord, i: int) -> Vector:
    """Control point `i` of the segment, in the course frame."""
    return add(load(ball['origin']), load(ball['position_coefficients'][i]))
