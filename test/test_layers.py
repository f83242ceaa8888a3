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

"""Imports point one way only, and the physics needs no ROS."""

import ast
from importlib import import_module
from importlib.util import find_spec
import os
from pathlib import Path
import re
import subprocess
import sys

import pytest

ROOT = Path(__file__).resolve().parents[1]
PHYSICS = sorted((ROOT / 'golf_sim_ros' / 'physics').rglob('*.py'))
ROS = (
    'rclpy',
    'rcl_interfaces',
    'std_msgs',
    'std_srvs',
    'geometry_msgs',
    'visualization_msgs',
    'diagnostic_msgs',
    'rosgraph_msgs',
    'builtin_interfaces',
    'ament_index_python',
    'launch',
    'launch_ros',
)


def test_the_contracts_of_import_linter_hold():
    pytest.importorskip('importlinter')
    code = 'from importlinter.cli import lint_imports_command; lint_imports_command()'
    check = subprocess.run(
        [sys.executable, '-c', code, '--no-cache'], cwd=ROOT, capture_output=True, text=True
    )
    assert check.returncode == 0, check.stdout + check.stderr
    assert '0 broken' in check.stdout


@pytest.mark.parametrize(
    'module, missing',
    [
        ('golf_sim_ros.physics', (*ROS, 'yaml', 'matplotlib', 'scipy')),
        ('golf_sim_ros.course', ROS),
        ('golf_sim_ros.wind', ROS),
        ('golf_sim_ros.bag', ROS),
        ('golf_sim_ros.cli.resimulate', (*ROS, 'rosbags')),
    ],
    ids=lambda value: value if isinstance(value, str) else '',
)
def test_what_is_not_a_node_imports_where_ros_is_not_installed(module, missing):
    code = f'import sys; sys.modules.update(dict.fromkeys({missing!r})); import {module}'
    run = subprocess.run([sys.executable, '-c', code], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_the_backend_alone_imports_numba():
    knowing = {path.parent.name for path in PHYSICS if {'numba', 'llvmlite'} & imported(path)}
    assert knowing == {'jit'}


def test_one_module_knows_the_private_parts_of_numba():
    private = re.compile(r'^\s*(?:from|import) numba(?:\.core|\._| import _)', re.MULTILINE)
    everywhere = (ROOT / 'golf_sim_ros').rglob('*.py')
    knowing = {path.name for path in everywhere if private.search(path.read_text('utf-8'))}
    assert knowing == {'internals.py'}


def test_the_physics_plays_a_shot_without_importing_numba():
    code = (
        'import sys; from golf_sim_ros.course import load_course; '
        'from golf_sim_ros.physics import Shot, simulate; '
        "simulate(load_course('links'), Shot((30.0, 0.0, 10.0))); sys.exit('numba' in sys.modules)"
    )
    environment = {**os.environ, 'GOLF_SIM_ROS_ENGINE': 'auto'}
    assert subprocess.run([sys.executable, '-c', code], cwd=ROOT, env=environment).returncode == 0


def imported(path):
    """Top-level names of the modules that the file at `path` imports, wherever in it."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition('.')[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            found.add(node.module.partition('.')[0])
    return found


# Names that every module of a kind has; and laws, which `surfaces` asks of the ground as a whole.
OF_EACH_KIND = {
    'record',
    'idle',
    'dormant',
    'INSTEAD_OF',
    'LIVE',
    'METHOD',
    'TABLE',
    'SHAPES',
    'NUMBERED',
    'build',
    'plan',
    'heights',
}
SAME_LAW = (
    {'geometry/surface_protocol.py', 'geometry/surfaces.py'},
    {'effects/protocol.py', 'effects/__init__.py'},
)


def test_no_name_in_the_physics_has_two_meanings():
    found = {}
    for path in PHYSICS:
        place = path.relative_to(ROOT / 'golf_sim_ros' / 'physics').as_posix()
        for name in defined(path) if not place.startswith('jit/') else ():
            found.setdefault(name, set()).add(place)
    twice = {
        name: places
        for name, places in found.items()
        if len(places) > 1
        and places not in SAME_LAW
        and not name.startswith('_')
        and name not in OF_EACH_KIND
    }
    assert not twice


def defined(path):
    """Module-level names that the file at `path` defines."""
    for node in ast.parse(path.read_text(encoding='utf-8')).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        for target in node.targets if isinstance(node, ast.Assign) else ():
            yield from (name.id for name in ast.walk(target) if isinstance(name, ast.Name))


SCRIPTS = [
    path
    for folder in ('benchmarks', 'tools', 'examples')
    for path in sorted((ROOT / folder).rglob('*.py'))
]


@pytest.mark.parametrize('path', SCRIPTS, ids=lambda path: path.name)
def test_what_a_script_imports_of_the_package_is_there(path):
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.ImportFrom) and (node.module or '').startswith('golf_sim_ros'):
            if node.module.startswith(
                ('golf_sim_ros.nodes', 'golf_sim_ros.sim_node', 'golf_sim_ros.cli')
            ):
                pytest.importorskip('rclpy')
            found = import_module(node.module)
            assert [
                alias.name
                for alias in node.names
                if not hasattr(found, alias.name) and not find_spec(f'{node.module}.{alias.name}')
            ] == []
