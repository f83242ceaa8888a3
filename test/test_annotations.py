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

"""All that is public in the package has types, and tells a caller's checker so."""

import ast
from importlib.resources import files
from pathlib import Path

import golf_sim_ros
import pytest

PACKAGE = Path(golf_sim_ros.__file__).parent
MODULES = sorted(PACKAGE.rglob('*.py'))
FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
RECORDS = ('NamedTuple', 'TypedDict', 'Protocol')


def name(path):
    """How a test calls `path`."""
    return path.relative_to(PACKAGE).as_posix()


def public(tree, inside=''):
    """Name and node of the public functions, classes and methods of `tree`.

    Special methods, too: they are called from outside. Not functions within functions.
    """
    for node in tree.body:
        if isinstance(node, (*FUNCTIONS, ast.ClassDef)):
            if not node.name.startswith('_') or node.name.endswith('__'):
                yield inside + node.name, node
                if isinstance(node, ast.ClassDef):
                    yield from public(node, inside=f'{node.name}.')


def untyped(node, is_method):
    """List what of a function has no type: names of parameters, and 'return'."""
    given = node.args
    parameters = [*given.posonlyargs, *given.args]
    static = any(getattr(mark, 'id', '') == 'staticmethod' for mark in node.decorator_list)
    if is_method and not static:
        parameters = parameters[1:]  # self, or cls
    parameters += [*given.kwonlyargs, *filter(None, (given.vararg, given.kwarg))]
    found = [parameter.arg for parameter in parameters if parameter.annotation is None]
    return found + ['return'] * (node.returns is None)


def untyped_fields(node):
    """Names that a record gives a value and no type: they only look like fields."""
    bases = {ast.unparse(base).rpartition('.')[2] for base in node.bases}
    if bases.isdisjoint(RECORDS):
        return []
    return [
        target.id
        for statement in node.body
        if isinstance(statement, ast.Assign)
        for target in statement.targets
        if isinstance(target, ast.Name) and not target.id.startswith('_')
    ]


def faults(tree):
    """Lines about all that is public in `tree` and has no type."""
    for title, node in public(tree):
        missing = (
            untyped_fields(node)
            if isinstance(node, ast.ClassDef)
            else untyped(node, is_method='.' in title)
        )
        if missing:
            yield f'line {node.lineno}: {title}: {", ".join(missing)}'


@pytest.mark.parametrize('path', MODULES, ids=name)
def test_all_that_is_public_has_types(path):
    assert not list(faults(ast.parse(path.read_text(encoding='utf-8'))))


@pytest.mark.parametrize(
    ('source', 'missing'),
    [
        ('def f(a: int, *b, c=1, **d) -> int: ...', 'line 1: f: c, b, d'),
        ('def f(self) -> int: ...', 'line 1: f: self'),
        ('def f(): ...', 'line 1: f: return'),
        ('class A:\n    def __init__(self, a): ...', 'line 2: A.__init__: a, return'),
        ('class A:\n    @staticmethod\n    def f(a) -> int: ...', 'line 3: A.f: a'),
        ('class A:\n    @property\n    def f(self): ...', 'line 3: A.f: return'),
        ('class A(NamedTuple):\n    a: int\n    b = 1', 'line 1: A: b'),
    ],
)
def test_what_has_no_type_is_found(source, missing):
    assert list(faults(ast.parse(source))) == [missing]


def test_what_is_private_or_has_types_is_no_fault():
    source = (
        'def _f(a): ...\n'
        'def f(a: int, *, b: int = 1) -> None:\n'
        '    def inside(c): ...\n'
        'class A(NamedTuple):\n'
        '    a: int\n'
        '    @classmethod\n'
        '    def of(cls, b: int) -> "A": ...\n'
    )
    assert not list(faults(ast.parse(source)))


def test_the_package_says_that_it_has_types():
    assert (files('golf_sim_ros') / 'py.typed').is_file()
    setup = ast.parse((PACKAGE.parent / 'setup.py').read_text(encoding='utf-8'))
    (call,) = [node for node in ast.walk(setup) if getattr(node, 'arg', '') == 'package_data']
    assert 'py.typed' in ast.unparse(call.value)
