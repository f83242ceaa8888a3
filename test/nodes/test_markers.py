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

"""Markers show the course and the play as they are."""

from math import cos, hypot, pi, sin

from golf_sim_ros.course import load_course
from golf_sim_ros.drawing.polygon_triangles import triangles
from golf_sim_ros.nodes.conversions import header
from golf_sim_ros.nodes.markers.course_markers import (
    course_markers,
    HOLE_DIAMETER,
    MARGIN,
    outskirts,
    surface,
)
from golf_sim_ros.nodes.markers.play_markers import CONTACTS, Scene, TRAIL, Trail
from golf_sim_ros.physics import (
    Course,
    Cylinder,
    geometry,
    ground_height,
    Heightmap,
    Material,
    Patch,
    Plane,
    Sphere,
    Water,
    World,
)
from golf_sim_ros.physics.geometry.cup import DEPTH
from golf_sim_ros.physics.geometry.zone import places_inside
from hypothesis import given, strategies
import numpy as np
import pytest
from rclpy.serialization import serialize_message
from visualization_msgs.msg import Marker

GRASS, SAND = Material('grass', color=(0.1, 0.5, 0.1)), Material('sand', color=(0.9, 0.8, 0.6))
SQUARE = ((0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0))
PIT = ((20.0, -5.0), (30.0, -5.0), (30.0, 5.0), (20.0, 5.0))


@pytest.fixture(scope='module')
def course():
    """Load the shipped course."""
    return load_course('golf_without_friends')


def area(corners):
    """Signed area of a polygon, positive when counterclockwise."""
    following = [*corners[1:], corners[0]]
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, following))


def total(pieces):
    return sum(area(piece) for piece in pieces)


def threes(corners):
    """Corners of triangles, three by three."""
    return list(zip(corners[::3], corners[1::3], corners[2::3]))


def surfaces(array):
    """For each colour the triangles, three (x, y, z) each, that show ground in it."""
    found = {}
    for marker in array.markers:
        if marker.ns == 'ground':
            corners = [(point.x, point.y, point.z) for point in marker.points]
            color = tuple(
                round(part, 3) for part in (marker.color.r, marker.color.g, marker.color.b)
            )
            found[color] = threes(corners)
    return found


def covers(pieces, x, y):
    x, y = np.array([x]), np.array([y])
    return any(places_inside([corner[:2] for corner in piece], x, y)[0] for piece in pieces)


def test_a_square_without_cuts_is_two_triangles():
    assert len(triangles(SQUARE)) == 2 and total(triangles(SQUARE)) == pytest.approx(100.0)


def test_a_cut_within_takes_just_its_area_away():
    pieces = triangles(SQUARE, [((2, 2), (6, 3), (4, 7))])
    assert total(pieces) == pytest.approx(100.0 - area(((2, 2), (6, 3), (4, 7))))
    assert not covers(pieces, 4, 4) and covers(pieces, 1, 1) and covers(pieces, 8, 5)


def test_a_cut_over_the_border_takes_only_what_is_inside():
    assert total(triangles(SQUARE, [((8, 8), (12, 8), (12, 12), (8, 12))])) == pytest.approx(96.0)


def test_cuts_that_overlap_take_their_union():
    cuts = [((2, 2), (6, 2), (6, 6), (2, 6)), ((4, 4), (8, 4), (8, 8), (4, 8))]
    assert total(triangles(SQUARE, cuts)) == pytest.approx(100.0 - 28.0)


def test_a_concave_outline_and_a_clockwise_one_are_covered():
    corner = ((0, 0), (4, 0), (4, 4), (2, 4), (2, 2), (0, 2))
    assert total(triangles(corner)) == pytest.approx(12.0)
    assert total(triangles(tuple(reversed(corner)))) == pytest.approx(12.0)


@given(
    strategies.lists(strategies.floats(0.3, 3.0), min_size=3, max_size=9),
    strategies.floats(0.0, 6.3),
    strategies.floats(4.0, 6.0),
    strategies.floats(4.0, 6.0),
)
def test_triangles_and_a_star_shaped_cut_make_up_the_outline(radii, turn, x, y):
    angles = [turn + 2 * pi * i / len(radii) for i in range(len(radii))]
    cut = tuple((x + r * cos(a), y + r * sin(a)) for r, a in zip(radii, angles))
    pieces = triangles(SQUARE, [cut])
    assert total(pieces) + area(cut) == pytest.approx(100.0, abs=1e-6)
    assert all(area(piece) > -1e-9 for piece in pieces)


def test_a_patch_is_shown_where_it_lies_in_its_colour():
    patch = Patch((5.0, 1.0, 0.5), (0.0, -0.6, 0.8), 0.3, 8.0, 4.0, SAND)
    ((color, pieces),) = surfaces(
        course_markers(Course((patch,), tee=(5.0, 1.0)), 'course')
    ).items()
    assert color == (0.9, 0.8, 0.6)
    for corner in [corner for piece in pieces for corner in piece]:
        assert -0.6 * (corner[1] - 1.0) + 0.8 * (corner[2] - 0.5) == pytest.approx(0.0, abs=1e-9)
    assert total([[corner[:2] for corner in piece] for piece in pieces]) == pytest.approx(
        8 * 4 * 0.8
    )


def test_a_planes_cut_is_open_and_the_plane_is_drawn_around_the_course():
    ground = (Plane(material=GRASS, cut=(PIT,)),)
    pieces = surfaces(course_markers(Course(ground), 'course'))[0.1, 0.5, 0.1]
    assert not covers(pieces, 25.0, 0.1) and covers(pieces, 19.0, 0.1)
    assert covers(pieces, 30.0 + MARGIN - 1, 0.1) and not covers(pieces, 30.0 + MARGIN + 1, 0.1)


def test_a_zone_is_shown_in_its_colour_where_there_is_ground_and_later_ones_over_earlier():
    turf, zones = (
        Plane(material=GRASS, cut=(PIT,)),
        ((SAND, SQUARE), (GRASS, PIT), (SAND, PIT[:3])),
    )
    found = surfaces(course_markers(Course((turf,), zones=zones), 'course'))
    assert total(
        [[corner[:2] for corner in piece] for piece in found[0.9, 0.8, 0.6]]
    ) == pytest.approx(100.0)
    assert covers(found[0.9, 0.8, 0.6], 5.1, 5.2) and not covers(found[0.1, 0.5, 0.1], 5.1, 5.2)
    under = surfaces(course_markers(Course((Plane(material=GRASS),), zones=zones), 'course'))
    assert covers(under[0.9, 0.8, 0.6], 27.0, -3.0) and covers(under[0.1, 0.5, 0.1], 22.0, 3.0)


def test_a_height_map_is_shown_at_its_heights_and_painted_with_zones():
    heights = np.add.outer(0.1 * np.arange(11), 0.02 * np.arange(21))
    course = Course(
        (Heightmap(heights, (0.0, 0.0), 1.0, GRASS),), tee=(1.0, 1.0), zones=((SAND, SQUARE),)
    )
    found = surfaces(course_markers(course, 'course'))
    for color in (0.1, 0.5, 0.1), (0.9, 0.8, 0.6):
        assert total(
            [[corner[:2] for corner in piece] for piece in found[color]]
        ) == pytest.approx(100.0)
        for x, y, z in (corner for piece in found[color] for corner in piece):
            assert z == pytest.approx(0.02 * x + 0.1 * y)
    assert covers(found[0.9, 0.8, 0.6], 9.3, 9.6) and covers(found[0.1, 0.5, 0.1], 10.3, 9.6)


def test_a_large_height_map_is_thinned_out_and_its_outline_stays():
    course = Course((Heightmap(np.zeros((301, 402)), material=GRASS),), tee=(5.0, 5.0))
    array = course_markers(course, 'course')
    assert len(serialize_message(array)) < 5e6
    corners = np.array([c for piece in surfaces(array)[0.1, 0.5, 0.1] for c in piece])
    assert corners.min(0).tolist() == [0.0, 0.0, 0.0] and corners.max(0).tolist() == [
        401.0,
        300.0,
        0.0,
    ]


def test_where_a_patch_lies_in_the_plane_only_the_patch_is_shown():
    ground = (Plane(material=GRASS), Patch((10.0, 0.0, 0.0), length=4.0, width=4.0, material=SAND))
    found = surfaces(course_markers(Course(ground), 'course'))
    assert covers(found[0.9, 0.8, 0.6], 10.1, 0.1)
    assert not covers(found[0.1, 0.5, 0.1], 10.1, 0.1) and covers(found[0.1, 0.5, 0.1], 13.1, 0.1)


def test_water_is_blue_over_its_polygon_at_its_level_and_what_is_below_shines_through():
    course = Course(
        (Plane(material=GRASS, cut=(PIT,)),), water=(Water(PIT, -0.2), Water(SQUARE, 0.5))
    )
    array = course_markers(course, 'course')
    (made,) = (marker for marker in array.markers if marker.ns == 'water')
    corners = [(point.x, point.y, point.z) for point in made.points]
    pieces = threes(corners)
    assert total(pieces) == pytest.approx(200.0)
    seen = [made.color.a * color.a for color in made.colors]  # as RViz has it
    assert all(alpha == pytest.approx(0.6) for alpha in seen) and seen
    assert made.color.b > max(made.color.r, made.color.g)
    assert {(x > 15.0, z) for x, _, z in corners} == {(True, -0.2), (False, 0.5)}


def test_an_upright_patch_and_an_upright_plane_are_shown():
    for shape in (
        Patch((5.0, 0.0, 1.0), (1.0, 0.0, 0.0), 1.5707963, 4.0, 2.0, SAND),
        Plane((5.0, 0.0, 0.0), (1.0, 0.0, 0.0), SAND),
    ):
        array = course_markers(Course((Plane(material=GRASS), shape)), 'course')
        corners = [corner for piece in surfaces(array)[0.9, 0.8, 0.6] for corner in piece]
        assert len(corners) == 6 and all(corner[0] == pytest.approx(5.0) for corner in corners)


def test_triangles_that_share_a_corner_share_its_message(course):
    lists = [marker for marker in course_markers(course, 'links').markers if marker.ns == 'ground']
    assert len(lists) > 3
    for marker in lists:
        points = {(point.x, point.y, point.z) for point in marker.points}
        assert len({id(point) for point in marker.points}) == len(points) < len(marker.points)
        colors = {(color.r, color.g, color.b) for color in marker.colors}
        assert len({id(color) for color in marker.colors}) == len(colors) <= len(marker.colors) / 3


def test_the_shipped_course_is_few_markers_of_every_material_with_stamp_0(course):
    array = course_markers(course, 'links')
    assert len(array.markers) <= 12
    materials = {tuple(round(part, 3) for part in shape.material.color) for shape in course.ground}
    assert set(surfaces(array)) == materials
    assert len({(marker.ns, marker.id) for marker in array.markers}) == len(array.markers)
    for marker in array.markers:
        assert marker.header.frame_id == 'links' and marker.header.stamp.sec == 0
        assert marker.color.a == 1.0 and marker.scale.x > 0.0


def test_over_the_shipped_course_what_is_highest_is_what_is_shown(course):
    shown = surfaces(course_markers(course, 'course'))
    colors = {
        shape.material.name: tuple(round(part, 3) for part in shape.material.color)
        for shape in course.ground
    }
    low, _, high, _ = outskirts(course)
    for part in range(1, 250):  # multiples of two irrational numbers fill the rectangle evenly
        x = low[0] + part * 0.7548776662 % 1.0 * (high[0] - low[0])
        y = low[1] + part * 0.5698402910 % 1.0 * (high[1] - low[1])
        _, material = ground_height(course, x, y)
        assert covers(shown[colors[material]], x, y), (x, y, material)


def test_the_hole_has_a_disc_a_stick_and_a_flag_and_a_course_without_has_none(course):
    x, y = course.hole
    z = ground_height(course, x, y)[0]
    disc, stick, flag = [m for m in course_markers(course, 'course').markers if m.ns == 'hole']
    assert disc.scale.x == HOLE_DIAMETER
    assert (disc.pose.position.x, disc.pose.position.y, disc.pose.position.z) == (x, y, z)
    assert stick.pose.position.z - 0.5 * stick.scale.z == pytest.approx(z - DEPTH)
    assert max(point.z for point in flag.points) == pytest.approx(z - DEPTH + stick.scale.z)
    bare = course._replace(flagstick=False)
    assert [m.type for m in course_markers(bare, 'course').markers if m.ns == 'hole'] == [
        Marker.CYLINDER
    ]
    assert not [
        m for m in course_markers(course._replace(hole=None), 'course').markers if m.ns == 'hole'
    ]


def test_a_tree_is_a_cylinder_and_a_sphere_in_their_colours():
    tree = (Cylinder((60.0, 12.0, 1.0), 0.3, 8.0, SAND), Sphere((60.0, 12.0, 9.0), 2.5, GRASS))
    array = course_markers(Course((Plane(material=GRASS),), obstacles=tree), 'course')
    trunk, crown = [m for m in array.markers if m.ns == 'obstacles']
    assert (trunk.type, trunk.scale.x, trunk.scale.z) == (Marker.CYLINDER, 0.6, 8.0)
    assert (trunk.pose.position.x, trunk.pose.position.z) == (60.0, 5.0)
    assert (crown.type, crown.scale.z, crown.pose.position.z) == (Marker.SPHERE, 5.0, 9.0)
    assert crown.color.g == pytest.approx(0.5)


def test_the_tee_stands_on_the_ground_on_both_sides_of_the_ball(course):
    (tee,) = [m for m in course_markers(course, 'course').markers if m.ns == 'tee']
    left, right = tee.points
    assert left.y - course.tee[1] == course.tee[1] - right.y > 1.0
    assert left.z == ground_height(course, left.x, left.y)[0]


def test_a_trail_keeps_few_points_spread_over_the_whole_way():
    trail = Trail(TRAIL)
    for i in range(100000):
        trail.add((i, 0.0, 0.0))
        assert len(trail.places) < TRAIL
    steps = {b[0] - a[0] for a, b in zip(trail.places, trail.places[1:])}
    assert trail.places[0] == (0, 0.0, 0.0) and len(steps) == 1 and len(trail.places) >= TRAIL // 2
    assert trail.places[-1][0] > 99000


@pytest.fixture(scope='module')
def world(course):
    """Two balls on the shipped course."""
    return World(course, ('red', 'blue'))


def test_the_play_is_a_handful_of_markers_with_every_ball_where_it_is(world):
    scene = Scene(world)
    scene.trails['red'].add((1.0, 2.0, 3.0))
    array = scene.markers(header('course', 0, 1.5), world, (0.0, 3.0, 0.0))
    assert len(array.markers) == 4 + 3 * len(world.names)
    balls = [marker for marker in array.markers if marker.ns == 'ball']
    for name, ball in zip(world.names, balls):
        place = ball.pose.position
        assert (place.x, place.y, place.z) == world[name].position
        assert ball.scale.x == pytest.approx(2 * world.course.ball.radius)
    trail = next(marker for marker in array.markers if marker.ns == 'trail')
    assert (trail.points[0].x, trail.points[-1].y) == (1.0, world['red'].position[1])
    assert all(marker.header.stamp.nanosec == 500000000 for marker in array.markers)


def test_the_wind_is_an_arrow_of_a_metre_for_each_metre_a_second_and_none_when_calm(world):
    def arrow(wind):
        array = Scene(world).markers(header('course', 0, 0.0), world, wind)
        return next(marker for marker in array.markers if marker.ns == 'wind')

    tail, tip = arrow((3.0, 4.0, 0.0)).points
    assert hypot(tip.x - tail.x, tip.y - tail.y) == pytest.approx(5.0) and tip.z == tail.z
    assert arrow((0.0, 0.0, 0.0)).action == Marker.DELETE


def test_only_the_last_contacts_are_shown(world):
    scene = Scene(world)
    assert scene.hits().action == Marker.DELETE
    for i in range(CONTACTS + 5):
        scene.contacts.append((float(i), 0.0, 0.0))
    assert [point.x for point in scene.hits().points] == [float(i) for i in range(5, CONTACTS + 5)]


def test_a_kind_of_ground_without_a_function_of_its_own_is_shown_by_its_heights():
    patch = Patch((1.0, 2.0, 0.5), (-0.2, 0.1, 1.0), 0.3, 4.0, 2.0, GRASS)
    low, high = geometry.extent(patch)
    ((material, shown),) = surface.dispatch(object)(patch, Course((Plane(), patch)), 0)
    assert material == GRASS
    x, y, z = shown.reshape(-1, 3).T
    np.testing.assert_allclose(z, 0.5 + 0.2 * (x - 1.0) - 0.1 * (y - 2.0), atol=1e-9)
    assert low[0] <= x.min() and x.max() <= high[0] and low[1] <= y.min() and y.max() <= high[1]
    assert total(shown) == pytest.approx(4.0 * 2.0, rel=0.15)  # its edges are those of the grid
