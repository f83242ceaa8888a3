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

"""Transport of momentum, and of anything else, by the air: fluxes, and an implicit step in time.

Advection is upwind of third order (QUICK, Leonard, Comput. Methods Appl. Mech. Eng. 19 (1979)
59-98) in its advective form. A step solves for the change along x, y and zeta one after the other,
with upwind differences of first order, so that it may be many cells long.

What is done along x and along y is written out for both: on arrays whose axes are swapped the same
kernel would give the same bits, in 1.6 times the time.
"""

from typing import NamedTuple

import numpy as np

from .compiled import inner, kernel
from .grid import Metric
from .pressure_solver import Velocity

QUICK = 0.125  # curvature that the value at a face is corrected by; 0: central differences


class Faces(NamedTuple):
    """A number for each face of control volumes, across x, y and zeta."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray

    @classmethod
    def zeros(cls, shape: tuple[int, ...]) -> 'Faces':
        """Zeros, for control volumes of `shape`."""
        return cls(*Velocity.zeros(shape))


class Viscosity(NamedTuple):
    """Viscosity [m^2/s] at the centres of cells and at their faces across zeta."""

    cells: np.ndarray
    levels: np.ndarray


class Transport(NamedTuple):
    """What a quantity is carried by: volume ``flux`` and ``conductance`` of faces, and scratch.

    ``padded``: the quantity with two ghosts on each side; ``rate``: its change a second.
    """

    flux: Faces
    conductance: Faces
    padded: np.ndarray
    rate: np.ndarray

    @classmethod
    def of(cls, shape: tuple[int, ...]) -> 'Transport':
        """Scratch for control volumes of `shape`."""
        return cls(
            Faces.zeros(shape),
            Faces.zeros(shape),
            np.zeros(tuple(n + 4 for n in shape)),
            np.zeros(shape),
        )


@kernel
def faces_of_cells(flux: Velocity, viscosity: Viscosity, m: Metric, out: Transport) -> None:
    """Fluxes and conductances of the faces of cells. Writes out."""
    nx, ny = m.j.shape
    nz = m.dz.size
    nu = viscosity.cells
    for i in range(nx + 1):
        a = max(i - 1, 0)
        b = min(i, nx - 1)
        for j in range(ny):
            area = m.dy[j] * m.jx[i, j] / m.dxf[i]
            for k in range(nz):
                out.flux.x[i, j, k] = flux.u[i, j, k]
                out.conductance.x[i, j, k] = 0.5 * (nu[a, j, k] + nu[b, j, k]) * area * m.dz[k]
    for i in range(nx):
        for j in range(ny + 1):
            a = max(j - 1, 0)
            b = min(j, ny - 1)
            area = m.dx[i] * m.jy[i, j] / m.dyf[j]
            for k in range(nz):
                out.flux.y[i, j, k] = flux.v[i, j, k]
                out.conductance.y[i, j, k] = 0.5 * (nu[i, a, k] + nu[i, b, k]) * area * m.dz[k]
    for i in range(nx):
        for j in range(ny):
            steep = m.sx[i, j] * m.sx[i, j] + m.sy[i, j] * m.sy[i, j]
            area = m.dx[i] * m.dy[j] / m.j[i, j]
            for k in range(nz + 1):
                slant = 1.0 + steep * m.fade[k] * m.fade[k]
                out.flux.z[i, j, k] = flux.w[i, j, k]
                out.conductance.z[i, j, k] = viscosity.levels[i, j, k] * slant * area / m.dzf[k]


@kernel
def faces_of_u(flux: Velocity, viscosity: Viscosity, m: Metric, out: Transport) -> None:
    """Fluxes and conductances of the control volumes of u, those inside. Writes out."""
    nx, ny = m.j.shape
    nz = m.dz.size
    nu = viscosity.cells
    for i in range(nx):
        for j in range(ny):
            area = m.dy[j] * m.j[i, j] / m.dx[i]
            for k in range(nz):
                out.flux.x[i, j, k] = 0.5 * (flux.u[i, j, k] + flux.u[i + 1, j, k])
                out.conductance.x[i, j, k] = nu[i, j, k] * area * m.dz[k]
    for i in range(nx - 1):
        for j in range(ny + 1):
            a = max(j - 1, 0)
            b = min(j, ny - 1)
            area = 0.125 * m.dxf[i + 1] * (m.jy[i, j] + m.jy[i + 1, j]) / m.dyf[j]
            for k in range(nz):
                four = nu[i, a, k] + nu[i, b, k] + nu[i + 1, a, k] + nu[i + 1, b, k]
                out.flux.y[i, j, k] = 0.5 * (flux.v[i, j, k] + flux.v[i + 1, j, k])
                out.conductance.y[i, j, k] = four * area * m.dz[k]
        for j in range(ny):
            sx = 0.5 * (m.sx[i, j] + m.sx[i + 1, j])
            sy = 0.5 * (m.sy[i, j] + m.sy[i + 1, j])
            area = 0.5 * m.dxf[i + 1] * m.dy[j] / m.jx[i + 1, j]
            for k in range(nz + 1):
                slant = 1.0 + (sx * sx + sy * sy) * m.fade[k] * m.fade[k]
                two = viscosity.levels[i, j, k] + viscosity.levels[i + 1, j, k]
                out.flux.z[i, j, k] = 0.5 * (flux.w[i, j, k] + flux.w[i + 1, j, k])
                out.conductance.z[i, j, k] = two * slant * area / m.dzf[k]


@kernel
def faces_of_v(flux: Velocity, viscosity: Viscosity, m: Metric, out: Transport) -> None:
    """Fluxes and conductances of the control volumes of v, those inside. Writes out."""
    nx, ny = m.j.shape
    nz = m.dz.size
    nu = viscosity.cells
    for i in range(nx + 1):
        a = max(i - 1, 0)
        b = min(i, nx - 1)
        for j in range(ny - 1):
            area = 0.125 * m.dyf[j + 1] * (m.jx[i, j] + m.jx[i, j + 1]) / m.dxf[i]
            for k in range(nz):
                four = nu[a, j, k] + nu[b, j, k] + nu[a, j + 1, k] + nu[b, j + 1, k]
                out.flux.x[i, j, k] = 0.5 * (flux.u[i, j, k] + flux.u[i, j + 1, k])
                out.conductance.x[i, j, k] = four * area * m.dz[k]
    for i in range(nx):
        for j in range(ny):
            area = m.dx[i] * m.j[i, j] / m.dy[j]
            for k in range(nz):
                out.flux.y[i, j, k] = 0.5 * (flux.v[i, j, k] + flux.v[i, j + 1, k])
                out.conductance.y[i, j, k] = nu[i, j, k] * area * m.dz[k]
        for j in range(ny - 1):
            sx = 0.5 * (m.sx[i, j] + m.sx[i, j + 1])
            sy = 0.5 * (m.sy[i, j] + m.sy[i, j + 1])
            area = 0.5 * m.dx[i] * m.dyf[j + 1] / m.jy[i, j + 1]
            for k in range(nz + 1):
                slant = 1.0 + (sx * sx + sy * sy) * m.fade[k] * m.fade[k]
                two = viscosity.levels[i, j, k] + viscosity.levels[i, j + 1, k]
                out.flux.z[i, j, k] = 0.5 * (flux.w[i, j, k] + flux.w[i, j + 1, k])
                out.conductance.z[i, j, k] = two * slant * area / m.dzf[k]


@kernel
def faces_of_w(flux: Velocity, viscosity: Viscosity, m: Metric, out: Transport) -> None:
    """Fluxes and conductances of the control volumes of w, those inside. Writes out."""
    nx, ny = m.j.shape
    nz = m.dz.size
    nu = viscosity.levels
    for i in range(nx + 1):
        a = max(i - 1, 0)
        b = min(i, nx - 1)
        for j in range(ny):
            area = 0.5 * m.dy[j] * m.jx[i, j] / m.dxf[i]
            for k in range(nz - 1):
                two = nu[a, j, k + 1] + nu[b, j, k + 1]
                out.flux.x[i, j, k] = 0.5 * (flux.u[i, j, k] + flux.u[i, j, k + 1])
                out.conductance.x[i, j, k] = two * area * m.dzf[k + 1]
    for i in range(nx):
        for j in range(ny + 1):
            a = max(j - 1, 0)
            b = min(j, ny - 1)
            area = 0.5 * m.dx[i] * m.jy[i, j] / m.dyf[j]
            for k in range(nz - 1):
                two = nu[i, a, k + 1] + nu[i, b, k + 1]
                out.flux.y[i, j, k] = 0.5 * (flux.v[i, j, k] + flux.v[i, j, k + 1])
                out.conductance.y[i, j, k] = two * area * m.dzf[k + 1]
    for i in range(nx):
        for j in range(ny):
            steep = m.sx[i, j] * m.sx[i, j] + m.sy[i, j] * m.sy[i, j]
            area = m.dx[i] * m.dy[j] / m.j[i, j]
            for k in range(nz):
                slant = 1.0 + steep * m.fade[k] * m.fade[k + 1]
                out.flux.z[i, j, k] = 0.5 * (flux.w[i, j, k] + flux.w[i, j, k + 1])
                out.conductance.z[i, j, k] = viscosity.cells[i, j, k] * slant * area / m.dz[k]


@inner
def gained(
    flux: float,
    conductance: float,
    values: tuple[float, float, float, float],
    curved: float,
    bounded: bool,
) -> float:
    """Return what a control volume gains through a face from the side of a neighbour.

    `flux` goes to the neighbour; `values`: here, the neighbour's, beyond it, and opposite.
    """
    here, beside, beyond, opposite = values
    curvature = beside - 2.0 * here + opposite if flux >= 0.0 else beyond - 2.0 * beside + here
    at_face = 0.5 * (here + beside) - curved * curvature
    if bounded:
        at_face = min(max(at_face, min(here, beside)), max(here, beside))
    return conductance * (beside - here) - flux * (at_face - here)


@kernel
def transport(carried: Transport, curved: float, bounded: bool) -> None:
    """Gain of each control volume by advection and diffusion, in advective form. Writes rate.

    `curved`: `QUICK` or 0; `bounded`: whether values at faces lie between those beside them.
    """
    f = carried.padded
    flux, conductance = carried.flux, carried.conductance
    nx, ny, nz = carried.rate.shape
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                x, y, z = i + 2, j + 2, k + 2
                c = f[x, y, z]
                a, b = f[x - 1, y, z], f[x + 1, y, z]
                total = gained(
                    -flux.x[i, j, k],
                    conductance.x[i, j, k],
                    (c, a, f[x - 2, y, z], b),
                    curved,
                    bounded,
                )
                total += gained(
                    flux.x[i + 1, j, k],
                    conductance.x[i + 1, j, k],
                    (c, b, f[x + 2, y, z], a),
                    curved,
                    bounded,
                )
                a, b = f[x, y - 1, z], f[x, y + 1, z]
                total += gained(
                    -flux.y[i, j, k],
                    conductance.y[i, j, k],
                    (c, a, f[x, y - 2, z], b),
                    curved,
                    bounded,
                )
                total += gained(
                    flux.y[i, j + 1, k],
                    conductance.y[i, j + 1, k],
                    (c, b, f[x, y + 2, z], a),
                    curved,
                    bounded,
                )
                a, b = f[x, y, z - 1], f[x, y, z + 1]
                total += gained(
                    -flux.z[i, j, k],
                    conductance.z[i, j, k],
                    (c, a, f[x, y, z - 2], b),
                    curved,
                    bounded,
                )
                total += gained(
                    flux.z[i, j, k + 1],
                    conductance.z[i, j, k + 1],
                    (c, b, f[x, y, z + 2], a),
                    curved,
                    bounded,
                )
                carried.rate[i, j, k] = total


@kernel
def sweep_x(change: np.ndarray, carried: Transport, time: np.ndarray) -> None:
    """Solve for the `change`, implicit along x; `time`: step over volume [s/m^3].

    Writes change.
    """
    flux, conductance = carried.flux.x, carried.conductance.x
    nx, ny, nz = change.shape
    kept = np.empty((nx, nz))
    for j in range(ny):
        for i in range(nx):
            for k in range(nz):
                t = time[i, j, k]
                low = t * (conductance[i, j, k] + max(flux[i, j, k], 0.0))
                high = t * (conductance[i + 1, j, k] + max(-flux[i + 1, j, k], 0.0))
                before = change[i - 1, j, k] if i > 0 else 0.0
                carried_on = kept[i - 1, k] if i > 0 else 0.0
                pivot = 1.0 / (1.0 + low + high - low * carried_on)
                kept[i, k] = high * pivot
                change[i, j, k] = (change[i, j, k] + low * before) * pivot
        for back in range(1, nx):
            i = nx - 1 - back
            for k in range(nz):
                change[i, j, k] += kept[i, k] * change[i + 1, j, k]


@kernel
def sweep_y(change: np.ndarray, carried: Transport, time: np.ndarray) -> None:
    """`sweep_x`, along y. Writes change."""
    flux, conductance = carried.flux.y, carried.conductance.y
    nx, ny, nz = change.shape
    kept = np.empty((ny, nz))
    for i in range(nx):
        for j in range(ny):
            for k in range(nz):
                t = time[i, j, k]
                low = t * (conductance[i, j, k] + max(flux[i, j, k], 0.0))
                high = t * (conductance[i, j + 1, k] + max(-flux[i, j + 1, k], 0.0))
                before = change[i, j - 1, k] if j > 0 else 0.0
                carried_on = kept[j - 1, k] if j > 0 else 0.0
                pivot = 1.0 / (1.0 + low + high - low * carried_on)
                kept[j, k] = high * pivot
                change[i, j, k] = (change[i, j, k] + low * before) * pivot
        for back in range(1, ny):
            j = ny - 1 - back
            for k in range(nz):
                change[i, j, k] += kept[j, k] * change[i, j + 1, k]


@kernel
def sweep_z(change: np.ndarray, carried: Transport, time: np.ndarray, sink: np.ndarray) -> None:
    """`sweep_x`, along zeta; `sink`: step times the rate at which what is there goes.

    Writes change.
    """
    flux, conductance = carried.flux.z, carried.conductance.z
    nx, ny, nz = change.shape
    kept = np.empty(nz)
    for i in range(nx):
        for j in range(ny):
            before = 0.0
            carried_on = 0.0
            for k in range(nz):
                t = time[i, j, k]
                low = t * (conductance[i, j, k] + max(flux[i, j, k], 0.0))
                high = t * (conductance[i, j, k + 1] + max(-flux[i, j, k + 1], 0.0))
                pivot = 1.0 / (1.0 + low + high + sink[i, j, k] - low * carried_on)
                carried_on = high * pivot
                before = (change[i, j, k] + low * before) * pivot
                kept[k] = carried_on
                change[i, j, k] = before
            for back in range(1, nz):
                k = nz - 1 - back
                change[i, j, k] += kept[k] * change[i, j, k + 1]


def implicit(
    change: np.ndarray, carried: Transport, volume: np.ndarray, step: float, sink: np.ndarray
) -> np.ndarray:
    """Implicit `change` for an explicit one, in place, over a `step` [s].

    `sink`: rate [1/s] at which what is there goes.
    """
    time = step / volume
    sweep_x(change, carried, time)
    if change.shape[1] > 1:
        sweep_y(change, carried, time)
    sweep_z(change, carried, time, step * sink)
    return change
