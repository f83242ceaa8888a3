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

"""Grid that follows the ground: z = h + zeta (1 - h / top), with h the ground above the datum.

Velocities are staggered (Arakawa C): u on faces across x, v across y, w across zeta, all of them
Cartesian. Fields are indexed [i, j, k] along x, y, zeta. Terrain-following coordinates: Gal-Chen
and Somerville, J. Comput. Phys. 17 (1975) 209-228.
"""

from collections.abc import Callable
from math import ceil, log
from typing import NamedTuple

import numpy as np

Heights = Callable[[np.ndarray, np.ndarray], np.ndarray]


class Metric(NamedTuple):
    """What kernels need of a grid.

    ``dx``, ``dy``, ``dz``: widths of cells; ``dxf``, ``dyf``, ``dzf``: distances of centres, at
    faces; ``jx``, ``jy``, ``j``: dz/dzeta at faces across x, across y, at centres; ``sx``,
    ``sy``: slope of the ground in cells; ``fade``: 1 - zeta / top at faces across zeta; ``zc``:
    zeta of centres.
    """

    dx: np.ndarray
    dy: np.ndarray
    dz: np.ndarray
    dxf: np.ndarray
    dyf: np.ndarray
    dzf: np.ndarray
    jx: np.ndarray
    jy: np.ndarray
    j: np.ndarray
    sx: np.ndarray
    sy: np.ndarray
    fade: np.ndarray
    zc: np.ndarray


class Grid:
    """Grid over a ground.

    Parameters
    ----------
    x, y, zeta : ndarray, (nx + 1,), (ny + 1,), (nz + 1,)
        Faces of the cells [m]; ``zeta`` from 0 to the top.
    heights : callable, optional
        ``heights(x, y)`` gives the ground [m] above the datum at arrays of places; else it is 0.
    """

    def __init__(
        self, x: np.ndarray, y: np.ndarray, zeta: np.ndarray, heights: Heights | None = None
    ) -> None:
        self.x, self.y, self.zeta = x, y, zeta
        self.xc, self.yc, self.zc = centres(x), centres(y), centres(zeta)
        self.shape = len(self.xc), len(self.yc), len(self.zc)
        self.top = zeta[-1]
        if heights is None:
            heights = level
        hx = heights(*np.meshgrid(x, self.yc, indexing='ij'))
        hy = heights(*np.meshgrid(self.xc, y, indexing='ij'))
        self.ground = heights(*np.meshgrid(self.xc, self.yc, indexing='ij'))
        dx, dy, dz = np.diff(x), np.diff(y), np.diff(zeta)
        self.metric = Metric(
            dx,
            dy,
            dz,
            between_centres(x),
            between_centres(y),
            between_centres(zeta),
            1.0 - hx / self.top,
            1.0 - hy / self.top,
            1.0 - self.ground / self.top,
            np.diff(hx, axis=0) / dx[:, None],
            np.diff(hy, axis=1) / dy[None, :],
            1.0 - zeta / self.top,
            self.zc,
        )

    @property
    def cells(self) -> int:
        """Number of cells."""
        nx, ny, nz = self.shape
        return nx * ny * nz

    @property
    def volumes(self) -> tuple[np.ndarray, ...]:
        """Volumes of the control volumes of u, v, w and of cells, an array each."""
        m = self.metric
        x, xf = m.dx[:, None, None], m.dxf[:, None, None]
        y, yf = m.dy[None, :, None], m.dyf[None, :, None]
        j = m.j[:, :, None]
        return (
            xf * y * m.jx[:, :, None] * m.dz,
            x * yf * m.jy[:, :, None] * m.dz,
            x * y * j * m.dzf,
            x * y * j * m.dz,
        )


def level(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights of level ground at the datum."""
    return np.zeros_like(x)


def centres(faces: np.ndarray) -> np.ndarray:
    """Middles between `faces`."""
    return 0.5 * (faces[1:] + faces[:-1])


def between_centres(faces: np.ndarray) -> np.ndarray:
    """Distances of the centres beside each of the `faces`; at the ends, of a cell's ghost."""
    middle = centres(faces)
    first, last = 2.0 * (middle[0] - faces[0]), 2.0 * (faces[-1] - middle[-1])
    return np.concatenate([[first], np.diff(middle), [last]])


def layers(first: float, ratio: float, top: float) -> np.ndarray:
    """Faces of layers from 0 to `top`, the lowest about `first` thick, each thicker by `ratio`."""
    count = max(2, ceil(log(1.0 + top * (ratio - 1.0) / first) / log(ratio)))
    low, high = 1.0 + 1e-9, 2.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        total = first * (middle**count - 1.0) / (middle - 1.0)
        low, high = (middle, high) if total < top else (low, middle)
    faces = np.cumsum(np.concatenate([[0.0], first * low ** np.arange(count)]))
    return faces * (top / faces[-1])


def with_buffer(low: float, high: float, cell: float, ratio: float, width: float) -> np.ndarray:
    """Faces of equal cells of about `cell` from `low` to `high`, with a buffer on both sides.

    Its cells grow by `ratio` each, until it is at least `width` wide.
    """
    inside = np.linspace(low, high, max(1, round((high - low) / cell)) + 1)
    cell = (high - low) / (len(inside) - 1)
    count = ceil(log(1.0 + width * (ratio - 1.0) / (cell * ratio)) / log(ratio))
    outside = np.cumsum(cell * ratio ** np.arange(1, count + 1))
    return np.concatenate([low - outside[::-1], inside, high + outside])
