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

"""Fit the laws of drag and lift to flights and wind-tunnel points together.

    .venv/bin/python tools/fit_aerodynamics.py

prints the parameters for physics/effects/drag.py and magnus.py, and how far the fit is from every
table, fitted rows and rows held out apart: the third, sixth, ... row of every file of test/data is
held out. It starts from `PRIOR`, not from what is in place, so that it comes out the same each
time; it takes about a minute.

A row of a tour's table, an average of many shots, counts by the differences that such averages
have. The two launch monitors' models of flight, which differ by 2 to 6 yd at like launches, count
by that. A wind-tunnel point counts by its own uncertainty and that of being another ball's. What
no datum decides stays near `PRIOR`.
"""

import csv
from math import pi
from pathlib import Path
from types import FunctionType
from typing import NamedTuple

from golf_sim_ros.physics.effects.drag import drag_coefficient, DragLaw
from golf_sim_ros.physics.effects.magnus import lift_per_ratio, LiftLaw
from golf_sim_ros.physics.effects.spin_decay import SMITS_SMITH, SMITS_SMITH_DENSITY
from golf_sim_ros.physics.properties.air import Air, density, viscosity
import numpy as np
from scipy.optimize import least_squares

DATA = Path(__file__).parents[1] / 'test' / 'data'
MPH, YARD, RPM, DEGREE = 0.44704, 0.9144, pi / 30, pi / 180
RADIUS, MASS, GRAVITY = 0.021335, 0.04593, 9.80665
PER_SPEED = 2 * RADIUS * density(Air()) / viscosity(Air())  # Reynolds number at 1 m/s
PUSH = 0.5 * density(Air()) * pi * RADIUS**2 / MASS
DECAY = SMITS_SMITH * density(Air()) / SMITS_SMITH_DENSITY / RADIUS
STEP = 0.05  # s
LAST = 9.5  # s
FIGURES = ('carry [yd]', 'apex [yd]', 'landing angle [deg]', 'flight time [s]')
HELD_OUT = 3  # every third row of a file
# What a residual is that counts as one, of each of `FIGURES`.
AVERAGES = (1.4, 1.4, 3.5, 0.3)
MODELS = (2.1, 2.4, 5.5, 0.5)
TABLES = {
    'trackman_pga_2010s.csv': AVERAGES,
    'trackman_pga_2023.csv': AVERAGES,
    'trackman_driver_chart_2010_aoa0.csv': AVERAGES,
    'trackman_6iron_calm.csv': AVERAGES,
    'trackman_model_bins.csv': MODELS,
    'flightscope_launches.csv': MODELS,
}
# The same of a coefficient, of the ball it was measured on: of one that was measured well, of 13
# modern balls, of balls of 1976 and 2004 (where modern ones were measured, too, those of 1976 have
# 0.03 to 0.05 more drag), of a smooth sphere.
POINTS = ('aero_points.csv', 'aero_points_high_spin.csv')
UNCERTAIN = {
    'USGA': 0.008,
    'Lyu2018': 0.02,
    'BearmanHarvey1976': 0.08,
    'Naruo2004': 0.08,
    'Sphere': 0.02,
}
OTHER_BALL = 0.03  # drag of 13 models differs by up to 0.05, below the crisis by 0.1 (Lyu 2018)
NO_SPIN_MEANT = 2000.0  # rpm: the middle of "1500-2500 rpm", where a point has no spin ratio
MIDDLE = {'': 1.4e5, '1.26e5-2.38e5': 1.8e5}  # Re of a point that is told for a range of them
# Where each parameter is expected and how far off it may be for the weight of one row: a turbulent
# boundary layer has CD 0.2 without spin at 1.2e5 and more beyond (Lyu 2018, USGA), and 0.3 to 0.35
# more with much spin (Bearman and Harvey); a laminar one 0.40 to 0.49 as a smooth sphere, and
# 0.05 more with spin (estimate); the crisis of 13 balls is at 6e4 to 8e4 (Lyu 2018). Lift sets
# in with CL 0.07 and grows to 0.4 to 0.45 (Bearman and Harvey).
PRIOR = (
    DragLaw(0.18, 0.05, 1.5e5, 0.3, 0.3, 0.45, 0.05, 7e4),
    LiftLaw(0.07, LiftLaw().early_at, 0.4, 1.3e5, 0.35, 0.25),
)
SPREAD = (
    DragLaw(0.05, 0.05, 5e4, 0.1, 0.15, 0.03, 0.03, 1.5e4),
    LiftLaw(0.05, 0.0, 0.4, 5e4, 0.2, 0.15),
)
START, WIDTH = np.concatenate(PRIOR), np.concatenate(SPREAD)
FREE = WIDTH > 0.0  # early_at is chosen, not fitted: with less, lift would set in with a jump


class Table(NamedTuple):
    """Shots of a table as arrays in SI; `told` is a row of each of `FIGURES`, nan for none."""

    speed: np.ndarray
    launch: np.ndarray
    spin: np.ndarray
    axis: np.ndarray
    told: np.ndarray


def rows(name):
    """Rows of a table as dicts."""
    lines = (DATA / name).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith('#')))


def column(table, *names):
    """Read the first column of these names that there is as numbers, nan where it is empty."""
    key = next((name for name in names if name in table[0]), names[0])
    return np.array([float(row.get(key) or 'nan') for row in table])


def table_of(name):
    """`Table` of a file."""
    table = rows(name)
    apex = column(table, 'max_height_yd', 'max_height_ft')
    apex = apex if 'max_height_yd' in table[0] else apex / 3.0
    return Table(
        column(table, 'ball_speed_mph') * MPH,
        column(table, 'launch_deg') * DEGREE,
        column(table, 'spin_rpm', 'total_spin_rpm') * RPM,
        np.nan_to_num(column(table, 'spin_axis_deg')) * DEGREE,
        np.array(
            [
                column(table, 'carry_yd'),
                apex,
                column(table, 'land_angle_deg'),
                column(table, 'flight_time_s'),
            ]
        ),
    )


def is_held_out(count):
    """Whether a row was kept from the fit, for each of `count` rows of a file."""
    return np.arange(count) % HELD_OUT == HELD_OUT - 1


def split(parameters):
    """`DragLaw` and `LiftLaw` of a row of all parameters."""
    count = len(DragLaw._fields)
    return DragLaw(*parameters[:count].tolist()), LiftLaw(*parameters[count:].tolist())


# The kernels take a root of a number: the same code with numpy's takes roots of arrays.
lifts_per_ratio = FunctionType(
    lift_per_ratio.__code__, {**lift_per_ratio.__globals__, 'sqrt': np.sqrt}, argdefs=(1.0,)
)


def drag_and_lift(laws, ratio, reynolds):
    """Drag and lift coefficients, arrays."""
    drag, lift = laws
    ss, rr = ratio * ratio, reynolds * reynolds
    return drag_coefficient(drag, ss, rr), ratio * lifts_per_ratio(lift, ss, rr)


def fly(laws, shots):
    """`FIGURES` of shots, a `Table`, in still air of 25 degrees at sea level: RK4, all at once."""
    across = np.array(
        [
            np.sin(shots.axis) * np.sin(shots.launch),
            -np.cos(shots.axis),
            -np.sin(shots.axis) * np.cos(shots.launch),
        ]
    )

    def rates(state):
        velocity, spin = state[3:6], state[6]
        speed = np.sqrt((velocity * velocity).sum(0))
        lifting = np.cross(across, velocity, axis=0)
        part = np.sqrt((lifting * lifting).sum(0)) / speed  # of the spin: that across the velocity
        ratio, reynolds = RADIUS * spin / speed, PER_SPEED * speed
        drag = drag_coefficient(laws[0], ratio * ratio, reynolds * reynolds)
        per_ratio = lifts_per_ratio(laws[1], (ratio * part) ** 2, reynolds * reynolds)
        pushed = PUSH * speed * (per_ratio * ratio * lifting - drag * velocity)
        pushed[2] -= GRAVITY
        return np.concatenate([velocity, pushed, [-DECAY * speed * spin]])

    zero = np.zeros_like(shots.speed)
    ahead, up = shots.speed * np.cos(shots.launch), shots.speed * np.sin(shots.launch)
    state = np.array([zero, zero, zero, ahead, zero, up, shots.spin])
    path = [state]
    for _ in range(round(LAST / STEP)):
        k1 = rates(state)
        k2 = rates(state + 0.5 * STEP * k1)
        k3 = rates(state + 0.5 * STEP * k2)
        k4 = rates(state + STEP * k3)
        state = state + STEP / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        path.append(state)
    return landed(np.array(path))


def landed(path):
    """`FIGURES` of flights of which `path` holds the states, (steps, 7, shots)."""
    z = path[:, 2]
    last = np.argmax((z[1:] <= 0) & (z[:-1] >= 0), axis=0)
    every = np.arange(z.shape[1])
    before, after = path[last, :, every].T, path[last + 1, :, every].T
    # From there to the ground on a parabola.
    change = (after[3:6] - before[3:6]) / STEP
    z0, v0, fall = before[2], before[5], change[2]
    s = (-v0 - np.sqrt(v0 * v0 - 2 * fall * z0)) / fall
    x, y = before[:2] + before[3:5] * s + 0.5 * change[:2] * s * s
    vx, vy, vz = before[3:6] + change * s
    top = z.max(0) + 0.5 * GRAVITY * (STEP / 4) ** 2
    return np.array(
        [
            np.hypot(x, y) / YARD,
            top / YARD,
            np.arctan2(-vz, np.hypot(vx, vy)) / DEGREE,
            last * STEP + s,
        ]
    )


READ = {name: table_of(name) for name in TABLES}
TOGETHER = Table(*(np.concatenate(columns, -1) for columns in zip(*READ.values())))


def table_errors(laws):
    """Errors of `FIGURES` for the rows of each table; nan where none is told."""
    errors = fly(laws, TOGETHER) - TOGETHER.told
    counts = [len(table.speed) for table in READ.values()]
    return dict(zip(READ, np.split(errors, np.cumsum(counts)[:-1], axis=1)))


class Points(NamedTuple):
    """Wind-tunnel points as arrays; nan where one of drag and lift was not measured."""

    ratio: np.ndarray
    reynolds: np.ndarray
    drag: np.ndarray
    lift: np.ndarray
    source: np.ndarray
    held_out: np.ndarray


def points_of(names=POINTS):
    """`Points` of the files."""
    found = []
    for name in names:
        table = rows(name)
        for row, held in zip(table, is_held_out(len(table))):
            reynolds = MIDDLE.get(row['Re']) or float(row['Re'])
            meant = NO_SPIN_MEANT * RPM * RADIUS * PER_SPEED / reynolds
            ratio = float(row['S']) if row['S'] else meant
            told = (float(row[key] or 'nan') for key in ('CD', 'CL'))
            found.append((ratio, reynolds, *told, row['source'].split('_')[0], held))
    return Points(*map(np.array, zip(*found)))


MEASURED = points_of()


def point_errors(laws):
    """Errors of drag and lift at the wind-tunnel points, two rows."""
    found = drag_and_lift(laws, MEASURED.ratio, MEASURED.reynolds)
    return np.array(found) - np.array([MEASURED.drag, MEASURED.lift])


def residuals(free):
    """All that the fit makes small, of the parameters that are `FREE`."""
    parameters = START.copy()
    parameters[FREE] = free
    laws = split(parameters)
    parts = [(parameters - START)[FREE] / WIDTH[FREE]]
    for name, errors in table_errors(laws).items():
        fitted = errors[:, ~is_held_out(errors.shape[1])]
        parts.append((fitted / np.array(TABLES[name])[:, None]).ravel())
    one = np.hypot(OTHER_BALL, [UNCERTAIN[source] for source in MEASURED.source])
    parts.append((point_errors(laws) / one)[:, ~MEASURED.held_out].ravel())
    off = np.concatenate(parts)
    return off[np.isfinite(off)]


def fitted(**how):
    """`DragLaw` and `LiftLaw` of the fit."""
    how = {'x_scale': WIDTH[FREE], 'bounds': (0.05 * START[FREE], np.inf), **how}
    parameters = START.copy()
    parameters[FREE] = least_squares(residuals, START[FREE], **how).x
    return split(parameters)


def rounded(law):
    """`law` with numbers of four digits."""
    return type(law)(*(float(f'{value:.4g}') for value in law))


def spread(errors):
    """Bias and root mean square of errors, as text."""
    errors = errors[np.isfinite(errors)]
    return f'{errors.mean():+.2f}, {np.sqrt((errors**2).mean()):.2f}' if len(errors) else ''


def main():
    """Fit, and print."""
    best = tuple(map(rounded, fitted()))
    for law in best:
        print(type(law).__name__, ', '.join(f'{k} {v:.4g}' for k, v in law._asdict().items()))
    print('bias and root mean square of the rows that were fitted | that were held out')
    for name, errors in table_errors(best).items():
        held = is_held_out(errors.shape[1])
        for label, row in zip(FIGURES, errors):
            if np.isfinite(row).any():
                print(f'{name} {label}: {spread(row[~held])} | {spread(row[held])}')
    errors = point_errors(best)
    for source in UNCERTAIN:
        here = MEASURED.source == source
        for label, row in zip(('drag', 'lift'), 1000 * errors):
            if np.isfinite(row[here]).any():
                told = spread(row[here & ~MEASURED.held_out])
                held = spread(row[here & MEASURED.held_out])
                print(f'{source} {label} [1/1000]: {told} | {held}')


if __name__ == '__main__':
    main()
