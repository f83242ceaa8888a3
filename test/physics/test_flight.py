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

"""A ball in the air: closed forms and symmetries."""

from math import log, pi, radians

from driving_range import (
    DRIVE,
    EVERYTHING,
    GRAVITY,
    HARD,
    hilly,
    launched,
    level,
    one_by_one,
    random_shots,
    TURF,
)
from golf_sim_ros.physics import (
    ACCURACY,
    Course,
    EFFECTS,
    LogProfile,
    Patch,
    Phase,
    Plane,
    PowerProfile,
    register_effect,
    Shot,
    simulate,
    simulate_many,
    UniformProfile,
    World,
)
from golf_sim_ros.physics.effects import wind_at
from golf_sim_ros.physics.effects.drag import dynamic_push
from golf_sim_ros.physics.effects.ferguson_drag import FergusonDrag
from golf_sim_ros.physics.effects.ferguson_lift import FergusonLift
from golf_sim_ros.physics.properties.air import density
from hypothesis import assume, given, HealthCheck, settings
from hypothesis import strategies as st
import numpy as np
import oracles
from other_process import run
import pytest

presets = pytest.mark.parametrize('accuracy', ACCURACY)
few = settings(
    max_examples=25,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow],
)


# Closed forms


@presets
def test_a_ball_in_vacuum_lands_at_v2_sin2a_over_g(accuracy):
    rng = np.random.default_rng(1)
    speed, angle = rng.uniform(1, 100, 200), rng.uniform(0.1, 1.5, 200)
    spins = rng.uniform(-500, 500, (200, 3))
    shots = one_by_one(
        level(TURF), launched(speed, angle), spins, effects=GRAVITY, accuracy=accuracy
    )
    told = shots['carry'], shots['apex'], shots['flight_time']
    exact = np.transpose([oracles.vacuum_flight(v, a) for v, a in zip(speed, angle)])
    np.testing.assert_allclose(told, exact, rtol=1e-9)  # parabolas are exact for every preset
    np.testing.assert_allclose(shots['landing_speed'], speed, rtol=1e-9)
    np.testing.assert_allclose(shots['landing_angle'], angle, rtol=1e-9)


@pytest.fixture(scope='module')
def told():
    """Run what the other effects do in plain Python."""
    return run(findings)


def findings():
    """All that is asked of the other process below, by preset where it depends on that."""
    with_constant_drag_and_lift()
    by_preset = {
        accuracy: {
            'linear drag': error_of_linear_drag(accuracy),
            'coast': coasting(accuracy),
            'throws': vertical_throws(accuracy),
        }
        for accuracy in ACCURACY
    }
    return {
        **by_preset,
        'circles': circling(),
        'wind': {name: shares_of_wind(name) for name in PROFILES},
    }


def with_constant_drag_and_lift():
    """Register drag and lift of constant coefficients, as a package of its own would."""
    register_effect(
        'constant_drag',
        lambda scene: FergusonDrag(dynamic_push(scene.course), 1.0, 0.4, 0.0, -1.0),
        lambda scene: 'only on request',
        'Drag of constant coefficient.',
    )
    register_effect(
        'constant_lift',
        lambda scene: FergusonLift(dynamic_push(scene.course), 1.0, 0.25, 0.0, -1.0, 0.0),
        lambda scene: 'only on request',
        'Lift of constant coefficient.',
    )


@presets
def test_linear_drag_gives_the_exponential_path(accuracy, told):
    assert 0 < told[accuracy]['linear drag'] < ACCURACY[accuracy].touch


def error_of_linear_drag(accuracy):
    """Greatest distance from the closed form, in time and at the landing."""
    worst = 0.0
    for velocity in ((60, 0, 20), (30, 5, 30), (5, 0, 2)):
        play = simulate(
            level(HARD), Shot(velocity), effects=('gravity', 'linear_drag'), accuracy=accuracy
        )
        flying = play.times < play.result.flight_time
        for time, place in zip(play.times[flying], play.positions[flying] - play.positions[0]):
            worst = max(
                worst, np.linalg.norm(place - oracles.linear_drag_path(velocity, 0.18, time))
            )
        landing = oracles.linear_drag_path(velocity, 0.18, play.result.flight_time)
        worst = max(worst, abs(play.result.carry - np.hypot(*landing[:2])), abs(landing[2]))
    return worst


@presets
def test_quadratic_drag_slows_a_vertical_throw(accuracy, told):
    for speed, shot in zip(THROWS, told[accuracy]['throws']):
        terminal = oracles.terminal_speed(dynamic_push(level(HARD)), 0.4)
        height, rise = oracles.quadratic_rise(speed, terminal)
        apex, back, time, half_way_down = shot
        limit = ACCURACY[accuracy].touch
        assert apex == pytest.approx(height, abs=limit)
        assert back == pytest.approx(oracles.quadratic_return_speed(speed, terminal), abs=limit)
        assert oracles.quadratic_fall(time - rise, terminal)[0] == pytest.approx(height, abs=limit)
        fallen = oracles.quadratic_fall((time - rise) / 2, terminal)[0]
        assert half_way_down == pytest.approx(height - fallen, abs=limit)


THROWS = (10, 40, 90)  # m/s


def vertical_throws(accuracy):
    """Apex, landing speed, flight time and height half-way down in time of throws straight up."""
    course = level(HARD)
    terminal = oracles.terminal_speed(dynamic_push(course), 0.4)
    told = []
    for speed in THROWS:
        world = World(course, effects=('gravity', 'constant_drag'), accuracy=accuracy)
        end = simulate(
            course, Shot((0, 0, speed)), effects=('gravity', 'constant_drag'), accuracy=accuracy
        )
        world.strike('ball', (0, 0, speed))
        rise = oracles.quadratic_rise(speed, terminal)[1]
        world.advance(0.5 * (rise + end.result.flight_time))
        told.append(
            (
                end.result.apex,
                end.result.landing_speed,
                end.result.flight_time,
                world['ball'].position[2] - course.ball.radius,
            )
        )
    return told


@presets
def test_without_gravity_quadratic_drag_lets_a_ball_coast(accuracy, told):
    rate = 0.4 * dynamic_push(level(HARD))
    for time, way, speed in told[accuracy]['coast']:
        exact_way, exact_speed = oracles.quadratic_coast(80, rate, time)
        assert way == pytest.approx(exact_way, abs=ACCURACY[accuracy].touch)
        assert speed == pytest.approx(exact_speed, abs=ACCURACY[accuracy].touch)


def coasting(accuracy):
    """Fly a ball with nothing but drag: times, ways and speeds."""
    world = World(level(HARD), effects=('constant_drag',), accuracy=accuracy)
    world.place('ball', (0, 0, 5), (80, 0, 0))
    rows = []
    for _ in range(20):
        world.advance(0.25)
        rows.append((world.time, world['ball'].position[0], world['ball'].velocity[0]))
    return rows


def test_lift_alone_flies_a_ball_in_a_circle(told):
    # m v^2 / R = rho A CL v^2 / 2, whatever the speed.
    push = dynamic_push(level(HARD))
    for speed, positions in told['circles']:
        radius = 1 / (push * 0.25)
        middle = np.array((0, radius, 5))
        np.testing.assert_allclose(
            np.linalg.norm(np.subtract(positions, middle), axis=1), radius, atol=1e-6
        )
        assert np.ptp(np.transpose(positions)[2]) < 1e-12
        assert np.ptp(np.transpose(positions)[1]) > radius


def circling():
    """Places of balls spinning about the vertical with nothing but constant lift."""
    flights = []
    for speed in (20, 80):
        world = World(level(HARD), effects=('constant_lift',), accuracy='reference')
        world.place('ball', (0, 0, 5), (speed, 0, 0), (0, 0, 200))
        rows = []
        for _ in range(40):
            world.advance(15 / speed)
            rows.append(world['ball'].position)
        flights.append((speed, rows))
    return flights


def test_spin_decays_with_the_path_alone():
    thickness = density(level(TURF).air) / 1.18
    for velocity, spin in zip(*random_shots(5, seed=3)):
        world = World(level(TURF), effects=EVERYTHING, accuracy='reference')
        world.strike('ball', velocity, spin)
        path, speed = 0.0, np.linalg.norm(velocity)
        while not world.advance(0.002) and world['ball'].phase == Phase.FLIGHT:
            ball, before = world['ball'], speed
            speed = np.linalg.norm(ball.velocity)
            path += 0.002 * (before + speed) / 2  # trapezoids: to 1e-8 of it
            kept = np.linalg.norm(ball.spin) / np.linalg.norm(spin)
            assert kept == pytest.approx(oracles.spin_after(1.0, thickness * path), rel=1e-8)
            np.testing.assert_allclose(np.cross(ball.spin, spin), 0.0, atol=1e-6)
        assert path > 4


def test_a_drive_carries_240_to_262_metres():
    for accuracy in ACCURACY:
        assert 240 < simulate(level(TURF), Shot(*DRIVE), accuracy=accuracy).result.carry < 262


# Symmetries

shots = st.tuples(*[st.floats(-40, 40)] * 2, st.floats(3, 50), *[st.floats(-500, 500)] * 3)


@few
@given(shots)
def test_mirrored_spin_mirrors_the_curve(shot):
    u, v, w, p, q, r = shot
    there = simulate(level(TURF), Shot((u, v, w), (p, q, r)), effects=EVERYTHING, rate=20.0)
    back = simulate(level(TURF), Shot((u, -v, w), (-p, q, -r)), effects=EVERYTHING, rate=20.0)
    np.testing.assert_allclose(there.times, back.times, atol=1e-9)
    np.testing.assert_allclose(there.positions, back.positions * (1, -1, 1), atol=1e-9)
    np.testing.assert_allclose(there.spins, back.spins * (-1, 1, -1), atol=1e-6)
    assert there.result.side == pytest.approx(-back.result.side, abs=1e-9)


def test_sidespin_to_the_left_curves_left():
    left = simulate(level(TURF), Shot(launched(60, 0.3), (0, -200, 100)), effects=EVERYTHING)
    assert left.result.carry_side > 5


@few
@given(shots, st.tuples(*[st.floats(-200, 200)] * 2, st.floats(-20, 20)))
def test_a_shifted_course_shifts_the_path(shot, move):
    here = simulate(hilly(), Shot(shot[:3], shot[3:]), effects=EVERYTHING, rate=20.0)
    there = simulate(hilly(move), Shot(shot[:3], shot[3:]), effects=EVERYTHING, rate=20.0)
    assert_same_path(here, there, lambda places: places + move)


@few
@given(shots, st.floats(-pi, pi))
def test_a_turned_course_turns_the_path(shot, turn):
    matrix = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    # what is struck straight up has its sides told from the x axis
    assume(np.hypot(*shot[:2]) > 1e-3)
    here = simulate(hilly(), Shot(shot[:3], shot[3:]), effects=EVERYTHING, rate=20.0)
    there = simulate(
        hilly(turn=turn), Shot(matrix @ shot[:3], matrix @ shot[3:]), effects=EVERYTHING, rate=20.0
    )
    assert_same_path(here, there, lambda places: places @ matrix.T)


def assert_same_path(here, there, moved):
    """Before the first contact to rounding; then bounces may magnify it a thousandfold."""
    flying = int(20 * here.result.flight_time)
    assert there.result.status == here.result.status
    np.testing.assert_allclose(there.positions[:flying], moved(here.positions[:flying]), atol=1e-9)
    np.testing.assert_allclose(
        there.result.position, moved(np.array(here.result.position)), atol=1e-6
    )
    assert there.result.total == pytest.approx(here.result.total, abs=1e-6)
    assert there.result.side == pytest.approx(here.result.side, abs=1e-6)


@presets
def test_uniform_wind_is_a_change_of_frame(accuracy):
    course = level(TURF, wind_profile=UniformProfile())
    wind = np.array((6.0, -9.0, 1.5))
    for velocity, spin in zip(*random_shots(5, seed=4)):
        velocity[2] = 40.0
        windy = simulate(
            course,
            Shot(velocity, spin),
            wind=wind,
            effects=(*EVERYTHING, 'wind'),
            accuracy=accuracy,
            rate=50.0,
        )
        calm = simulate(
            course, Shot(velocity - wind, spin), effects=EVERYTHING, accuracy=accuracy, rate=50.0
        )
        flying = int(50 * min(windy.result.flight_time, calm.result.flight_time))
        assert flying > 100
        carried = calm.positions[:flying] + np.outer(calm.times[:flying], wind)
        np.testing.assert_allclose(windy.positions[:flying], carried, atol=1e-9)
        np.testing.assert_allclose(windy.spins[:flying], calm.spins[:flying], atol=1e-9)


# Wind

PROFILES = {
    'log': (LogProfile(0.03), lambda h: log(1 + h / 0.03) / log(1 + 10 / 0.03)),
    'power': (PowerProfile(0.2), lambda h: (h / 10) ** 0.2),
    'uniform': (UniformProfile(), lambda h: 1.0),
}


@pytest.mark.parametrize('name', PROFILES)
def test_wind_grows_with_height_over_the_ground_as_its_profile_says(name, told):
    heights, shares = told['wind'][name]
    np.testing.assert_allclose(shares, [PROFILES[name][1](h) for h in heights], rtol=1e-12)


def shares_of_wind(name):
    """Heights over the ground, and the wind there over that at 10 m.

    Once on the plain, once over a hill of 30 m.
    """
    ground = (
        Plane(material=TURF),
        Patch((100.0, 0.0, 30.0), length=20.0, width=20.0, material=TURF),
    )
    wind = np.array((3.0, -4.0, 0.5))
    model = World(Course(ground, wind_profile=PROFILES[name][0]), wind=wind)._model
    heights, shares = (0.1, 1.0, 10.0, 50.0), []
    for height in heights:
        for x, z in ((0.0, 0.0), (100.0, 30.0)):
            blows = wind_at(model.effects, model.land.ground, (x, 0.0, z + height))
            assert np.allclose(np.cross(blows, wind), 0.0)
            shares.append(float(np.dot(blows, wind) / np.dot(wind, wind)))
    return np.repeat(heights, 2), shares


def test_calm_air_has_no_wind_and_a_wind_that_comes_up_compiles_nothing():
    world = World(level(TURF))
    calm = world.program
    assert 'wind' not in world.effects_on and world.effects_off['wind'] == 'no wind'
    world.set_wind((1.0, 0.0, 0.0))
    assert 'wind' in world.effects_on and 'wind' not in world.effects_off
    assert world.program == calm
    world.set_wind((0.0, 0.0, 0.0))
    assert 'wind' not in world.effects_on
    assert 'constant_drag' not in EFFECTS


def test_a_head_wind_shortens_and_a_side_wind_moves_a_drive():
    def drive(wind):
        return simulate(level(TURF), Shot(*DRIVE), wind=wind, effects=(*EVERYTHING, 'wind')).result

    assert drive((-5, 0, 0)).carry < drive((1e-9, 0, 0)).carry - 10
    assert drive((0, 5, 0)).carry_side > 10
    assert radians(30) < drive((-5, 0, 0)).landing_angle < radians(60)


def test_the_apex_is_that_before_the_first_contact_not_of_a_later_hop():
    ramp = Patch((2.0, 0.0, 0.0), (-(0.5**0.5), 0.0, 0.5**0.5), 0.0, 2.0, 2.0, HARD)
    course = level(HARD, effects=GRAVITY)._replace(ground=(Plane(material=HARD), ramp))
    play = simulate(course, Shot((10.0, 0.0, 1.0)))
    assert play.result.apex == pytest.approx(0.5 / oracles.G, rel=1e-6)
    assert play.positions[:, 2].max() - play.positions[0, 2] > 5 * play.result.apex
    (told,) = simulate_many(course, [(10.0, 0.0, 1.0)], np.zeros((1, 3)), engine='python')
    assert told['apex'] == play.result.apex
