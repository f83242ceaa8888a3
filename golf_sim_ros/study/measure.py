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

"""Measurement of a method on a scene: how far off it is, and how long it takes."""

from collections.abc import Callable, Sequence
from math import hypot, sqrt
from time import perf_counter, process_time
from typing import Any, NamedTuple

import numpy as np

from .scenes import Game, Scene
from ..physics import Preset, Result, simulate_many, World

Play = Callable[[int], Any]  # plays so many times, and gives the `Truth` of one

BATCH_TIME = 0.02  # s: a batch of shots is at least this long
REPEATS = 5
LONG_CALL = 1.0  # s: what takes so long is timed once
MOST_SHOTS = 20000
LONG = 300.0  # s: nothing moves for longer
NOWHERE = (np.nan, np.nan)


class Row(NamedTuple):
    """One method on one scene.

    ``setting`` is the method's step or tolerance; errors [m] against the scene's reference, of the
    first touch and of the rest; ``time`` [s] of a whole shot, the median of several batches;
    ``compiled`` [s] that its machine code took to be made or loaded. Not a number where a method
    has no such figure.
    """

    scene: str
    method: str
    setting: str
    touch_error: float
    rest_error: float
    time: float
    compiled: float


class Truth(NamedTuple):
    """First touch of a shot, along and across its launch, and rests of all balls, (n, 3) [m].

    Not numbers where a method does not play as far.
    """

    touch: tuple[float, float]
    rest: tuple[tuple[float, float, float], ...]

    def errors(self, other: 'Truth') -> tuple[float, float]:
        """Distances [m] of `other` from these.

        Of the first touch, and of the ball whose rest is farthest off.
        """
        return (
            hypot(*np.subtract(self.touch, other.touch)),
            float(np.linalg.norm(np.subtract(self.rest, other.rest), axis=1).max()),
        )


class Stage:
    """A scene ready to be played at an accuracy, with some effects.

    What is built for it is built once. ``stage(count)`` plays `count` times and gives the `Truth`
    of one. ``rewinding``: time [s] that it has taken to put balls back, which is none of a play's.
    """

    rewinding = 0.0

    def __init__(
        self, scene: Scene | Game, accuracy: str | Preset, effects: tuple[str, ...] | None = None
    ) -> None:
        self.scene = scene
        self.accuracy = accuracy
        self.effects = effects or scene.effects
        self.world = set_up(scene, accuracy, self.effects) if isinstance(scene, Game) else None
        self.start = self.world.state() if self.world else None

    def __call__(self, count: int = 1) -> Truth:
        """Play `count` times; return the `Truth` of one play."""
        world, scene = self.world, self.scene
        if isinstance(scene, Scene):
            return played(scene, self.accuracy, count, self.effects)
        assert world is not None and self.start is not None  # every `Game` has them
        for _ in range(count):
            began = process_time()
            world.restore(self.start)
            self.rewinding += process_time() - began
            for ball, velocity, spin in scene.strikes:
                world.strike(world.names[ball], velocity, spin)
                if not scene.together:
                    world.advance(LONG)
            world.advance(LONG)
        return Truth(NOWHERE, tuple(world[name].position for name in world.names))


def set_up(game: Game, accuracy: str | Preset, effects: tuple[str, ...]) -> World:
    """`World` of a `Game` before the first strike."""
    world = World(game.course, len(game.places), effects, accuracy, wind=game.wind)
    for name, place in zip(world.names, game.places):
        world.place(name, place)
    return world


def played(
    scene: Scene, accuracy: str | Preset, count: int = 1, effects: tuple[str, ...] | None = None
) -> Truth:
    """Play `count` equal shots of a `Scene`; return the `Truth` of the first."""
    shot = scene.shot
    told = simulate_many(
        scene.course,
        np.tile(shot.velocity, (count, 1)),
        np.tile(shot.spin, (count, 1)),
        scene.wind,
        effects or scene.effects,
        accuracy,
    )[0]
    return truth(told['carry'], told['carry_side'], told['position'])


def truth(carry: float, side: float, position: Sequence[float]) -> Truth:
    """`Truth` of the figures of one ball's result."""
    x, y, z = position
    return Truth((sqrt(max(carry * carry - side * side, 0.0)), side), ((x, y, z),))


def ticked(scene: Scene, accuracy: str | Preset, rate: float) -> tuple[Truth, float]:
    """Play a `Scene` in still air, tick by tick.

    Returns its `Truth`, and the time [s] that a simulated second takes.
    """
    world = World(scene.course, effects=scene.effects, accuracy=accuracy)
    start, fastest = world.state(), np.inf
    for _ in range(REPEATS):
        world.restore(start)
        world.strike(world.names[0], *scene.shot)
        ends: list[Result] = []
        ticks, began = 0, process_time()
        while not ends:
            ends = [event for event in world.advance(1.0 / rate) if isinstance(event, Result)]
            ticks += 1
        fastest = min(fastest, (process_time() - began) * rate / ticks)
    return truth(ends[0].carry, ends[0].carry_side, ends[0].position), fastest


def timed(*plays: Play) -> tuple[float, ...]:
    """Median times [s] of one more shot of each ``play(count)``, in turns.

    What a call costs is taken off.
    """
    singles = tuple(clocked(play, 1) for play in plays)
    if max(singles) > LONG_CALL:
        return singles
    counts = [enough(play) for play in plays]
    rounds = [
        [
            (clocked(play, count) - clocked(play, 1)) / (count - 1)
            for play, count in zip(plays, counts)
        ]
        for _ in range(REPEATS)
    ]
    return tuple(float(t) for t in np.median(rounds, axis=0))


def enough(play: Play) -> int:
    """Find how many shots take long enough to be timed.

    Also against a call for one, which is taken off.
    """
    single, count = fastest(play, 1), 2
    while fastest(play, count) - single < max(BATCH_TIME, 0.5 * single) and count < MOST_SHOTS:
        count *= 4
    return count


def fastest(play: Play, count: int) -> float:
    """Least time [s] of several calls."""
    return min(clocked(play, count) for _ in range(3))


def clocked(play: Play, count: int) -> float:
    """Time [s] that the process is busy with ``play(count)``, less that of rewinding a `Stage`."""
    began = process_time() - getattr(play, 'rewinding', 0.0)
    play(count)
    return process_time() - began - getattr(play, 'rewinding', 0.0)


def measured(scene: Scene | Game, truth: Truth, method: Any) -> Row:
    """`Row` of a `Method` on a scene."""
    began = perf_counter()
    play = method.ready(scene)
    found = play(1)
    compiled = perf_counter() - began
    touch, rest = truth.errors(found)
    (time,) = timed(play)
    return Row(
        scene.name,
        method.name,
        method.setting,
        touch if scene.flies else np.nan,
        rest,
        time,
        compiled,
    )
