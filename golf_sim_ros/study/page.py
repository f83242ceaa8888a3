# SPDX-License-Identifier: Apache-2.0
"""The page that tells what accuracy costs: figure, tables, and what they mean."""
import csv
from math import isfinite
import platform

import numpy as np

from ..physics import ACCURACY
from .measure import Row

STYLE = {
    'euler': ('tab:red', 'semi-implicit Euler'), 'rk4': ('tab:orange', 'RK4'),
    'dormand_prince': ('tab:blue', 'Dormand-Prince'),
    'scipy RK45': ('tab:gray', 'scipy RK45, flight only'),
    'scipy DOP853': ('black', 'scipy DOP853, flight only')}
OURS = ('euler', 'rk4', 'dormand_prince')
LEVELS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8)  # m
LEAST = 1e-13  # m: errors below are rounding, drawn here


def write_csv(rows, path):
    """Write all rows, with their field names, to a CSV file."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(Row._fields)
        writer.writerows(rows)


def draw(rows, path):
    """Draw time against error, a panel a scene and a line a method, to a PNG file."""
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
    scenes = list(dict.fromkeys(row.scene for row in rows))
    figure, panels = pyplot.subplots(2, (len(scenes) + 1) // 2, figsize=(11, 8.5), layout='constrained')
    for panel, scene in zip(panels.flat, scenes):
        draw_scene(panel, [row for row in rows if row.scene == scene])
    handles = {}
    for panel in panels.flat:
        handles.update(dict(zip(*reversed(panel.get_legend_handles_labels()))))
    figure.legend(handles.values(), handles.keys(), loc='outside lower center', ncols=4, frameon=False)
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def draw_scene(panel, rows):
    """Draw one scene's rows."""
    flies = any(isfinite(row.touch_error) for row in rows)
    what = 'touch_error' if flies else 'rest_error'
    for method, (color, label) in STYLE.items():
        line = [(max(getattr(r, what), LEAST), r.time * 1e6) for r in rows if r.method == method]
        if line:
            panel.plot(*zip(*line), 'o-', color=color, label=label, markersize=3, linewidth=1)
    for preset, marker in zip(ACCURACY, 'v*D'):
        row = next(r for r in rows if r.method == 'preset' and r.setting == preset)
        panel.plot(max(getattr(row, what), LEAST), row.time * 1e6, marker, color='tab:green', markersize=10,
                   label=f'preset {preset}', linestyle='none')
    for row in rows:
        if row.method == 'report_2019':
            panel.plot(getattr(row, what), row.time * 1e6, 'X', color='tab:purple', markersize=9,
                       label='the report of 2019', linestyle='none')
    panel.set(xscale='log', yscale='log', title=rows[0].scene, ylabel='time of a shot [us]',
              xlabel=f'error at {"first touch" if flies else "rest"} [m]')
    panel.invert_xaxis()
    panel.grid(alpha=0.3)


def seconds_at(rows, method, level):
    """Least time [s] of a method's settings that are exact to `level` [m] at first touch, or None."""
    fit = [row.time for row in rows if row.method == method and row.touch_error <= level]
    return min(fit, default=None)


def equal_error_table(rows):
    """Markdown table: time at equal error of each integrator, over that of Dormand-Prince."""
    lines = ['| scene | error at most | Dormand-Prince | RK4 | Euler | scipy RK45 | scipy DOP853 |',
             '|---|---|---|---|---|---|---|']
    for scene in dict.fromkeys(row.scene for row in rows if isfinite(row.touch_error)):
        own = [row for row in rows if row.scene == scene]
        for level in LEVELS:
            base = seconds_at(own, 'dormand_prince', level)
            if base:
                others = (seconds_at(own, m, level) for m in ('rk4', 'euler', 'scipy RK45', 'scipy DOP853'))
                cells = ('-' if t is None else f'{t / base:.3g} x' for t in others)
                lines.append(f'| {scene} | {level:.0e} m | {base * 1e6:.0f} us | ' + ' | '.join(cells) + ' |')
    return '\n'.join(lines)


def exceptions(rows):
    """Sentences about where Dormand-Prince is not the fastest at equal error."""
    found = []
    for scene in dict.fromkeys(row.scene for row in rows if isfinite(row.touch_error)):
        own = [row for row in rows if row.scene == scene]
        for level in LEVELS:
            base = seconds_at(own, 'dormand_prince', level)
            for other, label in (('rk4', 'RK4'), ('euler', 'Euler')):
                time = seconds_at(own, other, level)
                if base and time and time < base:
                    found.append(f'- {scene}, {level:.0e} m: {label} took {time / base:.2f} of the time.')
    return '\n'.join(found) or 'There was none in this run.'


def full_table(rows):
    """Markdown table of all rows."""
    lines = ['| scene | method | setting | first touch off by | rest off by | time of a shot | compiling |',
             '|---|---|---|---|---|---|---|']
    for row in rows:
        errors = (f'{e:.1e} m' if isfinite(e) else '-' for e in (row.touch_error, row.rest_error))
        lines.append(f'| {row.scene} | {row.method} | {row.setting} | ' + ' | '.join(errors)
                     + f' | {row.time * 1e6:.1f} us | {row.compiled:.1f} s |')
    return '\n'.join(lines)


def preset_table(rows):
    """Markdown table of the presets: promise, worst of the study, time."""
    lines = ['| preset | promises, first touch and rest | worst here | time of a shot | for |',
             '|---|---|---|---|---|']
    use = {'sketch': 'watching many shots at once', 'standard': 'playing', 'reference': 'research'}
    for name, preset in ACCURACY.items():
        own = [row for row in rows if row.method == 'preset' and row.setting == name]
        touch, rest = (np.nanmax([getattr(r, e) for r in own]) for e in ('touch_error', 'rest_error'))
        times = [row.time * 1e6 for row in own]
        lines.append(f'| {name} | {preset.touch:g} m, {preset.rest:g} m | {touch:.1e} m, {rest:.1e} m '
                     f'| {min(times):.0f} to {max(times):.0f} us | {use[name]} |')
    return '\n'.join(lines)


def report_costs(rows):
    """Markdown list: what the report's choices cost in each scene."""
    lines = []
    for row in rows:
        if row.method == 'report_2019':
            touch = f'first touch {row.touch_error:.2g} m off, ' if isfinite(row.touch_error) else ''
            lines.append(f'- {row.scene}: {touch}rest {row.rest_error:.2g} m off.')
    return '\n'.join(lines)


def write_page(rows, path, picture, table, command):
    """Write the Markdown page that shows the figure and says what it means."""
    path.write_text(PAGE.format(
        command=command, picture=picture, table=table, machine=platform.machine(),
        python=platform.python_version(), presets=preset_table(rows), equal=equal_error_table(rows),
        exceptions=exceptions(rows), report=report_costs(rows), rows=full_table(rows)), encoding='utf-8')


PAGE = """# What accuracy costs

Made by `{command}` on {machine}, Python {python}; do not edit. Errors are distances from a far tighter
reference; times are medians for one whole shot, flight to rest, in a batch, on one thread. Compare times
within this page only: machines differ, ratios less so.

![time against error]({picture})

Each line is a method over its dial, more exact to the right; lower is faster. scipy flies to the first
touch only, everything else plays to the rest. The rows are in [{table}]({table}).

## Which preset for what

{presets}

A putt costs little and is exact in every preset: rolling on a plane is in closed form. Where the ground
is hard and bounces are many, an error of the flight grows with every bounce, so the rest is less exact
than the first touch.

## At equal error

Least time of any setting that is exact enough at first touch, as a multiple of Dormand-Prince's:

{equal}

Where Dormand-Prince was not the fastest:

{exceptions}

Where RK4 comes close or wins, flights are so smooth that a fixed step loses nothing: five evaluations a
step against seven, and no error estimate. But nothing tells RK4 which step a scene needs; gusts make it
thousands of times less exact at the same step. Euler is first order and needs steps far below a
millisecond for a centimetre.

## The model of the report of 2019

Linear drag, wind as a force that grows with height, a percentage of spin lost at every bounce, sand that
swallows everything, semi-implicit Euler at 50 Hz with push-out (`golf_sim_ros/physics/report_2019.py`).
What that costs against the model here:

{report}

Linear drag is right at one speed only: too weak for a driver, too strong for a pitch. Friction without
torque never makes a ball roll, so it skids until it stops. Push-out at 50 Hz lets a drive sink half a
metre into the ground before it is noticed, and gives back energy that the impact had taken.

## All rows

{rows}
"""
