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

"""A par 3 between tall trees, where the wind swirls, over a creek to a shallow green."""

from random import Random

import numpy as np

from .landform import band, bump, ellipse, grid, inland, plateau, smooth, waves
from .writing import map_course, place, polygon, rectangle, rounded

LOW, HIGH, SPACING = (-30.0, -70.0), (210.0, 70.0), 1.0
SHORE = 20.0  # m from the map's outline to where the land is at its full height
TEE, HOLE = (0.0, 0.0), (143.0, 4.0)
TEE_HEIGHT, GREEN_HEIGHT, BANK = 5.0, 2.2, 6.0
GREEN, GREEN_RADII, GREEN_TURN = (142.0, 2.0), (8.0, 17.0), 0.25
CREEK, CREEK_WIDTH, CREEK_DEPTH, CREEK_LEVEL = 121.0, 5.0, 1.6, -0.25
BUNKERS = [  # middle, radii of the hollow, heading, depth [m]
    ((131.0, 4.0), (5.0, 8.0), 0.3, 1.0),
    ((154.0, -8.0), (6.0, 6.5), 0.0, 1.1),
    ((156.0, 12.0), (5.5, 7.0), 0.2, 1.1),
]
SAND = 0.72  # of a hollow's radii that are sand
SEED, TRUNK, ROOT = 12, 0.35, 0.5
LANE = 26.0  # m to either side of the way that are free of trees
AROUND_GREEN = 22.0
APART = 9.0  # m between two trees
TREES = 90

TEXT = """\
# A par 3 of 143 m between pines 18 to 26 m high, from a raised tee over a creek to a shallow green
# with a bank and more pines behind it. The wind over the tops is not that at the flag: in the lee
# of the trees it drops and turns, above the creek it comes through the gap. tall_pines_wind.npz is
# that wind, solved for.
# Made by tools/make_courses.py, its wind by tools/make_wind_fields.py; change it there.
format: 1
name: Tall pines
tee: {tee}
hole: {hole}
flagstick: true
wind_profile: {{law: log, roughness: 0.1}}  # bushes and scattered trees (Wieringa 1993)
wind_field: tall_pines_wind.npz

ground:
  # Level ground around the heights, whose outline lies at 0, too.
  - shape: plane
    material: rough
    cut:
      - {outline}
  - shape: heightmap
    heights: tall_pines.npy
    origin: {low}
    spacing: {spacing}
    material: rough

zones:
{zones}

water:
  - level: {level}
    polygon: {creek}

materials:
  # The wind meets needles all over the crown: leaf-area density 1.5 1/m (pines: 1 to 2) x 0.2
  # (Sanz 2003, Boundary-Layer Meteorol. 108, 189).
  pine: {{like: leaves, canopy_drag: 0.3, color: [0.12, 0.32, 0.14]}}

obstacles:
{trees}
"""


def heights():
    """Heights [m], rows along x."""
    x, y = grid(LOW, HIGH, SPACING)
    land = 1.2 + 1.0 * waves(x, y, 12, (45.0, 100.0), 7) + 2.0 * smooth((np.abs(y) - 30.0) / 30.0)
    land = land + BANK * smooth((x - 152.0) / 26.0) * bump(x, y, (178.0, 4.0), (45.0, 60.0))
    land = raised(land, plateau(x, y, TEE, (8.0, 7.0), 22.0), TEE_HEIGHT)
    land = raised(land, plateau(x, y, GREEN, GREEN_RADII, 9.0, GREEN_TURN), green(x, y))
    for middle, radii, heading, depth in BUNKERS:
        land = land - depth * bump(x, y, middle, radii, heading)
    across = smooth(1.0 - np.abs(x - bed(y)) / (2.2 * CREEK_WIDTH))
    land = raised(land, across, CREEK_LEVEL - CREEK_DEPTH * across)
    return rounded(land * inland(x, y, LOW, HIGH, SHORE))


def raised(land, share, height):
    """`land` that is brought to `height` where `share` is 1."""
    return land + share * (height - land)


def green(x, y):
    """Heights of the green: it falls to the creek."""
    return GREEN_HEIGHT + 0.02 * (x - GREEN[0]) + 0.004 * (y - GREEN[1])


def bed(y):
    """Return x of the creek's middle."""
    return CREEK + 4.0 * np.sin(y / 17.0)


def creek():
    """Corners of the creek, as wide as its hollow."""
    y = np.linspace(LOW[1] + SHORE, HIGH[1] - SHORE, 25)
    near, far = bed(y) - 1.5 * CREEK_WIDTH, bed(y) + 1.5 * CREEK_WIDTH
    return [*zip(near, y), *zip(far[::-1], y[::-1])]


def zones():
    """Materials and polygons, later over earlier."""
    found = [
        ('fairway', band([(95.0, 0.0), (113.0, 2.0)], 14.0, 6.0)),
        (
            'first_cut',
            ellipse(GREEN, (GREEN_RADII[0] + 4.0, GREEN_RADII[1] + 4.0), GREEN_TURN, 32),
        ),
        ('green', ellipse(GREEN, GREEN_RADII, GREEN_TURN, 32)),
        ('tee', rectangle((-6.0, -5.0), (6.0, 5.0))),
    ]
    sand = [
        ('sand', ellipse(middle, (SAND * radii[0], SAND * radii[1]), heading))
        for middle, radii, heading, _ in BUNKERS
    ]
    return found + sand


def places():
    """Where trees stand: x, y, with room between them, none in the way of the ball."""
    random, found = Random(SEED), []
    while len(found) < TREES:
        x, y = round(random.uniform(-24.0, 204.0), 1), round(random.uniform(-64.0, 64.0), 1)
        in_lane = x < GREEN[0] and abs(y) < LANE
        at_green = np.hypot(x - GREEN[0], y - GREEN[1]) < AROUND_GREEN
        in_creek = abs(x - bed(y)) < 2.0 * CREEK_WIDTH
        crowded = any(np.hypot(x - a, y - b) < APART for a, b in found)
        if not (in_lane or at_green or in_creek or crowded):
            found.append((x, y))
    return found


def trees(land):
    """Trunks and crowns that stand on `land`, `heights()`: lines of YAML."""
    random, lines = Random(SEED + 1), []
    for x, y in places():
        trunk, crown = round(random.uniform(5.0, 8.0), 1), round(random.uniform(2.6, 3.6), 1)
        top = round(random.uniform(18.0, 26.0), 1)
        z = land[round((y - LOW[1]) / SPACING), round((x - LOW[0]) / SPACING)]
        lines += [
            f'  - {{shape: cylinder, base: {place((x, y, z - ROOT))}, radius: {TRUNK}, '
            f'height: {trunk + ROOT:g}, material: wood}}',
            f'  - {{shape: cylinder, base: {place((x, y, z + trunk))}, radius: {crown:g}, '
            f'height: {top - trunk:g}, material: pine}}',
        ]
    return lines


def files():
    """Names and bytes."""
    land = heights()
    return map_course(
        'tall_pines',
        TEXT,
        land,
        (LOW, HIGH, SPACING),
        zones(),
        tee=list(TEE),
        hole=list(HOLE),
        level=CREEK_LEVEL,
        creek=polygon(creek()),
        trees='\n'.join(trees(land)),
    )
