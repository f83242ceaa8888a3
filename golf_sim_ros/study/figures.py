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

"""Figures of the page on what accuracy costs."""

from collections.abc import Sequence
from math import isfinite
from os import PathLike
from typing import Any

import matplotlib
from matplotlib import pyplot
import numpy as np

from .effects import EffectRow
from .measure import Row
from .sizes import SizeRow
from .ticks import TickRow
from ..physics import ACCURACY

matplotlib.use('Agg')
STYLE = {
    'euler': ('tab:red', 'semi-implicit Euler'),
    'rk4': ('tab:orange', 'RK4'),
    'dormand_prince': ('tab:blue', 'Dormand-Prince'),
    'scipy RK45': ('tab:gray', 'scipy RK45, flight only'),
    'scipy DOP853': ('black', 'scipy DOP853, flight only'),
}
LEAST = 1e-13  # m: errors below are rounding, drawn here
LEAST_MOVED = 1e-6  # m


def save(figure: Any, path: str | PathLike[str]) -> None:
    """Write a figure to a PNG file."""
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def draw(rows: Sequence[Row], path: str | PathLike[str]) -> None:
    """Draw time against error, a panel a scene and a line a method, to a PNG file."""
    scenes = list(dict.fromkeys(row.scene for row in rows))
    across = 2 if len(scenes) <= 4 else 3
    down = -(-len(scenes) // across)
    figure, panels = pyplot.subplots(
        down, across, figsize=(5.5 * across, 3.8 * down + 0.9), layout='constrained'
    )
    handles = {}
    for panel, scene in zip(panels.flat, scenes):
        draw_scene(panel, [row for row in rows if row.scene == scene])
        handles.update(dict(zip(*reversed(panel.get_legend_handles_labels()))))
    unused = slice(len(scenes), None)
    for panel in panels.flat[unused]:
        panel.set_axis_off()
    figure.legend(
        handles.values(), handles.keys(), loc='outside lower center', ncols=4, frameon=False
    )
    save(figure, path)


def draw_scene(panel: Any, rows: Sequence[Row]) -> None:
    """Draw one scene's rows."""
    flies = any(isfinite(row.touch_error) for row in rows)
    what = 'touch_error' if flies else 'rest_error'
    for method, (color, label) in STYLE.items():
        line = [(max(getattr(r, what), LEAST), r.time * 1e6) for r in rows if r.method == method]
        if line:
            panel.plot(*zip(*line), 'o-', color=color, label=label, markersize=3, linewidth=1)
    for preset, marker in zip(ACCURACY, 'v*D'):
        row = next(r for r in rows if r.method == 'preset' and r.setting == preset)
        panel.plot(
            max(getattr(row, what), LEAST),
            row.time * 1e6,
            marker,
            color='tab:green',
            markersize=10,
            label=f'preset {preset}',
            linestyle='none',
        )
    for row in rows:
        if row.method == 'report_2019':
            panel.plot(
                getattr(row, what),
                row.time * 1e6,
                'X',
                color='tab:purple',
                markersize=9,
                label='the report of 2019',
                linestyle='none',
            )
    panel.set(
        xscale='log',
        yscale='log',
        title=rows[0].scene,
        ylabel='time of a shot [us]',
        xlabel=f'error at {"first touch" if flies else "rest"} [m]',
    )
    panel.invert_xaxis()
    panel.grid(alpha=0.3)


def draw_effects(rows: Sequence[EffectRow], path: str | PathLike[str]) -> None:
    """Draw what a scene is without an effect, to a PNG file.

    How far the rest moves, and the time that saves, a bar each.
    """
    names = [f'{row.scene}: {row.effect}' for row in rows]
    places = np.arange(len(rows))[::-1]
    figure, (left, right) = pyplot.subplots(
        1, 2, figsize=(12, 0.24 * len(rows) + 1.2), sharey=True, layout='constrained'
    )
    left.barh(
        places,
        [max(row.rest_moved, LEAST_MOVED) for row in rows],
        left=LEAST_MOVED,
        color='tab:blue',
    )
    left.set(xscale='log', xlim=(LEAST_MOVED, None), xlabel='rest elsewhere by [m]')
    left.set_yticks(places, names, fontsize=8)
    left.margins(y=0.01)
    right.barh(places, [row.saved for row in rows], color='tab:orange')
    right.axvline(0.0, color='black', linewidth=0.8)
    right.set(xlabel='time saved [%]')
    figure.suptitle('Without an effect')
    for panel in (left, right):
        panel.grid(alpha=0.3, axis='x')
    save(figure, path)


def draw_ticks(rows: Sequence[TickRow], path: str | PathLike[str]) -> None:
    """Draw error of the rest against tick rate, a panel a scene, to a PNG file."""
    scenes = list(dict.fromkeys(row.scene for row in rows))
    figure, panels = pyplot.subplots(
        1, len(scenes), figsize=(5 * len(scenes), 4.6), layout='constrained'
    )
    colors = dict(zip((*ACCURACY, ''), ('tab:cyan', 'tab:blue', 'tab:green', 'tab:red')))
    for panel, scene in zip(panels, scenes):
        for accuracy in dict.fromkeys(row.accuracy for row in rows):
            line = [
                (row.rate, max(row.rest_error, LEAST))
                for row in rows
                if (row.scene, row.accuracy) == (scene, accuracy)
            ]
            panel.plot(*zip(*line), 'o-', label=accuracy, color=colors.get(accuracy, colors['']))
        panel.set(
            xscale='log',
            yscale='log',
            title=scene,
            xlabel='ticks a second',
            ylabel='error at rest [m]',
        )
        panel.grid(alpha=0.3)
    figure.legend(
        *panels[0].get_legend_handles_labels(), loc='outside lower center', ncols=4, frameon=False
    )
    save(figure, path)


def draw_sizes(rows: Sequence[SizeRow], path: str | PathLike[str]) -> None:
    """Draw time of a play against what is counted, a panel each, to a PNG file."""
    kinds = list(dict.fromkeys(row.what for row in rows))
    figure, panels = pyplot.subplots(
        1, len(kinds), figsize=(5 * len(kinds), 4), layout='constrained'
    )
    for panel, what in zip(panels, kinds):
        own = [row for row in rows if row.what == what]
        panel.plot([row.count for row in own], [1e6 * row.time for row in own], 'o-')
        panel.set(xscale='log', yscale='log', xlabel=what, ylabel='time of a play [us]')
        panel.grid(alpha=0.3)
    save(figure, path)
