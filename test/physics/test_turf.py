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

from driving_range import launched, level, one_by_one
from golf_sim_ros.course.material_file import shipped
from golf_sim_ros.physics import (
    ACCURACY,
    Course,
    Material,
    PENNER,
    Phase,
    Plane,
    Shot,
    simulate,
    World,
)
from golf_sim_ros.physics.effects import effective_normal, turf
from golf_sim_ros.physics.response import ground_impact
import numpy as np
import pytest

MPH, YARD, RPM, DEGREE = 0.44704, 0.9144, pi / 30, pi / 180
IMPACTS = int(os.environ.get('RANDOM_SHOTS', 100))  # of a material; 15000 for the whole lot
SURFACES = sorted(set(shipped()[0]) - {'leaves'})  # balls pass through these
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
    shot = simulate(
        ground(material),
        Shot(tuple(launched(speed * MPH, launch * DEGREE)), (0.0, -backspin * RPM, 0.0)),
    ).result
    return shot.carry / YARD, (shot.position[0] - shot.carry) / YARD


def test_a_full_iron_runs_on_a_little():
    for material in ('firm_fairway', 'fairway'):
        assert 2 <= run(material, 120, 16.3, 7097)[1] <= 12


def test_a_full_wedge_stops_on_a_firm_green_and_spins_back_on_a_soft_one():
    assert -5 <= run('firm_green', 102, 24.2, 9304)[1] <= 5
    assert run('soft_green', 102, 24.2, 10000)[1] * YARD <= -1.0


def test_a_bump_and_run_runs_farther_than_it_carries():
    for material in ('firm_fairway', 'fairway', 'green', 'firm_green'):
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
        ends = one_by_one(course, skims, 0 * skims, accuracy=accuracy, effects=effects)
        assert (ends['status'] == 'at_rest').all()
        assert ends['bounces'].max() < 1000


def bounce_of(name):
    """Law of an impact with level ground: velocity and spin after those before."""
    model = World(ground(name), effects=('turf',), engine='python')._model
    material = model.land.materials[0]

    def after(velocity, spin):
        return ground_impact.bounced(
            model.land, (tuple(velocity), tuple(spin)), (0.0, 0.0, 1.0), material
        )

    return after


def random_impact(rng):
    """Velocity to 80 m/s, 0.2 to 90 degrees down, and spin to 1,200 rad/s, of any impact."""
    speed = 80.0 * rng.uniform() ** rng.choice((1.0, 3.0))
    down = 0.2 * 450.0 ** rng.uniform() if rng.uniform() < 0.5 else rng.uniform(0.2, 90.0)
    velocity = launched(speed, -down * DEGREE, rng.uniform(0, 2 * pi))
    axis = rng.normal(size=3)
    return velocity, rng.uniform(0, 1200) * axis / np.linalg.norm(axis)


def turned(arrow, angle, rng):
    """Vector `arrow` turned by a small `angle` [rad] towards any side."""
    side = np.cross(arrow, rng.normal(size=3))
    return arrow * np.cos(angle) + side / np.linalg.norm(side) * np.linalg.norm(arrow) * np.sin(
        angle
    )


@pytest.mark.parametrize('name', SURFACES)
def test_an_impact_gives_back_less_than_it_gets(name):
    rng, after = np.random.default_rng(11), bounce_of(name)
    radius, inertia = ground(name).ball.radius, ground(name).ball.inertia
    for _ in range(10 * IMPACTS):
        velocity, spin = random_impact(rng)
        left, turning = map(np.array, after(velocity, spin))
        approach = -velocity[2]
        assert 0.0 <= left[2] <= approach * (0.9 if approach > 0.5 else 1.0)
        before = velocity @ velocity + inertia * radius**2 * spin @ spin
        assert left @ left + inertia * radius**2 * turning @ turning <= before * (1 + 1e-12)


@pytest.mark.parametrize('name', SURFACES)
def test_an_impact_a_little_different_ends_a_little_different(name):
    rng, after = np.random.default_rng(17), bounce_of(name)
    radius = ground(name).ball.radius
    for i in range(5 * IMPACTS):
        velocity, spin = random_impact(rng)
        if i % 4 == 0:  # where it is steepest: fast, and hardly touching
            velocity = launched(80.0, -DEGREE * 0.2 * 30.0 ** rng.uniform())
        nearby = (
            (turned(velocity, 1e-4, rng), spin),
            (velocity, turned(spin, 1e-4, rng)),
            (1.0001 * velocity, spin),
            (velocity, 1.0001 * spin),
        )
        here = after(velocity, spin)
        size = max(np.linalg.norm(velocity), radius * np.linalg.norm(spin))
        for near in nearby:
            there = after(*near)
            moved = np.concatenate(
                (np.subtract(there[0], here[0]), radius * np.subtract(there[1], here[1]))
            )
            assert np.linalg.norm(moved) <= (1e-2 + 1e-4) * size


def test_the_tilt_is_penners_where_he_has_it_from():
    angle = 44.4 * DEGREE
    velocity = 18.6 * np.sin(angle), 0.0, -18.6 * np.cos(angle)
    softness = shipped()[0]['firm_fairway']['softness']
    felt = effective_normal((turf.record(None),), (0.0, 0.0, 1.0), velocity, softness)
    assert np.arccos(felt[2]) / DEGREE == pytest.approx(15.4, rel=0.1)
    left, _ = bounce_of('firm_fairway')(velocity, (0.0, 0.0, 0.0))
    # The reference impact in bounce_expected_penner.csv is at 44.4 degrees.
    assert left[2] == pytest.approx(3.889, rel=0.1)


@pytest.mark.parametrize('name', SURFACES)
def test_both_engines_play_an_impact(name):
    rng, after = np.random.default_rng(11), bounce_of(name)
    world = World(ground(name))
    radius = world.course.ball.radius
    for _ in range(IMPACTS // 4):
        velocity, spin = random_impact(rng)
        expected, turning = after(velocity, spin)
        world.place('ball', (0, 0, radius), velocity=velocity, spin=spin)
        world.advance(1e-9)
        told = world['ball']
        if expected[2] < 0.1:  # else it may slide or roll on
            continue
        np.testing.assert_allclose(told.velocity, expected, atol=1e-6)
        np.testing.assert_allclose(told.spin, turning, atol=1e-4)


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
