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

"""Cost of each effect in a scene, and how the shot ends without it."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import NamedTuple

from .measure import Stage, timed
from .scenes import Game, Scene

NEEDED = {'gravity'}  # without it nothing comes down


class EffectRow(NamedTuple):
    """A scene without one of its effects.

    ``touch_moved``, ``rest_moved`` [m]: how far first touch and rest then lie elsewhere, of
    several balls the farthest; ``saved``: percentage of the time of a shot that it saves, ``time``
    [s] being that with all.
    """

    scene: str
    effect: str
    touch_moved: float
    rest_moved: float
    saved: float
    time: float


def droppable(scene: Scene | Game) -> tuple[str, ...]:
    """Names of the effects that a scene can be played without."""
    return tuple(name for name in scene.effects if name not in NEEDED)


def without(scene: Scene | Game, effect: str) -> EffectRow:
    """`EffectRow` of a scene that is played at `standard` with and without an effect, in turns."""
    rest = tuple(name for name in scene.effects if name != effect)
    whole, less = Stage(scene, 'standard'), Stage(scene, 'standard', rest)
    touch, moved = whole().errors(less())
    time, shorter = timed(whole, less)
    return EffectRow(scene.name, effect, touch, moved, 100.0 * (1.0 - shorter / time), time)


def jobs(scenes: Iterable[Scene | Game]) -> Iterator[Callable[[], EffectRow]]:
    """Yield a function for each row.

    Of a `Game` only what no scene before it has: it would compile for minutes.
    """
    seen: set[str] = set()
    for scene in scenes:
        for effect in droppable(scene):
            if not isinstance(scene, Game) or effect not in seen:
                yield partial(without, scene, effect)
            seen.add(effect)
