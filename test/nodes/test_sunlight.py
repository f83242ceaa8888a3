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

"""Markers bring their colours, with the sun on them; frames of several sims do not collide."""

from types import SimpleNamespace

from golf_sim_ros.course import load_course
from golf_sim_ros.course.package_files import share
from golf_sim_ros.drawing.rviz_view import rviz_view
from golf_sim_ros.drawing.sunlight import banded, CONTRAST, lit, SHADE, STRIPES, SUN
from golf_sim_ros.nodes import transforms
from golf_sim_ros.nodes.conversions import header
from golf_sim_ros.nodes.markers.course_markers import course_markers
from golf_sim_ros.nodes.markers.play_markers import HALO, Scene
from golf_sim_ros.physics import ground_height, Material, World
from hypothesis import given, strategies
import numpy as np
import pytest
from visualization_msgs.msg import Marker
import yaml

ROOT = share('package.xml').parent
COURSES = sorted(path.stem for path in share('config', 'courses').glob('*.yaml'))
GRASS, MOWN = Material('grass', color=(0.2, 0.5, 0.1)), Material('fairway', color=(0.2, 0.5, 0.1))
FLAT = np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
place = strategies.floats(-40.0, 40.0)


@pytest.mark.parametrize('name', COURSES)
def test_every_list_of_triangles_has_a_colour_for_each_point(name):
    markers = course_markers(load_course(name), 'course').markers
    lists = [marker for marker in markers if marker.type == Marker.TRIANGLE_LIST]
    assert {'ground', 'hole', 'water'} >= {marker.ns for marker in lists} >= {'ground'}
    for marker in lists:
        assert len(marker.colors) == len(marker.points) > 0


@pytest.mark.parametrize('name', COURSES)
def test_ground_is_as_bright_as_its_material_in_the_mean(name):
    for marker in course_markers(load_course(name), 'course').markers:
        if marker.ns == 'ground':
            seen = np.mean([(color.r, color.g, color.b) for color in marker.colors], 0)
            meant = np.array([marker.color.r, marker.color.g, marker.color.b])
            assert (seen > 0.6 * meant).all() and (seen < 1.35 * meant).all()


def test_level_ground_has_its_colour_and_what_faces_the_sun_is_brighter():
    assert lit(FLAT, GRASS)[0] == pytest.approx(GRASS.color)
    towards = FLAT.copy()
    towards[..., 2] = -(SUN[0] * FLAT[..., 0] + SUN[1] * FLAT[..., 1]) / SUN[2]
    away = FLAT.copy()
    away[..., 2] = 9.0 * (SUN[0] * FLAT[..., 0] + SUN[1] * FLAT[..., 1])
    assert (lit(towards, GRASS)[0] > GRASS.color).all()
    assert lit(away, GRASS)[0] == pytest.approx(SHADE * np.array(GRASS.color))
    assert lit(FLAT[:, ::-1], GRASS)[0] == pytest.approx(GRASS.color)  # whichever way it is wound


def test_stripes_follow_each_other():
    width = STRIPES['fairway']
    light = [lit(FLAT + [width * k, 0.0, 0.0], MOWN)[0, 0] / MOWN.color[0] for k in range(4)]
    assert light == pytest.approx([1 + CONTRAST, 1 - CONTRAST] * 2)


@given(strategies.tuples(*[strategies.tuples(place, place)] * 3))
def test_bands_cover_the_triangle_and_lie_in_one_stripe_and_in_its_plane(triangle):
    triangle = np.array([[(x, y, 0.1 * x - 0.2 * y) for x, y in triangle]])
    pieces = banded(triangle, MOWN)
    width = STRIPES['fairway']
    assert np.ptp(pieces[:, :, 0], axis=1).max() < width + 1e-5
    middle = pieces[:, :, 0].mean(1)
    bands = np.floor(middle / width)
    sound = np.ptp(pieces[:, :, 0], axis=1) > 1e-3  # the rest is no more than a line
    own = lit(pieces, MOWN)[sound, 0] > lit(pieces, GRASS)[sound, 0]
    assert (own == (bands[sound] % 2 == 0)).all()
    x, y, z = pieces.reshape(-1, 3).T
    np.testing.assert_allclose(z, 0.1 * x - 0.2 * y, atol=1e-9)
    assert areas(pieces).sum() == pytest.approx(areas(triangle).sum(), abs=1e-3)
    assert banded(triangle, GRASS) is triangle


def areas(corners):
    """Areas of triangles (n, 3, 3)."""
    sides = corners[:, 1:] - corners[:, :1]
    return 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)


def test_a_ball_has_a_halo_and_the_pin_its_distance():
    world = World(load_course('links'), ('ball',), engine='python')
    scene = Scene(world)
    made = {
        (marker.ns, marker.id): marker
        for marker in scene.markers(header('course', 0, 0.0), world, (0.0, 0.0, 0.0)).markers
    }
    assert made['halo', 0].scale.x == HALO and made['halo', 0].color.a < 1.0
    assert made['halo', 0].pose.position == made['ball', 0].pose.position
    assert made['text', 0].text == '346 m' and 3.0 < made['text', 0].scale.z < 8.0
    assert made['text', 1].action == Marker.DELETE
    scene.ended = SimpleNamespace(
        position=(1.0, 2.0, 3.0), lie='rough', status='at_rest', total=12.3
    )
    made = scene.markers(header('course', 0, 0.0), world, (0.0, 0.0, 0.0)).markers
    assert [marker.text for marker in made if marker.ns == 'text'][1] == '12.3 m, rough'


def test_words_on_a_short_hole_are_small():
    world = World(load_course('putting_green'), ('ball',), engine='python')
    made = Scene(world).markers(header('course', 0, 0.0), world, (0.0, 0.0, 0.0)).markers
    pin = next(marker for marker in made if (marker.ns, marker.id) == ('text', 0))
    assert pin.text == '3.0 m' and pin.scale.z < 0.3 and pin.pose.position.z < 0.5


def frames(frame):
    """Child frames of a sim whose frame is `frame`, each with its parent."""
    course, head = load_course('links'), header('', 0, 1.0)
    ball = SimpleNamespace(position=(1.0, 2.0, 3.0))
    found = transforms.of_course(course, 'map', frame, head)
    found += transforms.of_balls(frame, head, {'ball': ball, 'tee_ball': ball}, TURNS)
    return {made.child_frame_id: made.header.frame_id for made in found}


TURNS = {'ball': transforms.UPRIGHT, 'tee_ball': transforms.UPRIGHT}


def test_frames_are_one_tree_below_the_parent():
    assert frames('course') == {
        'course': 'map',
        'course/tee': 'course',
        'course/hole': 'course',
        'course/ball': 'course',
        'course/tee_ball': 'course',
    }


def test_frames_of_two_sims_do_not_collide():
    assert not frames('one').keys() & frames('other').keys()


def test_the_hole_is_where_the_course_has_it():
    made = transforms.of_course(load_course('links'), 'map', 'course', header('', 0, 2.5))
    hole = next(one for one in made if one.child_frame_id == 'course/hole').transform
    assert (hole.translation.x, hole.translation.y) == (346.0, 9.0)
    assert (hole.rotation.w, made[0].header.stamp.sec) == (1.0, 2)


def test_what_cannot_be_published_is_refused(monkeypatch):
    given = SimpleNamespace(parent_frame='map', frame_id='course', balls=('ball',))
    monkeypatch.setattr(transforms, 'IS_HERE', False)
    assert 'tf2_msgs' in transforms.objection(given)
    monkeypatch.setattr(transforms, 'IS_HERE', True)
    assert transforms.objection(given) == ''
    for wrong in ({'parent_frame': 'course'}, {'parent_frame': ''}, {'frame_id': ''}):
        refused = SimpleNamespace(**{**vars(given), **wrong})
        assert next(iter(wrong)) in transforms.objection(refused)
    given.balls = ('ball', 'hole')
    assert "'hole'" in transforms.objection(given)


def nodes(tree, key):
    """All values of a key, wherever in the tree."""
    if isinstance(tree, dict):
        yield from ([tree[key]] if key in tree else [])
        tree = list(tree.values())
    for part in tree if isinstance(tree, list) else []:
        yield from nodes(part, key)


@pytest.mark.parametrize('path', sorted((ROOT / 'rviz').glob('*.rviz')), ids=lambda p: p.name)
def test_views_of_rviz_have_a_near_clip_that_depth_can_bear(path):
    near = list(nodes(yaml.safe_load(path.read_text(encoding='utf-8')), 'Near Clip Distance'))
    assert near and all(0.4 <= distance <= 1.0 for distance in near)


def test_the_layout_for_foxglove_is_on_our_topics():
    layout = (ROOT / 'foxglove' / 'golf.json').read_text(encoding='utf-8')
    tree = yaml.safe_load(layout)
    topics = set(nodes(tree, 'topicPath')) | {
        topic for group in nodes(tree, 'topics') for topic in group
    }
    assert {'/course/markers', '/play/markers', '/shot/result'} <= topics


@pytest.mark.parametrize('name', COURSES)
def test_rviz_looks_from_over_the_ground_behind_the_tee_to_the_hole(name):
    course = load_course(name)
    config = (ROOT / 'rviz' / 'golf.rviz').read_text(encoding='utf-8')
    tree = yaml.safe_load(rviz_view(config, course))
    view = tree['Visualization Manager']['Views']['Current']
    focus = np.array([view['Focal Point'][axis] for axis in 'XYZ'])
    flat = np.cos(view['Pitch'])
    away = (flat * np.cos(view['Yaw']), flat * np.sin(view['Yaw']), np.sin(view['Pitch']))
    for share_of_way in np.linspace(0.3, 1.0, 8):
        x, y, z = focus + share_of_way * view['Distance'] * np.array(away)
        ground = ground_height(course, float(x), float(y))
        assert ground is None or z > ground[0] + 0.3, 'the view looks into a hill'
    to_hole = np.subtract(course.hole, focus[:2])
    assert np.dot(to_hole, away[:2]) < 0.0
    assert view['Class'] == 'rviz_default_plugins/Orbit'
