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

"""Errors of the presets over many random shots, against what they promise."""

from collections.abc import Callable
from functools import lru_cache, partial
from math import pi
from typing import NamedTuple

import numpy as np

from .methods import TRUTH
from .scenes import EFFECTS, level
from ..physics import ACCURACY, Course, Material, Preset, simulate_many

SHOTS = 20_000


class PromiseRow(NamedTuple):
    """A preset over many shots: errors [m] of the first touch, and the worst of the rest."""

    accuracy: str
    shots: int
    touch_median: float
    touch_worst: float
    rest_worst: float


def jobs(material: Material, count: int = SHOTS) -> list[Callable[[], PromiseRow]]:
    """Make a function for each row; `count` shots end on level ground of a `material`."""
    ends = lru_cache(partial(played, level(material), count))
    return [partial(kept, ends, name) for name in ACCURACY]


def random_shots(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Draw velocities [m/s] and spins [rad/s], (n, 3).

    5 to 90 m/s, 2 to 60 degrees high, spin to 1000 rad/s about any axis.
    """
    random = np.random.default_rng(seed)
    speed, up = random.uniform(5, 90, count), random.uniform(2, 60, count) * pi / 180
    axes = random.normal(size=(count, 3))
    spins = axes * (random.uniform(0, 1000, count) / np.linalg.norm(axes, axis=1))[:, np.newaxis]
    return np.transpose([speed * np.cos(up), np.zeros(count), speed * np.sin(up)]), spins


def played(course: Course, count: int, accuracy: str | Preset) -> tuple[np.ndarray, np.ndarray]:
    """Play the random shots.

    Returns first touches (n, 2), along the launch and across, and rests (n, 3) [m].
    """
    told = simulate_many(course, *random_shots(count), effects=EFFECTS, accuracy=accuracy)
    side = told['carry_side']
    return np.transpose([np.sqrt(told['carry'] ** 2 - side**2), side]), told['position']


def kept(ends: Callable[[str | Preset], tuple[np.ndarray, np.ndarray]], name: str) -> PromiseRow:
    """`PromiseRow` of a preset; ``ends(accuracy)`` gives what `played` does."""
    touch, rest = (
        np.linalg.norm(mine - true, axis=1) for mine, true in zip(ends(name), ends(TRUTH))
    )
    return PromiseRow(name, len(touch), float(np.median(touch)), touch.max(), rest.max())
