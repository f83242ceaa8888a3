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

"""Log of collisions: the one writer of impacts, with ground, balls and water, and of going out."""

from ..jit import kernel
from ..kernel_types import BallRecord, Vector
from ..mechanics.vector import load, store, ZERO
from ..state.events import Log, next_event, WENT_OUT

NOT_A_PART = -1  # sort, and material, of what is no part of the ground


@kernel
def log_impact(
    ball: BallRecord,
    instant: tuple[float, int],
    hit: tuple[int, int, int, Vector],
    before: tuple[Vector, Vector],
    impulse: Vector,
    log: Log,
) -> None:
    """Log an impact that has just been applied to `ball`.

    `instant` is the time and the ball's number; `hit` the event's kind, material and sort and the
    normal of what is hit; `before` the velocity and spin before the impact; `impulse` the impulse
    [N s].
    """
    event = next_event(log)
    event['time'] = instant[0]
    event['ball'] = instant[1]
    event['kind'] = hit[0]
    event['material'] = hit[1]
    event['sort'] = hit[2]
    store(event['position'], load(ball['position']))
    store(event['normal'], hit[3])
    store(event['velocity_before'], before[0])
    store(event['velocity_after'], load(ball['velocity']))
    store(event['spin_before'], before[1])
    store(event['spin_after'], load(ball['spin']))
    store(event['impulse'], impulse)


@kernel
def log_out_of_bounds(ball: BallRecord, number: int, now: float, log: Log) -> None:
    """Log that the ball has gone out of bounds."""
    material = ball['material'] if ball['support'] >= 0 else NOT_A_PART
    motion = load(ball['velocity']), load(ball['spin'])
    log_impact(
        ball,
        (now, number),
        (WENT_OUT, material, NOT_A_PART, load(ball['normal'])),
        motion,
        ZERO,
        log,
    )
