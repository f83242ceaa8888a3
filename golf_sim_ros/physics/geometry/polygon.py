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

"""Polygons in plan: point queries on a table of corners."""

from math import inf, sqrt
from typing import Iterable, NamedTuple, Sequence

import numpy as np

from ..jit import kernel, shared
from ..kernel_types import Vector

# corners x, y of a polygon in plan, in their order
Outline = Sequence[Sequence[float]]


OUTSIDE = 1e-6  # m: no rounding takes a point so far outside of all corners for one inside


class Polygons(NamedTuple):
    """Polygons in one table: ``corners[first[i]:first[i + 1]]`` are those of polygon i.

    It lies within ``boxes[i]``: least x and y, greatest x and y.
    """

    corners: np.ndarray
    first: np.ndarray
    boxes: np.ndarray


class Regions(NamedTuple):
    """Polygons with holes.

    Those of outline i are cuts ``first_cut[i]`` to before ``first_cut[i + 1]``.
    """

    outlines: Polygons
    cuts: Polygons
    first_cut: np.ndarray


class Circle(NamedTuple):
    """Round outline in plan."""

    x: float
    y: float
    radius: float


def polygons(outlines: Sequence[Outline]) -> Polygons:
    """`Polygons` of sequences of (x, y)."""
    first = np.cumsum([0] + [len(outline) for outline in outlines]).astype(np.int64)
    corners = np.array([c for outline in outlines for c in outline], float).reshape(-1, 2)
    boxes = [
        (*np.min(outline, 0) - OUTSIDE, *np.max(outline, 0) + OUTSIDE) for outline in outlines
    ]
    return Polygons(corners, first, np.array(boxes, float).reshape(-1, 4))


def regions(outlines: Sequence[Outline], cuts: Sequence[Sequence[Outline]]) -> Regions:
    """`Regions` of sequences of (x, y), and for each of them a sequence of such sequences."""
    first = np.cumsum([0] + [len(own) for own in cuts]).astype(np.int64)
    return Regions(polygons(outlines), polygons([cut for own in cuts for cut in own]), first)


def sides(outline: Outline) -> Iterable[tuple[Sequence[float], Sequence[float]]]:
    """Pairs of neighbouring corners, the last with the first."""
    return zip(outline, tuple(outline[1:]) + tuple(outline[:1]))


@kernel
def beside(table: Polygons, i: int, x: float, y: float) -> float:
    """Distance [m] of the point from polygon `i`, 0 inside."""
    return 0.0 if inside(table, i, x, y) else from_sides(table, i, x, y)


@kernel
def from_sides(table: Polygons, i: int, x: float, y: float) -> float:
    """Distance [m] of the point from the nearest side of polygon `i`."""
    best = inf
    first = table.first[i]
    last = table.first[i + 1]
    j = last - 1
    for k in range(first, last):
        ax = table.corners[j, 0]
        ay = table.corners[j, 1]
        ex = table.corners[k, 0] - ax
        ey = table.corners[k, 1] - ay
        t = min(max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0), 1.0)
        dx = x - ax - t * ex
        dy = y - ay - t * ey
        best = min(best, sqrt(dx * dx + dy * dy))
        j = k
    return best


@kernel
def inside(table: Polygons, i: int, x: float, y: float) -> bool:
    """Whether polygon `i` contains the point, by the even-odd rule."""
    box = table.boxes[i]
    if not (box[0] <= x <= box[2] and box[1] <= y <= box[3]):
        return False
    odd = False
    first = table.first[i]
    last = table.first[i + 1]
    j = last - 1
    for k in range(first, last):
        ax = table.corners[k, 0]
        ay = table.corners[k, 1]
        bx = table.corners[j, 0]
        by = table.corners[j, 1]
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            odd = not odd
        j = k
    return odd


@shared
def contains_box(table: Polygons, i: int, low: Vector, high: Vector) -> bool:
    """Whether polygon `i` contains all of a box in plan: no side meets it, and a corner is in."""
    box = table.boxes[i]
    if not (box[0] <= low[0] and high[0] <= box[2] and box[1] <= low[1] and high[1] <= box[3]):
        return False
    x, y = 0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])
    half_x, half_y = 0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1])
    first = table.first[i]
    last = table.first[i + 1]
    j = last - 1
    for k in range(first, last):
        ax = table.corners[j, 0] - x
        ay = table.corners[j, 1] - y
        bx = table.corners[k, 0] - x
        by = table.corners[k, 1] - y
        apart = (
            min(ax, bx) > half_x
            or max(ax, bx) < -half_x
            or min(ay, by) > half_y
            or max(ay, by) < -half_y
            or abs(ax * by - ay * bx) > half_x * abs(by - ay) + half_y * abs(bx - ax)
        )
        if not apart:
            return False
        j = k
    return inside(table, i, low[0], low[1])


@kernel
def in_region(table: Regions, i: int, x: float, y: float) -> bool:
    """Whether region `i` contains the point."""
    if not inside(table.outlines, i, x, y):
        return False
    for k in range(table.first_cut[i], table.first_cut[i + 1]):
        if inside(table.cuts, k, x, y):
            return False
    return True


@kernel
def beside_region(table: Regions, i: int, x: float, y: float) -> float:
    """Lower bound [m] on the distance of the point from region `i`; 0 inside, and only there."""
    away = beside(table.outlines, i, x, y)
    for k in range(table.first_cut[i], table.first_cut[i + 1]):
        if inside(table.cuts, k, x, y):
            away = max(away, from_sides(table.cuts, k, x, y))
    return away
