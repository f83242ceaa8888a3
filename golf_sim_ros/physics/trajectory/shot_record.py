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

"""Record of a shot under way, for its result, and the checks that fail a shot."""

from . import segment
from ..jit import entry, kernel
from ..kernel_types import BallRecord, StructRecord
from ..mechanics.vector import load, store
from ..state.ball import FLIGHT, LAUNCH, moves, REST
from ..state.events import Log, LOST, next_event, SHOT_ENDS
from ..state.transitions import come_to_rest, put_back

NOT_FINITE, TOO_MUCH_WORK = 1, 2  # why a shot fails
# Bound on the work of a path, a token bucket: segments a second, four times what a wedged ball
# takes, and the burst beyond that, which drains at that rate. In `make hard` the burst comes to
# some 350; at `reference` a ball that skims on turf which never stops to throw it up takes 37 000
# bounces within a second or two.
SUSTAINED_WORK = 20_000.0
MOST_WORK = 100_000
APEX_SPEED = 1e-7  # m/s: a ball that rises no faster is at its apex but for a femtometre


@kernel
def update_apex(ball: BallRecord) -> None:
    """Update the greatest height in flight before the first contact with the segment.

    Writes apex.
    """
    if ball['phase'] != FLIGHT or ball['landed']:
        return
    # No root finding where the control points are lower.
    if segment.extent_along(ball, 2)[1] <= ball['apex']:
        return
    time = ball['end'] - ball['begin']
    start = segment.position(ball, 0.0)[2]
    ball['apex'] = max(ball['apex'], max(start, segment.position(ball, time)[2]))
    low = 0.0
    high = time
    rising = segment.velocity(ball, low)[2]
    falling = segment.velocity(ball, high)[2]
    if rising <= 0.0 or falling >= 0.0:
        return
    moved = 0
    # Regula falsi; an end that stays twice loses half of its weight (Illinois)
    for _ in range(50):
        apex = (low * falling - high * rising) / (falling - rising)
        speed = segment.velocity(ball, apex)[2]
        if abs(speed) < APEX_SPEED:
            break
        if speed > 0.0:
            falling *= 0.5 if moved > 0 else 1.0
            low = apex
            rising = speed
            moved = 1
        else:
            rising *= 0.5 if moved < 0 else 1.0
            high = apex
            falling = speed
            moved = -1
    ball['apex'] = max(ball['apex'], segment.position(ball, apex)[2])


@kernel
def mark_moved_by_ball(ball: BallRecord) -> None:
    """Mark a ball at rest that another one sets off. Writes moved_by_ball, struck_at.

    If it is lost, it goes back to where it lay.
    """
    if not ball['shot_active'] and ball['phase'] == REST:
        ball['moved_by_ball'] = 1
        store(ball['struck_at'], load(ball['position']))


@kernel
def record_landing(ball: BallRecord, now: float) -> None:
    """Record time, position and velocity of a shot's first contact. Writes landing."""
    if ball['shot_active'] and not ball['landed'] and ball['phase'] == FLIGHT:
        ball['landed'] = 1
        ball['landing'] = now
        store(ball['landed_at'], load(ball['position']))
        store(ball['landing_velocity'], load(ball['velocity']))


@kernel
def end_shot(ball: BallRecord, number: int, now: float, kind: int, log: Log) -> None:
    """End the ball's shot and log it as `kind`, SHOT_ENDS or LOST.

    A ball that still moves is over time, and is stopped. Writes shot_active, ended, over_time,
    phase, motion.
    """
    ball['ended'] = now
    if moves(ball['phase']):
        ball['over_time'] = 1
        come_to_rest(ball)
    ball['shot_active'] = 0
    event = next_event(log)
    event['time'] = now
    event['ball'] = number
    event['kind'] = kind
    log.count[1] = 1


@kernel
def check_segment(ball: BallRecord, now: float) -> int:
    """Reason for which the ball can't go on with its segment planned at `now`, or 0.

    Writes counted_until, segments_spent.
    """
    passed = max(now - ball['counted_until'], 0.0)
    ball['counted_until'] = now
    ball['segments_spent'] = max(ball['segments_spent'] - SUSTAINED_WORK * passed, 0.0) + 1.0
    if ball['segments_spent'] > MOST_WORK:
        return TOO_MUCH_WORK
    w = ball['position_coefficients']
    s = ball['spin_coefficients']
    total = ball['end'] - ball['begin'] + ball['span']
    for k in range(3):
        total += w[1, k] + w[2, k] + w[3, k] + w[4, k] + w[5, k] + s[1, k] + s[2, k] + s[3, k]
    # Infinite or not a number: the difference is no zero.
    return 0 if total - total == 0.0 else NOT_FINITE


@kernel
def is_finite(ball: BallRecord) -> bool:
    """Whether the ball's position, velocity and spin are finite."""
    x = ball['position']
    v = ball['velocity']
    w = ball['spin']
    total = x[0] + x[1] + x[2] + v[0] + v[1] + v[2] + w[0] + w[1] + w[2]
    return total - total == 0.0


@kernel
def fail(ball: BallRecord, number: int, now: float, why: int, log: Log) -> None:
    """Fail the shot of a ball that can't go on; it is put back to where it was struck.

    Logs the end. Writes motion, phase, shot.
    """
    ball['failed'] = why
    ball['moved_by_ball'] = 0
    put_back(ball)
    end_shot(ball, number, now, SHOT_ENDS if ball['shot_active'] else LOST, log)


@kernel
def copy_result(ball: BallRecord, end: StructRecord) -> None:
    """Copy what a result needs of a ball's shot into `end`, an `ENDED` record."""
    end['phase'] = ball['phase']
    end['support'] = ball['support']
    end['material'] = ball['material']
    store(end['position'], load(ball['position']))
    end['struck'] = ball['struck']
    store(end['struck_at'], load(ball['struck_at']))
    store(end['launch'], load(ball['launch']))
    store(end['launch_spin'], load(ball['launch_spin']))
    end['apex'] = ball['apex']
    end['landed'] = ball['landed']
    end['landing'] = ball['landing']
    store(end['landed_at'], load(ball['landed_at']))
    store(end['landing_velocity'], load(ball['landing_velocity']))
    end['bounces'] = ball['bounces']
    end['ended'] = ball['ended']
    end['over_time'] = ball['over_time']


@entry
def begin_shot(ball: BallRecord, now: float) -> None:
    """Begin a shot with the ball's velocity and spin at `now`. Writes shot, end, ending."""
    ball['shot_active'] = 1
    ball['moved_by_ball'] = 0
    ball['struck'] = now
    ball['end'] = now
    ball['ending'] = LAUNCH
    ball['apex'] = ball['position'][2]
    store(ball['struck_at'], load(ball['position']))
    store(ball['launch'], load(ball['velocity']))
    store(ball['launch_spin'], load(ball['spin']))
    ball['landed'] = 0
    ball['bounces'] = 0
    ball['over_time'] = 0
    ball['failed'] = 0
    ball['counted_until'] = now
    ball['segments_spent'] = 0.0
