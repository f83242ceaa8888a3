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

"""Projection of a velocity field onto those without divergence, the pressure solver.

The gradient is the exact adjoint of the divergence, so the operator is symmetric: conjugate
gradients, preconditioned by the operator of level ground, which is solved directly: along x and y
by its eigenvectors (fast diagonalisation, Lynch, Rice and Thomas, Numer. Math. 6 (1964) 185-199),
along zeta by elimination.
"""

from typing import NamedTuple

import numpy as np

from .compiled import inner, kernel
from .grid import Grid, Metric

TILE = 512  # numbers of a row that stay in the processor's cache


class Velocity(NamedTuple):
    """Velocity on the faces.

    ``u`` (nx + 1, ny, nz), ``v`` (nx, ny + 1, nz), ``w`` (nx, ny, nz + 1).
    """

    u: np.ndarray
    v: np.ndarray
    w: np.ndarray

    @classmethod
    def zeros(cls, shape: tuple[int, ...]) -> 'Velocity':
        """Still air on a grid of `shape` cells."""
        nx, ny, nz = shape
        return cls(
            np.zeros((nx + 1, ny, nz)), np.zeros((nx, ny + 1, nz)), np.zeros((nx, ny, nz + 1))
        )

    def copy(self) -> 'Velocity':
        """Copy that shares no array."""
        return Velocity(*(part.copy() for part in self))


@kernel
def volume_fluxes(velocity: Velocity, m: Metric, out: Velocity) -> None:
    """Volume fluxes [m^3/s] through the faces of cells, towards greater x, y, zeta. Writes out."""
    u, v, w = velocity
    nx, ny, nz = v.shape[0], u.shape[1], u.shape[2]
    for i in range(nx + 1):
        for j in range(ny):
            area = m.dy[j] * m.jx[i, j]
            for k in range(nz):
                out.u[i, j, k] = area * m.dz[k] * u[i, j, k]
    for i in range(nx):
        for j in range(ny + 1):
            area = m.dx[i] * m.jy[i, j]
            for k in range(nz):
                out.v[i, j, k] = area * m.dz[k] * v[i, j, k]
    for i in range(nx):
        for j in range(ny):
            flux_up(velocity, m, out.w, i, j)


@inner
def flux_up(velocity: Velocity, m: Metric, out: np.ndarray, i: int, j: int) -> None:
    """Volume fluxes through the faces across zeta of a column: none at ground and top.

    Writes out.
    """
    u, v, w = velocity
    nz = u.shape[2]
    area = m.dx[i] * m.dy[j]
    p = 0.25 * m.sx[i, j]
    q = 0.25 * m.sy[i, j]
    out[i, j, 0] = 0.0
    out[i, j, nz] = 0.0
    for k in range(1, nz):
        along_x = u[i, j, k - 1] + u[i, j, k] + u[i + 1, j, k - 1] + u[i + 1, j, k]
        along_y = v[i, j, k - 1] + v[i, j, k] + v[i, j + 1, k - 1] + v[i, j + 1, k]
        out[i, j, k] = area * (w[i, j, k] - m.fade[k] * (p * along_x + q * along_y))


@kernel
def net_outflow(flux: Velocity, out: np.ndarray) -> None:
    """Volume [m^3/s] that leaves each cell. Writes out."""
    nx, ny, nz = out.shape
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                out[i, j, k] = (
                    flux.u[i + 1, j, k]
                    - flux.u[i, j, k]
                    + flux.v[i, j + 1, k]
                    - flux.v[i, j, k]
                    + flux.w[i, j, k + 1]
                    - flux.w[i, j, k]
                )


@kernel
def gradient(p: np.ndarray, m: Metric, out: Velocity) -> None:
    """Minus the gradient of `p` on inner faces: the adjoint of `net_outflow` over their volumes.

    Writes out.
    """
    nx, ny, nz = p.shape
    for i in range(1, nx):
        for j in range(ny):
            scale = 0.25 / (m.jx[i, j] * m.dxf[i])
            left = m.dx[i - 1] * m.sx[i - 1, j]
            right = m.dx[i] * m.sx[i, j]
            for k in range(nz):
                slanted = 0.0
                if k > 0:
                    slanted += m.fade[k] * (
                        left * (p[i - 1, j, k - 1] - p[i - 1, j, k])
                        + right * (p[i, j, k - 1] - p[i, j, k])
                    )
                if k < nz - 1:
                    slanted += m.fade[k + 1] * (
                        left * (p[i - 1, j, k] - p[i - 1, j, k + 1])
                        + right * (p[i, j, k] - p[i, j, k + 1])
                    )
                out.u[i, j, k] = (p[i - 1, j, k] - p[i, j, k]) / m.dxf[i] - scale * slanted / m.dz[
                    k
                ]
    for i in range(nx):
        for j in range(1, ny):
            gradient_along_y(p, m, out.v, i, j)
    for i in range(nx):
        for j in range(ny):
            for k in range(1, nz):
                out.w[i, j, k] = (p[i, j, k - 1] - p[i, j, k]) / (m.j[i, j] * m.dzf[k])


@inner
def gradient_along_y(p: np.ndarray, m: Metric, out: np.ndarray, i: int, j: int) -> None:
    """`gradient` on the faces across y above one place. Writes out."""
    nz = p.shape[2]
    scale = 0.25 / (m.jy[i, j] * m.dyf[j])
    left = m.dy[j - 1] * m.sy[i, j - 1]
    right = m.dy[j] * m.sy[i, j]
    for k in range(nz):
        slanted = 0.0
        if k > 0:
            slanted += m.fade[k] * (
                left * (p[i, j - 1, k - 1] - p[i, j - 1, k])
                + right * (p[i, j, k - 1] - p[i, j, k])
            )
        if k < nz - 1:
            slanted += m.fade[k + 1] * (
                left * (p[i, j - 1, k] - p[i, j - 1, k + 1])
                + right * (p[i, j, k] - p[i, j, k + 1])
            )
        out[i, j, k] = (p[i, j - 1, k] - p[i, j, k]) / m.dyf[j] - scale * slanted / m.dz[k]


@kernel
def inner_product(a: np.ndarray, b: np.ndarray) -> float:
    """Sum of the products of two fields; BLAS would start threads for that."""
    total = 0.0
    p, q = a.ravel(), b.ravel()
    for n in range(p.size):
        total += p[n] * q[n]
    return total


@inner
def multiply(a: np.ndarray, b: np.ndarray, out: np.ndarray) -> None:
    """Matrix product ``a @ b``: a tile of a row at a time, eight rows of `b` at once.

    Writes out.
    """
    rows, depth = a.shape
    width = b.shape[1]
    whole = depth - depth % 8
    for low in range(0, width, TILE):
        high = min(low + TILE, width)
        for i in range(rows):
            for q in range(low, high):
                out[i, q] = 0.0
            for n in range(0, whole, 8):
                for q in range(low, high):
                    out[i, q] += (
                        a[i, n] * b[n, q]
                        + a[i, n + 1] * b[n + 1, q]
                        + a[i, n + 2] * b[n + 2, q]
                        + a[i, n + 3] * b[n + 3, q]
                        + a[i, n + 4] * b[n + 4, q]
                        + a[i, n + 5] * b[n + 5, q]
                        + a[i, n + 6] * b[n + 6, q]
                        + a[i, n + 7] * b[n + 7, q]
                    )
            for n in range(whole, depth):
                for q in range(low, high):
                    out[i, q] += a[i, n] * b[n, q]


@kernel
def solve_level(r: np.ndarray, modes: 'Modes', out: np.ndarray) -> None:
    """Solve the operator of level ground for the right-hand side `r`. Writes out."""
    nx, ny, nz = r.shape
    other = np.empty((nx, ny, nz))
    multiply(modes.x_transposed, r.reshape(nx, ny * nz), other.reshape(nx, ny * nz))
    for i in range(nx):
        multiply(modes.y_transposed, other[i], out[i])
        for j in range(ny):
            for k in range(nz):
                below = modes.link[k] * out[i, j, k - 1] if k > 0 else 0.0
                out[i, j, k] = (out[i, j, k] + below) * modes.pivot[i, j, k]
            for back in range(1, nz):
                k = nz - 1 - back
                out[i, j, k] += modes.link[k + 1] * modes.pivot[i, j, k] * out[i, j, k + 1]
        multiply(modes.y, out[i], other[i])
    multiply(modes.x, other.reshape(nx, ny * nz), out.reshape(nx, ny * nz))


@kernel
def pivots(eigenvalues: np.ndarray, link: np.ndarray, dz: np.ndarray, out: np.ndarray) -> None:
    """Inverse pivots of the elimination along zeta for each pair of modes. Writes out."""
    nx, ny, nz = out.shape
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                diagonal = eigenvalues[i, j] * dz[k] + link[k] + link[k + 1]
                if i == 0 and j == 0 and k == 0:
                    diagonal += link[1]  # pins the constant, which nothing else does
                if k > 0:
                    diagonal -= link[k] * link[k] * out[i, j, k - 1]
                out[i, j, k] = 1.0 / diagonal


class Modes(NamedTuple):
    """Eigenvectors along ``x`` and ``y``, and the elimination along zeta."""

    x: np.ndarray
    x_transposed: np.ndarray
    y: np.ndarray
    y_transposed: np.ndarray
    link: np.ndarray
    pivot: np.ndarray


def modes_of(grid: Grid) -> Modes:
    """`Modes` of the operator of level ground at the mean height of a `grid`."""
    m = grid.metric
    (x_values, x), (y_values, y) = eigenmodes(m.dx), eigenmodes(m.dy)
    mean = m.j.mean()
    link = np.concatenate([[0.0], 1.0 / (mean * m.dzf[1:-1]), [0.0]])
    pivot = np.empty(grid.shape)
    pivots(mean * (x_values[:, None] + y_values[None, :]), link, m.dz, pivot)
    transposed = (np.ascontiguousarray(q.T) for q in (x, y))
    return Modes(x, next(transposed), y, next(transposed), link, pivot)


def eigenmodes(d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues and eigenvectors of minus the second difference over cells of widths `d`.

    Rising, the first one 0; vectors are columns, orthonormal with the weights `d`.
    """
    n = len(d)
    links = 2.0 / (d[1:] + d[:-1])
    matrix = np.zeros((n, n))
    inner_faces = np.arange(n - 1)
    for here, there in ((inner_faces, inner_faces + 1), (inner_faces + 1, inner_faces)):
        matrix[here, here] += links
        matrix[here, there] -= links
    weight = 1.0 / np.sqrt(d)
    values, vectors = np.linalg.eigh(weight[:, None] * matrix * weight)
    values[0] = 0.0
    return values, np.ascontiguousarray(weight[:, None] * vectors)


class PressureSolver:
    """Projection on a `Grid`."""

    def __init__(self, grid: Grid) -> None:
        self.grid, self.modes = grid, modes_of(grid)
        self.flux, self.slope = Velocity.zeros(grid.shape), Velocity.zeros(grid.shape)
        self.net = np.zeros(grid.shape)
        self.iterations = 0

    def net_outflow(self, velocity: Velocity) -> np.ndarray:
        """Volume [m^3/s] that leaves each cell; overwritten by the next call."""
        volume_fluxes(velocity, self.grid.metric, self.flux)
        net_outflow(self.flux, self.net)
        return self.net

    def gradient(self, p: np.ndarray) -> Velocity:
        """Acceleration by the pressure `p` over density on faces; overwritten by the next call."""
        gradient(p, self.grid.metric, self.slope)
        return self.slope

    def project(self, velocity: Velocity, tolerance: float, most: int) -> np.ndarray:
        """Remove the divergence of `velocity`, in place.

        Parameters
        ----------
        tolerance : float
            What may be left of the greatest divergence.
        most : int
            Iterations.

        Returns
        -------
        ndarray
            The potential whose gradient was added.
        """
        r = self.net_outflow(velocity).copy()
        r -= r.mean()
        greatest = abs(r).max()
        potential, z = np.zeros_like(r), np.empty_like(r)
        along, product = None, 1.0
        self.iterations = 0
        while self.iterations < most and abs(r).max() > tolerance * greatest:
            solve_level(r, self.modes, z)
            product, before = inner_product(r, z), product
            along = z.copy() if along is None else z + (product / before) * along
            moved = self.net_outflow(self.gradient(along))
            share = product / inner_product(along, moved)
            potential += share * along
            r -= share * moved
            self.iterations += 1
        for part, change in zip(velocity, self.gradient(potential)):
            part -= change
        return potential

    def divergence(self, velocity: Velocity) -> float:
        """Greatest divergence over that of one face: |div u| dx / U."""
        net = abs(self.net_outflow(velocity)) / self.grid.volumes[-1]
        m = self.grid.metric
        width = min(m.dx.min(), m.dy.min() if len(m.dy) > 1 else m.dx.min())
        return float(net.max() * width / max(abs(velocity.u).max(), abs(velocity.v).max()))
