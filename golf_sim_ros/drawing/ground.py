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

"""The course under a play: from above, and cut open along the paths."""

from collections.abc import Sequence

from matplotlib.axes import Axes
import numpy as np

from .relief import grid_relief, relief
from .shots import DrawnShot
from .window import Window
from .zone_triangles import in_region
from ..physics import Course
from ..physics.scene.kernel_model import materials

LIGHT = 2.5  # how much brighter a slope of 1 is that rises towards the right and up
SHADE = 0.22  # at most so much brighter or darker
NOTHING = (1.0, 1.0, 1.0)
WATER = (0.20, 0.45, 0.70)
CLEAR = 0.25  # how much of the ground shines through water


def paint(axes: Axes, course: Course, window: Window, pixels: int) -> set[int]:
    """Paint the ground seen from above in its materials' colours, lit from the upper left.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    course : golf_sim_ros.physics.Course
    window : Window
    pixels : int
        Along x.

    Returns
    -------
    set of int
        Numbers of the materials seen.
    """
    side = window.width / pixels
    x = np.arange(window.left, window.right, side) + 0.5 * side
    y = np.arange(window.low, window.high, side) + 0.5 * side
    heights, numbers = grid_relief(course, x, y)
    colors = flooded(tints(course, numbers) * lit(heights, side), course, heights, x, y)
    axes.imshow(
        np.clip(colors, 0.0, 1.0),
        origin='lower',
        extent=(window.left, window.right, window.low, window.high),
        aspect='auto',
        interpolation='antialiased',
        zorder=0,
    )
    return set(numbers.flat) - {-1}


def tints(course: Course, numbers: np.ndarray) -> np.ndarray:
    """Colours of materials by number, (..., 3)."""
    return np.array([*(material.color for material in materials(course)), NOTHING])[numbers]


def flooded(
    colors: np.ndarray, course: Course, heights: np.ndarray, x: np.ndarray, y: np.ndarray
) -> np.ndarray:
    """`colors` (ny, nx, 3) of a ground, blue where water covers it.

    It has `heights` (ny, nx) over `x`, `y`.
    """
    x, y = np.meshgrid(x, y)
    for pond in course.water:
        over = in_region(pond.polygon, pond.cut, x.ravel(), y.ravel()).reshape(x.shape)
        wet = over & (heights < pond.level)
        colors[wet] = CLEAR * colors[wet] + (1.0 - CLEAR) * np.array(WATER)
    return colors


def lit(heights: np.ndarray, side: float) -> np.ndarray:
    """Brightness of a ground whose `heights` are `side` apart, (..., 1)."""
    if min(heights.shape) < 2:
        return np.ones((*heights.shape, 1))
    down, along = np.gradient(heights, side)
    light = np.nan_to_num(LIGHT * (along - down))
    return 1.0 + np.clip(light, -SHADE, SHADE)[..., np.newaxis]


def cut_open(
    axes: Axes, course: Course, shots: Sequence[DrawnShot], along: int, places: np.ndarray
) -> np.ndarray:
    """Fill the ground below the paths, seen from the side; return its heights.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Its lower limit is set afterwards.
    course : golf_sim_ros.physics.Course
    shots : sequence of DrawnShot
    along : int
        0 where the view's horizontal axis is x, 1 where it is y.
    places : ndarray
        Rising, on that axis.
    """
    aside = middle(shots, along, places)
    heights, numbers = relief(course, *((places, aside), (aside, places))[along])
    starts = np.flatnonzero(np.diff(numbers, prepend=-2))
    for start, end in zip(starts, [*starts[1:], len(places) - 1]):
        if numbers[start] >= 0:
            part = slice(start, end + 1)
            axes.fill_between(
                places[part],
                heights[part],
                -1e4,
                linewidth=0.0,
                zorder=1,
                color=tints(course, numbers[start]),
            )
    return heights


def middle(shots: Sequence[DrawnShot], along: int, places: np.ndarray) -> np.ndarray:
    """Find how far aside the paths are at `places` along, in the mean of those that pass there."""
    passing = np.full((len(shots), len(places)), np.nan)
    for row, shot in zip(passing, shots):
        order = np.argsort(shot.positions[:, along], kind='stable')
        there = shot.positions[order, along]
        row[:] = np.interp(places, there, shot.positions[order, 1 - along], np.nan, np.nan)
    some = np.isfinite(passing).any(0)
    if not some.any():
        return np.full(len(places), shots[0].positions[0, 1 - along])
    return np.interp(places, places[some], np.nanmean(passing[:, some], 0))
