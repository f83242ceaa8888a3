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

"""Placement: where balls are teed, put down and dropped, and where they can't be."""

from functools import lru_cache
from math import atan2, cos, hypot, inf, isfinite, pi, sin
from typing import Callable, Hashable, Iterable, Iterator, NamedTuple, Optional, Sequence

import numpy as np

from .collision.ground_contact import RESTING_GAP
from .geometry import surfaces
from .geometry.solid import FLAGSTICK_RADIUS, without
from .kernel_types import BallRecord, Vector
from .mechanics.vector import ZERO
from .result import three
from .scene.course_record import Course
from .scene.kernel_model import Model
from .state.ball import FAILED, HOLED, LAUNCH, REST

APART = 0.5  # m between balls on the tee
BESIDE = 2.2  # radii from centre to centre, of a ball that is dropped beside another
FARTHEST = 1e6  # m: the same limit as in course files
FALL = 1e4  # m: how far down ground is searched
# Fields of a ball that is taken up from where it lay.
TAKEN_UP = 'shot_active', 'moved_by_ball', 'water', 'sleeps_on_ball', 'time_stepping'


class NoPlace(ValueError):
    """Place where a ball can't be put; the message says why."""


class Site(NamedTuple):
    """What balls are placed on: a course, its model for kernels, and an engine's `put_down`.

    That lowers balls onto the ground. ``is_shared``: balls touch each other, so no two are put at
    one place.
    """

    course: Course
    model: Model
    put_down: Callable[..., tuple[bool, float, bool]]
    is_shared: bool


def checked_start(
    position: Iterable[float], velocity: Optional[Iterable[float]], spin: Optional[Iterable[float]]
) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
    """Tuples of floats, each None as zeros.

    `NoPlace` where one is not finite or it is too far away.
    """
    position = tuple(map(float, position))
    velocity = ZERO if velocity is None else tuple(map(float, velocity))
    spin = ZERO if spin is None else tuple(map(float, spin))
    if not all(map(isfinite, (*position, *velocity, *spin))):
        raise NoPlace(f'position {position}, velocity {velocity} or spin {spin} is not finite')
    if max(map(abs, position)) > FARTHEST:
        raise NoPlace(f'position {position} is farther away than {FARTHEST:g} m')
    return position, velocity, spin


def tee_places(course: Course, count: int) -> list[tuple[float, float]]:
    """Places x, y of so many balls side by side at the tee."""
    x, y = course.tee[:2]
    apart = max(APART, BESIDE * course.ball.radius)
    return [(x, y + apart * (i - 0.5 * (count - 1))) for i in range(count)]


def unfit(tee: Sequence[float], names: Sequence[str], number: int, reason: object) -> str:
    """Reason why the ball of that number can't be teed up, alone or beside others."""
    if len(names) == 1:
        return f'tee {list(tee)} must be where a ball can lie: {reason}'
    return (
        f'balls {", ".join(names)} do not fit beside each other at the tee {list(tee)}: '
        f'{names[number]}: {reason}'
    )


def placed(site: Site, balls: np.ndarray, number: int, position: Sequence[float]) -> BallRecord:
    """Record of the ball of that number, put down at x, y or x, y, z.

    `NoPlace` where it is not free.
    """
    ball = put_down_once(Putting(site, balls[number].copy(), tuple(position))).copy()
    if not is_free(site, balls, number, three(ball['position'])):
        raise NoPlace(f'position {position} is taken by another ball')
    return ball


class Putting(NamedTuple):
    """What decides where a ball comes to lie: the `site`, its record before, its `position`.

    The ground is compared by identity, as it is built once a course: see `kernel_model.ground`.
    """

    site: Site
    ball: BallRecord
    position: tuple[float, ...]

    @property
    def key(self) -> tuple[Hashable, ...]:
        """What is equal where the outcome is."""
        site = self.site
        land, hole = site.model.land, (site.course.hole, site.course.flagstick)
        return id(land.ground), land.ball, hole, site.put_down, self.position, self.ball.tobytes()

    def __eq__(self, other: object) -> bool:
        """Whether the outcome is the same."""
        return isinstance(other, Putting) and self.key == other.key

    def __hash__(self) -> int:
        """Hash of the key."""
        return hash(self.key)


@lru_cache(maxsize=8)
def put_down_once(putting: Putting) -> BallRecord:
    """Record of a ball that is put down; kept, for every new world puts its balls on the tee."""
    ball = putting.ball.copy()
    put_ball_down(putting.site, ball, putting.position)
    return ball


def put_ball_down(site: Site, ball: BallRecord, position: Sequence[float]) -> None:
    """Put a `ball` record at x, y, z, or on the ground at x, y; `NoPlace` where it can't be."""
    land = site.model.land
    bare = site.model._replace(land=land._replace(ground=without(land.ground)))
    x, y, *exact = position
    if not exact:
        x, y = beside_flagstick(site, x, y)
    place = position if exact else lowered(site.put_down, bare, ball, (x, y))
    _, inside, wet = site.put_down(site.model, ball, place, 0.0)
    if inside > surfaces.SAME_HEIGHT:
        _, in_ground, _ = site.put_down(bare, ball, place, 0.0)
        what = 'the ground' if in_ground > surfaces.SAME_HEIGHT else 'an obstacle or the flagstick'
        raise NoPlace(f'position {position} lies {inside:.3g} m deep in {what}')
    if wet:
        raise NoPlace(f'position {position} lies in water')


def beside_flagstick(site: Site, x: float, y: float) -> tuple[float, float]:
    """x, y in the hole, moved to where a ball drops in beside the flagstick.

    Any other as they are.
    """
    ground, radius, hole = site.model.land.ground, site.model.land.ball.radius, site.course.hole
    if not hole or not site.course.flagstick:
        return x, y
    away = hypot(x - hole[0], y - hole[1])
    room = FLAGSTICK_RADIUS + radius + surfaces.SAME_HEIGHT
    if away >= room or room + radius > ground.hole[2]:
        return x, y
    towards = atan2(y - hole[1], x - hole[0])
    return hole[0] + room * cos(towards), hole[1] + room * sin(towards)


def lowered(
    put_down: Callable[..., tuple[bool, float, bool]],
    model: Model,
    ball: BallRecord,
    place: tuple[float, float],
) -> Vector:
    """Position of a `ball` record that is lowered onto the ground of `model` at x, y.

    Writes the ball.
    """
    x, y = place
    ground, radius = model.land.ground, model.land.ball.radius
    for room in (3 * radius, 30 * radius, 300 * radius):  # a steep plane is touched higher up
        top = max(surfaces.look_down(ground, x, y)[0], ground.highest) + room
        touches, inside, _ = put_down(
            model, ball, (x, y, top), min(top - ground.lowest + room, FALL)
        )
        if touches and inside <= surfaces.SAME_HEIGHT:
            return three(ball['position'])
    raise NoPlace(f'no ground at x {x:g}, y {y:g}')


def is_free(site: Site, balls: np.ndarray, number: int, place: Sequence[float]) -> bool:
    """Whether a ball at `place` overlaps no ball but that of `number`."""
    if not site.is_shared:
        return True
    others = np.delete(balls, number)
    others = others[others['phase'] != HOLED]
    apart = np.linalg.norm(others['position'] - place, axis=1)
    return not (apart < 2.0 * site.model.land.ball.radius - surfaces.SAME_HEIGHT).any()


def lay(site: Site, balls: np.ndarray, number: int, ball: BallRecord, now: float) -> None:
    """Lay the ball of that number where `placed` has put its record, from `now` on; write `balls`.

    Balls that sleep on it where it was wake up.
    """
    wake_sleepers_on(site, balls, number, now)
    if balls[number]['phase'] == HOLED:  # the next hole begins
        ball['strokes'] = 0
    balls[number] = ball
    laid = balls[number]
    laid['phase'], laid['end'] = REST, inf
    for field in (*TAKEN_UP, 'micro_bounce_end'):
        laid[field] = 0
    laid['struck'], laid['struck_at'] = now, laid['position']


def wake_sleepers_on(site: Site, balls: np.ndarray, number: int, now: float) -> None:
    """Wake the balls that sleep on a ball which is taken away."""
    apart = np.linalg.norm(balls['position'] - balls['position'][number], axis=1)
    sleepers = (
        (balls['phase'] == REST)
        & (balls['sleeps_on_ball'] != 0)
        & (apart <= 2.0 * (site.model.land.ball.radius + RESTING_GAP))
    )
    sleepers[number] = False
    for other in np.flatnonzero(sleepers):
        set_off(balls[other], now)


def set_off(ball: BallRecord, now: float) -> None:
    """Let a `ball` record at rest set off `now`, if it can."""
    ball['end'], ball['ending'] = now, LAUNCH
    ball['moved_by_ball'], ball['struck_at'] = 1, ball['position']


def drop(
    site: Site, balls: np.ndarray, number: int, peg: Optional[Sequence[float]], now: float
) -> None:
    """Drop a lost ball where it was struck, or beside a ball that lies there by `now`.

    Write `balls`.

    What holds it there: the `peg` if that is where it was teed; or nothing lets it go again, if it
    failed.
    """
    ball = balls[number]
    is_held = ball['phase'] == FAILED or three(ball['struck_at']) == peg
    ball['phase'], ball['end'] = REST, inf
    for field in TAKEN_UP:
        ball[field] = 0
    for x, y, z, lower in spots(three(ball['struck_at']), site.model.land.ball.radius):
        if is_free(site, balls, number, (x, y, z)):
            touches, inside, wet = site.put_down(site.model, ball, (x, y, z + lower), 2.0 * lower)
            if lower == 0.0 or touches and inside <= surfaces.SAME_HEIGHT and not wet:
                break
    else:
        site.put_down(site.model, ball, three(ball['struck_at']), 0.0)
    if not is_held:
        ball['end'], ball['ending'] = now, LAUNCH


def spots(place: Vector, radius: float) -> Iterator[tuple[float, float, float, float]]:
    """Candidate spots for a dropped ball: its `place`, then rings around it.

    Yields x, y, z, and how far above and below that ground may lie.
    """
    x, y, z = place
    yield x, y, z, 0.0
    for ring in range(1, 20):
        for step in range(6 * ring):
            angle = step * pi / (3 * ring)
            away = BESIDE * radius * ring
            yield x - away * cos(angle), y + away * sin(angle), z, 2.0 * radius
