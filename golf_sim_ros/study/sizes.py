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

"""Growth of the time with balls, triangles and contacts."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

from .measure import Stage, timed
from .scenes import club_shot, EFFECTS, Game, hills, level, lofted
from ..physics import Ball, Course, Material, Plane, Restitution
from ..physics.mechanics.vector import ZERO

BALLS = (1, 3, 10, 30, 100, 300)
TRIANGLES = (200, 2_000, 20_000, 100_000)
CONTACTS = (1, 3, 10, 30, 60)
APART = 0.5  # m
AWAY = (0.0, -1000.0)  # m: where balls are until they are placed


class SizeRow(NamedTuple):
    """Time [s] of one play with `count` of `what`."""

    what: str
    count: int  # type: ignore[assignment]  # hides that of tuple, which a row has no use for
    time: float


def jobs(material: Material) -> Iterator[Callable[[], SizeRow]]:
    """Yield a function for each row; balls fly over a `material`."""
    yield from (partial(grown, 'balls', count, volley(count, material)) for count in BALLS)
    yield from (partial(grown, 'triangles', count, rolling(count)) for count in TRIANGLES)
    yield from (partial(grown, 'contacts', count, row(count)) for count in CONTACTS)


def grown(what: str, count: int, game: Game) -> SizeRow:
    """`SizeRow` of a `Game` at `standard`."""
    stage = Stage(game, 'standard')
    stage()
    (time,) = timed(stage)
    return SizeRow(what, count, time)


def volley(count: int, material: Material) -> Game:
    """Make a `Game`: as many 7 irons, hit at once from one long tee.

    They fly, bounce and roll side by side.
    """
    places = tuple((0.0, APART * i) for i in range(count))
    strikes = tuple((i, *club_shot('7i')) for i in range(count))
    return Game(
        'volley',
        level(material)._replace(tee=AWAY),
        places,
        strikes,
        (*EFFECTS, 'ball_ball'),
        together=True,
    )


def rolling(triangles: int) -> Game:
    """Make a `Game`: one ball that bounces and rolls over a mesh until it rests."""
    shot = lofted(10.0, 40.0, 0.0)
    return Game('mesh bounce', hills(triangles), ((0.0, 0.0),), ((0, *shot),), EFFECTS)


def row(contacts: int) -> Game:
    """Make a `Game`: a ball hits a row of so many that touch each other.

    All impacts are at one instant.
    """
    floor = Material('smooth', Restitution(0.0), 0.0, 0.5, 0.5, 0.5)
    course = Course((Plane(material=floor),), tee=AWAY, ball=Ball(restitution=0.9, friction=0.0))
    width = 2.0 * Ball().radius
    places = tuple((width * i, 0.0, 0.5 * width) for i in range(contacts))
    return Game(
        'row',
        course,
        (*places, (-0.1, 0.0, 0.5 * width)),
        ((contacts, (1.5, 0.0, 0.0), ZERO),),
        ('gravity', 'ball_ball'),
    )
