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

"""What is imported is declared, for apt and for pip.

What apt has not is optional, and its lack reported.
"""

import ast
from pathlib import Path
import re
import runpy
import stat
import subprocess
import sys
from unittest.mock import patch
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = sorted((ROOT / 'golf_sim_ros').rglob('*.py'))
LAUNCH = sorted((ROOT / 'launch').rglob('*.py'))

# By the name it is imported by: the key of rosdep, the name for pip.
PYTHON = {
    'numpy': ('python3-numpy', 'numpy'),
    'yaml': ('python3-yaml', 'pyyaml'),
    'matplotlib': ('python3-matplotlib', 'matplotlib'),
    'scipy': ('python3-scipy', 'scipy'),
    'tqdm': ('python3-tqdm', 'tqdm'),
}
ROS = (
    'rclpy',
    'rcl_interfaces',
    'std_msgs',
    'std_srvs',
    'geometry_msgs',
    'visualization_msgs',
    'diagnostic_msgs',
    'rosgraph_msgs',
)
LAUNCHING = ('launch', 'launch_ros')  # no wheels
WITHOUT_WHEELS = ('tf2_msgs',)  # imported where it is installed
STARTED = ('rviz2',)  # by the launch file, not imported

# What apt has not: where it is imported, and only when it is needed; the extra of pip that brings
# it. llvmlite is numba's own compiler and comes with it.
BY_PIP = {
    'numba': ('fast', 'numba', ('golf_sim_ros/physics/jit/', 'golf_sim_ros/wind/compiled.py')),
    'llvmlite': ('fast', 'numba', ('golf_sim_ros/physics/jit/',)),
    'rosbags': (
        'bag',
        'rosbags',
        (
            'golf_sim_ros/recording/bag.py',
            'golf_sim_ros/recording/bag_file.py',
            'golf_sim_ros/recording/bag_writer.py',
        ),
    ),
    'trimesh': ('mesh', 'trimesh', ('golf_sim_ros/course/mesh_file.py',)),
    'rasterio': ('terrain', 'rasterio', ('golf_sim_ros/course/terrain_file.py',)),
    'nicegui': ('view', 'nicegui', ('golf_sim_ros/view/page.py', 'golf_sim_ros/view/server.py')),
    'fastapi': ('view', 'nicegui', ('golf_sim_ros/view/server.py',)),  # NiceGUI is made of it
}
# Modules that are imported only when what they need is asked for.
LATE = (
    'golf_sim_ros/physics/jit/',
    'golf_sim_ros/view/page.py',
    'golf_sim_ros/view/server.py',
    'golf_sim_ros/wind/compiled.py',
)
# Every apt key here is one of rosdep's, for apt, in rosdistro's python.yaml, with no exception for
# a release.
NO_APT_KEY = ('python3-numba', 'python3-rosbags-pip', 'python3-trimesh-pip')


def name(path):
    return path.relative_to(ROOT).as_posix()


def imports(path):
    """Top-level name of each import, and whether the file cannot be imported without it."""
    found = set()

    def look(node, hard):
        if isinstance(node, ast.Import):
            found.update((alias.name.partition('.')[0], hard) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.add((node.module.partition('.')[0], hard))
        forgiven = isinstance(node, ast.Try) and any(map(forgives, node.handlers))
        later = isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
        for child in ast.iter_child_nodes(node):
            look(child, hard and not forgiven and not later)

    look(ast.parse(path.read_text(encoding='utf-8')), True)
    return {
        (module, hard)
        for module, hard in found
        if module not in sys.stdlib_module_names and module != 'golf_sim_ros'
    }


def forgives(handler):
    """Whether an except clause takes an import that fails."""
    return handler.type is not None and 'ImportError' in ast.dump(handler.type)


def manifest(kind):
    """Keys that package.xml names in elements of that kind."""
    return [element.text for element in ElementTree.parse(ROOT / 'package.xml').iter(kind)]


@pytest.fixture(scope='module')
def setup():
    """Run setup.py: the arguments that setuptools gets."""
    with patch('setuptools.setup') as called, pytest.MonkeyPatch.context() as here:
        here.chdir(ROOT)
        runpy.run_path(str(ROOT / 'setup.py'))
    return called.call_args.kwargs


def names(requirements):
    return {re.match(r'[\w.-]+', requirement)[0] for requirement in requirements}


@pytest.mark.parametrize('path', PACKAGE, ids=name)
def test_what_a_module_imports_is_known_here(path):
    known = {*PYTHON, *ROS, *WITHOUT_WHEELS, *BY_PIP}
    assert not {module for module, _ in imports(path)} - known


@pytest.mark.parametrize('path', LAUNCH, ids=name)
def test_a_launch_file_imports_what_ros_brings(path):
    assert {module for module, _ in imports(path)} <= {*LAUNCHING, *ROS, 'yaml'}


def test_what_is_imported_is_in_the_manifest_and_nothing_else():
    used = {module for path in PACKAGE + LAUNCH for module, _ in imports(path)}
    wanted = {PYTHON[module][0] if module in PYTHON else module for module in used - BY_PIP.keys()}
    assert sorted(manifest('exec_depend')) == sorted({*wanted, *STARTED})


def test_what_is_imported_is_declared_for_pip(setup):
    used = {module for path in PACKAGE for module, _ in imports(path)}
    required = names(setup['install_requires'])
    extras = {extra: names(wanted) for extra, wanted in setup['extras_require'].items()}
    for module in used & PYTHON.keys():
        assert PYTHON[module][1] in required.union(*extras.values()), module
    for distro, extra in (('jazzy', 'ros'), ('kilted', 'ros-kilted')):
        wheels = {f'ros-{distro}-{module.replace("_", "-")}' for module in used & set(ROS)}
        assert extras[extra] == {*wheels, f'ros-{distro}-rmw-fastrtps-cpp'}


def test_pip_needs_no_more_than_the_simulator_does(setup):
    assert names(setup['install_requires']) == {'numpy', 'pyyaml'}


@pytest.mark.parametrize('module', sorted(BY_PIP))
def test_what_apt_has_not_is_imported_when_needed_and_only_where_it_is_told_how_to_get_it(
    module, setup
):
    extra, wanted, places = BY_PIP[module]
    importers = {
        name(path): hard for path in PACKAGE for found, hard in imports(path) if found == module
    }
    assert [place for place in importers if not place.startswith(places)] == []
    assert not any(hard and not place.startswith(LATE) for place, hard in importers.items())
    assert wanted in names(setup['extras_require'][extra])


@pytest.mark.parametrize('kind', ['depend', 'exec_depend', 'build_depend', 'test_depend'])
def test_the_manifest_asks_for_nothing_that_apt_has_not(kind):
    assert [key for key in manifest(kind) if key in NO_APT_KEY or key.endswith('-pip')] == []


@pytest.mark.parametrize(
    'module',
    [
        'nodes.sim_node',
        'nodes.wind_node',
        'cli.shoot',
        'cli.record_play',
        'cli.resimulate',
        'cli.plot_play',
        'cli.accuracy_study',
        'cli.view_play',
        'cli.play_hole',
        'cli.compare_shots',
        'bag',
        'course',
        'physics',
    ],
)
def test_with_numpy_and_yaml_alone_it_imports(module):
    missing = {*PYTHON, *BY_PIP} - {'numpy', 'yaml'}
    if module.startswith(('nodes', 'cli.shoot', 'cli.record')):
        pytest.importorskip('rclpy')
    run = without(missing, f'import golf_sim_ros.{module}')
    assert run.returncode == 0, run.stderr


def without(missing, source):
    """Run `source` by a Python where the modules `missing` are not installed."""
    code = f'import sys; sys.modules.update(dict.fromkeys({sorted(missing)!r})); {source}'
    return subprocess.run(
        [sys.executable, '-W', 'ignore', '-c', code], cwd=ROOT, capture_output=True, text=True
    )


@pytest.mark.parametrize(
    'missing, source, ways',
    [
        (
            'rosbags',
            'from golf_sim_ros.recording.bag import decoder; decoder("play")',
            ["pip install 'golf_sim_ros[bag]'"],
        ),
        (
            'rosbags',
            'from golf_sim_ros.recording.bag_writer import BagWriter; BagWriter("play", "mcap")',
            ["pip install 'golf_sim_ros[bag]'"],
        ),
        (
            'trimesh',
            'from golf_sim_ros.course.mesh_file import by_trimesh; by_trimesh(b"", "a.ply")',
            ["pip install 'golf_sim_ros[mesh]'"],
        ),
        (
            'matplotlib',
            'from golf_sim_ros.cli.plot_play import main; sys.exit(main(["play"]))',
            ['apt install python3-matplotlib', "pip install 'golf_sim_ros[plot]'"],
        ),
        (
            'nicegui',
            'from golf_sim_ros.cli.play_hole import main; sys.exit(main([]))',
            ["pip install 'golf_sim_ros[view]'", '--terminal'],
        ),
        *(
            (
                library,
                'from golf_sim_ros.cli.accuracy_study import main; sys.exit(main(["--quick"]))',
                [
                    'apt install python3-scipy python3-matplotlib python3-tqdm',
                    "pip install 'golf_sim_ros[study]'",
                ],
            )
            for library in ('matplotlib', 'scipy', 'tqdm')
        ),
    ],
)
def test_what_is_missing_is_told_with_the_ways_to_get_it(missing, source, ways, setup):
    run = without({'numba', missing}, source)
    told = run.stderr.strip().splitlines()[-1]
    assert run.returncode and missing in told and all(way in told for way in ways), run.stderr
    extra = re.search(r'golf_sim_ros\[(\w+)\]', told)[1]
    assert missing in names(setup['extras_require'][extra])


def test_each_executable_has_a_script_that_all_may_run_and_a_module(setup):
    targets = dict(entry.split(' = ') for entry in setup['entry_points']['console_scripts'])
    assert sorted(targets) == sorted(path.name for path in (ROOT / 'scripts').iterdir())
    for executable, target in targets.items():
        script = ROOT / 'scripts' / executable
        assert stat.S_IMODE(script.stat().st_mode) & 0o111 == 0o111
        assert f'from {target.partition(":")[0]} import main' in script.read_text(encoding='utf-8')
