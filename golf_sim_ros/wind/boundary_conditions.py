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

"""Boundary conditions: the logarithmic profile that flows in, and what is kept at the sides.

Where air flows in its velocity is given; where it flows out it follows what comes, scaled so that
as much leaves as enters. The top is a lid along which the profile goes on; air does not pass the
ground. In a buffer around the course a sponge draws the air back to the profile.
"""

from collections.abc import Iterator
from math import cos, sin
from typing import Any, NamedTuple

import numpy as np

from .grid import Grid, Metric
from .land_survey import Box
from .pressure_solver import Velocity
from .turbulence_closure import equilibrium_energy, friction_velocity, KAPPA

REFERENCE_HEIGHT = 10.0  # m, where a wind is given (WMO)
PARALLEL = 1e-12  # a direction whose component is less runs along the side
SPONGE = 2.0  # rate of the sponge at the outermost cell, in speeds of the wind over its width


class Inflow(NamedTuple):
    """Wind far upstream over level ground, of a logarithmic profile.

    ``angle`` [rad] from x towards y into which the air goes; ``roughness`` length [m]; ``speed``
    [m/s] at 10 m.
    """

    angle: float
    roughness: float
    speed: float = 1.0

    @property
    def direction(self) -> tuple[float, ...]:
        """Unit vector (x, y) of the wind; along a side exactly so."""
        parts = cos(self.angle), sin(self.angle)
        return tuple(0.0 if abs(part) < PARALLEL else part for part in parts)

    @property
    def friction(self) -> float:
        """Friction velocity [m/s]."""
        return friction_velocity(self.speed, REFERENCE_HEIGHT, self.roughness)

    @property
    def energy(self) -> float:
        """Kinetic energy k of the turbulence [m^2/s^2]."""
        return equilibrium_energy(self.friction)

    def at(self, height: Any) -> np.ndarray:
        """Speed [m/s] at `height` [m] over the ground."""
        return self.friction / KAPPA * np.log1p(np.maximum(height, 0.0) / self.roughness)

    def ends(self) -> Iterator[tuple[int, int]]:
        """Axis and end, 0 or -1, of each side that the wind blows in at."""
        for axis, part in enumerate(self.direction):
            if part:
                yield axis, 0 if part > 0.0 else -1


def extend(padded: np.ndarray, inside: np.ndarray) -> None:
    """Put a field `inside` of its `padded` array, whose ghosts get the values next to them."""
    padded[2:-2, 2:-2, 2:-2] = inside
    for axis in range(3):
        along = padded.swapaxes(0, axis)
        along[0] = along[1] = along[2]
        along[-1] = along[-2] = along[-3]


def set_ghosts(padded: np.ndarray, axis: int, end: int, value: Any) -> None:
    """Set both ghosts at an `end`, 0 or -1, of an `axis` to a `value`: one number, or an array."""
    along = padded.swapaxes(0, axis)
    for ghost in (0, 1) if end == 0 else (-1, -2):
        along[ghost, 2:-2, 2:-2] = value


def balance(velocity: Velocity, metric: Metric) -> None:
    """Scale what flows out of the sides so that it is as much as flows in, in place."""
    m = metric
    sides = []
    for part, stretch, width in (
        (velocity.u, m.jx, m.dy),
        (velocity.v.swapaxes(0, 1), m.jy.T, m.dx),
    ):
        for end, sign in ((0, -1.0), (-1, 1.0)):
            area = (stretch[end] * width)[:, None] * m.dz
            sides.append((part[end], sign * part[end] * area))
    total_in = -sum(np.minimum(out, 0.0).sum() for _, out in sides)
    total_out = sum(np.maximum(out, 0.0).sum() for _, out in sides)
    for values, out in sides:
        values[out > 0.0] *= total_in / total_out


def let_out(velocity: Velocity, inflow: Inflow) -> None:
    """Let the sides where air flows out follow the cells before them, in place."""
    for axis, end in inflow.ends():
        part = velocity[axis].swapaxes(0, axis)
        far, before = (-1, -2) if end == 0 else (0, 1)
        sign = 1.0 if end == 0 else -1.0
        part[far] = sign * np.maximum(sign * part[before], 0.0)


def follow_ground(velocity: Velocity, metric: Metric) -> None:
    """Set the vertical velocity at the ground to that of air along it, in place."""
    u = 0.5 * (velocity.u[1:, :, 0] + velocity.u[:-1, :, 0])
    v = 0.5 * (velocity.v[:, 1:, 0] + velocity.v[:, :-1, 0])
    velocity.w[:, :, 0] = u * metric.sx + v * metric.sy


def sponge_rates(grid: Grid, box: Box, speed: float) -> np.ndarray:
    """Rates [1/s], (nx, ny), at which the sponge draws the air to the profile.

    0 in `box`, x and y from and to; from there outwards they grow with the square of the distance.
    """
    (low_x, high_x), (low_y, high_y) = box
    shares, widths = [], []
    for centre, faces, low, high in (
        (grid.xc, grid.x, low_x, high_x),
        (grid.yc, grid.y, low_y, high_y),
    ):
        width = max(faces[-1] - high, low - faces[0], 1e-9)
        shares.append(np.maximum(np.maximum(low - centre, centre - high), 0.0) / width)
        widths.append(width)
    share = np.minimum(np.maximum(shares[0][:, None], shares[1][None, :]), 1.0)
    return SPONGE * speed / max(widths) * share * share
