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

"""Paths from above and from the side."""

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
import numpy as np

from . import ground
from .shots import DrawnShot
from .style import bare, colors, FEW, HALO, legible, SKY, SMALL, stroke
from .window import Window
from ..physics import Course

HOLE_RADIUS = 0.054  # m, Rules of Golf
APART = 0.17  # inches between two numbers of shots
ROOM = 0.25  # inches that a number takes beside its end
STEEPEST = 6.0  # heights are enlarged at most so many times
ENDS = {'at_rest': 'o', 'holed': 'o'}  # other ends are crosses


def above(
    axes: Axes,
    shots: Sequence[DrawnShot],
    course: Course | None,
    window: Window,
    size: Sequence[float],
    pixels: int,
) -> set[int]:
    """Draw `shots` from above into `axes`, `size` inches wide and high; return materials seen."""
    seen = ground.paint(axes, course, window, pixels) if course else set()
    for shot, color in zip(shots, colors(len(shots))):
        path(axes, shot, shot.positions[:, 0], shot.positions[:, 1], color, len(shots))
        touches(axes, [(c.position[0], c.position[1]) for c in shot.collisions], color, len(shots))
    ends(axes, shots, (0, 1))
    if course:
        furniture(axes, course)
    axes.set(xlim=(window.left, window.right), ylim=(window.low, window.high))
    number(axes, shots, course.hole if course else None, window.width / size[0])
    return seen


def path(
    axes: Axes, shot: DrawnShot, x: np.ndarray, y: np.ndarray, color: Any, shots: int
) -> None:
    """Draw one line of a shot among `shots`, labelled with its number."""
    axes.plot(
        x,
        y,
        color=color,
        zorder=5,
        solid_capstyle='round',
        label=f'shot {shot.result.shot}',
        **stroke(shots),
    )


def touches(axes: Axes, places: Sequence[tuple[float, float]], color: Any, shots: int) -> None:
    """Draw the bounces of one of `shots` shots at `places`, rows of x, y."""
    if len(places):
        size = 3.2 if shots <= len(FEW) else 2.0
        axes.plot(
            *zip(*places),
            'o',
            markersize=size,
            markerfacecolor='white',
            markeredgecolor=color,
            markeredgewidth=0.28 * size,
            linestyle='none',
            zorder=6,
        )


def ends(axes: Axes, shots: Sequence[DrawnShot], axis: tuple[int, int]) -> None:
    """Draw where `shots` began and ended; `axis` says which two coordinates are seen."""
    for shot, color in zip(shots, colors(len(shots))):
        mark, size = ENDS.get(shot.result.status, 'X'), 6.5 if len(shots) <= len(FEW) else 5.0
        axes.plot(
            *shot.positions[0, list(axis)],
            'D',
            color=color,
            markersize=0.6 * size,
            markeredgecolor='white',
            markeredgewidth=0.5,
            zorder=7,
        )
        axes.plot(
            *shot.positions[-1, list(axis)],
            mark,
            color=color,
            markersize=size,
            markeredgecolor='white',
            markeredgewidth=0.9,
            zorder=8,
        )


def number(axes: Axes, shots: Sequence[DrawnShot], hole: tuple | None, scale: float) -> None:
    """Write the shots' numbers at their ends, where there is room; an inch is `scale` metres.

    They stand to the right, or to the left where the picture ends or the flag is in the way.
    """
    places = np.array([shot.positions[-1, :2] for shot in shots])
    edge = axes.get_xlim()[1] - ROOM * scale
    flag_place = np.array(hole or (np.inf, np.inf)) - (0.0, 0.5 * ROOM * scale)
    for i in legible(places / scale, APART):
        ahead, above_it = (flag_place - places[i]) / scale
        left = places[i][0] > edge or 0.0 <= ahead < 1.3 * ROOM and abs(above_it) < 1.3 * ROOM
        side = {'xytext': (-5, 5), 'ha': 'right'} if left else {'xytext': (5, 5)}
        text = axes.annotate(
            str(shots[i].result.shot),
            places[i],
            **side,
            textcoords='offset points',
            fontsize=SMALL,
            fontweight='bold',
            color=colors(len(shots))[i],
            zorder=9,
            annotation_clip=True,
        )
        text.set_path_effects(HALO)


def furniture(axes: Axes, course: Course) -> None:
    """Draw tee, hole and bounds."""
    axes.plot(
        *course.tee,
        's',
        color='white',
        markeredgecolor='black',
        markeredgewidth=0.6,
        markersize=4.5,
        zorder=4,
    )
    if course.bounds:
        axes.plot(
            *zip(*course.bounds, course.bounds[0]),
            color='white',
            linestyle=(0, (4, 3)),
            linewidth=1.0,
            zorder=3,
        )
    if course.hole:
        x, y = course.hole
        turn = np.linspace(0.0, 2 * np.pi, 49)
        axes.fill(
            x + HOLE_RADIUS * np.cos(turn), y + HOLE_RADIUS * np.sin(turn), color='black', zorder=4
        )
        flag(axes, x, y)


def flag(axes: Axes, x: float, y: float) -> None:
    """Draw a flagstick of fixed size at `x`, `y`."""
    axes.plot(
        x,
        y,
        marker=[(0, 0), (0, 2), (0.9, 1.6), (0, 1.2), (0, 0)],
        markersize=22,
        markerfacecolor='#d3212c',
        markeredgecolor='white',
        markeredgewidth=0.7,
        zorder=7,
    )


def from_side(
    axes: Axes,
    shots: Sequence[DrawnShot],
    course: Course | None,
    window: Window,
    size: Sequence[float],
) -> None:
    """Draw `shots` from the side into `axes`, over what `window` shows.

    `axes` are `size` inches wide and high.
    """
    along = side_axis(window)
    limits = (window.left, window.right) if along == 0 else (window.low, window.high)
    heights = [shot.positions[:, 2] for shot in shots]
    if course:
        heights.append(ground.cut_open(axes, course, shots, along, np.linspace(*limits, 1200)))
    low, high, times = span(heights, (limits[1] - limits[0]) * size[1] / size[0])
    for shot, color in zip(shots, colors(len(shots))):
        path(axes, shot, shot.positions[:, along], shot.positions[:, 2], color, len(shots))
        touches(
            axes, [(c.position[along], c.position[2]) for c in shot.collisions], color, len(shots)
        )
    ends(axes, shots, (along, 2))
    axes.set(xlim=limits, ylim=(low, high), facecolor=SKY)
    bare(axes, f'From the side{enlarged(times)}', '' if along == 0 else 'y, left [m]', 'z, up [m]')


def side_axis(window: Window) -> int:
    """Choose the axis over which a play is best seen: 0 is x, 1 is y."""
    return 0 if window.width >= window.height else 1


def span(heights: list[np.ndarray], equal: float) -> tuple[float, float, float]:
    """Least and greatest height to be shown, and how many times they are enlarged.

    `equal` is the span [m] in which heights would be shown as large as lengths.
    """
    low, high = (
        choose([choose(h[np.isfinite(h)]) for h in heights if np.isfinite(h).any()])
        for choose in (min, max)
    )
    shown = max(1.3 * (high - low), equal / STEEPEST)
    low -= 0.45 * (shown - (high - low))
    return low, low + shown, equal / shown


def enlarged(times: float) -> str:
    """Remark on heights that are enlarged, for a title."""
    return '' if 0.95 < times < 1.05 else f', heights × {times:.2g}'
