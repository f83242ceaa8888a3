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

"""Compile the physics beforehand, once a machine or image.

The compiled engine then starts at once.
"""

import argparse
from collections.abc import Sequence
import sys
from typing import Any

from .closed_pipe import in_pipes
from ..course import load_course
from ..physics import World
from ..physics.jit import cache
from ..physics.jit.build import Build, READY

EPILOG = """One program serves every course with one ball, another every course with several; two
more those with a wind field (--course links). They are kept in a folder of their own for each
version of the physics; GOLF_SIM_ROS_CACHE names its parent. The exit code is 0 when all is
compiled, 1 when it cannot be, 2 for wrong arguments."""
PROGRAMS = {'one ball': ('ball',), 'several balls': ('red', 'blue')}
BAR = '{percentage:3.0f} % |{bar}| {remaining} left'
LOOK = 0.2  # s between two looks


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Compile what is not compiled; return the exit code."""
    options = parser().parse_args(args)
    try:
        course = load_course(options.course)
        worlds = [
            World(course, PROGRAMS[name], engine='python') for name in options.programs or PROGRAMS
        ]
        reason = compiled([world.part for world in worlds])
    except ValueError as error:  # of the course, or because two balls find no place on its tee
        reason = ' '.join(str(error).split())
    except KeyboardInterrupt:
        return 130
    if reason:
        print(f'compile_physics: {reason}', file=sys.stderr)
        return 1
    print(f'kept in {cache.folder().path}')
    return 0


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='compile_physics', description=__doc__, epilog=EPILOG)
    reader.add_argument(
        '--course',
        default='golf_without_friends',
        help='one with a wind field, or with effects of its own, needs programs of its own',
    )
    reader.add_argument(
        '--only',
        dest='programs',
        action='append',
        choices=list(PROGRAMS),
        help='one of the programs; all if not given',
    )
    return reader


def compiled(parts: Sequence[Any]) -> str:
    """Compile the programs of `parts`, with a bar; return why that could not be, or ''."""
    build = Build(True, *parts)
    with bar() as shown:
        while not build.wait(LOOK):
            shown.update(round(100 * build.progress) - shown.n)
        if build.state == READY:
            shown.update(100 - shown.n)
    return '' if build.state == READY else build.reason


def bar() -> Any:
    """Make a progress bar of a hundred percent; without tqdm it is a `NoBar`."""
    try:
        from tqdm import tqdm
    except ImportError:
        return NoBar()
    return tqdm(total=100, unit='%', bar_format=BAR)


class NoBar:
    """Shows nothing, in place of the bar of tqdm."""

    n = 100

    def __enter__(self) -> 'NoBar':
        """Begin nothing."""
        return self

    def __exit__(self, *error: object) -> None:
        """End nothing."""

    def update(self, step: int) -> None:
        """Show nothing."""


if __name__ == '__main__':
    sys.exit(main())
