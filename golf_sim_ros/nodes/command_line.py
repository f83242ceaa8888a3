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

"""What is typed after the name of a node.

Help, mistakes that ROS would pass over, params files.
"""

from collections.abc import Iterator, Sequence
import os
import re
import shlex
import stat
import sys
from typing import Any, NamedTuple

from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.logging import get_logger, LoggingSeverity, set_logger_level
from rclpy.utilities import remove_ros_args
import yaml

from .. import __version__

# Exit codes.
WRONG_ARGUMENTS = 2
UNUSABLE = 1
HELP, VERSION = ('-h', '--help'), '--version'
PARAM, REMAP, FILE = ('-p', '--param'), ('-r', '--remap'), '--params-file'
TAKES_ONE = {*PARAM, *REMAP, FILE, '--log-level', '-e', '--enclave', '--log-config-file'}
ASSIGN, SECTION = ':=', 'ros__parameters'
# Files of launch_ros: what a launch file gives to a single node, under /**.
OF_LAUNCH = 'launch_params_'
UNKNOWN = rclpy_implementation.UnknownROSArgsError
# Of no use to who typed it.
IN_RCL = re.compile(r', at [^\s,]+:\d+|^Failed to parse ROS arguments: ')


class Program(NamedTuple):
    """What the command line of a node has to know of it."""

    name: str  # of the executable
    does: str  # in one line
    parameters: dict[str, tuple[Any, str]]  # name: (default, meaning)
    example: str  # NAME:=VALUE


def answered(program: Program, words: Sequence[str] | None = None) -> int | None:
    """Print one line or the help, where `words` leave nothing to run, and return the exit code.

    None where there is something to run. `words` are the arguments of the process, `sys.argv[1:]`
    if not given.
    """
    words = sys.argv[1:] if words is None else list(words)
    if not set(words).isdisjoint(HELP):
        print(help_of(program))
        return 0
    if VERSION in words:
        print(f'golf_sim_ros {__version__}')
        return 0
    wrong = misplaced(program, words)
    if wrong:
        print(f'{program.name}: {wrong}', file=sys.stderr)
        return WRONG_ARGUMENTS
    code, line = objection(words)
    if line:
        get_logger('golf_sim_ros').fatal(line)
    return code or None


def help_of(program: Program) -> str:
    """Text of `--help`."""
    lines = [
        f'usage: {command(program)} [--ros-args [-p NAME:=VALUE] [--params-file FILE] ...]',
        '',
        program.does,
        '',
        'parameters, with their defaults:',
    ]
    for name, (default, meaning) in program.parameters.items():
        lines += [f'  {name:<17} {shown(default):<21} {meaning}']
    return '\n'.join(
        [
            *lines,
            '',
            f'example: {command(program)} --ros-args -p {program.example}',
            '--version tells the version; what may follow --ros-args is as with every ROS 2 node',
        ]
    )


def shown(default: Any) -> str:
    """Write a default as one types it."""
    if isinstance(default, bool):
        return str(default).lower()
    return f'[{", ".join(default)}]' if isinstance(default, tuple) else str(default)


def command(program: Program) -> str:
    """Give the command that starts the node."""
    return f'ros2 run golf_sim_ros {program.name}'


def split(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """Part `words` into those for ROS, without `--ros-args` and `--`, and the others."""
    ours: list[str] = []
    ros: list[str] = []
    into_ros = False
    for word in words:
        if word == '--ros-args' or (word == '--' and into_ros):
            into_ros = word == '--ros-args'
        else:
            (ros if into_ros else ours).append(word)
    return ros, [word for word in ours if word]


def pairs(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Pair the flags of `words` with what follows them; what has no flag follows ''.

    A flag that takes nothing is paired with ''.
    """
    left = iter(words)
    for word in left:
        if word in TAKES_ONE:
            yield word, next(left, '')
        else:
            yield ('', word) if not word.startswith('-') else (word, '')


def misplaced(program: Program, words: Sequence[str]) -> str:
    """Say which word is the first that has no effect where it stands, with the right command.

    One line, or '' where there is none. rcl takes a bare `NAME:=VALUE` for a remap rule, and
    leaves alone all other words before `--ros-args`.
    """
    ros, ours = split(words)
    right: list[str] = []
    wrong = ''
    for flag, word in pairs(ours):
        name = word.partition(ASSIGN)[0]
        is_rule = ASSIGN in word
        is_parameter = (
            is_rule and flag not in REMAP and (name in program.parameters or flag in PARAM)
        )
        if is_parameter:
            wrong = wrong or f'{word} sets no parameter without --ros-args'
            right += ['-p', word]
        elif is_rule and flag in ('', *REMAP):
            right += ['-r', word]
        elif flag in TAKES_ONE and word:
            wrong = wrong or f'{flag} does nothing without --ros-args'
            right += [flag, word]
        else:
            wrong = wrong or f'{flag or word} is no argument of this node; see --help'
    typed = shlex.join([*right, *ros] or ['-p', program.example])
    return wrong and f'{wrong}; right is: {command(program)} --ros-args {typed}'


def objection(words: Sequence[str]) -> tuple[int, str]:
    """Exit code and one line about what rcl could not use of `words`; 0 and '' without any."""
    for flag, rule in pairs(split(words)[0]):
        if (flag in PARAM and not all(rule.partition(ASSIGN))) or (not flag and ASSIGN in rule):
            return (
                WRONG_ARGUMENTS,
                f'{f"{flag} {rule}".strip()!r}: a parameter is given as -p NAME:=VALUE',
            )
    for path in params_files(words):
        reason = unreadable(path)
        if reason:
            return UNUSABLE, f'--params-file {path}: {reason}'
    # Of a pipe nothing would be left to rclpy.init.
    if all(os.path.isfile(path) for path in params_files(words)):
        return rcl_objection(words)
    return 0, ''


def unreadable(path: str) -> str:
    """Say why the file at `path` can't be read, or ''; it is not opened, as it may be a pipe."""
    try:
        mode = os.stat(path).st_mode
    except OSError as error:
        return error.strerror or str(error)
    if stat.S_ISDIR(mode):
        return 'is a folder'
    return '' if os.access(path, os.R_OK) else 'may not be read'


def rcl_objection(words: Sequence[str]) -> tuple[int, str]:
    """`objection` in the words of rcl.

    rcl parses the arguments twice here, so that it is one line.
    """
    set_logger_level('rcl', LoggingSeverity.FATAL)  # rcl would log half of it in a line before
    try:
        remove_ros_args(['', *words])
    except UNKNOWN as error:
        return WRONG_ARGUMENTS, f'no ROS argument: {error}'
    except RuntimeError as error:  # the base of all that rcl raises
        return UNUSABLE, explained(error)
    finally:
        set_logger_level('rcl', LoggingSeverity.UNSET)
    return 0, ''


def explained(error: object) -> str:
    """Put what rcl says on one line."""
    return IN_RCL.sub('', ' '.join(str(error).split()))


def params_files(words: Sequence[str]) -> list[str]:
    """Paths of the params files among `words`."""
    return [path for flag, path in pairs(split(words)[0]) if flag == FILE]


def only_for_all_nodes(words: Sequence[str], node: str) -> set[str]:
    """Names of parameters that params files give to all nodes.

    Without those that something in `words` gives to `node` itself.
    """
    rules = [rule for flag, rule in pairs(split(words)[0]) if flag in PARAM]
    own = {rule.partition(ASSIGN)[0].rpartition(':')[2] for rule in rules}
    shared: set[str] = set()
    for path in params_files(words):
        for section, names in sections(path):
            if section == node or os.path.basename(path).startswith(OF_LAUNCH):
                own |= names
            elif section in ('*', '**'):
                shared |= names
    return shared - own


def sections(path: str) -> list[tuple[str, set[str]]]:
    """Read the sections of a params file.

    Of each the last part of the name of the node, and the names of parameters.
    """
    if not os.path.isfile(path):  # a pipe, read already
        return []
    try:
        with open(path, encoding='utf-8') as file:
            return list(sections_of('', yaml.load(file, Loader=yaml.BaseLoader)))
    except (OSError, ValueError, yaml.YAMLError):
        return []  # rcl could read it: nothing to complain about here


def sections_of(name: str, content: Any) -> Iterator[tuple[str, set[str]]]:
    """`sections` of a part of the file; namespaces may hold nodes."""
    for key, inside in content.items() if isinstance(content, dict) else ():
        if key == SECTION:
            yield name.rpartition('/')[2], set(dotted(inside))
        else:
            yield from sections_of(key, inside)


def dotted(parameters: Any, before: str = '') -> Iterator[str]:
    """Names of parameters as ROS has them: those of an inner mapping follow a dot."""
    for name, value in parameters.items() if isinstance(parameters, dict) else ():
        if isinstance(value, dict):
            yield from dotted(value, f'{before}{name}.')
        else:
            yield f'{before}{name}'
