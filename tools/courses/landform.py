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

"""What land is made of: functions of x, y [m] that give heights [m] or shares from 0 to 1.

Both are arrays.
"""

from math import cos, pi, sin
from random import Random

import numpy as np


def grid(low, high, spacing):
    """Grid x (1, nx) and y (ny, 1) from `low` to `high`, pairs of x and y."""
    x, y = (np.arange(round((b - a) / spacing) + 1) * spacing + a for a, b in zip(low, high))
    return x[np.newaxis], y[:, np.newaxis]


def smooth(t):
    """From 0 at `t` <= 0 to 1 at `t` >= 1, with no slope and no bend at either end."""
    t = np.clip(t, 0.0, 1.0)
    return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t)


def inland(x, y, low, high, width):
    """0 on the rectangle from `low` to `high`, 1 where its sides are `width` or farther away."""
    share = 1.0
    for place, a, b in ((x, low[0], high[0]), (y, low[1], high[1])):
        share = share * smooth((place - a) / width) * smooth((b - place) / width)
    return share


def away(x, y, center, radii, heading=0.0):
    """Distance from `center`, over the radii of an ellipse whose first lies along `heading`."""
    dx, dy = x - center[0], y - center[1]
    c, s = cos(heading), sin(heading)
    return np.hypot((c * dx + s * dy) / radii[0], (c * dy - s * dx) / radii[1])


def bump(x, y, center, radii, heading=0.0):
    """1 at `center`, 0 from the ellipse of `radii` on, round everywhere."""
    inside = np.clip(1.0 - away(x, y, center, radii, heading) ** 2, 0.0, 1.0)
    return inside * inside * inside


def plateau(x, y, center, radii, slope, heading=0.0):
    """1 within the ellipse of `radii`, falling to 0 over `slope` [m] around it."""
    beyond = (away(x, y, center, radii, heading) - 1.0) * min(radii)
    return 1.0 - smooth(beyond / slope)


def waves(x, y, seed, lengths, count):
    """Waves of `count` directions, their lengths [m] between the two of `lengths`.

    Their mean is 0, and they go from about -1 to 1.
    """
    random = Random(seed)
    total = 0.0
    for i in range(count):
        turn, phase = random.uniform(0.0, pi), random.uniform(0.0, 2.0 * pi)
        length = lengths[0] + (lengths[1] - lengths[0]) * i / (count - 1)
        total = total + length * np.sin(
            2.0 * pi / length * (cos(turn) * x + sin(turn) * y) + phase
        )
    return total * 2.0 / (count * lengths[1])


def along(x, course):
    """Piecewise cubic through `course`, rows of (x, y): y over `x`, level at every row."""
    result = np.full(np.shape(x), float(course[0][1]))
    for (x0, y0), (x1, y1) in zip(course, course[1:]):
        result = result + (y1 - y0) * smooth((x - x0) / (x1 - x0))
    return result


def ellipse(center, radii, heading=0.0, corners=24):
    """Corners (x, y) of an ellipse."""
    c, s = cos(heading), sin(heading)
    turns = [2.0 * pi * i / corners for i in range(corners)]
    return [
        (
            center[0] + c * radii[0] * cos(t) - s * radii[1] * sin(t),
            center[1] + s * radii[0] * cos(t) + c * radii[1] * sin(t),
        )
        for t in turns
    ]


def band(course, half_width, step):
    """Corners of the strip around `along` of `course`, `half_width` to either side."""
    first, last = course[0][0], course[-1][0]
    x = np.linspace(first, last, round((last - first) / step) + 1)
    y = along(x, course)
    return [*zip(x, y - half_width), *zip(x[::-1], y[::-1] + half_width)]
