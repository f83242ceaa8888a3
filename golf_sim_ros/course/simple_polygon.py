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

r"""Whether a polygon crosses or touches itself, in n log n: the sweep of Shamos and Hoey (1976).

A line goes over the plane from left to right and keeps the sides that it cuts in order from below.
Two that meet are neighbours in that order before they do, so only neighbours are compared, when
they become so::

            \   /            order at | :  c, b, a
        a----\-|/----
        b-----\|             a new side is compared with the one
        c------|\---         below and the one above it
"""

from collections.abc import Sequence

Point = tuple[float, float]
Side = tuple[Point, Point]  # its left end comes first


def crossing(corners: Sequence[Point]) -> tuple[int, int] | None:
    """Find two sides that share more than the corner between neighbours; None without any.

    Returns their numbers. `corners`: (x, y), no two the same in a row. Side i goes from corner i
    to the next one.
    """
    sides = [(a, b) if a <= b else (b, a) for a, b in zip(corners, [*corners[1:], *corners[:1]])]
    twice = same_corner(corners)
    if twice:
        return twice
    ends = sorted(
        [(side[0], 0, number) for number, side in enumerate(sides)]
        + [(side[1], 1, number) for number, side in enumerate(sides)]
    )
    order: list[int] = []  # numbers of the sides that the line cuts, from below
    # At one point begins come before ends, so what touches there is seen.
    for point, is_end, number in ends:
        at = (
            place_of(point, order, sides, number)
            if is_end
            else place_in(point, sides[number], order, sides)
        )
        if is_end:
            del order[at]
            pairs = [(at - 1, at)]
        else:
            order.insert(at, number)
            pairs = [(at - 1, at), (at, at + 1)]
        for low, high in pairs:
            if 0 <= low and high < len(order) and meet(order[low], order[high], corners):
                return min(order[low], order[high]), max(order[low], order[high])
    return None


def same_corner(corners: Sequence[Point]) -> tuple[int, int] | None:
    """Sides that begin where the polygon has been before."""
    known: dict[Point, int] = {}
    for number, corner in enumerate(corners):
        if corner in known:
            return known[corner], number
        known[corner] = number
    return None


def place_in(point: Point, side: Side, order: list[int], sides: list[Side]) -> int:
    """Where in the `order` a side that begins at `point` belongs."""
    low, high = 0, len(order)
    while low < high:
        middle = (low + high) // 2
        other = sides[order[middle]]
        above = turn(*other, point) or turn(*other, side[1])
        if above > 0:
            low = middle + 1
        else:
            high = middle
    return low


def place_of(point: Point, order: list[int], sides: list[Side], number: int) -> int:
    """Where in the `order` the side that ends at `point` is."""
    low, high = 0, len(order)
    while low < high:
        middle = (low + high) // 2
        if turn(*sides[order[middle]], point) > 0:
            low = middle + 1
        else:
            high = middle
    while low < len(order) and order[low] != number and turn(*sides[order[low]], point) == 0:
        low += 1
    return low if low < len(order) and order[low] == number else order.index(number)


def meet(i: int, j: int, corners: Sequence[Point]) -> bool:
    """Whether sides `i` and `j` share more than the corner between neighbours."""
    n = len(corners)
    a, b, c, d = corners[i], corners[(i + 1) % n], corners[j], corners[(j + 1) % n]
    if b == c or d == a:
        corner, one, other = (b, a, d) if b == c else (a, b, c)
        return turn(one, corner, other) == 0 and any(
            (p - o) * (q - o) > 0 for p, q, o in zip(one, other, corner)
        )
    apart = any(
        max(a[k], b[k]) < min(c[k], d[k]) or max(c[k], d[k]) < min(a[k], b[k]) for k in (0, 1)
    )
    return not apart and turn(a, b, c) * turn(a, b, d) <= 0 and turn(c, d, a) * turn(c, d, b) <= 0


def turn(a: Point, b: Point, c: Point) -> int:
    """Tell how the way from `a` over `b` to `c` turns: 1 left, -1 right, 0 not at all."""
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (area > 0) - (area < 0)
