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

"""Wind fields of several accuracies and directions, against finer ones."""

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache, partial
from math import cos, pi, radians, sin
from time import process_time
from typing import NamedTuple

import numpy as np

from ..course.course_file import course_without_field
from ..physics import Course, simulate_many
from ..wind import WindField

COURSE = 'tall_pines'
LEVELS = ('mass', 'sketch', 'standard', 'reference')
DIRECTIONS = (4, 8, 16, 32)
TRIED = (0.35, 1.9, 3.3, 5.2)  # rad: between all those directions, some by half of the way
WIND = 8.0  # m/s at 10 m
HEIGHTS = (2.0, 10.0)  # m over the ground
PLACES, SEED = 4000, 0
# m/s, degrees, rad/s: a driver, a 7 iron, a pitching wedge, half a wedge
SHOTS = ((74.7, 10.9, 281.0), (53.6, 16.3, 742.0), (45.6, 24.2, 974.0), (28.0, 30.0, 700.0))


class WindRow(NamedTuple):
    """A field against a better one, at `TRIED` angles.

    ``low``, ``high``: rms of the difference at 2 and 10 m, over the wind; ``landing``,
    ``farthest`` [m]: how far apart shots come down, in the mean and at most; ``cells`` of its
    grid; ``time`` [s] of a core that a direction takes.
    """

    what: str
    low: float
    high: float
    landing: float
    farthest: float
    cells: int
    time: float


@lru_cache(maxsize=None)
def bare() -> Course:
    """Return the course without a field."""
    return course_without_field(COURSE)


@lru_cache(maxsize=None)
def solved(level: str, angles: tuple[float, ...]) -> tuple[WindField, int, float]:
    """Field at `angles`, number of cells, and the time [s] that a direction takes."""
    from ..wind import solving

    case = solving.case_of(bare(), solving.level_of(level))
    solving.solve_direction(case._replace(level=solving.level_of('mass')), angles[0])  # compiles
    began = process_time()
    found = {angle: solving.solve_direction(case, angle) for angle in angles}
    time = (process_time() - began) / len(angles)
    return solving.field_of(bare(), case, level, found), case.grid.cells, time


def jobs() -> Iterator[Callable[[], WindRow]]:
    """Yield a function for each row."""
    for level in LEVELS[:-1]:
        yield partial(of_level, level)
    for count in DIRECTIONS:
        yield partial(of_directions, count)


def of_level(level: str) -> WindRow:
    """`WindRow` of a level of accuracy, solved for at the very angles, against the reference."""
    fields = [solved(one, TRIED)[0] for one in (level, LEVELS[-1])]
    _, cells, time = solved(level, TRIED)
    return against(f'{level}, the very direction', fields, cells, time)


def of_directions(count: int) -> WindRow:
    """`WindRow` of so many directions at `standard`, against fields of the very angles."""
    even = tuple(2.0 * pi * n / count for n in range(count))
    field, cells, time = solved('standard', even)
    return against(
        f'standard, {count} directions', [field, solved('standard', TRIED)[0]], cells, time
    )


def against(what: str, fields: Sequence[WindField], cells: int, time: float) -> WindRow:
    """`WindRow` of the first of two `fields` against the second."""
    winds = [(WIND * cos(angle), WIND * sin(angle), 0.0) for angle in TRIED]
    low, high = (rms(fields, winds, height) for height in HEIGHTS)
    one, other = (landings(field, winds) for field in fields)
    off = np.linalg.norm(one - other, axis=-1)
    return WindRow(what, low, high, float(off.mean()), float(off.max()), cells, time)


def rms(fields: Sequence[WindField], winds: Sequence[tuple], height: float) -> float:
    """Root of the mean square of the difference of two fields at a `height`, over the wind."""
    x, y = fields[0].survey.x, fields[0].survey.y
    places = np.random.default_rng(SEED).uniform((x[0], y[0]), (x[-1], y[-1]), (PLACES, 2))
    places = np.column_stack([places, fields[0].survey.heights_at(*places.T) + height])
    squares = [
        ((fields[0].velocity(places, wind) - fields[1].velocity(places, wind)) ** 2).sum(1).mean()
        for wind in winds
    ]
    return float(np.sqrt(np.mean(squares))) / WIND


def landings(field: WindField, winds: Sequence[tuple]) -> np.ndarray:
    """Where `SHOTS` come down in each of the `winds`, (n, m, 2) [m]: carry and side."""
    course = bare()._replace(wind_field=field.atlas, obstacles=())
    speeds, angles, spins = np.array(SHOTS).T
    rise = np.array([radians(angle) for angle in angles])
    velocities = np.column_stack([speeds * np.cos(rise), 0.0 * speeds, speeds * np.sin(rise)])
    turning = np.column_stack([0.0 * spins, -spins, 0.0 * spins])
    told = [simulate_many(course, velocities, turning, wind) for wind in winds]
    return np.array([np.column_stack([one['carry'], one['carry_side']]) for one in told])
