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

"""Trees as porous drag: how much Cd a there is in each cell of a grid."""

from math import pi

import numpy as np

from .grid import Grid
from .land_survey import Survey
from ..physics.geometry.solid import Cylinder, Sphere
from ..physics.scene.course_record import Course

Solid = Cylinder | Sphere

LOOKS = 16  # along each side of a crown


def trees_of(course: Course) -> list[Solid]:
    """Obstacles of a course that brake the wind: those whose material has a canopy drag."""
    return [solid for solid in course.obstacles if solid.material.canopy_drag > 0.0]


def tallest(course: Course, survey: Survey) -> float:
    """Height [m] of the top of the tallest tree over the ground under it; 0 without any."""
    return max(
        (
            float(high - survey.heights_at(x, y))
            for (x, y), _, _, high in map(measures, trees_of(course))
        ),
        default=0.0,
    )


def measures(solid: Solid) -> tuple[tuple[float, float], float, float, float]:
    """Middle (x, y), radius, lowest and greatest height of a crown [m]."""
    if isinstance(solid, Sphere):
        x, y, z = solid.center
        return (x, y), solid.radius, z - solid.radius, z + solid.radius
    x, y, z = solid.base
    return (x, y), solid.radius, z, z + solid.height


def canopy_drag(course: Course, grid: Grid, survey: Survey) -> np.ndarray:
    """Cd a (nx, ny, nz) [1/m] in the cells of a `grid`, by the share of each that is in crowns.

    Crowns stand as high over the ground of the grid as over that of the `survey`.
    """
    total = np.zeros(grid.shape)
    for solid in trees_of(course):
        middle, radius, low, high = measures(solid)
        low, high = (z - float(survey.heights_at(*middle)) for z in (low, high))
        unit = (np.arange(LOOKS) + 0.5) / LOOKS
        x, y, z = (
            looks.ravel()
            for looks in np.meshgrid(2.0 * unit - 1.0, 2.0 * unit - 1.0, unit, indexing='ij')
        )
        round_plan = x * x + y * y
        if isinstance(solid, Sphere):
            held = round_plan + (2.0 * z - 1.0) ** 2 <= 1.0
            volume = 4.0 / 3.0 * pi * radius**3
        else:
            held = round_plan <= 1.0
            volume = pi * radius**2 * (high - low)
        place = middle[0] + radius * x[held], middle[1] + radius * y[held]
        above = low + (high - low) * z[held]
        add_to_cells(
            total, grid, (*place, above), solid.material.canopy_drag * volume / held.sum()
        )
    return total / grid.volumes[-1]


def add_to_cells(
    total: np.ndarray, grid: Grid, places: tuple[np.ndarray, ...], amount: float
) -> None:
    """Add an `amount` to the cell of each of the `places`: x, y and height over the ground.

    Writes total.
    """
    x, y, above = places
    i = np.searchsorted(grid.x, x) - 1
    j = np.searchsorted(grid.y, y) - 1
    known = (i >= 0) & (i < grid.shape[0]) & (j >= 0) & (j < grid.shape[1]) & (above > 0.0)
    i, j, above = i[known], j[known], above[known]
    k = np.searchsorted(grid.zeta, above / grid.metric.j[i, j]) - 1
    np.add.at(total, (i, j, np.clip(k, 0, grid.shape[2] - 1)), amount)
