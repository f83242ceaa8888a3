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

"""Turbulence closure: one equation for the kinetic energy k, a mixing length from the height.

nu_t = Cmu^(1/4) l sqrt(k), dissipation Cmu^(3/4) k^(3/2) / l, l = kappa (z + z0), shortened in
foliage. Cmu is that of the neutral surface layer, where k = 5.48 u*^2 (Panofsky and Dutton,
"Atmospheric Turbulence", 1984). In foliage: Finnigan, Annu. Rev. Fluid Mech. 32 (2000) 519-571,
and Sanz, Boundary-Layer Meteorol. 108 (2003) 189-197.

The length at a face across zeta is the logarithmic mean of the heights beside it. So the
logarithmic profile over level ground is a solution of the discrete equations, too.
"""

from math import log, sqrt
from typing import NamedTuple

import numpy as np

from .compiled import inner, kernel
from .grid import Grid, Metric
from .pressure_solver import Velocity

Column = tuple[
    int, int, np.ndarray
]  # its place in plan, and the shear that makes turbulence there

KAPPA = 0.41  # von Karman's constant
CMU = 0.0333
IN_FOLIAGE = 2.0 * 0.3 * 0.3 * 0.3  # mixing length in foliage times its Cd a: 2 (u*/U_h)^3
THIN = 1e-3  # 1/m: foliage of less Cd a shortens no mixing length
FED, SPENT = 1.0, 4.0  # shares of Cd a |U|^3 that foliage makes into k, and of Cd a |U| k it takes


class Closure(NamedTuple):
    """State of the closure.

    ``length``: mixing length at faces across zeta; ``wall``: friction velocity over the speed in
    the lowest cell; ``friction``: friction velocity [m/s]; ``levels``, ``cells``: eddy viscosity
    [m^2/s]; ``made``: production of k [m^2/s^3]; ``inverse``: 1 / l in cells.
    """

    length: np.ndarray
    wall: np.ndarray
    wall_length: np.ndarray
    friction: np.ndarray
    levels: np.ndarray
    cells: np.ndarray
    made: np.ndarray
    inverse: np.ndarray


def closure_of(grid: Grid, roughness: np.ndarray, foliage: np.ndarray) -> Closure:
    """`Closure` over ground of that `roughness` (nx, ny), with Cd a (nx, ny, nz) of `foliage`."""
    nx, ny, nz = grid.shape
    j = grid.metric.j[:, :, None]
    above = grid.top + 0.5 * grid.metric.dzf[-1]
    heights = j * np.concatenate([grid.zc, [above]]) + roughness[:, :, None]
    length = np.empty((nx, ny, nz + 1))
    length[:, :, 0] = 1.0  # at the ground nothing is mixed: there the wall law holds
    length[:, :, 1:] = KAPPA * np.diff(heights, axis=2) / np.diff(np.log(heights), axis=2)
    dense = np.zeros((nx, ny, nz + 1))
    dense[:, :, 1:-1] = np.maximum(foliage[:, :, 1:], foliage[:, :, :-1])
    dense[:, :, 0], dense[:, :, -1] = foliage[:, :, 0], foliage[:, :, -1]
    length = np.minimum(
        length, np.where(dense > THIN, IN_FOLIAGE / np.maximum(dense, THIN), np.inf)
    )
    first = j[:, :, 0] * grid.zc[0]
    zeros = [np.zeros(s) for s in ((nx, ny), (nx, ny, nz + 1), *3 * [(nx, ny, nz)])]
    return Closure(
        length, KAPPA / np.log(1.0 + first / roughness), KAPPA * (0.5 * first + roughness), *zeros
    )


@kernel
def close(velocity: Velocity, k: np.ndarray, m: Metric, closure: Closure) -> None:
    """Viscosities, production of `k` and 1 / l for a `velocity`. Writes closure."""
    nx, ny, nz = k.shape
    shear = np.empty(nz + 1)
    for i in range(nx):
        for j in range(ny):
            at_ground(velocity, m, closure, i, j)
            at_levels(velocity, k, m, closure, (i, j, shear))
            in_cells(velocity, k, m, closure, (i, j, shear))


@inner
def at_ground(velocity: Velocity, m: Metric, closure: Closure, i: int, j: int) -> None:
    """Friction velocity, by the wall law, under one place. Writes friction."""
    u = 0.5 * (velocity.u[i, j, 0] + velocity.u[i + 1, j, 0])
    v = 0.5 * (velocity.v[i, j, 0] + velocity.v[i, j + 1, 0])
    w = u * m.sx[i, j] + v * m.sy[i, j]
    closure.friction[i, j] = closure.wall[i, j] * sqrt(u * u + v * v + w * w)


@inner
def at_levels(
    velocity: Velocity, k: np.ndarray, m: Metric, closure: Closure, column: Column
) -> None:
    """Viscosity and production by vertical shear at a column's faces. Writes levels, shear."""
    i, j, made = column
    u, v, _ = velocity
    nz = k.shape[2]
    root = CMU**0.25
    friction = closure.friction[i, j]
    made[0] = friction * friction * friction / closure.wall_length[i, j]
    closure.levels[i, j, 0] = 0.0
    for n in range(1, nz):
        step = 0.5 / (m.j[i, j] * m.dzf[n])
        uz = step * (u[i, j, n] + u[i + 1, j, n] - u[i, j, n - 1] - u[i + 1, j, n - 1])
        vz = step * (v[i, j, n] + v[i, j + 1, n] - v[i, j, n - 1] - v[i, j + 1, n - 1])
        energy = 0.5 * (k[i, j, n] + k[i, j, n - 1])
        closure.levels[i, j, n] = root * closure.length[i, j, n] * sqrt(energy)
        made[n] = closure.levels[i, j, n] * (uz * uz + vz * vz)
    closure.levels[i, j, nz] = root * closure.length[i, j, nz] * sqrt(k[i, j, nz - 1])
    made[nz] = made[nz - 1] * closure.length[i, j, nz - 1] / closure.length[i, j, nz]


@inner
def in_cells(
    velocity: Velocity, k: np.ndarray, m: Metric, closure: Closure, column: Column
) -> None:
    """Viscosity, production and 1 / l in the cells of a column. Writes cells, made, inverse."""
    i, j, shear = column
    nz = k.shape[2]
    root = CMU**0.25
    for n in range(nz):
        below = closure.length[i, j, n] if n > 0 else closure.wall_length[i, j]
        inverse = 0.5 / below + 0.5 / closure.length[i, j, n + 1]
        closure.inverse[i, j, n] = inverse
        closure.cells[i, j, n] = root * sqrt(k[i, j, n]) / inverse
        other = closure.cells[i, j, n] * other_shear(velocity, m, i, j, n)
        closure.made[i, j, n] = max(0.5 * (shear[n] + shear[n + 1]) + other, 0.0)


@inner
def other_shear(velocity: Velocity, m: Metric, i: int, j: int, n: int) -> float:
    """Square of the rate of strain, 2 S : S, without the vertical shear of u and v."""
    u, v, w = velocity
    nx, ny = m.j.shape
    nz = m.dz.size
    left, right = max(i - 1, 0), min(i + 1, nx - 1)
    near, far = max(j - 1, 0), min(j + 1, ny - 1)
    down, up = max(n - 1, 0), min(n + 1, nz - 1)
    fade = 0.5 * (m.fade[n] + m.fade[n + 1])
    slope_x = m.sx[i, j] * fade
    slope_y = m.sy[i, j] * fade
    height = m.j[i, j] * (m.zc[up] - m.zc[down])
    uz = 0.5 * (u[i, j, up] + u[i + 1, j, up] - u[i, j, down] - u[i + 1, j, down]) / height
    vz = 0.5 * (v[i, j, up] + v[i, j + 1, up] - v[i, j, down] - v[i, j + 1, down]) / height
    wz = (w[i, j, n + 1] - w[i, j, n]) / (m.j[i, j] * m.dz[n])
    ux = (u[i + 1, j, n] - u[i, j, n]) / m.dx[i] - slope_x * uz
    vy = (v[i, j + 1, n] - v[i, j, n]) / m.dy[j] - slope_y * vz
    along_x = distance(m.dxf, left, right)
    along_y = distance(m.dyf, near, far)
    uy = 0.5 * (u[i, far, n] + u[i + 1, far, n] - u[i, near, n] - u[i + 1, near, n]) / along_y
    vx = 0.5 * (v[right, j, n] + v[right, j + 1, n] - v[left, j, n] - v[left, j + 1, n]) / along_x
    wx = 0.5 * (w[right, j, n] + w[right, j, n + 1] - w[left, j, n] - w[left, j, n + 1]) / along_x
    wy = 0.5 * (w[i, far, n] + w[i, far, n + 1] - w[i, near, n] - w[i, near, n + 1]) / along_y
    across = uy - slope_y * uz + vx - slope_x * vz
    wx -= slope_x * wz
    wy -= slope_y * wz
    return (
        2.0 * (ux * ux + vy * vy + wz * wz)
        + across * across
        + wx * (2.0 * uz + wx)
        + wy * (2.0 * vz + wy)
    )


@inner
def distance(between: np.ndarray, first: int, last: int) -> float:
    """Distance of the centres of two cells, 1 of a cell from itself."""
    total = 0.0
    for n in range(first, last):
        total += between[n + 1]
    return total if last > first else 1.0


def equilibrium_energy(friction: float) -> float:
    """Kinetic energy k [m^2/s^2] of the logarithmic profile of a `friction` velocity [m/s]."""
    return friction * friction / sqrt(CMU)


def friction_velocity(speed: float, height: float, roughness: float) -> float:
    """Friction velocity [m/s] of a logarithmic profile of `speed` [m/s] at a `height` [m]."""
    return KAPPA * speed / log(1.0 + height / roughness)
