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

"""How far balls run on turf and in sand, against launch monitors and what golfers know."""

import csv
from functools import lru_cache
from math import atan, cos, log, pi, sin, sqrt
from pathlib import Path

from driving_range import launched, level, one_by_one
from golf_sim_ros.course.material_file import shipped
from golf_sim_ros.physics import ACCURACY, Course, Material, Phase, Plane, simulate_many, World
import numpy as np
import pytest
from scipy.integrate import solve_ivp

MPH, YARD, RPM, DEGREE, GRAVITY = 0.44704, 0.9144, pi / 30, pi / 180, 9.80665
DATA = Path(__file__).parents[1] / 'data'
FAIRWAYS = 'firm_fairway', 'fairway', 'soft_fairway'
GREENS = 'firm_green', 'green', 'soft_green'
TURFS = (*FAIRWAYS, *GREENS, 'tee', 'first_cut', 'rough', 'artificial_turf')


@lru_cache
def material(name):
    """Shipped material of that name."""
    return Material(name=name, **shipped()[0][name])


def rows(name):
    """Rows of a table in test/data."""
    lines = (DATA / name).read_text().splitlines()
    return list(csv.DictReader(line for line in lines if line[0] != '#'))


def runs(name, speeds, launches, spins, azimuths=0.0, axes=0.0):
    """How far shots go on from their carry [yd]: mph, degrees, rpm; axes tilted to the right."""
    azimuths, axes = np.atleast_1d(azimuths) * -DEGREE, np.atleast_1d(axes) * DEGREE
    velocities = launched(np.atleast_1d(speeds) * MPH, np.atleast_1d(launches) * DEGREE, azimuths)
    left = np.stack((-np.sin(azimuths), np.cos(azimuths), 0.0 * azimuths), -1)
    axis = np.cos(axes)[:, None] * left + np.sin(axes)[:, None] * np.array([0.0, 0.0, 1.0])
    shots = one_by_one(
        level(material(name)), velocities, -np.atleast_1d(spins)[:, None] * RPM * axis
    )
    return (np.hypot(*shots['position'][:, :2].T) - shots['carry']) / YARD


def comes_back(name, speed, launch, backspin):
    """How far a shot comes back from its carry [m]: mph, degrees, rpm."""
    velocities = launched(np.array([speed * MPH]), launch * DEGREE)
    found = one_by_one(level(material(name)), velocities, [(0.0, -backspin * RPM, 0.0)])
    return found['carry'][0] - found['position'][0, 0]


@pytest.mark.parametrize(
    'name, least, most', [('fairway', 16.0, 24.0), ('firm_fairway', 26.0, 40.0)]
)
def test_the_tours_average_drive_runs_out_as_on_a_fairway(name, least, most):
    drive = rows('trackman_pga_2023.csv')[0]
    found = runs(name, *(float(drive[k]) for k in ('ball_speed_mph', 'launch_deg', 'spin_rpm')))
    assert drive['club'] == 'Driver' and least <= found[0] <= most


def test_softer_fairways_stop_a_drive_sooner():
    found = [runs(name, 167, 10.9, 2686)[0] for name in FAIRWAYS]
    assert found == sorted(found, reverse=True)


def test_runs_on_a_fairway_are_those_of_another_model():
    table = rows('flightscope_launches.csv')
    names = 'ball_speed_mph', 'launch_deg', 'total_spin_rpm', 'azimuth_deg', 'spin_axis_deg'
    columns = [np.array([float(row[name]) for row in table]) for name in names]
    told = np.array([float(row['run_yd']) for row in table])
    errors = runs('fairway', *columns) - told
    lowest = columns[1] < 9.0
    assert lowest.sum() == 2 and np.abs(errors[lowest]).max() <= 12.0
    assert len(errors) == 18 and np.abs(errors).mean() <= 5.0


@pytest.mark.parametrize('mph, launch', [(102, 24.2), (104, 23.7)])
def test_a_full_wedge_of_10000_rpm_comes_back_on_a_soft_green(mph, launch):
    assert 1.0 <= comes_back('soft_green', mph, launch, 10000) <= 5.0


@pytest.mark.parametrize('launch', [30, 40, 45, 50, 55])
def test_a_flop_does_not_come_back_all_the_way(launch):
    for name in GREENS:
        assert comes_back(name, 68, launch, 12000) <= 6.0


def played(course, place, velocity, spin, tick=0.02, longest=400.0):
    """Way of a ball to its rest: times, positions and velocities at ticks."""
    world = World(course)
    world.place('ball', place, velocity=velocity, spin=spin)
    told = [world['ball']]
    while world.moving and len(told) * tick < longest:
        world.advance(tick)
        told.append(world['ball'])
    times = tick * np.arange(len(told))
    return times, np.array([b.position for b in told]), np.array([b.velocity for b in told])


def hop(places, velocities):
    """Greatest height of a ball once it has left the ground for the first time."""
    rises = np.flatnonzero(np.diff(velocities[:, 2]) > 0.0)
    first = rises[0] + 1 if len(rises) else -1
    return places[first:, 2].max()


@pytest.mark.parametrize('name', [*FAIRWAYS, 'tee', 'first_cut', 'rough'])
@pytest.mark.parametrize('down', [False, True])
def test_thinned_and_topped_balls_stay_low_and_stop(name, down):
    course = level(material(name))
    radius = course.ball.radius
    for speed in (25.0, 41.0, 60.0):
        for angle in (0.3, 1.7, 3.0):
            # Topped, or hit onto the ground: a thinned one with backspin flies on, up to 140 m.
            for topspin in (0.0, 150.0, 300.0, *((-150.0, -300.0) if down else ())):
                velocity = launched(speed, -angle * DEGREE if down else angle * DEGREE)
                _, places, motion = played(
                    course, (0.0, 0.0, radius + 1e-3), velocity, (0.0, topspin, 0.0)
                )
                assert hop(places, motion) - radius <= 0.6
                if name not in ('firm_fairway', 'tee'):
                    assert places[-1, 0] <= 110.0 * YARD


@pytest.mark.parametrize('mph, launch, rpm', [(92.0, 1.7, 2100.0), (92.0, 3.0, 2800.0)])
def test_a_thinned_iron_does_not_rise_after_its_first_touch(mph, launch, rpm):
    course = level(material('fairway'))
    _, places, motion = played(
        course,
        (0.0, 0.0, course.ball.radius),
        launched(mph * MPH, launch * DEGREE),
        (0.0, -rpm * RPM, 0.0),
    )
    assert hop(places, motion) - course.ball.radius <= 0.6
    assert places[-1, 0] <= 110.0 * YARD


def holding_slope(turf):
    """Steepest slope on which a ball at rest stays, and one that rolls comes to rest."""
    return min(1.4 * turf.rolling_resistance, max(turf.static_friction, turf.dynamic_friction))


@pytest.mark.parametrize('name', TURFS)
def test_a_ball_that_bounces_rests_where_one_that_rolls_does(name):
    turf = material(name)
    for percent in range(0, 61, 2):
        tilt = atan(percent / 100)
        if percent / 100 >= holding_slope(turf):
            break
        up = np.array((np.sin(tilt), 0.0, np.cos(tilt)))
        course = Course((Plane(normal=tuple(up), material=turf),))
        foot = course.ball.radius * up
        downhill = np.array((np.cos(tilt), 0.0, -np.sin(tilt)))
        for ahead in (downhill, -downhill, np.array((0.0, 1.0, 0.0))):
            dropped = played(course, foot + (0, 0, 3.0), 15.0 * ahead, (0, 0, 0), 0.25)[0][-1]
            if percent / 100 <= 0.85 * holding_slope(turf):
                assert dropped <= 60.0
                continue
            spin = np.cross(up, 15.0 * ahead) / course.ball.radius
            rolled = played(course, foot, 15.0 * ahead, spin, 0.25)[0][-1]
            # Falling and bouncing take up to 3 s, in which nothing brakes.
            assert dropped <= 3.0 + 1.5 * rolled


def in_sand(speed, angle, backspin=0.0):
    """Way of a ball from its impact with level sand."""
    course = level(material('sand'))
    return played(
        course,
        (0.0, 0.0, course.ball.radius),
        launched(speed, -angle * DEGREE),
        (0.0, -backspin, 0.0),
        tick=0.005,
    )


@pytest.mark.parametrize('backspin', [0.0, 400.0, 1000.0])
def test_sand_stops_what_comes_down_steeply_and_not_what_skims(backspin):
    for speed, angle, most in (
        (30.0, 45.0, 4.0),
        (20.0, 45.0, 2.0),
        *((speed, angle, 0.5) for speed in (20.0, 30.0) for angle in (60.0, 75.0, 90.0)),
    ):
        assert np.abs(in_sand(speed, angle, backspin)[1][:, 0]).max() <= most
    _, places, motion = in_sand(30.0, 10.0, backspin)
    assert np.linalg.norm(motion[places[:, 0] > 5.0][0]) >= 10.0
    assert places[-1, 0] <= 30.0


GRASS = Material(
    'grass',
    rolling_resistance=0.13,
    resistance_growth=0.07,
    dynamic_friction=0.4,
    static_friction=0.5,
)
BRAKE, SLIPS, GRIP = 0.13 * GRAVITY, 0.4 * GRAVITY, 0.5 * GRAVITY
# Of the growth: static friction that slows the spin counts as 1.05 times dynamic friction.
SPINNING = 0.4 * 0.5 / (1.05 * 0.4)
# m/s: what slows the spin of a faster ball leaves less grip to resistance; of one that is faster
# still, friction can't slow it any more
SPARING = sqrt((GRIP - BRAKE) / (SPINNING * 0.07 * BRAKE))
SLIPPING = sqrt(GRIP / (SPINNING * 0.07 * BRAKE))


def braked(speed, slower, even, growing):
    """Way in which v' = -(even + growing v^2) slows a ball from one speed to another."""
    return log((even + growing * speed**2) / (even + growing * slower**2)) / (2.0 * growing)


def rolled_out(speed):
    """Way on level grass of a ball that rolls: v' = -a (1 + b v^2), as far as it grips."""
    if speed > SLIPPING:
        return slid_out(speed, speed)
    growing = 0.07 * BRAKE
    fast = braked(speed, SPARING, GRIP, (1.0 - SPINNING) * growing) if speed > SPARING else 0.0
    return fast + braked(min(speed, SPARING), 0.0, BRAKE, growing)


def slid_out(speed, turning):
    """Way on level grass of a ball whose surface turns forward at another speed than its own."""
    forward = 1.0 if turning >= speed else -1.0

    def rates(_, state):
        drag = 1.4 * BRAKE * 0.07 * state[1] ** 2
        return state[1], forward * SLIPS - drag, -forward * 2.5 * SLIPS

    def slip(_, state):
        return forward * (state[1] - state[2]) + 1e-12

    slip.terminal, slip.direction = True, 1
    start = 0.0, speed, turning
    way = solve_ivp(rates, (0.0, 60.0), start, events=slip, rtol=1e-12, atol=1e-12)
    assert way.status == 1
    return way.y[0, -1] + rolled_out(way.y[1, -1])


def rest_on(course, velocity, spin, accuracy='standard'):
    """Place where a ball rests that is set off on a course's plane through the origin."""
    normal = np.array(course.ground[0].normal, float)
    world = World(course, accuracy=accuracy)
    place = course.ball.radius * normal / np.linalg.norm(normal)
    world.place('ball', place, velocity=velocity, spin=spin)
    world.advance(60.0)
    assert world['ball'].phase == Phase.REST
    return np.array(world['ball'].position) - place


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('speed', [0.5, 3.0, 9.0, 10.0, 12.0, 41.0])
def test_resistance_that_grows_with_speed_is_exact_in_a_straight_line(accuracy, speed):
    course = level(GRASS)
    found = rest_on(course, (speed, 0, 0), (0, speed / course.ball.radius, 0), accuracy)
    slips = {'reference': 1e-6, 'standard': 1e-4, 'sketch': 1e-3}[accuracy]
    rolls = 1e-8 if accuracy == 'reference' else 5e-5
    assert abs(found[0] - rolled_out(speed)) < (slips if speed > SLIPPING else rolls)


@pytest.mark.parametrize('less', [0.0, 1e-14, 1e-12, 1e-6])
@pytest.mark.parametrize('speed', [5.25, 5.75])
def test_a_resistance_that_slowing_the_spin_takes_up_is_exact_too(less, speed):
    # 0.4 of static over 1.05 times dynamic friction is 1: nothing grows while grip is short.
    static = 2.625 * 0.3 * (1.0 - less)
    turf = GRASS._replace(rolling_resistance=0.3, dynamic_friction=0.3, static_friction=static)
    course = level(turf)
    found = rest_on(course, (speed, 0, 0), (0, speed / course.ball.radius, 0), 'reference')
    growing = 0.3 * 0.07 * GRAVITY
    sparing = sqrt((static - 0.3) * GRAVITY / (0.4 * static / (1.05 * 0.3) * growing))
    fast = (speed**2 - sparing**2) / (2.0 * static * GRAVITY)
    assert abs(found[0] - fast - braked(sparing, 0.0, 0.3 * GRAVITY, growing)) < 2e-6


def test_a_ball_rolls_where_only_static_friction_is_told():
    course = level(GRASS._replace(dynamic_friction=0.0))
    found = rest_on(course, (2.0, 0, 0), (0, 2.0 / course.ball.radius, 0))
    assert abs(found[0] - braked(2.0, 0.0, BRAKE, 0.07 * BRAKE)) < 5e-5


@pytest.mark.parametrize('name', ['fairway', 'firm_fairway', 'first_cut', 'rough', 'sand'])
def test_a_fast_ball_that_slips_by_next_to_nothing_goes_as_far_as_one_that_rolls(name):
    course = level(material(name))
    speeds = np.linspace(0.5, 45.0, 60)
    spins = np.linspace(0.5, 45.0, 60) / course.ball.radius
    straight = np.transpose([speeds, 0 * speeds, 0 * speeds])
    ends = [
        one_by_one(course, straight, np.transpose([0 * spins, (1 + by) * spins, 0 * spins]))
        for by in (-1e-5, 0.0, 1e-5)
    ]
    # Static friction exceeds dynamic friction: a few balls in the range of GRIP_MARGIN part.
    assert np.ptp([end['total'] for end in ends], axis=0).max() < 0.03


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('speed, backspin', [(3.0, 0.0), (12.0, 0.0), (41.0, 100.0)])
def test_grass_brakes_the_centre_of_a_ball_that_slides(accuracy, speed, backspin):
    course = level(GRASS)
    expected = slid_out(speed, -course.ball.radius * backspin)
    found = rest_on(course, (speed, 0, 0), (0, -backspin, 0), accuracy)
    within = {'reference': 1e-6, 'standard': 1e-4, 'sketch': 1e-3}  # sketch's paths err by 0.01 mm
    assert abs(found[0] - expected) < within[accuracy]


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('speed', [0.0, -1e-8, -2.0])
def test_a_ball_that_a_slope_drives_is_braked_by_grass_however_slow_it_begins(accuracy, speed):
    fall = 0.3
    course = Course((Plane(normal=(sin(fall), 0.0, cos(fall)), material=GRASS),))
    down = np.array((cos(fall), 0.0, -sin(fall)))
    press, pull = GRAVITY * cos(fall), 5 / 7 * GRAVITY * sin(fall)

    def rates(_, state):
        v = state[1]
        return v, pull - np.copysign(0.13 * press * (1.0 + 0.07 * v * v), v)

    world = World(course, effects=('gravity',), accuracy=accuracy, engine='python')
    start = np.array(world['ball'].position)
    radius = course.ball.radius
    world.place('ball', start, speed * down, (0.0, speed / radius, 0.0))
    world.advance(9.0)
    exact = solve_ivp(rates, (0.0, 9.0), (0.0, speed), rtol=1e-12, atol=1e-12, max_step=0.01)
    way = (np.array(world['ball'].position) - start) @ down
    within = {'reference': 1e-5, 'standard': 1e-2, 'sketch': 0.1}[accuracy]
    assert abs(way - exact.y[0, -1]) < within


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('friction, resistance, fall', [(0.2, 0.5, 0.4), (0.45, 0.9, 0.8)])
def test_growing_resistance_brakes_where_grip_limits_the_constant(
    friction, resistance, fall, accuracy
):
    slippery = GRASS._replace(
        static_friction=friction, dynamic_friction=friction, rolling_resistance=resistance
    )
    tilt = atan(fall)
    course = Course((Plane(normal=(sin(tilt), 0.0, cos(tilt)), material=slippery),))
    down = np.array((cos(tilt), 0.0, -sin(tilt)))
    press, pull = GRAVITY * cos(tilt), GRAVITY * sin(tilt)
    growth = resistance * 0.07 * press

    def rates(_, state):
        v = state[1]
        growing = growth * v * v
        needed = abs(2 / 7 * pull - 2 / 5 * growing)  # by the spin, driven and slowed
        braked = min(resistance * press, max(friction * press - needed, 0.0))
        return v, 5 / 7 * pull - growing - braked

    world = World(course, effects=('gravity',), accuracy=accuracy, engine='python')
    start = np.array(world['ball'].position)
    world.place('ball', start, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    world.advance(0.8)
    assert world['ball'].phase == Phase.ROLL
    exact = solve_ivp(rates, (0.0, 0.8), (0.0, 0.0), rtol=1e-11, atol=1e-12, max_step=0.001)
    way = (np.array(world['ball'].position) - start) @ down
    within = {'reference': 1e-5, 'standard': 1e-3, 'sketch': 1e-2}[accuracy]
    assert abs(way - exact.y[0, -1]) < within


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('speed', [0.0, 1e-8])
def test_grass_brakes_a_ball_that_only_its_spin_drives(accuracy, speed):
    course = level(GRASS)
    expected = slid_out(speed, 1500.0 * course.ball.radius)
    found = rest_on(course, (speed, 0, 0), (0, 1500.0, 0), accuracy)
    within = {'reference': 1e-6, 'standard': 1e-4, 'sketch': 1e-3}
    assert abs(found[0] - expected) < within[accuracy]


@pytest.mark.parametrize('accuracy', ACCURACY)
def test_grass_on_a_slope_is_the_same_ode(accuracy):
    fall = 0.1
    course = Course((Plane(normal=(0.0, -fall, 1.0), material=GRASS),))
    up = np.array((0.0, -fall, 1.0)) / np.hypot(fall, 1.0)
    across, uphill = np.array((1.0, 0.0, 0.0)), np.cross(up, (1.0, 0.0, 0.0))
    press, pull = GRAVITY * up[2], 5 / 7 * GRAVITY * uphill[2]
    growth = 0.13 * 0.07 * press

    def rates(_, state):
        x, y, u, v = state
        speed = np.hypot(u, v)
        spinning = SPINNING * growth * speed
        turning = np.hypot(spinning * u, spinning * v + 0.4 * pull)
        brake = min(0.13 * press, max(0.5 * press - turning, 0.0)) / speed + growth * speed
        return u, v, -brake * u, -brake * v - pull

    def stops(_, state):
        return np.hypot(state[2], state[3]) - 1e-5

    stops.terminal = True
    start = 0.0, 0.0, 8.0, 3.0
    way = solve_ivp(rates, (0.0, 60.0), start, events=stops, rtol=1e-12, atol=1e-12)
    velocity = 8.0 * across + 3.0 * uphill
    found = rest_on(course, velocity, np.cross(up, velocity) / course.ball.radius, accuracy)
    expected = way.y[0, -1] * across + way.y[1, -1] * uphill
    # No step of `sketch` ends where grip begins to be short of what resistance would take.
    within = {'reference': 1e-7, 'standard': 2e-4, 'sketch': 3e-4}
    assert np.linalg.norm(found - expected) < within[accuracy]


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize(
    'velocity, spin',
    [
        ((26.376009946476362, 7.852291146144746, 1.669), (111.615509, -374.918826, 33.508525)),
        ((24.247227045202834, -1.4640305817, 1.242957480), (-6.501150594, -107.671845, -5.397937)),
    ],
)
def test_a_ball_that_slides_at_the_end_of_its_slip_is_not_driven_on(velocity, spin, accuracy):
    # Turf brakes a fast ball's centre harder than friction can end its slip.
    course = Course((Plane(material=material('fairway')),))
    found = simulate_many(course, [velocity], [spin], accuracy=accuracy, engine='python')
    assert found['status'][0] == 'at_rest'
    assert found['total'][0] < 60.0
