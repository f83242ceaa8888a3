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

"""The bytes that a page gets of a course say what the physics says of its ground."""

import json
import struct

from golf_sim_ros.course import load_course
from golf_sim_ros.course.package_files import share
from golf_sim_ros.drawing.relief import relief
from golf_sim_ros.physics import Course, Cylinder, ground_height, Patch, Plane, Sphere, Water
from golf_sim_ros.physics.scene.kernel_model import materials
from golf_sim_ros.view.course_data import course_data, pack
from golf_sim_ros.view.raster import ground_grid, NO_GROUND
import numpy as np
import pytest

COURSES = sorted(path.stem for path in share('config', 'courses').glob('*.yaml'))


def unpacked(raw):
    """JSON, heights and materials, as `js/land.js` reads them."""
    assert raw[:4] == b'GOLF'
    (length,) = struct.unpack('<I', raw[4:8])
    about = json.loads(raw[8:][:length])
    grid = about['grid']
    count = grid['nx'] * grid['ny']
    differences = np.frombuffer(raw, '<i2', count, 8 + length).reshape(grid['ny'], grid['nx'])
    numbers = np.frombuffer(raw, 'u1', offset=8 + length + 2 * count)
    heights = grid['mean'] + grid['step'] * np.cumsum(differences.astype(np.int64), axis=1)
    return about, heights, numbers.reshape(grid['my'], grid['mx'])


def test_every_shipped_course_is_here():
    assert {'golf_without_friends', 'links', 'playground', 'putting_green'} <= set(COURSES)


@pytest.mark.parametrize('name', COURSES)
def test_grids_agree_with_the_physics_at_any_place(name):
    course = load_course(name)
    _, heights, _ = unpacked(pack(course))
    random = np.random.default_rng(1)
    low = np.min([course.tee, course.hole or course.tee], 0) - 30.0
    high = np.max([course.tee, course.hole or course.tee], 0) + 30.0
    x, y = (np.sort(random.uniform(low[axis], high[axis], 25)) for axis in (0, 1))
    asked, numbers = relief(course, x, y[:, np.newaxis])
    found, kinds = ground_grid(course, x, y)
    np.testing.assert_allclose(found, asked, atol=1e-9)
    assert (kinds == np.where(numbers < 0, NO_GROUND, numbers)).all()


@pytest.mark.parametrize('name', COURSES)
def test_what_is_packed_is_the_ground_to_a_millimetre(name):
    course = load_course(name)
    about, heights, numbers = unpacked(pack(course))
    grid = about['grid']
    random = np.random.default_rng(2)
    for _ in range(60):
        i, j = random.integers(grid['nx']), random.integers(grid['ny'])
        x, y = grid['x'] + i * grid['spacing'], grid['y'] + j * grid['spacing']
        place = ground_height(course, float(x), float(y))
        assert abs(heights[j, i] - place[0]) <= 0.5 * grid['step'] + 1e-9
    texel = grid['spacing'] * (grid['nx'] - 1) / grid['mx']
    for _ in range(60):
        i, j = random.integers(grid['mx']), random.integers(grid['my'])
        place = (grid['x'] + (i + 0.5) * texel, grid['y'] + (j + 0.5) * texel)
        name = materials(course)[numbers[j, i]].name
        assert name == ground_height(course, *map(float, place))[1]


@pytest.mark.parametrize('name', COURSES)
def test_a_course_is_small_and_its_tag_names_its_content(name):
    course = load_course(name)
    data = course_data(course)
    assert len(data.packed) < 100_000
    assert data == course_data(course)
    assert data.tag != course_data(course._replace(tee=(1.0, 1.0))).tag


def test_what_stands_and_lies_on_a_course_is_told():
    square = ((0, 0), (9, 0), (9, 9), (0, 9))
    course = Course(
        ground=(Plane((0, 0, 0)),),
        hole=(20.0, 0.0),
        obstacles=(Sphere((5, 5, 3), 2.0), Cylinder((1, 2, 0), 0.5, 4.0)),
        water=(Water(square, -0.5),),
    )
    about, _, _ = unpacked(pack(course))
    assert [one['kind'] for one in about['obstacles']] == ['sphere', 'cylinder']
    assert about['water'][0]['level'] == -0.5
    assert about['hole'] == [20.0, 0.0, 0.0]


def test_a_cliff_is_as_high_as_it_is():
    low, high = Plane((0, 0, 0)), Patch((0, 0, 20.0), length=30.0, width=30.0)
    about, heights, _ = unpacked(pack(Course(ground=(low, high), hole=(10.0, 0.0))))
    assert heights.max() > 10.0
    assert abs(heights[heights > 10.0] - 20.0).max() <= about['grid']['step']
    assert abs(heights[heights <= 10.0]).max() <= about['grid']['step']


def test_walls_are_told_as_corners():
    about, _, _ = unpacked(pack(load_course('playground')))
    (wall,) = about['walls']
    assert np.ptp(np.array(wall['corners']), 0).tolist() == [0.0, 12.0, 2.0]
