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

"""Everything that a course may hold, once, within 60 m."""

from .bowl import bowl
from .landform import bump, grid, inland
from .writing import npy, polygon, rectangle, rounded, stl

BUNKER, LIP, BUNKER_DEPTH = [(20, 7), (24, 6), (27, 9), (25, 13), (21, 12)], 0.1, 0.5
LOW, HIGH, SPACING = (34.0, -8.0), (50.0, 8.0), 0.5  # of the green

# Courses are known by the digest of their files, so that the bytes of these stay.
TEXT = """\
# Everything that a course may hold, within 60 m: every shape and material, zones, obstacles, water, a hole
# and bounds.
# Made by tools/make_courses.py; change it there.
format: 1
name: Playground
tee: [0, 0]
hole: [42, 0]
flagstick: true
bounds: [[-10, -25], [62, -25], [62, 25], [-10, 25]]

ground:
  - shape: plane
    material: rough
    cut:
      - {bunker}
      - {green}
      - [[18, -18], [28, -18], [28, -8], [18, -8]]   # pond
  - {{shape: patch, center: [0, 0, 0], length: 6, width: 5, material: tee}}
  - {{shape: mesh, file: playground_bunker.stl, material: sand}}
  - {{shape: heightmap, heights: playground.npy, origin: {low}, spacing: {spacing}, material: green}}
  - {{shape: patch, center: [23, -13, -0.8], length: 12, width: 12, material: sand}}   # floor of the pond
  - {{shape: patch, center: [56, 0, 1], normal: [-1, 0, 0], heading: 1.5707963267948966, length: 12, width: 2,
     material: stone}}   # wall behind the green

zones:
  - {{material: fairway, polygon: [[8, -5], [33, -5], [33, 5], [8, 5]]}}
  - {{material: first_cut, polygon: [[8, 5], [18, 5], [18, 7], [8, 7]]}}
  - {{material: artificial_turf, polygon: [[-6, 10], [0, 10], [0, 16], [-6, 16]]}}
  - {{material: hardpan, polygon: [[2, 14], [10, 14], [10, 20], [2, 20]]}}
  - {{material: soft_green, polygon: [[-6, -20], [4, -20], [4, -12], [-6, -12]]}}
  - {{material: firm_green, polygon: [[6, -20], [16, -20], [16, -12], [6, -12]]}}

water:
  - {{polygon: [[18, -18], [28, -18], [28, -8], [18, -8]], level: -0.2}}

obstacles:
  - {{shape: cylinder, base: [13, 9, 0], radius: 0.2, height: 4, material: wood}}
  - {{shape: sphere, center: [13, 9, 5.2], radius: 2, material: leaves}}
"""  # noqa: E501


def heights():
    """Heights of the green [m], rows along x: a mound beside the hole, and it falls from there."""
    x, y = grid(LOW, HIGH, SPACING)
    land = 0.25 - 0.012 * (x - 42.0) + 0.15 * bump(x, y, (44.0, 3.0), (5.0, 4.0))
    return rounded(land * inland(x, y, LOW, HIGH, 4.0))


def files():
    """Names and bytes."""
    content = TEXT.format(
        bunker=polygon(BUNKER), green=polygon(rectangle(LOW, HIGH)), low=list(LOW), spacing=SPACING
    )
    return {
        'playground.yaml': content.encode(),
        'playground.npy': npy(heights()),
        'playground_bunker.stl': stl(bowl(BUNKER, 0.0, LIP, BUNKER_DEPTH)),
    }
