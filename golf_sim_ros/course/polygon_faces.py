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

r"""Triangles of the faces of a mesh file, which may have many corners, be concave, and have holes.

A convex face is a fan. Of any other one ears are cut, as Meisters (1975) and Eberly, Triangulation
by ear clipping, say::

        e-----d            d is an ear of a b c d e: it turns left, and no other
        |    /             corner lies in c d e or on the cut from c to e
        |   c
        |    \
        a-----b

A hole is joined to the outline by a slit, there and back, which is how such files have it; so
corners may coincide. Nothing is added: each triangle's corners are corners of the face.
"""

from collections.abc import Sequence

import numpy as np

FLAT = 1e-14  # of a face's size squared: a triangle of less area is a line


def triangles_of(
    polygons: Sequence[Sequence[int]], vertices: np.ndarray
) -> tuple[np.ndarray, list[int]]:
    """Triangles of `polygons`, and which of these have none.

    A polygon is a sequence of numbers of `vertices` (n, 3).

    Returns
    -------
    faces : ndarray (m, 3) of int
    crossed : list of int
        Numbers of the polygons that cross themselves: they give no triangle.
    """
    sizes = np.array([len(polygon) for polygon in polygons], int)
    found = [np.zeros((0, 3), np.int64)]
    crossed: list[int] = []
    for size in np.unique(sizes):
        numbers = np.flatnonzero(sizes == size)
        same = np.array([polygons[int(i)] for i in numbers], np.int64)
        plain = convex(vertices[same]) if size > 3 else np.ones(len(same), bool)
        found += [same[plain][:, (0, k, k + 1)] for k in range(1, size - 1)]
        for number, polygon in zip(numbers[~plain], same[~plain]):
            ears = ears_of(in_plane(vertices[polygon]))
            if ears is None:
                crossed.append(int(number))
            else:
                found.append(polygon[ears])
    return np.concatenate(found), sorted(crossed)


def normals_of(corners: np.ndarray) -> np.ndarray:
    """Newell's normals of faces with `corners` (m, n, 3): as long as twice the area."""
    around = corners - corners[:, :1]
    return np.cross(around, np.roll(around, -1, 1)).sum(1)


def convex(corners: np.ndarray) -> np.ndarray:
    """Whether a fan covers each of the faces with `corners` (m, n, 3), seen along its normal.

    So it does with a face that is a line: of triangles without area. One that crosses itself has a
    normal of nothing, too.
    """
    normals = normals_of(corners)[:, np.newaxis]
    ahead = np.roll(corners, -1, 1) - corners
    turns = np.einsum('ijk,ijk->ij', np.cross(np.roll(ahead, 1, 1), ahead), normals + 0 * ahead)
    spokes = corners[:, 1:] - corners[:, :1]
    areas = np.einsum(
        'ijk,ijk->ij', np.cross(spokes[:, :-1], spokes[:, 1:]), normals + 0 * spokes[:, 1:]
    )
    least = -FLAT * np.einsum('ijk,ijk->i', normals, normals)[:, np.newaxis]
    fans = np.linalg.norm(np.cross(spokes[:, :-1], spokes[:, 1:]), axis=2).max(1)
    wide = np.linalg.norm(normals[:, 0], axis=1) > 1e-9 * fans
    line = fans <= FLAT * np.ptp(corners, 1).max(1) ** 2
    return line | wide & (turns >= least).all(1) & (areas >= least).all(1)


def in_plane(corners: np.ndarray) -> np.ndarray | None:
    """Corners (n, 2) of a face in its plane, counterclockwise, about 1 in size.

    None of a face without an area, which has no side up.
    """
    size = np.ptp(corners, 0).max()
    normal = normals_of(corners[np.newaxis])[0]
    length = np.linalg.norm(normal)
    if not length > 1e-9 * size * size:
        return None
    normal = normal / length
    across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    across /= np.linalg.norm(across)
    return (corners - corners[0]) @ np.stack((across, np.cross(normal, across)), 1) / size


def ears_of(points: np.ndarray | None) -> np.ndarray | None:
    """Rows of three corners each, that cover the polygon of `points` (n, 2), counterclockwise.

    None where it crosses itself.
    """
    if points is None:
        return None
    ears, ring = [], list(range(len(points)))
    i = since = 0
    while len(ring) >= 3:
        a, b, c = (ring[(i + k) % len(ring)] for k in (-1, 0, 1))
        area = turn(points[a], points[b], points[c])
        if area > FLAT and is_ear(points, ring, a, b, c):
            ears.append((a, b, c))
            ring.remove(b)
            i, since = i + 1, 0  # the next but one: cut all in a row they would be slivers
        elif since > len(ring):
            # All have been tried: a corner on a line, or a slit walked back, is left out.
            line = lines(points, ring)
            if line is None:
                return None
            ring.remove(line)
            since = 0
        else:
            i, since = i + 1, since + 1
        i %= max(len(ring), 1)
    return np.array(ears, np.int64).reshape(-1, 3)


def turn(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    """Twice the area of the triangle, positive where its corners go round counterclockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def turns(a: np.ndarray, b: np.ndarray, points: np.ndarray) -> np.ndarray:
    """`turn` of `a`, `b` and each of `points` (n, 2)."""
    return (b[0] - a[0]) * (points[:, 1] - a[1]) - (b[1] - a[1]) * (points[:, 0] - a[0])


def is_ear(points: np.ndarray, ring: list[int], a: int, b: int, c: int) -> bool:
    """Whether no corner of the `ring` lies in the triangle, or on the cut from `c` to `a`.

    What lies on the other two sides, as each corner and what coincides with one, does not count.
    """
    others = points[ring]
    p, q, r = points[a], points[b], points[c]
    inside = (
        (turns(p, q, others) > FLAT)
        & (turns(q, r, others) > FLAT)
        & (turns(r, p, others) >= -FLAT)
    )
    return not bool(inside.any())


def lines(points: np.ndarray, ring: list[int]) -> int | None:
    """Find the first of the `ring` at which it goes straight on, or back.

    None where it nowhere does.
    """
    corners = points[ring]
    before, after = np.roll(corners, 1, 0), np.roll(corners, -1, 0)
    way, on = (corners - before).T, (after - before).T
    areas = way[0] * on[1] - way[1] * on[0]
    flat = np.flatnonzero(np.abs(areas) <= FLAT)
    return ring[flat[0]] if len(flat) else None
