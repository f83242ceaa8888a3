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

"""Bouncing, sliding, rolling, resting: closed forms and laws of the contact with hard ground."""

import csv
from math import atan, cos, pi, radians, sin, sqrt, tan
from pathlib import Path

from driving_range import (
    down,
    EVERYTHING,
    GRAVITY,
    HARD,
    level,
    one_by_one,
    random_shots,
    slope,
    TURF,
)
from golf_sim_ros.physics import (
    ACCURACY,
    Collision,
    Course,
    Heightmap,
    Material,
    Phase,
    Plane,
    Preset,
    Restitution,
    Result,
    rolling_resistance_of_stimp,
    Shot,
    simulate,
    simulate_many,
    World,
)
from golf_sim_ros.physics.jit import entry
from golf_sim_ros.physics.mechanics import coulomb_deceleration
from golf_sim_ros.physics.scene.kernel_model import Limits
import numpy as np
import oracles
from oracles import G, RADIUS
import pytest

presets = pytest.mark.parametrize('accuracy', ACCURACY)
EXACT = 1e-9  # what has a closed form in the engine is exact to rounding, whatever the preset

# Gives just what grip needs, however hard the ball slips.
RUBBER = HARD._replace(static_friction=50.0, dynamic_friction=50.0)
SMOOTH = Material('smooth', Restitution(0.7))


def forward(speed):
    """Spin vector of a ball whose surface turns forward, towards +x, at `speed`."""
    return 0.0, speed / RADIUS, 0.0


def first_bounce(material, velocity, spin, accuracy='standard'):
    """First collision of a ball that sets off in vacuum, close over level ground of `material`."""
    world = World(level(material), effects=GRAVITY, accuracy=accuracy)
    world.place('ball', (0, 0, RADIUS + 1e-4), velocity, spin)
    return next(event for event in world.advance(1.0) if isinstance(event, Collision))


def end_of(world):
    """Play the shot under way to its end: the result."""
    return next(event for event in world.advance(301.0) if isinstance(event, Result))


# Bouncing


@presets
def test_a_dropped_ball_rises_to_e2_of_its_height_each_time(accuracy):
    world = World(level(SMOOTH), effects=GRAVITY, accuracy=accuracy)
    world.place('ball', (0, 0, 2 + RADIUS))
    time = sqrt(2 * 2 / G)
    events = world.advance(time + 1e-6)
    for bounce in range(1, 12):
        height = oracles.height_after(2, 0.7, bounce)
        up = sqrt(2 * height / G)
        if up * G < ACCURACY[accuracy].limits.settle:  # this one and the rest are summed
            assert bounce > 6
            break
        assert events[-1].time == pytest.approx(time, abs=EXACT)
        assert events[-1].velocity_after[2] == pytest.approx(sqrt(2 * G * height), abs=EXACT)
        world.advance(time + up - world.time)
        assert world['ball'].position[2] - RADIUS == pytest.approx(height, abs=EXACT)
        time += 2 * up
        events = world.advance(time + 1e-6 - world.time)


@presets
@pytest.mark.parametrize('e', [0.1, 0.5, 0.9])
def test_all_bounces_take_2v_over_g_times_1_minus_e(accuracy, e):
    course = level(Material('e', Restitution(e)))
    up = simulate_many(
        course,
        [[0, 0, 0.02], [0, 0, 3], [0, 0, 15]],
        np.zeros((3, 3)),
        effects=GRAVITY,
        accuracy=accuracy,
        engine='python',
    )
    exact = [oracles.time_of_all_bounces(v, e) for v in (0.02, 3, 15)]
    np.testing.assert_allclose(up['duration'], exact, atol=EXACT)


def test_an_ideal_ball_bounces_for_a_minute_and_keeps_its_energy():
    world = World(level(Material('ideal', Restitution(1.0))), effects=GRAVITY)
    world.place('ball', (0, 0, 2 + RADIUS))
    before = G * 2
    world.advance(60.0)
    ball = world['ball']
    after = G * (ball.position[2] - RADIUS) + 0.5 * np.dot(ball.velocity, ball.velocity)
    assert ball.phase == Phase.FLIGHT
    assert after == pytest.approx(before, rel=1e-10)


bounces = pytest.mark.parametrize(
    'v, spin', [(5, 0), (5, -8), (-3, 6), (0, -10), (12, 12), (2, 30)]
)


@bounces
@pytest.mark.parametrize('ex', [-1.0, 0.0, 0.3, 1.0])
def test_a_bounce_with_grip_turns_spin_into_speed(v, spin, ex):
    hit = first_bounce(RUBBER._replace(tangential_restitution=ex), (v, 0, -4), forward(spin))
    after = oracles.gripping_bounce(v, spin, ex)
    assert (hit.velocity_after[0], RADIUS * hit.spin_after[1]) == pytest.approx(after, abs=EXACT)
    assert hit.velocity_after[2] == pytest.approx(-0.5 * hit.velocity_before[2], abs=EXACT)


@bounces
def test_a_superball_bounces_as_garwin_says(v, spin):
    superball = RUBBER._replace(tangential_restitution=1.0, restitution=Restitution(1.0))
    hit = first_bounce(superball, (v, 0, -4), forward(spin))
    assert hit.velocity_after[0] == pytest.approx(3 / 7 * v + 4 / 7 * spin, abs=EXACT)
    assert RADIUS * hit.spin_after[1] == pytest.approx(10 / 7 * v - 3 / 7 * spin, abs=EXACT)
    assert hit.velocity_after[2] == pytest.approx(-hit.velocity_before[2], abs=EXACT)


def test_every_second_bounce_of_a_superball_is_undone_by_the_next():
    superball = RUBBER._replace(tangential_restitution=1.0, restitution=Restitution(1.0))
    world = World(level(superball), effects=GRAVITY)
    world.place('ball', (0, 0, 1), (2, 1, 0), (30, -100, 7))
    hits = world.advance(20.0)
    assert len(hits) > 10
    for hit, following in zip(hits, hits[1:]):
        undone = hit.velocity_before * np.array((1, 1, -1))
        np.testing.assert_allclose(following.velocity_after, undone, atol=1e-8)
        np.testing.assert_allclose(following.spin_after, hit.spin_before, atol=1e-6)


@pytest.mark.parametrize('spin', [3, 60])
def test_a_backspin_drop_kicks_back(spin):
    hit = first_bounce(HARD, (0, 0, -4), forward(-spin))
    approach = -hit.velocity_before[2]
    grips = oracles.grips(0, -spin, 0.4, 0.5, approach)
    assert grips == (spin == 3)
    kick = -2 / 7 * spin if grips else -0.4 * 1.5 * approach
    assert hit.velocity_after[0] == pytest.approx(kick, abs=EXACT)


@pytest.mark.parametrize('v, spin', [(15, 0), (-15, 0), (6, -20), (0, 40)])
def test_a_bounce_that_slips_loses_mu_times_its_normal_impulse(v, spin):
    hit = first_bounce(HARD, (v, 0, -2), forward(spin))
    approach = -hit.velocity_before[2]
    assert not oracles.grips(v, spin, 0.4, 0.5, approach)
    after = oracles.slipping_bounce(v, spin, 0.4, 0.5, approach)
    assert (hit.velocity_after[0], RADIUS * hit.spin_after[1]) == pytest.approx(after, abs=EXACT)


def published_bounces():
    """Rows of the table of rigid bounces in test/data."""
    with open(Path(__file__).parents[1] / 'data' / 'rigid_bounces.csv', encoding='utf-8') as file:
        return list(csv.DictReader(line for line in file if not line.startswith('#')))


@pytest.mark.parametrize('row', published_bounces(), ids=lambda row: row['case'])
def test_rigid_bounces_agree_with_the_table(row):
    number = {key: float(value) for key, value in row.items() if key not in ('case', 'regime')}
    angle = radians(number['angle_below_horizontal_deg'])
    material = HARD._replace(restitution=Restitution(0.4))
    world = World(level(material), effects=GRAVITY)
    world.place(
        'ball',
        (0, 0, RADIUS + 1e-9),
        (number['v_in_mps'] * cos(angle), 0, -number['v_in_mps'] * sin(angle)),
        (0, -number['backspin_in_rad_s'], 0),
    )
    (hit,) = world.advance(1e-6)
    assert hit.velocity_after[0] == pytest.approx(number['vx_out'], abs=1e-3)
    assert hit.velocity_after[2] == pytest.approx(number['vy_out'], abs=1e-3)
    assert -hit.spin_after[1] == pytest.approx(number['backspin_out_rad_s'], abs=1e-3 / RADIUS)


@pytest.mark.parametrize('tilt', [0.0, 0.1])
def test_angular_momentum_about_the_contact_is_kept_in_every_bounce(tilt):
    seen = 0
    for velocity, spin in zip(*random_shots(20, seed=5)):
        play = simulate(slope(-tilt, HARD), Shot(velocity, spin), effects=EVERYTHING, rate=10.0)
        seen += len(play.collisions)
        for hit in play.collisions:
            np.testing.assert_allclose(
                angular_momentum(hit.spin_after, hit.velocity_after, hit.normal),
                angular_momentum(hit.spin_before, hit.velocity_before, hit.normal),
                atol=1e-9 * (1 + np.linalg.norm(hit.velocity_before)),
            )
    assert seen > 100


def angular_momentum(spin, velocity, normal):
    """Angular momentum about the point of contact, over m r [m/s]."""
    return oracles.K * RADIUS * np.array(spin) + np.cross(normal, velocity)


def test_no_bounce_pulls_or_rubs_harder_than_coulomb_or_gains_energy():
    hits = [
        hit
        for velocity, spin in zip(*random_shots(50, seed=6))
        for hit in simulate(
            level(HARD), Shot(velocity, spin), effects=EVERYTHING, rate=10.0
        ).collisions
    ]
    assert len(hits) > 200
    for hit in hits:
        press = np.dot(hit.impulse, hit.normal)
        rub = np.linalg.norm(hit.impulse - press * np.array(hit.normal))
        change = np.subtract(hit.velocity_after, hit.velocity_before) * oracles.MASS
        assert press > 0 and rub <= 0.4 * press * (1 + 1e-12)
        np.testing.assert_allclose(change, hit.impulse, atol=1e-12)
        assert energy(hit.velocity_after, hit.spin_after) <= energy(
            hit.velocity_before, hit.spin_before
        )


def energy(velocity, spin):
    """Kinetic energy over mass."""
    return 0.5 * (np.dot(velocity, velocity) + oracles.K * RADIUS * RADIUS * np.dot(spin, spin))


# Sliding and rolling

ROLLS_ON = Material('ice', Restitution(0.0), 0.0, 0.4, 0.3)  # no rolling resistance


@presets
@pytest.mark.parametrize('v, spin', [(2, 0), (2, -4), (2, -8), (1, 5), (-3, 0)])
def test_a_sliding_ball_rolls_at_5_7_of_its_speed(v, spin, accuracy):
    speed, time, way = oracles.slide_to_roll(v, spin, 0.3)
    world = World(level(ROLLS_ON), effects=GRAVITY, accuracy=accuracy)
    world.strike('ball', (v, 0, 0), forward(spin))
    world.advance(0.5 * time)
    assert world['ball'].phase == Phase.SLIDE
    sign = 1 if v > spin else -1
    assert world['ball'].velocity[0] == pytest.approx(v - sign * 0.3 * G * 0.5 * time, abs=EXACT)
    world.advance(time + EXACT - world.time)
    ball = world['ball']
    assert ball.phase == Phase.ROLL
    assert ball.velocity[0] == pytest.approx(speed, abs=EXACT)
    assert RADIUS * ball.spin[1] == pytest.approx(speed, abs=EXACT)
    assert ball.position[0] == pytest.approx(way, abs=1e-8)


def test_the_slide_of_a_plain_strike_is_12_v2_over_49_mu_g():
    assert oracles.slide_to_roll(2, 0, 0.3) == pytest.approx(
        (10 / 7, 4 / (7 * 0.3 * G), 48 / (49 * 0.3 * G))
    )


@presets
def test_a_ball_rolls_down_ten_degrees_at_5_7_g_sin(accuracy):
    world = World(slope(radians(10), ROLLS_ON), effects=GRAVITY, accuracy=accuracy)
    start = np.array(world['ball'].position)
    world.place('ball', (0, 0))
    for time in (0.5, 1.0, 2.0):
        world.advance(time - world.time)
        ball = world['ball']
        assert ball.phase == Phase.ROLL
        way = oracles.rolling_down(radians(10), time)
        np.testing.assert_allclose(
            np.array(ball.position) - start, way * down(radians(10)), atol=EXACT
        )
        np.testing.assert_allclose(ball.velocity, 2 * way / time * down(radians(10)), atol=EXACT)
        assert RADIUS * ball.spin[1] == pytest.approx(2 * way / time, abs=EXACT)


@presets
@pytest.mark.parametrize('margin', [0.999, 1.001, 1.5])
def test_a_ball_slides_down_where_tan_exceeds_7_2_mu(margin, accuracy):
    material = Material('film', Restitution(0.0), 0.0, 0.2, 0.2)
    angle = atan(3.5 * 0.2 * margin)
    world = World(slope(angle, material), effects=GRAVITY, accuracy=accuracy)
    world.place('ball', (0, 0))
    start = np.array(world['ball'].position)
    world.advance(1.0)
    ball = world['ball']
    slides = margin > 1
    assert ball.phase == (Phase.SLIDE if slides else Phase.ROLL)
    way = 0.5 * G * (sin(angle) - 0.2 * cos(angle)) if slides else oracles.rolling_down(angle, 1.0)
    np.testing.assert_allclose(np.array(ball.position) - start, way * down(angle), atol=EXACT)
    turns = 5 * 0.2 * G * cos(angle) / (2 * RADIUS) if slides else 2 * way / RADIUS
    assert ball.spin[1] == pytest.approx(turns, abs=1e-6)


@presets
@pytest.mark.parametrize('feet', [4, 8, 10, 13])
def test_a_ball_off_the_stimpmeter_rolls_what_the_green_reads(feet, accuracy):
    green = HARD._replace(rolling_resistance=rolling_resistance_of_stimp(feet))
    world = World(level(green), effects=GRAVITY, accuracy=accuracy)
    world.strike('ball', (1.83, 0, 0), forward(1.83))
    assert world['ball'].phase == Phase.ROLL
    end = end_of(world)
    assert end.total == pytest.approx(oracles.stimp_distance(feet), abs=EXACT)
    assert end.duration == pytest.approx(2 * oracles.stimp_distance(feet) / 1.83, abs=EXACT)
    assert end.carry == end.flight_time == end.apex == 0


@pytest.mark.parametrize('tilt, error', [(1e-4, 1e-6), (0.02, 0.03)])
def test_a_putt_across_a_slope_breaks_by_the_closed_form(tilt, error):
    # The slope falls towards +x; the putt rolls along +y. The closed form is for small slopes.
    green = HARD._replace(rolling_resistance=rolling_resistance_of_stimp(10))
    decel = green.rolling_resistance * G * cos(tilt)
    way, left = 3.048, 0.5
    speed = sqrt(2 * decel * (way + left))
    world = World(slope(tilt, green), effects=GRAVITY, accuracy='reference')
    world.strike('ball', (0, speed, 0), (-speed / RADIUS, 0, 0))
    start = np.array(world['ball'].position)
    time = (speed - sqrt(2 * decel * left)) / decel
    world.advance(time)
    broke = (np.array(world['ball'].position) - start) @ down(tilt)
    expected = oracles.break_of_putt(5 / 7 * G * sin(tilt), decel, way, left)
    assert broke == pytest.approx(expected, rel=error)
    assert broke > 0


solve_ivp = pytest.importorskip('scipy.integrate').solve_ivp


@presets
@pytest.mark.parametrize('tilt', [0.0, 0.1, 0.3])
def test_a_slide_follows_its_differential_equation(tilt, accuracy):
    velocity, spin = np.array((1.5, -2.0)), np.array((-60.0, 150.0))
    rates = oracles.sliding_ball_rates(0.3, tilt)
    world = World(slope(tilt, ROLLS_ON), effects=GRAVITY, accuracy=accuracy)
    start = np.array(world['ball'].position)
    basis = np.array((down(tilt), (0, 1, 0)))
    world.place('ball', (0, 0), tuple(velocity @ basis), tuple(spin @ basis))
    times = np.linspace(0, 0.28, 15)
    exact = solve_ivp(
        rates,
        (0, 0.28),
        (0, 0, *velocity, *spin),
        method='DOP853',
        rtol=1e-12,
        atol=1e-12,
        t_eval=times,
    ).y.T
    for time, row in zip(times[1:], exact[1:]):
        world.advance(time - world.time)
        ball = world['ball']
        assert ball.phase == Phase.SLIDE
        limit = max(ACCURACY[accuracy].limits.path, EXACT)
        np.testing.assert_allclose(
            basis @ (np.array(ball.position) - start), row[:2], atol=2 * limit
        )
        np.testing.assert_allclose(basis @ ball.velocity, row[2:4], atol=100 * limit)


@presets
@pytest.mark.parametrize('tilt, resistance', [(0.0, 0.1), (0.05, 0.1), (0.05, 0.02), (0.2, 0.05)])
def test_a_roll_follows_its_differential_equation(tilt, resistance, accuracy):
    green = HARD._replace(rolling_resistance=resistance)
    world = World(slope(tilt, green), effects=GRAVITY, accuracy=accuracy)
    start = np.array(world['ball'].position)
    basis = np.array((down(tilt), (0, 1, 0)))
    velocity = np.array((-1.0, 1.5))
    spin = np.cross(np.cross(*basis), velocity @ basis) / RADIUS
    world.place('ball', (0, 0), tuple(velocity @ basis), tuple(spin))
    times = np.linspace(0, 1.2, 13)
    exact = solve_ivp(
        oracles.rolling_ball_rates(resistance, tilt),
        (0, 1.2),
        (0, 0, *velocity),
        method='DOP853',
        rtol=1e-12,
        atol=1e-12,
        t_eval=times,
    ).y.T
    for time, row in zip(times[1:], exact[1:]):
        world.advance(time - world.time)
        ball = world['ball']
        limit = max(ACCURACY[accuracy].limits.path, EXACT)
        assert ball.phase == Phase.ROLL
        np.testing.assert_allclose(
            basis @ (np.array(ball.position) - start), row[:2], atol=2 * limit
        )
        np.testing.assert_allclose(basis @ ball.velocity, row[2:], atol=100 * limit)


def beyond(place, heading, angle, far=30.0):
    """Corners of a rectangle, which a ball enters at `place`, at an `angle` to its near side."""
    along = np.array((cos(heading + angle), sin(heading + angle)))
    inward = np.array((along[1], -along[0]))
    near = [place - far * along, place + far * along]
    return [tuple(corner) for corner in (*near, near[1] + far * inward, near[0] + far * inward)]


@pytest.mark.parametrize('ground', ['plane', 'height map'])
@pytest.mark.parametrize('phase', ['rolls', 'slides'])
@pytest.mark.parametrize('angle', [0.5 * pi, 1.0, 0.01, 1e-4, 1e-5, 1e-6])
def test_a_ball_is_braked_by_what_it_is_on_wherever_the_border_lies(ground, phase, angle):
    slow = HARD._replace(name='slow', rolling_resistance=0.3, dynamic_friction=0.3)
    random = np.random.default_rng(4)
    heights = Heightmap(np.zeros((21, 21)), (-10.0, -10.0), 1.0, HARD)
    shape = Plane(material=HARD) if ground == 'plane' else heights
    speed = 3.0
    for way, heading in zip(random.uniform(0.1, 0.5, 15), random.uniform(0.0, 2.0 * pi, 15)):
        ahead = np.array((cos(heading), sin(heading), 0.0))
        zone = slow, beyond(way * ahead[:2], heading, angle)
        world = World(Course((shape,), zones=(zone,)), effects=GRAVITY, engine='python')
        turning = np.cross((0.0, 0.0, 1.0), ahead) * (speed / RADIUS if phase == 'rolls' else 0.0)
        world.place('ball', (0.0, 0.0, RADIUS), speed * ahead, turning)
        if phase == 'rolls':
            world.advance(30.0)
            left = speed**2 - 2.0 * HARD.rolling_resistance * G * way
            expected = way + left / (2.0 * slow.rolling_resistance * G)
        else:
            braking = HARD.dynamic_friction * G
            first = (speed - sqrt(speed**2 - 2.0 * braking * way)) / braking
            world.advance(first + 0.01)
            then = speed - braking * first
            expected = way + 0.01 * then - 0.5 * slow.dynamic_friction * G * 0.01**2
        # A nanometre across an oblique border is a tenth of a millimetre along it.
        within = 2e-6 + 4e-9 / angle
        assert np.linalg.norm(world['ball'].position[:2]) == pytest.approx(expected, abs=within)


@pytest.mark.parametrize('ground', ['plane', 'height map'])
@pytest.mark.parametrize('heading', [0.0, 1.0, pi - 1.0, pi])
@pytest.mark.parametrize('zone_heading', [0.0, pi])
def test_a_ball_that_starts_on_a_border_is_braked_by_what_it_rolls_onto(
    ground, heading, zone_heading
):
    slow = HARD._replace(name='slow', rolling_resistance=0.3)
    heights = Heightmap(np.zeros((21, 21)), (-10.0, -10.0), 1.0, HARD)
    shape = Plane(material=HARD) if ground == 'plane' else heights
    zone = slow, beyond(np.zeros(2), zone_heading, 0.5 * pi)
    world = World(Course((shape,), zones=(zone,)), effects=GRAVITY, engine='python')
    ahead = np.array((cos(heading), sin(heading), 0.0))
    spin = np.cross((0.0, 0.0, 1.0), ahead) / RADIUS
    world.place('ball', (0.0, 0.0, RADIUS), ahead, spin)
    world.advance(30.0)
    onto = slow if cos(heading - zone_heading) > 0.0 else HARD
    expected = 0.5 / (onto.rolling_resistance * G)
    assert np.linalg.norm(world['ball'].position[:2]) == pytest.approx(expected, abs=2e-6)


@pytest.mark.parametrize('shift', [-1e-13, 1e-13])
@pytest.mark.parametrize('uphill', [True, False])
def test_a_ball_put_on_a_border_of_a_slope_rests_if_what_is_below_holds_it(uphill, shift):
    slick = HARD._replace(name='slick', rolling_resistance=0.05)
    tilt = 0.1
    foot = -RADIUS * sin(tilt) + shift
    far = -9.0 if uphill else 9.0
    zone = ((foot, -9.0), (foot, 9.0), (far, 9.0), (far, -9.0))
    ground = slope(tilt, slick).ground
    # The slope falls towards +x: HARD, which holds, is above the border or below.
    world = World(Course(ground, zones=((HARD, zone),), tee=(5.0, 5.0)), effects=GRAVITY)
    world.place('ball', (0.0, 0.0))
    world.advance(1.0)
    assert (world['ball'].phase == Phase.REST) == (not uphill)


def test_a_rolling_ball_does_not_turn_about_the_normal():
    normal = np.array((sin(0.05), 0, cos(0.05)))
    world = World(slope(0.05, HARD), effects=GRAVITY, accuracy='reference')
    world.strike('ball', 2 * down(0.05) + (0, 1, 0))
    for _ in range(40):
        world.advance(0.05)
        ball = world['ball']
        assert abs(np.dot(ball.spin, normal)) < 1e-9
        if ball.phase == Phase.ROLL:
            rolling = np.cross(normal, ball.velocity) / RADIUS
            np.testing.assert_allclose(ball.spin, rolling, atol=1e-5)


def test_a_spin_about_the_normal_stops_after_its_closed_time():
    # Torque pivot m g on k m r^2: the spin falls at pivot g / (k r^2).
    world = World(level(HARD), effects=GRAVITY)
    world.strike('ball', (0, 0, 0), (0, 0, 100.0))
    rate = 0.003 * G / (oracles.K * RADIUS * RADIUS)
    world.advance(0.25)
    assert world['ball'].spin[2] == pytest.approx(100 - 0.25 * rate, abs=1e-6)
    end = end_of(world)
    assert end.duration == pytest.approx(100 / rate, abs=EXACT)
    assert end.total < EXACT


def test_a_ball_at_rest_turns_no_more():
    world = World(level(TURF))
    world.strike('ball', (20.0, 1.0, 9.0), (3.0, -300.0, 40.0))
    end_of(world)
    assert world['ball'].phase == Phase.REST and world['ball'].spin == (0.0, 0.0, 0.0)


# Resting


def resting_cases():
    """Slopes just below and above each of the two limits, for several materials."""
    cases = []
    for resistance, static in ((0.1, 0.5), (0.3, 0.35), (0.5, 0.2), (0.0, 0.3), (0.2, 0.0)):
        for tangent in (1.4 * resistance, static):
            for factor in (0.5, 1 - 1e-6, 1 + 1e-6, 1.5):
                cases.append((tangent * factor, resistance, static))
        cases.append((0.0, resistance, static))
    return cases


@pytest.mark.parametrize('tangent, resistance, static', resting_cases())
def test_a_ball_rests_where_rolling_resistance_and_static_friction_hold_it(
    tangent, resistance, static
):
    material = Material('slope', Restitution(0.0), 0.0, static, 0.5 * static, resistance)
    holds = 5 / 7 * tangent <= resistance and tangent <= static
    world = World(slope(atan(tangent), material), effects=GRAVITY)
    world.place('ball', (0, 0))
    before = world['ball'].position
    world.advance(3.0)
    ball = world['ball']
    assert (ball.phase == Phase.REST) == holds
    assert (ball.position == before) == holds


@pytest.mark.parametrize('tilt, rests', [(0.05, True), (0.13, True), (0.15, False)])
def test_a_putt_uphill_stays_or_comes_back(tilt, rests):
    assert (5 / 7 * tan(tilt) <= HARD.rolling_resistance) == rests
    world = World(slope(-tilt, HARD), effects=GRAVITY)
    start = np.array(world['ball'].position)
    world.place('ball', (0, 0), tuple(2 * down(-tilt)), forward(2))
    world.advance(20.0)
    assert (world['ball'].phase == Phase.REST) == rests
    way = (np.array(world['ball'].position) - start) @ down(-tilt)
    decel = (HARD.rolling_resistance * cos(tilt) + 5 / 7 * sin(tilt)) * G
    assert way == pytest.approx(2 * 2 / (2 * decel), abs=EXACT) if rests else way < 0


# Micro-bounces, too small to follow


def rests_with(settle, velocities, spins, course, effects=GRAVITY):
    """Where shots in vacuum rest when rebounds slower than `settle` are summed."""
    preset = Preset(ACCURACY['reference'].method, Limits(settle, 1e-10))
    return one_by_one(course, velocities, spins, effects=effects, accuracy=preset)


KINDS = {
    'hard': HARD,
    'slick': HARD._replace(dynamic_friction=0.05),
    'lively': HARD._replace(restitution=Restitution(0.8)),
}


@pytest.mark.parametrize('kind', KINDS)
def test_summing_the_last_bounces_moves_the_rest_with_the_square_of_their_speed(kind):
    material = KINDS[kind]
    velocities, spins = random_shots(200, seed=7)
    exact = rests_with(1e-4, velocities, spins, level(material))
    for settle, error in ((0.1, 5e-3), (0.01, 5e-5), (0.001, 5e-7)):
        summed = rests_with(settle, velocities, spins, level(material))
        assert np.linalg.norm(summed['position'] - exact['position'], axis=1).max() < error
        assert np.abs(summed['duration'] - exact['duration']).max() < error


@pytest.mark.parametrize('rise', [0.0, 0.05])
def test_the_sum_of_the_last_bounces_counts_that_soft_turf_throws_a_fast_ball_up(rise):
    # Without that, half of them are off by more than 5e-4 m. Up a rise, balls that skim
    # it.
    velocities, spins = random_shots(300, seed=7)
    course = slope(-rise, TURF)
    exact, summed = (
        rests_with(settle, velocities, spins, course, (*GRAVITY, 'turf')) for settle in (1e-5, 0.1)
    )
    off = np.linalg.norm(summed['position'] - exact['position'], axis=1)
    assert np.median(off) < 1e-4 and off.max() < 2e-3


@presets
def test_the_smallest_lift_off_ends_at_rest_on_the_ground(accuracy):
    lifts = 10.0 ** np.arange(-9, 0)
    strikes = np.array([(u, 0, lift) for lift in lifts for u in (0, 2)])
    for spins in (np.zeros_like(strikes), strikes[:, [1, 0, 1]] / RADIUS):
        ends = one_by_one(level(TURF), strikes, spins, effects=EVERYTHING, accuracy=accuracy)
        assert (ends['status'] == 'at_rest').all()
        assert np.abs(ends['position'][:, 2] - RADIUS).max() < 1e-9
        assert np.isfinite(ends['total']).all() and ends['total'].max() < 3


@entry
def time_at(u, pull, friction, time):
    """Time at the parameter that is found for `time`."""
    motion = coulomb_deceleration.decelerated(u, pull, friction, (0.0, 0.0, 1.0))
    return coulomb_deceleration.after(motion, coulomb_deceleration.parameter_at(motion, time))[0]


@pytest.mark.parametrize('friction', [0.0, 1e-18, 1e-3, 4.9])
@pytest.mark.parametrize('speed', [1e-9, 1e-6, 1e-3, 1.0, 100.0])
@pytest.mark.parametrize('time', [1e-6, 1e-2, 10.0])
def test_where_a_slide_down_a_slope_is_at_a_time_is_found_however_slow_it_begins(
    speed, friction, time
):
    for heading in np.arange(0.1, 6.3, 0.5):
        u = speed * cos(heading), speed * sin(heading), 0.0
        assert time_at(u, (5.0, 0.0, 0.0), friction, time) == pytest.approx(time, rel=1e-9)
