# SPDX-License-Identifier: Apache-2.0
"""A polygon with holes, cut into triangles."""
from math import isclose


def triangles(outline, cuts=(), window=None, regions=()):
    """Triangles, tuples of three (x, y) counterclockwise, that cover `outline` except for `cuts`.

    With a `window`, only what lies in that polygon, too. `regions` are cuts with holes: pairs of an outline
    and a sequence of polygons.

    The plane is sliced into slabs at the y of every corner and crossing. Within a slab no two edges
    cross, so the pieces between neighbouring edges are trapezoids, each all inside or all outside::

        y1 ----/----\\--------/---
              / kept \\  cut  / kept
        y0 --/--------\\----/-----

    Polygons are tuples of (x, y) in either direction; they may be concave and overlap each other.
    """
    kept, gone = [tuple(outline), *([tuple(window)] if window else [])], [tuple(cut) for cut in cuts]
    holed = [(tuple(cut), [tuple(hole) for hole in holes]) for cut, holes in regions]
    parts = (*kept, *gone, *(polygon for cut, holes in holed for polygon in (cut, *holes)))
    edges = [edge for polygon in parts for edge in sides(polygon)]
    levels = sorted({y for a, b in edges for y in (a[1], b[1])} | set(crossings(edges)))
    found = []
    for low, high in zip(levels, levels[1:]):
        for piece in trapezoids(edges, low, high):
            place = middle(piece)
            if (all(inside(place, p) for p in kept) and not any(inside(place, p) for p in gone)
                    and not any(holds(place, *region) for region in holed)):
                found.extend(halves(piece))
    return found


def sides(polygon):
    """Edges of `polygon`, pairs of corners."""
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def crossings(edges):
    """The y at which two of `edges` cross."""
    for i, (a, b) in enumerate(edges):
        for c, d in edges[:i]:
            bend = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
            if bend == 0.0:
                continue
            part = ((c[0] - a[0]) * (d[1] - c[1]) - (c[1] - a[1]) * (d[0] - c[0])) / bend
            other = ((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / bend
            if 0.0 < part < 1.0 and 0.0 < other < 1.0:
                yield a[1] + part * (b[1] - a[1])


def trapezoids(edges, low, high):
    """Pieces of the slab from `low` to `high` between neighbours of the `edges` that pass through it.

    A piece is (left at low, right at low, right at high, left at high).
    """
    through = sorted((at(edge, 0.5 * (low + high)), at(edge, low), at(edge, high)) for edge in edges
                     if min(edge[0][1], edge[1][1]) <= low and max(edge[0][1], edge[1][1]) >= high)
    for (left, *a), (right, *b) in zip(through, through[1:]):
        if not isclose(left, right, rel_tol=1e-12, abs_tol=1e-12):
            yield (a[0], low), (b[0], low), (b[1], high), (a[1], high)


def at(edge, y):
    """The x of `edge` at `y`."""
    (x0, y0), (x1, y1) = edge
    return x0 + (x1 - x0) * (y - y0) / (y1 - y0)


def middle(piece):
    """Mean of the corners."""
    return sum(x for x, _ in piece) / len(piece), sum(y for _, y in piece) / len(piece)


def inside(point, polygon):
    """Whether `point` lies in `polygon`: a ray to the right leaves it an odd number of times."""
    x, y = point
    return sum((a[1] > y) != (b[1] > y) and x < at((a, b), y) for a, b in sides(polygon)) % 2 == 1


def holds(point, outline, holes):
    """Whether `point` lies in `outline` and in none of its `holes`."""
    return inside(point, outline) and not any(inside(point, hole) for hole in holes)


def halves(piece):
    """The two triangles of a trapezoid, or the one that is left where a side has no length."""
    a, b, c, d = piece
    return [corners for corners in ((a, b, c), (a, c, d)) if len(set(corners)) == 3]
