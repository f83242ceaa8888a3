# SPDX-License-Identifier: Apache-2.0
"""How far a ball has turned, for those who draw it."""
from math import cos, sin, sqrt

UPRIGHT = (0.0, 0.0, 0.0, 1.0)


def turned(orientation, spin, time):
    """Quaternion (x, y, z, w) after `time` [s] of constant `spin` [rad/s] from `orientation`.

    The product of the turn and `orientation`, brought back to unit length.
    """
    rate = sqrt(sum(part * part for part in spin))
    if rate == 0.0:
        return orientation
    half = 0.5 * rate * time
    a, b, c = (sin(half) * part / rate for part in spin)
    d = cos(half)
    x, y, z, w = orientation
    product = (d * x + a * w + b * z - c * y, d * y + b * w + c * x - a * z,
               d * z + c * w + a * y - b * x, d * w - a * x - b * y - c * z)
    size = sqrt(sum(part * part for part in product))
    return tuple(part / size for part in product)
