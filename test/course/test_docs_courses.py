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

"""What docs/courses.md offers to copy works."""

from pathlib import Path
import re

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import ground_height, World

TEXT = (Path(__file__).parents[2] / 'docs' / 'courses.md').read_text(encoding='utf-8')
PLAIN = 'format: 1\ntee: [0, 0]\nground: [{shape: plane, material: rough}]\n'


def test_an_outline_in_utm_becomes_a_zone_with_a_bunker_left_out(tmp_path, capsys):
    (code,) = re.findall(r'```python\n(import yaml.*?)```', TEXT, re.DOTALL)
    exec(code, {})
    path = tmp_path / 'links.yaml'
    path.write_text(PLAIN + capsys.readouterr().out)
    course = load_course(path)
    assert [ground_height(course, *place)[1] for place in ((100, 0), (84, -4), (0, 0))] == [
        'fairway',
        'rough',
        'rough',
    ]


def test_the_slopes_on_which_a_ball_rests_are_those_told(tmp_path):
    told = re.search(r'That is (.*?)\. On a steeper one', TEXT, re.DOTALL)[1]
    pairs = re.findall(r'(\d+) %\s+on\s+`(\w+)`', told)
    assert len(pairs) == 9
    for percent, name in pairs:
        assert lies(tmp_path, name, float(percent) - 0.5) and not lies(
            tmp_path, name, float(percent) + 0.5
        )


def lies(folder, material, percent):
    """Whether a ball that is put down on a slope of so many percent lies still."""
    path = folder / 'links.yaml'
    path.write_text(
        'format: 1\ntee: [0, 0]\nground: [{shape: plane, '
        f'normal: [{-percent / 100}, 0, 1], material: {material}}}]\n'
    )
    world = World(load_course(path), engine='python')
    world.place('ball', (50.0, 0.0))
    return not world.moving
