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

"""Sources of the kernels, as trees, for tests that read them."""

import ast
from pathlib import Path

import golf_sim_ros.physics

PHYSICS = Path(golf_sim_ros.physics.__file__).parent
# Not of the engine: what calls it, how it is compiled, and how a World is put together.
APART = ('world', 'jit')


def trees():
    """Path within the physics, and tree, of each module in a folder of kernels."""
    for path in sorted(PHYSICS.rglob('*.py')):
        place = path.relative_to(PHYSICS)
        if len(place.parts) > 1 and not place.parts[0].startswith(APART):
            yield place.as_posix(), ast.parse(path.read_text(encoding='utf-8'))


def functions(tree):
    """Functions of a tree, wherever in it."""
    return (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef))


def targets(node):
    """Targets of a node, if it is an assignment."""
    if isinstance(node, ast.Assign):
        found = node.targets
    elif isinstance(node, (ast.AugAssign, ast.AnnAssign)):
        found = [node.target]
    else:
        return
    for target in found:
        yield from target.elts if isinstance(target, ast.Tuple) else (target,)


def field_of(node):
    """Name of the record and of its field in an expression like ``ball['phase']``, or two None."""
    if (
        isinstance(node, ast.Subscript)
        and isinstance(node.slice, ast.Constant)
        and isinstance(node.slice.value, str)
    ):
        return ast.unparse(node.value), node.slice.value
    return None, None
