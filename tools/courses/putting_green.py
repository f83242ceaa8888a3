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

"""A green to putt on: a ridge across it, a bowl behind that, and a putt of 3 m that breaks."""

import numpy as np

from .landform import bump, ellipse, grid, inland
from .writing import npy, polygon, rectangle, rounded

LOW, HIGH, SPACING = (-12.0, -16.0), (22.0, 16.0), 0.5
MIDDLE, RADII = (5.0, 0.0), (10.5, 9.5)  # of the green
SHOULDER = 6.0  # m from the map's outline to where the land is as high as it is meant to be
HOLE = (3.0, 0.0)

# Courses are known by the digest of their files, so that the bytes of these stay.
TEXT = """\
# A putting green of 21 x 19 m, stimp 10: from the tee a putt of 3 m that breaks to the right; elsewhere
# longer ones, over a ridge and into a bowl. Made by tools/make_courses.py; change it there.
format: 1
name: Putting green
tee: [0, 0]
hole: {hole}
flagstick: false
bounds: [[-40, -40], [60, -40], [60, 40], [-40, 40]]

ground:
  # Level ground around the heights, whose outline lies at 0, too.
  - shape: plane
    material: fairway
    cut:
      - {outline}
  - {{shape: heightmap, heights: putting_green.npy, origin: {low}, spacing: {spacing}, material: fairway}}

zones:
  - material: green
    polygon: {green}
"""  # noqa: E501


def heights():
    """Heights [m], rows along x."""
    x, y = grid(LOW, HIGH, SPACING)
    land = 0.15 + 0.014 * (y - MIDDLE[1]) + 0.006 * (x - MIDDLE[0])
    ridge = np.exp(-0.5 * ((x - 9.0 + 0.25 * y) / 1.9) ** 2)  # along y, leaning
    land = land + 0.06 * ridge - 0.11 * bump(x, y, (12.0, -3.0), (5.5, 5.5))
    return rounded(land * inland(x, y, LOW, HIGH, SHOULDER))


def files():
    """Names and bytes."""
    content = TEXT.format(
        hole=list(HOLE),
        outline=polygon(rectangle(LOW, HIGH)),
        low=list(LOW),
        spacing=SPACING,
        green=polygon(ellipse(MIDDLE, RADII, corners=36)),
    )
    return {'putting_green.yaml': content.encode(), 'putting_green.npy': npy(heights())}
