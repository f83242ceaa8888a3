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

"""YAML files, read strictly.

No key twice, one line for every error, '1e-3' is a number, '1:30' is none.
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
import gc
from os import PathLike
import re
from typing import Any

import yaml

from .input_file import content
from .schema import CourseError, shown

MOST = 1_000_000  # values that a file may come to by saying the same again and again
# What a file can write after `!!`, or by itself, that Python then refuses; each in its own way.
REFUSALS = (ValueError, KeyError, AttributeError, IndexError, TypeError, OverflowError)
NUMBER = re.compile(r'[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)[eE][-+]?[0-9]+$')
# YAML 1.1 without its sexagesimals: 1:30 is a time of day, and no coordinate of 90.
INT = re.compile(r'[-+]?(0b[0-1_]+|0[0-7_]+|0|[1-9][0-9_]*|0x[0-9a-fA-F_]+)$')
FLOAT = re.compile(
    r'([-+]?[0-9][0-9_]*\.[0-9_]*([eE][-+][0-9]+)?|\.[0-9][0-9_]*([eE][-+][0-9]+)?'
    r'|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN))$'
)
REPLACED = {'tag:yaml.org,2002:int': INT, 'tag:yaml.org,2002:float': FLOAT}


BASE: Any = getattr(yaml, 'CSafeLoader', yaml.SafeLoader)


class Loader(BASE):
    """PyYAML's safe loader; YAML 1.1 wants a point in every float, people don't."""

    yaml_implicit_resolvers = {
        first: [(tag, REPLACED.get(tag, pattern)) for tag, pattern in found]
        for first, found in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }

    def construct_object(self, node: yaml.Node, deep: bool = False) -> Any:
        """Value of `node`; CourseError with its line where it has none."""
        try:
            return super().construct_object(node, deep)
        except REFUSALS as error:
            if isinstance(error, CourseError):
                raise
            reason = f': {_one_line(error)}' if isinstance(error, ValueError) else ''
            kind = node.tag.rpartition(':')[2]
            raise CourseError(
                f'line {node.start_mark.line + 1}: is not valid YAML: {shown(_written(node))} '
                f'is no {kind}{reason}'
            ) from None


Loader.add_implicit_resolver('tag:yaml.org,2002:float', NUMBER, list('-+.0123456789'))


def read_yaml(path: str | PathLike[str]) -> tuple[bytes, Any]:
    """Bytes and content of the YAML file at `path`.

    Raises
    ------
    CourseError
        There is no such file, or it is no valid YAML.
    """
    try:
        raw = content(path)
        return raw, parsed(raw)
    except yaml.YAMLError as error:
        raise CourseError(f'{path}: {_explained(error)}') from None
    except RecursionError:
        raise CourseError(f'{path}: is nested too deeply') from None
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None
    except ValueError as error:  # a character that YAML does not allow
        raise CourseError(f'{path}: is not valid YAML: {_one_line(error)}') from None


def parsed(raw: bytes) -> Any:
    """Content of a YAML document; None where it is empty."""
    loader = Loader(raw)
    try:
        root = loader.get_single_node()
        if root is None:
            return None
        _refuse_repeated_keys(root)
        _refuse_explosions(root)
        return loader.construct_document(root)
    finally:
        loader.dispose()


@contextmanager
def uncollected() -> Iterator[None]:
    """Work without garbage collection.

    It would go through all of a large file again and again.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def _children(node: yaml.Node) -> list[yaml.Node]:
    """Nodes directly below `node`."""
    if isinstance(node, yaml.MappingNode):
        return [child for pair in node.value for child in pair]
    return node.value if isinstance(node, yaml.SequenceNode) else []


def _refuse_repeated_keys(root: yaml.Node) -> None:
    """Raise where a mapping below the node `root` has a key twice.

    YAML would keep the last in silence.
    """
    left = [root]
    known: set[int] = set()
    while left:
        node = left.pop()
        if id(node) in known:
            continue
        known.add(id(node))
        if isinstance(node, yaml.MappingNode):
            _refuse_repeated(key for key, _ in node.value)
        left += _children(node)


def _refuse_repeated(keys: Iterable[yaml.Node]) -> None:
    lines: dict[Any, int] = {}
    for key in keys:
        if isinstance(key, yaml.ScalarNode):
            line = key.start_mark.line + 1
            if key.value in lines:
                raise CourseError(
                    f'line {line}: key {shown(key.value)} is already in line '
                    f'{lines[key.value]}; a key may appear once'
                )
            lines[key.value] = line


def _refuse_explosions(root: yaml.Node) -> None:
    """Raise where aliases make a small file huge, or endless.

    What they name is read wherever it is used.
    """
    sizes: dict[int, int] = {}
    left = [(root, False)]
    while left:
        node, done = left.pop()
        if done:
            sizes[id(node)] = 1 + sum(sizes[id(child)] for child in _children(node))
        elif id(node) not in sizes:
            sizes[id(node)] = MOST  # of what is not yet counted: of what is within itself
            left.append((node, True))
            left += [(child, False) for child in _children(node) if id(child) not in sizes]
    if sizes[id(root)] > max(MOST, 4 * len(sizes)):
        raise CourseError(
            f'is too large: its aliases make {len(sizes)} values {shown(sizes[id(root)])}'
        )


def _written(node: yaml.Node) -> str:
    """Text of `node` for a message."""
    return node.value if isinstance(node, yaml.ScalarNode) else '...'


def _explained(error: Exception) -> str:
    mark = getattr(error, 'problem_mark', None) or getattr(error, 'context_mark', None)
    where = f'line {mark.line + 1}: ' if mark else ''
    return f'{where}is not valid YAML: {_one_line(getattr(error, "problem", None) or error)}'


def _one_line(error: object) -> str:
    return ' '.join(str(error).split())
