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

"""Page on what accuracy costs: figures, tables, and what they mean."""

from collections.abc import Callable, Sequence
import csv
from pathlib import Path
import platform
from typing import Any

from . import figures, tables


def write(found: dict[str, list], folder: Path, command: str) -> None:
    """Write page, figures and rows of a study into a folder.

    Parameters
    ----------
    found : dict of str to list
        Rows by 'methods' and 'promises', and of a full study by the other names of `SECTIONS`.
    folder : pathlib.Path
    command : str
        What made them.
    """
    for part, rows in found.items():
        stem = NAMES[part]
        write_csv(rows, folder / f'{stem}.csv')
        if part in DRAW:
            DRAW[part](rows, folder / f'{stem}.png')
    text = ''.join(
        section.format(**facts(part, found[part]))
        for part, section in SECTIONS.items()
        if part in found
    )
    all_rows = ROWS.format(rows=tables.full_table(found['methods']))
    head = HEAD.format(
        command=command, machine=platform.machine(), python=platform.python_version()
    )
    (folder / 'accuracy.md').write_text(head + text + all_rows, encoding='utf-8')


def write_csv(rows: Sequence[Any], path: Path) -> None:
    """Write rows, with their field names, to a CSV file."""
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.writer(file, lineterminator='\n')
        writer.writerow(rows[0]._fields)
        writer.writerows(rows)


def facts(part: str, rows: Sequence[Any]) -> dict[str, Any]:
    """Values that a section's text leaves open, by name."""
    made: dict[str, dict[str, Callable[[Sequence[Any]], Any]]] = {
        'grounds': {
            'table': tables.ground_table,
            'beyond': tables.beyond_promise,
            'left_out': tables.left_out,
        },
        'methods': {
            'presets': tables.preset_table,
            'equal': tables.equal_error_table,
            'exceptions': tables.exceptions,
            'report': tables.report_costs,
        },
        'scipy': {'table': tables.scipy_table, 'ratios': tables.least_ratios},
        'promises': {'table': tables.promise_table},
        'effects': {'table': tables.effect_table, 'dispensable': tables.dispensable},
        'ticks': {'table': tables.tick_table, 'costs': tables.tick_costs, 'spread': tables.spread},
        'sizes': {'table': tables.size_table},
        'wind': {'table': tables.wind_table},
    }
    return {name: make(rows) for name, make in made[part].items()}


NAMES = {
    'grounds': 'accuracy_grounds',
    'methods': 'accuracy',
    'scipy': 'accuracy_scipy',
    'promises': 'accuracy_promises',
    'effects': 'accuracy_effects',
    'ticks': 'accuracy_ticks',
    'sizes': 'accuracy_sizes',
    'wind': 'accuracy_wind',
}
DRAW: dict[str, Callable[[Sequence[Any], Path], None]] = {
    'grounds': figures.draw_grounds,
    'methods': figures.draw,
    'effects': figures.draw_effects,
    'ticks': figures.draw_ticks,
    'sizes': figures.draw_sizes,
}

HEAD = """# What accuracy costs

Made by `{command}` on {machine}, Python {python}; do not edit. Errors are distances from a far
tighter reference. The time of a shot is a slope, that of many shots less that of few, from the
strike to rest, in a batch, on one thread, the median of several; what a call costs by itself is
told apart. Scipy's is that of whole plays. Compare times within this page only: machines differ,
ratios less so.
"""

GROUNDS = """
## Cost over error, by kind of ground

![time against error by kind of ground](accuracy_grounds.png)

Drives, chips (12 m/s, 30 degrees) and putts (4 m/s), 500 of each, all a little different (5 % in
speed, 3 degrees in direction), on

- plane: a level fairway;
- patches: `golf_without_friends`, planes with outlines, with bunkers and a pond;
- height map: `links`, dunes;
- mesh of hills: fairway, gentle hills of 20,000 triangles, 120 m wide, for drives 700 m;
- height map of hills: the same heights as those triangles have at their corners, smooth between.

Each line is Dormand-Prince over its tolerance, from 1 m to 1e-10 m, more exact to the right; the
limits of contacts, how far a path may be off and from when bounces are summed, go with it. The
thick line is the median error at rest, the thin one the 99th percentile.

{table}

Grounds are timed in turns. A call for one is `simulate_many` for a single shot: most of it makes
the world and depends on the course, little on the preset.

On curved ground and over edges the rest is less exact than on a plane: a ball that is a little off
meets another slope, another triangle, or a border that it just misses. The presets promise the
rest of every shot on level ground, and of 99 in 100 on height maps. Here, patches and the mesh
included, more were further off with:

{beyond}

Shots that the reference did not bring to an end are left out, of a volley {left_out} at most. The
rows are in [accuracy_grounds.csv](accuracy_grounds.csv), with the worst shots.
"""

METHODS = """
## Cost over error, by scene and method

![time against error](accuracy.png)

Each line is a method over its dial, more exact to the right; lower is faster. Panels whose errors
are at first touch have the same scales, and so have those at rest. scipy flies to the first touch
only, everything else plays to the rest. The rows are in [accuracy.csv](accuracy.csv).

## Which preset for what

{presets}

- Watching: `sketch`. Nobody sees the difference on a screen.
- Playing: `standard`. A ball that is a centimetre off is within what a real one would be, hit
  twice.
- Research: `reference`, where differences of shots are looked at, or another method is judged.

The promises are for still air, on level ground and, for 99 in 100 shots, on height maps; a scene
in gusts, or of several strokes, is allowed more. A putt on a plane green is exact in every preset:
rolling there is in closed form. Where the ground is hard and bounces are many, an error of the
flight grows with every bounce, so the rest is less exact than the first touch. Where balls hit
many others, it grows so fast that no preset foretells for long who ends where.

## At equal error

Least time of any setting that is exact enough at first touch, as a multiple of Dormand-Prince's:

{equal}

Where Dormand-Prince was not the fastest:

{exceptions}

RK4 takes five evaluations a step against seven, with no error estimate: where a flight is smooth,
its fixed step loses nothing. But nothing tells RK4 which step a scene needs. Euler is first order
and needs steps far below a millisecond for a centimetre.

## The model of the report of 2019

Linear drag, wind as a force that grows with height, a percentage of spin lost at every bounce,
sand that swallows everything, semi-implicit Euler at 50 Hz with push-out
(`golf_sim_ros/physics/baselines/report_2019.py`). What that costs against the model here:

{report}

Linear drag is right at one speed only: too weak for a driver, too strong for a pitch. Friction
without torque never makes a ball roll, so it skids until it stops. Push-out at 50 Hz lets a drive
sink half a metre into the ground before it is noticed, and gives back energy that the impact had
taken.
"""

SCIPY = """
## Against scipy, like with like

`solve_ivp` of scipy, RK45 or DOP853, flies under the same forces, in scalar Python
(`golf_sim_ros/study/scipy_flight.py`), one shot at a time; this package flies a batch. Both do the
same:

- To the first touch: here onto ground on which what lands stops dead, so that nothing of a shot
  is left to play.
- To the last impact, of shots that bounce: scipy starts anew at each impact, from where this
  package's law of impact lets the ball off, in plain Python, up to the last impact of over 0.2
  m/s. This package plays the whole shot, which is more, slower bounces and the way to rest too.

The error is that of the touch that is farthest off, against a far tighter reference. Scipy's time
over that here, over error levels from 1 m to 1e-9 m:

{ratios}

At each level the fastest of 27 tolerances here, from 1 m to 1e-13 m, and the fastest of 25 `rtol`
of each of scipy's methods, from 1e-1 to 1e-13, with `atol` the same:

{table}

The rows are in [accuracy_scipy.csv](accuracy_scipy.csv).
"""

PROMISES = """
## What the presets promise, tried

Random shots in still air: 5 to 90 m/s, 2 to 60 degrees high, spin up to 1000 rad/s about any axis,
on a level fairway and on the height map of `links`. Off from a far tighter reference, and how many
are beyond what is promised:

{table}

On level ground the promises are of every shot. On relief they are of 99 in 100: where a ball
grazes a crest, or stops just short of a border or a slope, the least error decides where it goes.
Facets of a mesh scatter balls that bounce on them, so nothing is promised there.
"""

EFFECTS = """
## What an effect costs, and what a scene is without it

![each effect's cost](accuracy_effects.png)

Each scene once more, at `standard`, without one of its effects; timed in turns with the whole.
What is saved can be negative: a ball that drag does not brake flies and bounces for longer.

{table}

Without these a ball rests within a centimetre of where it would:

{dispensable}

`effects: auto` goes further where it is certain: it leaves out what the scene has no cause for, so
that nothing moves at all. Of several balls it is the one that moved farthest that is told.
"""

TICKS = """
## Error against tick rate

![error against tick rate](accuracy_ticks.png)

The rest, by how often the play is looked at. Steps end at events, never at ticks, so a preset's
error is the same at every rate: over all rates here it differs by {spread:.1e} m at most. Where
the step is the tick, the error falls with the rate, and stays large.

{table}

What ticks cost, called from Python one by one, without ROS:

{costs}
"""

SIZES = """
## Time against balls, triangles, contacts

![time against sizes](accuracy_sizes.png)

Balls: as many 7 irons hit at once, side by side, to the last one's rest, with impacts among them
looked for. Triangles: a ball that bounces and rolls through the same hills, made of ever finer
triangles. Contacts: a ball hits a row of as many that touch, all of which push at one instant.

{table}
"""

WIND = """
## Wind fields

Fields of `tall_pines`, a par 3 between trees, in 8 m/s into four directions: levels of accuracy,
each solved for in these directions, against `reference`; and fields of several directions,
blended, against those of the very direction. The difference of the air at 2 and 10 m over the
ground is over the wind far upstream; a driver, a 7 iron and two wedges come down so far apart,
trees apart.

{table}

[wind.md](wind.md) says which level is for what.
"""

ROWS = """
## All rows

{rows}
"""

SECTIONS = {
    'grounds': GROUNDS,
    'methods': METHODS,
    'scipy': SCIPY,
    'promises': PROMISES,
    'effects': EFFECTS,
    'ticks': TICKS,
    'sizes': SIZES,
    'wind': WIND,
}
