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

"""Time for which a ball is clear of a smooth surface, by its height over what lies straight below.

That height costs one look where the closest point takes a search. Where the surface's upward
normal (-dz/dx, -dz/dy, 1) is at most as long as S, a point at a height h over it is at least h / S
away from it. Along a path of acceleration at most A and speed at most v, over second derivatives
of at most K, the height's rate falls by at most S A + K v^2 a second, and the height by S v.
"""

from .conservative_advancement import advancement_bound, MOST_ADVANCES
from ..geometry import surfaces
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import BallRecord
from ..trajectory.segment import greatest_acceleration, greatest_speed, position, velocity

LOOK = 1.0 / 32.0  # work of one query of a part, over that of planning a segment
NEAR = 0.005  # m: so near to the surface it pays to ask for the closest point


@kernel
def time_near_relief(
    ground: Ground, part: int, ball: BallRecord, radius: float, begin: float, until: float
) -> float:
    """Time from `begin` on, `until` at most, before which the ball is clear of `part`.

    From then on it may be within NEAR of it. Writes segments_spent.
    """
    steep, bend = surfaces.relief(ground, part)
    fastest = greatest_speed(ball)
    falls = steep * greatest_acceleration(ball) + bend * fastest * fastest
    near = steep * (radius + NEAR)
    time = begin
    for _ in range(MOST_ADVANCES):
        ball['segments_spent'] += LOOK
        height, rate = surfaces.height_above(
            ground, part, position(ball, time), velocity(ball, time)
        )
        if height <= near:
            return time
        # To the middle of what counts as near, or that would never be reached.
        room = height - steep * (radius + 0.5 * NEAR)
        time += max(advancement_bound(room, rate, falls), room / (steep * fastest + 1e-9))
        if time >= until:
            return until
    return time
