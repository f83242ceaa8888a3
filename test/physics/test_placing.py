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

"""Placing and teeing: the whole ball has room, on the ground, or it is refused with the reason."""

from math import cos, hypot, pi, sin

from driving_range import HARD, level
from golf_sim_ros.course import CourseError, load_course, shipped_courses
from golf_sim_ros.physics import (
    Ball,
    Course,
    Cylinder,
    Material,
    Patch,
    Phase,
    Plane,
    Result,
    Sphere,
    Water,
    World,
)
from oracles import RADIUS
import pytest

STEEP = Material('steep', HARD.restitution, 0.0, 0.5, 0.4, 0.05)
WOOD = Material('wood', HARD.restitution, 0.0, 0.4, 0.3)
STICK = 0.0095  # m, radius


def hillside(grade):
    """Make a course that rises towards +x."""
    return Course(
        (Plane(normal=(-grade / hypot(1, grade), 0, 1 / hypot(1, grade)), material=STEEP),),
        effects=('gravity',),
    )


@pytest.mark.parametrize('wind', [(0.0, 0.0, 0.0), (-40.0, 60.0, 0.0)])
@pytest.mark.parametrize('grade', [0.1, 0.3, 1.0, 10.0])
def test_a_teed_ball_is_held_on_any_slope_and_in_any_wind_until_it_is_struck(grade, wind):
    world = World(hillside(grade)._replace(effects='auto'), wind=wind)
    before = world['ball']
    assert before.phase == Phase.REST and not world.moving
    assert world.advance(10.0) == [] and world['ball'] == before
    world.set_wind((50.0, 0.0, 0.0))
    assert world.advance(10.0) == [] and world['ball'] == before
    world.strike('ball', (0.0, 0.0, 1.0))
    assert world.moving
    world.advance(2.0)
    assert world['ball'].position[0] < -0.1


def test_a_ball_that_is_placed_on_a_slope_that_does_not_hold_it_rolls():
    world = World(hillside(0.3))
    world.place('ball', (0.0, 0.0))
    world.advance(1.0)
    assert world['ball'].position[0] < -0.1


def test_a_teed_ball_that_is_hit_sets_off():
    world = World(hillside(0.3)._replace(effects=('gravity', 'ball_ball')), ('a', 'b'))
    x, y, z = world['b'].position
    world.place('a', (x - 0.1, y, z - 0.03 + 0.005), velocity=(3.0, 0.0, 0.9))
    world.advance(1.0)
    assert world['b'].position[0] < x - 0.01 or world['b'].position[0] > x + 0.01


def test_a_reset_tees_the_ball_on_the_slope_again():
    world = World(hillside(0.3))
    world.strike('ball', (5.0, 0.0, 5.0))
    world.advance(0.3)
    assert [result.status for result in world.reset()] == ['aborted']
    assert world['ball'].phase == Phase.REST and world['ball'].position[:2] == (0.0, 0.0)
    assert world.advance(5.0) == [] and not world.moving


def test_a_ball_that_is_lost_from_the_tee_is_held_there_again():
    world = World(hillside(0.3)._replace(bounds=((-1, -1), (1, -1), (1, 1), (-1, 1))))
    world.strike('ball', (-10.0, 0.0, 1.0))
    events = []
    while world.moving:
        events += world.advance(0.5)
    (result,) = (event for event in events if isinstance(event, Result))
    assert result.status in ('out_of_bounds', 'time_limit')
    assert result.status == 'time_limit' or world['ball'].position[:2] == (0.0, 0.0)


def test_a_tee_that_touches_a_wall_holds_the_ball():
    wall = Patch((RADIUS, 0.0, 0.0), (-1.0, 0.0, 0.0), 0.0, 1.0, 1.0, HARD)
    world = World(Course((Plane(material=HARD), wall), effects=('gravity',)))
    assert world['ball'].phase == Phase.REST
    world.strike('ball', (-3.0, 0.0, 0.0))
    assert world.advance(10.0)[-1].status == 'at_rest'


def saved(tmp_path, text):
    path = tmp_path / 'course.yaml'
    path.write_text('format: 1\n' + text)
    return path


@pytest.mark.parametrize(
    'what, reason',
    [
        (
            'obstacles:\n'
            '  - {shape: cylinder, base: [0, 0, 0], radius: 0.3, height: 8, material: rough}',
            'obstacle',
        ),
        (
            'obstacles: [{shape: sphere, center: [0.03, 0, 0.02], radius: 0.02, material: rough}]',
            'obstacle',
        ),
        ('water: [{polygon: [[-1, -1], [1, -1], [1, 1], [-1, 1]], level: 0.1}]', 'water'),
        ('tee: [5, 5]\nhole: [5, 5]\nball: {radius: 0.05}', 'flagstick'),
    ],
)
def test_a_tee_inside_of_something_is_an_error_of_the_course(tmp_path, what, reason):
    path = saved(tmp_path, f'ground: [{{shape: plane, material: green}}]\n{what}\n')
    with pytest.raises(CourseError) as error:
        load_course(path)
    (line,) = str(error.value).splitlines()
    assert line.startswith(f'{path}: tee [') and reason in line


def test_the_hillside_that_ended_the_node_is_played(tmp_path):
    course = load_course(
        saved(tmp_path, 'ground: [{shape: plane, normal: [-0.3, 0, 1], material: green}]\n')
    )
    world = World(course)
    world.strike('ball', (1.0, 0.0, 3.0))
    assert world.moving


@pytest.mark.parametrize('name', sorted(shipped_courses()))
def test_every_shipped_tee_is_taken_by_a_world(name):
    assert World(load_course(name))['ball'].phase == Phase.REST


def test_balls_that_do_not_fit_beside_each_other_are_an_error_of_the_parameter():
    strip = Patch((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.0, 2.0, 1.2, HARD)
    assert World(Course((strip,)), ('a', 'b', 'c'))['c'].phase == Phase.REST
    reason = '^balls a, b, c, d, e do not fit beside each other at the tee .*: a: no ground at'
    with pytest.raises(ValueError, match=reason):
        World(Course((strip,)), ('a', 'b', 'c', 'd', 'e'))


def test_large_balls_are_teed_further_apart():
    world = World(level(HARD)._replace(ball=Ball(radius=1.0)), ('a', 'b', 'c'))
    assert world['b'].position[1] - world['a'].position[1] == pytest.approx(2.2)


def beside(trunk, gap):
    """x, y of a ball beside a trunk, `gap` off it."""
    return trunk.base[0] + trunk.radius + RADIUS + gap, trunk.base[1]


@pytest.fixture
def trunk():
    return Cylinder((10.0, 0.0, -1.0), 0.3, 9.0, WOOD)


@pytest.fixture
def wood(trunk):
    """Make a world with a trunk 8 m high at x = 10, and a ball of stone over ground at x = 20."""
    stone = Sphere((20.0, 0.0, 0.5), 0.4, WOOD)
    return World(Course((Plane(material=HARD),), obstacles=(trunk, stone)))


@pytest.mark.parametrize('gap', [-0.3, -0.1, -RADIUS, -0.005, -1e-5])
def test_a_place_that_is_partly_inside_a_trunk_is_refused(wood, trunk, gap):
    before = wood['ball']
    for place in (beside(trunk, gap), (*beside(trunk, gap), RADIUS), (*beside(trunk, gap), 4.0)):
        with pytest.raises(ValueError, match=r'lies [\d.e-]+ m deep in an obstacle'):
            wood.place('ball', place)
    assert wood['ball'] == before


@pytest.mark.parametrize('gap', [0.0, 1e-5, 0.005])
def test_a_place_beside_a_trunk_is_taken_and_the_ball_stays(wood, trunk, gap):
    wood.place('ball', beside(trunk, gap))
    wood.advance(1.0)
    assert wood['ball'].position == pytest.approx((*beside(trunk, gap), RADIUS), abs=1e-6)


def test_a_place_under_a_stone_is_on_the_ground(wood):
    wood.place('ball', (20.0, 0.0))
    assert wood['ball'].position == pytest.approx((20.0, 0.0, RADIUS), abs=1e-9)
    with pytest.raises(ValueError, match='obstacle'):
        wood.place('ball', (20.0, 0.0, 0.1))


@pytest.fixture
def green():
    """Make a world with a hole and a flagstick 3 m from the tee."""
    return World(Course((Plane(material=HARD),), hole=(3.0, 0.0)))


@pytest.mark.parametrize('away', [0.0, 0.01, 0.02, STICK + RADIUS])
@pytest.mark.parametrize('angle', [0.0, 2.0, -pi / 2])
def test_a_ball_that_is_placed_on_the_hole_drops_in_beside_the_stick(green, away, angle):
    green.place('ball', (3.0 + away * cos(angle), away * sin(angle)))
    green.advance(2.0)
    ball = green['ball']
    assert ball.phase == Phase.HOLED
    assert hypot(ball.position[0] - 3.0, ball.position[1]) >= STICK + RADIUS - 1e-6


def test_a_ball_that_is_placed_on_a_hole_without_stick_drops_in():
    world = World(Course((Plane(material=HARD),), hole=(3.0, 0.0), flagstick=False))
    world.place('ball', (3.0, 0.0))
    assert world['ball'].phase == Phase.HOLED and world['ball'].position[:2] == (3.0, 0.0)


def test_a_ball_too_large_to_drop_in_beside_the_stick_is_refused():
    world = World(Course((Plane(material=HARD),), hole=(3.0, 0.0), ball=Ball(radius=0.025)))
    with pytest.raises(ValueError, match='flagstick'):
        world.place('ball', (3.0, 0.0))


def test_a_place_on_the_bank_of_water_is_refused_where_the_ball_would_lie_in_it():
    pond = Water(((1.0, -1.0), (5.0, -1.0), (5.0, 1.0), (1.0, 1.0)), 0.05)
    world = World(Course((Plane(material=HARD),), water=(pond,)))
    with pytest.raises(ValueError, match='lies in water'):
        world.place('ball', (2.0, 0.0))
    world.place('ball', (0.9, 0.0))


@pytest.mark.parametrize('place', [(1e308, 0.0), (0.0, -1.1e6), (0.0, 0.0, 1e9), (3e6, 0.0, 0.1)])
def test_a_place_out_of_this_world_is_refused(place):
    world = World(level(HARD))
    with pytest.raises(ValueError, match='farther away than 1e[+]06 m'):
        world.place('ball', place)


@pytest.mark.parametrize('accuracy', ['standard', 'reference'])
@pytest.mark.parametrize(
    'place', [(1e6, 0.0), (-1e6, 1e6), (645447.3692832283, 898691.9485607379)]
)
def test_a_weak_shot_far_away_comes_to_rest_in_few_segments(place, accuracy):
    world = World(level(HARD), accuracy=accuracy)
    world.place('ball', place)
    world.strike('ball', (-1.2e-4, 9e-4, -4e-4))
    assert world.advance(10.0)[-1].status == 'at_rest'
    assert world._balls['segments_spent'][0] < 100


def test_strikes_are_counted_from_the_tee():
    world = World(
        Course(
            (Plane(material=HARD),),
            hole=(3.0, 0.0),
            effects=('gravity',),
            bounds=((-5, -5), (9, -5), (9, 5), (-5, 5)),
        )
    )

    def played(velocity):
        world.strike('ball', velocity)
        (result,) = (event for event in world.advance(60.0) if isinstance(event, Result))
        return result.status, result.stroke, result.penalty

    assert played((1.0, 0.5, 0.0)) == ('at_rest', 1, 0)
    assert played((20.0, 0.0, 0.0)) == ('out_of_bounds', 2, 1)
    world.place('ball', (2.0, 1.0))  # a free place: the count goes on
    assert played((0.0, -1e-9, 0.0)) == ('at_rest', 3, 0)
    world.place('ball', (3.0, 0.0))
    assert world['ball'].phase == Phase.HOLED
    world.place('ball', (0.0, 0.0))  # the next tee
    assert played((0.5, 0.5, 0.0)) == ('at_rest', 1, 0)
    assert played((0.5, 0.5, 0.0)) == ('at_rest', 2, 0)
    world.reset()
    assert played((0.5, 0.5, 0.0)) == ('at_rest', 1, 0)
