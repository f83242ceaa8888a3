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

"""The caddie plays by itself: stroke after stroke, hole after hole."""

import asyncio
from typing import Any, Callable

from .caddie import launch, Stroke
from .session import Session
from .worker import Worker

LOOK = 0.1  # s from one look at the session to the next
MOMENT = 1.5  # s from a ball at rest to the next stroke
ADMIRE = 6.0  # s that a card is shown
MOST = 30  # strokes after which a hole is given up


async def demonstrate(
    session: Session, worker: Worker, game: Any, is_watched: Callable = lambda: True
) -> None:
    """Play round after round, while somebody looks."""
    while True:
        while not is_watched():
            await asyncio.sleep(LOOK)
        await play_hole(session, worker, game.link.strike, MOMENT)
        played = session.round.holes[-1:]
        await asyncio.sleep(ADMIRE)
        if session.round.holes[-1:] == played:  # nobody has gone on meanwhile
            await game.go_on()


async def play_hole(session: Session, worker: Worker, strike: Callable, moment: float) -> None:
    """Play a hole to its end."""
    await until(lambda: session.can_strike())
    while not session.is_over and session.round.hole.strokes < MOST:
        await asyncio.sleep(moment)
        lie = session.lie
        answer = lie and await worker.ask('choose', lie)
        if lie is None or answer is None or not session.can_strike():
            await until(session.can_strike)
            continue
        stroke = Stroke(**answer)
        velocity, spin = launch(lie.course.hole, lie.place, stroke)
        session.sent(stroke.club, velocity, spin)
        strike(velocity, spin)
        await until(lambda: session.can_strike() or session.is_over)


async def until(condition: Callable) -> None:
    """Wait until a condition holds."""
    while not condition():
        await asyncio.sleep(LOOK)
