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

"""Write docs/validation.md and docs/validation.png: flights and coefficients against tables.

    .venv/bin/python tools/validate.py

plays every table of test/data by every law of flight, some 150 shots six times, in plain Python or
compiled code: a minute or two. The numbers are this machine's; tests hold the budgets by club.
"""

from pathlib import Path

from fit_aerodynamics import DATA, is_held_out, MEASURED, point_errors, spread, UNCERTAIN
from golf_sim_ros.comparison.errors import compare, figures, LAWS
from golf_sim_ros.physics.effects.drag import DragLaw
from golf_sim_ros.physics.effects.magnus import LiftLaw
from golf_sim_ros.shot_input.monitor_file import read_monitor_file
from golf_sim_ros.shot_input.units import UNITS
import matplotlib
from matplotlib import pyplot as plt
import numpy as np

DOCS = Path(__file__).parents[1] / 'docs'
TABLES = {
    'trackman_pga_2010s': 'PGA Tour, 2010s',
    'trackman_pga_2023': 'PGA Tour, 2023',
    'trackman_driver_chart_2010_aoa0': 'driver chart 2010',
    'trackman_6iron_calm': '6 iron, calm',
    'trackman_model_bins': "TrackMan's model, bins",
    'flightscope_launches': "FlightScope's model",
}
PGA = ('trackman_pga_2010s', 'trackman_pga_2023')
BINS = 'trackman_model_bins'
GOLF = UNITS['golf']
SHOWN = figures(GOLF)
# Errors that a club may have, the worse of the two tables: carry [yd], apex [yd], landing angle
# [deg]. A table's rows are averages, of which a shot with the average launch differs by 2 to 5 yd.
BUDGETS = {
    'Driver': (3.5, 3.0, 3.0),
    '3-wood': (8.0, 3.0, 3.5),
    '5-wood': (5.0, 3.0, 5.0),
    'Hybrid': (5.5, 3.0, 5.5),
    '3 Iron': (4.0, 3.0, 6.5),
    '4 Iron': (3.0, 3.0, 7.0),
    '5 Iron': (2.5, 3.5, 6.5),
    '6 Iron': (3.0, 3.0, 5.0),
    '7 Iron': (5.0, 2.0, 4.0),
    '8 Iron': (4.0, 2.0, 3.0),
    '9 Iron': (3.0, 3.0, 2.5),
    'PW': (6.0, 4.0, 2.5),
}
TEXT = """# Validation

Made by `.venv/bin/python tools/validate.py`, which plays every table of `test/data/` and writes
this page and its picture. The files say where their numbers are from. A shot is flown from the
launch that its row tells, in still air of 25 degrees Celsius at sea level: none of the tables says
in what air it was.

**What is held out.** The third, sixth, ... row of every file is not shown to the fit
(`is_held_out` in `tools/fit_aerodynamics.py`). Errors of rows that were fitted and of rows that
were held out stand apart. What the rows weigh was chosen by looking at all of them: the held-out
rows are new to the parameters, not to that choice. The laws by name are as published, and were
fitted to none of this.

**What these tables are.** The tours' averages are of many real shots: the flight of the average
launch is not the average flight, by 2 to 5 yd, and the conditions are not told. The chart, the
bins and FlightScope's launches are models of two makers of launch monitors, who see the first
metres and compute the rest. They differ from each other by 2 to 6 yd at like launches, and from
the tours' averages by more: TrackMan's model carries the launch of the tour's 3-wood 7 to 8 yd
farther than its average. Where this simulation is within that, nothing here says which is right.
`compare_shots` ([tools.md](tools.md)) makes such tables of your own shots.

![Errors of the carry over the spin ratio, and by club](validation.png)

## The law of flight, by table

Bias and root mean square of simulated less told: rows that were fitted, then rows that were held
out.

{tables}

## By spin ratio at launch

All rows of the bins: bias and root mean square.

{bands}

## By club

The law's error in both of the tour's tables, 2010s and 2023, and the budget that
`test/comparison/test_validation.py` holds it to.

{clubs}

## Laws side by side

Mean absolute error over all rows of a table: carry [yd], apex [yd], landing angle [deg].

{laws}

`linear` is F = -c v with the default lift.

## Wind-tunnel points

Bias and root mean square of the coefficients in thousandths. The old balls, Bearman and Harvey's
and Naruo's, have more drag than balls of today where both were measured; a sphere is what golf
balls below the crisis are expected to be like.

{points}
"""


def errors_of(name, laws):
    """`Comparison` of a table with laws, and its clubs."""
    shots = read_monitor_file(DATA / f'{name}.csv')
    return compare(shots, laws, GOLF), shots.clubs


def figures_table(found):
    """Markdown table: the law's errors by file, fitted and held-out rows apart."""
    lines = [
        '| table | rows | ' + ' | '.join(f'{name} [{unit.name}]' for name, unit in SHOWN) + ' |',
        '|---|---|---|---|---|---|',
    ]
    for name, title in TABLES.items():
        errors = found[name].errors['fitted']
        held = is_held_out(errors.shape[1])
        for label, mask in (('fitted', ~held), ('held out', held)):
            if mask.any():
                cells = [spread(row[mask] / unit.size) for row, (_, unit) in zip(errors, SHOWN)]
                lines.append(f'| {title} | {mask.sum()} {label} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def bands_table(comparison):
    """Markdown table: the errors in bands of the spin ratio."""
    errors = comparison.errors['fitted']
    lines = [
        '| spin ratio | rows | carry [yd] | apex [yd] | landing angle [deg] | flight time [s] |',
        '|---|---|---|---|---|---|',
    ]
    for label, mask in comparison.groups['spin ratio']:
        cells = [spread(row[mask] / unit.size) for row, (_, unit) in zip(errors, SHOWN)]
        lines.append(f'| {label} | {mask.sum()} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def club_errors(found):
    """Errors by club, (2, 3): both tables; carry [yd], apex [yd], landing angle [deg]."""
    units = np.array([unit.size for _, unit in SHOWN[:3]])[:, None]
    both = [found[name].errors['fitted'][:3] / units for name in PGA]
    return dict(zip(BUDGETS, np.transpose(both, (2, 0, 1))))


def clubs_table(found):
    """Markdown table: errors and budgets by club."""
    lines = ['| club | carry [yd] | budget | apex [yd] | budget | landing angle [deg] | budget |']
    lines.append('|---|---|---|---|---|---|---|')
    for club, errors in club_errors(found).items():
        cells = [
            f'{old:+.1f}, {new:+.1f} | {budget:g}'
            for (old, new), budget in zip(errors.T, BUDGETS[club])
        ]
        lines.append(f'| {club} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def laws_table(found):
    """Markdown table: mean absolute errors of every law in every table."""
    lines = [f'| table | {" | ".join(LAWS)} |', '|---' * (1 + len(LAWS)) + '|']
    for name, title in TABLES.items():
        cells = []
        for errors in found[name].errors.values():
            means = [
                f'{np.nanmean(np.abs(row)) / unit.size:.2f}'
                for row, (_, unit) in zip(errors[:3], SHOWN)
                if np.isfinite(row).any()
            ]
            cells.append(', '.join(means))
        lines.append(f'| {title} | {" | ".join(cells)} |')
    return '\n'.join(lines)


def points_table():
    """Markdown table: errors of the coefficients by source, fitted and held-out points apart."""
    drag, lift = 1000.0 * point_errors((DragLaw(), LiftLaw()))
    lines = ['| source | points | drag | lift |', '|---|---|---|---|']
    for source in UNCERTAIN:
        here = MEASURED.source == source
        for label, mask in (('fitted', ~MEASURED.held_out), ('held out', MEASURED.held_out)):
            mask = mask & here
            cells = f'{spread(drag[mask])} | {spread(lift[mask])}'
            lines.append(f'| {source} | {mask.sum()} {label} | {cells} |')
    return '\n'.join(lines)


def draw(found):
    """Draw the carry's errors: over the spin ratio in every table, and by club."""
    from golf_sim_ros.drawing.style import bare, colors

    matplotlib.use('Agg')
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.4), constrained_layout=True)
    for (name, title), color in zip(TABLES.items(), colors(len(TABLES))):
        comparison = found[name]
        off = comparison.errors['fitted'][0] / GOLF.length.size
        held = is_held_out(len(off))
        left.plot(comparison.ratios[~held], off[~held], '.', color=color, label=title)
        left.plot(comparison.ratios[held], off[held], 'o', mfc='none', ms=5, color=color)
    for name, color in zip(PGA, colors(2)):
        off = found[name].errors['fitted'][0] / GOLF.length.size
        right.plot(off, 'o-', ms=4, color=color, label=TABLES[name])
    budget = [carry for carry, *_ in BUDGETS.values()]
    right.step(range(len(budget)), budget, 'k:', where='mid', lw=0.8, label='budget')
    right.step(range(len(budget)), np.negative(budget), 'k:', where='mid', lw=0.8)
    right.set_xticks(range(len(BUDGETS)), list(BUDGETS), rotation=50, fontsize=8)
    for axes in (left, right):
        axes.axhline(0.0, color='k', lw=0.5)
        axes.legend(frameon=False, fontsize=7)
    bare(left, 'carry: simulated less told; rings were held out', 'spin ratio at launch', 'yd')
    bare(right, "the tour's clubs", '', 'yd')
    figure.savefig(DOCS / 'validation.png', dpi=90)


def main():
    """Play everything and write the page."""
    found = {name: errors_of(name, list(LAWS))[0] for name in TABLES}
    page = TEXT.format(
        tables=figures_table(found),
        bands=bands_table(found[BINS]),
        clubs=clubs_table(found),
        laws=laws_table(found),
        points=points_table(),
    )
    (DOCS / 'validation.md').write_text(page, encoding='utf-8')
    draw(found)
    print(DOCS / 'validation.md')


if __name__ == '__main__':
    main()
