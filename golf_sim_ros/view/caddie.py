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

"""Where a shot would go, how a green slopes, which line holes, and what to play: physics alone."""

from math import atan2, cos, degrees, hypot, radians, sin
from typing import Any, NamedTuple

import numpy as np

from .raster import ground_grid
from ..physics import Course, ground_height, Rejected, Result, World
from ..physics.scene.kernel_model import materials
from ..shot_input.clubs import CLUBS, PUTTER
from ..shot_input.launch_monitor import Launch, parted, velocity_and_spin

LONGEST = 60.0  # s that are looked ahead
LEAST_FLIGHT = 0.2  # s in the air of a shot whose landing is shown
POINTS = 160  # of a path that is drawn
MOST_TILT = radians(22.0)  # of the spin's axis, at full curve
PUTTS = 25.0  # m: a ball on the green is putted from no farther
BEYOND = 0.35  # m past the hole that a putt is to reach
FASTEST_PUTT = 12.0  # m/s
TRIES = 14  # putts that are tried to find the line
GREENS = ('green', 'firm_green', 'soft_green', 'artificial_turf')
ASIDE = 0.05  # m from one height to the next, of which a slope is taken
LEAST_POWER, MOST_POWER = 0.08, 1.0
HALVINGS = 7
WORSE = {'sand': 22.0, 'rough': 7.0, 'water': 150.0}  # m that such an end is worse than a fairway
LOST = 170.0  # m that a stroke and a penalty are worth
AIMS = (0.0, 6.0, -6.0, 12.0, -12.0)  # deg from the hole, tried in this order


class Stroke(NamedTuple):
    """A shot as a player says it.

    Parameters
    ----------
    club : str
    power : float
        Part of the club's average ball speed and spin; for the putter the ball's speed [m/s].
    aim : float
        Angle from the line to the hole, positive to the right [deg].
    curve : float
        From -1, a hook to the left, to 1, a slice to the right.
    """

    club: str
    power: float
    aim: float = 0.0
    curve: float = 0.0


class Flight(NamedTuple):
    """A shot that was played out: its path, rows of x, y, z [m], and how it ended."""

    path: np.ndarray
    landing: tuple | None
    result: Result


def launch(hole: tuple | None, place: tuple, stroke: Stroke) -> tuple:
    """Velocity and spin of a stroke from `place` towards `hole`, or along x without one."""
    heading = atan2(hole[1] - place[1], hole[0] - place[0]) if hole else 0.0
    if stroke.club == PUTTER:
        given = Launch(stroke.power)
    else:
        average = CLUBS[stroke.club].launch
        assert average is not None, 'only the putter has none'
        backspin, sidespin = parted(stroke.power * average.backspin, MOST_TILT * stroke.curve)
        speed = stroke.power * average.speed
        given = Launch(speed, average.launch, 0.0, backspin, sidespin)
    return velocity_and_spin(given._replace(azimuth=radians(stroke.aim)), heading)


def play_out(
    course: Course,
    place: tuple,
    stroke: Stroke,
    wind: tuple,
    hole: tuple | None = None,
    step: float = 0.05,
) -> Flight | None:
    """`Flight` of a stroke towards `hole`, the course's if None; None where it can't be played.

    The path has a row every `step` [s].
    """
    try:
        world = World(course, wind=wind, engine='python')
        name = world.names[0]
        world.place(name, tuple(place[:2]))
        world.happened()
        world.strike(name, *launch(hole or course.hole, place, stroke))
    except (Rejected, ValueError):
        return None
    path, events = [world[name].position], world.happened()
    while world.time < LONGEST and not any(isinstance(event, Result) for event in events):
        events += world.advance(step)
        path.append(world[name].position)
    result = next((event for event in events if isinstance(event, Result)), None)
    if result is None:
        return None
    flew = result.flight_time > LEAST_FLIGHT and not isinstance(events[0], Result)
    path[-1] = result.position
    return Flight(np.array(path), events[0].position if flew else None, result)


def prediction(course: Course, place: tuple, stroke: Stroke, wind: tuple) -> dict[str, Any] | None:
    """Path, landing and end of a stroke, for JSON; None where it cannot be played."""
    flight = play_out(course, place, stroke, wind)
    if flight is None:
        return None
    every = max(1, len(flight.path) // POINTS)
    path = np.vstack([flight.path[:-1:every], flight.path[-1:]])
    return {
        'path': np.round(path, 3).tolist(),
        'landing': flight.landing and np.round(flight.landing, 3).tolist(),
        'end': np.round(flight.result.position, 3).tolist(),
        'carry': round(flight.result.carry, 2),
        'total': round(flight.result.total, 2),
        'to_hole': flight.result.to_hole,
        'status': flight.result.status,
        'lie': flight.result.lie,
    }


def is_putt(course: Course, place: tuple) -> bool:
    """Whether a ball at `place` is best putted: on a green, not too far from the hole."""
    if course.hole is None:
        return False
    found = ground_height(course, float(place[0]), float(place[1]))
    way = hypot(course.hole[0] - place[0], course.hole[1] - place[1])
    return found is not None and found[1] in GREENS and way < PUTTS


def slopes(course: Course, place: tuple) -> list:
    """Rows of x, y, z and the slope along x and y of the green, on a grid around ball and hole."""
    hole, ball = np.array(course.hole, float), np.array(place[:2], float)
    way = max(np.hypot(*(hole - ball)), 3.0)
    step = 0.5 if way < 7.0 else 1.0
    half = np.ceil((0.5 * way + 2.0) / step) * step
    x, y = (
        np.arange(middle - half, middle + half + 1e-9, step)
        for middle in np.round(0.5 * (hole + ball) / step) * step
    )
    heights, numbers = ground_grid(course, x, y)
    east, west = (ground_grid(course, x + d, y)[0] for d in (ASIDE, -ASIDE))
    north, south = (ground_grid(course, x, y + d)[0] for d in (ASIDE, -ASIDE))
    greens = [k for k, material in enumerate(materials(course)) if material.name in GREENS]
    along, up = (east - west) / (2 * ASIDE), (north - south) / (2 * ASIDE)
    on = np.isin(numbers, greens) & np.isfinite(along) & np.isfinite(up)
    rows = np.column_stack([*(grid[on] for grid in np.meshgrid(x, y)), heights[on]])
    return np.round(np.column_stack([rows, along[on], up[on]]), 4).tolist()


def putt(course: Course, place: tuple, wind: tuple = (0.0, 0.0, 0.0)) -> Stroke:
    """Find the putt that dies a little past the hole, on the line that holes it.

    Along and across the line to the hole the end is to be `BEYOND` past it: two unknowns, speed
    and aim, are corrected by how far the end is off; tried on the course without its hole.
    """
    bare = course._replace(hole=None, flagstick=False)
    hole, ball = np.array(course.hole, float), np.array(place[:2], float)
    way = float(np.hypot(*(hole - ball)))
    ahead = (hole - ball) / way
    speed, aim, best = putt_speed(way + BEYOND), 0.0, None
    for _ in range(TRIES):
        stroke = Stroke(PUTTER, min(speed, FASTEST_PUTT), aim)
        flight = play_out(bare, place, stroke, wind, course.hole)
        if flight is None:
            break
        end = np.array(flight.result.position[:2]) - ball
        along = float(end @ ahead)
        passed = passes(flight.path, hole, ahead)
        off = abs(along - way - BEYOND) + 3.0 * abs(passed)
        if best is None or off < best[0]:
            best = off, stroke
        if off < 0.05:
            break
        speed *= float(np.clip(((way + BEYOND) / max(along, 0.05)) ** 0.5, 0.6, 1.7))
        aim += degrees(atan2(passed, way))
    return best[1] if best else Stroke(PUTTER, putt_speed(way + BEYOND))


def passes(path: np.ndarray, hole: np.ndarray, ahead: np.ndarray) -> float:
    """How far to the left of the hole a path passes it, or ends [m]."""
    left = np.array([-ahead[1], ahead[0]])
    along, across = (path[:, :2] - hole) @ ahead, (path[:, :2] - hole) @ left
    beyond = np.flatnonzero(along >= 0.0)
    if not len(beyond) or not beyond[0]:
        return float(across[-1])
    k = int(beyond[0])
    share = -along[k - 1] / max(along[k] - along[k - 1], 1e-9)
    return float(across[k - 1] + share * (across[k] - across[k - 1]))


def putt_speed(way: float) -> float:
    """Speed that rolls about so far on a level green of stimp 10 [m/s]."""
    return (2.0 * 0.75 * way) ** 0.5 * 1.15


def line(course: Course, place: tuple, wind: tuple) -> list:
    """Rows of x, y, z of the putt that holes."""
    flight = play_out(course, place, putt(course, place, wind), wind)
    return [] if flight is None else np.round(flight.path, 3).tolist()


def choose(course: Course, place: tuple, wind: tuple) -> Stroke:
    """Choose the stroke that leaves the least way from `place`, clear of water and sand."""
    if is_putt(course, place):
        return putt(course, place, wind)
    hole = hole_of(course)
    way = hypot(hole[0] - place[0], hole[1] - place[1])
    best: tuple[float, Stroke] | None = None
    for aim in AIMS:
        for club in likely_clubs(way):
            stroke, left = reaching(course, place, club, aim, way, wind)
            if stroke and (best is None or left < best[0]):
                best = left, stroke
        if best and best[0] < max(9.0, 0.75 * max(0.0, way - 225.0)):
            break
    return best[1] if best else Stroke('pw', MOST_POWER)


def likely_clubs(way: float) -> list:
    """Clubs whose average carries about as far as `way`, or the longest."""
    carries = {name: club.carry for name, club in CLUBS.items() if club.carry is not None}
    if way > max(carries.values()) + 15.0:
        return ['driver', '3w', '5i']
    enough = [name for name, carry in carries.items() if carry > 0.82 * way] or ['driver']
    return [enough[-1], *enough[-2:-1]]


def hole_of(course: Course) -> tuple[float, float]:
    """Find where the hole is; ValueError where there is none to play to."""
    if course.hole is None:
        raise ValueError(f'{course.name} has no hole')
    return course.hole[0], course.hole[1]


def usual_power(club: str, way: float) -> float:
    """About the power with which a club carries to the hole, at most a whole shot."""
    carry = CLUBS[club].carry
    if not carry or not 0.0 < way < carry:
        return MOST_POWER
    return max(LEAST_POWER, (way / carry) ** 0.6)


def reaching(
    course: Course, place: tuple, club: str, aim: float, way: float, wind: tuple
) -> tuple:
    """Search how hard to hit a club to end at the hole: the stroke, and what it leaves [m]."""
    low, high = LEAST_POWER, MOST_POWER
    best: tuple[float, Stroke | None] = (1e9, None)
    hole = hole_of(course)
    for n in range(HALVINGS):
        power = MOST_POWER if n == 0 else 0.5 * (low + high)
        stroke = Stroke(club, power, aim)
        flight = play_out(course, place, stroke, wind, step=LONGEST)
        if flight is None:
            break
        left = left_over(flight.result, way)
        best = (left, stroke) if left < best[0] else best
        if flight.result.status == 'holed':
            break
        reached = np.subtract(flight.result.position[:2], place[:2])
        heading = atan2(hole[1] - place[1], hole[0] - place[0])
        along = reached @ (cos(heading), sin(heading))
        if n == 0 and along < way:
            break
        low, high = (power, high) if along < way else (low, power)
    return best[1], best[0]


def left_over(result: Result, way: float) -> float:
    """Weigh what an end leaves to do [m]: the way to the hole, more where the ball lies badly."""
    if result.status == 'holed':
        return 0.0
    if result.status in ('water', 'out_of_bounds', 'failed', 'time_limit'):
        return way + LOST
    left = result.to_hole or 0.0
    return left + WORSE.get(result.lie, 0.0) * min(1.0, left / 10.0)
