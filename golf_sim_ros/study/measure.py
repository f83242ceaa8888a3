# SPDX-License-Identifier: Apache-2.0
"""Measuring a method on a scene: how far off it is, and how long it takes."""
from math import hypot, sqrt
from time import perf_counter
from typing import NamedTuple

import numpy as np

from ..physics import simulate_many

BATCH_TIME = 0.02  # s: a batch of shots is at least this long
REPEATS = 5
MOST_SHOTS = 20000


class Row(NamedTuple):
    """One method on one scene.

    ``setting`` is the method's dial; errors [m] against the scene's reference, of the first touch and
    of the rest; ``time`` [s] of a whole shot, the median of several batches; ``compiled`` [s] that
    its machine code took to be made or loaded. Not a number where a method has no such figure.
    """

    scene: str
    method: str
    setting: str
    touch_error: float
    rest_error: float
    time: float
    compiled: float


class Truth(NamedTuple):
    """Where a shot touches first, along and across its launch, and where it rests [m].

    Not numbers where a method does not play as far.
    """

    touch: tuple
    rest: tuple

    def errors(self, other):
        """Distances of the first touch and of the rest of `other` from these."""
        return (hypot(*(a - b for a, b in zip(self.touch, other.touch))),
                hypot(*(a - b for a, b in zip(self.rest, other.rest))))


def played(scene, accuracy, count=1):
    """Result of `count` equal shots of a scene, as `Truth`, from the first of them."""
    shot = scene.shot
    told = simulate_many(scene.course, np.tile(shot.velocity, (count, 1)), np.tile(shot.spin, (count, 1)),
                         scene.wind, scene.effects, accuracy)[0]
    ahead = sqrt(max(told['carry'] ** 2 - told['carry_side'] ** 2, 0.0))
    return Truth((ahead, told['carry_side']), tuple(told['position']))


def timed(play):
    """Median time [s] of one more shot of ``play(count)``: what a call itself costs is taken off."""
    single = min(clocked(play, 1) for _ in range(REPEATS))
    count = 2
    while clocked(play, count) - single < BATCH_TIME and count < MOST_SHOTS:
        count *= 4
    times = [(clocked(play, count) - single) / (count - 1) for _ in range(REPEATS)]
    return float(np.median(times))


def clocked(play, count):
    """Time [s] of ``play(count)``."""
    began = perf_counter()
    play(count)
    return perf_counter() - began


def first(play):
    """What ``play()`` gives the first time, and the time [s] it takes, compiling included."""
    began = perf_counter()
    found = play()
    return found, perf_counter() - began


def measured(scene, truth, method):
    """`Row` of a `Method` on a scene."""
    found, compiled = first(lambda: method.play(scene, 1))
    touch, rest = truth.errors(found)
    time = timed(lambda count: method.play(scene, count))
    return Row(scene.name, method.name, method.setting, touch if scene.flies else np.nan,
               rest, time, compiled)
