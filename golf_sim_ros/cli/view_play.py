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

"""Look at a play in a browser: a sim's as it goes on, or a recorded one. Publishes nothing."""

import argparse
from pathlib import Path
import sys
from typing import Any, Callable, Optional

from .closed_pipe import in_pipes, say
from ..course import CourseError, load_course
from ..drawing.recorded_shots import recorded
from ..optional_packages import how_to_get
from ..recording.bag import BagError, read_bag
from ..recording.replay import course_of
from ..view.course_data import course_data, pack
from ..view.one_file import one_file
from ..view.play_data import play_data


class NoView(RuntimeError):
    """There is nothing to look at, and one line says why."""


@in_pipes
def main(args: Optional[list] = None) -> int:
    """Show a play until a signal ends it, or write it to a file; return the exit code."""
    reader = parser()
    options = reader.parse_args(args)
    if options.output and not options.bag:
        reader.error('-o needs a BAG: what is still played has no end')
    try:
        if not options.bag:
            return watched(options)
        course, play = chosen(options)
        if options.output:
            write(options, course, play)
            return 0
        return replayed(options, course, play)
    except ModuleNotFoundError as error:
        if (error.name or 'nicegui').partition('.')[0] not in ('nicegui', 'fastapi'):
            raise
        return failed(f'the page needs NiceGUI: {how_to_get("view", "nicegui")}')
    except (BagError, CourseError, NoView, OSError, RuntimeError, ValueError) as error:
        return failed(error)


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='view_play', description=__doc__)
    reader.add_argument(
        'bag', nargs='?', help='rosbag2 bag to look at: a folder, or one of its files; else a sim'
    )
    reader.add_argument(
        '-o',
        '--output',
        metavar='FILE',
        help='write one HTML file that shows the bag without network or server',
    )
    add_page(reader)
    return reader


def add_page(reader: argparse.ArgumentParser) -> None:
    """Add the options of every page."""
    reader.add_argument('--namespace', metavar='NS', help='namespace of the sim')
    reader.add_argument(
        '--course', help='name or path of the course, where it is not where the sim says'
    )
    reader.add_argument(
        '--units', choices=('golf', 'si'), default='golf', help='yards, or metres (%(default)s)'
    )
    reader.add_argument(
        '--port', type=port, default=0, help='port of the page (the first free from 8470 on)'
    )
    reader.add_argument(
        '--host',
        nargs='+',
        default=['127.0.0.1'],
        metavar=('ADDRESS', 'NAME'),
        help='address to listen on (127.0.0.1: nobody else can open the page), and names by which '
        'browsers call this machine',
    )


def port(text: str) -> int:
    """Parse the number of a port."""
    if not (text.isdecimal() and int(text) < 2**16):
        raise argparse.ArgumentTypeError(f'{text!r} is no port: 0 to 65535')
    return int(text)


def chosen(options: argparse.Namespace) -> tuple:
    """Course and bytes of the play that a bag holds."""
    plays = read_bag(options.bag)
    if options.namespace is not None:
        wanted = options.namespace.strip('/')
        plays = tuple(play for play in plays if play.namespace.strip('/') == wanted)
    found = [(play, recorded(play)) for play in plays]
    found = [(play, shots) for play, shots in found if shots]
    if not found:
        raise NoView(f'{options.bag}: no shot was recorded with its path and end')
    play, shots = found[0]
    if len(found) > 1:
        others = ', '.join(other.namespace or '/' for other, _ in found[1:])
        note(f'{play.namespace or "/"} is shown; the bag also holds {others}')
    if play.config is None and not options.course:
        raise NoView(f'{options.bag} does not say on which course this was; --course does')
    course = course_of(play.config, options.course) if play.config else load_course(options.course)
    return course, play_data(shots)


def write(options: argparse.Namespace, course: Any, play: bytes) -> None:
    """Write the file that shows the play."""
    html = one_file(pack(course), play, course.name, options.units)
    Path(options.output).write_text(html, encoding='utf-8')
    say(f'{options.output}: {len(html) / 1e6:.2f} MB; any browser opens it')


def replayed(options: argparse.Namespace, course: Any, play: bytes) -> int:
    """Serve a recorded play; return the exit code."""
    from ..view import page, server

    place = place_of(options)
    server.serve_replay(
        course_data(course),
        play,
        lambda one, other: page.replay_page(one, other, course.name, options.units),
    )
    return server.run(place, course.name, ready(place), nothing, nothing)


def watched(options: argparse.Namespace) -> int:
    """Serve the play of a sim; return the exit code."""
    from ..view import page, server
    from ..view.session import Session

    link_to = linked()
    place, session = place_of(options), Session()
    link = link_to(session, options.namespace, False, options.course)
    server.serve_feed(session.feed)
    server.show('/', lambda: page.watch_page(options.units))
    server.at_start(link.connect)
    return server.run(place, 'golf_sim_ros', ready(place), session.feed.close, link.close)


def linked() -> type:
    """`SimLink`, or `NoView` where there is no ROS 2."""
    from ..nodes.environment import complete_environment, unsafe

    complete_environment()
    if unsafe():
        raise NoView(unsafe())
    try:
        from ..view.sim_link import SimLink
    except ModuleNotFoundError as error:
        raise NoView(f'a sim is heard over ROS 2, and there is no {error.name}') from None
    return SimLink


def place_of(options: argparse.Namespace) -> Any:
    """`Place` of the page, with a port that is free."""
    from ..view import server

    address, *names = options.host
    port = options.port or server.free_port(address)
    return server.Place(address, port, tuple(names))


def ready(place: Any) -> Any:
    """Make what prints the page's URL when it can be opened."""

    def tell(url: str) -> None:
        say(f'{url}   (open it in a browser; Ctrl-C ends it)')
        if place.address not in ('127.0.0.1', 'localhost', '::1'):
            say(
                f'Listening on {place.address}: whoever reaches this machine there can open the '
                'page, unencrypted and without a password'
            )

    return tell


def nothing() -> None:
    """Do nothing."""


def note(text: str) -> None:
    """Print a line that does not belong to what was asked for."""
    print(f'view_play: {text}', file=sys.stderr)


def failed_with(program: str) -> Callable:
    """Make what says in one line why there is no page, and gives the exit code."""

    def failed(reason: object) -> int:
        print(f'{program}: {" ".join(str(reason).split())}', file=sys.stderr)
        return 1

    return failed


failed = failed_with('view_play')


if __name__ == '__main__':
    sys.exit(main())
