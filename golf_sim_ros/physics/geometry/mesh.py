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

"""Triangle meshes: thin sheets, hit from both sides unless they are one-sided.

Each triangle is a part. Between coplanar triangles there are seams, no edges: a ball that rolls
off one is put on the plane of the next, which is the same. Parts are numbered depth first along a
bounding volume hierarchy, mesh by mesh.
"""

from math import inf
from typing import Mapping, NamedTuple, Sequence

import numpy as np

from . import surface_protocol
from .bvh import build_bvh, BVH_NODE, leaf_grid, LeafGrid, leaves_between
from .plane_patch import FLUSH, meets, PLANE_ROUNDING, SAME_HEIGHT
from ..jit import kernel
from ..kernel_types import StructRecord, Vector
from ..mechanics.vector import add_scaled, dot, length, load, scale, sub, tangential, unit, ZERO
from ..properties.material import Material

# m: on a border, face, side or corner is decided this far ahead of a moving ball.
MESH_AHEAD = 1e-7
NARROW = 1e-9  # m: the normal of a triangle that is no wider is rounding
TRIANGLE_FACE, CORNER = -1, 3  # feature of a triangle, if not side 0, 1 or 2

TRIANGLE = np.dtype(
    [
        ('corners', 'f8', (3, 3)),
        ('normal', 'f8', 3),
        ('inward', 'f8', (3, 3)),  # of each side: in the plane, as long as the side
        ('material', 'i8'),
        ('one_sided', 'i8'),
        ('leaf', 'i8'),
    ],
    align=True,
)


class Mesh(NamedTuple):
    """Triangles between `vertices`, (n, 3) [m]; rows of `faces`, (m, 3), are numbers of vertices.

    Seen from the front, a one-sided triangle's corners go round counterclockwise.
    """

    vertices: np.ndarray
    faces: np.ndarray
    material: Material = Material()
    one_sided: bool = False


class Meshes(NamedTuple):
    """All meshes of a course: triangles, the nodes of one BVH after the other, their leaves."""

    triangles: np.ndarray
    nodes: np.ndarray
    grid: LeafGrid


def meshes(shapes: Sequence[Mesh], material_number: Mapping[Material, int]) -> Meshes:
    """`Meshes` of `Mesh` records; `material_number` maps a material to its row.

    Raises
    ------
    ValueError
        A face names a vertex that there is not, is not finite, or is no wider than a nanometre.
    """
    triangles, nodes = [np.zeros(0, TRIANGLE)], [np.zeros(0, BVH_NODE)]
    before = above = 0
    for shape in shapes:
        corners = np.asarray(shape.vertices, float).reshape(-1, 3)[checked(shape)]
        a, b, c = corners.transpose(1, 0, 2)
        tree, order = build_bvh(np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
        rows = _rows(corners[order], material_number[shape.material], shape.one_sided)
        leaves = np.flatnonzero(tree['last'] > tree['first'])
        rows['leaf'] = above + np.repeat(leaves, (tree['last'] - tree['first'])[leaves])
        for name in ('first', 'last'):
            tree[name] += before
        tree['skip'] += above
        triangles.append(rows)
        nodes.append(tree)
        before, above = before + len(rows), above + len(tree)
    tree = np.concatenate(nodes)
    return Meshes(np.concatenate(triangles), tree, leaf_grid(tree))


def checked(shape: Mesh) -> np.ndarray:
    """Faces of `shape`, a `Mesh`; ValueError where one can't be used."""
    vertices = np.asarray(shape.vertices, float).reshape(-1, 3)
    faces = np.asarray(shape.faces, np.int64).reshape(-1, 3)
    if len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices):
        raise ValueError(f'a face of a mesh names a vertex out of 0 to {len(vertices) - 1}')
    wide = widths(vertices[faces]) > NARROW  # false for a width that is not a number, too
    if not wide.all():
        raise ValueError(
            f'face {wide.argmin()} of a mesh is not finite, or no wider than {NARROW} m'
        )
    return faces


def widths(corners: np.ndarray) -> np.ndarray:
    """Least widths [m] of the triangles with `corners` (n, 3, 3)."""
    with np.errstate(invalid='ignore', divide='ignore'):
        sides = corners[:, (1, 2, 0)] - corners
        normals = np.cross(sides[:, 0], sides[:, 1])
        areas = np.einsum('ij,ij->i', normals, normals)
        longest = np.einsum('ijk,ijk->ij', sides, sides).max(1)
        return np.where(longest > 0.0, np.sqrt(areas / longest), 0.0)


def _rows(corners: np.ndarray, material: int, one_sided: bool) -> np.ndarray:
    sides = corners[:, (1, 2, 0)] - corners
    # The normal is that of the two shorter sides: of a sliver, the longest adds nothing but
    # rounding.
    longest = np.einsum('ijk,ijk->ij', sides, sides).argmax(1)
    turned = (longest[:, np.newaxis] + np.arange(1, 4)) % 3
    corners = np.take_along_axis(corners, turned[:, :, np.newaxis], 1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1])
    rows = np.zeros(len(corners), TRIANGLE)
    rows['corners'] = corners
    rows['normal'] = normals / np.linalg.norm(normals, axis=1)[:, np.newaxis]
    sides = corners[:, (1, 2, 0)] - corners
    rows['inward'] = np.cross(rows['normal'][:, np.newaxis], sides)
    rows['material'], rows['one_sided'] = material, one_sided
    return rows


@surface_protocol.parts.register(Meshes)
def _parts(kind: Meshes) -> int:
    return len(kind.triangles)


@surface_protocol.next_part.register(Meshes)
def _next_part(kind: Meshes, part: int, low: Vector, high: Vector) -> int:
    # A query resumes at the leaf of `part`, not at the root: a loop over parts is one walk of the
    # tree.
    triangles = len(kind.triangles)
    node = 0
    end = len(kind.nodes) - 1
    if 0 < part < triangles:
        leaf = kind.triangles[part]['leaf']
        last = kind.nodes[leaf]['last']
        while part < last:
            if is_near(kind.triangles[part], low, high):
                return part
            part += 1
        node = leaf + 1
    elif part == 0:
        node, end = leaves_between(kind.grid, low, high)
    while part < triangles and node <= end:
        if not meets(kind.nodes[node], low, high):
            node = kind.nodes[node]['skip']
            continue
        for k in range(kind.nodes[node]['first'], kind.nodes[node]['last']):
            if is_near(kind.triangles[k], low, high):
                return k
        node += 1
    return triangles


@surface_protocol.parts_within.register(Meshes)
def _parts_within(kind: Meshes, low: Vector, high: Vector, most: int) -> tuple[int, int, int]:
    first = last = -1
    count = 0
    node, end = leaves_between(kind.grid, low, high)
    while node <= end and count < most:
        if not meets(kind.nodes[node], low, high):
            node = kind.nodes[node]['skip']
            continue
        for k in range(kind.nodes[node]['first'], kind.nodes[node]['last']):
            if count < most and is_near(kind.triangles[k], low, high):
                first = k if count == 0 else first
                last = k
                count += 1
        node += 1
    return first, last, count


@kernel
def is_near(triangle: StructRecord, low: Vector, high: Vector) -> bool:
    """Whether the triangle may overlap the box from `low` to `high`.

    Neither an axis of the box separates them nor a normal of a side, in the triangle's plane.
    """
    for axis in range(3):
        a = triangle['corners'][0, axis]
        b = triangle['corners'][1, axis]
        c = triangle['corners'][2, axis]
        if low[axis] > max(a, b, c) or high[axis] < min(a, b, c):
            return False
    for i in range(3):
        inward = triangle['inward'][i]
        corner = triangle['corners'][i]
        room = margin = 0.0  # of the box's innermost corner, times the side's length
        for axis in range(3):
            furthest = high[axis] if inward[axis] > 0.0 else low[axis]
            if inward[axis] != 0.0:
                room += inward[axis] * (furthest - corner[axis])
            margin += abs(inward[axis])
        if room < -FLUSH * margin:
            return False
    return True


@kernel
def offset_from(triangle: StructRecord, point: Vector) -> tuple[Vector, int]:
    """Vector to `point` from the triangle's closest point, and that one's feature.

    TRIANGLE_FACE, the number of a side, or CORNER.
    """
    where = TRIANGLE_FACE
    best = ZERO
    least = inf
    for i in range(3):
        start = load(triangle['corners'][i])
        d = sub(point, start)
        if dot(load(triangle['inward'][i]), d) >= 0.0:  # the foot is on the inner side
            continue
        side = sub(load(triangle['corners'][(i + 1) % 3]), start)
        t = min(max(dot(d, side) / dot(side, side), 0.0), 1.0)
        offset = add_scaled(d, -t, side)
        size = dot(offset, offset)
        if size < least:
            least = size
            best = offset
            where = i if 0.0 < t < 1.0 else CORNER
    if where == TRIANGLE_FACE:
        best = scale(height_over(triangle, point), load(triangle['normal']))
    return best, where


@kernel
def height_over(triangle: StructRecord, point: Vector) -> float:
    """Height [m] of `point` over the triangle's plane."""
    return dot(sub(point, load(triangle['corners'][1])), load(triangle['normal']))


@kernel
def beside_triangle(triangle: StructRecord, point: Vector, offset: Vector) -> float:
    """Distance [m], by its `offset`, from the triangle of the foot of `point` in its plane."""
    return length(tangential(offset, load(triangle['normal'])))


@surface_protocol.nearest.register(Meshes)
def _nearest(kind: Meshes, part: int, point: Vector) -> tuple[float, Vector]:
    triangle = kind.triangles[part]
    normal = load(triangle['normal'])
    offset, where = offset_from(triangle, point)
    # A foot within FLUSH of a face counts as on it: rounding between neighbours is no edge.
    if where == TRIANGLE_FACE or beside_triangle(triangle, point, offset) <= FLUSH:
        h = height_over(triangle, point)
        return abs(h), normal if h >= 0.0 else scale(-1.0, normal)
    return length(offset), unit(offset, normal)


@surface_protocol.turn.register(Meshes)
def _turn(kind: Meshes, part: int, point: Vector, velocity: Vector) -> Vector:
    speed = length(velocity)
    if speed == 0.0:
        return ZERO
    triangle = kind.triangles[part]
    _, where = offset_from(triangle, add_scaled(point, MESH_AHEAD / speed, velocity))
    if where == TRIANGLE_FACE:
        return ZERO
    distance, out = surface_protocol.nearest(kind, part, point)
    # Along a side the closest point goes along with the ball, and the normal stays.
    if where != CORNER:
        side = sub(load(triangle['corners'][(where + 1) % 3]), load(triangle['corners'][where]))
        velocity = tangential(velocity, unit(side, ZERO))
    return scale(1.0 / distance, tangential(velocity, out))


@surface_protocol.touchable.register(Meshes)
def _touchable(kind: Meshes, part: int, point: Vector) -> bool:
    return (
        kind.triangles[part]['one_sided'] == 0 or height_over(kind.triangles[part], point) >= 0.0
    )


@surface_protocol.has_relief.register(Meshes)
def _has_relief(kind: Meshes, part: int) -> bool:
    return True


@surface_protocol.flat_under.register(Meshes)
def _flat_under(kind: Meshes, part: int, point: Vector) -> bool:
    return is_over_triangle(kind.triangles[part], point)


@kernel
def is_over_triangle(triangle: StructRecord, point: Vector) -> bool:
    """Whether the foot of `point` in the triangle's plane lies in the triangle."""
    offset, where = offset_from(triangle, point)
    return where == TRIANGLE_FACE or beside_triangle(triangle, point, offset) <= PLANE_ROUNDING


@surface_protocol.is_below_plane.register(Meshes)
def _is_below_plane(kind: Meshes, part: int, point: Vector, normal: Vector) -> bool:
    triangle = kind.triangles[part]
    if (
        abs(dot(load(triangle['normal']), normal)) > 1.0 - 1e-12
        and abs(height_over(triangle, point)) <= SAME_HEIGHT
    ):
        return True
    for i in range(3):
        if dot(sub(load(triangle['corners'][i]), point), normal) > PLANE_ROUNDING:
            return False
    return True


@surface_protocol.form.register(Meshes)
def _form(kind: Meshes, part: int) -> int:
    return surface_protocol.FACE_FORM


@surface_protocol.face_plane.register(Meshes)
def _face_plane(kind: Meshes, part: int, point: Vector) -> tuple[float, Vector]:
    h = height_over(kind.triangles[part], point)
    normal = load(kind.triangles[part]['normal'])
    return abs(h), normal if h >= 0.0 else scale(-1.0, normal)


@surface_protocol.limits.register(Meshes)
def _limits(kind: Meshes, part: int) -> int:
    return 3


@surface_protocol.limit.register(Meshes)
def _limit(kind: Meshes, part: int, i: int) -> tuple[Vector, Vector]:
    triangle = kind.triangles[part]
    return load(triangle['corners'][i]), unit(load(triangle['inward'][i]), ZERO)


@surface_protocol.material_of.register(Meshes)
def _material_of(kind: Meshes, part: int) -> int:
    return kind.triangles[part]['material']


@surface_protocol.top.register(Meshes)
def _top(kind: Meshes, x: float, y: float) -> tuple[float, int]:
    best = -1e300
    who = -1
    low = (x - PLANE_ROUNDING, y - PLANE_ROUNDING, -inf)
    high = (x + PLANE_ROUNDING, y + PLANE_ROUNDING, inf)
    part = surface_protocol.next_part(kind, 0, low, high)
    while part < len(kind.triangles):
        triangle = kind.triangles[part]
        n = triangle['normal']
        if abs(n[2]) > 1e-9:
            corner = triangle['corners'][1]
            z = corner[2] - (n[0] * (x - corner[0]) + n[1] * (y - corner[1])) / n[2]
            if z >= best - SAME_HEIGHT and is_over_triangle(triangle, (x, y, z)):
                best = max(best, z)
                who = part
        part = surface_protocol.next_part(kind, part + 1, low, high)
    return best, who


def plan(shape: Mesh) -> tuple[()]:
    """Outlines in plan: none, for a triangle's own sides are its limits."""
    return ()


def heights(shape: Mesh) -> tuple[float, float]:
    """Least and greatest height of the vertices that belong to faces."""
    z = np.asarray(shape.vertices, float).reshape(-1, 3)[
        np.asarray(shape.faces, np.int64).reshape(-1, 3), 2
    ]
    return float(z.min(initial=inf)), float(z.max(initial=-inf))


SHAPES = (Mesh,)
NUMBERED = 3
build = meshes
