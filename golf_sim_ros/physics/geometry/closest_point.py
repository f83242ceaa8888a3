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

"""Closest point of a bicubic surface to a point, within a rectangle in plan.

Newton's method with box constraints on half the squared distance: a coordinate at the rectangle's
border, and driven over it, stays there (active set). Coordinates are metres from the grid's
origin.
"""

import numpy as np

from .bicubic import bicubic, cell_at, in_cell, jet
from ..jit import kernel, shared
from ..kernel_types import HigherDerivatives, Rectangle, StructRecord, SurfacePoint, Vector

MOST_NEWTON_STEPS = 60
CONVERGED_STEP = 1e-13  # of the spacing: shorter steps change nothing
# Of the spacing: shorter steps are taken without line search, whose test would be rounding.
SURE = 1e-6
# Of the spacing: after such a step the next would be rounding, for each errs by the last one's
# square, and so would what Taylor's formula leaves out of the height and the slopes. The second
# derivatives stay as they were: after a longer step a step's error estimate would be noise.
LAST = 1e-8
# Of the spacing: what is so near a look in the same cell tells as well as another look would, to
# 1e-10 of the curvature times the spacing.
CLOSE = 1e-2
START_SAMPLES = 5  # a side, to start from where there may be several local minima
Samples = tuple[float, float, float, float, float]  # of a row of START_SAMPLES
NO_SAMPLES = (1e300, 1e300, 1e300, 1e300, 1e300)


@kernel
def held(x: float, low: float, high: float, pull: float) -> bool:
    """Whether a coordinate is at a bound over which `pull` drives it: active.

    `pull` is the derivative there.
    """
    return x <= low and pull >= 0.0 or x >= high and pull <= 0.0


@kernel
def newton(
    hessian: Vector, gradient: tuple[float, float], fixed_x: bool, fixed_y: bool
) -> tuple[float, float]:
    """Newton step for a gradient, by x and y, and a Hessian, by xx, xy and yy.

    A fixed coordinate stays.
    """
    a, b, c = hessian
    gx, gy = gradient
    if fixed_x and fixed_y:
        return 0.0, 0.0
    if fixed_x:
        return 0.0, -gy / c
    if fixed_y:
        return -gx / a, 0.0
    det = a * c - b * b
    return (b * gy - c * gx) / det, (b * gx - a * gy) / det


@kernel
def share_within(x: float, step: float, low: float, high: float) -> float:
    """Share of `step` from `x` that stays between `low` and `high`."""
    if x + step > high:
        return (high - x) / step
    if x + step < low:
        return (low - x) / step
    return 1.0


@kernel
def half_square(point: Vector, x: float, y: float, z: float) -> float:
    """Half the squared distance of `point` from x, y, z."""
    dx = x - point[0]
    dy = y - point[1]
    dz = z - point[2]
    return 0.5 * (dx * dx + dy * dy + dz * dz)


@kernel
def curvatures(point: Vector, at: SurfacePoint) -> Vector:
    """Hessian of half the squared distance: by xx, xy and yy."""
    z, zx, zy, zxx, zxy, zyy = at
    up = z - point[2]
    return 1.0 + zx * zx + up * zxx, zx * zy + up * zxy, 1.0 + zy * zy + up * zyy


@kernel
def pulls(point: Vector, x: float, y: float, at: SurfacePoint) -> tuple[float, float]:
    """Gradient of half the squared distance, by x and y."""
    up = at[0] - point[2]
    return x - point[0] + up * at[1], y - point[1] + up * at[2]


@shared
def descend(
    table: np.ndarray, grid: StructRecord, box: Rectangle, x: float, y: float, point: Vector
) -> tuple[float, float, SurfacePoint]:
    """Local minimum of the distance from `point`, downhill from `x`, `y`, and `bicubic` there."""
    x0, y0, x1, y1 = box
    size = grid['spacing']
    at, higher = jet(table, grid, x, y)
    for n in range(MOST_NEWTON_STEPS):
        gx, gy = pulls(point, x, y, at)
        fixed_x = held(x, x0, x1, gx)
        fixed_y = held(y, y0, y1, gy)
        a, b, c = curvatures(point, at)
        convex = (
            (fixed_x or a > 0.0)
            and (fixed_y or c > 0.0)
            and (fixed_x or fixed_y or a * c - b * b > 0.01 * a * c)
        )
        if not convex:
            # not positive definite: Gauss-Newton, as if the surface were flat
            a = 1.0 + at[1] * at[1]
            b = at[1] * at[2]
            c = 1.0 + at[2] * at[2]
        dx, dy = newton((a, b, c), (gx, gy), fixed_x, fixed_y)
        if not fixed_x and (x <= x0 and dx < 0.0 or x >= x1 and dx > 0.0):
            dx, dy = newton((a, b, c), (gx, gy), True, fixed_y)
        elif not fixed_y and (y <= y0 and dy < 0.0 or y >= y1 and dy > 0.0):
            dx, dy = newton((a, b, c), (gx, gy), fixed_x, True)
        if abs(dx) + abs(dy) <= CONVERGED_STEP * size:
            break
        share = min(share_within(x, dx, x0, x1), share_within(y, dy, y0, y1))
        if convex and share == 1.0:
            if abs(dx) + abs(dy) < LAST * size:
                return x + dx, y + dy, moved_by(at, dx, dy)
            if n == 0 and is_close(grid, box, (x, y), (dx, dy)):
                return closest_in_cell(point, (x, y), (at, higher), (dx, dy))
        # Backtracking line search with Armijo's condition.
        before = half_square(point, x, y, at[0])
        falling = gx * dx + gy * dy
        for _ in range(30):
            nx = onto(x + share * dx, x0, x1, size)
            ny = onto(y + share * dy, y0, y1, size)
            at = bicubic(table, grid, nx, ny)
            if (
                abs(dx) + abs(dy) < SURE * size
                or half_square(point, nx, ny, at[0]) <= before + 1e-4 * share * falling
            ):
                break
            share *= 0.5
        moved = abs(nx - x) + abs(ny - y)
        x = nx
        y = ny
        if moved == 0.0:
            break
    return x, y, at


@kernel
def is_close(
    grid: StructRecord, box: Rectangle, place: tuple[float, float], step: tuple[float, float]
) -> bool:
    """Whether Newton's `step` from a `place` is short, and twice it stays in cell and `box`."""
    x, y = place
    dx, dy = step
    x0, y0, x1, y1 = box
    far_x = x + 2.0 * dx
    far_y = y + 2.0 * dy
    return (
        abs(dx) + abs(dy) < CLOSE * grid['spacing']
        and x0 < far_x < x1
        and y0 < far_y < y1
        and cell_at(grid, x, y) == cell_at(grid, far_x, far_y)
    )


@kernel
def closest_in_cell(
    point: Vector,
    place: tuple[float, float],
    there: tuple[SurfacePoint, HigherDerivatives],
    step: tuple[float, float],
) -> tuple[float, float, SurfacePoint]:
    """Closest point near a `place` in plan, by the `jet` `there`, and `bicubic` at it.

    ``step``: the first one of Newton's method; the second is taken here.
    """
    x, y = place
    dx, dy = step
    at = in_cell(*there, dx, dy)
    gx, gy = pulls(point, x + dx, y + dy, at)
    more, less = newton(curvatures(point, at), (gx, gy), False, False)
    return x + dx + more, y + dy + less, moved_by(at, more, less)


@kernel
def moved_by(at: SurfacePoint, dx: float, dy: float) -> SurfacePoint:
    """`bicubic` a short way from where it is `at`, by Taylor's formula to second order."""
    z, zx, zy, zxx, zxy, zyy = at
    bent = zxx * dx + zxy * dy, zxy * dx + zyy * dy
    return (
        z + (zx + 0.5 * bent[0]) * dx + (zy + 0.5 * bent[1]) * dy,
        zx + bent[0],
        zy + bent[1],
        zxx,
        zxy,
        zyy,
    )


@kernel
def onto(x: float, low: float, high: float, size: float) -> float:
    """Clamp `x` between `low` and `high`, and snap it to one that is reached but for rounding."""
    if x - low < CONVERGED_STEP * size:
        return low
    if high - x < CONVERGED_STEP * size:
        return high
    return x


@shared
def closest_point(
    table: np.ndarray, grid: StructRecord, box: Rectangle, bend: float, point: Vector
) -> tuple[float, float, SurfacePoint]:
    """Closest point of the surface to `point` in the rectangle `box`, and `bicubic` there.

    Where `bend`, a product of curvature and height, is below 1, the distance has one minimum; else
    it is searched from every sample that is nearer than its neighbours.
    """
    x0, y0, x1, y1 = box
    if bend < 1.0:
        return descend(
            table, grid, box, min(max(point[0], x0), x1), min(max(point[1], y0), y1), point
        )
    best_x = min(max(point[0], x0), x1)
    best_y = min(max(point[1], y0), y1)
    best_x, best_y, best_at = descend(table, grid, box, best_x, best_y, point)
    best = half_square(point, best_x, best_y, best_at[0])
    before = after = NO_SAMPLES
    here = samples(table, grid, box, point, 0)
    for i in range(START_SAMPLES):
        after = samples(table, grid, box, point, i + 1) if i < START_SAMPLES - 1 else NO_SAMPLES
        for j in range(START_SAMPLES):
            if (
                before[j] < here[j]
                or after[j] < here[j]
                or j > 0
                and here[j - 1] < here[j]
                or j < START_SAMPLES - 1
                and here[j + 1] < here[j]
            ):
                continue
            x = x0 + (x1 - x0) * i / (START_SAMPLES - 1.0)
            y = y0 + (y1 - y0) * j / (START_SAMPLES - 1.0)
            x, y, at = descend(table, grid, box, x, y, point)
            far = half_square(point, x, y, at[0])
            if far < best:
                best = far
                best_x = x
                best_y = y
                best_at = at
        before = here
        here = after
    return best_x, best_y, best_at


@shared
def samples(
    table: np.ndarray, grid: StructRecord, box: Rectangle, point: Vector, i: int
) -> Samples:
    """Half the squared distances of `point` from row `i` of the samples, as a tuple."""
    x0, y0, x1, y1 = box
    x = x0 + (x1 - x0) * i / (START_SAMPLES - 1.0)
    y = y1 - y0
    return (
        sample(table, grid, point, x, y0),
        sample(table, grid, point, x, y0 + y * 1 / (START_SAMPLES - 1.0)),
        sample(table, grid, point, x, y0 + y * 2 / (START_SAMPLES - 1.0)),
        sample(table, grid, point, x, y0 + y * 3 / (START_SAMPLES - 1.0)),
        sample(table, grid, point, x, y0 + y * 4 / (START_SAMPLES - 1.0)),
    )


@shared
def sample(table: np.ndarray, grid: StructRecord, point: Vector, x: float, y: float) -> float:
    """Half the squared distance of `point` from the surface at `x`, `y`."""
    return half_square(point, x, y, bicubic(table, grid, x, y)[0])
