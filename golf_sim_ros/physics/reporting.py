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

"""Reporting: the engine's log as collisions and results, with names for its numbers."""

from typing import NamedTuple, Optional, Union

import numpy as np

from .result import Collision, COLLISION_KINDS, failure, Result, result
from .state.ball import FAILED, OUT, WATER
from .state.events import BALL_HIT, Log, LOST, SHOT_ENDS, WATER_HIT, WENT_OUT
from .state.serialize import plain_rows

Happening = Union[Collision, Result]  # what a world tells of


class Labels(NamedTuple):
    """Names of the `balls` and the `materials` by number, and where the `hole` is, or None."""

    balls: tuple[str, ...]
    materials: tuple[str, ...]
    hole: Optional[tuple[float, float]]


class Report(NamedTuple):
    """Logged events: each `Collision` and `Result` in order, what else follows from them.

    ``lost``: numbers of the balls that are to be dropped; ``failures``: why balls could not go on.
    """

    events: list[Happening]
    lost: list[int]
    failures: list[str]


def report(log: Log, balls: np.ndarray, labels: Labels, start: float) -> Report:
    """`Report` of the logged events, which empties the log.

    A failed shot no longer counts as a stroke. `start` is the world's time at the zero of the
    engine's clock.
    """
    events: list[Happening] = []
    lost: list[int] = []
    failures: list[str] = []
    for time, number, kind, other, sort, *vectors in plain_rows(log.events[: log.count[0]]):
        ball, name = balls[number], labels.balls[number]
        if kind == SHOT_ENDS:
            events.append(result(ball, name, start + time, labels.hole, labels.materials))
        elif kind != LOST:
            events.append(Collision(start + time, name, *hit(labels, kind, other, sort), *vectors))
        if kind == LOST or kind == SHOT_ENDS and ball['phase'] in (WATER, OUT, FAILED):
            lost.append(number)
        if kind in (LOST, SHOT_ENDS) and ball['phase'] == FAILED:
            ball['strokes'] -= kind == SHOT_ENDS  # the next one has the same number
            failures.append(f'{name}: {failure(ball)}')
    log.count[:] = 0
    return Report(events, lost, failures)


def hit(labels: Labels, kind: int, other: int, sort: int) -> tuple[str, str]:
    """Kind of a logged collision, and name of the material or ball that was hit."""
    if kind == BALL_HIT:
        return 'ball', labels.balls[other]
    if kind == WATER_HIT:
        return 'water', 'water'
    lie = labels.materials[other] if other >= 0 else ''
    return ('out_of_bounds' if kind == WENT_OUT else COLLISION_KINDS[sort]), lie


def aborted(balls: np.ndarray, labels: Labels, clock: float, time: float) -> list[Result]:
    """Abort each shot under way; their `Result`.

    It ends now: at `clock` for the engine, at the world's `time`.
    """
    under_way = [number for number, ball in enumerate(balls) if ball['shot_active']]
    balls['ended'][under_way] = clock
    return [
        result(balls[number], labels.balls[number], time, labels.hole, labels.materials)
        for number in under_way
    ]
