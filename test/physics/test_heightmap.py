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

"""Curved ground from heights on a grid."""

from math import pi, sqrt
import os

from driving_range import EVERYTHING, GRAVITY, HARD, one_by_one, random_shots
from golf_sim_ros.course import load_course
from golf_sim_ros.course.schema import CourseError
from golf_sim_ros.physics import (
    ACCURACY,
    Course,
    Heightmap,
    Material,
    METHODS,
    Phase,
    Plane,
    Preset,
    Restitution,
    World,
)
from golf_sim_ros.physics.geometry import closest_point, heightmap, surface_protocol
from golf_sim_ros.physics.geometry.bicubic import bicubic, in_cell, jet, nodes
from golf_sim_ros.physics.jit import entry
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from oracles import G, RADIUS
import pytest

GREEN = Material('green', Restitution(0.4), 0.0, 0.4, 0.35, 0.055, 0.003)
IDEAL = Material('ideal', Restitution(0.5), 0.0, 2.0, 2.0, 0.0, 0.0)
MANY = int(os.environ.get('GOLF_SIM_SHOTS', '60'))


@entry
def top(kind, x, y):
    """Highest ground of a kind; Python can call it."""
    return surface_protocol.top(kind, x, y)


@entry
def nearest(kind, part, point):
    """Distance of a part of a kind and direction from there; Python can call it."""
    return surface_protocol.nearest(kind, part, point)


def surface(height, material=GREEN, spacing=0.5, low=(-10, -10), high=(10, 10)):
    """Height map of a function of x and y."""
    x = np.arange(low[0], high[0] + 0.5 * spacing, spacing)
    y = np.arange(low[1], high[1] + 0.5 * spacing, spacing)
    heights = np.broadcast_to(height(x[np.newaxis], y[:, np.newaxis]), (len(y), len(x)))
    return Heightmap(heights, low, spacing, material)


def step():
    """Make a map with a rise of 1 m over one cell of 0.5 m."""
    return surface(lambda x, y: 1.0 * (x > 0.1) + 0 * y, HARD, 0.5, (-4, -4), (4, 4))


def energy(ball):
    """Energy over mass [J/kg], with its height counted from z = 0."""
    v, w = np.array(ball.velocity), np.array(ball.spin)
    return 0.5 * (v @ v + 0.4 * RADIUS * RADIUS * (w @ w)) + G * ball.position[2]


def rests_at(course, start, velocity, accuracy='standard', engine='auto'):
    """Where a ball that is struck comes to rest; its energy never grows."""
    world = World(course, effects=GRAVITY, accuracy=accuracy, engine=engine)
    world.place('ball', start)
    world.strike('ball', velocity)
    last = energy(world['ball'])
    while world.moving and world.time < 60.0:
        world.advance(0.05)
        assert energy(world['ball']) <= last + 1e-6, world.time
        last = energy(world['ball'])
    assert world['ball'].phase == Phase.REST
    return np.array(world['ball'].position)


def test_a_tilted_plane_of_heights_is_that_plane():
    velocities, spins = random_shots(10, seed=11)
    velocities *= 0.1
    map_ = surface(lambda x, y: 0.03 * x - 0.02 * y, HARD, 4.0, (-40, -40), (40, 40))
    plane = Plane(normal=(-0.03, 0.02, 1.0), material=HARD)
    plane = plane._replace(normal=tuple(np.array(plane.normal) / np.linalg.norm(plane.normal)))
    ends = [
        one_by_one(Course((ground,)), velocities, spins, effects=GRAVITY, accuracy='reference')
        for ground in (plane, map_)
    ]
    for name in ('carry', 'carry_side', 'total', 'side'):
        np.testing.assert_allclose(ends[1][name], ends[0][name], atol=1e-6, err_msg=name)


def test_the_spline_passes_through_its_heights_and_bends_without_a_jump():
    rng = np.random.default_rng(1)
    column = rng.normal(size=(9, 1))
    slope = nodes(np.hstack((column, column)))[:, 0, 2]
    rise = np.diff(column[:, 0])
    begin = 6 * rise - 4 * slope[:-1] - 2 * slope[1:]
    end = -6 * rise + 2 * slope[:-1] + 4 * slope[1:]
    np.testing.assert_allclose(end[:-1], begin[1:], atol=1e-12)
    assert begin[0] == pytest.approx(0, abs=1e-12) and end[-1] == pytest.approx(0, abs=1e-12)


def test_nearest_is_what_brute_force_finds():
    kind = heightmap.build([step()], {HARD: 0})
    grid = kind.grids[0]
    rng = np.random.default_rng(2)
    for _ in range(40):
        row, column = rng.integers(0, 16), rng.integers(6, 11)
        x = -4 + 0.5 * (column + np.linspace(0, 1, 41))
        y = -4 + 0.5 * (row + np.linspace(0, 1, 41))
        point = np.array((x[0], y[0], 0.5)) + rng.uniform((-0.5, -0.5, 0.8), (1, 1, 2))
        z = np.array([[top(kind, a, b)[0] for a in x] for b in y[:1]])
        squares = (
            (x - point[0])[np.newaxis] ** 2
            + (y - point[1])[:, np.newaxis] ** 2
            + (z - point[2]) ** 2
        )
        distance, normal = nearest(kind, row * grid['nx'] + column, tuple(point))
        brute = sqrt(squares.min())
        # from afar a second hollow may be missed by a hair
        assert brute - 0.01 <= distance <= brute + 1e-3
        assert np.linalg.norm(normal) == pytest.approx(1, abs=1e-12)


def test_taylors_formula_in_a_cell_leaves_out_what_is_of_fifth_order():
    hills = surface(lambda x, y: np.sin(x) * np.sin(0.5 * y * y))
    kind = heightmap.build([hills], {GREEN: 0})
    grid = kind.grids[0]
    # The greatest errors of height, slope and curvature, by distance.
    errors = {0.02: np.zeros(6), 0.04: np.zeros(6)}
    random = np.random.default_rng(4)
    for cell, place, way in zip(
        random.integers(0, 40, (200, 2)),
        random.uniform(0.2, 0.8, (200, 2)),
        random.uniform(0, 7, 200),
    ):
        x, y = 0.5 * (cell + place)
        there = jet(kind.nodes, grid, x, y)
        for step, most in errors.items():
            dx, dy = step * np.cos(way), step * np.sin(way)
            found = np.subtract(in_cell(*there, dx, dy), bicubic(kind.nodes, grid, x + dx, y + dy))
            np.maximum(most, abs(found), out=most)
    ratio = errors[0.04] / errors[0.02]
    assert ratio == pytest.approx([32, 16, 16, 8, 8, 8], rel=0.2)


@pytest.mark.parametrize('cell', [False, True])
def test_the_closest_point_found_with_one_look_is_that_of_two(cell, monkeypatch):
    """Wherever a point is over the map, or over or beside one of its cells, and near it."""
    hills = surface(lambda x, y: 0.2 * np.sin(x) * np.sin(0.7 * y))
    kind = heightmap.build([hills], {GREEN: 0})
    grid = kind.grids[0]
    found = {}
    for close in (closest_point.CLOSE, 0.0):
        monkeypatch.setattr(closest_point, 'CLOSE', close)
        random = np.random.default_rng(6)
        found[close] = []
        for low_x, low_y, *place, height in random.uniform(-0.02, 1.02, (600, 5)):
            low = 0.5 * np.round(39 * np.clip((low_x, low_y), 0.0, 1.0))
            box = (*low, *(low + 0.5)) if cell else (0.0, 0.0, 20.0, 20.0)
            x, y = low + 0.5 * np.array(place) if cell else 20.0 * np.array(place)
            start = np.clip((x, y), box[:2], box[2:])
            z = bicubic(kind.nodes, grid, *start)[0] + 2.0 * RADIUS * height
            px, py, at = closest_point.descend(kind.nodes, grid, box, *start, (x, y, z))
            found[close].append((px, py, *at))
    one, two = (np.array(points) for points in found.values())
    off = np.abs(one - two).max(axis=0)
    assert max(off[:2]) < 1e-9 and off[2] < 1e-12 and max(off[3:5]) < 1e-9 and max(off[5:]) < 1e-7
    assert 100 < np.count_nonzero(np.any(one != two, axis=1))  # found with one look


@entry
def hollow_around(kind, part, point, reach):
    """Bound on the hollows of a part of a kind around a point; Python can call it."""
    return surface_protocol.hollow_around(kind, part, point, reach)


def test_hollows_around_a_place_are_those_of_the_cells_there():
    hills = surface(lambda x, y: np.sin(x) * np.sin(0.5 * y * y))
    kind = heightmap.build([hills], {GREEN: 0})
    (grid,) = kind.grids
    cells = kind.cells[:, 2].reshape(grid['ny'], grid['nx'])
    whole = grid['number']
    for x, y, reach in np.random.default_rng(3).uniform(
        (-9.0, -9.0, 0.0), (9.0, 9.0, 1.0), (60, 3)
    ):
        left, right = (int((x + 10.0 + way) / 0.5) for way in (-reach, reach))
        front, back = (int((y + 10.0 + way) / 0.5) for way in (-reach, reach))
        rows, columns = slice(max(front, 0), back + 1), slice(max(left, 0), right + 1)
        there = cells[rows, columns].max()
        assert hollow_around(kind, whole, (x, y, 0.5), reach) == there
    assert hollow_around(kind, whole, (0.0, 0.0, 0.5), 50.0) == grid['hollow'] == cells.max()
    assert hollow_around(kind, 7, (0.0, 0.0, 0.5), 0.1) == kind.cells[7, 2]


def test_a_ball_in_a_bowl_swings_at_5_7_of_a_sliding_one():
    curve = 2.0  # m: radius of the bowl
    bowl = surface(
        lambda x, y: curve - np.sqrt(curve * curve - x * x - y * y), IDEAL, 0.1, (-1, -1), (1, 1)
    )
    world = World(Course((bowl,)), effects=GRAVITY)
    world.place('ball', (0.02, 0, bowl.heights[10][10] + 0.0225), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    times, places = np.arange(1, 700) * 0.01, []
    for _ in times:
        world.advance(0.01)
        places.append(world['ball'].position[0])
    down = [i for i, (a, b) in enumerate(sliding_window_view(places, 2)) if a > 0 >= b]
    period = (times[down[-1]] - times[down[0]]) / (len(down) - 1)
    assert period == pytest.approx(2 * pi / sqrt(5 * G / (7 * (curve - RADIUS))), rel=5e-3)


def test_a_rolling_ball_has_the_spin_of_rolling_at_every_instant_not_only_where_a_segment_ends():
    land = surface(lambda x, y: 0.05 * np.sin(0.7 * x) + 0.04 * np.cos(0.5 * y))
    world = World(Course((land,)), effects=GRAVITY)
    world.place('ball', (-5.0, 1.0))
    world.strike('ball', (3.0, 0.5, 0.0))
    rolled = 0
    while world.moving:
        world.advance(0.02)
        ball = world['ball']
        if ball.phase == Phase.ROLL:
            speed = sqrt(np.dot(ball.velocity, ball.velocity))
            assert RADIUS * sqrt(np.dot(ball.spin, ball.spin)) == pytest.approx(
                speed, rel=2e-3, abs=2e-3
            )
            rolled += 1
    assert rolled > 50


@pytest.mark.parametrize('share, flies', [(0.98, False), (1.02, True)])
def test_a_ball_leaves_a_crest_where_gravity_no_longer_bends_its_path(share, flies):
    curve = 2.0
    crest = surface(
        lambda x, y: np.sqrt(curve * curve - x * x) + 0 * y, IDEAL, 0.05, (-1, -1), (1, 1)
    )
    speed = share * sqrt(G * (curve + RADIUS))
    world = World(Course((crest,)), effects=GRAVITY)
    world.place('ball', (0, 0), (speed, 0, 0), (0, speed / RADIUS, 0))
    world.advance(0.002)
    assert (world['ball'].phase == Phase.FLIGHT) == flies


HILL = surface(
    lambda x, y: 0.15 * np.sin(x * pi / 20) ** 2 * np.cos(y * pi / 10) ** 2,
    GREEN,
    0.5,
    (0, -5),
    (20, 5),
)
AROUND = Plane(material=GREEN, cut=(((0, -5), (20, -5), (20, 5), (0, 5)),))


def rolls_over(course, start, velocity, spin, effects, accuracy):
    """Roll a ball over `course` for a second: never into the hill, and in few steps."""
    world = World(course, effects=effects, accuracy=accuracy)
    world.place('ball', start, velocity, spin)
    kind = heightmap.build([HILL], {GREEN: 0})
    for _ in range(50):
        world.advance(0.02)
        x, y, z = world['ball'].position
        if 0 < x < 20 and abs(y) < 5:
            assert z > top(kind, x, y)[0] + RADIUS - 1e-4, (world.time, world['ball'])
    assert int(world._balls['evaluations'][0]) < 10_000


@pytest.mark.parametrize('accuracy', ACCURACY)
def test_topspin_holds_a_ball_to_a_crest_from_where_its_weight_alone_would_let_it_fly(accuracy):
    rolls_over(Course((HILL,)), (0, 0), (44, 0, 0), (0, 160, 0), EVERYTHING, accuracy)


@pytest.mark.parametrize('accuracy', ACCURACY)
def test_a_ball_rolls_from_a_plane_on_to_a_map_that_begins_in_its_cut(accuracy):
    rolls_over(Course((AROUND, HILL)), (-1, -4.2), (3.26, -0.5, 0), (0, 0, 0), GRAVITY, accuracy)


def test_a_plane_does_not_slow_a_ball_down_that_rolls_level_with_it_in_its_cut():
    flat = surface(lambda x, y: 0 * x + 0 * y, GREEN, 0.5, (0, -5), (20, 5))
    world = World(Course((AROUND, flat)), effects=GRAVITY)
    world.place('ball', (1.0, 0.3), (30.0, 2.0, 0.0))
    world.advance(0.5)
    assert world['ball'].position[0] > 10 and int(world._balls['evaluations'][0]) < 500


@pytest.mark.parametrize('rise, rests', [(1.39, True), (1.41, False)])
def test_a_ball_holds_where_5_7_of_the_slope_is_no_more_than_rolling_resistance(rise, rests):
    tilt = rise * 0.055
    hill = surface(lambda x, y: tilt * x + 0.05 * np.maximum(np.abs(y) - 5, 0) ** 3)
    world = World(Course((hill,)), effects=GRAVITY)
    world.place('ball', (0, 0, 0.05), (0, 0, 0), (0, 0, 0))
    world.advance(60.0)
    assert (world['ball'].phase == Phase.REST) == rests


def test_rest_on_a_wavy_green_is_the_same_to_a_millimetre_at_any_accuracy():
    green = Course((surface(lambda x, y: 0.3 * np.sin(x / 6) * np.cos(y / 7) + 0.02 * x),))
    for velocity in [(3.2, 1.0, 0), (-1.5, 0.4, 0), (0.5, -2.5, 1)]:
        ends = [
            rests_at(green, (0, 0), velocity, accuracy) for accuracy in ('standard', 'reference')
        ]
        np.testing.assert_allclose(ends[0], ends[1], atol=1e-3)


def test_fixed_steps_come_to_rest_on_a_wavy_green_too():
    green = Course((surface(lambda x, y: 0.3 * np.sin(x / 6) * np.cos(y / 7) + 0.02 * x),))
    fixed = Preset(METHODS['rk4'].record(0.02), ACCURACY['reference'].limits)
    ends = (
        rests_at(green, (0, 0), (3.2, 1.0, 0), fixed, engine='python'),
        rests_at(green, (0, 0), (3.2, 1.0, 0), 'reference'),
    )
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-4)


def test_nothing_tunnels_through_a_steep_map():
    course = Course((step(), Plane((0, 0, -3), material=HARD)))
    kind = heightmap.build(course.ground[:1], {HARD: 0})
    rng = np.random.default_rng(4)
    for _ in range(MANY):
        x, y = rng.uniform(-2, 2, 2)
        world = World(course, effects=GRAVITY, accuracy='sketch')
        way = rng.normal(size=3) * (1, 1, rng.choice([1, 0.02]))
        axis = rng.normal(size=3)
        world.place(
            'ball',
            (x, y, top(kind, x, y)[0] + 0.1 + rng.uniform(0, 1.9)),
            rng.uniform(0, 120) * way / np.linalg.norm(way),
            rng.uniform(0, 2000) * axis / np.linalg.norm(axis),
        )
        for _ in range(30):
            world.advance(0.02)
            bx, by, bz = world['ball'].position
            if max(abs(bx), abs(by)) < 4:
                assert bz > top(kind, bx, by)[0] + 0.5 * RADIUS, (world.time, world['ball'])


@pytest.mark.parametrize(
    'start, velocity, spin',
    [
        ((-1.0088, 0.0998, 0.30765), (98.193, -4.342, -52.949), (1310.3, 405.7, -761.4)),
        ((-0.9221, -0.4896, 0.28377), (39.679, -4.957, -22.72), (-304.8, 98.0, 51.8)),
    ],
)
def test_friction_under_a_press_of_thousands_of_weights_does_not_hold_up_time(
    start, velocity, spin
):
    """Ground that turns fast drives slip and spin as hard as friction takes them.

    No step shrinks to none.
    """
    world = World(
        Course((step(), Plane((0, 0, -3), material=HARD))), effects=GRAVITY, accuracy='reference'
    )
    world.place('ball', start, velocity, spin)
    before = energy(world['ball'])
    for _ in range(3):
        world.advance(0.02)
        assert energy(world['ball']) <= before + 1e-6
    assert int(world._balls['evaluations'][0]) < 20_000


def test_a_ball_stays_outside_the_walls_of_a_map():
    block = surface(lambda x, y: 1.0 + 0.1 * x + 0 * y, HARD, 0.5, (0, -2), (4, 2))
    world = World(Course((block, Plane(material=HARD))), effects=GRAVITY)
    world.place('ball', (-1, 0.3, 0.2), (20, 1, 0), (0, 100, 0))
    for _ in range(100):
        world.advance(0.02)
        assert world['ball'].position[0] <= -RADIUS + 1e-6


@pytest.mark.parametrize('speed', [2.7, 2.75, 3.0])
def test_a_ball_that_falls_past_a_wall_meets_no_back_of_the_ground_beyond_it(speed):
    heights = [
        [0.1, 0.26, 0.39, 0.28, 0.25],
        [0, 0.33, 0.06, 0.04, 0],
        [0.39, 0.4, 0.25, 0.32, 0.39],
        [0.31, 0, 0.39, 0.15, 0.33],
        [0.25, 0.1, 0, 0.19, 0.05],
    ]
    world = World(
        Course(
            (Plane((0, 0, -1), material=GREEN), Heightmap(heights, (-1, -1), 0.5, GREEN)),
            tee=(9.0, 0.0),
        ),
        effects=GRAVITY,
    )
    world.place('ball', (0.9, 0, 1.0), (0, -speed, 0))
    assert world.advance(0.6) == []
    assert world['ball'].position == pytest.approx((0.9, -0.6 * speed, 1.0 - 0.18 * G), abs=1e-9)


COURSE = """format: 1
ground:
  - {shape: heightmap, heights: green.npy, origin: [-1, -1], spacing: 0.5, material: green}
"""


def saved(folder, heights):
    """Path of a course file with a map of `heights`."""
    np.save(folder / 'green.npy', heights)
    (folder / 'links.yaml').write_text(COURSE)
    return folder / 'links.yaml'


def test_a_course_reads_its_heights_and_its_digest_covers_them(tmp_path):
    heights = np.arange(30.0).reshape(5, 6) / 100
    course = load_course(saved(tmp_path, heights))
    np.testing.assert_array_equal(course.ground[0].heights, heights)
    assert load_course(saved(tmp_path, heights + 1e-9)).digest != course.digest


@pytest.mark.parametrize(
    'heights, said',
    [
        (np.zeros((1, 5)), '2 x 2 or more; its shape is (1, 5)'),
        (np.zeros(5), '2 x 2 or more; its shape is (5,)'),
        (np.array([[0, 1], [np.nan, 0]]), 'height [1, 0] is nan'),
        (np.array([[0, 1], [1e9, 0]]), 'height [1, 0] is 1000000000.0'),
        (np.array([['a', 'b'], ['c', 'd']]), 'must hold numbers'),
        (np.array([[{}, 1], [1, 1]], object), 'no .npy file that can be read'),
    ],
)
def test_heights_that_are_none_are_refused_in_one_line(tmp_path, heights, said):
    with pytest.raises(CourseError) as error:
        load_course(saved(tmp_path, heights))
    assert (
        said in str(error.value)
        and 'green.npy' in str(error.value)
        and '\n' not in str(error.value)
    )


@pytest.mark.parametrize(
    'content, said',
    [
        (b'heights', 'is no .npy file'),
        (b'\x93NUMPY\x01\x00', 'no .npy file that can be read'),
        (
            b"\x93NUMPY\x01\x00F\x00{'descr': '<f8', 'fortran_order': False, "
            b"'shape': (99999, 99999), }   \n",
            'it tells of (99999, 99999) numbers, and ends',
        ),
        (None, 'cannot be read'),
    ],
)
def test_a_broken_file_of_heights_is_refused_in_one_line(tmp_path, content, said):
    path = saved(tmp_path, np.zeros((2, 2)))
    (tmp_path / 'green.npy').unlink()
    if content is not None:
        (tmp_path / 'green.npy').write_bytes(content)
    with pytest.raises(CourseError) as error:
        load_course(path)
    assert said in str(error.value) and '\n' not in str(error.value)


def test_a_ball_that_slides_down_a_steep_map_is_not_lost_in_small_steps():
    # Noise of the map's curvature made steps of 10 us at `reference`, until the shot failed.
    heights = np.zeros((5, 5))
    heights[2, 2], heights[2, 4] = 0.375, 0.25
    smooth = Material('smooth', Restitution(0.0), 0.0, 0.0, 0.0, 1.0, 0.0)
    course = Course((Plane((0, 0, -1)), Heightmap(heights, (-1.0, -1.0), 0.5, smooth)))
    world = World(course, effects=GRAVITY, accuracy='reference')
    world.place('ball', (0.9, 0.0, 1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    world.advance(0.6)
    assert world['ball'].position[0] < 0.6
