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

"""Draw docs/physics.png and print the tables of docs/physics.md: laws against measurements.

.venv/bin/python tools/draw_physics.py
"""

from math import log
from pathlib import Path

from fit_aerodynamics import column, DEGREE, drag_and_lift, MPH, rows, RPM, YARD
from golf_sim_ros.course.material_file import shipped
from golf_sim_ros.drawing.style import bare, colors
from golf_sim_ros.physics import (
    Course,
    Material,
    Phase,
    Plane,
    Restitution,
    Shot,
    simulate,
    simulate_many,
    World,
)
from golf_sim_ros.physics.effects.drag import DragLaw
from golf_sim_ros.physics.effects.magnus import LiftLaw
import matplotlib
from matplotlib import pyplot as plt
import numpy as np

matplotlib.use('Agg')

DOCS = Path(__file__).parents[1] / 'docs'
PGA = ('trackman_pga_2010s.csv', 'trackman_pga_2023.csv')
RUNS = (
    ('driver, firm fairway', 'firm_fairway', 167, 10.9, 2686),
    ('driver, fairway', 'fairway', 167, 10.9, 2686),
    ('7 iron, fairway', 'fairway', 120, 16.3, 7097),
    ('wedge, firm green', 'firm_green', 102, 24.2, 9304),
    ('wedge of 10,000 rpm, soft green', 'soft_green', 102, 24.2, 10000),
    ('bump and run, green', 'green', 25, 15, 1500),
    ('wedge, sand', 'sand', 80, 30, 9000),
)


def ground(name, normal=(0, 0, 1)):
    """Course of one plane of a shipped material."""
    return Course((Plane(normal=normal, material=Material(name=name, **shipped()[0][name])),))


def strikes(speed, launch, backspin):
    """Velocities and spins of shots: mph, degrees, rpm."""
    v, angle = np.atleast_1d(speed) * MPH, np.atleast_1d(launch) * DEGREE
    zero = np.zeros(len(v))
    return (
        np.stack((v * np.cos(angle), zero, v * np.sin(angle)), 1),
        np.stack((zero, -np.atleast_1d(backspin) * RPM, zero), 1),
    )


def of_table(name):
    """Its rows' strikes."""
    table = rows(name)
    return strikes(*(column(table, key) for key in ('ball_speed_mph', 'launch_deg', 'spin_rpm')))


def print_runs():
    """How far shots run out."""
    print('| shot | carry [yd] | from there [yd] |\n|---|---|---|')
    for label, material, *shot in RUNS:
        (end,) = simulate_many(ground(material), *strikes(*shot))
        rolled = end['position'][0] - end['carry']
        print(f'| {label} | {end["carry"] / YARD:.1f} | {rolled / YARD:.1f} |')


def draw_flights(axes):
    """Fly every club of the tour's table.

    A dot is where the table lands it, a tick at the table's apex.
    """
    table = rows('trackman_pga_2023.csv')
    velocities, spins = of_table('trackman_pga_2023.csv')
    palette = colors(len(table))
    for row, velocity, spin, color in zip(table, velocities, spins, palette):
        play = simulate(ground('fairway'), Shot(tuple(velocity), tuple(spin)))
        flying = play.times <= play.result.flight_time
        x, _, z = play.positions[flying].T / YARD
        axes.plot(x, z, color=color, lw=1.2)
        axes.plot(float(row['carry_yd']), 0.0, 'o', color=color, ms=4, clip_on=False)
        axes.plot(x[z.argmax()], float(row['max_height_yd']), '_', color=color, ms=9)
    bare(axes, 'PGA Tour 2023: flights, and what the table says', 'yd', 'yd')


def points(key, spinning):
    """Spin ratios or Reynolds numbers, and coefficients `key`, of the wind-tunnel points."""
    found = [
        row
        for row in rows('aero_points.csv')
        if row[key] and row['S'] and (float(row['S']) > 0) == spinning
    ]
    across = 'S' if spinning else 'Re'
    return [float(row[across]) for row in found], [float(row[key]) for row in found]


def draw_coefficients(drag_axes, lift_axes, crisis_axes):
    """Drag and lift over the spin ratio; drag without spin over the Reynolds number."""
    ratio, laws = np.linspace(0.0, 1.0, 300), (DragLaw(), LiftLaw())
    speeds = (7e4, 1e5, 1.5e5, 2e5)
    for reynolds, color in zip(speeds, colors(len(speeds))):
        drag, lift = drag_and_lift(laws, ratio, np.full(300, reynolds))
        drag_axes.plot(ratio, drag, color=color, label=f'Re {reynolds:g}')
        lift_axes.plot(ratio, lift, color=color)
    for axes, key in ((drag_axes, 'CD'), (lift_axes, 'CL')):
        axes.plot(*points(key, True), 'k.', ms=3)
    drag_axes.legend(frameon=False, fontsize=8)
    reynolds = np.linspace(3e4, 2.5e5, 300)
    crisis_axes.plot(reynolds, drag_and_lift(laws, np.zeros(300), reynolds)[0])
    crisis_axes.plot(*points('CD', False), 'k.')
    bare(drag_axes, 'drag coefficient', 'spin ratio')
    bare(lift_axes, 'lift coefficient', 'spin ratio')
    bare(crisis_axes, 'drag coefficient without spin', 'Reynolds number')


def draw_bounce(axes):
    """Angle and speed at which turf gives back a ball of 25 m/s without spin, by its angle."""
    world, angles = World(ground('fairway')), np.linspace(10, 90, 33)
    radius, out = world.course.ball.radius, []
    for angle in angles * DEGREE:
        world.place('ball', (0, 0, radius), velocity=(25 * np.cos(angle), 0, -25 * np.sin(angle)))
        world.advance(1e-9)
        out.append(world['ball'].velocity)
    out = np.array(out)
    axes.plot(angles, np.arctan2(out[:, 2], out[:, 0]) / DEGREE, label='angle out [deg]')
    axes.plot(angles, 4 * np.linalg.norm(out, axis=1), label='4 x speed out [m/s]')
    axes.legend(frameon=False, fontsize=8)
    bare(axes, '25 m/s onto fairway, no spin', 'angle in [deg]')


def draw_putt(axes):
    """Play a putt of 10 ft across a slope of 2 %; and the closed form of its break.

    The form holds for a small slope.
    """
    tilt, way, left = 0.02, 3.048, 0.45
    course = ground('green', (np.sin(np.arctan(tilt)), 0, np.cos(np.arctan(tilt))))
    brake = shipped()[0]['green']['rolling_resistance'] * 9.80665
    world = World(course)
    x0, y0, z0 = world['ball'].position
    speed, radius = np.sqrt(2 * brake * (way + left)), course.ball.radius
    world.place('ball', (x0, y0, z0), velocity=(0, speed, 0), spin=(-speed / radius, 0, 0))
    path = [world['ball'].position]
    while world.moving:
        world.advance(0.02)
        path.append(world['ball'].position)
    x, y, _ = np.array(path).T
    axes.plot(y - y0, x - x0)
    side = 5 / 7 * 9.80665 * tilt
    axes.plot(way, side / brake * (way / 2 - left / 2 * log((way + left) / left)), 'ko')
    bare(axes, '10 ft across 2 %, stimp 10: break', 'm', 'm')


def draw_errors(axes):
    """Carry's error, club by club, of both of the tour's tables."""
    for name in PGA:
        carry = simulate_many(ground('fairway'), *of_table(name))['carry'] / YARD
        axes.plot(
            carry - column(rows(name), 'carry_yd'), 'o-', ms=4, label=name[13:-4].replace('_', ' ')
        )
    axes.axhline(0, color='k', lw=0.5)
    axes.set_xticks(
        range(12), [row['club'].split()[0] for row in rows(name)], rotation=60, fontsize=7
    )
    axes.legend(frameon=False, fontsize=8)
    bare(axes, 'carry: found less told', '', 'yd')


def fastest_holed(aside, bounciness):
    """Lowest speed [m/s] at the rim that escapes a hole in a level green.

    The ball passes `aside` [m] of its centre.
    """
    green = Material(name='green', **shipped()[0]['green'])._replace(
        restitution=Restitution(bounciness)
    )
    world = World(Course((Plane(material=green),), hole=(1.0, 0.0), flagstick=False))
    radius, brake = world.course.ball.radius, 9.80665 * green.rolling_resistance
    start, low, high = 1.0 - np.sqrt(0.054**2 - aside**2) - 0.1, 0.1, 4.0
    for _ in range(12):
        speed = 0.5 * (low + high)
        before = np.sqrt(speed**2 + 2 * brake * 0.1)
        world.reset()
        place = start, aside, radius
        world.place('ball', place, velocity=(before, 0, 0), spin=(0, before / radius, 0))
        world.advance(15.0)
        low, high = (speed, high) if world['ball'].phase == Phase.HOLED else (low, speed)
    return high


def draw_capture(axes):
    """Up to which speed the hole takes a ball, by how far off centre it rolls, and by its rim."""
    aside = np.linspace(0.0, 0.05, 11)
    for bounciness in (0.2, 0.5, 0.8):
        speeds = [fastest_holed(d, bounciness) for d in aside]
        axes.plot(1e3 * aside, speeds, '.-', label=f'rim gives {bounciness}')
    axes.legend(frameon=False, fontsize=8)
    bare(axes, 'lowest speed that escapes the hole, m/s', 'mm off centre')


def main():
    """Draw and print."""
    figure, axes = plt.subplots(2, 4, figsize=(16, 7.5), constrained_layout=True)
    draw_flights(axes[0, 0])
    draw_coefficients(axes[0, 1], axes[0, 2], axes[1, 0])
    draw_bounce(axes[1, 1])
    draw_putt(axes[1, 2])
    draw_errors(axes[0, 3])
    draw_capture(axes[1, 3])
    figure.savefig(DOCS / 'physics.png', dpi=90)
    print_runs()


if __name__ == '__main__':
    main()
