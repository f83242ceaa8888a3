# SPDX-License-Identifier: Apache-2.0
"""Triangles of the ground in the colours of its zones, for display."""
from math import ceil, sqrt

import numpy as np

from .slabs import sides, triangles

MOST_CELLS = 20000  # of a height map that are drawn: a message of about 3 MB


def flat(outline, cuts, material, zones):
    """Pairs of a material and its triangles of (x, y): `outline` without `cuts`, painted with `zones`."""
    found = [(material, triangles(outline, [*cuts, *(polygon for _, polygon in zones)]))]
    for number, (paint, polygon) in enumerate(zones):
        later = [over for _, over in zones[number + 1:]]
        hiding = [cut for cut in (*cuts, *later) if boxes_meet(cut, polygon)]
        found.append((paint, triangles(polygon, hiding, outline)))
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
    for number, (_, polygon) in enumerate(zones):
        numbers[holds(polygon, x, y)] = number
    return numbers


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
