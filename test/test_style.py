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

"""What every file of the project keeps to."""

import ast
from pathlib import Path
import re
import subprocess
import sys

import golf_sim_ros
import pytest

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ('golf_sim_ros', 'test', 'tools', 'launch', 'benchmarks', 'docs', 'examples')
SOURCES = [
    ROOT / 'setup.py',
    *(path for folder in FOLDERS for path in sorted((ROOT / folder).rglob('*.py'))),
]
EXECUTABLES = sorted((ROOT / 'scripts').iterdir())
PACKAGE = sorted((ROOT / 'golf_sim_ros').rglob('*.py'))
PHYSICS = ROOT / 'golf_sim_ros' / 'physics'
# What users call of the physics, its modules right in the folder, may take more parameters, by
# name.
OF_FEW_PARAMETERS = [path for path in SOURCES if path.parent != PHYSICS]
MOST_BRANCHES, MOST_PARAMETERS = 15, 6
# As ament_copyright reads it.
HEADER = """# Copyright 2026 golf_sim_ros maintainers
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

"""


def name(path):
    """How a test calls `path`."""
    return path.relative_to(ROOT).as_posix()


def test_flake8_finds_nothing():
    pytest.importorskip('flake8')
    check = subprocess.run(
        [sys.executable, '-m', 'flake8', *map(str, SOURCES + EXECUTABLES)],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert check.returncode == 0, check.stdout + check.stderr


def test_no_function_branches_often():
    pytest.importorskip('flake8')
    check = subprocess.run(
        [
            sys.executable,
            '-m',
            'flake8',
            '--select',
            'C901',
            '--max-complexity',
            str(MOST_BRANCHES),
            *map(str, SOURCES),
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert check.returncode == 0, check.stdout + check.stderr


@pytest.mark.parametrize('path', OF_FEW_PARAMETERS, ids=name)
def test_no_function_has_many_parameters(path):
    wrong = [
        f'{name(path)}:{node.lineno} {node.name}'
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8')))
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        and len(parameters(node)) > MOST_PARAMETERS
    ]
    assert not wrong


def parameters(node):
    """Parameters of a function but `self` and `cls`."""
    found = [arg.arg for arg in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)]
    return [arg for arg in found if arg not in ('self', 'cls')]


@pytest.mark.parametrize('path', SOURCES + EXECUTABLES, ids=name)
def test_a_file_starts_with_its_licence_and_says_what_it_is(path):
    text = path.read_text(encoding='utf-8')
    assert text.removeprefix('#!/usr/bin/env python3\n').startswith(HEADER)
    assert ast.get_docstring(ast.parse(text)), 'has no docstring'


@pytest.mark.parametrize('path', PACKAGE, ids=name)
def test_all_that_is_public_has_a_docstring_with_a_line_that_stands_alone(path):
    tree = ast.parse(path.read_text(encoding='utf-8'))
    wrong = [
        f'{name(path)}:{node.lineno} {title}'
        for title, node in public(tree)
        if not well_described(node)
    ]
    assert not wrong


def public(tree, inside=''):
    """Name and node of the public functions and classes of `tree`, and of their methods.

    Functions and classes are those of the module's level.
    """
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            if not node.name.startswith('_'):
                yield inside + node.name, node
                if isinstance(node, ast.ClassDef):
                    yield from public(node, inside=f'{node.name}.')


def well_described(node):
    """Whether the docstring of `node` is one line, or one and an empty line before the rest.

    A property may leave it out, and a callback named after what it waits for: their names say it.
    """
    docstring = ast.get_docstring(node)
    if docstring is None:
        return bool(node.decorator_list) or node.name.startswith('on_')
    lines = docstring.splitlines()
    return bool(lines[0].strip()) and (len(lines) == 1 or not lines[1].strip())


def test_the_licence_file_is_the_whole_apache_licence():
    text = (ROOT / 'LICENSE').read_text(encoding='utf-8')
    for part in (
        'Version 2.0, January 2004',
        '9. Accepting Warranty',
        'END OF TERMS AND CONDITIONS',
    ):
        assert part in text


def test_the_version_is_the_same_everywhere():
    manifest = (ROOT / 'package.xml').read_text(encoding='utf-8')
    setup = (ROOT / 'setup.py').read_text(encoding='utf-8')
    assert re.search(r'<version>(.*)</version>', manifest)[1] == golf_sim_ros.__version__
    assert re.search(r"version='(.*)'", setup)[1] == golf_sim_ros.__version__
