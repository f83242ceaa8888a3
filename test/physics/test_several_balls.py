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

"""Several balls: impacts of two, of many at one instant, and balls that lean on each other."""

from itertools import permutations
import json

from golf_sim_ros.physics import Ball, Course, Material, Patch, Phase, Plane, Restitution, World
from golf_sim_ros.physics.state.events import new_log, next_event
from hard_scenes import IN_A_BOWL, poured
import numpy as np
from other_process import run
import pytest

RADIUS = Ball().radius
IDEAL = Material('ideal', Restitution(1.0))
CLOTH = Material('cloth', Restitution(0.5), 0.0, 0.2, 0.2, 0.01)
FLOOR = Material('floor', Restitution(0.5), 0.0, 0.4, 0.3, 0.02, 0.001)


def table(material, balls, restitution=1.0, friction=0.0):
    """World of `balls` far away from the origin on a level plane."""
    course = Course(
        (Plane(material=material),),
        tee=(0.0, 500.0),
        ball=Ball(restitution=restitution, friction=friction),
        effects=('gravity', 'ball_ball'),
    )
    return World(course, balls)


def rolling(speed):
    """Velocity and spin of a ball that rolls along x."""
    return {'velocity': (speed, 0.0, 0.0), 'spin': (0.0, speed / RADIUS, 0.0)}


def motion(world, names):
    """Positions and velocities of balls, two (n, 3) arrays."""
    return (
        np.array([world[name].position for name in names]),
        np.array([world[name].velocity for name in names]),
    )


def cradle(order, restitution):
    """Velocities along x after the ball that `order` names first has hit the row of the others."""
    world = table(IDEAL, len(order), restitution)
    names = [world.names[i] for i in order]
    for k, name in enumerate(names[1:]):
        world.place(name, (2 * RADIUS * k, 0.0, RADIUS))
    world.place(names[0], (-0.3, 0.0, RADIUS), velocity=(2.0, 0.0, 0.0))
    world.advance(0.5)
    return motion(world, names)[1][:, 0]


@pytest.mark.parametrize('order', list(permutations(range(5)))[::17])
def test_a_row_of_five_passes_all_the_speed_on_whatever_their_order(order):
    assert cradle(order, 1.0) == pytest.approx([0, 0, 0, 0, 2.0], abs=1e-9)


def test_a_row_of_twenty_passes_all_the_speed_on():
    order = np.random.default_rng(4).permutation(20)
    assert cradle(order, 1.0) == pytest.approx([0.0] * 19 + [2.0], abs=1e-9)


def test_each_impact_of_a_row_that_gives_less_back_passes_half_of_1_plus_e_on():
    assert cradle(range(5), 0.9)[-1] == pytest.approx(2.0 * 0.95**4, abs=1e-9)


def rack(order, friction):
    """Positions, velocities and collisions after a break head-on, in the order of their places."""
    world = table(CLOTH, 16, 0.9, friction)
    names = [world.names[i] for i in order]
    places = [
        (row * np.sqrt(3) * RADIUS, (2 * k - row) * RADIUS)
        for row in range(5)
        for k in range(row + 1)
    ]
    for name, place in zip(names[1:], places):
        world.place(name, (*place, RADIUS))
    world.place(names[0], (-0.3, 0.0, RADIUS), **rolling(5.0))
    collisions = world.advance(0.1)
    return *motion(world, names), collisions


MIRRORED = [0] + [1 + row * (row + 1) // 2 + row - k for row in range(5) for k in range(row + 1)]


@pytest.mark.parametrize('friction', [0.0, 0.2])
def test_a_rack_broken_head_on_is_symmetric_and_does_not_know_its_order(friction):
    places, velocities, collisions = rack(range(16), friction)
    others, their_velocities, _ = rack(np.random.default_rng(7).permutation(16), friction)
    assert np.abs(places - others).max() < 1e-9
    assert np.abs(velocities - their_velocities).max() < 1e-9
    mirror = np.array([1, -1, 1])
    assert np.abs(places[MIRRORED] * mirror - places).max() < 1e-9
    assert np.abs(velocities[MIRRORED] * mirror - velocities).max() < 1e-9
    assert any(c.kind == 'ball' for c in collisions)
    apart = np.linalg.norm(places[:, None] - places[None], axis=2) + np.eye(16)
    assert apart.min() > 2 * RADIUS - 1e-6


def test_a_break_without_friction_keeps_the_momentum():
    world = table(IDEAL, 16, 0.9)
    places = [
        (row * np.sqrt(3) * RADIUS, (2 * k - row) * RADIUS)
        for row in range(5)
        for k in range(row + 1)
    ]
    for name, place in zip(world.names[1:], places):
        world.place(name, (*place, RADIUS))
    world.place(world.names[0], (-0.3, 0.01, RADIUS), velocity=(5.0, 0.0, 0.0))
    world.advance(0.5)
    velocities = motion(world, world.names)[1]
    assert velocities.sum(0) == pytest.approx([5.0, 0.0, 0.0], abs=1e-9)
    assert (velocities**2).sum() < 25.0


@pytest.mark.parametrize('friction', [0.05, 1.0])
@pytest.mark.parametrize('cut', [0.3, 0.8])
def test_an_oblique_impact_throws_and_turns_as_its_closed_form_says(friction, cut):
    world = table(IDEAL, ('cue', 'object'), 0.8, friction)
    place = 2 * RADIUS * np.array([-np.sqrt(1 - cut * cut), -cut, 0.0])
    world.place('object', (0.0, 0.0, RADIUS))
    world.place(
        'cue', (place[0] - 0.1, place[1], RADIUS), velocity=(3.0, 0.0, 0.0), spin=(0.0, 0.0, 20.0)
    )
    world.advance(0.1)
    mass, normal = world.course.ball.mass, place / (2 * RADIUS)
    velocity, spin = np.array([3.0, 0.0, 0.0]), np.array([0.0, 0.0, 20.0])
    pushed = -(1 + 0.8) * mass / 2 * (velocity @ normal)
    sliding = velocity - (velocity @ normal) * normal - RADIUS * np.cross(spin, normal)
    size = np.linalg.norm(sliding)
    rub = -min(friction * pushed, mass / 7 * size) * sliding / size
    impulse = pushed * normal + rub
    turn = -RADIUS * np.cross(normal, impulse) / (0.4 * mass * RADIUS * RADIUS)
    assert world['cue'].velocity == pytest.approx(velocity + impulse / mass, abs=1e-9)
    assert world['object'].velocity == pytest.approx(-impulse / mass, abs=1e-9)
    assert world['cue'].spin == pytest.approx(spin + turn, abs=1e-7)
    assert world['object'].spin == pytest.approx(turn, abs=1e-7)


def test_a_rolling_ball_that_hits_an_equal_one_keeps_two_sevenths_and_gives_five():
    grip = Material('grip', Restitution(0.0), 0.0, 0.3, 0.3, 0.0)
    world = table(grip, ('cue', 'object'))
    world.place('object', (0.0, 0.0, RADIUS))
    world.place('cue', (-0.2, 0.0, RADIUS), **rolling(1.4))
    world.advance(3.0)
    assert world['cue'].velocity[0] == pytest.approx(0.4, abs=1e-9)
    assert world['object'].velocity[0] == pytest.approx(1.0, abs=1e-9)


def test_the_impulses_told_of_an_instant_are_all_that_changed_each_ball():
    """A ball that rolls up to another one presses it into the ground at the same instant."""
    world = table(FLOOR, ['red', 'blue', 'green'], 0.8, 0.2)
    world.place('red', (0, 0, RADIUS), **rolling(4.0))
    world.place('blue', (0.3, 0, RADIUS))
    world.place('green', (0.3 + 2 * RADIUS, 0, RADIUS))
    told = world.advance(0.1)
    first = [event for event in told if event.time == told[0].time]
    assert {event.kind for event in first} == {'ball', 'bounce'} and len(first) >= 3
    gained = {name: np.zeros(3) for name in world.names}
    for event in first:
        gained[event.ball] += event.impulse
        if event.kind == 'ball':
            gained[event.with_] -= event.impulse
    moved = {
        event.ball: np.subtract(event.velocity_after, event.velocity_before) for event in first
    }
    for name, change in moved.items():
        assert gained[name] == pytest.approx(Ball().mass * change, rel=0, abs=1e-12), name
    assert {'red', 'blue'} <= set(moved)


def test_balls_pass_through_each_other_where_ball_ball_is_off():
    course = Course((Plane(material=IDEAL),), tee=(0.0, 500.0), effects=('gravity',))
    world = World(course, ('red', 'blue'))
    world.place('blue', (0.0, 0.0, RADIUS))
    world.place('red', (-0.2, 0.0, RADIUS), velocity=(2.0, 0.0, 0.0))
    assert world.advance(0.5) == []
    assert world['red'].velocity == pytest.approx((2.0, 0.0, 0.0))
    assert world['blue'].velocity == (0.0, 0.0, 0.0)


def test_a_flying_ball_hits_another_in_the_air_and_both_are_told():
    world = table(FLOOR, ('red', 'blue'), 0.85, 0.2)
    world.place('blue', (10.0, 0.0, RADIUS))
    world.place('red', (0.0, 0.0, RADIUS))
    world.strike('blue', (-10.0, 0.0, 10.0))
    world.strike('red', (10.0, 0.0, 10.0))
    events = world.advance(200.0)
    bumps = [event for event in events if getattr(event, 'kind', '') == 'ball']
    assert len(bumps) == 1 and {bumps[0].ball, bumps[0].with_} == {'red', 'blue'}
    assert bumps[0].position[2] > 1.0
    assert sorted(event.ball for event in events if hasattr(event, 'status')) == ['blue', 'red']


@pytest.mark.parametrize('ahead', [0.05, 0.1])
def test_a_ball_that_stops_in_the_way_of_one_that_rolls_is_hit(ahead):
    world = table(CLOTH, ('first', 'second'), 0.9)
    world.place('first', (0.0, 0.0, RADIUS), **rolling(ahead))
    world.place('second', (-2.0, 0.0, RADIUS), **rolling(1.5))
    bumps, deepest = 0, -1.0
    for _ in range(1500):
        bumps += sum(event.kind == 'ball' for event in world.advance(0.01))
        deepest = max(deepest, overlaps(world))
    assert bumps and deepest < 1e-6 and not world.moving


def test_a_full_log_of_events_loses_its_last_one():
    assert run(filled) == [[1.0, 3.0], 2]


def filled():
    """Write three events to a log for two: its times and its count."""
    log = new_log(2)
    for time in (1.0, 2.0, 3.0):
        next_event(log)['time'] = time
    return log.events['time'].tolist(), int(log.count[0])


def test_a_place_that_another_ball_has_is_refused():
    world = table(FLOOR, ('red', 'blue'))
    world.place('blue', (0.0, 0.0))
    with pytest.raises(ValueError, match='taken by another ball'):
        world.place('red', (0.01, 0.0))


def test_two_balls_dropped_on_each_other_come_to_rest_apart():
    world = table(FLOOR, ('under', 'over'), 0.9, 0.2)
    world.place('under', (0.0, 0.0))
    world.place('over', (0.002, 0.0, 0.2), velocity=(0.0, 0.0, -0.1))
    world.advance(20.0)
    places, velocities = motion(world, world.names)
    assert not velocities.any() and world['under'].phase == world['over'].phase == Phase.REST
    assert np.linalg.norm(places[0] - places[1]) > 2 * RADIUS - 1e-6
    assert places[:, 2] == pytest.approx([RADIUS, RADIUS], abs=1e-9)


def test_several_balls_play_on_from_a_state_as_they_would_have():
    world = table(FLOOR, 3, 0.85, 0.2)
    for k, name in enumerate(world.names):
        world.place(name, (0.3 * k, 0.0))
    world.strike(world.names[0], (3.0, 0.0, 0.0))
    world.advance(0.05)
    other = table(FLOOR, 3, 0.85, 0.2)
    other.restore(world.state())
    for each in (world, other):
        each.advance(10.0)
    assert np.array_equal(motion(world, world.names), motion(other, world.names))


def test_what_a_world_has_played_before_changes_no_bit_of_a_break():
    world = table(CLOTH, 16, 0.9, 0.05)
    places = [
        (row * np.sqrt(3) * RADIUS, (2 * k - row) * RADIUS)
        for row in range(5)
        for k in range(row + 1)
    ]
    for name, place in zip(world.names, (*places, (-0.3, 0.0))):
        world.place(name, (*place, RADIUS))
    start, ends = world.state(), []
    for _ in range(3):
        world.restore(start)
        world.strike(world.names[-1], (3.0, 0.0, 0.0))
        world.advance(20.0)
        ends.append(motion(world, world.names)[0])
    assert np.array_equal(ends[0], ends[1]) and np.array_equal(ends[0], ends[2])


def overlaps(world):
    """How deep [m] the two balls that overlap most do."""
    places = motion(world, world.names)[0]
    apart = np.linalg.norm(places[:, None] - places[None], axis=2) + 10 * RADIUS * np.eye(
        len(places)
    )
    return 2 * RADIUS - apart.min()


def box(side, height=2.0):
    """Floor and four walls around the origin."""
    walls = [
        Patch(
            (0.5 * side * x, 0.5 * side * y, 0.5 * height),
            (-x, -y, 0),
            0.0,
            side + 0.1,
            height,
            FLOOR,
        )
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    return (Plane(material=FLOOR), *walls)


@pytest.mark.parametrize('count', [20, 60])
def test_balls_poured_into_a_box_come_to_rest_within_20_s_without_overlap_and_stay(count):
    side, random = 0.2, np.random.default_rng(count)
    course = Course(
        box(side),
        tee=(0.0, 500.0),
        ball=Ball(restitution=0.5, friction=0.2),
        effects=('gravity', 'ball_ball'),
    )
    world = World(course, count)
    for k, name in enumerate(world.names):
        place = 0.06 * np.array((k % 3 - 1, k // 3 % 3 - 1, k // 9)) + (0.0, 0.0, 0.1)
        world.place(name, place + (*random.uniform(-5e-3, 5e-3, 2), 0.0), velocity=(0.0, 0.0, 0.0))
    world.advance(20.0)
    assert not world.moving and overlaps(world) < 1e-4
    places = motion(world, world.names)[0]
    assert (
        np.abs(places[:, :2]).max() < 0.5 * side - RADIUS + 1e-4
        and places[:, 2].min() > RADIUS - 1e-4
    )
    world.advance(60.0)
    assert np.array_equal(motion(world, world.names)[0], places)


@pytest.mark.parametrize('taken', ['placed', 'struck'])
def test_a_ball_on_three_falls_when_one_of_them_is_taken_away(taken):
    floor = Material('rough', Restitution(0.3), 0.0, 0.9, 0.9, 0.05)
    course = Course(
        (Plane(material=floor),),
        tee=(0.0, 500.0),
        ball=Ball(restitution=0.3, friction=0.9),
        effects=('gravity', 'ball_ball'),
    )
    world, apart = World(course, ('a', 'b', 'c', 'top')), 2.0002 * RADIUS
    for name, turn in zip('abc', np.arange(3) * 2 * np.pi / 3):
        world.place(name, apart / np.sqrt(3) * np.array((np.cos(turn), np.sin(turn))))
    world.place(
        'top', (0.0, 0.0, RADIUS + np.sqrt(2 / 3) * apart + 1e-3), velocity=(0.0, 0.0, 0.0)
    )
    world.advance(5.0)
    assert not world.moving and world['top'].position[2] > 2.5 * RADIUS
    if taken == 'placed':
        world.place('a', (3.0, 0.0))
    else:
        world.strike('a', (5.0, 0.0, 1.0))
    world.advance(20.0)
    assert not world.moving and world['top'].position[2] == pytest.approx(RADIUS, abs=1e-6)


def test_a_pile_goes_on_from_its_state_to_the_bit():
    worlds = [poured(IN_A_BOWL, 20, 'standard') for _ in range(2)]
    worlds[0].advance(0.6)
    worlds[1].restore(json.loads(json.dumps(worlds[0].state())))
    leaning = [ball['time_stepping'] for ball in worlds[0].state()['balls'].values()]
    assert sum(map(bool, leaning)) > 10
    for _ in range(20):
        for world in worlds:
            world.advance(0.1)
        assert np.array_equal(
            motion(worlds[0], worlds[0].names), motion(worlds[1], worlds[1].names)
        )
    assert not worlds[0].moving


def test_a_rough_preset_does_not_hold_a_ball_on_an_edge_for_ever():
    # Two faces shared the edge that it followed, and each was an obstacle to a ball on the other.
    world = poured(IN_A_BOWL, 20, 'sketch')
    world.advance(10.0)
    assert not world.moving
