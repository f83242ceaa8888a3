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

"""Impact with water: a ball ricochets or enters, sinks, and its shot is over."""

from math import asin, pi, sqrt

from .collision_log import log_impact, NOT_A_PART
from ..jit import kernel, shared
from ..kernel_types import BallProperties, BallRecord, SceneRecord, Vector
from ..mechanics.vector import dot, length, load, scale, store, sub, UP
from ..properties.water import ADDED_MASS, WATER_DENSITY
from ..state.ball import FLIGHT, moves, NO_PART
from ..state.events import Log, WATER_HIT
from ..trajectory import segment
from ..trajectory.shot_record import record_landing

# Johnson, Ricochet of non-spinning projectiles, mainly from water, Int. J. Impact Eng. 21 (1998)
# 15-24: a sphere ricochets off water that it hits at less than 18 degrees over the root of its
# specific gravity. For a golf ball that is 16.9 degrees.
CRITICAL_ANGLE = 18.0 * pi / 180
# That holds for balls so fast that their weight does not count. Estimates: the slowest that
# ricochets, and what it keeps of its speed along the water, upwards, and of its spin.
SKIPS_AT = 10.0  # m/s
ALONG_KEPT = 0.7
UPWARD_KEPT = 0.6
SPIN_KEPT = 0.5
DEEP = 2.0  # radii below the surface: the ball is well under water
LATE = 1e-9  # s: how exactly the time is found from which a ball only sinks
SINKING_SPEED = 0.5  # m/s: a golf ball sinks at 0.4, so a slower one has lost what it came with
DEEPEST = 5.0  # m below the surface: deeper down no ball is followed


@kernel
def specific_gravity(record: BallProperties) -> float:
    """Specific gravity: density of the ball over that of water."""
    r = record.radius
    return record.mass / (4.0 / 3.0 * pi * r * r * r * WATER_DENSITY)


@shared
def resolve_water_impact(
    land: SceneRecord, ball: BallRecord, number: int, now: float, log: Log
) -> None:
    """Resolve the impact of ball `number` with water, ricochet or entry, and log it.

    A ball that enters shares its momentum with its added mass. Writes water, velocity, spin,
    contact, step, stepping, landing, bounces.
    """
    record_landing(ball, now)
    velocity = load(ball['velocity'])
    spin = load(ball['spin'])
    heavy = specific_gravity(land.ball)
    if skips_off(land, ball, velocity, heavy):
        ball['bounces'] += 1
        x, y, z = velocity
        store(ball['velocity'], (ALONG_KEPT * x, ALONG_KEPT * y, -UPWARD_KEPT * z))
        store(ball['spin'], scale(SPIN_KEPT, spin))
    else:
        ball['water'] = ball['target']
        store(ball['velocity'], scale(heavy / (heavy + ADDED_MASS), velocity))
        # A ball that rolls in keeps its support: its shot ends there as one that touches ground
        # under water.
        if ball['phase'] == FLIGHT:
            ball['support'] = NO_PART
    store(ball['normal'], UP)
    ball['step'] = 0.0
    ball['rapid_impacts'] = 0
    ball['time_stepping'] = 0
    impulse = scale(land.ball.mass, sub(load(ball['velocity']), velocity))
    log_impact(
        ball,
        (now, number),
        (WATER_HIT, NOT_A_PART, NOT_A_PART, UP),
        (velocity, spin),
        impulse,
        log,
    )


@kernel
def skips_off(land: SceneRecord, ball: BallRecord, velocity: Vector, heavy: float) -> bool:
    """Whether a ball of specific gravity `heavy` that hits water at `velocity` ricochets."""
    speed = length(velocity)
    under = land.ground.waters.levels[ball['target'] - 1] - ball['position'][2]
    # Only from above: one that comes in through the outline, as from a bank, is under the surface
    # already.
    if ball['phase'] != FLIGHT or velocity[2] >= 0.0 or speed < SKIPS_AT or under > 1e-6:
        return False
    return asin(-velocity[2] / speed) < CRITICAL_ANGLE / sqrt(heavy)


@kernel
def leave_water(land: SceneRecord, ball: BallRecord) -> None:
    """Take a ball that rises above the surface, a light one or one sent up, out of water.

    Writes water.
    """
    if (
        ball['position'][2] > land.ground.waters.levels[ball['water'] - 1]
        and ball['velocity'][2] > 0.0
    ):
        ball['water'] = 0


@kernel
def has_ended_in_water(land: SceneRecord, ball: BallRecord) -> bool:
    """Whether a ball in water has reached ground, or is so slow that it only sinks or floats."""
    if ball['water'] == 0 or not moves(ball['phase']):
        return False
    if ball['phase'] != FLIGHT:
        return True
    return only_sinks(land, ball, load(ball['position']), load(ball['velocity']))


@kernel
def only_sinks(land: SceneRecord, ball: BallRecord, place: Vector, v: Vector) -> bool:
    """Whether the ball, which is in water, only sinks or floats once it is at `place` with `v`."""
    depth = land.ground.waters.levels[ball['water'] - 1] - place[2]
    slow = dot(v, v) < SINKING_SPEED * SINKING_SPEED
    return depth > DEEPEST or slow and (depth > DEEP * land.ball.radius or v[2] >= 0.0)


@kernel
def sinking_time(land: SceneRecord, ball: BallRecord, until: float) -> float:
    """Time on the segment from which the ball only sinks or floats; `until` if it does not then.

    It is at most `until`, and up to 2 LATE late.
    """
    place, v = segment.position(ball, until), segment.velocity(ball, until)
    if not only_sinks(land, ball, place, v):
        return until
    before, after = 0.0, until
    while after - before > LATE:
        middle = 0.5 * (before + after)
        place, v = segment.position(ball, middle), segment.velocity(ball, middle)
        if only_sinks(land, ball, place, v):
            after = middle
        else:
            before = middle
    return min(after + LATE, until)
