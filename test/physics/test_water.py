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

"""Water and bounds: where a ball is in, what becomes of its shot, and where it is put back."""

from math import cos, hypot, pi, radians, sin, sqrt
import os

from golf_sim_ros.physics import (
    Ball,
    Collision,
    Course,
    Material,
    Patch,
    Phase,
    Plane,
    Restitution,
    Result,
    simulate_many,
    Water,
    World,
)
import numpy as np
from oracles import RADIUS
import pytest
from scipy.integrate import solve_ivp

SHOTS = int(os.environ.get('RANDOM_SHOTS', 300)) // 10
GRAVITY = 9.80665
TURF = Material('turf', Restitution(0.4), 0.0, 0.4, 0.4, 0.1)
POND = ((10.0, -5.0), (40.0, -5.0), (40.0, 5.0), (10.0, 5.0))
LEVEL = -0.2
CALM = ('gravity', 'water', 'ball_ball')


def pond(depth=2.0, **more):
    """Course with a pond from x = 10 to 40 m, `depth` deep."""
    floor = Patch((25.0, 0.0, LEVEL - depth), (0, 0, 1), 0.0, 30.0, 10.0, TURF)
    course = Course(
        (Plane(material=TURF, cut=(POND,)), floor), water=(Water(POND, LEVEL),), effects=CALM
    )
    return course._replace(**more)


def bank():
    """Course with a straight slope down into water whose outline lies well up the slope."""
    slope = Plane((0, 0, 0), (0.1, 0, 1), TURF)
    outline = ((5.0, -5.0), (60.0, -5.0), (60.0, 5.0), (5.0, 5.0))
    return Course((slope,), water=(Water(outline, -1.0),), effects=CALM)


def split(events):
    """Collisions and results among `events`."""
    return (
        [event for event in events if isinstance(event, Collision)],
        [event for event in events if isinstance(event, Result)],
    )


def into(angle, speed=30.0, **more):
    """Collisions of a ball that meets the water at `angle` [rad] below the horizontal."""
    world = World(pond(**more))
    world.place('ball', (15.0, 0.0, LEVEL + 1e-6), (speed * cos(angle), 0.0, -speed * sin(angle)))
    return split(world.advance(0.01))[0]


def test_a_ball_in_the_pond_ends_as_water_once_and_is_back_on_its_spot():
    world = World(pond())
    spot = world['ball'].position
    world.strike('ball', (10.0, 0.0, 8.0))
    (wet,), (result,) = split(world.advance(20.0))
    assert (result.status, result.lie) == ('water', 'water')
    assert world['ball'].position == spot and world['ball'].phase == Phase.REST
    falls = (8.0 + sqrt(64.0 + 2 * GRAVITY * (spot[2] - LEVEL))) / GRAVITY
    assert wet.time == result.flight_time == pytest.approx(falls, abs=1e-9)
    assert result.carry == pytest.approx(10.0 * falls, abs=1e-8)
    assert result.position[2] < LEVEL - 2 * RADIUS
    world.strike('ball', (1.0, 0.0, 0.0))
    assert split(world.advance(20.0))[1][0].status == 'at_rest'


def test_meeting_water_is_told_as_a_collision():
    world = World(pond())
    world.strike('ball', (10.0, 0.0, 8.0), (0.0, -50.0, 0.0))
    (wet,), _ = split(world.advance(20.0))
    assert (wet.kind, wet.with_, wet.normal) == ('water', 'water', (0.0, 0.0, 1.0))
    assert wet.position[2] == pytest.approx(LEVEL, abs=1e-9)
    assert wet.velocity_before[2] < wet.velocity_after[2] < 0
    change = np.subtract(wet.velocity_after, wet.velocity_before)
    assert wet.impulse == pytest.approx(Ball().mass * change)


@pytest.mark.parametrize('speed', [12.0, 60.0])
@pytest.mark.parametrize('mass', [Ball().mass, 0.08])
def test_a_fast_ball_skips_below_the_critical_angle_and_no_steeper(speed, mass):
    gravity = mass / (4 / 3 * pi * RADIUS**3 * 998.0)
    critical = radians(18.0) / sqrt(gravity)
    (skip,) = into(0.99 * critical, speed, ball=Ball(mass=mass))
    assert skip.velocity_after[2] > 0 and hypot(*skip.velocity_after) < hypot(
        *skip.velocity_before
    )
    (dive,) = into(1.01 * critical, speed, ball=Ball(mass=mass))
    assert dive.velocity_after[2] < 0


def test_a_slow_ball_does_not_skip():
    assert into(radians(5.0), 9.0)[0].velocity_after[2] < 0


def test_a_ball_under_water_falls_as_drag_buoyancy_and_the_water_it_carries_along_say():
    world = World(pond(depth=8.0), accuracy='reference')
    world.place('ball', (20.0, 0.0, LEVEL + 1e-9), (8.0, 0.0, -12.0))
    wet = split(world.advance(0.001))[0][0]
    volume = 4 / 3 * pi * RADIUS**3
    mass, moved = Ball().mass, Ball().mass + 0.5 * 998.0 * volume
    assert wet.velocity_after == pytest.approx(np.multiply(wet.velocity_before, mass / moved))

    def rates(_, state):
        v = state[3:]
        force = -0.5 * 998.0 * 0.45 * pi * RADIUS**2 * np.linalg.norm(v) * v
        force[2] -= (mass - 998.0 * volume) * GRAVITY
        return [*v, *(force / moved)]

    start = [*wet.position, *wet.velocity_after]
    path = solve_ivp(rates, (0, 0.15), start, 'DOP853', rtol=1e-12, atol=1e-12, dense_output=True)
    for _ in range(14):
        world.advance(0.01)
        ball = world['ball']
        assert [*ball.position, *ball.velocity] == pytest.approx(
            path.sol(world.time - wet.time), abs=1e-7
        )
    assert world['ball'].phase == Phase.FLIGHT


def test_where_a_ball_is_in_the_water_is_found_exactly_whatever_the_shot():
    rng = np.random.default_rng(5)
    world, found = World(pond()), 0
    for _ in range(SHOTS):
        world.strike('ball', (*rng.uniform((3, -4), (25, 4)), rng.uniform(1, 12)))
        events = []
        while not split(events)[1]:
            events += world.advance(0.1)
        hits, (result,) = split(events)
        wet = [hit for hit in hits if hit.kind == 'water']
        assert (result.status == 'water') == any(hit.velocity_after[2] < 0 for hit in wet)
        for hit in wet:
            found += 1
            x, y, z = hit.position
            assert z == pytest.approx(LEVEL, abs=1e-9)
            assert 10 - 1e-9 <= x <= 40 + 1e-9 and abs(y) <= 5 + 1e-9
        world.reset()
    assert found > SHOTS // 4


def test_ticks_do_not_count():
    ends = []
    for tick in (30.0, 0.004, 0.0371):
        world = World(pond())
        world.strike('ball', (25.0, 0.3, 3.0))
        events = []
        while not split(events)[1]:
            events += world.advance(tick)
        ends.append([tuple(event)[1:] for event in events])
    assert [len(told) for told in ends] == [len(ends[0])] * 3 and len(ends[0]) > 2
    for told in zip(*ends):
        for one in told[1:]:
            for a, b in zip(one, told[0]):
                assert a == b or a == pytest.approx(b, abs=1e-9)


def test_a_ball_that_rolls_down_a_bank_is_in_the_water_where_its_middle_is():
    world = World(bank())
    world.strike('ball', (5.0, 0.0, -0.5))
    (wet,), (result,) = split(world.advance(30.0))
    assert (wet.kind, result.status) == ('water', 'water')
    assert wet.position[2] == pytest.approx(-1.0, abs=1e-9) and wet.position == result.position
    assert world['ball'].phase == Phase.REST and world['ball'].position[0] == pytest.approx(
        0.0, abs=0.01
    )


def test_a_ball_that_comes_through_the_side_of_the_outline_is_in_the_water_there():
    course = bank()._replace(
        water=(Water(((20.0, -5.0), (60.0, -5.0), (60.0, 5.0), (20.0, 5.0)), -1.0),)
    )
    world = World(course)
    world.strike('ball', (6.0, 0.0, -0.6))
    (*_, wet), (result,) = split(world.advance(30.0))
    assert wet.kind == 'water' and result.status == 'water'
    assert wet.position[0] == pytest.approx(20.0, abs=1e-9)


def test_where_the_ground_is_higher_than_the_level_there_is_no_water():
    outline = ((-50.0, -5.0), (60.0, -5.0), (60.0, 5.0), (-50.0, 5.0))
    world = World(bank()._replace(water=(Water(outline, -1.0),)))
    world.strike('ball', (-3.0, 0.0, 0.3))
    hits, _ = split(world.advance(1.0))
    assert not hits and world['ball'].position[0] < -1.0


def test_a_pond_without_a_floor_and_a_ball_that_floats_end_the_shot_too():
    for course in (
        pond()._replace(ground=(Plane(material=TURF, cut=(POND,)),)),
        pond(ball=Ball(mass=0.02)),
        pond(effects=('gravity',)),
    ):
        world = World(course)
        world.strike('ball', (10.0, 0.0, 8.0))
        assert split(world.advance(60.0))[1][0].status == 'water'


def test_a_ball_knocked_into_the_water_is_back_without_a_result():
    world = World(pond(tee=(8.0, 0.0)), ('a', 'b'))
    world.place('a', (7.0, 0.0))
    world.place('b', (9.5, 0.0))
    spot = world['b'].position
    world.strike('a', (3.7, 0.0, 0.0))
    hits, results = split(world.advance(30.0))
    assert [hit.ball for hit in hits if hit.kind == 'water'] == ['b']
    assert [result.ball for result in results] == ['a']
    assert world['b'].position == spot and world['b'].phase == Phase.REST


def test_a_dropped_ball_is_put_beside_one_that_has_come_to_lie_there():
    world = World(pond(), ('a', 'b'))
    world.place('a', (0.0, 0.0))
    world.strike('a', (10.0, 0.0, 8.0))
    world.advance(0.5)
    world.place('b', (0.0, 0.0))
    world.advance(10.0)
    a, b = world['a'], world['b']
    assert a.phase == b.phase == Phase.REST and b.position[:2] == (0.0, 0.0)
    apart = np.linalg.norm(np.subtract(a.position, b.position))
    assert 2 * RADIUS < apart < 3 * RADIUS
    assert a.position[2] == pytest.approx(RADIUS, abs=1e-9)


@pytest.mark.parametrize('bystanders', [0, 1, 5, 50])
def test_a_moving_ball_does_not_pass_through_one_that_is_dropped_in_its_way(bystanders):
    others = [f'c{i}' for i in range(bystanders)]
    world = World(pond(), ('a', 'b', *others))
    for i, name in enumerate(others):
        world.place(name, (-20.0, 0.3 * i))
    world.place('b', (-4.0, 0.0))
    world.place('a', (0.0, 0.0))
    world.strike('a', (10.0, 0.0, 8.0))
    world.advance(1.7)
    world.strike('b', (4.0, 0.0, 0.0))
    events = []
    for _ in range(400):
        events += world.advance(0.01)
    assert any(hit.kind == 'ball' for hit in split(events)[0])


def test_a_ball_cannot_be_placed_in_water():
    world = World(pond())
    for place in ((20.0, 0.0), (20.0, 0.0, LEVEL - 0.5)):
        with pytest.raises(ValueError, match='lies in water'):
            world.place('ball', place)
    world.place('ball', (20.0, 0.0, LEVEL + 0.5))


def test_a_ball_may_go_on_from_its_state_while_it_sinks():
    world = World(pond())
    world.strike('ball', (10.0, 0.0, 8.0))
    world.advance(1.7)
    again = World(pond())
    again.restore(world.state())
    ends = []
    for one in (world, again):
        one.advance(0.05)
        assert one['ball'].position[2] < LEVEL
        ends.append((one['ball'], one.state()['balls']['ball']['water']))
    assert ends[0] == ends[1] and ends[0][1] == 1


def test_many_shots_are_told_the_same():
    strikes = [(10.0, 0.0, 8.0), (25.0, 0.0, 3.0), (3.0, 0.0, 1.0)]
    told = simulate_many(pond(), strikes, np.zeros((3, 3)), engine='python')
    assert (
        list(told['status']) == ['water', 'water', 'at_rest']
        and list(told['lie'][:2]) == ['water'] * 2
    )


def test_a_course_with_water_compiles_nothing_that_one_without_does_not():
    wet, dry = World(pond(effects='auto')), World(pond(effects='auto', water=()))
    assert 'water' in wet.effects_on and dry.effects_off['water'] == 'no water'
    assert wet.program == dry.program


# Bounds


def test_a_ball_that_goes_out_is_told_as_a_collision_just_before_its_result():
    course = Course(
        (Plane(material=TURF),),
        effects=('gravity',),
        bounds=((-5.0, -5.0), (9.0, -5.0), (9.0, 5.0), (-5.0, 5.0)),
    )
    world = World(course)
    world.strike('ball', (7.0, 0.0, 0.0))
    events = world.advance(20.0)
    out, result = events
    assert (out.kind, out.with_, result.status) == ('out_of_bounds', 'turf', 'out_of_bounds')
    assert out.position == result.position and out.position[0] > 9.0 + RADIUS
    assert out.velocity_before == out.velocity_after == out.impulse == (0.0, 0.0, 0.0)
    assert (result.stroke, result.penalty) == (1, 1)
    free = World(course._replace(bounds=None))
    free.strike('ball', (7.0, 0.0, 0.0))
    # where it comes to rest, as without bounds
    assert free.advance(20.0)[0].position == result.position


@pytest.mark.parametrize('beyond, status', [(-0.001, 'at_rest'), (0.001, 'out_of_bounds')])
def test_a_ball_is_out_only_if_all_of_it_lies_beyond_the_line(beyond, status):
    course = Course((Plane(material=TURF),), effects=('gravity',))
    world = World(course)
    world.strike('ball', (3.0, 0.0, 0.0))
    rest = world.advance(20.0)[0].position
    line = rest[0] - RADIUS - beyond
    world = World(course._replace(bounds=((-5.0, -5.0), (line, -5.0), (line, 5.0), (-5.0, 5.0))))
    world.strike('ball', (3.0, 0.0, 0.0))
    result = world.advance(20.0)[-1]
    assert (result.status, result.position) == (status, rest)


def test_a_ball_that_rolls_back_over_the_line_is_in_play():
    away = 1.0 / np.hypot(1.0, 0.1)
    smooth = TURF._replace(rolling_resistance=0.02)
    course = Course(
        (Plane(material=smooth), Plane((3.0, 0.0, 0.0), (-0.1 * away, 0.0, away), smooth)),
        effects=('gravity',),
        bounds=((-90.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-90.0, 5.0)),
    )
    world = World(course)
    world.strike('ball', (3.9, 0.0, 0.0), (0.0, 3.9 / RADIUS, 0.0))
    furthest, events = 0.0, []
    while world.moving:
        events += world.advance(0.01)
        furthest = max(furthest, world['ball'].position[0])
    assert furthest > 5.0 + RADIUS
    assert events[-1].status == 'at_rest' and events[-1].position[0] < 5.0


def test_a_ball_that_lands_out_is_told_of_the_bounces_and_at_its_rest_of_the_bounds():
    course = Course(
        (Plane(material=TURF),),
        effects=('gravity',),
        bounds=((-5.0, -5.0), (9.0, -5.0), (9.0, 5.0), (-5.0, 5.0)),
    )
    world = World(course)
    world.strike('ball', (10.0, 0.0, 8.0))
    hits, (result,) = split(world.advance(20.0))
    assert {hit.kind for hit in hits[:-1]} == {'bounce'} and hits[-1].kind == 'out_of_bounds'
    assert result.status == 'out_of_bounds' and hits[-1].time == result.time and len(hits) > 2


def test_a_ball_that_falls_off_the_edge_of_all_ground_is_out():
    world = World(
        Course((Patch((0, 0, 0), (0, 0, 1), 0.0, 10.0, 10.0, TURF),), effects=('gravity',))
    )
    world.strike('ball', (8.0, 0.0, 0.0))
    hits, (result,) = split(world.advance(20.0))
    assert hits[-1].kind == result.status == 'out_of_bounds'
    assert world['ball'].phase == Phase.REST and world['ball'].position[:2] == (0.0, 0.0)


def test_water_out_of_bounds_is_out_of_bounds():
    world = World(pond(bounds=((-5.0, -5.0), (9.0, -5.0), (9.0, 5.0), (-5.0, 5.0))))
    world.strike('ball', (10.0, 0.0, 8.0))
    hits, (result,) = split(world.advance(20.0))
    assert [hit.kind for hit in hits] == [
        'water',
        'out_of_bounds',
    ] and result.status == 'out_of_bounds'


@pytest.mark.parametrize('order', [('a', 'b'), ('b', 'a')])
def test_balls_that_meet_in_the_air_beyond_the_bounds_are_not_out_yet(order):
    world = World(
        Course(
            (Plane(material=TURF),),
            effects=('gravity', 'ball_ball'),
            bounds=((-5.0, -5.0), (9.0, -5.0), (9.0, 5.0), (-5.0, 5.0)),
        ),
        ('a', 'b'),
    )
    starts = {
        'a': ((18.0, 0.0, 0.25), (10.0, 0.0, 0.0)),
        'b': ((20.0, 0.0, 0.25), (-1.0, 0.0, 0.0)),
    }
    for name in order:
        world.place(name, *starts[name])
    met, *_ = world.advance(0.2)
    assert met.kind == 'ball' and world['a'].phase == world['b'].phase == Phase.FLIGHT
