# SPDX-License-Identifier: Apache-2.0
"""Orientations of balls as quaternions, integrated from their spin: for display only."""
from math import cos, sin, sqrt

from ..jit import entry
from ..state.ball import moves

UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@entry
def turn_orientations(orientations, balls, time):
    """Turn the orientations of the `balls` that move by `time` [s] of their present spin.

    Writes orientations. They are (n, 4), quaternions x, y, z, w: products of the rotation and what they were,
    normalised again.
    """
    for i in range(len(balls)):
        p, q, r = balls[i]['spin']
        rate = sqrt(p * p + q * q + r * r)
        if rate > 0.0 and moves(balls[i]['phase']):  # exact for constant spin, however long the time is
            part, d = sin(0.5 * rate * time) / rate, cos(0.5 * rate * time)
            a, b, c = part * p, part * q, part * r
            x, y, z, w = orientations[i]
            x, y, z, w = (d * x + a * w + b * z - c * y, d * y + b * w + c * x - a * z,
                          d * z + c * w + a * y - b * x, d * w - a * x - b * y - c * z)
            size = sqrt(x * x + y * y + z * z + w * w)
            orientations[i, 0], orientations[i, 1] = x / size, y / size
            orientations[i, 2], orientations[i, 3] = z / size, w / size
