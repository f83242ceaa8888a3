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

"""Draw a recorded play: from the side, from above, over time, and in numbers. Needs no ROS."""

import argparse
from collections.abc import Callable, Sequence
import sys
from typing import TYPE_CHECKING

from .closed_pipe import in_pipes
from ..course import CourseError, load_course
from ..optional_packages import how_to_get
from ..physics import Course
from ..recording.bag import BagError, read_bag, Recording
from ..recording.replay import course_of

if TYPE_CHECKING:
    from ..drawing.shots import DrawnShot

NEEDED = f'plot_play needs matplotlib: {how_to_get("plot", "matplotlib")}'


class NoPicture(RuntimeError):
    """There is nothing to draw, and one line says why."""


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Draw the play of a bag; return the exit code."""
    options = parser().parse_args(args)
    try:
        from ..drawing import draw, recorded
    except ImportError as error:
        return failed(f'{NEEDED} ({error})')
    try:
        play, shots = chosen(read_bag(options.bag), options, recorded)
        draw(options.output, shots, course_under(play, options.course), options.title, options.dpi)
    except (BagError, CourseError, NoPicture, OSError, ValueError) as error:
        return failed(error)
    print(f'{options.output}: {len(shots)} shot{"s" * (len(shots) > 1)}')
    return 0


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='plot_play', description=__doc__)
    reader.add_argument('bag', help='folder of a rosbag2 bag, or one of its files, .mcap or .db3')
    reader.add_argument(
        '-o',
        '--output',
        default='play.png',
        metavar='FILE',
        help='picture to write: .png, .svg or .pdf (%(default)s)',
    )
    reader.add_argument(
        '--shots', type=int, nargs='+', metavar='N', help='only these, by their numbers'
    )
    reader.add_argument('--namespace', help='sim to draw, where the bag holds several')
    reader.add_argument(
        '--course', help='name or path of the course, where the bag does not say or it moved'
    )
    reader.add_argument('--title', default='', help="instead of the course's name")
    reader.add_argument(
        '--dpi',
        type=dots,
        default=150,
        help='pixels an inch; the picture is 12 inches wide (%(default)s)',
    )
    return reader


def dots(text: str) -> int:
    """Pixels an inch, from the command line."""
    if not 20 <= int(text) <= 1200:
        raise argparse.ArgumentTypeError(f'{text} is not 20 to 1200')
    return int(text)


def chosen(
    plays: Sequence[Recording],
    options: argparse.Namespace,
    recorded: Callable[[Recording], list['DrawnShot']],
) -> tuple[Recording, list['DrawnShot']]:
    """Find the first of the recorded `plays` that has shots to be drawn, and these."""
    if options.namespace is not None:
        plays = [
            play for play in plays if play.namespace.strip('/') == options.namespace.strip('/')
        ]
    found = [(play, wanted(recorded(play), options.shots)) for play in plays]
    found = [(play, shots) for play, shots in found if shots]
    if not found:
        raise NoPicture(f'{options.bag}: no such shot was recorded with its path and end')
    if len(found) > 1:
        others = ', '.join(
            f'{play.namespace or "/"}: {len(shots)} shots' for play, shots in found[1:]
        )
        note(f'{found[0][0].namespace or "/"} is drawn; the bag also holds {others}')
    return found[0]


def wanted(shots: list['DrawnShot'], numbers: Sequence[int] | None) -> list['DrawnShot']:
    """Those of `shots` with one of `numbers`; all, if there are no numbers."""
    return [shot for shot in shots if not numbers or shot.result.shot in numbers]


def course_under(play: Recording, name: str | None) -> Course | None:
    """Course that was played on, or None where the bag does not say."""
    if play.config is None:
        if name is None:
            note('the bag does not say on which course this was played; --course does')
        return load_course(name) if name else None
    course = course_of(play.config, name)
    if course.digest != play.config['course']['digest']:
        note(f'{course.path} has changed since the play')
    return course


def note(text: str) -> None:
    """Print a line about something that the picture does not show."""
    print(f'plot_play: {text}', file=sys.stderr)


def failed(reason: object) -> int:
    """Say in one line why there is no picture; return the exit code."""
    note(' '.join(str(reason).split()))
    return 1


if __name__ == '__main__':
    sys.exit(main())
