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

"""Zones and water with a cut, as fairways around bunkers and ponds around islands; and rounds."""

from golf_sim_ros.course import CourseError, load_course, load_round
from golf_sim_ros.drawing.zone_triangles import curved, flat, in_region, last_zone, sheet
from golf_sim_ros.physics import Course, ground_height, Patch, Plane, Shot, simulate, World
from golf_sim_ros.physics.geometry import polygon
from golf_sim_ros.physics.geometry.zone import Zone
from golf_sim_ros.physics.jit import entry
from golf_sim_ros.physics.properties.material import Material
import numpy as np
from oracles import RADIUS
import pytest

BOX, RING, HOLE = (((-r, -r), (r, -r), (r, r), (-r, r)) for r in (30.0, 20.0, 10.0))
OVER = ((5.0, 5.0), (25.0, 5.0), (25.0, 15.0), (5.0, 15.0))  # lies over the edges of RING and HOLE
COURSE = """format: 1
tee: [-25, 0]
ground:
  - {shape: plane, material: rough}
zones:
  - {material: fairway, polygon: [[-20, -20], [20, -20], [20, 20], [-20, 20]],
     cut: [[[-10, -10], [10, -10], [10, 10], [-10, 10]], [[5, 5], [25, 5], [25, 15], [5, 15]]]}
"""
POND = """format: 1
tee: [-28, 0]
ground:
  - {shape: plane, material: rough, point: [0, 0, -1]}
  - {shape: patch, center: [-35, 0, 0], length: 30, width: 60, material: rough}
water:
  - {polygon: [[-20, -20], [20, -20], [20, 20], [-20, 20]], level: -0.2,
     cut: [[[-10, -10], [10, -10], [10, 10], [-10, 10]]]}
"""


@pytest.fixture
def load(tmp_path):
    """Write a course file and load it."""

    def load(content):
        (tmp_path / 'links.yaml').write_text(content)
        return load_course(tmp_path / 'links.yaml')

    return load


def wanted(x, y):
    """Whether a place is on the fairway of COURSE."""
    ring = max(abs(x), abs(y)) < 20 and not max(abs(x), abs(y)) < 10
    return ring and not (5 < x < 25 and 5 < y < 15)


def test_a_zone_leaves_its_cuts_as_they_are(load):
    course = load(COURSE)
    places = np.random.default_rng(1).uniform(-30, 30, (400, 2))
    for x, y in places:
        assert ground_height(course, x, y)[1] == ('fairway' if wanted(x, y) else 'rough')
    assert (
        last_zone(course.zones, *places.T) == [0 if wanted(x, y) else -1 for x, y in places]
    ).all()


def test_a_cut_shows_the_zone_below_and_lines_where_it_begins(load):
    course = load(
        COURSE.replace(
            'zones:', f'zones:\n  - {{material: green, polygon: {list(map(list, BOX))}}}'
        )
    )
    assert [ground_height(course, x, 0)[1] for x in (0, 15, 25, 35)] == [
        'green',
        'fairway',
        'green',
        'rough',
    ]
    roll = simulate(course, Shot((16.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    whole = course._replace(zones=tuple(zone._replace(cut=()) for zone in course.zones))
    slow = simulate(whole, Shot((16.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    # the green within is the faster
    assert -10 < slow.result.position[0] < roll.result.position[0] - 0.5


def area(pieces):
    """Area of triangles of (x, y)."""
    corners = np.array(pieces, float).reshape(-1, 3, 2)
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    return 0.5 * np.abs(ax * by - ay * bx).sum()


def test_pictures_and_markers_show_cuts():
    turf, grass, sand = Material('turf'), Material('grass'), Material('sand')
    shown = flat(
        BOX,
        (),
        turf,
        (Zone(grass, RING, (HOLE, OVER)), Zone(sand, HOLE, (((0, 0), (5, 0), (0, 5)),))),
    )
    found = {material.name: area(pieces) for material, pieces in shown}
    ring = 1600 - 400 - (15 * 10 - 25)
    assert found['grass'] == pytest.approx(ring) and found['sand'] == pytest.approx(400 - 12.5)
    assert found['turf'] == pytest.approx(3600 - ring - 387.5)


@entry
def beside_region(table, i, x, y):
    """Distance from a region, and whether the place is in it."""
    return polygon.beside_region(table, i, x, y), polygon.in_region(table, i, x, y)


def test_the_distance_from_a_region_is_never_more_than_it_is():
    table = polygon.regions([RING, HOLE], [(HOLE, OVER), ()])
    rng = np.random.default_rng(2)
    inner = rng.uniform(-20, 20, (4000, 2))
    inner = inner[[beside_region(table, 0, x, y)[1] for x, y in inner]]
    assert len(inner) > 1000 and in_region(RING, (HOLE, OVER), *inner.T).all()
    for x, y in rng.uniform(-40, 40, (300, 2)):
        nearest = np.hypot(*(inner - (x, y)).T).min()
        away, inside = beside_region(table, 0, x, y)
        assert away <= nearest + 1e-9 and (away == 0.0) == inside
    assert (
        beside_region(table, 0, 0.0, 0.0)[0] == 10.0
        and beside_region(table, 1, 0.0, 15.0)[0] == 5.0
    )


@entry
def contains_box(table, i, low, high):
    """Whether a polygon contains a box."""
    return polygon.contains_box(table, i, low, high)


def test_a_box_is_in_a_polygon_where_all_of_it_is():
    bent = ((0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (4, 3), (4, 4), (0, 4))
    star = ((0, 0), (2, 1), (4, 0), (3, 2), (4, 4), (2, 3), (0, 4), (1, 2))
    table = polygon.polygons([bent, star, bent[::-1]])
    grid = np.stack(np.meshgrid(*2 * [np.linspace(0.0, 1.0, 21)]), -1).reshape(-1, 2)
    rng = np.random.default_rng(3)
    told = np.zeros(2)
    for i, outline in enumerate((bent, star, bent[::-1])):
        for _ in range(1000):
            middle, half = rng.uniform(0, 4, 2), rng.uniform(0, 0.7, 2)
            low, high = middle - half, middle + half
            within = in_region(outline, (), *(low + grid * (high - low)).T).all()
            contained = contains_box(table, i, (*low, 0.0), (*high, 0.0))
            # A corner of the outline may poke into the box between the places of the grid.
            pokes = any((low < corner).all() and (corner < high).all() for corner in outline)
            assert contained == (within and not pokes)
            told[int(contained)] += 1
    assert (told > 100).all()


@pytest.mark.parametrize(
    'speed, status, low, high',
    [
        (9.0, 'water', -20.0, -10.0),
        (16.0, 'at_rest', -10.0, 10.0),
        (20.5, 'water', 10.0, 20.0),
        (31.0, 'at_rest', 20.0, 200.0),
    ],
)
def test_a_ball_that_lands_on_an_island_or_beyond_the_pond_stays_dry(
    load, speed, status, low, high
):
    # At 45 degrees no ball skips, and on soft ground it stays near where it lands.
    soft = (
        POND.replace(
            'ground:',
            'materials: {rough: {restitution: 0, static_friction: 1, dynamic_friction: 1, '
            'rolling_resistance: 5}}\nground:',
        )
        + 'effects: [gravity]\n'
    )
    result = simulate(
        load(soft), Shot((speed / 2**0.5, 0.0, speed / 2**0.5), (0.0, 0.0, 0.0))
    ).result
    assert result.status == status and low < result.position[0] < high


def test_a_ball_is_placed_on_an_island_and_not_in_the_water_around(load):
    world = World(load(POND))
    world.place('ball', (0.0, 0.0))
    with pytest.raises(ValueError, match='lies in water'):
        world.place('ball', (15.0, 0.0))


def test_cuts_compile_nothing_that_is_not_compiled_without(load):
    for content in (COURSE, POND):
        course = load(content)
        plain = course._replace(
            zones=tuple(zone._replace(cut=()) for zone in course.zones),
            water=tuple(pond._replace(cut=()) for pond in course.water),
        )
        bare = plain._replace(zones=(), water=())
        assert World(course).program == World(plain).program == World(bare).program


def test_a_zone_may_be_a_pair_as_ever(load):
    course = load(COURSE)
    pair = course._replace(zones=((course.zones[0].material, RING),))
    assert ground_height(pair, 0.0, 0.0)[1] == 'fairway'


@pytest.mark.parametrize(
    'cut, said',
    [
        ('[[0, 0], [1, 0], [1, 1]]', 'zones[0].cut[0] [0, 0] must be a list of 3 or more corners'),
        (
            '[[[0, 0], [1, 1], [1, 0], [0, 1]]]',
            'zones[0].cut[0] [[0, 0], [1, 1], [1, 0], [0, 1]] must be a polygon',
        ),
        ('3', 'zones[0].cut 3 must be a list of polygons'),
    ],
)
def test_a_wrong_cut_is_named(load, cut, said):
    with pytest.raises(CourseError) as caught:
        load(
            'format: 1\nground: [{shape: plane, material: rough}]\n'
            f'zones: [{{material: green, polygon: [[0, 0], [9, 0], [9, 9]], cut: {cut}}}]\n'
        )
    assert said in str(caught.value)


def test_a_round_is_its_courses_in_order_and_a_course_is_a_round_of_one(tmp_path):
    (tmp_path / 'holes').mkdir()
    (tmp_path / 'holes' / 'first.yaml').write_text(COURSE)
    (tmp_path / 'second.yaml').write_text(POND)
    path = tmp_path / 'round.yaml'
    path.write_text(
        'format: 1\nname: a round\n'
        'round: [holes/first.yaml, second.yaml, links, holes/first.yaml]\n'
    )
    played = load_round(path)
    assert [course.name for course in played] == [
        'first',
        'second',
        load_course('links').name,
        'first',
    ]
    assert played[1].digest == load_course(tmp_path / 'second.yaml').digest
    assert [course.name for course in load_round(tmp_path / 'second.yaml')] == ['second']
    assert load_round('links')[0].digest == load_course('links').digest
    with pytest.raises(
        CourseError,
        match=r'round.yaml: is a round of 4 courses: give one of them: holes/first.yaml',
    ):
        load_course(path)


@pytest.mark.parametrize(
    'content, said',
    [
        ('round: []', "key 'format' is missing"),
        ('format: 1\nround: []', 'round [] must be a list of one or more'),
        ('format: 1\nround: [1]', 'round[0] 1 must be a line of text'),
        (
            'format: 1\nround: [a.yaml]\nhole: [1, 2]',
            "key 'hole' is unknown; known: format, name, round",
        ),
        ('format: 1\nround: [nowhere.yaml]', 'nowhere.yaml: cannot be read: No such file'),
        ('format: 1\nround: [round.yaml]', 'round: '),
        ('format: 1\nround: [~nobody_at_all/x.yaml]', 'cannot be read'),
    ],
)
def test_a_wrong_round_is_told_in_one_line(tmp_path, content, said):
    path = tmp_path / 'round.yaml'
    path.write_text(content)
    with pytest.raises(CourseError) as caught:
        load_round(path)
    assert (
        said in str(caught.value)
        and str(caught.value).startswith(f'{path}: ')
        and len(str(caught.value)) <= 300
    )


def test_many_zones_are_shown_as_few_are():
    turf = Material('turf')
    places = [(-28 + 4 * (i % 14), -28 + 4 * (i // 14)) for i in range(196)]
    zones = [
        Zone(Material(f'zone {i % 3}'), ((x, y), (x + 5, y), (x + 5, y + 3), (x, y + 3)))
        for i, (x, y) in enumerate(places)
    ]
    found = {}
    for material, pieces in flat(BOX, (HOLE,), turf, zones):
        found[material.name] = found.get(material.name, 0.0) + area(pieces)
    x, y = (
        part.ravel() + 0.125
        for part in np.meshgrid(np.arange(-30, 30, 0.25), np.arange(-30, 30, 0.25))
    )
    last = last_zone(zones, x, y)
    shown = np.maximum(np.abs(x), np.abs(y)) > 10
    for number in range(3):
        own = shown & (last >= 0) & (last % 3 == number)
        assert found[f'zone {number}'] == pytest.approx(own.sum() / 16)
    assert found['turf'] == pytest.approx((shown & (last < 0)).sum() / 16)


def test_ground_that_is_not_flat_is_painted_up_to_the_edges_of_zones():
    sand, grass, turf = (Material(name) for name in ('sand', 'grass', 'turf'))
    x, y = np.linspace(-35.0, 35.0, 24), np.linspace(-33.0, 33.0, 10)
    hook = ((22.0, -9.0), (33.0, -20.0), (34.0, 12.5), (30.0, 0.3), (23.0, 12.0))
    corners = sheet(x, y, np.add.outer(0.2 * y, 0.1 * x))
    painted = dict(curved(corners, grass, [Zone(turf, RING, (HOLE,)), Zone(sand, hook)]))
    found = {material.name: area(pieces[:, :, :2]) for material, pieces in painted.items()}
    sandy = 233.4  # by the shoelace formula
    wanted = {'sand': sandy, 'turf': 1200.0, 'grass': 70.0 * 66.0 - 1200.0 - sandy}
    assert found == pytest.approx(wanted, abs=1e-2)
    for pieces in painted.values():
        east, north, up = pieces.reshape(-1, 3).T
        np.testing.assert_allclose(up, 0.1 * east + 0.2 * north, atol=1e-9)


@pytest.mark.parametrize('tilt', [0.0, 0.05])
def test_a_ball_stays_within_the_walls_of_the_pit_that_it_falls_into(tilt):
    pit = np.array(((0, -2), (6, -2), (6, 4), (4, 4), (4, 0), (0, 0)), float)
    up = np.array((-tilt, 0.0, 1.0)) / np.hypot(tilt, 1.0)
    ground = Plane(normal=tuple(up), cut=(pit.tolist(),))
    floor = Patch((3.0, 1.0, -1.0), length=9.0, width=9.0)
    world = World(Course((ground, floor), tee=(-5.0, 0.0)))
    ways = np.roll(pit, -1, 0) - pit
    rng = np.random.default_rng(4)
    deep = 0
    for _ in range(40):
        start = (*rng.uniform((4.3, -1.7), (5.7, -0.3)), rng.uniform(-0.9, 0.3))
        world.place('ball', start, (*rng.uniform(-8, 8, 2), rng.uniform(-3, 3)))
        for _ in range(100):
            world.advance(0.02)
            place = np.array(world['ball'].position)
            height = place @ up
            if -1.5 < height < -0.1:  # else at the rim, or out of the pit
                deep += 1
                foot = (place - height * up)[:2]
                share = ((foot - pit) * ways).sum(1) / (ways**2).sum(1)
                beside = foot - pit - np.clip(share, 0.0, 1.0)[:, np.newaxis] * ways
                assert in_region(pit, (), *foot) and place[2] > -1.0 + 0.98 * RADIUS
                assert np.hypot(*beside.T).min() > 0.98 * RADIUS
    assert deep > 1000
