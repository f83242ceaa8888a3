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

"""The ground from above, at many places at once."""

from typing import Any

import numpy as np

from ..physics import Course
from ..physics.geometry import surfaces
from ..physics.scene import kernel_model

COARSE = 4  # places of a grid to one that is always looked at


def look_down(
    ground: Any, xs: np.ndarray, ys: np.ndarray, heights: np.ndarray, numbers: np.ndarray
) -> None:
    """Find the highest ground at every place.

    Writes heights and numbers of materials; -1 without ground.
    """
    for i in range(len(xs)):
        z, part = surfaces.top(ground, xs[i], ys[i])
        heights[i] = z
        numbers[i] = surfaces.material_of(ground, part, (xs[i], ys[i], z)) if part >= 0 else -1


def relief(course: Course, x: Any, y: Any) -> tuple[np.ndarray, np.ndarray]:
    """Heights and materials of the highest ground at many places.

    Parameters
    ----------
    course : Course
    x, y : array_like
        Places [m]; they are broadcast against each other.

    Returns
    -------
    heights : ndarray
        [m]; not a number where there is no ground.
    numbers : ndarray of int
        Rows of `golf_sim_ros.physics.scene.kernel_model.materials(course)`; -1 where there is no
        ground.
    """
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    heights, numbers = np.empty(x.size), np.empty(x.size, np.int64)
    look_down(kernel_model.bare_ground(course), x.flatten(), y.flatten(), heights, numbers)
    heights[numbers < 0] = np.nan
    return heights.reshape(x.shape), numbers.reshape(x.shape)


def grid_relief(course: Course, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """`relief` at the places of a grid, looked at closely only where the material changes.

    Elsewhere heights are interpolated between every fourth place: what is smaller than that, and
    far from any edge, is not seen. In plain Python a picture takes 2 s so, a whole grid 20.

    Parameters
    ----------
    course : Course
    x, y : ndarray
        Rising, (nx,) and (ny,), places along both axes [m].

    Returns
    -------
    heights, numbers : ndarray, (ny, nx)
        See `relief`.
    """
    columns, rows = coarse(len(x)), coarse(len(y))
    heights, numbers = relief(course, x[columns], y[rows][:, np.newaxis])
    near = (
        np.searchsorted(rows, np.arange(len(y)), 'right') - 1,
        np.searchsorted(columns, np.arange(len(x)), 'right') - 1,
    )
    edges = near_edges(numbers)[np.ix_(*near)]
    along = np.array([np.interp(x, x[columns], row) for row in heights])
    fine = np.array([np.interp(y, y[rows], column) for column in along.T]).T
    kinds = numbers[np.ix_(*near)]
    i, j = np.nonzero(edges)
    fine[i, j], kinds[i, j] = relief(course, x[j], y[i])
    return fine, kinds


def coarse(count: int) -> np.ndarray:
    """Every fourth of so many places, and the last."""
    return np.unique([*range(0, count, COARSE), count - 1])


def near_edges(numbers: np.ndarray) -> np.ndarray:
    """Whether a block of the grid, or one beside it, has several `numbers` at its corners."""
    padded = np.pad(numbers, 2, mode='edge')
    windows = np.lib.stride_tricks.sliding_window_view(padded, (4, 4))[:-1, :-1]
    return windows.min((2, 3)) != windows.max((2, 3))
