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

"""Tables of the page on what accuracy costs."""

from collections.abc import Sequence
from math import isfinite

import numpy as np

from .against_scipy import OURS, ScipyRow
from .effects import EffectRow
from .grounds import GroundRow, PLANE, SHOTS
from .measure import Row
from .promises import PromiseRow
from .sizes import SizeRow
from .ticks import TickRow
from .wind_fields import WindRow
from ..physics import ACCURACY

LEVELS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8)  # m
CENTIMETRE = 0.01  # m
DECADES = tuple(10.0**-i for i in range(10))  # m


def seconds_at(rows: Sequence[Row], method: str, level: float) -> float | None:
    """Least time [s] of the settings of a method that are exact to `level` [m] at first touch.

    None where none is.
    """
    fit = [row.time for row in rows if row.method == method and row.touch_error <= level]
    return min(fit, default=None)


def equal_error_table(rows: Sequence[Row]) -> str:
    """Markdown table: time at equal error of each integrator, over that of Dormand-Prince."""
    lines = ['| scene | error at most | Dormand-Prince | RK4 | Euler |', '|---|---|---|---|---|']
    for scene in dict.fromkeys(row.scene for row in rows if isfinite(row.touch_error)):
        own = [row for row in rows if row.scene == scene]
        for level in LEVELS:
            base = seconds_at(own, 'dormand_prince', level)
            if base:
                others = (seconds_at(own, method, level) for method in ('rk4', 'euler'))
                cells = ('-' if t is None else f'{t / base:.3g} x' for t in others)
                lines.append(
                    f'| {scene} | {level:.0e} m | {base * 1e6:.0f} us | '
                    + ' | '.join(cells)
                    + ' |'
                )
    return '\n'.join(lines)


def exceptions(rows: Sequence[Row]) -> str:
    """Sentences about where Dormand-Prince is not the fastest at equal error."""
    found = []
    for scene in dict.fromkeys(row.scene for row in rows if isfinite(row.touch_error)):
        own = [row for row in rows if row.scene == scene]
        for level in LEVELS:
            base = seconds_at(own, 'dormand_prince', level)
            for other, label in (('rk4', 'RK4'), ('euler', 'Euler')):
                time = seconds_at(own, other, level)
                if base and time and time < base:
                    found.append(
                        f'- {scene}, {level:.0e} m: {label} took {time / base:.2f} of the time.'
                    )
    return '\n'.join(found) or 'There was none in this run.'


def full_table(rows: Sequence[Row]) -> str:
    """Markdown table of all rows."""
    lines = [
        '| scene | method | setting | first touch off by | rest off by | time of a shot '
        '| compiling |',
        '|---|---|---|---|---|---|---|',
    ]
    for row in rows:
        errors = (f'{e:.1e} m' if isfinite(e) else '-' for e in (row.touch_error, row.rest_error))
        lines.append(
            f'| {row.scene} | {row.method} | {row.setting} | '
            + ' | '.join(errors)
            + f' | {row.time * 1e6:.1f} us | {row.compiled:.1f} s |'
        )
    return '\n'.join(lines)


def preset_table(rows: Sequence[Row]) -> str:
    """Markdown table of the presets: promise, worst of the study, time."""
    lines = [
        '| preset | promises, first touch and rest | worst here | time of a shot | for |',
        '|---|---|---|---|---|',
    ]
    for name, preset in ACCURACY.items():
        own = [row for row in rows if row.method == 'preset' and row.setting == name]
        touch, rest = (
            np.nanmax([getattr(r, e) for r in own]) for e in ('touch_error', 'rest_error')
        )
        times = [row.time * 1e6 for row in own]
        lines.append(
            f'| {name} | {preset.touch:g} m, {preset.rest:g} m | {touch:.1e} m, {rest:.1e} m '
            f'| {min(times):.0f} to {max(times):.0f} us | {preset.use} |'
        )
    return '\n'.join(lines)


def promise_table(rows: Sequence[PromiseRow]) -> str:
    """Markdown table: promises of the presets, and what many shots showed."""
    lines = [
        '| ground | preset | shots | first touch: median | 99 % | worst | promised, beyond '
        '| rest: median | 99 % | worst | promised, beyond |',
        '|---|---|---|---|---|---|---|---|---|---|---|',
    ]
    for row in rows:
        preset = ACCURACY[row.accuracy]
        lines.append(
            f'| {row.ground} | {row.accuracy} | {row.shots:,} | {row.touch_median:.1e} m '
            f'| {row.touch_most:.1e} m | {row.touch_worst:.1e} m '
            f'| {preset.touch:g} m, {row.touch_beyond} | {row.rest_median:.1e} m '
            f'| {row.rest_most:.1e} m | {row.rest_worst:.1e} m '
            f'| {preset.rest:g} m, {row.rest_beyond} |'
        )
    return '\n'.join(lines)


def ground_table(rows: Sequence[GroundRow]) -> str:
    """Markdown table: what the presets cost and how far off they are, by kind of ground."""
    lines = [
        "| strike | ground | preset | time of a shot | over the plane's "
        '| first touch: median | 99 % | rest: median | 99 % | a call for one |',
        '|---|---|---|---|---|---|---|---|---|---|',
    ]
    own = {(row.strike, row.ground, row.setting): row for row in rows if row.setting in ACCURACY}
    for strike, ground in dict.fromkeys((row.strike, row.ground) for row in rows):
        for preset in ACCURACY:
            row, plane = own[strike, ground, preset], own[strike, PLANE, preset]
            errors = (row.touch_median, row.touch_most, row.rest_median, row.rest_most)
            lines.append(
                f'| {strike} | {ground} | {preset} | {row.time * 1e6:.1f} us '
                f'| {row.time / plane.time:.1f} x | '
                + ' | '.join(f'{e:.1e} m' if isfinite(e) else '-' for e in errors)
                + f' | {row.call * 1e6:.0f} us |'
            )
    return '\n'.join(lines)


def beyond_promise(rows: Sequence[GroundRow]) -> str:
    """Markdown list: where over a hundredth of shots is further off than a preset promises."""
    lines = [
        f'- {row.setting}, {row.strike} on {row.ground}: {row.rest_most:.1e} m instead of '
        f'{ACCURACY[row.setting].rest:g} m, the worst {row.rest_worst:.1e} m.'
        for row in rows
        if row.setting in ACCURACY and row.rest_most > ACCURACY[row.setting].rest
    ]
    return '\n'.join(lines) or 'There was none in this run.'


def left_out(rows: Sequence[GroundRow]) -> int:
    """Find how many shots of a volley the reference did not bring to an end, at most."""
    return SHOTS - min(row.shots for row in rows)


def best_at(rows: Sequence[ScipyRow], level: float) -> ScipyRow | None:
    """Fastest of `rows` that is exact to `level` [m]; None where none is."""
    return min((row for row in rows if row.error <= level), key=lambda r: r.time, default=None)


def duels(
    rows: Sequence[ScipyRow],
) -> list[tuple[str, str, float, ScipyRow | None, ScipyRow | None]]:
    """Scene, end, level [m] and the fastest of this package's rows and of scipy's there."""
    found = []
    for scene, end in dict.fromkeys((row.scene, row.end) for row in rows):
        own = [row for row in rows if (row.scene, row.end) == (scene, end)]
        ours = [row for row in own if row.method == OURS]
        theirs = [row for row in own if row.method != OURS]
        found += [
            (scene, end, level, best_at(ours, level), best_at(theirs, level)) for level in DECADES
        ]
    return found


def scipy_table(rows: Sequence[ScipyRow]) -> str:
    """Markdown table: this package and scipy at equal error, a line a level."""
    lines = [
        "| scene | to the | error at most | here | setting | scipy's best | setting | scipy over "
        'here |',
        '|---|---|---|---|---|---|---|---|',
    ]
    for scene, end, level, mine, other in duels(rows):
        cells = [scene, end, f'{level:.0e} m']
        for row in (mine, other):
            cells += [f'{row.time * 1e6:.4g} us', setting_of(row)] if row else ['-', '-']
        cells.append(f'{other.time / mine.time:.0f} x' if mine and other else '-')
        lines.append('| ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines)


def setting_of(row: ScipyRow) -> str:
    """Return the setting of a row, with the method where it is scipy's."""
    return row.setting if row.method == OURS else f'{row.method.split()[-1]}, {row.setting}'


def least_ratios(rows: Sequence[ScipyRow]) -> str:
    """Markdown list: scipy's time over this package's, least and most of all levels."""
    ratios: dict[tuple[str, str], list[float]] = {}
    for scene, end, _, mine, other in duels(rows):
        if mine and other:
            ratios.setdefault((scene, end), []).append(other.time / mine.time)
    return '\n'.join(
        f'- {scene}, to the {end}: {min(some):.0f} to {max(some):.0f} times.'
        for (scene, end), some in ratios.items()
    )


def report_costs(rows: Sequence[Row]) -> str:
    """Markdown list: what the report's choices cost in each scene."""
    lines = []
    for row in rows:
        if row.method == 'report_2019':
            touch = (
                f'first touch {row.touch_error:.2g} m off, ' if isfinite(row.touch_error) else ''
            )
            lines.append(f'- {row.scene}: {touch}rest {row.rest_error:.2g} m off.')
    return '\n'.join(lines)


def effect_table(rows: Sequence[EffectRow]) -> str:
    """Markdown table: what each effect costs, and how far off the shot ends without it."""
    lines = [
        '| scene | without | first touch elsewhere by | rest elsewhere by | time saved |',
        '|---|---|---|---|---|',
    ]
    for row in rows:
        moved = (f'{e:.2g} m' if isfinite(e) else '-' for e in (row.touch_moved, row.rest_moved))
        lines.append(
            f'| {row.scene} | {row.effect} | ' + ' | '.join(moved) + f' | {row.saved:.0f} % |'
        )
    return '\n'.join(lines)


def dispensable(rows: Sequence[EffectRow]) -> str:
    """Markdown list: effects that a scene can do without.

    Without them the ball rests within a centimetre of where it would.
    """
    lines = []
    for scene in dict.fromkeys(row.scene for row in rows):
        own = [row for row in rows if row.scene == scene and row.rest_moved <= CENTIMETRE]
        if own:
            lines.append(
                f'- {scene}: ' + ', '.join(f'{row.effect} ({row.rest_moved:.1g} m)' for row in own)
            )
    return '\n'.join(lines)


def tick_table(rows: Sequence[TickRow]) -> str:
    """Markdown table: error over the tick rate, a line a scene and an accuracy."""
    rates = list(dict.fromkeys(row.rate for row in rows))
    lines = [
        '| scene | accuracy | ' + ' | '.join(f'{rate:g} Hz' for rate in rates) + ' |',
        '|---|---|' + '---|' * len(rates),
    ]
    for scene, accuracy in dict.fromkeys((row.scene, row.accuracy) for row in rows):
        own = {
            row.rate: row.rest_error
            for row in rows
            if (row.scene, row.accuracy) == (scene, accuracy)
        }
        lines.append(
            f'| {scene} | {accuracy} | '
            + ' | '.join(f'{own[rate]:.2e} m' for rate in rates)
            + ' |'
        )
    return '\n'.join(lines)


def spread(rows: Sequence[TickRow]) -> float:
    """Find how much [m] a preset's error differs at most between tick rates, in one scene."""
    kept: dict[tuple[str, str], list[float]] = {}
    for row in rows:
        if row.accuracy in ACCURACY:
            kept.setdefault((row.scene, row.accuracy), []).append(row.rest_error)
    return max(max(errors) - min(errors) for errors in kept.values())


def tick_costs(rows: Sequence[TickRow]) -> str:
    """Markdown table: share of a core for a simulated second at `standard`, by tick rate."""
    own = [row for row in rows if row.accuracy == 'standard']
    lines = ['| scene | ticks a second | of a core in real time |', '|---|---|---|']
    lines += [f'| {row.scene} | {row.rate:g} | {100 * row.time:.3f} % |' for row in own]
    return '\n'.join(lines)


def size_table(rows: Sequence[SizeRow]) -> str:
    """Markdown table: time of one play, and for each of what is counted."""
    lines = ['| what | how many | time of a play | for each |', '|---|---|---|---|']
    lines += [
        f'| {row.what} | {row.count} | {1e6 * row.time:.0f} us '
        f'| {1e6 * row.time / row.count:.3g} us |'
        for row in rows
    ]
    return '\n'.join(lines)


def wind_table(rows: Sequence[WindRow]) -> str:
    """Markdown table of wind fields against better ones."""
    lines = [
        '| field | air at 2 m | at 10 m | landing, mean | at most | cells | a direction |',
        '|---|---|---|---|---|---|---|',
    ]
    lines += [
        f'| {row.what} | {row.low:.1%} | {row.high:.1%} | {row.landing:.2f} m | '
        f'{row.farthest:.2f} m | {row.cells} | {row.time:.1f} s |'
        for row in rows
    ]
    return '\n'.join(lines)
