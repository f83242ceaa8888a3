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

"""Play holes in a browser, or in the terminal: club, power, aim, curve, and strike."""

import argparse
import asyncio
import sys
from typing import Optional

from .closed_pipe import in_pipes
from .view_play import add_page, failed_with, linked, NoView, place_of, ready
from ..course import CourseError, load_course
from ..optional_packages import how_to_get
from ..view.game import Hole
from ..view.own_sim import keep_to_ourselves, own_namespace, OwnSim
from ..view.session import Session

DEFAULT = 'links'
WIND = 3.0  # m/s


@in_pipes
def main(args: Optional[list] = None) -> int:
    """Play until a signal ends it, or the demonstration is over; return the exit code."""
    options = parser().parse_args(args)
    try:
        check(options)
        return (in_terminal if options.terminal else in_browser)(options)
    except ModuleNotFoundError as error:
        if (error.name or 'nicegui').partition('.')[0] not in ('nicegui', 'fastapi'):
            raise
        return failed(
            f'the page needs NiceGUI: {how_to_get("view", "nicegui")}; --terminal needs none'
        )
    except (CourseError, NoView, OSError, RuntimeError, ValueError) as error:
        return failed(error)


failed = failed_with('play_hole')


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='play_hole', description=__doc__)
    reader.add_argument(
        'courses',
        nargs='*',
        metavar='COURSE',
        help=f'names or paths of courses, each a hole, one after the other ({DEFAULT})',
    )
    reader.add_argument('--terminal', action='store_true', help='play in the terminal')
    reader.add_argument('--demo', action='store_true', help='let the caddie play')
    reader.add_argument(
        '--wind',
        type=float,
        default=WIND,
        metavar='SPEED',
        help='mean wind of an own sim [m/s]; 0: calm (%(default)s)',
    )
    reader.add_argument(
        '--real-time-factor',
        type=float,
        default=1.0,
        metavar='X',
        help='how fast time passes in an own sim (%(default)s)',
    )
    add_page(reader)
    return reader


def check(options: argparse.Namespace) -> None:
    """Check what the arguments name; CourseError or NoView where it cannot be played."""
    if options.namespace is not None:
        if options.courses:
            raise NoView('--namespace joins a sim, which has its own course: name none')
        return
    options.courses = options.courses or [options.course or DEFAULT]
    for name in options.courses:
        if load_course(name).hole is None:
            raise NoView(f'{name} has no hole to play')


class Game:
    """A round: the session, and the sim that is one's own or that was joined."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options, self.session = options, Session(is_game=True)
        self.number = 0
        self.left: Optional[Hole] = None  # the hole after which another one was begun
        self.own = None
        if options.namespace is None:
            keep_to_ourselves()
        link_to = linked()
        namespace = options.namespace
        if namespace is None:
            namespace = own_namespace()
            factor = f'real_time_factor:={options.real_time_factor}'
            self.own = OwnSim(namespace, [factor], options.wind)
        course = options.course if options.namespace is not None else None
        self.link = link_to(self.session, namespace, True, course)

    def begin(self) -> None:
        """Begin with the first hole."""
        self.link.connect()
        if self.own:
            self.own.start(self.options.courses[0])

    async def go_on(self) -> None:
        """Begin the next hole, or all holes anew after the last one; once, whoever asks."""
        if not self.own:
            self.link.reset()
            return
        holes = self.session.round.holes
        if not holes or holes[-1] is self.left:
            return
        self.left = holes[-1]
        self.number += 1
        if self.number % len(self.options.courses) == 0:
            holes.clear()
        course = self.options.courses[self.number % len(self.options.courses)]
        await asyncio.to_thread(self.own.start, course)

    @property
    def is_last(self) -> bool:
        """Whether no further hole follows."""
        return not self.own or self.number + 1 >= len(self.options.courses)

    def closing(self) -> None:
        """Tell all to end."""
        self.session.feed.close()
        if self.own:
            self.own.interrupt()

    def close(self) -> None:
        """End all."""
        if self.own:
            self.own.stop()
        self.link.close()


def in_browser(options: argparse.Namespace) -> int:
    """Serve the page; return the exit code."""
    from ..view import page, server
    from ..view.demo import demonstrate, until
    from ..view.worker import Worker

    place, game, worker = place_of(options), Game(options), Worker()
    session = game.session
    server.serve_feed(session.feed)
    server.show(
        '/', lambda: page.PlayPage(session, worker, game.link.strike, game.go_on, options.units)
    )
    server.at_start(game.begin)
    tasks = []

    async def watch(own: OwnSim) -> None:
        await until(lambda: own.ending)
        session.on_ending(own.ending)
        failed(session.problem)

    if game.own:
        watching = watch(game.own)
        server.at_start(lambda: tasks.append(asyncio.create_task(watching)))
    if options.demo:
        demo = demonstrate(session, worker, game, lambda: bool(session.feed.clients))
        server.at_start(lambda: tasks.append(asyncio.create_task(demo)))

    def closing() -> None:
        worker.close()
        game.closing()
        for task in tasks:
            task.cancel()

    return server.run(place, 'golf_sim_ros', ready(place), closing, game.close)


def in_terminal(options: argparse.Namespace) -> int:
    """Play in the terminal; return the exit code."""
    from ..view.terminal import play

    return play(Game(options), options)


if __name__ == '__main__':
    sys.exit(main())
