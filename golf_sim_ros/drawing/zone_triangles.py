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

"""Triangles of the ground in the colours of its zones, for display."""

from collections.abc import Iterable, Sequence
from math import ceil, sqrt
from typing import Any

import numpy as np

from .parted_triangles import boxes, parted_along
from .polygon_triangles import Polygon, sides, triangles
from ..physics import Material
from ..physics.geometry.zone import places_inside, zones_of

FEW = 20  # zones on a tile; fewer on all of a surface are drawn at once
MOST_CELLS = 20000  # of a height map that are drawn: a message of about 3 MB


def flat(
    outline: Polygon, cuts: Sequence[Polygon], material: Material, zones: Sequence[Any]
) -> list[tuple[Material, list[tuple]]]:
    """Paint `outline`, without `cuts`, with `zones`.

    Returns pairs of a material and its triangles of (x, y).
    """
    zones = zones_of(zones)
    near = Boxes([zone.polygon for zone in zones])
    base: list[tuple] = []
    for tile in tiles(outline, len(zones)):
        base += triangles(
            tile, cuts, outline, [(zones[i].polygon, zones[i].cut) for i in near.to(tile)]
        )
    found: list[tuple[Material, list[tuple]]] = [(material, base)]
    for number, (paint, polygon, own) in enumerate(zones):
        later = [(zones[i].polygon, zones[i].cut) for i in near.to(polygon, number + 1)]
        hiding = [cut for cut in (*cuts, *own) if boxes_meet(cut, polygon)]
        found.append((paint, triangles(polygon, hiding, outline, later)))
    return found


def tiles(outline: Polygon, count: int) -> list[Polygon]:
    """Rectangles that cover `outline`, so small that a few of `count` polygons lie in each."""
    n = ceil(sqrt(count / FEW))
    if n <= 1:
        return [outline]
    x, y = (
        np.linspace(low, high, n + 1).tolist()
        for low, high in zip(np.min(outline, 0), np.max(outline, 0))
    )
    return [
        ((x[i], y[k]), (x[i + 1], y[k]), (x[i + 1], y[k + 1]), (x[i], y[k + 1]))
        for i in range(n)
        for k in range(n)
    ]


class Boxes:
    """Upright rectangles around `polygons`."""

    def __init__(self, polygons: Sequence[Polygon]) -> None:
        self.low = np.array([np.min(polygon, 0) for polygon in polygons]).reshape(-1, 2)
        self.high = np.array([np.max(polygon, 0) for polygon in polygons]).reshape(-1, 2)

    def to(self, polygon: Polygon, first: int = 0) -> list[int]:
        """Numbers, from `first` on, of those that meet the rectangle around `polygon`."""
        low, high = np.min(polygon, 0), np.max(polygon, 0)
        near = (low <= self.high[first:]).all(1) & (self.low[first:] <= high).all(1)
        return (first + np.flatnonzero(near)).tolist()


def boxes_meet(one: Polygon, other: Polygon) -> bool:
    """Whether the upright rectangles around two polygons meet."""
    (low, high), (other_low, other_high) = ((np.min(p, 0), np.max(p, 0)) for p in (one, other))
    return bool((low <= other_high).all() and (other_low <= high).all())


def curved(
    corners: np.ndarray, material: Material, zones: Sequence[Any]
) -> list[tuple[Material, np.ndarray]]:
    """Paint triangles (n, 3, 3), `corners`, with `zones`, along whose edges they are cut.

    Returns pairs of a material and its triangles.
    """
    corners = np.asarray(corners, float)
    for zone in zones_of(zones):
        for polygon in (zone.polygon, *zone.cut):
            corners = parted_around(corners, polygon)
    paint = last_zone(zones, *corners[..., :2].mean(1).T)
    return [
        (zones[number][0] if number >= 0 else material, corners[paint == number])
        for number in np.unique(paint)
    ]


def parted_around(corners: np.ndarray, polygon: Polygon) -> np.ndarray:
    """Triangles (n, 3, 3), those cut through which an edge of `polygon` goes."""
    least, most = boxes(corners)
    near = ((least <= np.max(polygon, 0)) & (np.min(polygon, 0) <= most)).all(1)
    pieces = corners[near]
    for start, end in sides(polygon):
        pieces = parted_along(pieces, start, end)
    return np.concatenate([corners[~near], pieces])


def last_zone(zones: Sequence[Any], x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Find the number of the last of `zones` that holds each place; -1 where there is none."""
    numbers = np.full(len(x), -1)
    for number, zone in enumerate(zones_of(zones)):
        (left, front), (right, back) = np.min(zone.polygon, 0), np.max(zone.polygon, 0)
        near = np.flatnonzero((left <= x) & (x <= right) & (front <= y) & (y <= back))
        numbers[near[in_region(zone.polygon, zone.cut, x[near], y[near])]] = number
    return numbers


def in_region(
    polygon: Polygon, cuts: Iterable[Polygon], x: np.ndarray, y: np.ndarray
) -> np.ndarray:
    """Whether `polygon`, without `cuts`, holds each place."""
    return places_inside(polygon, x, y) & ~np.any(
        [places_inside(cut, x, y) for cut in cuts], axis=0
    )


def cells(heights: Any, origin: Sequence[float], spacing: float) -> np.ndarray:
    """Triangles (n, 3, 3) of a height map, two a cell.

    Of a large one, of every second or third height.
    """
    heights = np.asarray(heights, float)
    ny, nx = heights.shape
    stride = max(1, ceil(sqrt((ny - 1) * (nx - 1) / MOST_CELLS)))
    rows, columns = (np.unique([*range(0, n, stride), n - 1]) for n in (ny, nx))
    return sheet(
        origin[0] + columns * spacing, origin[1] + rows * spacing, heights[np.ix_(rows, columns)]
    )


def sheet(x: np.ndarray, y: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Triangles (n, 3, 3) of `heights` at `x`, `y`: two for each cell between them."""
    grid = np.stack((*np.meshgrid(x, y), heights), -1)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    return np.stack((np.stack((a, b, c), 2), np.stack((a, c, d), 2)), 2).reshape(-1, 3, 3)
