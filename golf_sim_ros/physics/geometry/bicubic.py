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

from math import floor

import numpy as np

from ..jit import kernel
from ..kernel_types import StructRecord, SurfacePoint, Vector

# Rows of cells that are bounded at once: on a map of 1000 x 1000 those take some 50 MB.
AT_ONCE = 64

GRID = np.dtype(
    [
        ('origin', 'f8', 2),
        ('spacing', 'f8'),
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
def hermite(start: float, slope: float, end: float, end_slope: float, t: float) -> Vector:
    """Value, first and second derivative at `t` of a cubic Hermite curve over 0 to 1."""
    rise = end - start
    c2 = 3.0 * rise - 2.0 * slope - end_slope
    c3 = slope + end_slope - 2.0 * rise
    return (
        start + t * (slope + t * (c2 + t * c3)),
        slope + t * (2.0 * c2 + 3.0 * t * c3),
        2.0 * c2 + 6.0 * t * c3,
    )


@kernel
def cell_at(grid: StructRecord, x: float, y: float) -> tuple[int, int]:
    """Column and row of the cell at `x`, `y` [m] from the grid's origin, or of the nearest one."""
    column = min(max(int(floor(x / grid['spacing'])), 0), grid['nx'] - 1)
    row = min(max(int(floor(y / grid['spacing'])), 0), grid['ny'] - 1)
    return column, row


@kernel
def bicubic(table: np.ndarray, grid: StructRecord, x: float, y: float) -> SurfacePoint:
    """Height at `x`, `y` [m] from the grid's origin, its derivatives by x, y, xx, xy and yy."""
    size = grid['spacing']
    column, row = cell_at(grid, x, y)
    u = x / size - column
    v = y / size - row
    k = grid['first_node'] + row * (grid['nx'] + 1) + column
    a = table[k]
    b = table[k + 1]
    c = table[k + grid['nx'] + 1]
    d = table[k + grid['nx'] + 2]
    low = hermite(a[0], a[1], b[0], b[1], u)
    high = hermite(c[0], c[1], d[0], d[1], u)
    rise = hermite(a[2], a[3], b[2], b[3], u)
    rise_high = hermite(c[2], c[3], d[2], d[3], u)
    z, zy, zyy = hermite(low[0], rise[0], high[0], rise_high[0], v)
    zx, zxy, _ = hermite(low[1], rise[1], high[1], rise_high[1], v)
    zxx, _, _ = hermite(low[2], rise[2], high[2], rise_high[2], v)
    return z, zx / size, zy / size, zxx / (size * size), zxy / (size * size), zyy / (size * size)
