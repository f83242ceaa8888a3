# SPDX-License-Identifier: Apache-2.0
"""Triangles of the ground in the colours of its zones, for display."""
from math import ceil, sqrt

import numpy as np

from .physics.ground.zone import zones_of
from .slabs import sides, triangles

MOST_CELLS = 20000  # of a height map that are drawn: a message of about 3 MB


def flat(outline, cuts, material, zones):
    """Pairs of a material and its triangles of (x, y): `outline` without `cuts`, painted with `zones`."""
    zones = zones_of(zones)
    found = [(material, triangles(outline, cuts, regions=[(zone.polygon, zone.cut) for zone in zones]))]
    for number, (paint, polygon, own) in enumerate(zones):
        later = [(zone.polygon, zone.cut) for zone in zones[number + 1:] if boxes_meet(zone.polygon, polygon)]
        hiding = [cut for cut in (*cuts, *own) if boxes_meet(cut, polygon)]
        found.append((paint, triangles(polygon, hiding, outline, later)))
    return found


def boxes_meet(one, other):
    """Whether the upright rectangles around two polygons meet."""
    (low, high), (other_low, other_high) = ((np.min(p, 0), np.max(p, 0)) for p in (one, other))
    return bool((low <= other_high).all() and (other_low <= high).all())


def curved(corners, material, zones):
    """Pairs of a material and its triangles: each of `corners`, (n, 3, 3), is painted as its middle."""
    corners = np.asarray(corners, float)
    paint = last_zone(zones, *corners[..., :2].mean(1).T)
    return [(zones[number][0] if number >= 0 else material, corners[paint == number])
            for number in np.unique(paint)]


def last_zone(zones, x, y):
    """Number of the last of `zones` that holds each place; -1 where there is none."""
    numbers = np.full(len(x), -1)
    for number, zone in enumerate(zones_of(zones)):
        numbers[in_region(zone.polygon, zone.cut, x, y)] = number
    return numbers


def in_region(polygon, cuts, x, y):
    """Whether `polygon`, without `cuts`, holds each place."""
    return holds(polygon, x, y) & ~np.any([holds(cut, x, y) for cut in cuts], axis=0)


def holds(polygon, x, y):
    """Whether `polygon` holds each place: a ray to the right leaves it an odd number of times."""
    odd = np.zeros(len(x), bool)
    for (ax, ay), (bx, by) in sides(polygon):
        crossed = (ay > y) != (by > y)
        odd[crossed] ^= x[crossed] < ax + (bx - ax) * (y[crossed] - ay) / (by - ay)
    return odd


def cells(heights, origin, spacing):
    """Triangles (n, 3, 3) of a height map, two a cell; of a large one, of every second or third height."""
    heights = np.asarray(heights, float)
    ny, nx = heights.shape
    stride = max(1, ceil(sqrt((ny - 1) * (nx - 1) / MOST_CELLS)))
    rows, columns = (np.unique([*range(0, n, stride), n - 1]) for n in (ny, nx))
    x, y = np.meshgrid(origin[0] + columns * spacing, origin[1] + rows * spacing)
    grid = np.stack((x, y, heights[np.ix_(rows, columns)]), -1)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    return np.stack((np.stack((a, b, c), 2), np.stack((a, c, d), 2)), 2).reshape(-1, 3, 3)
