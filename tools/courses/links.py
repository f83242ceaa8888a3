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

"""A par 4 between dunes: everything is one height map, painted with zones."""

from random import Random

import numpy as np

from .landform import along, band, bump, ellipse, grid, inland, plateau, smooth, waves
from .writing import map_course, place, polygon, rectangle, rounded

LOW, HIGH, SPACING = (-20.0, -60.0), (380.0, 60.0), 1.0
SHORE = 12.0  # m from the map's outline to where the dunes are at their full height
TEE, HOLE = (0.0, 0.0), (346.0, 9.0)
# the fairway's middle, then the green
WAY = [(0.0, 0.0), (120.0, -6.0), (240.0, 10.0), (330.0, 8.0)]
TEE_HEIGHT, GREEN_HEIGHT = 3.0, 1.6
TEEING, TEE_SLOPE = (7.0, 6.0), 14.0
GREEN, GREEN_RADII, GREEN_SLOPE = (344.0, 8.0), (14.0, 11.0), 12.0
BUNKERS = [  # middle, radii of the hollow, heading, depth [m]
    ((222.0, -12.0), (9.0, 6.0), 0.4, 1.1),
    ((252.0, 30.0), (10.0, 6.5), -0.3, 1.2),
    ((325.0, -6.0), (8.0, 6.0), 0.8, 1.3),
    ((343.0, 26.5), (9.0, 6.0), 0.1, 1.2),
    ((364.0, 0.0), (6.5, 8.0), 0.0, 1.1),
]
SAND = 0.72  # of a hollow's radii that are sand
POND, POND_RADII, POND_DEPTH, POND_LEVEL = (150.0, -34.0), (26.0, 15.0), 2.6, -0.1
TREES, TREE_SEED = 14, 7
FOOT = 0.5  # m of a trunk that are in the ground
WOODS = [((60.0, 38.0), (30.0, 10.0)), ((185.0, 42.0), (32.0, 9.0)), ((290.0, -40.0), (34.0, 9.0))]

# Courses are known by the digest of their files, so that the bytes of these stay.
TEXT = """\
# A par 4 of 346 m between dunes, in one height map of 400 x 120 m: over rough to a fairway that bends, with a
# pond to its right, bunkers where drives and approaches end, and a green with a tier.
# The wind over it was solved for, with its dunes and trees: links_wind.npz.
# Made by tools/make_courses.py, its wind by tools/make_wind_fields.py; change it there.
format: 1
name: Links
tee: {tee}
hole: {hole}
flagstick: true
bounds: [[-14, -54], [374, -54], [374, 54], [-14, 54]]
wind_field: links_wind.npz

ground:
  # Level ground around the heights, whose outline lies at 0, too.
  - shape: plane
    material: rough
    cut:
      - {outline}
  - {{shape: heightmap, heights: links.npy, origin: {low}, spacing: {spacing}, material: rough}}

zones:
{zones}

water:
  - level: {level}
    polygon: {pond}

obstacles:
{trees}
"""  # noqa: E501


def heights():
    """Heights [m], rows along x."""
    x, y = grid(LOW, HIGH, SPACING)
    aside = np.abs(y - along(x, WAY))
    wild = 0.25 + 0.75 * smooth((aside - 14.0) / 22.0)  # dunes are flattened where one plays
    land = 0.9 + 1.9 * wild * waves(x, y, 3, (38.0, 90.0), 9) + 1.6 * smooth((aside - 20.0) / 25.0)
    land = raised(land, plateau(x, y, TEE, TEEING, TEE_SLOPE), TEE_HEIGHT)
    land = raised(land, plateau(x, y, POND, POND_RADII, 14.0), 0.3)
    land = raised(land, plateau(x, y, GREEN, GREEN_RADII, GREEN_SLOPE), green(x, y))
    for middle, radii, heading, depth in BUNKERS:
        land = land - depth * bump(x, y, middle, radii, heading)
    land = land - POND_DEPTH * bump(x, y, POND, POND_RADII)
    return rounded(land * inland(x, y, LOW, HIGH, SHORE))


def raised(land, share, height):
    """`land` that is brought to `height` where `share` is 1."""
    return land + share * (height - land)


def green(x, y):
    """Heights of the green: it rises to the back, with a tier, and falls to one side."""
    dx, dy = x - GREEN[0], y - GREEN[1]
    return GREEN_HEIGHT + 0.012 * dx - 0.008 * dy + 0.18 * smooth((dx + 0.3 * dy - 3.0) / 9.0)


def zones():
    """Materials and polygons, later over earlier."""
    found = [
        ('fairway', band([(70.0, along(70.0, WAY)), *WAY[1:]], 14.0, 10.0)),
        ('fairway', ellipse(GREEN, (GREEN_RADII[0] + 3.0, GREEN_RADII[1] + 3.0), corners=32)),
        ('green', ellipse(GREEN, GREEN_RADII, corners=32)),
        ('tee', rectangle((-5.0, -4.0), (5.0, 4.0))),
    ]
    sand = [
        ('sand', ellipse(middle, (SAND * radii[0], SAND * radii[1]), heading))
        for middle, radii, heading, _ in BUNKERS
    ]
    return found + sand


def trees(land):
    """Trunks and crowns that stand on `land`, `heights()`: lines of YAML."""
    random, lines = Random(TREE_SEED), []
    for i in range(TREES):
        middle, reach = WOODS[i % len(WOODS)]
        x, y = (round(m + random.uniform(-r, r), 1) for m, r in zip(middle, reach))
        trunk, crown = round(random.uniform(3.0, 4.5), 1), round(random.uniform(2.0, 3.2), 1)
        z = land[round((y - LOW[1]) / SPACING), round((x - LOW[0]) / SPACING)]
        base, center = place((x, y, z - FOOT)), place((x, y, z + trunk + 0.6 * crown))
        lines += [
            f'  - {{shape: cylinder, base: {base}, radius: 0.2, height: {trunk + FOOT:g}, '
            'material: wood}',
            f'  - {{shape: sphere, center: {center}, radius: {crown:g}, material: leaves}}',
        ]
    return lines


def files():
    """Names and bytes."""
    land = heights()
    return map_course(
        'links',
        TEXT,
        land,
        (LOW, HIGH, SPACING),
        zones(),
        tee=list(TEE),
        hole=list(HOLE),
        level=POND_LEVEL,
        pond=polygon(ellipse(POND, POND_RADII)),
        trees='\n'.join(trees(land)),
    )
