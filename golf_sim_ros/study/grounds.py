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

"""Cost over error by kind of ground: the same strikes on a plane, patches, height maps, a mesh."""

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np

from .measure import clocked
from .methods import dial, TRUTH
from .scenes import as_heights, club_shot, hills, level, lofted, of_material
from ..course import load_course
from ..physics import ACCURACY, Course, Material, Preset, simulate_many

STRIKES = {
    'drive': club_shot('driver'),
    'chip': lofted(12.0, 30.0, 0.0),
    'putt': lofted(4.0, 0.0, 0.0),
}
SPREAD = 0.05  # of speed, and of direction in radians
TOLERANCES = (1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10)  # m
TRIANGLES = 20_000
WIDTHS = {'drive': 700.0}  # m: of the hills, where the narrow ones are too small
PLANE = 'plane'
FEW, SHOTS = 100, 500
ROUNDS = 5
CALLS = 15
PERCENTILES = 50, 99, 100


class GroundRow(NamedTuple):
    """A strike on a kind of ground at a preset or a tolerance [m], of many slightly different.

    Errors [m] of first touch and rest: median, 99th percentile, worst; not a number where the ball
    does not fly. ``shots``: how many of them the reference brought to an end. ``time`` [s] of a
    shot: that of many less that of few; ``call`` [s] for one shot and all that comes with it.
    """

    strike: str
    ground: str
    setting: str
    shots: int
    touch_median: float
    touch_most: float
    touch_worst: float
    rest_median: float
    rest_most: float
    rest_worst: float
    time: float
    call: float


def jobs(
    material: Material, counts: tuple[int, int] = (FEW, SHOTS)
) -> Iterator[Callable[[], GroundRow]]:
    """Yield a function for each row; plane and hills are of a `material`.

    `counts`: few and many shots, for the time of one.
    """
    for strike in STRIKES:
        volleys = {
            name: Volley(course, strike, counts[1]) for name, course in grounds(strike, material)
        }
        for setting, accuracy in settings():
            measure = lru_cache(partial(in_turns, volleys, setting, accuracy, counts))
            for name in volleys:
                yield partial(row_of, measure, name)


def grounds(strike: str, material: Material) -> Iterator[tuple[str, Course]]:
    """Yield name and `Course` of each kind of ground for a strike."""
    mesh = of_material(hills(TRIANGLES, WIDTHS.get(strike, 120.0)), material)
    yield PLANE, level(material)
    yield 'patches', load_course('golf_without_friends')
    yield 'height map', load_course('links')
    yield 'mesh of hills', mesh
    yield 'height map of hills', as_heights(mesh)


def settings() -> Iterator[tuple[str, str | Preset]]:
    """Yield name and accuracy of each setting."""
    yield from ((name, name) for name in ACCURACY)
    yield from ((f'tolerance {tolerance:.3g}', dial(tolerance)) for tolerance in TOLERANCES)


def spread(strike: str, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Draw velocities [m/s] and spins [rad/s], (n, 3), of strikes that are each a little other."""
    random = np.random.default_rng(1)
    shot = STRIKES[strike]
    speeds, angles = SPREAD * random.standard_normal((2, count))
    ahead = np.transpose([np.cos(angles), np.sin(angles), 0.0 * angles])
    across = np.transpose([-np.sin(angles), np.cos(angles), 0.0 * angles])
    velocities = (1.0 + speeds[:, None]) * shot.velocity[0] * ahead
    velocities[:, 2] = (1.0 + speeds) * shot.velocity[2]
    return velocities, shot.spin[1] * across


class Volley:
    """Strikes that are each a little different on a `course`."""

    def __init__(self, course: Course, strike: str, shots: int) -> None:
        self.course, self.strike = course, strike
        self.struck = spread(strike, shots)
        self.truth = lru_cache(partial(self.played, TRUTH, shots))

    def played(self, accuracy: str | Preset, count: int) -> np.ndarray:
        """Results of the first `count` strikes."""
        velocities, spins = self.struck
        return simulate_many(self.course, velocities[:count], spins[:count], accuracy=accuracy)

    def errors(self, accuracy: str | Preset) -> tuple[np.ndarray, np.ndarray]:
        """Errors (n,) [m] of first touch and rest; without shots that the truth has not ended."""
        true = self.truth()
        ended = true['status'] != 'failed'
        touch, rest = (
            np.linalg.norm(mine - other, axis=1)[ended]
            for mine, other in zip(ends(self.played(accuracy, len(true))), ends(true))
        )
        flies = STRIKES[self.strike].velocity[2] > 0.0
        return touch if flies else np.full(len(touch), np.nan), rest


def ends(told: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First touches (n, 2), along the launch and across, and rests (n, 3) [m], of results."""
    side = told['carry_side']
    along = np.sqrt(np.maximum(told['carry'] ** 2 - side**2, 0.0))
    return np.transpose([along, side]), told['position']


def in_turns(
    volleys: dict[str, Volley], setting: str, accuracy: str | Preset, counts: tuple[int, int]
) -> dict[str, GroundRow]:
    """`GroundRow` of each of the `volleys` at an accuracy, by ground; they are timed in turns.

    `counts`: few and many shots, for the slope.
    """
    few, many = counts
    errors = [volley.errors(accuracy) for volley in volleys.values()]
    plays = [partial(volley.played, accuracy) for volley in volleys.values()]
    rounds = [[clocked(play, many) - clocked(play, few) for play in plays] for _ in range(ROUNDS)]
    calls = [[clocked(play, 1) for play in plays] for _ in range(CALLS)]
    times, whole = np.median(rounds, axis=0) / (many - few), np.median(calls, axis=0)
    found = {}
    for (name, volley), both, time, call in zip(volleys.items(), errors, times, whole):
        shares = [float(np.percentile(some, share)) for some in both for share in PERCENTILES]
        count = len(both[0])
        found[name] = GroundRow._make(
            [volley.strike, name, setting, count, *shares, float(time), float(call)]
        )
    return found


def row_of(measure: Callable[[], dict[str, GroundRow]], ground: str) -> GroundRow:
    """`GroundRow` of a `ground` among those that ``measure()`` gives."""
    return measure()[ground]
