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

"""Moving air pushes balls that roll, slide or rest on the ground."""

from math import hypot, pi, sqrt

from golf_sim_ros.course.material_file import materials, shipped
from golf_sim_ros.physics import Course, Heightmap, Material, Plane, Restitution, Shot, simulate
from golf_sim_ros.physics import World
from golf_sim_ros.physics.effects import EFFECTS, protocol, Scene
from golf_sim_ros.physics.effects.wind import LogProfile, UniformProfile
import numpy as np
import pytest
from scipy.integrate import solve_ivp

FOOT = 0.3048
G = 9.80665
RADIUS = 0.021335
EVEN = UniformProfile()
STIMP = 1.83  # m/s with which a stimpmeter releases a ball: USGA


def green(feet, profile=EVEN, **more):
    """Level green of a stimp reading in feet."""
    resistance = STIMP**2 / (2.0 * G * feet * FOOT)
    grass = Material('green', Restitution(0.3), 0.0, 0.4, 0.45, resistance, 0.0)
    return Course((Plane(material=grass),), wind_profile=profile, **more)


def putt(course, speed, wind, **how):
    """Play a putt along x that rolls from the start; its result."""
    spin = (0.0, speed / RADIUS, 0.0)
    return simulate(course, Shot((speed, 0.0, 0.0), spin), wind=wind, **how).result


def drag_rate(course, velocity, spin):
    """Acceleration [m/s^2] by drag and lift of a ball at `velocity` through the air."""
    scene = Scene(course)
    speed = sqrt(sum(v * v for v in velocity))
    flow = protocol.Flow(velocity, speed, spin, (0.0, 0.0, RADIUS), velocity)
    forces = [
        protocol.acceleration(EFFECTS[name].record(scene), flow) for name in ('drag', 'magnus')
    ]
    return np.sum(forces, 0)


def rolled(course, speed, wind, share=1.0):
    """End (x, y) of a rolling ball by an ODE of its own, in `wind` times `share` at its height."""
    resistance = course.ground[0].material.rolling_resistance

    def rates(time, state):
        v = state[2:]
        spin = (-v[1] / RADIUS, v[0] / RADIUS, 0.0)
        through = (v[0] - wind[0] * share, v[1] - wind[1] * share, 0.0)
        push = drag_rate(course, through, spin) - drag_rate(course, (v[0], v[1], 0.0), spin)
        press = G - push[2]
        return [*v, *(5 / 7 * push[:2] - resistance * press * v / hypot(*v))]

    def stops(time, state):
        return hypot(*state[2:]) - 1e-4

    stops.terminal = True
    found = solve_ivp(
        rates, (0.0, 60.0), [0.0, 0.0, speed, 0.0], events=stops, rtol=1e-9, atol=1e-10
    )
    return found.y[:2, -1]


def speed_for(feet, stimp):
    """Speed [m/s] of a putt that rolls so many feet on a level green in still air."""
    return STIMP * sqrt(feet / stimp)


def test_a_putt_across_a_uniform_wind_is_moved_as_pelz_measured():
    course = green(9.5)
    result = putt(course, speed_for(9.0, 9.5), (0.0, 4.5, 0.0))
    assert 0.2 < result.side < 0.4


@pytest.mark.parametrize('speed', [0.4, 1.8, 4.0])
@pytest.mark.parametrize(
    'blows, heading',
    [
        *((blows, heading) for blows in (2.0, 4.5) for heading in (0.0, 0.25, 0.5, 1.0)),
        (8.94, 0.5),
    ],
)
def test_a_rolling_ball_follows_its_equation_of_motion(speed, blows, heading):
    course = green(9.5)
    wind = (blows * np.cos(heading * pi), blows * np.sin(heading * pi), 0.0)
    result = putt(course, speed, wind)
    np.testing.assert_allclose(result.position[:2], rolled(course, speed, wind), atol=1e-3)


def test_the_wind_is_that_at_the_height_of_the_balls_centre():
    course = green(10.0, profile=LogProfile(0.01))
    speed = speed_for(5.5 / FOOT, 10.0)
    share = np.log(1.0 + RADIUS / 0.01) / np.log(1.0 + 10.0 / 0.01)
    result = putt(course, speed, (0.0, 10.0, 0.0))
    np.testing.assert_allclose(
        result.position[:2], rolled(course, speed, (0.0, 10.0), share), atol=1e-3
    )
    assert 0.09 < result.side < 0.16


def hold(course):
    """Wind [m/s] that just holds a resting ball: 5/7 of its drag over mass is what resists it."""
    resistance = course.ground[0].material.rolling_resistance
    low, high = 0.0, 40.0
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        push = drag_rate(course, (-middle, 0.0, 0.0), (0.0, 0.0, 0.0))
        low, high = (low, middle) if 5 / 7 * push[0] > resistance * G else (middle, high)
    return low


@pytest.mark.parametrize('engine', ['python', 'compiled'])
def test_a_ball_at_rest_sets_off_in_a_wind_that_overcomes_what_holds_it(engine):
    course = green(10.0)
    world = World(course, engine=engine)
    world.place('ball', (3.0, 1.0))
    just = hold(course)
    world.set_wind((0.99 * just, 0.0, 0.0))
    world.advance(5.0)
    assert world['ball'].position[:2] == (3.0, 1.0)
    world.set_wind((1.01 * just, 0.0, 0.0))
    world.advance(5.0)
    assert world['ball'].position[0] > 3.01
    world.set_wind((0.0, 0.0, 0.0))
    world.advance(30.0)
    stopped = world['ball'].position
    world.advance(30.0)
    assert world['ball'].position == stopped and not world.in_motion


def test_a_ball_on_its_tee_stays_in_any_wind():
    world = World(green(10.0), wind=(60.0, 0.0, 0.0))
    teed = world['ball'].position
    world.set_wind((0.0, 60.0, 0.0))
    world.advance(10.0)
    assert world['ball'].position == teed and not world.in_motion


def test_a_ball_rests_in_the_hole_in_any_wind():
    course = green(10.0, hole=(2.0, 0.0), flagstick=False)
    result = putt(course, speed_for(2.3 / FOOT, 10.0), (3.0, 0.0, 0.0))
    assert result.status == 'holed'
    result = putt(course, speed_for(1.4 / FOOT, 10.0), (12.0, 0.0, 0.0))
    assert result.status == 'holed'


def test_with_the_wind_a_putt_is_longer_and_against_it_shorter():
    course = green(10.0)
    ends = [
        putt(course, 1.5, (blows, 0.0, 0.0)).position[0] for blows in (-4.0, -2.0, 0.0, 2.0, 4.0)
    ]
    assert all(np.diff(ends) > 0.03)


def test_still_air_costs_nothing_and_changes_no_bit():
    world = World(green(10.0), engine='python')
    assert [type(record).__name__ for record in world._model.land.air] == ['Nothing']
    ends = [
        putt(green(10.0), 1.5, (0.0, 0.0, 0.0), effects=names) for names in ('auto', 'gravity')
    ]
    assert ends[0].position == ends[1].position


@pytest.mark.parametrize('engine', ['python', 'compiled'])
def test_a_ball_on_curved_ground_is_pushed_as_on_a_plane(engine):
    course = green(10.0)
    flat = putt(course, 1.5, (1.0, 3.0, 0.0), engine=engine)
    heights = np.zeros((40, 40))
    sheet = Heightmap(heights, (-10.0, -10.0), 0.5, course.ground[0].material)
    curved = putt(course._replace(ground=(sheet,)), 1.5, (1.0, 3.0, 0.0), engine=engine)
    np.testing.assert_allclose(curved.position, flat.position, atol=1e-5)


def test_gusts_end_the_segments_of_rolling_balls_too():
    course = green(10.0)
    gusts = [(0.0, 0.0, 0.0, 0.0), (0.5, 0.0, 3.0, 0.0), (1.5, 0.0, 0.0, 0.0)]
    shot = Shot((1.5, 0.0, 0.0), (0.0, 1.5 / RADIUS, 0.0))
    one = simulate(course, shot, wind=gusts, engine='python').result
    still = simulate(course, shot, engine='python').result
    assert 0.01 < one.side < 0.5 and still.side == 0.0


def test_balls_come_to_rest_or_roll_on_in_every_wind_and_on_every_turf():
    known = materials({}, shipped()[0])
    for name in ('green', 'fairway', 'rough', 'sand', 'concrete'):
        if name not in known:
            continue
        course = Course((Plane(material=known[name]),), wind_profile=UniformProfile())
        for blows in (0.5, 5.0, 20.0, 60.0):
            world = World(course, wind=(0.0, blows, 0.0), engine='python')
            world.place('ball', (0.0, 0.0, RADIUS), (3.0, 0.0, 0.0))
            world.advance(2.0)
            ball = world['ball']
            assert np.isfinite([*ball.position, *ball.velocity]).all()
            assert hypot(*ball.velocity[:2]) < 3.0 + blows
            assert ball.position[2] == pytest.approx(RADIUS, abs=0.5)
