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

"""Meshes: triangles are the ground they show.

No side, corner or crack between them is felt or passed.
"""

from math import cos, hypot, sin
import os

from driving_range import as_on_relief, GRAVITY, HARD
from golf_sim_ros.physics import (
    Course,
    ground_height,
    Material,
    Mesh,
    Patch,
    Phase,
    Plane,
    Shot,
    simulate,
    World,
)
from golf_sim_ros.physics.geometry import surface_protocol
from golf_sim_ros.physics.geometry.mesh import meshes
from golf_sim_ros.physics.geometry.surfaces import look_down
from golf_sim_ros.physics.jit import entry
from golf_sim_ros.physics.scene import kernel_model
from golf_sim_ros.study.scenes import hills
import numpy as np
from oracles import RADIUS
import pytest
from scene import bowl

SHOTS = int(os.environ.get('MESH_SHOTS', 100))  # at the sheet that nothing may pass
SIDE = 6.0  # m from the middle of a floor to its sides


def floor(seed, inner=100, up=(0.0, 0.0, 1.0)):
    """Irregular triangles that make a square around the origin, across `up`, wound either way."""
    rng = np.random.default_rng(seed)
    places = [(-SIDE, -SIDE), (SIDE, -SIDE), (SIDE, SIDE), (-SIDE, SIDE)]
    faces = [(0, 1, 2), (0, 2, 3)]
    for place in rng.uniform(-0.9 * SIDE, 0.9 * SIDE, (inner, 2)):
        hit = next(i for i, face in enumerate(faces) if within([places[k] for k in face], place))
        a, b, c = faces.pop(hit)
        faces += [(a, b, len(places)), (b, c, len(places)), (len(places), c, a)]
        places.append(tuple(place))
    faces = np.array([face[:: rng.choice((-1, 1))] for face in faces])
    across = np.cross(up, (1.0, 0.0, 0.0)) / np.linalg.norm(np.cross(up, (1.0, 0.0, 0.0)))
    return np.array(places) @ (np.cross(across, up), across), faces


def within(corners, place):
    """Whether a triangle in plan holds `place`."""
    a, b, c = np.array(corners)
    turns = [
        (q - p)[0] * (place - p)[1] - (q - p)[1] * (place - p)[0]
        for p, q in ((a, b), (b, c), (c, a))
    ]
    return min(turns) >= 0 or max(turns) <= 0


def course(vertices, faces, material=HARD, **more):
    """Course of a mesh alone."""
    return Course((Mesh(np.array(vertices, float), np.array(faces), material, **more),))


def rolling(velocity, up=(0.0, 0.0, 1.0)):
    """Spin of a ball that rolls at `velocity`."""
    return np.cross(up, velocity) / RADIUS


def played(course, place, velocity, spin, ticks=(0.1,) * 40, accuracy='standard'):
    """States of a ball after `ticks` [s], and how the last of them is; gravity alone."""
    world = World(course, effects=GRAVITY, accuracy=accuracy)
    world.place('ball', place, velocity, spin)
    rows = []
    for tick in ticks:
        world.advance(tick)
        rows.append(np.concatenate(world['ball'][:3]))
    return np.array(rows), world['ball']


# A floor of triangles is a plane

VERTICES, FACES = floor(1)


def on_a_floor(place, velocity, spin):
    """Assert that a ball moves on triangles as on a plane."""
    place = (*place, RADIUS)
    found, ball = played(course(VERTICES, FACES), place, velocity, spin)
    exact, _ = played(Course((Plane(material=HARD),)), place, velocity, spin)
    assert np.abs(exact[:, :2]).max() < SIDE
    np.testing.assert_allclose(found[:, :6], exact[:, :6], rtol=0, atol=1e-9)
    assert np.abs(found[:, 5]).max() < 1e-9
    assert ball.phase == Phase.REST


@pytest.mark.parametrize('heading', np.arange(0.1, 6.3, 1.3))
@pytest.mark.parametrize('rolls', [True, False])
def test_a_floor_of_200_triangles_rolls_like_a_plane(heading, rolls):
    velocity = np.array((1.7 * cos(heading), 1.7 * sin(heading), 0))
    on_a_floor((0.1, -0.2), velocity, rolling(velocity) if rolls else (3, 40, 60))


@pytest.mark.parametrize('corner', [4, 17, 60])
@pytest.mark.parametrize('aside', [0.0, 3e-10, 4e-8])
def test_a_ball_rolls_over_a_vertex_of_a_floor(corner, aside):
    way = np.array((0.6, 0.8, 0))
    start = VERTICES[corner] - 0.4 * way + aside * np.array((0.8, -0.6, 0))
    on_a_floor(start[:2], 1.1 * way, rolling(1.1 * way))


@pytest.mark.parametrize('face', [3, 77, 140])
@pytest.mark.parametrize('aside', [0.0, 1e-12, 1e-8])
def test_a_ball_rolls_along_a_shared_side_of_a_floor(face, aside):
    a, b = VERTICES[FACES[face, 0]], VERTICES[FACES[face, 1]]
    way = (b - a) / np.linalg.norm(b - a)
    start = a + aside * np.array((-way[1], way[0], 0))
    on_a_floor(start[:2], 0.9 * way, rolling(0.9 * way))


@pytest.mark.parametrize('accuracy', ['standard', 'reference'])
@pytest.mark.parametrize('up', [(0.1, 0.0, 1.0), (-0.2, 0.15, 1.0)])
def test_a_tilted_floor_bounces_and_rolls_like_a_plane(accuracy, up):
    up = np.array(up) / np.linalg.norm(up)
    floored = course(*floor(2, up=up))
    plane = Course((Plane(normal=tuple(up), material=HARD),))
    shots = ((0.5, -0.2, 0), (0, 0, 0)), ((1, 1, 1.5), (0, -90, 30)), ((-0.6, 1, 2), (20, 60, 0))
    for velocity, spin in shots:
        place = 0.1 * np.array((0, 1, 0)) + 0.3 * up
        found, _ = played(floored, place, velocity, spin, ticks=(0.1,) * 15, accuracy=accuracy)
        even = as_on_relief(accuracy)
        exact, _ = played(plane, place, velocity, spin, ticks=(0.1,) * 15, accuracy=even)
        assert np.abs(exact[:, :2]).max() < SIDE
        np.testing.assert_allclose(found[:, :3], exact[:, :3], rtol=0, atol=1e-6)


def test_ground_height_is_that_of_the_highest_triangle():
    upper = Mesh(VERTICES + (0, 0, 1), FACES[:40], HARD._replace(name='upper'))
    shapes = (Mesh(VERTICES, FACES, HARD), upper)
    for x, y in np.random.default_rng(3).uniform(-SIDE, SIDE, (60, 2)):
        above = any(within(VERTICES[face, :2], np.array((x, y))) for face in FACES[:40])
        assert ground_height(Course(shapes), x, y) == (1.0, 'upper') if above else (0.0, 'hard')
    assert ground_height(Course(shapes), SIDE + 1e-6, 0) is None


def test_where_meshes_are_equally_high_the_later_counts():
    shapes = [Mesh(VERTICES, FACES, HARD._replace(name=name)) for name in ('first', 'last')]
    assert ground_height(Course(tuple(shapes)), 0.3, 0.4)[1] == 'last'
    assert ground_height(Course(tuple(shapes[::-1])), 0.3, 0.4)[1] == 'first'


# Ridges, creases, corners


def roof(slope, half=3.0):
    """Two rectangles in four triangles that meet over the y axis; `slope` is their rise [rad]."""
    z = half * np.tan(slope)
    return (
        [
            (-half, -half, -z),
            (0, -half, 0),
            (half, -half, -z),
            (half, half, -z),
            (0, half, 0),
            (-half, half, -z),
        ],
        [(0, 1, 4), (0, 4, 5), (1, 2, 3), (1, 3, 4)],
    )


def depth(course, point):
    """How deep [m] a ball at `point` lies in a mesh; by other means than the engine's."""
    (shape,) = course.ground
    return RADIUS - min(distance(shape.vertices[face], point) for face in shape.faces)


def distance(corners, point):
    """Distance of `point` from a triangle: from its inside, or else the nearest of its sides."""
    a, b, c = corners
    plane = np.column_stack((b - a, c - a))
    u, v = np.linalg.lstsq(plane, point - a, rcond=None)[0]
    if u >= 0 and v >= 0 and u + v <= 1:
        return np.linalg.norm(point - a - plane @ (u, v))
    sides = [(p, q - p) for p, q in zip(corners, np.roll(corners, -1, 0))]
    return min(
        np.linalg.norm(point - p - np.clip((point - p) @ side / (side @ side), 0, 1) * side)
        for p, side in sides
    )


@pytest.mark.parametrize('slope', [1e-6, 1e-3, 0.05, 0.6])
@pytest.mark.parametrize('speed', [0.3, 2.0])
@pytest.mark.parametrize('turned', [1.0, -1.0], ids=['ridge', 'crease'])
def test_a_ball_passes_a_fold_and_stays_on_it_or_over_it(slope, speed, turned):
    vertices, faces = roof(turned * slope)
    folded = course(vertices, faces)
    uphill = np.array((cos(slope), 0, turned * sin(slope)))
    up = np.array((-turned * sin(slope), 0, cos(slope)))
    velocity = speed * uphill
    world = World(folded, effects=GRAVITY)
    world.place(
        'ball', -0.02 * uphill + RADIUS * up + (0, 0.1234, 0), velocity, rolling(velocity, up)
    )
    energy = np.inf
    for _ in range(40):
        world.advance(0.005)
        ball = world['ball']
        assert depth(folded, ball.position) < 2e-6
        now = (
            9.80665 * ball.position[2]
            + 0.5 * np.dot(ball.velocity, ball.velocity)
            + 0.2 * RADIUS**2 * np.dot(ball.spin, ball.spin)
        )
        assert now <= energy + 1e-5
        energy = now
    assert ball.position[0] > 0.01 or slope == 0.6 and (turned < 0 or speed < 2)
    assert ball.position[1] == pytest.approx(0.1234, abs=1e-9)


PYRAMID = (
    [(0, 0, 0.5), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)],
    [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)],
)


def test_a_ball_dropped_on_a_vertex_comes_straight_back():
    states, ball = played(course(*PYRAMID), (0, 0, 0.8), None, None, ticks=(0.05,) * 60)
    np.testing.assert_allclose(states[:, :2], 0, atol=1e-12)
    assert ball.phase == Phase.REST and ball.position[2] == pytest.approx(0.5 + RADIUS, abs=1e-9)


@pytest.mark.parametrize('x, y', [(1e-3, 0), (0, 1e-3), (-1e-3, 0), (6e-4, -8e-4)])
def test_a_ball_dropped_beside_a_vertex_leaves_on_that_side(x, y):
    states, ball = played(course(*PYRAMID), (x, y, 0.8), None, None, ticks=(0.05,) * 12)
    assert np.dot(ball.position[:2], (x, y)) > 0.05 * hypot(x, y)
    assert abs(ball.position[0] * y - ball.position[1] * x) < 0.02 * hypot(x, y)


@pytest.mark.parametrize('velocity', [(0, 0, 0), (0, 0.5, 0), (0.3, 0.2, 0)])
def test_a_ball_comes_to_rest_deep_in_a_bowl(velocity):
    dish = course(*bowl())
    _, ball = played(dish, (0.3, 0, 0.15), velocity, None, ticks=(0.1,) * 150)
    assert ball.phase == Phase.REST
    assert hypot(*ball.position[:2]) < 0.25
    assert abs(depth(dish, np.array(ball.position))) < 2e-6


# Nothing is passed


@pytest.mark.parametrize('crumpled', [0.0, 0.3])
def test_no_shot_passes_a_single_sheet(crumpled):
    rng = np.random.default_rng(4)
    vertices, faces = floor(5)
    vertices = vertices * 30 + crumpled * rng.standard_normal((len(vertices), 1)) * (0, 0, 1)
    world = World(course(vertices, faces, HARD), effects=GRAVITY)
    ground = kernel_model.ground(world.course)
    top = vertices[:, 2].max()
    for _ in range(SHOTS):
        place = np.array((*rng.uniform(-4, 4, 2), top + RADIUS + rng.uniform(0, 2)))
        velocity = rng.standard_normal(3) * (1, 1, rng.choice((1, 0.1, 0.001)))
        velocity *= rng.uniform(0, 120) / np.linalg.norm(velocity)
        velocity[2] = -abs(velocity[2])
        spin = rng.standard_normal(3)
        world.place('ball', place, velocity, rng.uniform(0, 2000) * spin / np.linalg.norm(spin))
        for _ in range(6):
            world.advance(0.1)
            x, y, z = world['ball'].position
            if max(abs(x), abs(y)) > 29 * SIDE:
                break
            assert z > look_down(ground, x, y)[0], (place, velocity)


@pytest.mark.parametrize('aside', np.linspace(-0.1, 0.1, 5))
def test_a_ball_that_flies_in_from_beneath_a_facets_plane_lands_on_it(aside):
    # On hills the plane of a facet further on lies over the ball at first.
    chip = np.array((10.4 * cos(aside), 10.4 * sin(aside), 6.0))
    told = simulate(hills(20_000), Shot(tuple(chip)))
    assert told.result.status == 'at_rest'


def test_a_one_sided_mesh_is_passed_from_behind_only():
    vertices, faces = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)]
    for from_above, stopped in ((True, True), (False, False)):
        sign = 1 if from_above else -1
        states, _ = played(
            course(vertices, faces, one_sided=True),
            (0, 0, 0.2 * sign),
            (0, 0, -4 * sign),
            None,
            ticks=(0.1,),
        )
        assert (states[-1, 2] * sign > 0) == stopped


def test_a_mesh_of_two_sides_is_hit_from_below():
    sheet = course([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)])
    states, _ = played(sheet, (0, 0, -0.2), (0, 0, 9), None, ticks=(0.1,))
    assert states[-1, 2] < -RADIUS


# The record for kernels


@entry
def next_part(kind, part, low, high):
    """Next part of a kind; Python can call it."""
    return surface_protocol.next_part(kind, part, low, high)


@entry
def parts_within(kind, low, high, most):
    """First and last part of a kind in a box, and their count; Python can call it."""
    return surface_protocol.parts_within(kind, low, high, most)


def may_meet(corners, middle, half):
    """Whether a triangle meets a cube as seen along the axes and along its sides' normals.

    Those lie in its plane.
    """
    sides = np.roll(corners, -1, 0) - corners
    for axis in (*np.eye(3), *np.cross(np.cross(sides[0], sides[1]), sides)):
        seen, reach = (corners - middle) @ axis, half * np.abs(axis).sum()
        if seen.min() > reach or seen.max() < -reach:
            return False
    return True


def test_no_triangle_that_meets_a_box_is_passed_over():
    rng = np.random.default_rng(8)
    corners = rng.uniform(-1, 1, (200, 3, 3))
    kind = meshes([Mesh(corners.reshape(-1, 3), np.arange(600).reshape(-1, 3))], {Material(): 0})
    shares = rng.dirichlet((1, 1, 1), 2000)
    passed_over = 0
    for k, triangle in enumerate(kind.triangles['corners']):
        inside = shares @ triangle
        for _ in range(20):
            middle, half = rng.uniform(-1, 1, 3), 0.3 * rng.uniform()
            low, high = middle - half, middle + half
            near = next_part(kind, k, tuple(low), tuple(high)) == k
            assert near or not ((low <= inside) & (inside <= high)).all(1).any()
            passed_over += (
                not near and ((triangle.min(0) <= high) & (triangle.max(0) >= low)).all()
            )
    assert passed_over > 100


@pytest.mark.parametrize('size', [1.0, 0.03])
@pytest.mark.parametrize('count', [1, 2, 4, 5, 9, 300])
def test_the_hierarchy_finds_what_brute_force_finds(count, size):
    rng = np.random.default_rng(count)
    shapes = [
        Mesh(
            (n + rng.uniform(-1, 1, (n, 1, 3)) + rng.uniform(-size, size, (n, 3, 3))).reshape(
                -1, 3
            ),
            np.arange(3 * n).reshape(-1, 3),
        )
        for n in (count, 1, count)
    ]
    kind = meshes(shapes, {Material(): 0})
    corners = kind.triangles['corners']
    for _ in range(40):
        middle, half = count + rng.uniform(-1, 1, 3), rng.choice([0.05, 0.5]) * rng.uniform()
        low, high = tuple(middle - half), tuple(middle + half)
        met = np.array([may_meet(triangle, middle, half) for triangle in corners])
        found, part = [], next_part(kind, 0, low, high)
        while part < len(corners):
            found.append(part)
            part = next_part(kind, part + 1, low, high)
        assert found == np.flatnonzero(met).tolist()
        start = int(rng.integers(len(corners)))
        later = [k for k in found if k >= start]
        assert next_part(kind, start, low, high) == (later[0] if later else len(corners))
        for most in (1, 3, len(corners) + 1):
            first, last, many = parts_within(kind, low, high, most)
            assert many == min(most, len(found))
            assert many == 0 or (first, last) == (found[0], found[many - 1])


@pytest.mark.parametrize(
    'mesh, said',
    [
        (Mesh(np.zeros((3, 3)), np.array([[0, 1, 3]])), 'out of 0 to 2'),
        (Mesh(np.eye(3), np.array([[0, 1, 2], [0, 1, 1]])), 'face 1'),
        (Mesh(np.full((3, 3), np.nan), np.array([[0, 1, 2]])), 'face 0'),
    ],
)
def test_a_mesh_that_cannot_be_used_is_refused(mesh, said):
    with pytest.raises(ValueError, match=said):
        World(Course((mesh, Patch((0, 0, 0)))))


def waves(rows):
    """Wide wavy ground, 200 m x 200 m, from rows x rows vertices."""
    side = np.linspace(-100, 100, rows)
    x, y = (a.ravel() for a in np.meshgrid(side, side, indexing='ij'))
    first = np.arange(rows * rows).reshape(rows, rows)[:-1, :-1].ravel()
    faces = np.r_[
        np.c_[first, first + rows, first + 1], np.c_[first + 1, first + rows, first + rows + 1]
    ]
    return course(np.c_[x, y, 0.5 * np.sin(0.1 * x) * np.sin(0.07 * y)], faces)


def test_fast_balls_roll_over_the_flat_ridges_of_wide_ground_without_end():
    world = World(waves(71), effects=GRAVITY)
    for heading in range(30):
        world.place('ball', (0, 0, 3), (20 * cos(heading), 20 * sin(heading), 8))
        world.advance(30.0)
        assert not world.moving


def test_a_ball_that_lifts_off_a_ridge_within_a_nanometre_of_it_goes_on():
    # Its foot was past the ridge by less than tells an edge from a face: it hit the face for ever.
    world = World(waves(225), effects=GRAVITY)
    world.place('ball', (0, 0))
    heading = 1.015
    world.strike('ball', (15 * cos(heading), 15 * sin(heading), 8.0))
    world.advance(30.0)
    assert not world.moving
