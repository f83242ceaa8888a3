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

"""Triangulation of polygons with holes."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from math import isclose

Point = Sequence[float]  # x, y
Polygon = Sequence[Point]
Edge = tuple[Point, Point, int]  # from low to high, and the number of its polygon
Crossing = tuple[float, float, float, int]  # of an edge and a slab: see `slabs`


def triangles(
    outline: Polygon,
    cuts: Iterable[Polygon] = (),
    window: Polygon | None = None,
    regions: Iterable[tuple[Polygon, Sequence[Polygon]]] = (),
) -> list[tuple[Point, Point, Point]]:
    r"""Triangles, tuples of three (x, y) counterclockwise, that cover `outline` but not `cuts`.

    With a `window`, only what lies in that polygon, too. `regions` are cuts with holes: pairs of
    an outline and a sequence of polygons.

    The plane is sliced into slabs at the y of every corner and crossing. Within a slab no two
    edges cross, so the parts between neighbouring edges are trapezoids, each all inside or all
    outside::

        y1 ----/----\--------/---
              / kept \  cut  / kept
        y0 --/--------\----/-----

    Polygons are tuples of (x, y) in either direction; they may be concave and overlap each other.
    """
    state = Inside(
        [outline, *([window] if window else [])],
        [*((cut, ()) for cut in cuts), *((cut, holes) for cut, holes in regions)],
    )
    edges: list[Edge] = [
        (*upward(edge), owner)
        for owner, polygon in enumerate(state.polygons)
        for edge in sides(polygon)
        if edge[0][1] != edge[1][1]
    ]
    levels = sorted({y for polygon in state.polygons for _, y in polygon} | set(crossings(edges)))
    found = []
    for low, high, through in slabs(edges, levels):
        for piece in state.kept_of(through):
            (a, d), (b, c) = piece
            found.extend(halves((a, low), (b, low), (c, high), (d, high)))
    return found


class Inside:
    """Which polygons a place is in, on its way from left to right through a slab.

    `kept`: polygons that it must be in; `gone`: pairs of a polygon and its holes, in none of which
    it may be.
    """

    def __init__(
        self, kept: Sequence[Polygon], gone: Iterable[tuple[Polygon, Sequence[Polygon]]]
    ) -> None:
        self.kept = len(kept)
        self.polygons = [tuple(polygon) for polygon in kept]
        # Of each polygon, the number of the pair it belongs to.
        self.region: list[int | None] = [None] * self.kept
        for number, (cut, holes) in enumerate(gone):
            self.polygons += [tuple(cut), *(tuple(hole) for hole in holes)]
            self.region += [number] * (1 + len(holes))
        self.first = {number: owner for owner, number in reversed(list(enumerate(self.region)))}

    def kept_of(self, through: list[Crossing]) -> Iterator[tuple[list[float], list[float]]]:
        """Pairs of neighbouring edges of a slab, between which it is kept.

        Of each edge x at its low and at its high end.
        """
        odd: set[int] = set()
        covered: set[int] = set()
        holes: Counter[int] = Counter()
        kept = 0
        for (_, *left, owner), (_, *right, _) in zip(through, through[1:]):
            odd ^= {owner}
            step, number = (1 if owner in odd else -1), self.region[owner]
            if number is None:
                kept += step
            elif owner != self.first[number]:
                holes[number] += step
            if number is not None:
                covers = self.first[number] in odd and holes[number] == 0
                (covered.add if covers else covered.discard)(number)
            if (
                kept == self.kept
                and not covered
                and not isclose(sum(left), sum(right), rel_tol=1e-12, abs_tol=2e-12)
            ):
                yield left, right


def sides(polygon: Polygon) -> list[tuple[Point, Point]]:
    """Edges of `polygon`, pairs of corners."""
    return list(zip(polygon, [*polygon[1:], *polygon[:1]]))


def upward(edge: tuple[Point, Point]) -> tuple[Point, Point]:
    """`edge` from its lower to its upper end."""
    low, high = edge
    return (low, high) if low[1] < high[1] else (high, low)


def crossings(edges: Iterable[Edge]) -> Iterator[float]:
    """Yield the y at which two of `edges`, from low to high, cross."""
    active: list[Edge] = []
    for edge in sorted(edges, key=lambda edge: edge[0][1]):
        a, b, _ = edge
        active = [other for other in active if other[1][1] > a[1]]
        left, right = min(a[0], b[0]), max(a[0], b[0])
        for c, d, _ in active:
            if max(c[0], d[0]) < left or min(c[0], d[0]) > right:
                continue
            bend = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
            if bend == 0.0:
                continue
            part = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / bend
            theirs = ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / bend
            if 0.0 < part < 1.0 and 0.0 < theirs < 1.0:
                yield a[1] + part * (b[1] - a[1])
        active.append(edge)


def slabs(
    edges: Iterable[Edge], levels: list[float]
) -> Iterator[tuple[float, float, list[Crossing]]]:
    """Each slab between two neighbours of `levels`, and the edges through it from left to right.

    An edge is (x in the middle of the slab, x at its low end, x at its high end, owner).
    """
    begin, waiting = 0, sorted(edges, key=lambda edge: edge[0][1])
    active: list[Edge] = []
    for low, high in zip(levels, levels[1:]):
        while begin < len(waiting) and waiting[begin][0][1] <= low:
            active.append(waiting[begin])
            begin += 1
        active = [edge for edge in active if edge[1][1] >= high]
        middle = 0.5 * (low + high)
        through = [(at(edge, middle), at(edge, low), at(edge, high), edge[2]) for edge in active]
        yield low, high, sorted(through)


def at(edge: Edge, y: float) -> float:
    """Find the x of `edge` at `y`."""
    (x0, y0), (x1, y1), *_ = edge
    return x0 + (x1 - x0) * (y - y0) / (y1 - y0)


def halves(a: Point, b: Point, c: Point, d: Point) -> list[tuple[Point, Point, Point]]:
    """Part a trapezoid into two triangles, or the one that is left where a side has no length."""
    return [corners for corners in ((a, b, c), (a, c, d)) if len(set(corners)) == 3]
