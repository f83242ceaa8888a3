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

"""A course or a parameter that cannot be used ends the start with one line of what to do."""

from processes import parameters
import pytest

GROUND = '[{shape: plane, material: rough}]'
# What is in the file, and what the line must name: key, value, choices.
COURSES = {
    'unknown key': ('format: 1\nground: ' + GROUND + '\ntea: [0, 0]', ["'tea'", 'tee']),
    'wrong type': ('format: 1\ntee: far\nground: ' + GROUND, ['tee', "'far'", 'numbers']),
    'unknown material': (
        'format: 1\nground: [{shape: plane, material: gras}]',
        ['ground[0].material', "'gras'", 'fairway, firm_fairway, firm_green'],
    ),
    'no ground under the tee': (
        'format: 1\ntee: [9, 0]\nground: [{shape: patch, center: [0, 0, 0], length: 2, width: 2,'
        ' material: green}]',
        ['tee', '[9.0, 0.0]', 'ground'],
    ),
    'height map that is not there': (
        'format: 1\nground: [{shape: heightmap, heights: a.npy, spacing: 1, material: green}]',
        ['ground[0].heights', 'a.npy', 'No such file'],
    ),
    'not YAML': ('format: 1\nground: [', []),
    'missing key': ('ground: ' + GROUND, ["'format'"]),
}


def ended(start, *arguments):
    """Find the only line of a sim that ended with code 1, but for one that it has to compile."""
    process = start('sim_node', *arguments)
    assert process.wait() == 1, process.output
    (line,) = [line for line in process.lines if 'waiting for the physics' not in line]
    assert 'FATAL' in line
    return line


@pytest.mark.parametrize('case', COURSES)
def test_a_course_error_is_one_line_with_file_key_value_and_choices(start, tmp_path, case):
    content, needed = COURSES[case]
    file = tmp_path / 'links.yaml'
    file.write_text(content)
    line = ended(start, *parameters(course=file))
    assert all(part in line for part in [str(file), *needed]), line


def test_a_missing_course_file_is_one_line_with_its_path(start, tmp_path):
    file = tmp_path / 'none.yaml'
    assert str(file) in ended(start, *parameters(course=file))


def test_an_unknown_course_is_one_line_with_the_known_ones(start):
    line = ended(start, *parameters(course='st_andrews'))
    assert 'st_andrews' in line and 'golf_without_friends' in line


@pytest.mark.parametrize(
    'given, needed',
    [
        ({'accuracy': 'perfect'}, ['perfect', 'sketch', 'standard', 'reference']),
        ({'effects': "['drag', 'luck']"}, ['luck', 'magnus']),
        ({'balls': "['Ball']"}, ['Ball']),
        ({'balls': "['shot']"}, ['shot']),
        ({'balls': "['a', 'a']"}, ['different']),
        ({'rate': 20.0, 'publish_rate': 50.0}, ['publish_rate', '50', 'rate', '20']),
        ({'rate': 0.0}, ['rate']),
        ({'rate': 'fast'}, ['rate', 'fast']),
        ({'use_sim_time': 'true'}, ['use_sim_time']),
    ],
    ids=str,
)
def test_a_bad_parameter_is_one_line_that_names_it(start, given, needed):
    line = ended(start, *parameters(**given))
    assert all(part in line for part in needed), line
