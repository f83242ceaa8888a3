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

"""The key ``wind_field`` of a course: a field of its own land, or one line that says why not."""

import shutil

from golf_sim_ros.course import CourseError, load_course, shipped_courses
from golf_sim_ros.course.course_file import course_without_field
from golf_sim_ros.wind.land_survey import land_digest
import pytest

FIELD = shipped_courses()['links'].with_name('links_wind.npz')


@pytest.fixture
def links(tmp_path):
    """Path of a copy of `links`, with all its files."""
    for name in ('links.yaml', 'links.npy', 'links_wind.npz'):
        shutil.copy(FIELD.with_name(name), tmp_path)
    return tmp_path / 'links.yaml'


def refused(path):
    """Return the line by which a course is refused."""
    with pytest.raises(CourseError) as told:
        load_course(path)
    assert '\n' not in str(told.value) and len(str(told.value)) <= 300
    return str(told.value)


@pytest.mark.parametrize('name', ['links', 'tall_pines'])
def test_shipped_courses_come_with_fields_of_their_own_land(name):
    course = load_course(name)
    assert course.wind_field is not None and len(course.wind_field.angles) == 16
    bare = course_without_field(name)
    assert bare.wind_field is None and land_digest(bare) == land_digest(course)


def test_a_course_needs_none():
    assert load_course('golf_without_friends').wind_field is None


def test_an_empty_list_is_none_as_before(links):
    links.write_text(
        links.read_text()
        .replace('links_wind.npz', '[]', 2)
        .replace('# The wind over it was solved for, with its dunes and trees: []', '#')
    )
    assert load_course(links).wind_field is None


def test_a_field_is_part_of_the_digest(links):
    before = load_course(links).digest
    raw = FIELD.read_bytes()
    (links.parent / 'links_wind.npz').write_bytes(raw + b'\0')  # after the archive's end
    try:
        assert load_course(links).digest != before
    except CourseError:
        pass  # an archive may be refused for that


@pytest.mark.parametrize(
    'old, new',
    [
        ('level: -0.1', 'level: -0.2'),
        ('spacing: 1.0', 'spacing: 1.001'),
        ('radius: 2.1, material: leaves', 'radius: 2.2, material: leaves'),
        ('{material: tee, polygon: [[-5,', '{material: sand, polygon: [[-5,'),
        ('wind_field:', 'wind_profile: {law: log, roughness: 0.02}\nwind_field:'),
        ('wind_field:', 'materials: {rough: {roughness: 0.05}}\nwind_field:'),
        ('wind_field:', 'materials: {leaves: {canopy_drag: 0.5}}\nwind_field:'),
    ],
)
def test_of_another_land_it_is_refused(links, old, new):
    text = links.read_text()
    assert old in text
    links.write_text(text.replace(old, new, 1))
    assert refused(links).endswith(
        'wind_field was made for another ground, other trees or another roughness; make it anew: '
        'ros2 run golf_sim_ros wind_field COURSE -o FILE.npz'
    )


def test_what_the_wind_does_not_feel_may_change(links):
    text = links.read_text()
    text = text.replace('tee: [0.0, 0.0]', 'tee: [1.0, 0.0]')
    links.write_text(text + '\nmaterials: {rough: {restitution: 0.2, color: [1, 0, 0]}}\n')
    assert load_course(links).wind_field is not None


def test_of_another_profile_it_is_refused(links):
    links.write_text(
        links.read_text().replace('wind_field:', 'wind_profile: {law: power}\nwind_field:', 1)
    )
    assert refused(links).endswith(
        'wind_field a wind field needs a logarithmic wind_profile, and this is PowerProfile'
    )


@pytest.mark.parametrize('content', [b'', b'nonsense', b'PK\x03\x04nonsense'])
def test_a_broken_file_is_refused_in_one_line(links, content):
    (links.parent / 'links_wind.npz').write_bytes(content)
    assert 'wind_field links_wind.npz: ' in refused(links)


def test_a_truncated_one_is_refused_in_one_line(links):
    raw = FIELD.read_bytes()
    (links.parent / 'links_wind.npz').write_bytes(raw[: len(raw) // 2])
    assert 'wind_field links_wind.npz: is no wind field: ' in refused(links)


def test_a_folder_is_refused(links):
    (links.parent / 'links_wind.npz').unlink()
    (links.parent / 'links_wind.npz').mkdir()
    assert refused(links).endswith('wind_field links_wind.npz: cannot be read: Is a directory')


def test_the_digest_of_the_land_is_of_numbers_not_of_how_they_are_held():
    course = load_course('links')
    heights = course.ground[1].heights
    listed = course.ground[1]._replace(heights=[list(map(float, row)) for row in heights])
    assert land_digest(course._replace(ground=(course.ground[0], listed))) == land_digest(course)
