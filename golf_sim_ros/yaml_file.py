# SPDX-License-Identifier: Apache-2.0
"""YAML files, read strictly: no key twice, one line for every error, '1e-3' is a number."""
import re

import yaml

from .checked import CourseError, shown


class Loader(getattr(yaml, 'CSafeLoader', yaml.SafeLoader)):
    """PyYAML's safe loader; YAML 1.1 wants a point in every float, people don't."""


Loader.add_implicit_resolver('tag:yaml.org,2002:float',
                             re.compile(r'[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)[eE][-+]?[0-9]+$'),
                             list('-+.0123456789'))


def read_yaml(path):
    """Bytes and content of the YAML file at `path`.

    Raises
    ------
    CourseError
        There is no such file, or it is no valid YAML.
    """
    try:
        raw = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, 'strerror', None) or error
        raise CourseError(f'{path}: cannot be read: {reason}') from None
    try:
        return raw, parsed(raw)
    except yaml.YAMLError as error:
        raise CourseError(f'{path}: {_explained(error)}') from None
    except RecursionError:
        raise CourseError(f'{path}: is nested too deeply') from None
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None
    except ValueError as error:  # a date or number that YAML recognises and Python refuses
        raise CourseError(f'{path}: is not valid YAML: {_one_line(error)}') from None


def parsed(raw):
    """Content of a YAML document; None where it is empty."""
    loader = Loader(raw)
    try:
        root = loader.get_single_node()
        if root is None:
            return None
        _refuse_repeated_keys(root)
        return loader.construct_document(root)
    finally:
        loader.dispose()


def _refuse_repeated_keys(root):
    """Raise where a mapping below the node `root` has a key twice: YAML would keep the last in silence."""
    left, known = [root], set()
    while left:
        node = left.pop()
        if id(node) in known:
            continue
        known.add(id(node))
        if isinstance(node, yaml.MappingNode):
            _refuse_repeated(key for key, _ in node.value)
            left += [child for pair in node.value for child in pair]
        elif isinstance(node, yaml.SequenceNode):
            left += node.value


def _refuse_repeated(keys):
    lines = {}
    for key in keys:
        if isinstance(key, yaml.ScalarNode):
            line = key.start_mark.line + 1
            if key.value in lines:
                raise CourseError(f'line {line}: key {shown(key.value)} is already in line '
                                  f'{lines[key.value]}; a key may appear once')
            lines[key.value] = line


def _explained(error):
    mark = getattr(error, 'problem_mark', None) or getattr(error, 'context_mark', None)
    where = f'line {mark.line + 1}: ' if mark else ''
    return f'{where}is not valid YAML: {_one_line(getattr(error, "problem", None) or error)}'


def _one_line(error):
    return ' '.join(str(error).split())
