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

from .grounds import ends
from .methods import TRUTH
from .scenes import EFFECTS, level
from ..course import load_course
from ..physics import ACCURACY, Course, Material, Preset, simulate_many
from ..physics.effects import EffectNames

SHOTS = 20_000
RELIEF = 'links'  # course whose ground is a height map
MOST_SHOTS = 0.01  # on relief a promise is of all shots but one in a hundred

# Plays the random shots with a preset: first touches (n, 2) and rests (n, 3) [m].
Ends = Callable[[str | Preset], tuple[np.ndarray, np.ndarray]]


class PromiseRow(NamedTuple):
    """A preset over many shots on a ground: errors [m] of the first touch and of the rest.

    Their medians, what 99 of 100 shots are within, the worst; and how many are beyond the promise.
    """

    ground: str
    accuracy: str
    shots: int
    touch_median: float
    touch_most: float
    touch_worst: float
    touch_beyond: int
    rest_median: float
    rest_most: float
    rest_worst: float
    rest_beyond: int


def jobs(material: Material, count: int = SHOTS) -> list[Callable[[], PromiseRow]]:
    """Make a function for each row; `count` shots on level ground of a `material`, and on relief.

    CourseError where the course can't be read.
    """
    grounds: tuple[tuple[str, Course, EffectNames], ...] = (
        ('level', level(material), EFFECTS),
        (RELIEF, load_course(RELIEF), 'auto'),
    )
    plays = [
        (ground, lru_cache(partial(played, course, effects, count)))
        for ground, course, effects in grounds
    ]
    return [partial(kept, ground, play, name) for ground, play in plays for name in ACCURACY]


def random_shots(count: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Draw velocities [m/s] and spins [rad/s], (n, 3).

    5 to 90 m/s, 2 to 60 degrees high, spin to 1000 rad/s about any axis.
    """
    random = np.random.default_rng(seed)
    speed, up = random.uniform(5, 90, count), random.uniform(2, 60, count) * pi / 180
    axes = random.normal(size=(count, 3))
    spins = axes * (random.uniform(0, 1000, count) / np.linalg.norm(axes, axis=1))[:, np.newaxis]
    return np.transpose([speed * np.cos(up), np.zeros(count), speed * np.sin(up)]), spins


def played(
    course: Course, effects: EffectNames, count: int, accuracy: str | Preset
) -> tuple[np.ndarray, np.ndarray]:
    """Play the random shots.

    Returns first touches (n, 2), along the launch and across, and rests (n, 3) [m].
    """
    return ends(simulate_many(course, *random_shots(count), effects=effects, accuracy=accuracy))


def kept(ground: str, play: Ends, name: str) -> PromiseRow:
    """`PromiseRow` of a preset on a ground; ``play(accuracy)`` gives what `played` does."""
    preset = ACCURACY[name]
    touch, rest = (
        np.linalg.norm(mine - true, axis=1) for mine, true in zip(play(name), play(TRUTH))
    )
    return PromiseRow(
        ground, name, len(touch), *spread(touch, preset.touch), *spread(rest, preset.rest)
    )


def spread(errors: np.ndarray, promised: float) -> tuple[float, float, float, int]:
    """Median, 99 of 100 and worst of the errors [m], and how many are beyond what is promised."""
    median, most, worst = np.percentile(errors, [50.0, 100.0 * (1.0 - MOST_SHOTS), 100.0])
    return float(median), float(most), float(worst), int((errors > promised).sum())
