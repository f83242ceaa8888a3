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

"""Orientations of balls as quaternions, integrated from their spin: for display only."""

from math import cos, sin, sqrt

import numpy as np

from ..jit import entry
from ..state.ball import moves

UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@entry
def turn_orientations(orientations: np.ndarray, balls: np.ndarray, time: float) -> None:
    """Turn the orientations of the `balls` that move by `time` [s] of their present spin.

    Writes orientations. They are (n, 4), quaternions x, y, z, w: products of the rotation and what
    they were, normalised again.
    """
    for i in range(len(balls)):
        p, q, r = balls[i]['spin']
        rate = sqrt(p * p + q * q + r * r)
        # exact for constant spin, however long the time is
        if rate > 0.0 and moves(balls[i]['phase']):
            part, d = sin(0.5 * rate * time) / rate, cos(0.5 * rate * time)
            a, b, c = part * p, part * q, part * r
            x, y, z, w = orientations[i]
            x, y, z, w = (
                d * x + a * w + b * z - c * y,
                d * y + b * w + c * x - a * z,
                d * z + c * w + a * y - b * x,
                d * w - a * x - b * y - c * z,
            )
            size = sqrt(x * x + y * y + z * z + w * w)
            orientations[i, 0], orientations[i, 1] = x / size, y / size
            orientations[i, 2], orientations[i, 3] = z / size, w / size
