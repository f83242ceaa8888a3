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

"""Fits the laws of drag and lift to tour averages and wind-tunnel points together.

    .venv/bin/python tools/fit_aerodynamics.py

prints the parameters for physics/effects/drag.py and magnus.py, and how far the fit is from every
table. Points and tables are those of test/data, with their provenance in their heads. A point
counts by its own uncertainty, a table's row by that of an average of many shots; all points weigh
as much as all tables. What no datum decides stays near where it was.
"""

import csv
from math import pi
from pathlib import Path

from golf_sim_ros.physics.effects.drag import drag_coefficient, DragLaw
from golf_sim_ros.physics.effects.magnus import lift_per_ratio, LiftLaw
from golf_sim_ros.physics.properties.air import Air, density, viscosity
import numpy as np
from scipy.optimize import least_squares

DATA = Path(__file__).parents[1] / 'test' / 'data'
MPH, YARD, RPM, DEGREE = 0.44704, 0.9144, pi / 30, pi / 180
RADIUS, MASS, GRAVITY = 0.021335, 0.04593, 9.80665
PER_SPEED = 2 * RADIUS * density(Air()) / viscosity(Air())  # Reynolds number at 1 m/s
DECAY = 2.0e-5  # Smits and Smith 1994
STEP = 0.05  # s
LAST = 9.0  # s
FIGURES = ('carry [yd]', 'apex [yd]', 'landing angle [deg]')
# Residuals that count as one: carry and apex [yd], landing angle [deg]; coefficients of a ball
# that was measured well, of an average of 13 modern balls and of one of them, and of a ball of
# 1976.
CARRY, APEX, ANGLE = 2.5, 1.5, 3.5
UNCERTAIN = {'USGA': 0.008, 'Lyu2018': 0.02, 'BearmanHarvey1976': 0.03}
NO_SPIN_MEANT = 2000.0  # rpm: the middle of "1500-2500 rpm", where a point has no spin ratio
PRIOR = 3.0  # of a parameter's size: how far it may go for the weight of one row
START = np.array((*DragLaw(), *LiftLaw()))
# Drag that vanished without spin, or lift and drag that jumped with the first of it, would fit as
# well.
LEAST = np.array(
    (
        *DragLaw(*[0.0] * 10)._replace(base=0.11, fade=0.05),
        *LiftLaw(*[0.0] * 6)._replace(early_at=0.02),
    )
)
TABLES = (
    'trackman_pga_2010s.csv',
    'trackman_pga_2023.csv',
    'trackman_driver_chart_2010_aoa0.csv',
    'trackman_6iron_calm.csv',
)


def rows(name):
    """Rows of a table as dicts."""
    lines = (DATA / name).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith('#')))


def column(table, name):
    """Return a column as numbers; nan where it is empty."""
    return np.array([float(row.get(name) or 'nan') for row in table])


def split(parameters):
    """`DragLaw` and `LiftLaw` of a row of all parameters."""
    count = len(DragLaw._fields)
    return DragLaw(*parameters[:count].tolist()), LiftLaw(*parameters[count:].tolist())


def drag_and_lift(laws, ratio, reynolds):
    """Drag and lift coefficients, arrays."""
    drag, lift = laws
    pairs = [
        (cd(drag, s * s, re * re), s * cl(lift, s * s, re * re))
        for s, re in zip(np.ravel(ratio), np.ravel(reynolds))
    ]
    return np.array(pairs).T


cd, cl = drag_coefficient, lift_per_ratio


def fly(laws, speed, launch, spin):
    """Carry [yd], apex [yd] and landing angle [deg] of shots in still air of 25 degrees.

    By RK4, all at once.
    """
    air = Air()
    push = 0.5 * density(air) * pi * RADIUS**2 / MASS
    thickness = density(air) / 1.18

    def rates(state):
        _, _, vx, vz, w = state
        v = np.hypot(vx, vz)
        drag, lift = push * v * drag_and_lift(laws, RADIUS * w / v, PER_SPEED * v)
        return np.array(
            [
                vx,
                vz,
                -drag * vx - lift * vz,
                lift * vx - drag * vz - GRAVITY,
                -DECAY * thickness / RADIUS * v * w,
            ]
        )

    state = np.array([0 * speed, 0 * speed, speed * np.cos(launch), speed * np.sin(launch), spin])
    path = [state]
    for _ in range(round(LAST / STEP)):
        k1 = rates(state)
        k2 = rates(state + 0.5 * STEP * k1)
        k3 = rates(state + 0.5 * STEP * k2)
        k4 = rates(state + STEP * k3)
        state = state + STEP / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        path.append(state)
    x, z, vx, vz, _ = np.array(path).transpose(1, 0, 2)
    i = np.argmax((z[1:] <= 0) & (z[:-1] >= 0), axis=0)
    every = np.arange(len(speed))
    # From there to the ground by Newton's method on a parabola.
    z0, v0 = z[i, every], vz[i, every]
    fall = (vz[i + 1, every] - v0) / STEP
    s = (-v0 - np.sqrt(v0 * v0 - 2 * fall * z0)) / fall
    u0 = vx[i, every]
    ahead = (vx[i + 1, every] - u0) / STEP
    carry = x[i, every] + u0 * s + 0.5 * ahead * s * s
    angle = np.arctan2(-(v0 + fall * s), u0 + ahead * s)
    top = z.max(0) + 0.5 * GRAVITY * (STEP / 4) ** 2
    return carry / YARD, top / YARD, angle / DEGREE


def table_errors(laws, name):
    """Errors of `FIGURES` for the rows of a table; not a number where none is told."""
    table = rows(name)
    shots = (
        column(table, 'ball_speed_mph') * MPH,
        column(table, 'launch_deg') * DEGREE,
        column(table, 'spin_rpm') * RPM,
    )
    told = [column(table, key) for key in ('carry_yd', 'max_height_yd', 'land_angle_deg')]
    return np.array([found - wanted for found, wanted in zip(fly(laws, *shots), told)])


def point_errors(laws):
    """Errors of drag and lift at the wind-tunnel points, and what counts as one there."""
    found = []
    for row in rows('aero_points.csv'):
        reynolds = {'': 1.4e5, '1.26e5-2.38e5': 1.8e5}.get(row['Re']) or float(row['Re'])
        ratio = (
            float(row['S']) if row['S'] else NO_SPIN_MEANT * RPM * RADIUS / (reynolds / PER_SPEED)
        )
        (drag,), (lift,) = drag_and_lift(laws, ratio, reynolds)
        one = UNCERTAIN[row['source'].split('_')[0]]
        pairs = (drag, row['CD']), (lift, row['CL'])
        found += [(value - float(told), one) for value, told in pairs if told]
    return np.array(found).T


def residuals(parameters):
    """All that the fit makes small."""
    laws = split(parameters)
    off = [table_errors(laws, name) / np.array([[CARRY], [APEX], [ANGLE]]) for name in TABLES]
    tables = np.concatenate([part[np.isfinite(part)] for part in off])
    points = np.divide(*point_errors(laws))
    points = points * np.sqrt(len(tables) / len(points))
    return np.concatenate([tables, points, (parameters - START) / (PRIOR * START)])


def main():
    """Fit, and print."""
    fit = least_squares(
        residuals,
        np.maximum(START, 1.001 * LEAST),
        x_scale=START,
        bounds=(LEAST, np.inf),
        max_nfev=40,
    )
    best = split(fit.x)
    for law in best:
        print(
            type(law).__name__,
            ', '.join(f'{name} {value:.4g}' for name, value in law._asdict().items()),
        )
    for name in TABLES:
        for label, errors in zip(FIGURES, table_errors(best, name)):
            if np.isfinite(errors).all():
                off = np.abs(errors)
                print(f'{name} {label}: mean {off.mean():.2f}, worst {off.max():.2f}')
    errors, _ = point_errors(best)
    print(f'points: root mean square {np.sqrt((errors**2).mean()):.4f}')


if __name__ == '__main__':
    main()
