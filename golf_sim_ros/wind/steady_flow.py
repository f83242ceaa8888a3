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

"""Steady flow over a ground: Reynolds-averaged Navier-Stokes equations, marched in time to rest.

div u = 0, u . grad u = -grad p + div(nu_t grad u) - Cd a |u| u in foliage, with the closure of
`turbulence_closure`. Its first projection, of the undisturbed profile, is the mass-consistent
model (Sherman, J. Appl. Meteor. 17 (1978) 312-319).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from . import boundary_conditions as boundary
from . import momentum
from .errors import NotConverged
from .grid import Grid
from .march import March
from .momentum import Transport, Viscosity
from .pressure_solver import PressureSolver, Velocity
from .turbulence_closure import close, closure_of, CMU, FED, SPENT

LEAST_ENERGY = 0.02  # of that of the profile: k never falls below
STILL = 1e-12  # of the wind: air that slow has no direction for its friction
TIGHT, MANY = 1e-9, 200  # of a projection on its own: what is left, and iterations at most
# of divergence times width over speed, which the end of a march shall have
DIVERGENCE = 1e-11
BLOWN_UP = 50.0  # times the wind: no such air is meant


class Terrain(NamedTuple):
    """Ground as the air feels it.

    ``roughness`` length (nx, ny) [m]; ``foliage`` Cd a (nx, ny, nz) [1/m]; ``sponge`` rates (nx,
    ny) at a wind of 1 m/s [1/s].
    """

    roughness: np.ndarray
    foliage: np.ndarray
    sponge: np.ndarray

    @classmethod
    def bare(cls, grid: Grid, roughness: float) -> 'Terrain':
        """Terrain of a uniform `roughness` without trees, and without a sponge."""
        nx, ny, _ = grid.shape
        return cls(np.full((nx, ny), float(roughness)), np.zeros(grid.shape), np.zeros((nx, ny)))


class SteadyFlow:
    """Flow of an `Inflow` over the `Terrain` on a `Grid`, at first that inflow everywhere.

    Attributes
    ----------
    velocity : Velocity
    energy : ndarray, (nx, ny, nz)
        Kinetic energy k of the turbulence [m^2/s^2].
    residuals : list of float
        Change in each step; see `March`.
    """

    def __init__(self, grid: Grid, land: Terrain, inflow: boundary.Inflow) -> None:
        self.grid, self.land, self.inflow = grid, land, inflow
        self.pressure_solver = PressureSolver(grid)
        self.closure = closure_of(grid, land.roughness, land.foliage)
        m, (cx, cy) = grid.metric, inflow.direction
        self.profile = Velocity(
            cx * inflow.at(m.jx[:, :, None] * grid.zc),
            cy * inflow.at(m.jy[:, :, None] * grid.zc),
            np.zeros((*grid.shape[:2], grid.shape[2] + 1)),
        )
        above = grid.top + 0.5 * m.dzf[-1]
        self.at_top = cx * inflow.at(above), cy * inflow.at(above), 0.0
        self.velocity = self.profile.copy()
        boundary.balance(self.velocity, m)
        self.energy = np.full(grid.shape, inflow.energy)
        self.pressure = np.zeros(grid.shape)
        self.flux = Velocity.zeros(grid.shape)
        self.volumes = grid.volumes
        self.residuals: list[float] = []
        inside = (slice(1, -1), slice(None), slice(None))
        self._parts = []
        for axis, faces in enumerate(
            (momentum.faces_of_u, momentum.faces_of_v, momentum.faces_of_w)
        ):
            region = inside[-axis:] + inside[:-axis] if axis else inside
            shape = self.velocity[axis][region].shape
            if 0 not in shape:
                self._parts.append((axis, faces, region, Transport.of(shape)))
        self._carried_energy = Transport.of(grid.shape)

    def make_mass_consistent(self) -> None:
        """Remove the divergence of the present flow.

        Of the undisturbed profile that makes the mass-consistent model.
        """
        self.pressure_solver.project(self.velocity, TIGHT, MANY)
        boundary.follow_ground(self.velocity, self.grid.metric)

    def run(
        self, march: March | None = None, progress: Callable[[int, float], None] | None = None
    ) -> None:
        """March until the flow is at rest.

        Parameters
        ----------
        march : March, optional
        progress : callable, optional
            ``progress(step, change)`` after each step.

        Raises
        ------
        NotConverged
        """
        march = march or March()
        self.make_mass_consistent()
        for step in range(1, march.steps + 1):
            change = self.step(march)
            self.residuals.append(change)
            if progress:
                progress(step, change)
            if change < march.change:
                break
            if not change < BLOWN_UP:
                raise NotConverged(f'the flow blew up in step {step}')
        if not self.residuals[-1] < march.allowed:
            raise NotConverged(
                f'after {march.steps} steps the flow still changes by {self.residuals[-1]:.1e} of '
                f'the wind in the time it takes to pass a cell; {march.allowed:.0e} would do'
            )
        self._finish()

    def _finish(self) -> None:
        """Remove the divergence that the steps have left."""
        for _ in range(3):
            if self.divergence < DIVERGENCE:
                break
            self.pressure_solver.project(self.velocity, TIGHT, MANY)
        boundary.follow_ground(self.velocity, self.grid.metric)

    @property
    def divergence(self) -> float:
        """Greatest divergence of the solver's faces, times the width of a cell over the wind."""
        return self.pressure_solver.divergence(self.velocity)

    def step(self, march: March) -> float:
        """Make one step; the change of the velocity, as in `March`."""
        m = self.grid.metric
        close(self.velocity, self.energy, m, self.closure)
        self.pressure_solver.net_outflow(self.velocity)
        for mine, flux in zip(self.flux, self.pressure_solver.flux):
            mine[:] = flux
        time = march.courant / self._fastest()
        viscosity = Viscosity(self.closure.cells, self.closure.levels)
        before = self.velocity.copy()
        changes = self._momentum(viscosity, time)
        self._transport_energy(viscosity, time)
        for (axis, _, region, _), change in zip(self._parts, changes):
            self.velocity[axis][region] += change
        boundary.let_out(self.velocity, self.inflow)
        boundary.balance(self.velocity, m)
        potential = self.pressure_solver.project(self.velocity, 1e-2, march.projections)
        self.pressure -= potential / time
        boundary.follow_ground(self.velocity, m)
        most = max(abs(now - old).max() for now, old in zip(self.velocity[:2], before[:2]))
        return float(most / (self.inflow.speed * march.courant))

    def _fastest(self) -> float:
        """Greatest number of cells that air passes in a second."""
        u, v, w = map(abs, self.flux)
        through = u[1:] + u[:-1] + v[:, 1:] + v[:, :-1] + w[:, :, 1:] + w[:, :, :-1]
        return float((0.5 * through / self.volumes[-1]).max())

    def speeds(self) -> np.ndarray:
        """Speed [m/s] at the centres of the cells."""
        return np.sqrt(sum(part * part for part in self.centred()))

    def centred(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Velocity at the centres of the cells: three arrays (nx, ny, nz)."""
        u, v, w = self.velocity
        return (
            0.5 * (u[1:] + u[:-1]),
            0.5 * (v[:, 1:] + v[:, :-1]),
            0.5 * (w[:, :, 1:] + w[:, :, :-1]),
        )

    def _sinks(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rates [1/s], in cells, at which foliage takes momentum, and foliage with the ground."""
        m = self.grid.metric
        speed = self.speeds()
        foliage = self.land.foliage * speed
        steep = np.sqrt(1.0 + m.sx * m.sx + m.sy * m.sy)
        wall = self.closure.wall * self.closure.friction * steep / (m.j * m.dz[0])
        with_ground = foliage.copy()
        with_ground[:, :, 0] += wall
        return foliage, with_ground, speed

    def _momentum(self, viscosity: Viscosity, time: float) -> list[np.ndarray]:
        """Return changes of u, v, w inside, over a step of `time` [s]."""
        pressure = self.pressure_solver.gradient(self.pressure)
        foliage, with_ground, _ = self._sinks()
        sponge = (self.inflow.speed * self.land.sponge)[:, :, None]
        changes = []
        for axis, faces, region, carried in self._parts:
            faces(self.flux, viscosity, self.grid.metric, carried)
            now = self.velocity[axis][region]
            self._set_ghosts(axis, region, carried.padded)
            momentum.transport(carried, momentum.QUICK, False)
            volume = self.volumes[axis][region]
            drag = foliage if axis == 2 else with_ground
            drag, soaked = (on_faces(rate, axis) for rate in (drag, sponge))
            rate = carried.rate / volume + pressure[axis][region]
            rate -= drag * now + soaked * (now - self.profile[axis][region])
            changes.append(momentum.implicit(time * rate, carried, volume, time, drag + soaked))
        return changes

    def _set_ghosts(self, axis: int, region: Any, padded: np.ndarray) -> None:
        """Fill the ghosts around one part of the velocity."""
        part = self.velocity[axis]
        boundary.extend(padded, part[region])
        if axis < 2:
            padded[:, :, -2:] = self.at_top[axis]
        for across, end in self.inflow.ends():
            if across != axis:
                given = self.profile[axis][region].swapaxes(0, across)[end]
                boundary.set_ghosts(padded, across, end, given)
        for end in (0, -1):
            boundary.set_ghosts(padded, axis, end, part.swapaxes(0, axis)[end])

    def _transport_energy(self, viscosity: Viscosity, time: float) -> None:
        """Advance the kinetic energy k of the turbulence by a step of `time` [s], in place."""
        carried, closure = self._carried_energy, self.closure
        momentum.faces_of_cells(self.flux, viscosity, self.grid.metric, carried)
        carried.conductance.z[:, :, -1] = 0.0
        boundary.extend(carried.padded, self.energy)
        for axis, end in self.inflow.ends():
            boundary.set_ghosts(carried.padded, axis, end, self.inflow.energy)
        momentum.transport(carried, momentum.QUICK, True)
        foliage, _, speed = self._sinks()
        sponge = (self.inflow.speed * self.land.sponge)[:, :, None]
        spent = CMU**0.75 * np.sqrt(self.energy) * closure.inverse
        rate = carried.rate / self.volumes[-1] + closure.made - spent * self.energy
        rate += foliage * (FED * speed * speed - SPENT * self.energy)
        rate -= sponge * (self.energy - self.inflow.energy)
        sink = 1.5 * spent + SPENT * foliage + sponge
        change = momentum.implicit(time * rate, carried, self.volumes[-1], time, sink)
        np.maximum(self.energy + change, LEAST_ENERGY * self.inflow.energy, out=self.energy)


def on_faces(cells: np.ndarray, axis: int) -> np.ndarray:
    """Means of neighbouring `cells` along an axis; what has one cell along it stays as it is."""
    if cells.shape[axis] == 1:
        return cells
    along = cells.swapaxes(0, axis)
    return (0.5 * (along[1:] + along[:-1])).swapaxes(0, axis)
