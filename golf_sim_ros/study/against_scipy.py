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

"""Comparison with scipy, like with like: to the first touch, and over the same impacts."""

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache, partial
from math import inf
from typing import NamedTuple

import numpy as np

from .measure import clocked, REPEATS, Stage, timed
from .methods import dial, TRUTH
from .scenes import level, Scene
from .scipy_flight import flyer
from ..physics import Collision, Material, Preset, simulate

TOUCH, IMPACTS = 'first touch', 'last impact'
BOUNCING = ('bouncing on hard ground', 'chip and run')
TOLERANCES = tuple(10.0 ** (-0.5 * i) for i in range(27))  # m
RTOLS = tuple(10.0 ** (-0.5 * i) for i in range(2, 27))
OURS, THEIRS = 'dormand_prince', ('RK45', 'DOP853')
SLOWEST = 0.2  # m/s: the last impact is the last that is so fast
# What lands on it stops dead.
TRAP = Material('trap', dynamic_friction=100.0, rolling_resistance=1.0, ploughing=100.0)


class ScipyRow(NamedTuple):
    """A method on a scene up to the first touch, or over all impacts to the last.

    ``error`` [m] of the touch that is farthest off; ``time`` [s] of a play.
    """

    scene: str
    end: str
    method: str
    setting: str
    error: float
    time: float


def jobs(scenes: Iterable[Scene]) -> Iterator[Callable[[], ScipyRow]]:
    """Yield a function for each row, of scenes on level ground at height 0."""
    for scene in scenes:
        for end in (TOUCH, IMPACTS) if scene.name in BOUNCING else (TOUCH,):
            truth = lru_cache(partial(true_touches, scene, end))
            for tolerance in TOLERANCES:
                yield partial(ours, scene, end, truth, tolerance)
            for method in THEIRS:
                for rtol in RTOLS:
                    yield partial(theirs, scene, end, truth, method, rtol)


def trapped(scene: Scene) -> Scene:
    """`scene` on ground on which the shot ends where it lands."""
    return scene._replace(course=level(TRAP))


def touches(scene: Scene, accuracy: str | Preset) -> np.ndarray:
    """Places (n, 2) [m] of the impacts of a shot, as collisions tell them."""
    return np.array([collision.position[:2] for collision in collisions(scene, accuracy)])


def collisions(scene: Scene, accuracy: str | Preset) -> tuple[Collision, ...]:
    """Collisions of a shot; a few rows of its path are enough."""
    play = simulate(
        scene.course, scene.shot, scene.wind, scene.effects, accuracy, 1.0, engine='python'
    )
    return play.collisions


def true_touches(scene: Scene, end: str) -> np.ndarray:
    """Places (n, 2) [m] that the methods are held against: of the first touch, or of all."""
    found = collisions(scene, TRUTH)
    fast = [one.position[:2] for one in found if -one.velocity_before[2] >= SLOWEST]
    return np.array(fast[:1] if end == TOUCH else fast)


def farthest(found: np.ndarray, true: np.ndarray) -> float:
    """Distance [m] of the touch that is farthest from the true one; infinite if one is missing."""
    if len(found) < len(true):
        return inf
    return float(np.linalg.norm(found[: len(true)] - true, axis=1).max())


def ours(scene: Scene, end: str, truth: Callable[[], np.ndarray], tolerance: float) -> ScipyRow:
    """`ScipyRow` of this package.

    To the first touch on ground that ends the shot there; to the last impact, and on to the rest.
    """
    accuracy = dial(tolerance)
    played = trapped(scene) if end == TOUCH else scene
    error = farthest(touches(played, accuracy), truth())
    stage = Stage(played, accuracy)
    stage(1)
    (time,) = timed(stage)
    return ScipyRow(scene.name, end, OURS, f'tolerance {tolerance:.1e}', error, time)


def theirs(
    scene: Scene, end: str, truth: Callable[[], np.ndarray], method: str, rtol: float
) -> ScipyRow:
    """`ScipyRow` of scipy, started anew at each impact."""
    play, true = flyer(scene, method, rtol), truth()
    found = np.array([state[:2] for state in play(len(true))])
    time = float(np.median([clocked(play, len(true)) for _ in range(REPEATS)]))
    return ScipyRow(
        scene.name, end, f'scipy {method}', f'rtol {rtol:.1e}', farthest(found, true), time
    )
