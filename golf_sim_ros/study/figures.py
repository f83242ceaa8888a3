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

from collections.abc import Iterable, Sequence
from math import ceil, floor, isfinite, log10
from os import PathLike
from typing import Any

import matplotlib
from matplotlib import pyplot
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter
import numpy as np

from .effects import EffectRow
from .grounds import GroundRow
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
ERRORS = {'touch_error': 'error at first touch [m]', 'rest_error': 'error at rest [m]'}
LEAST = {'touch_error': 1e-13, 'rest_error': 1e-9}  # m: errors below are drawn here
LEAST_MOVED = 1e-6  # m
MARKERS = dict(zip(ACCURACY, 'v*D'))
ACROSS = 2  # panels
MOST_TICKS = 9
FEW_TICKS = 4
MARGIN = 0.3  # decades


def save(figure: Any, path: str | PathLike[str]) -> None:
    """Write a figure to a PNG file."""
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def scale(panels: Iterable[Any], along: str, values: Iterable[float], down: bool = False) -> None:
    """Give `panels` the same logarithmic scale for `values`, `along` x or y.

    Ticks are at powers of ten, no more than can be read; where these are few, at threes, too. It
    runs `down` or up.
    """
    known = [log10(value) for value in values if isfinite(value) and value > 0.0]
    low, high = min(known) - MARGIN, max(known) + MARGIN
    if floor(high) <= ceil(low):  # there is one power of ten at most between them
        low, high = floor(low) - MARGIN, ceil(high) + MARGIN
    ends = (10.0**high, 10.0**low) if down else (10.0**low, 10.0**high)
    step = ceil((high - low) / MOST_TICKS)
    ticks = [10.0**power for power in range(ceil(low), floor(high) + 1, step)]
    few = len(ticks) < FEW_TICKS
    if few:
        between = (3.0 * tick for tick in (0.1 * ticks[0], *ticks))
        ticks = sorted([*ticks, *(tick for tick in between if 10.0**low < tick < 10.0**high)])
    for panel in panels:
        panel.set(**{f'{along}scale': 'log', f'{along}lim': ends})
        axis = getattr(panel, f'{along}axis')
        axis.set_major_locator(FixedLocator(ticks))
        axis.set_minor_locator(NullLocator())
        if few:
            axis.set_major_formatter(StrMethodFormatter('{x:g}'))
        panel.grid(alpha=0.3)


def draw(rows: Sequence[Row], path: str | PathLike[str]) -> None:
    """Draw time against error, a panel a scene and a line a method, to a PNG file.

    Scenes whose errors are of the same kind, at first touch or at rest, have the same scales.
    """
    flown = list(dict.fromkeys(row.scene for row in rows if isfinite(row.touch_error)))
    rolled = [scene for scene in dict.fromkeys(row.scene for row in rows) if scene not in flown]
    groups = [(scenes, what) for scenes, what in zip((flown, rolled), ERRORS) if scenes]
    down = sum(ceil(len(scenes) / ACROSS) for scenes, _ in groups)
    figure, panels = pyplot.subplots(
        down, ACROSS, figsize=(5.5 * ACROSS, 3.6 * down + 0.9), layout='constrained', squeeze=False
    )
    for panel in panels.flat:
        panel.set_axis_off()
    handles = {}
    top = 0
    for scenes, what in groups:
        below = top + ceil(len(scenes) / ACROSS)
        used = panels[top:below].ravel()[: len(scenes)]
        top = below
        for panel, scene in zip(used, scenes):
            panel.set_axis_on()
            draw_scene(panel, [row for row in rows if row.scene == scene], what)
            handles.update(dict(zip(*reversed(panel.get_legend_handles_labels()))))
        own = [row for row in rows if row.scene in scenes]
        scale(used, 'x', [max(getattr(row, what), LEAST[what]) for row in own], down=True)
        scale(used, 'y', [row.time * 1e6 for row in own])
    figure.legend(
        handles.values(), handles.keys(), loc='outside lower center', ncols=4, frameon=False
    )
    save(figure, path)


def draw_scene(panel: Any, rows: Sequence[Row], what: str) -> None:
    """Draw one scene's rows; `what`: the field of the error."""
    for method, (color, label) in STYLE.items():
        line = [
            (max(getattr(r, what), LEAST[what]), r.time * 1e6) for r in rows if r.method == method
        ]
        if line:
            panel.plot(*zip(*line), 'o-', color=color, label=label, markersize=3, linewidth=1)
    for preset, marker in MARKERS.items():
        row = next(r for r in rows if r.method == 'preset' and r.setting == preset)
        panel.plot(
            max(getattr(row, what), LEAST[what]),
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
    panel.set(title=rows[0].scene, ylabel='time of a shot [us]', xlabel=ERRORS[what])


def draw_grounds(rows: Sequence[GroundRow], path: str | PathLike[str]) -> None:
    """Draw time against error at rest, a panel a strike and a line a kind of ground.

    To a PNG file. The median of the errors is a thick line, the 99th percentile a thin one.
    """
    strikes = list(dict.fromkeys(row.strike for row in rows))
    names = dict.fromkeys(row.ground for row in rows)
    figure, panels = pyplot.subplots(
        1, len(strikes), figsize=(5 * len(strikes), 5.6), layout='constrained', squeeze=False
    )
    for panel, strike in zip(panels.flat, strikes):
        for number, ground in enumerate(names):
            own = [row for row in rows if (row.strike, row.ground) == (strike, ground)]
            draw_ground(panel, own, f'C{number}')
        panel.set(title=strike, xlabel=ERRORS['rest_error'])
    panels[0, 0].set_ylabel('time of a shot [us]')
    errors = [
        max(e, LEAST['rest_error']) for row in rows for e in (row.rest_median, row.rest_most)
    ]
    scale(panels.flat, 'x', errors, down=True)
    scale(panels.flat, 'y', [row.time * 1e6 for row in rows])
    (thick,) = panels[0, 0].plot([], [], color='black', linewidth=2, label='median')
    (thin,) = panels[0, 0].plot([], [], '--', color='black', linewidth=0.8, label='99 %')
    presets = [
        panels[0, 0].plot([], [], marker, color='black', label=f'preset {preset}')[0]
        for preset, marker in MARKERS.items()
    ]
    lines = [
        panels[0, 0].plot([], [], color=f'C{number}', linewidth=2, label=ground)[0]
        for number, ground in enumerate(names)
    ]
    figure.legend(
        handles=[*lines, thick, thin, *presets], loc='outside lower center', ncols=5, frameon=False
    )
    save(figure, path)


def draw_ground(panel: Any, rows: Sequence[GroundRow], color: str) -> None:
    """Draw the rows of one strike on one kind of ground."""
    for what, style in (('rest_median', '-'), ('rest_most', '--')):
        line = [
            (max(getattr(row, what), LEAST['rest_error']), row.time * 1e6)
            for row in rows
            if row.setting not in ACCURACY
        ]
        width = 2.0 if what == 'rest_median' else 0.8
        if line:
            panel.plot(*zip(*line), style, color=color, linewidth=width)
    for row in rows:
        if row.setting in ACCURACY:
            panel.plot(
                max(row.rest_median, LEAST['rest_error']),
                row.time * 1e6,
                MARKERS[row.setting],
                color=color,
                markersize=9,
                markeredgecolor='black',
                linestyle='none',
            )


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
    left.set_ylim(-0.7, len(rows) - 0.3)
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
                (row.rate, max(row.rest_error, LEAST['rest_error']))
                for row in rows
                if (row.scene, row.accuracy) == (scene, accuracy)
            ]
            panel.plot(*zip(*line), 'o-', label=accuracy, color=colors.get(accuracy, colors['']))
        panel.set(title=scene, xlabel='ticks a second')
    panels[0].set_ylabel(ERRORS['rest_error'])
    scale(panels, 'x', [row.rate for row in rows])
    scale(panels, 'y', [max(row.rest_error, LEAST['rest_error']) for row in rows])
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
        panel.set_xlabel(what)
        scale([panel], 'x', [row.count for row in own])
    panels[0].set_ylabel('time of a play [us]')
    scale(panels, 'y', [1e6 * row.time for row in rows])
    save(figure, path)
