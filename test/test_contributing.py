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

"""The examples of CONTRIBUTING.md, put into a copy of the package as it says, are played."""

import os
from pathlib import Path
import re
import shutil
import subprocess
import sys

import pytest

ROOT = Path(__file__).resolve().parents[1]
TEXT = (ROOT / 'CONTRIBUTING.md').read_text(encoding='utf-8')
PLAY = """
from golf_sim_ros.course import load_course
from golf_sim_ros.physics import (
    ACCURACY, METHODS, Course, Plane, Preset, Result, Shot, World, simulate)
from golf_sim_ros.physics.geometry.cone import Cone

drive = Shot((73.3, 0.0, 14.1), (0.0, -281.0, 0.0))
course = load_course('golf_without_friends')
carry = simulate(course, drive, engine='python').result.carry
wet = simulate(course, drive, engine='python', rain=(50.0,)).result.carry
world = World(course, engine='python')
world.strike('ball', *drive)
world.advance(3.0)
world.set_live('rain', (50.0,))
shower = next(event for event in world.advance(60.0) if isinstance(event, Result)).carry
print(carry - wet, carry - shower)
midpoint = Preset(METHODS['midpoint'].record(0.02), ACCURACY['standard'].limits)
off = [abs(simulate(course, drive, engine='python', accuracy=preset).result.carry - carry)
       for preset in ('rough', midpoint)]
print(*off)
chip = Shot((9.0, 0.0, 6.0), (0.0, -100.0, 0.0))
print(simulate(load_course('yard'), chip, engine='python').result.status)
clay = load_course('yard').ground[0].material
ground = Plane(material=clay), Cone((3.0, 0.0, 0.0), 1.0, 0.2, clay)
world = World(Course(ground=ground), engine='python')
world.strike('ball', (3.5, 0.05, 0.0), (0.0, 0.0, 0.0))
heights = []
while world.moving:
    world.advance(0.02)
    heights.append(world['ball'].position[2])
print(max(heights), heights[-1])
"""


def files():
    """Contents, by path, of the blocks that CONTRIBUTING.md names a file for."""
    return dict(re.findall(r'`([\w/]+\.(?:py|yaml))`:\n\n```\w+\n(.*?)```', TEXT, re.DOTALL))


def insert(path, after, line):
    """Add a line after the one that begins with `after`."""
    text = path.read_text(encoding='utf-8')
    assert re.search(f'^{re.escape(after)}', text, re.MULTILINE), f'{path.name} has no {after!r}'
    path.write_text(
        re.sub(
            f'^({re.escape(after)}.*)$',
            lambda found: f'{found[1]}\n{line}',
            text,
            count=1,
            flags=re.MULTILINE,
        ),
        encoding='utf-8',
    )


@pytest.fixture(scope='module')
def told(tmp_path_factory):
    """Run `PLAY` in a copy with the examples: what it prints."""
    copy = tmp_path_factory.mktemp('checkout')
    for folder in ('golf_sim_ros', 'config'):
        shutil.copytree(ROOT / folder, copy / folder, ignore=shutil.ignore_patterns('__pycache__'))
    shutil.copy(ROOT / 'package.xml', copy)
    for path, content in files().items():
        (copy / path).write_text(content, encoding='utf-8')
    scene = copy / 'golf_sim_ros' / 'physics' / 'scene'
    insert(
        scene / 'presets.py', 'ACCURACY = {', re.search(r"^    'rough'.*$", TEXT, re.MULTILINE)[0]
    )
    run = subprocess.run(
        [sys.executable, '-c', PLAY],
        cwd=copy,
        capture_output=True,
        text=True,
        env={**os.environ, 'PYTHONPATH': str(copy)},
    )
    assert run.returncode == 0, run.stderr
    return [
        [word if word.isalpha() else float(word) for word in line.split()]
        for line in run.stdout.splitlines()
    ]


def test_it_has_an_example_of_each():
    assert {path.rpartition('/')[2] for path in files()} == {
        'rain.py',
        'cone.py',
        'midpoint.py',
        'clay.yaml',
        'yard.yaml',
    }


def test_rain_brakes_a_drive(told):
    throughout, later = told[0]
    assert throughout == pytest.approx(5.8, abs=0.1) and 0.5 < later < throughout - 0.5


def test_the_preset_and_the_integrator_are_as_exact_as_told(told):
    rough, midpoint = told[1]
    assert rough < 5.0 and midpoint < 2e-3


def test_the_putt_in_the_yard_is_holed(told):
    assert told[2] == ['holed']


def test_a_ball_rolls_over_the_cone(told):
    highest, end = told[3]
    assert 0.1 < highest < 0.25 and end == pytest.approx(0.021335, abs=1e-5)


def test_what_it_names_is_there():
    for path in set(re.findall(r'`((?:golf_sim_ros|test|tools|config|launch)/[\w/.]+)`', TEXT)):
        assert (ROOT / path).exists() or path in files(), path
