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

"""Laws that hold for every shot: it ends, on the ground, and in still air it gains no energy."""

from math import inf
import os

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import (
    Course,
    Cylinder,
    ground_height,
    Heightmap,
    LogProfile,
    Material,
    Mesh,
    Patch,
    Phase,
    Plane,
    Restitution,
    Result,
    simulate_many,
    World,
)
from hypothesis import given, HealthCheck, settings
from hypothesis import strategies as st
import numpy as np
import pytest
from scene import depth, energy, touches

SHOTS = int(os.environ.get('RANDOM_SHOTS', 300))  # 10000 for the whole lot
WATCHED = SHOTS // 10  # of them, tick by tick
TICK = 0.02  # s
LIFT = 2e-5  # J/kg: what putting a ball exactly on its surface, 1e-6 m higher at most, may give it
RELATIVE = 1e-9  # an event
ROUGH = Material('rough', Restitution(0.5), 0.0, 0.4, 0.3, 0.1, 0.002)
IDEAL = Material('ideal', Restitution(1.0))
STILL = ('gravity',)


def directions(random, count):
    """Draw unit vectors, evenly over the sphere."""
    arrows = random.normal(size=(count, 3))
    return arrows / np.linalg.norm(arrows, axis=1)[:, np.newaxis]


def shots(count, seed):
    """Velocities to 120 m/s and spins to 1000 rad/s in any direction."""
    random = np.random.default_rng(seed)
    return (
        random.uniform(0, 120, (count, 1)) * directions(random, count),
        random.uniform(0, 1000, (count, 1)) * directions(random, count),
    )


@pytest.fixture(scope='module')
def links():
    """Load the course that the package ships, without its pond, in which a ball would be lost."""
    return load_course('golf_without_friends')._replace(water=())


def watch(world, name='ball', tick=TICK, until=inf):
    """Play to the end, or `until` then, with an eye on the ball at every tick.

    Return what happened.
    """
    told, last = [], energy(world.course, world[name])
    while world.moving and world.time < until:
        events = world.advance(tick)
        told += events
        if any(isinstance(event, Result) and event.status == 'out_of_bounds' for event in events):
            break
        ball = world[name]
        now = energy(world.course, ball)
        assert np.isfinite((*ball.position, *ball.velocity, *ball.spin)).all(), (world.time, ball)
        assert depth(world.course, ball.position) < 2e-6, (world.time, ball)
        assert now <= last + RELATIVE * abs(last) * (1 + len(events)) + LIFT, (
            world.time,
            now - last,
            ball,
        )
        last = now
    return told


@pytest.mark.parametrize('velocity, spin', [((0, 0, 0), (0, 0, 0)), ((3, -2, 1), (100, 200, 300))])
def test_an_ideal_ball_bounces_for_60_s_without_losing_or_gaining_energy(velocity, spin):
    course = Course((Plane(material=IDEAL),), effects=STILL)
    world = World(course)
    world.place('ball', (0, 0, 2), velocity, spin)
    begin = energy(course, world['ball'])
    for _ in range(600):
        world.advance(0.1)
        assert abs(energy(course, world['ball']) / begin - 1) < 1e-10, world.time
    assert world.time == pytest.approx(60)


def test_random_shots_end_on_the_ground(links):
    velocities, spins = shots(SHOTS, 1)
    ended = simulate_many(links, velocities, spins)
    assert set(ended['status']) <= {'at_rest', 'out_of_bounds'}
    for i, position in enumerate(ended['position']):
        height, _ = ground_height(links, *position[:2])
        assert position[2] - height >= links.ball.radius - 1e-6, i
        assert depth(links, position) < 2e-6 and touches(links, position), i


def test_random_shots_stay_out_of_the_ground_and_gain_no_energy(links):
    for velocity, spin in zip(*shots(WATCHED, 2)):
        world = World(links)
        world.strike('ball', velocity, spin)
        result = watch(world)[-1]
        assert result.status in ('at_rest', 'out_of_bounds'), (velocity, spin)


def numbers(low, high):
    return st.floats(low, high, allow_subnormal=False)


def vectors(most):
    return st.tuples(*3 * [numbers(-most, most)])


def of(*values):
    """One of `values`; hypothesis would else make up what is left out."""
    return st.sampled_from(values)


materials = st.builds(
    Material,
    of('any'),
    st.builds(Restitution, numbers(0, 1), of(0.0), of(0.0), numbers(0, 0.2)),
    numbers(-1, 1),
    numbers(0, 2),
    numbers(0, 2),
    numbers(0.01, 2),
    # with less a ball turns on the spot for hours, and ends all the same
    of(0.0) | numbers(1e-4, 0.01),
    numbers(0, 1.5),
    of(()),
    of(0.0),
    # named, or they are drawn from all floats: of sandy and of long grass
    resistance_growth=of(0.0) | numbers(0, 0.1),
    ploughing=of(0.0) | numbers(0, 1),
    roughness=of(0.0),
    canopy_drag=of(0.0),
)
patches = st.builds(
    Patch,
    st.tuples(numbers(-3, 3), numbers(-3, 3), numbers(0, 1)),
    vectors(1)
    .filter(lambda n: np.linalg.norm(n) > 0.1)
    .map(lambda n: tuple(np.array(n) / np.linalg.norm(n))),
    numbers(-3, 3),
    numbers(0.01, 5),
    numbers(0.01, 5),
    materials,
    of(False),
    of(()),
)


@settings(
    max_examples=SHOTS // 20,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
@given(st.lists(patches, max_size=6), vectors(20), vectors(300))
def test_a_ball_among_patches_anyhow_gains_no_energy(clutter, velocity, spin):
    course = Course((Plane((0, 0, -1), material=ROUGH), *clutter), tee=(20.0, 0.0), effects=STILL)
    world = World(course)
    try:
        world.place('ball', (0.0, 0.0, 1.5), velocity, spin)
    except ValueError:
        return
    watch(world, until=30.0)  # what nothing brakes turns or swings for ever


def hills(heights, material):
    """Lay the same 5 by 5 `heights` twice: a height map, and 0.5 m right of it a mesh."""
    heights = np.reshape(heights, (5, 5))
    x, y = np.meshgrid(np.linspace(1.0, 3.0, 5), np.linspace(-1.0, 1.0, 5))
    first = np.arange(25).reshape(5, 5)[:-1, :-1].ravel()
    faces = np.concatenate(
        [np.c_[first, first + 1, first + 6], np.c_[first, first + 6, first + 5]]
    )
    return (
        Heightmap(heights, (-1.0, -1.0), 0.5, material),
        Mesh(np.c_[x.ravel(), y.ravel(), heights.ravel()], faces, material),
    )


lands = st.builds(hills, st.lists(numbers(0, 0.4), min_size=25, max_size=25), materials)
trunks = st.builds(
    Cylinder,
    st.tuples(numbers(-1, 3), numbers(-1, 1), of(-1.0)),
    numbers(0.01, 0.3),
    of(2.0),
    materials,
)


@settings(
    max_examples=SHOTS // 20,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
@given(lands, st.lists(trunks, min_size=1, max_size=2), vectors(10), vectors(300))
def test_a_ball_on_any_hills_among_trunks_gains_no_energy(land, trees, velocity, spin):
    course = Course(
        (Plane((0, 0, -1), material=ROUGH), *land),
        tee=(9.0, 0.0),
        obstacles=tuple(trees),
        effects=STILL,
    )
    # with others a step along hills errs by 1e-5 m, either way
    world = World(course, accuracy='reference')
    try:
        world.place('ball', (0.9, 0.0, 1.0), velocity, spin)
    except ValueError:
        return
    last = energy(course, world['ball'])
    while world.moving and world.time < 10.0:
        events = world.advance(TICK)
        now = energy(course, world['ball'])
        assert now <= last + RELATIVE * abs(last) * (1 + len(events)) + LIFT, (
            world.time,
            now - last,
        )
        last = now
    assert np.isfinite((*world['ball'].position, last)).all()


@settings(max_examples=SHOTS // 20, deadline=None, derandomize=True, database=None)
@given(materials, vectors(60), vectors(1000))
def test_a_shot_on_level_ground_of_any_material_ends_and_gains_no_energy(material, velocity, spin):
    world = World(Course((Plane(material=material),)))
    if not any((*velocity, *spin)):
        return
    world.strike('ball', velocity, spin)
    watch(world, tick=0.2)


def test_wind_of_100_m_s_presses_a_ball_against_a_wall_and_never_through():
    wall = Plane((5, 0, 0), (-1, 0, 0), ROUGH)
    course = Course((Plane(material=ROUGH), wall), wind_profile=LogProfile())
    world = World(course, wind=(100, 0, 0))
    world.strike('ball', (10, 0, 10), (0, 0, 0))
    for _ in range(1000):  # its spin carries it up the wall
        world.advance(TICK)
        assert world['ball'].position[0] < 5 - course.ball.radius + 1e-6
    world.set_wind((0, 0, 0))
    while world.moving:
        world.advance(TICK)
        assert depth(course, world['ball'].position) < 2e-6
    assert touches(course, world['ball'].position)


def test_wind_accuracy_and_place_may_change_in_mid_flight(links):
    world = World(links)
    world.strike('ball', (40, 0, 20), (0, -300, 0))
    world.advance(0.503)
    before = world['ball']
    world.accuracy = 'reference'
    world.set_wind((0, 0, 0))
    assert world['ball'] == before
    world.set_wind((5, 10, 0))
    assert world['ball'] == before
    world.advance(1e-9)
    assert np.allclose(world['ball'].position, before.position, atol=1e-6)
    world.advance(0.5)
    world.accuracy = 'sketch'
    world.set_wind((0, 0, 0))
    told = watch(world)
    assert told[-1].status == 'at_rest'


def test_a_ball_placed_in_mid_flight_is_there_and_its_shot_is_forgotten(links):
    world = World(links)
    world.strike('ball', (40, 0, 20))
    world.advance(0.5)
    world.place('ball', (20, 3))
    assert world['ball'].phase == Phase.REST and not world.moving
    assert touches(links, world['ball'].position)
    world.strike('ball', (10, 0, 5))
    assert watch(world)[-1].status == 'at_rest'


def test_a_ball_touching_the_ground_can_be_placed_and_a_deeper_one_cannot(links):
    world = World(links)
    x, y, z = world['ball'].position
    world.place('ball', (x, y, z))
    assert world['ball'].position == (x, y, z) and world['ball'].phase == Phase.REST
    with pytest.raises(ValueError):
        world.place('ball', (x, y, z - 1e-3))
    assert world['ball'].position == (x, y, z)


def test_several_balls_each_go_as_if_alone(links):
    names = ('red', 'green', 'blue')
    velocities, spins = shots(3, 5)
    velocities = 0.3 * np.abs(velocities)
    together = World(links, balls=names)
    places = {name: together[name].position for name in names}
    for name, velocity, spin in zip(names, velocities, spins):
        together.strike(name, velocity, spin)
    for _ in range(100):
        together.advance(TICK)
    for name, velocity, spin in zip(names, velocities, spins):
        alone = World(links)
        alone.place('ball', places[name])
        alone.strike('ball', velocity, spin)
        for _ in range(100):
            alone.advance(TICK)
        assert alone['ball'] == together[name]


def test_a_shot_that_never_stops_ends_at_the_time_limit():
    world = World(Course((Plane(material=IDEAL),), effects=STILL))
    world.strike('ball', (1, 0, 1))
    told = []
    for _ in range(301):
        told += world.advance(1.0)
    (result,) = (event for event in told if isinstance(event, Result))
    assert (
        result.status == 'time_limit'
        and result.duration == pytest.approx(300)
        and not world.moving
    )
