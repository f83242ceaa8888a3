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

"""Bicubic spline through heights on a grid, in Hermite form cell by cell.

Its second derivatives are continuous, unlike those of a bicubic of local slopes: curvature decides
the normal force on a rolling ball, so integrators keep their order across the seams of cells.
Boundary conditions are natural (no curvature across the outline). Heights of a tilted plane give
that plane.
"""

import numpy as np

from ..jit import kernel
from ..kernel_types import HigherDerivatives, StructRecord, SurfacePoint

# Rows of cells that are bounded at once: on a map of 1000 x 1000 those take some 50 MB.
AT_ONCE = 64
SIXTH = 1.0 / 6.0

GRID = np.dtype(
    [
        ('origin', 'f8', 2),
        ('spacing', 'f8'),
        ('per_metre', 'f8'),
        ('nx', 'i8'),
        ('ny', 'i8'),
        ('first_node', 'i8'),
        ('first_cell', 'i8'),
        ('first_wall', 'i8'),
        ('number', 'i8'),
        ('material', 'i8'),
        ('gentle', 'i8'),
        ('high', 'f8'),
        ('hollow', 'f8'),
        ('steep', 'f8'),
        ('bend', 'f8'),
    ],
    align=True,
)


def slopes(values: np.ndarray) -> np.ndarray:
    """Slopes, per grid step, of the natural cubic splines through the columns of `values`.

    They solve s[i-1] + 4 s[i] + s[i+1] = 3 (y[i+1] - y[i-1]), at the ends
    2 s[0] + s[1] = 3 (y[1] - y[0]): a tridiagonal system, by Thomas's algorithm.
    """
    n = len(values)
    rise = np.diff(values, axis=0)
    right = 3.0 * np.concatenate((rise[:1], rise[1:] + rise[:-1], rise[-1:]))
    diagonal = np.full(n, 4.0)
    diagonal[0] = diagonal[-1] = 2.0
    for i in range(1, n):
        right[i] -= right[i - 1] / diagonal[i - 1]
        diagonal[i] -= 1.0 / diagonal[i - 1]
    right[-1] /= diagonal[-1]
    for i in range(n - 2, -1, -1):
        right[i] = (right[i] - right[i + 1]) / diagonal[i]
    return right


def nodes(heights: np.ndarray) -> np.ndarray:
    """Node values, (ny, nx, 4): heights and derivatives by x, by y and by both, per grid step."""
    by_x = slopes(heights.T).T
    return np.stack((heights, by_x, slopes(heights), slopes(by_x)), -1)


def bounds(at_nodes: np.ndarray, spacing: float) -> np.ndarray:
    """Bounds on height [m] and curvature [1/m] over every cell: (ny - 1, nx - 1, 4).

    In order: least height, greatest height, greatest upward curvature (0 where there is none),
    greatest curvature of either sign. They are rigorous: those of Bernstein coefficients.
    """
    return np.concatenate(
        [
            _bounds(at_nodes[first:][: AT_ONCE + 1], spacing)
            for first in range(0, len(at_nodes) - 1, AT_ONCE)
        ]
    )


def _net(at: np.ndarray) -> np.ndarray:
    # Bezier's ordinates along x of heights and of slopes along y, then both along y:
    # (4, 4, ny - 1, nx - 1).
    def along_x(value: np.ndarray, slope: np.ndarray) -> np.ndarray:
        left, right = np.s_[:, :-1], np.s_[:, 1:]
        third = slope / 3
        return np.stack(
            (value[left], value[left] + third[left], value[right] - third[right], value[right])
        )

    heights, slopes_up = along_x(at[..., 0], at[..., 1]), along_x(at[..., 2], at[..., 3]) / 3
    low, high = heights[:, :-1], heights[:, 1:]
    rise, fall = slopes_up[:, :-1], slopes_up[:, 1:]
    return np.stack((low, low + rise, high - fall, high))


def _bounds(at: np.ndarray, spacing: float) -> np.ndarray:
    points = _net(at)
    area = spacing * spacing
    xx = 6 * np.diff(points, 2, axis=1) / area
    yy = 6 * np.diff(points, 2, axis=0) / area
    xy = np.abs(9 * np.diff(np.diff(points, axis=1), axis=0) / area).max((0, 1))
    up = _greatest(xx.max((0, 1)), yy.max((0, 1)), xy)
    down = _greatest(-xx.min((0, 1)), -yy.min((0, 1)), xy)
    return np.stack(
        (points.min((0, 1)), points.max((0, 1)), np.maximum(up, 0), np.maximum(up, down)), -1
    )


def steepest(at_nodes: np.ndarray, spacing: float) -> float:
    """Bound on the slope over a whole map."""
    return max(
        float(np.hypot(*(np.abs(np.diff(net, axis=axis)).max() for axis in (0, 1))))
        for net in (
            _net(at_nodes[first:][: AT_ONCE + 1]) for first in range(0, len(at_nodes) - 1, AT_ONCE)
        )
    ) * (3.0 / spacing)


def _greatest(xx: np.ndarray, yy: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Greatest eigenvalue of a symmetric matrix.

    It grows with each entry, so bounds give a bound.
    """
    return 0.5 * (xx + yy) + np.sqrt(0.25 * (xx - yy) ** 2 + xy * xy)


@kernel
def hermite(
    start: float, slope: float, end: float, end_slope: float, t: float
) -> tuple[float, float, float, float]:
    """Value and first three derivatives at `t` of a cubic Hermite curve over 0 to 1.

    Terms are grouped so that few wait for others (Estrin's scheme): that is what takes time.
    """
    rise = end - start
    both = slope + end_slope
    c2 = 3.0 * rise - (slope + both)
    c3 = both - 2.0 * rise
    square = t * t
    return (
        (start + t * slope) + square * (c2 + t * c3),
        (slope + 2.0 * t * c2) + 3.0 * square * c3,
        2.0 * c2 + 6.0 * t * c3,
        6.0 * c3,
    )


@kernel
def cell_along(place: float, count: int) -> int:
    """Which of `count` cells along an axis is at `place`, in steps of the grid, or nearest."""
    return int(min(place, count - 1.0)) if place > 0.0 else 0


@kernel
def cell_at(grid: StructRecord, x: float, y: float) -> tuple[int, int]:
    """Column and row of the cell at `x`, `y` [m] from the grid's origin, or of the nearest one."""
    per = grid['per_metre']
    return cell_along(x * per, grid['nx']), cell_along(y * per, grid['ny'])


@kernel
def bicubic(table: np.ndarray, grid: StructRecord, x: float, y: float) -> SurfacePoint:
    """Height at `x`, `y` [m] from the grid's origin, its derivatives by x, y, xx, xy and yy."""
    at, _ = jet(table, grid, x, y)
    return at


@kernel
def jet(
    table: np.ndarray, grid: StructRecord, x: float, y: float
) -> tuple[SurfacePoint, HigherDerivatives]:
    """`bicubic` at `x`, `y`, and the derivatives of third and fourth order that it has there.

    By xxx, xxy, xyy, yyy, xxxy, xxyy and xyyy: those of the cell at `x`, `y`, for they jump
    between cells.
    """
    per = grid['per_metre']
    column, row = cell_at(grid, x, y)
    u = x * per - column
    v = y * per - row
    k = grid['first_node'] + row * (grid['nx'] + 1) + column
    a = table[k]
    b = table[k + 1]
    c = table[k + grid['nx'] + 1]
    d = table[k + grid['nx'] + 2]
    low = hermite(a[0], a[1], b[0], b[1], u)
    high = hermite(c[0], c[1], d[0], d[1], u)
    rise = hermite(a[2], a[3], b[2], b[3], u)
    rise_high = hermite(c[2], c[3], d[2], d[3], u)
    z, zy, zyy, zyyy = hermite(low[0], rise[0], high[0], rise_high[0], v)
    zx, zxy, zxyy, zxyyy = hermite(low[1], rise[1], high[1], rise_high[1], v)
    zxx, zxxy, zxxyy, _ = hermite(low[2], rise[2], high[2], rise_high[2], v)
    zxxx, zxxxy, _, _ = hermite(low[3], rise[3], high[3], rise_high[3], v)
    area = per * per
    third = area * per
    fourth = area * area
    return (
        (z, zx * per, zy * per, zxx * area, zxy * area, zyy * area),
        (
            zxxx * third,
            zxxy * third,
            zxyy * third,
            zyyy * third,
            zxxxy * fourth,
            zxxyy * fourth,
            zxyyy * fourth,
        ),
    )


@kernel
def in_cell(at: SurfacePoint, higher: HigherDerivatives, dx: float, dy: float) -> SurfacePoint:
    """`bicubic` a little further in the cell of a `jet`, by Taylor's formula to fourth order.

    It has two terms more, of fifth and sixth order.
    """
    z, zx, zy, zxx, zxy, zyy = at
    zxxx, zxxy, zxyy, zyyy, zxxxy, zxxyy, zxyyy = higher
    xx = dx * dx
    xy = dx * dy
    yy = dy * dy
    cross = zxxxy * xx, zxxyy * xy, zxyyy * yy
    return (
        z
        + (zx * dx + zy * dy)
        + 0.5 * (zxx * xx + 2.0 * zxy * xy + zyy * yy)
        + ((zxxx * dx + 3.0 * zxxy * dy) * xx + (3.0 * zxyy * dx + zyyy * dy) * yy) * SIXTH
        + xy * (SIXTH * cross[0] + 0.25 * cross[1] + SIXTH * cross[2]),
        zx
        + (zxx * dx + zxy * dy)
        + 0.5 * (zxxx * xx + 2.0 * zxxy * xy + zxyy * yy)
        + dy * (0.5 * (cross[0] + cross[1]) + SIXTH * cross[2]),
        zy
        + (zxy * dx + zyy * dy)
        + 0.5 * (zxxy * xx + 2.0 * zxyy * xy + zyyy * yy)
        + dx * (SIXTH * cross[0] + 0.5 * (cross[1] + cross[2])),
        zxx + (zxxx * dx + zxxy * dy) + zxxxy * xy + 0.5 * zxxyy * yy,
        zxy + (zxxy * dx + zxyy * dy) + 0.5 * cross[0] + cross[1] + 0.5 * cross[2],
        zyy + (zxyy * dx + zyyy * dy) + 0.5 * zxxyy * xx + zxyyy * xy,
    )
