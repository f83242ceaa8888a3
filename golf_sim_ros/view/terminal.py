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

"""Holes in the terminal: what is asked, what is typed, the card."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from math import hypot
import os
import signal
import sys
from typing import Any

from . import caddie
from .caddie import launch, Stroke
from .demo import play_hole, until
from .game import Hole
from .session import Session
from .worker import Worker
from ..shot_input.clubs import club, CLUBS, PUTTER
from ..shot_input.units import UNITS

HELP = """\
CLUB [POWER] [AIM] [CURVE]   strike: 7i, 7i 80, 7i 80 -2, driver 100 0 20
  POWER  percent of the club's average; of the putter the ball's speed in m/s
  AIM    degrees from the hole, to the right
  CURVE  from -100, a hook, to 100, a slice
?                            what the caddie would play
q                            end
"""


class Lines:
    """Lines of standard input; several may come at once."""

    def __init__(self) -> None:
        self.waiting = b''

    async def read(self) -> str | None:
        """Read the next line; None where input ended."""
        more = b' '
        while more and b'\n' not in self.waiting:
            more = await read_some()
            self.waiting += more
        line, end, self.waiting = self.waiting.partition(b'\n')
        return (line + end).decode(errors='replace') or None


async def read_some() -> bytes:
    """Read what there is of standard input, as soon as there is any; nothing where it ended."""
    loop, ready = asyncio.get_running_loop(), asyncio.Event()
    with suppress(PermissionError, ValueError):  # a file, which need not be waited for
        loop.add_reader(sys.stdin, ready.set)
        try:
            await ready.wait()
        finally:
            loop.remove_reader(sys.stdin)
    return os.read(sys.stdin.fileno(), 4096)


def play(game: Any, options: Any) -> int:
    """Play in the terminal; return the exit code."""
    try:
        return asyncio.run(rounds(game, options))
    except (KeyboardInterrupt, asyncio.CancelledError):
        return 0
    finally:
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, signal.SIG_IGN)
        game.closing()
        game.close()


async def rounds(game: Any, options: Any) -> int:
    """Play all holes, until input ends, a signal comes or there is nothing left to play on."""
    loop, task = asyncio.get_running_loop(), asyncio.current_task()
    for number in (signal.SIGINT, signal.SIGTERM):
        if task is not None:
            loop.add_signal_handler(number, task.cancel)
    worker, lines = Worker(), Lines()
    forget = game.session.listen(tell_status(game))
    game.begin()
    playing = asyncio.create_task(holes(game, options, worker, lines))
    watching = asyncio.create_task(until(lambda: trouble(game)))
    try:
        await asyncio.wait((playing, watching), return_when=asyncio.FIRST_COMPLETED)
        if playing.done():
            return playing.result()
        playing.cancel()
        await asyncio.gather(playing, return_exceptions=True)
        failed(trouble(game))
        return 1
    finally:
        forget()
        for each in (playing, watching):
            each.cancel()
        await asyncio.gather(playing, watching, return_exceptions=True)
        await worker.ended()


async def holes(game: Any, options: Any, worker: Worker, lines: Lines) -> int:
    """Play all holes, or until input ends; return the exit code."""
    session = game.session
    while True:
        await until(session.can_strike)
        tee_off(session, options.units)
        if options.demo:
            await demonstrated(session, worker, game, options.units)
        elif not await typed(session, worker, game, options.units, lines):
            return 0
        print(card(session.round.hole), flush=True)
        if game.is_last:
            return 0
        await game.go_on()
        session.course = None


def failed(reason: str) -> None:
    """Print why nothing happens, on a line of its own."""
    print(f'play_hole: {reason}', file=sys.stderr, flush=True)


def tell_status(game: Any) -> Callable[[], None]:
    """Print, where another's sim is played, whenever it cannot be reached, is paused, is back."""
    told = ['']

    def tell() -> None:
        text = game.session.feed.status['text']
        if game.own is None and text != told[0] and not game.session.problem:
            told[0] = text
            failed(text or 'The sim is reached')

    return tell


def trouble(game: Any) -> str:
    """Why there is nothing to play; '' where there is, or may be soon."""
    return game.session.problem or (game.own.ending if game.own is not None else '')


def tee_off(session: Session, units: str) -> None:
    """Print the hole that begins."""
    hole, length = session.round.hole, UNITS[units].length
    way = way_to_hole(session) / length.size
    print(f'\n{hole.name}: par {hole.par}, {way:.0f} {length.name}', flush=True)


async def demonstrated(session: Session, worker: Worker, game: Any, units: str) -> None:
    """Let the caddie play, and print each stroke."""
    told = [0]

    def tell() -> None:
        lines = session.round.hole.lines
        first, told[0] = told[0], len(lines)
        for line in lines[first:]:
            print(described(line, units), flush=True)

    forget = session.listen(tell)
    try:
        await play_hole(session, worker, game.link.strike, 0.0)
    finally:
        forget()


async def typed(session: Session, worker: Worker, game: Any, units: str, lines: Lines) -> bool:
    """Strike as typed until the ball is in the hole; False where input ended."""
    print(HELP, end='')
    while not session.is_over:
        print(situation(session, units), end='', flush=True)
        try:
            line = await lines.read()
        except asyncio.CancelledError:
            print(flush=True)  # what is told next begins a line
            raise
        if line is None or line.strip() in ('q', 'quit', 'exit'):
            return False
        stroke = await understood(line, session, worker)
        if stroke is None:
            continue
        lie = session.lie
        if lie is None:
            continue
        velocity, spin = launch(lie.course.hole, lie.place, stroke)
        before = list(session.round.hole.lines)
        session.sent(stroke.club, velocity, spin)
        game.link.strike(velocity, spin)
        await until(lambda: session.can_strike() or session.is_over)
        played = [each for each in session.round.hole.lines if each not in before]
        for each in played:
            print(described(each, units), flush=True)
        if not played:
            print(unplayed(session.outcome), flush=True)
    return True


async def understood(line: str, session: Session, worker: Worker) -> Stroke | None:
    """Read a typed line as a stroke; None where it is none, after a line that says why."""
    words = line.split()
    if words == ['?']:
        answer = session.lie and await worker.ask('choose', session.lie)
        print(advice(Stroke(**answer)) if answer else 'no advice')
        return None
    if not words:
        return None
    try:
        return stroke_of(words, session)
    except ValueError as error:
        print(f'{error}; ? asks the caddie, q ends')
        return None


def stroke_of(words: list, session: Session) -> Stroke:
    """Read words as a stroke; ValueError where they are none."""
    name = club(words[0]).name
    if len(words) > 4:
        raise ValueError('CLUB, POWER, AIM and CURVE are all there is')
    numbers = [float(word) for word in words[1:]]
    power = numbers[0] if numbers else None
    aim, curve = [*numbers[1:], 0.0, 0.0][:2]
    if name == PUTTER:
        way = way_to_hole(session)
        return Stroke(name, caddie.putt_speed(way + 0.3) if power is None else power, aim)
    return Stroke(name, (100.0 if power is None else power) / 100, aim, curve / 100)


def way_to_hole(session: Session) -> float:
    """Distance from the ball to the hole [m]."""
    lie = session.lie
    if lie is None or lie.course.hole is None:
        return 0.0
    return hypot(lie.course.hole[0] - lie.place[0], lie.course.hole[1] - lie.place[1])


def advice(stroke: Stroke) -> str:
    """Write a stroke as it is typed."""
    power = stroke.power if stroke.club == PUTTER else 100 * stroke.power
    return f'{stroke.club} {power:.2f} {stroke.aim:.1f}'


def situation(session: Session, units: str) -> str:
    """Describe where the ball lies: stroke, way, wind, a club."""
    length, speed, lie = UNITS[units].length, UNITS[units].speed, session.lie
    way = way_to_hole(session)
    wind = hypot(*session.wind[:2])
    blows = f', wind {wind / speed.size:.1f} {speed.name}' if wind > 0.1 else ''
    putts = lie is not None and caddie.is_putt(lie.course, lie.place)
    likely = PUTTER if putts else caddie.likely_clubs(way)[0]
    carry = CLUBS[likely].carry
    reach = f' carries {carry / length.size:.0f}' if carry else ''
    number = session.round.hole.strokes + 1
    told = f'stroke {number}, {way / length.size:.1f} {length.name} to the hole{blows}'
    return f'{told} [{likely}{reach}]: '


def described(line: Any, units: str) -> str:
    """Describe a stroke that was played."""
    length, result = UNITS[units].length, line.result
    ends = {'holed': 'in the hole', 'water': 'in the water', 'out_of_bounds': 'out of bounds'}
    end = ends.get(result['status'], result['lie'].replace('_', ' '))
    penalty = f', {line.penalty} penalty stroke' if line.penalty else ''
    way = f'{result["total"] / length.size:.1f} {length.name}'
    return f'  {line.stroke}. {line.club or "shot"}: {way}, {end}{penalty}'


def unplayed(result: dict[str, Any] | None) -> str:
    """Describe why a strike was no stroke; its result is None where none came."""
    if result is None:
        return '  no result came: the strike was lost, or the sim is paused'
    return '  ' + ': '.join(filter(None, (result['status'], result.get('reason'))))


def card(hole: Hole) -> str:
    """Describe the score of a hole."""
    strokes = f'{hole.strokes} stroke{"" if hole.strokes == 1 else "s"}'
    return f'{hole.name}: {strokes}, {hole.verdict()} (par {hole.par})'
