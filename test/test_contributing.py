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
from golf_sim_ros.course.material_file import materials, shipped
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
laws = 'gravity', 'magnus', 'spin_decay', 'turf'
for drag in ('drag', 'range_ball'):
    print(simulate(course, drive, engine='python', effects=(drag, *laws)).result.carry)
foam = load_course('foam.yaml')
usual = foam._replace(ball=course.ball)
print(*(simulate(one, chip, engine='python').result.carry for one in (foam, usual)))
green = materials({'green': {'grain': 0.3}}, shipped()[0])['green']
for way in ((2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (-2.0, 0.0, 0.0)):
    putt = Shot(way, (0.0, 0.0, 0.0))
    print(simulate(Course(ground=(Plane(material=green),)), putt, engine='python').result.total)
"""


def files():
    """Contents, by path, of the blocks that CONTRIBUTING.md names a file for."""
    return dict(re.findall(r'`([\w/]+\.(?:py|yaml))`:\n\n```\w+\n(.*?)```', TEXT, re.DOTALL))


def block(begin):
    """Block of CONTRIBUTING.md without a file's name, one that begins with `begin`."""
    return re.search(rf'```\w+\n({re.escape(begin)}.*?)```', TEXT, re.DOTALL)[1]


def change(path, *pairs):
    """Replace texts that stand in a file once, each by another."""
    text = path.read_text(encoding='utf-8')
    for old, new in pairs:
        assert text.count(old) == 1, f'{path.name} has {old!r} {text.count(old)} times'
        text = text.replace(old, new)
    path.write_text(text, encoding='utf-8')


def add_grain(physics):
    """Give rolling a grain."""
    change(
        physics / 'properties' / 'material.py',
        ('roughness: float = 0.0', 'roughness: float = 0.0\n    grain: float = 0.0'),
        ('canopy_drag: float = 0.0', 'canopy_drag: float = 0.0\n    grain_heading: float = 0.0'),
        ("    'roughness': (", "    'grain': (0.0, 10.0),\n    'roughness': ("),
        ("    'canopy_drag': (", "    'grain_heading': (-360.0, 360.0),\n    'canopy_drag': ("),
    )
    law = block('    angle = ')
    change(
        physics / 'trajectory' / 'equations_of_motion.py',
        ('from ..effects import', 'from math import cos, radians, sin\nfrom ..effects import'),
        ('press: float, needed: float) -> float:', 'press, needed, way: Vector = ZERO) -> float:'),
        (
            "    return min(\n        material['rolling_resistance'] * press",
            law + "    return min(\n        material['rolling_resistance'] * against * press",
        ),
        (
            '<= rolling_deceleration(material, press, needed)',
            '<= rolling_deceleration(material, press, needed, downhill)',
        ),
        (
            '0.0 if micro_bouncing else rolling_deceleration(material, press, needed)',
            '0.0 if micro_bouncing else rolling_deceleration(material, press, needed, way)',
        ),
        (
            '    resistance = 0.0 if micro_bouncing',
            '    way = velocity if length(velocity) > LEAST_SPEED else free\n'
            '    resistance = 0.0 if micro_bouncing',
        ),
    )
    change(
        physics / 'engine' / 'planner.py',
        (
            '        if not is_in_still_air(land, ball, now):\n',
            block('        if not is_in_still_air'),
        ),
        (
            'import LEAST_SPEED, surface_at_start, turning_surface',
            'import LEAST_SPEED, material_under, surface_at_start, turning_surface',
        ),
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
    physics = copy / 'golf_sim_ros' / 'physics'
    line = re.search(r"^    'rough'.*$", TEXT, re.MULTILINE)[0]
    change(physics / 'scene' / 'presets.py', ('ACCURACY = {\n', f'ACCURACY = {{\n{line}\n'))
    add_grain(physics)
    course = 'format: 1\nground:\n  - {shape: plane, material: fairway}\n' + block('ball: ')
    (copy / 'foam.yaml').write_text(course, encoding='utf-8')
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
        'range_ball.py',
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


def test_a_range_ball_flies_as_far_as_told(told):
    assert told[4:6] == [[pytest.approx(254, abs=0.5)], [pytest.approx(234, abs=0.5)]]


def test_a_foam_ball_is_light(told):
    foam, usual = told[6]
    assert foam < 0.9 * usual


def test_grain_brakes_a_putt_as_told(told):
    assert [total for (total,) in told[7:]] == pytest.approx([2.11, 1.86, 1.68], abs=0.01)


def test_what_it_names_is_there():
    for path in set(re.findall(r'`((?:golf_sim_ros|test|tools|config|launch)/[\w/.]+)`', TEXT)):
        assert (ROOT / path).exists() or path in files(), path
