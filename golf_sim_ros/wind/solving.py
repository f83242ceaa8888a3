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

"""Solving for the wind over a course: a grid over its land, and a flow for each direction."""

from collections.abc import Callable, Sequence
from functools import partial
from math import pi
from typing import NamedTuple

import numpy as np

from .accuracy import Level, level_of
from .boundary_conditions import Inflow, sponge_rates
from .field import Cells, MOST_NUMBERS, WindField
from .foliage import canopy_drag, tallest
from .grid import Grid, layers, with_buffer
from .land_survey import Box, land_box, land_digest, smoothed, Survey, survey
from .steady_flow import SteadyFlow, Terrain
from ..physics.effects.wind_field import WindAtlas
from ..physics.scene.course_record import Course

LEAST_TOP = 300.0  # m, of the lid
OVER_RELIEF = 6.0  # times relief and trees, of the lid
LEAST_BUFFER, BUFFER_RELIEF, BUFFER_GROWTH = 200.0, 6.0, 1.28
SPONGE_FROM = 0.25  # of the buffer's width, from the land on
KEPT_TO = 80.0  # m over the ground and above trees: no ball flies much higher
MOST_PLACES = 60000  # that are looked at in a survey, unless cells are smaller
ALONG_WIND = 1.07  # standard deviation along the wind over sqrt(k): 2.5 u* (Panofsky and Dutton)
DEFAULT_DIRECTIONS = 16

# Called with the number of the direction, the step, and the change in it.
Progress = Callable[[int, int, float], None]


class Case(NamedTuple):
    """All that a flow over a course needs but the direction.

    ``core``: slices of the cells over its land, and up to the highest that are kept.
    """

    survey: Survey
    grid: Grid
    land: Terrain
    level: Level
    core: tuple


def solve(
    course: Course,
    directions: int | Sequence[float] = DEFAULT_DIRECTIONS,
    accuracy: str | Level = 'standard',
    progress: Progress | None = None,
) -> WindField:
    """Solve for the wind over a course.

    Parameters
    ----------
    course : Course
    directions : int or sequence of float
        How many, evenly all round, or angles into which the air goes, from x towards y [rad].
    accuracy : str
        'mass', 'sketch', 'standard' or 'reference'.
    progress : callable, optional
        ``progress(number, step, change)`` after each step of the direction of that number.

    Returns
    -------
    WindField

    Raises
    ------
    ValueError
        What is asked for does not make sense, or the course has no logarithmic wind profile.
    NotConverged
        A flow did not come to rest.
    """
    angles = angles_of(directions)
    case = case_of(course, level_of(accuracy))
    check_size(case, len(angles))
    solved = [
        solve_direction(case, angle, progress and partial(progress, number))
        for number, angle in enumerate(angles)
    ]
    return field_of(course, case, accuracy, dict(zip(angles, solved)))


def angles_of(directions: int | Sequence[float]) -> list[float]:
    """Angles [rad], rising, from 0 to below a whole turn, of a number or of angles.

    ValueError where they make no sense.
    """
    if isinstance(directions, (int, float)):
        if directions != int(directions) or not 1 <= directions <= 360:
            raise ValueError(
                f'directions {directions!r} must be a number from 1 to 360, or angles'
            )
        return [2.0 * pi * n / int(directions) for n in range(int(directions))]
    angles = np.asarray(directions, float)
    if angles.ndim != 1 or not len(angles) or not np.isfinite(angles).all():
        raise ValueError('directions must be a number, or one or more finite angles')
    return sorted(set((angles % (2.0 * pi) % (2.0 * pi)).tolist()))


def check_size(case: Case, directions: int) -> None:
    """Check that a field of so many directions is not too large to be loaded; else ValueError."""
    i, j, k = (part.stop - part.start for part in case.core)
    if 4 * i * j * k * directions > MOST_NUMBERS:
        most = MOST_NUMBERS // (4 * i * j * k)
        raise ValueError(f'{directions} directions are too many for {i} x {j} x {k} cells: {most}')


def case_of(course: Course, level: Level) -> Case:
    """`Case` of a course at a `Level`."""
    box = land_box(course)
    sides = [high - low for low, high in box]
    cell = max(max(sides) / level.cells, level.smallest)
    fine = max(0.25 * cell, min(0.5 * cell, (sides[0] * sides[1] / MOST_PLACES) ** 0.5))
    looked_at = survey(course, box, fine)
    felt = smoothed(looked_at, cell)
    trees = tallest(course, looked_at)
    top = max(LEAST_TOP, OVER_RELIEF * (looked_at.relief + trees))
    width = max(LEAST_BUFFER, BUFFER_RELIEF * felt.relief, 7.0 * cell)
    x, y = (with_buffer(low, high, cell, BUFFER_GROWTH, width) for low, high in box)
    faded = partial(faded_heights, felt, width)
    grid = Grid(x, y, layers(level.lowest, level.growth, top), faded)
    roughness = np.exp(
        np.log(felt.upstream)
        + faded_share(box, width, *np.meshgrid(grid.xc, grid.yc, indexing='ij'))
        * np.log(roughness_at(felt, grid) / felt.upstream)
    )
    out = SPONGE_FROM * width
    (left, right), (front, back) = box
    free = (left - out, right + out), (front - out, back + out)
    land = Terrain(roughness, canopy_drag(course, grid, looked_at), sponge_rates(grid, free, 1.0))
    core = [
        slice(int((centres < low).sum()), int((centres <= high).sum()))
        for centres, (low, high) in zip((grid.xc, grid.yc), box)
    ]
    levels = int((grid.zc < KEPT_TO + trees).sum()) + 1
    return Case(looked_at, grid, land, level, (*core, slice(0, levels)))


def faded_heights(felt: Survey, width: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights over the datum, which beyond the land fade to 0 over `width` [m]."""
    box = (felt.x[0], felt.x[-1]), (felt.y[0], felt.y[-1])
    return faded_share(box, width, x, y) * (felt.heights_at(x, y) - felt.datum)


def faded_share(box: Box, width: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """1 within `box`, falling smoothly to 0 at `width` [m] from it."""
    away = [
        np.maximum(np.maximum(low - at, at - high), 0.0) for (low, high), at in zip(box, (x, y))
    ]
    share = np.clip(1.0 - np.hypot(*away) / width, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def roughness_at(felt: Survey, grid: Grid) -> np.ndarray:
    """Roughness length [m] at the middles of cells."""
    x, y = np.meshgrid(grid.xc, grid.yc, indexing='ij')
    return np.exp(felt._replace(heights=np.log(felt.roughness)).heights_at(x, y))


class Solved(NamedTuple):
    """What is kept of the flow in one direction: see `Cells`."""

    ratios: np.ndarray
    residuals: np.ndarray


def solve_direction(
    case: Case, angle: float, progress: Callable[[int, float], None] | None = None
) -> Solved:
    """`Solved` of a `Case` in one direction; raises `NotConverged`."""
    inflow = Inflow(angle, case.survey.upstream)
    flow = SteadyFlow(case.grid, case.land, inflow)
    if case.level.march is None:
        flow.make_mass_consistent()
    else:
        flow.run(case.level.march, progress)
    heights = case.grid.metric.j[:, :, None] * case.grid.zc
    law = np.log1p(heights / read_roughness(case)[:, :, None])
    law /= np.log1p(10.0 / case.survey.upstream)
    parts = [part / law for part in flow.centred()] + [ALONG_WIND * np.sqrt(flow.energy)]
    kept = np.stack([part[case.core] for part in parts], axis=-1).astype(np.float32)
    return Solved(kept, np.array(flow.residuals))


def read_roughness(case: Case) -> np.ndarray:
    """Roughness length [m] that is read in flight: over the land a spline of its logarithm."""
    logarithm = np.log(case.land.roughness)
    around = np.pad(logarithm[case.core[:2]], 1, mode='reflect')
    for axis in (0, 1):
        along = around.swapaxes(0, axis)
        around = (0.125 * along[:-2] + 0.75 * along[1:-1] + 0.125 * along[2:]).swapaxes(0, axis)
    logarithm[case.core[:2]] = around
    return np.exp(logarithm)


def field_of(
    course: Course, case: Case, accuracy: str | Level, solved: dict[float, Solved]
) -> WindField:
    """`WindField` of a course from what was `Solved`, by angle."""
    grid, (i, j, _) = case.grid, case.core
    angles = sorted(solved)
    first, growth = layer_law(grid.zeta)
    cells = Cells(
        np.stack([solved[angle].ratios for angle in angles]),
        case.land.roughness[i, j],
        padded([solved[angle].residuals for angle in angles]),
    )
    atlas = WindAtlas(
        np.array(angles),
        cells.ratios,
        cells.roughness,
        (float(grid.xc[i][0]), float(grid.yc[j][0])),
        (float(grid.metric.dx[i][0]), float(grid.metric.dy[j][0])),
        first,
        growth,
        case.survey.datum,
        float(grid.top),
        case.survey.upstream,
    )
    name = accuracy if isinstance(accuracy, str) else 'other'
    return WindField(cells, atlas, case.survey, land_digest(course), name)


def padded(rows: Sequence[np.ndarray]) -> np.ndarray:
    """Array of rows of different lengths, with zeros at their ends."""
    table = np.zeros((len(rows), max(map(len, rows))))
    for row, values in zip(table, rows):
        row[: len(values)] = values
    return table


def layer_law(zeta: np.ndarray) -> tuple[float, float]:
    """``first`` and ``growth`` of layers whose faces are at ``first (exp(growth k) - 1)``."""
    growth = float(np.log((zeta[2] - zeta[1]) / (zeta[1] - zeta[0])))
    return float(zeta[1] / np.expm1(growth)), growth
