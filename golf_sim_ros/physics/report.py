# SPDX-License-Identifier: Apache-2.0
"""What a world reports: collisions, and a result for every shot."""
from math import atan2, cos, hypot, isfinite, sin
from typing import NamedTuple, Optional

from .state import Phase


class Collision(NamedTuple):
    """An impact of more than 0.1 m/s approach; SI units, the course's frame.

    ``with_`` is a material's or a ball's name, ``normal`` points out of what was hit and
    ``impulse`` [N s] acted on ``ball``.
    """

    time: float
    ball: str
    kind: str
    with_: str
    position: tuple
    normal: tuple
    velocity_before: tuple
    velocity_after: tuple
    spin_before: tuple
    spin_after: tuple
    impulse: tuple


class Result(NamedTuple):
    """How a shot ended; SI units.

    ``carry`` and ``total``: horizontal distance from the strike to the first contact and to the
    end; ``carry_side``, ``side``: the same points' distance from the vertical plane of the launch,
    left positive; ``apex``: greatest height over the strike; ``flight_time`` and ``duration``: to
    the first contact and to the end; ``to_hole``: horizontal distance left; ``lie``: material under
    the ball; ``landing_angle``: below the horizontal, positive downward; ``bounces``: impacts with
    the ground over 0.1 m/s; ``time``: when it ended; ``position``: where; ``velocity``, ``spin``:
    the strike as received.
    """

    shot: int
    ball: str
    status: str
    carry: float
    carry_side: float
    total: float
    side: float
    apex: float
    flight_time: float
    duration: float
    to_hole: Optional[float]
    lie: str
    landing_speed: float
    landing_angle: float
    bounces: int
    time: float
    position: tuple
    velocity: tuple
    spin: tuple
    reason: str = ''


STATUS = {Phase.REST: 'at_rest', Phase.HOLED: 'holed', Phase.WATER: 'water', Phase.OUT: 'out_of_bounds'}


def three(row):
    """Array of three as a tuple of floats."""
    return float(row[0]), float(row[1]), float(row[2])


def collision(event, time, ball, material):
    """`Collision` of a logged impact."""
    names = ('position', 'normal', 'velocity_before', 'velocity_after', 'spin_before', 'spin_after',
             'impulse')
    return Collision(time, ball, 'bounce', material, *(three(event[name]) for name in names))


def result(ball, name, status, time, end, hole, lie):
    """`Result` of the shot of a `ball` record that ended at `end` on its own clock."""
    flew = bool(ball['flew'] and ball['landed'])
    struck_at, landed_at, position = (three(ball[n]) for n in ('struck_at', 'landed_at', 'position'))
    launch, landing = three(ball['launch']), three(ball['landing_velocity'])
    carry, carry_side = way(struck_at, landed_at, launch) if flew else (0.0, 0.0)
    total, side = way(struck_at, position, launch)
    return Result(
        int(ball['shot']), name, status, carry, carry_side, total, side,
        float(ball['highest']) - struck_at[2] if ball['flew'] else 0.0,
        float(ball['landing'] - ball['struck']) if flew else 0.0,
        float(end - ball['struck']),
        None if hole is None else hypot(hole[0] - position[0], hole[1] - position[1]), lie,
        hypot(*landing) if flew else 0.0,
        atan2(-landing[2], hypot(landing[0], landing[1])) if flew else 0.0,
        int(ball['bounces']), time, position, launch, three(ball['launch_spin']))


def way(start, end, launch):
    """Horizontal distance from `start` to `end`, and the end's distance left of the launch plane."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    heading = atan2(launch[1], launch[0]) if hypot(launch[0], launch[1]) > 0 else 0.0
    return hypot(dx, dy), dy * cos(heading) - dx * sin(heading)


MOST_SPEED = 150.0  # m/s
MOST_SPIN = 2500.0  # rad/s


def objection(velocity, spin):
    """Why a strike can't be taken, or ''."""
    if not all(isfinite(x) for x in (*velocity, *spin)):
        return 'velocity or spin is not finite'
    if not any((*velocity, *spin)):
        return 'velocity and spin are zero'
    if hypot(*velocity) > MOST_SPEED:
        return f'speed {hypot(*velocity):.6g} m/s is over {MOST_SPEED:g} m/s'
    if hypot(*spin) > MOST_SPIN:
        return f'spin {hypot(*spin):.6g} rad/s is over {MOST_SPIN:g} rad/s'
    return ''
