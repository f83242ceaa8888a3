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

"""What is told of a play: collisions, a result for every shot, why a strike is rejected."""

from math import hypot, isfinite
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np

from .kernel_types import BallRecord, Vector
from .state.ball import Phase
from .state.serialize import plain_rows
from .trajectory.shot_record import MOST_WORK, NOT_FINITE, SUSTAINED_WORK, TOO_MUCH_WORK


class Collision(NamedTuple):
    """Impact of more than 0.1 m/s approach; SI units, the course's frame.

    ``kind`` is one of `COLLISION_KINDS`, ``with_`` the name of a material or a ball, ``normal``
    points out of what was hit and ``impulse`` [N s] acted on ``ball``.
    """

    time: float
    ball: str
    kind: str
    with_: str
    position: Vector
    normal: Vector
    velocity_before: Vector
    velocity_after: Vector
    spin_before: Vector
    spin_after: Vector
    impulse: Vector


class Result(NamedTuple):
    """Result of a shot; SI units.

    ``carry`` and ``total``: horizontal distance from the strike to the first contact and to the
    end; ``carry_side``, ``side``: the same points' distance from the vertical plane of the launch,
    left positive; ``apex``: greatest height over the strike before the first contact;
    ``flight_time`` and ``duration``: to the first contact and to the end; ``to_hole``: horizontal
    distance left; ``lie``: material under the ball; ``landing_angle``: below the horizontal,
    positive downward; ``bounces``: impacts with the ground over 0.1 m/s; ``time``: when it ended;
    ``position``: where; ``velocity``, ``spin``: the strike as received; ``stroke``: its number
    with this ball since that was teed; ``penalty``: strokes that its end costs, 1 in water and out
    of bounds.
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
    position: Vector
    velocity: Vector
    spin: Vector
    reason: str = ''
    stroke: int = 1
    penalty: int = 0


COSTS = ('water', 'out_of_bounds')  # statuses that cost a stroke: Rules of Golf 17.1d and 18.2b
# By surface_protocol.sort of what is hit.
COLLISION_KINDS = ('bounce', 'cup', 'flagstick', 'obstacle')
STATUS = {
    Phase.REST: 'at_rest',
    Phase.HOLED: 'holed',
    Phase.WATER: 'water',
    Phase.OUT: 'out_of_bounds',
    Phase.FAILED: 'failed',
}
FAULTS = {
    NOT_FINITE: 'its motion was not a number any more',
    TOO_MUCH_WORK: (
        f'its path took more than {MOST_WORK} segments beyond {SUSTAINED_WORK:.0f} a second'
    ),
}
MOVING = 'aborted'  # the status of a ball that is still on its way
OVER_TIME = 'time_limit'
ENDED_AS = np.array([STATUS.get(phase, MOVING) for phase in Phase])

SUMMARY = np.dtype(
    [
        ('status', 'U13'),
        ('carry', 'f8'),
        ('carry_side', 'f8'),
        ('total', 'f8'),
        ('side', 'f8'),
        ('apex', 'f8'),
        ('flight_time', 'f8'),
        ('duration', 'f8'),
        ('to_hole', 'f8'),
        ('lie', 'U32'),
        ('landing_speed', 'f8'),
        ('landing_angle', 'f8'),
        ('bounces', 'i8'),
        ('position', 'f8', 3),
        ('velocity', 'f8', 3),
        ('spin', 'f8', 3),
    ]
)


def three(row: np.ndarray) -> Vector:
    """Tuple of floats from an array of three."""
    x, y, z = row.tolist()
    return x, y, z


def summary(balls: np.ndarray, hole: Optional[Sequence[float]], lies: Sequence[str]) -> np.ndarray:
    """Results of ended shots, a structured array with the fields of `Result`.

    `balls` is an array of `BALL` or `ENDED` records, `lies` the materials' names. Without a hole
    ``to_hole`` is not a number.
    """
    told = np.zeros(len(balls), SUMMARY)
    landed = balls['landed'] != 0
    landing = balls['landing_velocity']
    level = np.hypot(landing[:, 0], landing[:, 1])
    told['status'] = np.where(balls['over_time'], OVER_TIME, ENDED_AS[balls['phase']])
    told['carry'], told['carry_side'] = np.where(landed, way(balls, 'landed_at'), 0.0)
    told['total'], told['side'] = way(balls, 'position')
    told['apex'] = np.where(
        landed | (balls['phase'] == Phase.FLIGHT) | (balls['phase'] == Phase.OUT),
        balls['apex'] - balls['struck_at'][:, 2],
        0.0,
    )
    told['flight_time'] = np.where(landed, balls['landing'] - balls['struck'], 0.0)
    told['duration'] = balls['ended'] - balls['struck']
    told['lie'] = np.array([*lies, ''])[np.where(balls['support'] >= 0, balls['material'], -1)]
    told['lie'][balls['phase'] == Phase.WATER] = 'water'
    told['landing_speed'] = np.where(landed, np.hypot(level, landing[:, 2]), 0.0)
    told['landing_angle'] = np.where(landed, np.arctan2(-landing[:, 2], level), 0.0)
    told['bounces'], told['position'] = balls['bounces'], balls['position']
    told['velocity'], told['spin'] = balls['launch'], balls['launch_spin']
    x, y = hole or (np.nan, np.nan)
    left = np.hypot(x - balls['position'][:, 0], y - balls['position'][:, 1])
    told['to_hole'] = np.where(balls['phase'] == Phase.HOLED, 0.0, left)
    return told


def way(balls: np.ndarray, end: str) -> tuple[np.ndarray, np.ndarray]:
    """Horizontal distance from the strike to `end`, and its distance from the launch plane.

    `end` is a field of `balls`; left is positive.
    """
    dx = balls[end][:, 0] - balls['struck_at'][:, 0]
    dy = balls[end][:, 1] - balls['struck_at'][:, 1]
    heading = np.arctan2(balls['launch'][:, 1], balls['launch'][:, 0])  # 0 if launched upright
    return np.hypot(dx, dy), dy * np.cos(heading) - dx * np.sin(heading)


def result(
    ball: BallRecord, name: str, time: float, hole: Optional[Sequence[float]], lies: Sequence[str]
) -> Result:
    """Sum up the shot of a `ball` record, which ended at the world's `time`, as a `Result`."""
    names = SUMMARY.names or ()
    figures: dict[str, Any] = dict(zip(names, *plain_rows(summary(ball[np.newaxis], hole, lies))))
    figures['to_hole'] = None if hole is None else figures['to_hole']
    return Result(
        shot=int(ball['shot']),
        ball=name,
        time=time,
        reason=failure(ball),
        stroke=int(ball['strokes']),
        penalty=int(figures['status'] in COSTS),
        **figures,
    )


def failure(ball: BallRecord) -> str:
    """Reason why the shot of a `ball` record failed, or ''."""
    if ball['phase'] != Phase.FAILED:
        return ''
    return (
        FAULTS[int(ball['failed'])] + f', {ball["ended"] - ball["struck"]:.9g} s after the strike'
    )


MOST_SPEED = 150.0  # m/s
MOST_SPIN = 2500.0  # rad/s


def objection(velocity: Sequence[float], spin: Sequence[float]) -> str:
    """Reason why a strike is rejected, or ''."""
    if not all(isfinite(x) for x in (*velocity, *spin)):
        return 'velocity or spin is not finite'
    if not any((*velocity, *spin)):
        return 'velocity and spin are zero'
    if hypot(*velocity) > MOST_SPEED:
        return f'speed {hypot(*velocity):.6g} m/s is over {MOST_SPEED:g} m/s'
    if hypot(*spin) > MOST_SPIN:
        return f'spin {hypot(*spin):.6g} rad/s is over {MOST_SPIN:g} rad/s'
    return ''


def suspects(velocities: np.ndarray, spins: np.ndarray) -> np.ndarray:
    """Mask of the strikes, rows of both (n, 3), that `objection` may reject.

    A fast, vectorised test.
    """
    size = np.stack(
        (np.einsum('ij,ij->i', velocities, velocities), np.einsum('ij,ij->i', spins, spins))
    )
    most = 0.999 * np.array([[MOST_SPEED * MOST_SPEED], [MOST_SPIN * MOST_SPIN]])
    return np.asarray(~((size <= most).all(0) & (size > 0.0).any(0)))
