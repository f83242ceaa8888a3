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

"""A wind field: how fast the air is, a section along the hole, and how it was solved for."""

from math import atan2, degrees, pi
import os
from typing import Any

from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Circle
import numpy as np

from .style import bare, GRID, INK, PALE, SMALL, TEXT
from ..physics import Course, Sphere
from ..wind import WindField

HEIGHTS = 2.0, 10.0  # m over the ground
WIND = 1.0  # m/s: fields are proportional
ARROWS = 26  # along x
TALL = 60.0  # m, of the section
COLORS = 'RdBu_r'
RANGE = (0.4, 1.6)  # of the speed over that far upstream
CONTOUR = 1.0  # m, or more where that would be many
MOST_CONTOURS = 12
TREES = '#1f7a3a'
WIDTH = 10.0  # inches
SECTION, RESIDUALS = 1.9, 1.5  # inches high
MARGIN = 0.75  # inches, of titles and labels, of each row
WIDE = 0.5  # height over width of land, below which maps are one above the other


def draw_field(
    path: str | os.PathLike, field: WindField, course: Course, angle: float | None = None
) -> None:
    """Draw a wind field as a picture.

    Parameters
    ----------
    path : str or path
        .png, .webp, .svg or .pdf
    field : golf_sim_ros.wind.WindField
    course : golf_sim_ros.physics.Course
    angle : float, optional
        Into which the air goes [rad]; of the directions solved for, that nearest to the way from
        tee to hole if not given.
    """
    angle = nearest_to_hole(field, course) if angle is None else angle
    x, y = field.survey.x, field.survey.y
    aspect = np.ptp(y) / np.ptp(x)
    beside = 1 if aspect < WIDE else 2
    tall = min(0.92 * WIDTH / beside * aspect, WIDTH)
    heights = [tall] * (2 // beside) + [SECTION, RESIDUALS]
    figure = Figure((WIDTH, sum(heights) + MARGIN * len(heights)), layout='constrained')
    grid = figure.add_gridspec(len(heights), beside, height_ratios=heights)
    maps = [figure.add_subplot(place) for place in list(grid)[:2]]
    for axes, height in zip(maps, HEIGHTS):
        shown = speed_map(axes, field, course, angle, height)
    bar = figure.colorbar(shown, ax=maps, shrink=0.9, pad=0.01, aspect=30)
    bar.ax.tick_params(labelsize=SMALL, colors=PALE, length=2.5)
    bar.outline.set_edgecolor(GRID)
    figure.suptitle(
        f'{course.name}: wind into {degrees(angle):.0f} degrees; colours: its speed over that at '
        'this height far upstream',
        fontsize=TEXT + 2.0,
        color=INK,
        x=0.01,
        ha='left',
    )
    section(figure.add_subplot(grid[-2, :]), field, course, angle)
    residuals(figure.add_subplot(grid[-1, :]), field)
    figure.savefig(path, dpi=110)


def nearest_to_hole(field: WindField, course: Course) -> float:
    """Of the directions of a field, that nearest to the way from tee to hole [rad]."""
    hole = course.hole or (course.tee[0] + 1.0, course.tee[1])
    ahead = atan2(hole[1] - course.tee[1], hole[0] - course.tee[0])
    return float(max(field.angles, key=lambda angle: np.cos(angle - ahead)))


def wind_at(field: WindField, angle: float, places: np.ndarray) -> np.ndarray:
    """Velocity at `places` (n, 3), in the wind of `angle`."""
    return field.velocity(places, (WIND * np.cos(angle), WIND * np.sin(angle), 0.0))


def upstream(field: WindField, height: Any) -> np.ndarray:
    """Speed far upstream at a `height` [m]."""
    rough = field.atlas.upstream
    return WIND * np.log1p(height / rough) / np.log1p(10.0 / rough)


def speed_map(
    axes: Axes, field: WindField, course: Course, angle: float, height: float
) -> AxesImage:
    """Draw how fast the air is at a `height` over the ground, with arrows, for a colour bar."""
    x, y = field.survey.x, field.survey.y
    places = np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)
    ground = field.survey.heights_at(*places.T)
    air = wind_at(field, angle, np.column_stack([places, ground + height]))
    speed = np.linalg.norm(air[:, :2], axis=1).reshape(len(y), len(x)) / upstream(field, height)
    shown = axes.imshow(
        speed,
        origin='lower',
        extent=(x[0], x[-1], y[0], y[-1]),
        cmap=COLORS,
        vmin=RANGE[0],
        vmax=RANGE[1],
        interpolation='bilinear',
    )
    step = max(CONTOUR, np.ceil(np.ptp(ground) / MOST_CONTOURS))
    levels = np.arange(np.floor(ground.min()), ground.max() + step, step)
    axes.contour(
        x, y, ground.reshape(len(y), len(x)), levels=levels, colors=PALE, linewidths=0.4, alpha=0.6
    )
    axes.add_collection(crowns(course))
    every = max(1, len(x) // ARROWS)
    picked = slice(every // 2, None, every)
    u, v = (air[:, n].reshape(len(y), len(x))[picked, picked] for n in (0, 1))
    axes.quiver(x[picked], y[picked], u, v, color=INK, width=0.0016, scale=1.3 * ARROWS)
    axes.plot(*course.tee, 'o', color=INK, markersize=3)
    if course.hole:
        axes.plot(*course.hole, '^', color=INK, markersize=4)
    bare(axes, f'at {height:g} m', 'x [m]', 'y [m]')
    return shown


def crowns(course: Course) -> PatchCollection:
    """Outlines in plan of what brakes the wind."""
    trees = [solid for solid in course.obstacles if solid.material.canopy_drag > 0.0]
    rings = [
        Circle((tree.center if isinstance(tree, Sphere) else tree.base)[:2], tree.radius)
        for tree in trees
    ]
    return PatchCollection(rings, facecolor='none', edgecolor=TREES, linewidth=0.9)


def section(axes: Axes, field: WindField, course: Course, angle: float) -> None:
    """Draw the speed over the way from tee to hole."""
    start, end = np.array(course.tee), np.array(course.hole or (field.survey.x[-1], course.tee[1]))
    along = np.linspace(0.0, 1.0, 160)
    places = start + along[:, None] * (end - start)
    ground = field.survey.heights_at(*places.T)
    above = np.geomspace(0.3, TALL, 60)
    air = [
        wind_at(field, angle, np.column_stack([places, ground + height])) / upstream(field, height)
        for height in above
    ]
    speed = np.linalg.norm(np.stack(air)[..., :2], axis=-1)
    way = along * np.linalg.norm(end - start)
    axes.pcolormesh(
        np.broadcast_to(way, speed.shape),
        ground + above[:, None],
        speed,
        cmap=COLORS,
        vmin=RANGE[0],
        vmax=RANGE[1],
        shading='gouraud',
    )
    axes.fill_between(way, ground, ground.min() - 2.0, color=GRID)
    axes.set_ylim(ground.min() - 2.0, ground.max() + 0.5 * TALL)
    bare(axes, 'from tee to hole', 'along the hole [m]', 'height [m]')


def residuals(axes: Axes, field: WindField) -> None:
    """Draw how the flow of each direction came to rest."""
    for angle, row in zip(field.angles, field.cells.residuals):
        row = row[row > 0.0]
        axes.semilogy(
            np.arange(1, len(row) + 1),
            row,
            color=colormaps['twilight_shifted'](angle / (2.0 * pi)),
            linewidth=1.0,
        )
    title = f'change of the flow in a step, of the wind: {len(field.angles)} directions'
    bare(axes, title, 'step')
    axes.grid(color=GRID, linewidth=0.6)
    axes.set_xlim(left=0.0)
    axes.tick_params(axis='y', which='minor', length=0.0)
