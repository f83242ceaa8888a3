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

"""Jobs of a study: one function for each row."""

from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache, partial
from typing import Any

from . import against_scipy, effects, grounds, promises, sizes, ticks, wind_fields
from .measure import measured, Row, Stage, Truth
from .methods import Method, methods, TRUTH
from .scenes import Game, quick_scenes, Scene, scenes

TICKED = ('iron into a green', 'bouncing on hard ground', 'mesh bounce')


def jobs(quick: bool) -> list[tuple[str, Callable[[], Any]]]:
    """Part and function of each row: a list of pairs, of the quick study or of the full one."""
    found: tuple[Scene | Game, ...] = quick_scenes() if quick else scenes()
    fairway = found[0].course.ground[0].material
    parts: dict[str, Iterable[Callable[[], Any]]] = {
        'methods': of_methods(found),
        'promises': promises.jobs(fairway),
    }
    if not quick:
        parts['grounds'] = grounds.jobs(fairway)
        flown = [one for one in found if isinstance(one, Scene) and one.flies]
        parts['scipy'] = against_scipy.jobs(flown)
        parts['effects'] = effects.jobs(found)
        ticked = [one for one in found if isinstance(one, Scene) and one.name in TICKED]
        parts['ticks'] = ticks.jobs(ticked)
        parts['sizes'] = sizes.jobs(found[1].course.ground[0].material)
        parts['wind'] = wind_fields.jobs()
    return [(part, job) for part, some in parts.items() for job in some]


def of_methods(found: Iterable[Scene | Game]) -> Iterator[Callable[[], Row]]:
    """Yield a function for each row of a method on a scene."""
    for scene in found:
        truth = lru_cache(Stage(scene, TRUTH))
        for method in methods(scene):
            yield partial(against, scene, truth, method)


def against(scene: Scene | Game, truth: Callable[[], Truth], method: Method) -> Row:
    """`Row` of a method, with what ``truth()`` finds as yardstick."""
    return measured(scene, truth(), method)
