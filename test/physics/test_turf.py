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

"""What turf and sand do to balls that land, and to those that roll: against what golfers see."""

import csv
from math import pi
import os
from pathlib import Path

from driving_range import launched, level
from golf_sim_ros.course.material_file import shipped
from golf_sim_ros.physics import (
    ACCURACY,
    Course,
    Material,
    PENNER,
    Phase,
    Plane,
    simulate_many,
    World,
)
import numpy as np
import pytest

MPH, YARD, RPM, DEGREE = 0.44704, 0.9144, pi / 30, pi / 180
IMPACTS = int(os.environ.get('RANDOM_SHOTS', 100))  # of a material; 15000 for the whole lot
DATA = Path(__file__).parents[1] / 'data'
PENNER_ROWS = [
    row
    for row in csv.DictReader(
        line
        for line in (DATA / 'bounce_expected_penner.csv').read_text().splitlines()
        if line[0] != '#'
    )
    if row['surface_model'].startswith('Penner')
]


def ground(name):
    """Level course of a shipped material."""
    return level(Material(name=name, **shipped()[0][name]))


def run(material, speed, launch, backspin):
    """Carry, and how far on from there a shot ends [yd]: mph, degrees, rpm."""
    (shot,) = simulate_many(
        ground(material),
        launched(np.array([speed * MPH]), launch * DEGREE),
        [(0.0, -backspin * RPM, 0.0)],
    )
    return shot['carry'] / YARD, (shot['position'][0] - shot['carry']) / YARD


def test_shots_run_out_as_far_as_they_do_on_a_fairway():
    assert 15 <= run('fairway', 167, 10.9, 2686)[1] <= 40
    assert 2 <= run('fairway', 120, 16.3, 7097)[1] <= 12


def test_a_full_wedge_stops_on_a_firm_green_and_spins_back_on_a_soft_one():
    assert -5 <= run('firm_green', 102, 24.2, 9304)[1] <= 5
    assert run('soft_green', 102, 24.2, 10000)[1] * YARD <= -1.0


def test_a_bump_and_run_runs_farther_than_it_carries():
    for material in ('fairway', 'green', 'firm_green'):
        carry, on = run(material, 25, 15, 1500)
        assert on > carry


def test_sand_stops_a_steep_wedge_and_lets_a_flat_shot_go_on():
    assert abs(run('sand', 80, 30, 9000)[1]) * YARD <= 1.0
    assert run('sand', 80, 5, 2000)[1] * YARD > 2.0


@pytest.mark.parametrize('row', PENNER_ROWS, ids=[row['case'] for row in PENNER_ROWS])
def test_penners_turf_is_as_published(row):
    course = level(Material('penner', PENNER, 0.0, 0.45, 0.40, 0.13, 0.004, 1.0))
    world = World(course, effects=('gravity', 'penner_2002'))
    speed, down = float(row['v_in_mps']), float(row['angle_below_horizontal_deg']) * DEGREE
    radius = course.ball.radius
    world.place(
        'ball',
        (0, 0, radius),
        velocity=(speed * np.cos(down), 0.0, -speed * np.sin(down)),
        spin=(0.0, -float(row['backspin_in_rad_s']), 0.0),
    )
    world.advance(1e-9)
    told = world['ball']
    expected = (
        float(row['vx_out']),
        float(row['vy_out']),
        radius * float(row['backspin_out_rad_s']),
    )
    found = (told.velocity[0], told.velocity[2], -radius * told.spin[1])
    size = np.hypot(*expected[:2])
    np.testing.assert_allclose(found, expected, atol=0.02 * size)


def test_a_ball_that_skims_on_turf_that_never_stops_to_throw_it_up_comes_to_rest():
    course = level(Material('penner', PENNER, 0.0, 0.45, 0.40, 0.13, 0.004, 1.0))
    skims = np.array([(3.0, 0.0, 0.5), (20.0, 0.0, 1.0), (40.0, 0.0, 4.0)])
    effects = 'gravity', 'drag', 'penner_2002'
    for accuracy in ACCURACY:
        ends = simulate_many(course, skims, 0 * skims, accuracy=accuracy, effects=effects)
        assert (ends['status'] == 'at_rest').all()
        assert ends['bounces'].max() < 1000


@pytest.mark.parametrize(
    'name', ('green', 'fairway', 'rough', 'soft_green', 'hardpan', 'artificial_turf', 'sand')
)
def test_no_impact_leaves_into_the_ground_or_gains_energy(name):
    rng = np.random.default_rng(11)
    world = World(ground(name))
    radius, inertia = world.course.ball.radius, world.course.ball.inertia
    for _ in range(IMPACTS):
        direction = rng.normal(size=3)
        velocity = rng.uniform(0.5, 80) * direction / np.linalg.norm(direction)
        velocity[2] = -abs(velocity[2])
        spin = rng.uniform(-700, 700, 3)
        world.place('ball', (0, 0, radius), velocity=velocity, spin=spin)
        world.advance(1e-9)
        told = world['ball']
        before = velocity @ velocity + inertia * radius**2 * spin @ spin
        after = np.square(told.velocity).sum() + inertia * radius**2 * np.square(told.spin).sum()
        assert told.velocity[2] >= -1e-7 and after <= before * (1 + 1e-9) + 1e-6


@pytest.mark.parametrize('name', ('green', 'fairway', 'rough', 'soft_green', 'hardpan', 'sand'))
def test_neighbouring_impacts_end_nearly_the_same(name):
    rng = np.random.default_rng(17)
    world = World(ground(name))
    radius = world.course.ball.radius

    def after(velocity, spin):
        world.place('ball', (0, 0, radius), velocity=velocity, spin=spin)
        world.advance(1e-9)
        told = world['ball']
        return np.concatenate((told.velocity, radius * np.array(told.spin)))

    for _ in range(100):
        velocity, spin = rng.uniform(-60, 60, 3), rng.uniform(-500, 500, 3)
        velocity[2] = -abs(velocity[2]) - 0.5
        near = 1e-7 * rng.normal(size=6)
        moved = after(velocity + near[:3], spin + near[3:] / radius) - after(velocity, spin)
        assert np.abs(moved).max() < 100 * np.abs(near).max()


def putt_ends(speeds, headings, fall):
    """Roll balls off at `speeds` and `headings` on a green that falls by `fall`: ends (n, 2)."""
    green = Material(name='green', **shipped()[0]['green'])
    course = Course((Plane(normal=(0.0, -fall, 1.0), material=green),))
    world, ends = World(course), []
    up = np.array((0.0, -fall, 1.0)) / np.hypot(fall, 1.0)
    for speed, heading in zip(speeds, headings):
        ahead = np.cross((-np.sin(heading), np.cos(heading), 0.0), up)
        velocity = speed * ahead / np.linalg.norm(ahead)
        world.place(
            'ball', course.ball.radius * up, velocity, np.cross(up, velocity) / course.ball.radius
        )
        world.advance(60.0)
        assert world['ball'].phase == Phase.REST
        ends.append(world['ball'].position[:2])
    return np.array(ends)


@pytest.mark.parametrize('fall', (0.0, 0.01, 0.03))
def test_where_a_putt_ends_has_no_step_and_no_kink(fall):
    speeds, headings = map(
        np.ravel, np.meshgrid(np.linspace(0.3, 3.0, 5), np.linspace(-3.0, 3.0, 7))
    )
    for size in (1e-2, 1e-3):
        for more, turn in ((size, 0.0), (0.0, size), (size, size)):
            ahead, here, behind = (
                putt_ends(speeds * (1 + k * more), headings + k * turn, fall) for k in (1, 0, -1)
            )
            # Second differences of a smooth function go with the step's square.
            assert np.abs(ahead - 2 * here + behind).max() < 60 * size * size
