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

"""Whether the error depends on the tick rate, and what ticks cost."""

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from .measure import Stage, ticked
from .methods import made, TRUTH
from .scenes import Scene
from ..physics import ACCURACY

RATES = (10.0, 50.0, 250.0, 1000.0, 4000.0)  # Hz
STEPPED = 'semi-implicit Euler, a step a tick'


class TickRow(NamedTuple):
    """A scene played tick by tick, at `rate` [Hz] and `accuracy`.

    Errors [m] of first touch and rest; ``time`` [s] that a simulated second takes, from Python;
    not a number for a step a tick, which is only there to compare.
    """

    scene: str
    accuracy: str
    rate: float
    touch_error: float
    rest_error: float
    time: float


def jobs(scenes: Iterable[Scene]) -> Iterator[Callable[[], TickRow]]:
    """Yield a function for each row."""
    for scene in scenes:
        for rate in RATES:
            for name in ACCURACY:
                yield partial(by_ticks, scene, name, rate)
            yield partial(by_steps, scene, rate)


def by_ticks(scene: Scene, accuracy: str, rate: float) -> TickRow:
    """`TickRow` of a preset."""
    found, time = ticked(scene, accuracy, rate)
    return TickRow(scene.name, accuracy, rate, *Stage(scene, TRUTH)().errors(found), time)


def by_steps(scene: Scene, rate: float) -> TickRow:
    """`TickRow` of an integrator whose step is the tick."""
    errors = Stage(scene, TRUTH)().errors(Stage(scene, made('euler', 1.0 / rate))())
    return TickRow(scene.name, STEPPED, rate, *errors, np.nan)
