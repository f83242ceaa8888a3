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

"""Make docs/wind.md with its tables and pictures: ``python tools/make_wind_page.py``.

Some minutes; needs numba and matplotlib. The table of accuracy is that of docs/accuracy_wind.csv,
which `accuracy_study` writes.
"""

import csv
from math import log2
from pathlib import Path
import sys

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from golf_sim_ros.course import load_course  # noqa: E402
from golf_sim_ros.course.course_file import shipped_courses  # noqa: E402
from golf_sim_ros.course.material_file import materials, shipped  # noqa: E402
from golf_sim_ros.drawing.wind_field import draw_field  # noqa: E402
from golf_sim_ros.physics import Course, Plane, simulate_many  # noqa: E402
from golf_sim_ros.study.tables import wind_table  # noqa: E402
from golf_sim_ros.study.wind_fields import WindRow  # noqa: E402
from golf_sim_ros.wind import Gusts, GustSettings, verification, WindField  # noqa: E402
import numpy as np  # noqa: E402

DOCS = ROOT / 'docs'
PICTURES = {'links': 0.0, 'tall_pines': 1.57}  # course, and direction of the wind [rad]
DRIVE = (73.3, 0.0, 14.1), (0.0, -281.0, 0.0)
SPEED, INTENSITY = 8.0, 0.145
SEEDS, DRIVES = 20, 100
WINDS = {'tail': 0.0, 'head': np.pi, 'cross': 0.5 * np.pi}
BLOWN, EVERY = 8.0, 0.1  # s of gusts that a drive flies through, one after the other

PAGE = """# Wind over uneven ground, and its turbulence

Made by `python tools/make_wind_page.py`; do not edit.

Over level ground the wind grows with the logarithm of the height, and that is what blows on a
course that says no more. Over dunes, in the lee of trees and above a pond it does not. A **wind
field** is the steady wind over one course, solved for beforehand from the Navier-Stokes equations
in several directions; live gusts scale it and turn it. **Turbulence** is a box of eddies that it
carries along. Either works without the other.

![wind over links](wind_links.webp)

## To have one

```sh
wind_field my_course.yaml -o my_wind.npz --plot      # 16 directions; a minute or two on one core
```

and in `my_course.yaml`:

```yaml
wind_field: my_wind.npz
```

`sim_node` then flies balls through it, without another parameter. `links` and `tall_pines` come
with fields. The command says how far it is; Ctrl-C keeps the directions that are done, and the
same command goes on. Solving needs numba; flying through a field does not. A field is of its
ground, water, trees and roughness: where one of them changes, the course is refused until the
field is made anew. What balls meet and the wind does not, as restitution or the tee, may change.

What the wind feels of a course, besides its ground:

- `roughness` of materials [m], the roughness length z0: 0.002 of a green to 0.03 of rough; where
  a material has none, that of the course's `wind_profile`, which is also that far upstream;
- `canopy_drag` of the material of obstacles [1/m]: leaf-area density times drag coefficient, 0.1
  to 0.5 for trees in leaf. `drag` of the same material brakes balls, and only them. Trunks do
  nothing.

In Python:

```python
from golf_sim_ros.course import load_course
from golf_sim_ros.wind import solve

field = solve(load_course('links'), directions=4, accuracy='sketch')
field.save('links.npz')
print(field.velocity([[346.0, 9.0, 5.0]], (8.0, 0.0, 0.0)))  # m/s
```

`velocity` takes places [m] and the wind 10 m over level ground far upstream [m/s].

## Which level for what

{accuracy}

Of `tall_pines`, in 8 m/s, against `reference` in the very direction, and against the very
direction; made by `accuracy_study`. `mass` is the first projection of the profile alone: a
mass-consistent model, quick, without lees, and trees do nothing. `sketch` shows where lees are.
`standard` is what to play with. `reference` is what the others are measured by. Sixteen
directions are as good as the level; eight do where there are few trees.

## How far to believe it

{verification}

The commands: `python -m golf_sim_ros.wind.verification taylor_green`, `cavity`, `ridge`, `hill`,
`flat`, `trees`. The solver converges over slopes of 1, cliffs, pits and dense trees; where a flow
does not come to rest, that is an error, never a field.

What it can't know: lees are the weak point of a closure with a mixing length (reversed flow
behind slopes over 0.5 is too short or too long by a good part); what is smaller than a cell (4 to
9 m on a hole) is seen as a mean; the air is neutral, so neither a sea breeze nor a calm evening
is in it; buildings and trunks do nothing.

## The equations

Steady, incompressible, Reynolds-averaged: div u = 0; u . grad u = -grad p + div(nu_t grad u) - Cd
a |u| u in trees. nu_t = Cmu^(1/4) l sqrt(k), with one equation for k; l = kappa (z + z0), in
trees at most 2 (0.3)^3 / (Cd a); k is made by shear, and in trees by Cd a |U|^3, and goes by
k^(3/2) / l and, in trees, by 4 Cd a |U| k. Cmu 0.0333, kappa 0.41.

The grid follows the ground, z = h + zeta (1 - h / top), with layers that grow from half a metre
to a lid at 300 m, or six times relief and trees; the ground fades to level in a buffer around,
where a sponge draws the air to the profile. Staggered velocities; the gradient of the projection
is the exact adjoint of its divergence, solved by conjugate gradients, preconditioned by the
operator of level ground (fast diagonalisation). QUICK in advective form, implicit steps along x,
y, zeta. The mixing length at a face is the logarithmic mean, so that the logarithmic profile is
an exact solution of the discrete equations over level ground. The speed of the wind is but a
scale of all this: one field serves all speeds.

In flight the field is read as the logarithmic law of the local roughness at the true height over
the ground, times the ratio that was solved for: quadratic splines, so that the wind and its
gradient are continuous, and the wall law below the lowest cell; the logarithm of the roughness is
a spline, too. Beyond the land, and higher than 80 m over ground and trees, where the field ends,
the ratio goes on as at its edge; below the ground the air is still. Between two directions the
wind is the sum of both, weighted so that as vectors they make it. It acts on balls on the ground
as on those in flight.

![wind over tall pines](wind_tall_pines.webp)

## Turbulence

```sh
sim_node --ros-args -p course:=tall_pines -p turbulence:=0.145 -p turbulence_seed:=3
```

One frozen box of eddies without divergence, 512 x 512 x 128 m in cells of 4 m, with von Karman's
spectrum, an integral scale of 60 m, and standard deviations along, across and up as 1 : 0.8 :
0.55. Along the wind it is 1.07 sqrt(k) of the field (2.5 u*, as measured), or without a field
`turbulence` times the wind at 10 m: 0.145 over short grass, 0.18 over rough, 0.28 among bushes.
Up it fades to nothing at the ground. The wind carries it along, whatever gusts come: where it is
belongs to the state of a play and to its journal, so that plays run again to the bit.

Whose scales are whose: `wind_node` draws the mean wind and its gusts, which last for seconds to
minutes and move all air alike; `turbulence` of `sim_node` draws the eddies that a ball crosses
within a flight. `wind_node` has a `turbulence` of its own, one random process for the whole sky:
it is for sims without the other, and with both the same would be counted twice. Spread of {count}
drives of 240 m in 8 m/s at an intensity of 0.145 (standard deviation of carry / aside, m):

{spread}
"""


def main():
    """Write page and pictures; return the exit code."""
    for name, angle in PICTURES.items():
        path = shipped_courses()[name].with_name(f'{name}_wind.npz')
        field, course = WindField.load(path), load_course(name)
        draw_field(DOCS / f'wind_{name}.webp', field, course, angle)
    text = PAGE.format(
        accuracy=accuracy(),
        verification=table_of_verification(),
        count=SEEDS * DRIVES,
        spread=table_of_spread(),
    )
    (DOCS / 'wind.md').write_text(text, encoding='utf-8')
    return 0


def accuracy():
    """Table of accuracy and cost."""
    with open(DOCS / 'accuracy_wind.csv', newline='', encoding='utf-8') as file:
        rows = [
            WindRow(row['what'], *(float(row[name]) for name in WindRow._fields[1:]))
            for row in csv.DictReader(file)
        ]
    return wind_table([row._replace(cells=int(row.cells)) for row in rows])


def table_of_verification():
    """Table of what closed forms and publications say, and what the solver does."""
    (coarse, _), (fine, left) = verification.taylor_green(16), verification.taylor_green(128)
    divergences = [left]
    rows = [
        (
            'Taylor-Green vortex, 16^2 to 128^2 cells',
            'order',
            f'{log2(coarse / fine) / 3:.2f}',
            '2',
        )
    ]
    for reynolds in (100, 400, 1000):
        z, u, left = verification.cavity(reynolds, 32)
        divergences.append(left)
        error = abs(np.interp(verification.GHIA_HEIGHTS, z, u) - verification.GHIA[reynolds]).max()
        what = f'lid-driven cavity, Re {reynolds}, 32^2 cells'
        rows.append((what, 'largest difference of u', f'{error:.4f}', '0 (Ghia 1982)'))
    for steepness in (0.05, 0.1):
        found, linear, left = verification.ridge(steepness)
        divergences.append(left)
        what = f'potential flow over a ridge, H/L {steepness}'
        rows.append(
            (what, 'speed-up at the crest', f'{found:.4f}', f'{linear:.4f}, linear theory')
        )
    for steepness in (0.1, 0.3):
        for cell in (20.0, 10.0):
            found, expected, left = verification.hill(steepness, cell)
            divergences.append(left)
            what = f'round hill, h/L {steepness}, cells of {cell:.0f} m'
            told = ' '.join(f'{value:.3f}' for value in found)
            lee = ' '.join(f'{value:.3f}' for value in expected)
            rows.append((what, 'speed-up at 2, 5, 10, 20 m', told, f'{lee} (Taylor, Lee 1984)'))
    kept, disturbed, left = verification.flat()
    divergences.append(left)
    rows.append(('level ground', 'profile kept within', f'{kept:.0e}', '0'))
    rows.append(('a start disturbed by 5 %', 'off after 2 km', f'{disturbed:.2%}', '0'))
    x, ratio, left = verification.trees()
    divergences.append(left)
    rows.append(
        (
            'row of trees, Cd a width 1.2',
            'least wind at 2 m, and 15 heights behind',
            f'{ratio.min():.2f} at {x[ratio.argmin()]:.1f} heights, {np.interp(15, x, ratio):.2f}',
            'shelterbelts: least at 2 to 6 heights, 0.65 to 0.9 at 15',
        )
    )
    rows.append(('all of these', 'divergence of faces x dx/U', f'{max(divergences):.0e}', '0'))
    lines = ['| case | figure | here | should be |', '|---|---|---|---|']
    return '\n'.join(lines + [f'| {" | ".join(row)} |' for row in rows])


def table_of_spread():
    """Table of how far drives scatter, in either kind of turbulence."""
    course = Course((Plane(material=materials({}, shipped()[0])['fairway']),))
    lines = ['| kind | tail | head | cross |', '|---|---|---|---|']
    for name, spread in (('a box of eddies', eddies), ('one process for the whole sky', sky)):
        cells = [spread(course, angle) for angle in WINDS.values()]
        lines.append(f'| {name} | ' + ' | '.join(f'{a:.1f} / {b:.1f}' for a, b in cells) + ' |')
    return '\n'.join(lines)


def eddies(course, angle):
    """Return standard deviations of carry and side in eddies."""
    wind = (SPEED * np.cos(angle), SPEED * np.sin(angle), 0.0)
    strikes = [np.tile(part, (DRIVES, 1)) for part in DRIVE]
    told = [
        simulate_many(course, *strikes, wind, engine='compiled', turbulence=(INTENSITY, seed))
        for seed in range(SEEDS)
    ]
    return tuple(np.std([one[field] for one in told]) for field in ('carry', 'carry_side'))


def sky(course, angle):
    """Return standard deviations of carry and side in the turbulence of `wind_node`."""
    settings = GustSettings(SPEED, 0.0, angle, 0.0, turbulence=INTENSITY)
    carries, sides = [], []
    for seed in range(SEEDS * 10):
        gusts = Gusts(settings, seed)
        times = np.arange(0.0, BLOWN, EVERY)
        table = np.array([(time, *gusts.wind(60.0 + time)) for time in times])
        told = simulate_many(course, [DRIVE[0]], [DRIVE[1]], table, engine='compiled')
        carries.append(told['carry'][0])
        sides.append(told['carry_side'][0])
    return np.std(carries), np.std(sides)


if __name__ == '__main__':
    sys.exit(main())
