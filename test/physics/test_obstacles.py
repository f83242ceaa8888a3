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

"""Trees and stones: what is solid is never passed through, and leaves only brake."""

from math import exp, hypot, sqrt
import os

from driving_range import GRAVITY, HARD, one_by_one
from golf_sim_ros.physics import (
    Collision,
    Course,
    Cylinder,
    Material,
    Phase,
    Plane,
    Restitution,
    Sphere,
    World,
)
import numpy as np
from oracles import RADIUS
import pytest
from scene import energy

# RANDOM_SHOTS=1000000 gives 100,000 of them, the whole lot
SHOTS = int(os.environ.get('RANDOM_SHOTS', 300)) // 10
WOOD = Material('wood', Restitution(0.45), 0.0, 0.45, 0.4, 0.05, 0.002)
LEAVES = Material('leaves', drag=0.25)
IDEAL = Material('ideal', Restitution(1.0))
STILL = ('gravity', 'foliage')
STICK = Cylinder((2.0, 0.0, 0.0), 0.01, 50.0, WOOD)


def among(*obstacles, **more):
    """World of a ball on level hard ground with `obstacles`."""
    return World(Course((Plane(material=HARD),), obstacles=obstacles, effects=GRAVITY, **more))


def from_axis(solid, position):
    """Distance of the middle of a ball from a solid's upright axis."""
    return hypot(position[0] - solid.base[0], position[1] - solid.base[1])


def outside(solid, position):
    """Signed distance of a point from an upright cylinder."""
    beyond = from_axis(solid, position) - solid.radius
    over = max(position[2] - solid.base[2] - solid.height, solid.base[2] - position[2])
    return hypot(beyond, over) if beyond > 0 and over > 0 else max(beyond, over)


def test_a_ball_is_reflected_by_a_trunk_as_by_the_plane_that_touches_it():
    aside = 0.1
    world = among(Cylinder((2.0, aside, 0.0), 0.3, 8.0, IDEAL))
    world.place('ball', (0, 0, 1.0), (20, 0, 0))
    (hit,) = (event for event in world.advance(0.2) if isinstance(event, Collision))
    reach = 0.3 + RADIUS
    normal = np.array((-sqrt(1 - (aside / reach) ** 2), -aside / reach, 0.0))
    assert hit.kind == 'obstacle' and hit.with_ == 'ideal'
    assert hit.normal == pytest.approx(normal, abs=1e-9)
    assert from_axis(world.course.obstacles[0], hit.position) == pytest.approx(reach, abs=1e-9)
    mirrored = hit.velocity_before - 2 * np.dot(hit.velocity_before, normal) * normal
    assert hit.velocity_after == pytest.approx(mirrored, abs=1e-9)


def test_a_ball_dropped_beside_the_middle_of_a_sphere_leaves_along_the_mirrored_way():
    world = among(Sphere((0.0, 0.0, 1.0), 0.5, IDEAL), tee=(5.0, 0.0))
    world.place('ball', (0.2, 0, 3.0), (0, 0, -10))
    hit = next(event for event in world.advance(1.0) if isinstance(event, Collision))
    assert np.linalg.norm(np.subtract(hit.position, (0, 0, 1))) == pytest.approx(
        0.5 + RADIUS, abs=1e-9
    )
    assert hit.normal[0] == pytest.approx(0.2 / (0.5 + RADIUS), abs=1e-9)


def test_no_shot_passes_a_cylinder_of_10_mm():
    random = np.random.default_rng(7)
    course = Course((Plane(material=HARD),), obstacles=(STICK,), effects=GRAVITY)
    aside = random.uniform(-1, 1, SHOTS) * (0.01 + RADIUS)
    # every fourth is hit, or missed, by a hair
    aside[::4] = (0.01 + RADIUS) * (1 - 10.0 ** random.uniform(-12, -2, len(aside[::4])))
    spins = random.normal(size=(SHOTS, 3))
    spins *= (random.uniform(0, 2000, SHOTS) / np.linalg.norm(spins, axis=1))[:, np.newaxis]
    world = World(course)
    speeds, ways = random.uniform(5, 120, SHOTS), random.uniform(0.1, 2, SHOTS)
    for y, speed, way, spin in zip(aside, speeds, ways, spins):
        world.place('ball', (2.0 - way, y, 3.0), (speed, 0, 0), spin)
        for _ in range(50):
            world.advance(2 * way / speed / 50)
            assert outside(STICK, world['ball'].position) > RADIUS - 1e-9, (y, speed, way, spin)
        # Nothing else turns it aside: whatever goes straight on has passed through.
        assert world['ball'].velocity[:2] != (speed, 0.0), (y, speed, way, spin)


def test_shots_into_a_wood_end_outside_of_every_trunk():
    random = np.random.default_rng(3)
    trunks = tuple(
        Cylinder((x, y, 0.0), radius, 8.0, WOOD)
        for x, y, radius in zip(
            random.uniform(5, 60, 40), random.uniform(-15, 15, 40), random.uniform(0.01, 0.4, 40)
        )
    )
    course = Course((Plane(material=HARD),), obstacles=trunks, effects=GRAVITY)
    speeds, turns = random.uniform(10, 40, SHOTS), random.uniform(-0.3, 0.3, SHOTS)
    velocities = np.stack(
        (speeds * np.cos(turns), speeds * np.sin(turns), random.uniform(0, 15, SHOTS)), -1
    )
    ended = one_by_one(course, velocities, random.normal(size=(SHOTS, 3)) * 100)
    assert set(ended['status']) == {'at_rest'}
    for position in ended['position']:
        assert min(outside(trunk, position) for trunk in trunks) > RADIUS - 1e-6
        assert position[2] == pytest.approx(RADIUS, abs=1e-6) or position[2] > 8


@pytest.mark.parametrize('spin', [(0, 0, 0), (0, 300, 0), (0, 0, 200)])
def test_a_ball_driven_between_trunk_and_ground_comes_to_rest_and_gains_no_energy(spin):
    world = among(Cylinder((1.0, 0.0, 0.0), 0.3, 8.0, WOOD))
    world.place('ball', (0.6, 0.05, 0.1), (6, 0, -4), spin)
    last = energy(world.course, world['ball'])
    while world.moving:
        events = world.advance(0.01)
        ball, now = world['ball'], energy(world.course, world['ball'])
        assert outside(world.course.obstacles[0], ball.position) > RADIUS - 2e-6
        assert ball.position[2] > RADIUS - 2e-6
        assert now <= last + 1e-9 * last * (1 + len(events)) + 2e-5
        last = now
    assert world['ball'].phase == Phase.REST


def test_a_ball_rests_on_a_stump_and_falls_off_it_when_it_rolls_over_the_rim():
    world = among(Cylinder((0.0, 0.0, 0.0), 0.3, 0.5, WOOD), tee=(3.0, 0.0))
    world.place('ball', (0.1, 0.1, 0.5 + RADIUS))
    assert (
        world['ball'].position == pytest.approx((0.1, 0.1, 0.5 + RADIUS))
        and world['ball'].lie == 'wood'
    )
    world.strike('ball', (1.0, 0.0, 0.0))
    world.advance(3.0)
    assert world['ball'].position[2] == pytest.approx(RADIUS) and world['ball'].position[0] > 0.3


@pytest.mark.parametrize('radius, speed', [(2.5, 30.0), (0.5, 60.0), (2.5, 5.0)])
def test_leaves_take_exp_of_their_way_from_a_balls_speed(radius, speed):
    crown = Sphere((10.0, 0.0, 50.0), radius, LEAVES)
    course = Course((Plane(material=HARD),), obstacles=(crown,), effects=('foliage',))
    world = World(course, accuracy='reference')
    world.place('ball', (10.0 - radius - 1, 0, 50.0), (speed, 0, 0))
    while world['ball'].position[0] < 10.0 + radius:
        world.advance(0.01)
    assert world['ball'].velocity == pytest.approx(
        (speed * exp(-0.25 * 2 * radius), 0, 0), rel=1e-4
    )


def test_steps_grow_again_past_the_jump_of_drag_where_leaves_begin_and_end():
    crown = Sphere((10.0, 0.0, 3.0), 2.0, LEAVES)
    course = Course((Plane(material=HARD),), obstacles=(crown,))
    world = World(course, effects=STILL, accuracy='reference')
    for k in range(20):
        world.place('ball', (5.0, 0.05 * k, 2.0), (30.0, 0.02 * k, 4.0))
        world.advance(0.5)
    assert int(world._balls['evaluations'][0]) < 40_000


def test_wind_blows_no_ball_through_the_leaves_and_without_leaves_there_is_no_foliage():
    course = Course((Plane(material=HARD),), obstacles=(Sphere((10, 0, 9), 2.5, LEAVES),))
    assert 'foliage' in World(course).effects_on
    assert World(course._replace(obstacles=(STICK,))).effects_off['foliage'] == 'no leaves'
