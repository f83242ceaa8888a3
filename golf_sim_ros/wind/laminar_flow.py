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

"""Laminar flow in a box, of constant viscosity: the solver on cases whose solutions are known.

The box lies in the plane of x and z, a cell deep. It uses the same transport and the same pressure
solver as `steady_flow`.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from . import momentum
from .grid import Grid
from .momentum import Transport, Viscosity
from .pressure_solver import PressureSolver, Velocity

EXACT, MANY = 1e-12, 60  # of a projection: what is left, and iterations at most


class Walls(NamedTuple):
    """Walls of a box: what they do to u above and below, and to w at the sides.

    Each maps the velocity beside the wall to that of its mirror image behind it.
    """

    below: Callable
    above: Callable
    beside: Callable


def slides(inside: np.ndarray) -> np.ndarray:
    """Wall along which the air slides without friction."""
    return inside


def sticks(inside: np.ndarray) -> np.ndarray:
    """Wall at rest to which the air sticks."""
    return -inside


def drags(inside: np.ndarray) -> np.ndarray:
    """Wall that moves with a speed of 1, and drags the air along."""
    return 2.0 - inside


class LaminarFlow:
    """Flow of `viscosity` between `walls` in a square box.

    Parameters
    ----------
    faces : ndarray, (n + 1,)
        Of its n x n cells, along x as along z.

    Attributes
    ----------
    velocity : Velocity
        At first still.
    """

    def __init__(self, faces: np.ndarray, viscosity: float, walls: Walls) -> None:
        cells = len(faces) - 1
        self.grid = Grid(faces, np.array([0.0, 1.0]), faces.copy())
        self.walls = walls
        self.pressure_solver = PressureSolver(self.grid)
        self.velocity = Velocity.zeros(self.grid.shape)
        self.pressure = np.zeros(self.grid.shape)
        self.viscosity = Viscosity(
            np.full(self.grid.shape, viscosity), np.full((cells, 1, cells + 1), viscosity)
        )
        self.flux = Velocity.zeros(self.grid.shape)
        self._u, self._w = Transport.of((cells - 1, 1, cells)), Transport.of((cells, 1, cells - 1))

    def rates(self, curved: float) -> tuple[np.ndarray, np.ndarray]:
        """Accelerations of u and w inside, pressure included."""
        self.pressure_solver.net_outflow(self.velocity)
        for mine, flux in zip(self.flux, self.pressure_solver.flux):
            mine[:] = flux
        pressure = self.pressure_solver.gradient(self.pressure)
        volumes, metric = self.grid.volumes, self.grid.metric
        momentum.faces_of_u(self.flux, self.viscosity, metric, self._u)
        momentum.faces_of_w(self.flux, self.viscosity, metric, self._w)
        self._set_ghosts()
        for carried in (self._u, self._w):
            momentum.transport(carried, curved, False)
        return (
            self._u.rate / volumes[0][1:-1] + pressure.u[1:-1],
            self._w.rate / volumes[2][:, :, 1:-1] + pressure.w[:, :, 1:-1],
        )

    def _set_ghosts(self) -> None:
        u, w = self._u.padded, self._w.padded
        u[2:-2, 2:-2, 2:-2] = self.velocity.u[1:-1]
        w[2:-2, 2:-2, 2:-2] = self.velocity.w[:, :, 1:-1]
        # through a wall nothing flows: zero on it, and the opposite behind it
        u[1], u[-2], w[:, :, 1], w[:, :, -2] = 0.0, 0.0, 0.0, 0.0
        u[0], u[-1] = -u[2], -u[-3]
        w[:, :, 0], w[:, :, -1] = -w[:, :, 2], -w[:, :, -3]
        for ghost, inside in ((1, 2), (0, 3)):
            u[:, :, ghost] = self.walls.below(u[:, :, inside])
            u[:, :, -1 - ghost] = self.walls.above(u[:, :, -1 - inside])
            w[ghost] = self.walls.beside(w[inside])
            w[-1 - ghost] = self.walls.beside(w[-1 - inside])
        for padded in (u, w):
            padded[:, :2] = padded[:, -2:] = padded[:, 2:3]

    def march_to_rest(self, step: float, change: float, most: int) -> int:
        """March with implicit steps until the velocity changes by less than `change` a second.

        Returns
        -------
        int
            Steps made; `most` where it did not come to rest.
        """
        volumes = self.grid.volumes
        none = [np.zeros_like(carried.rate) for carried in (self._u, self._w)]
        for count in range(1, most + 1):
            before = self.velocity.u.copy()
            u, w = self.rates(momentum.QUICK)
            for now, rate, carried, volume, sink in (
                (self.velocity.u[1:-1], u, self._u, volumes[0][1:-1], none[0]),
                (self.velocity.w[:, :, 1:-1], w, self._w, volumes[2][:, :, 1:-1], none[1]),
            ):
                now += momentum.implicit(step * rate, carried, volume, step, sink)
            self.pressure -= self.pressure_solver.project(self.velocity, EXACT, MANY) / step
            if abs(self.velocity.u - before).max() < change * step:
                break
        return count

    def march_in_time(self, end: float, steps: int, curved: float) -> None:
        """March to the time `end` with explicit steps of second order (Adams and Bashforth)."""
        step, before = end / steps, None
        for _ in range(steps):
            rates = self.rates(curved)
            slope = self.pressure_solver.gradient(self.pressure)
            pressure = slope.u[1:-1].copy(), slope.w[:, :, 1:-1].copy()
            own = [rate - push for rate, push in zip(rates, pressure)]
            inside = self.velocity.u[1:-1], self.velocity.w[:, :, 1:-1]
            for now, push, rate, last in zip(inside, pressure, own, before or own):
                now += step * (1.5 * rate - 0.5 * last + push)
            before = own
            self.pressure -= self.pressure_solver.project(self.velocity, EXACT, MANY) / step

    @property
    def divergence(self) -> float:
        """Greatest divergence times the width of a cell over the greatest speed."""
        return self.pressure_solver.divergence(self.velocity)
