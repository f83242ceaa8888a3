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

"""Flat ground: planes, patches, and the edges where they are cut.

Parts are numbered faces first, then the edges of cuts. A face is a rectangle, of endless size and
solid below for a plane; a cut plane's edges are walls that go down along its normal.

::

            n ^                         faces:  o centre, a along, b across
              |   b                     a, b, n right-handed
         .----|--/----.
        /     | /    /   cut            edges:  s start, d direction,
       /      o----->a   .----.                 down to `depth` below
      /            /   s/--->d/
     '------------'     '----'
"""

from math import cos, inf, sin
from typing import Any, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import surface_protocol
from .patch import Patch
from .plane import Plane
from .polygon import contains_box, inside, Outline, Polygons, polygons, sides
from ..jit import kernel
from ..kernel_types import StructRecord, Vector
from ..mechanics.vector import (
    add,
    add_scaled,
    dot,
    length,
    load,
    scale,
    sub,
    tangential,
    unit,
    ZERO,
)
from ..properties.material import Material

SAME_HEIGHT = 1e-6  # m: surfaces closer than this count as coplanar
PLANE_ROUNDING = 1e-9  # m: faces extend by this, so that neighbours leave no gap by rounding
FLUSH = 2.0 * PLANE_ROUNDING  # m: a foot so near to a triangle, in its plane, is on its face
# m: on a border the normal turns as it will beyond it, or a ball would leave an edge too late.
AHEAD = 2e-7

FACE = np.dtype(
    [
        ('center', 'f8', 3),
        ('normal', 'f8', 3),
        ('along', 'f8', 3),
        ('across', 'f8', 3),
        ('half_length', 'f8'),
        ('half_width', 'f8'),
        ('solid', 'i8'),
        ('one_sided', 'i8'),
        ('material', 'i8'),
        ('first_cut', 'i8'),
        ('last_cut', 'i8'),
        ('low', 'f8', 3),
        ('high', 'f8', 3),
    ],
    align=True,
)

EDGE = np.dtype(
    [
        ('start', 'f8', 3),
        ('direction', 'f8', 3),
        ('length', 'f8'),
        ('normal', 'f8', 3),
        ('depth', 'f8'),
        ('material', 'i8'),
        ('low', 'f8', 3),
        ('high', 'f8', 3),
    ],
    align=True,
)


class Flats(NamedTuple):
    """All flat ground of a course."""

    faces: np.ndarray
    edges: np.ndarray
    cuts: Polygons


def frame(normal: Sequence[float], heading: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Orthonormal frame: the normal, a unit vector along `heading` in its plane, one across."""
    n = np.asarray(normal, float)
    n = n / np.linalg.norm(n)
    ahead = np.array([cos(heading), sin(heading), 0.0])
    a = ahead - (ahead @ n) * n
    if np.linalg.norm(a) < 1e-9:  # the heading points along the normal: any direction will do
        a = np.cross([0.0, 0.0, 1.0], n)
    a = a / np.linalg.norm(a)
    return n, a, np.cross(n, a)


def flats(shapes: Sequence[Union[Plane, Patch]], material_number: Mapping[Material, int]) -> Flats:
    """`Flats` of `Plane` and `Patch` records; `material_number` maps a material to its row."""
    faces, edges = [], []
    outlines: list[Outline] = []
    for shape in shapes:
        solid = isinstance(shape, Plane)
        if isinstance(shape, Plane):
            center = np.asarray(shape.point, float)
            heading, half, one_sided = 0.0, (inf, inf), False
        else:
            center = np.asarray(shape.center, float)
            heading, half = shape.heading, (0.5 * shape.length, 0.5 * shape.width)
            one_sided = shape.one_sided
        n, a, b = frame(shape.normal, heading)
        number = material_number[shape.material]
        low, high = _face_box(center, n, a, b, half)
        faces.append(
            (
                center,
                n,
                a,
                b,
                *half,
                solid,
                one_sided,
                number,
                len(outlines),
                len(outlines) + len(shape.cut),
                low,
                high,
            )
        )
        for outline in shape.cut:
            edges += _cut_edges(center, n, outline, inf if solid else 0.0, number)
        outlines += shape.cut
    return Flats(np.array(faces, FACE), np.array(edges, EDGE), polygons(outlines))


def _face_box(
    center: np.ndarray, n: np.ndarray, a: np.ndarray, b: np.ndarray, half: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    if half[0] < inf:
        reach = np.abs(a) * half[0] + np.abs(b) * half[1]
        return center - reach, center + reach
    low, high = np.full(3, -inf), np.full(3, inf)
    for axis in range(3):
        if abs(n[axis]) == 1.0:
            (high if n[axis] > 0 else low)[axis] = center[axis]
    return low, high


def _cut_edges(
    center: np.ndarray, n: np.ndarray, outline: Outline, depth: float, material: int
) -> list[tuple[Any, ...]]:
    def lifted(corner: Sequence[float]) -> np.ndarray:
        x, y = corner
        z = center[2] - (n[0] * (x - center[0]) + n[1] * (y - center[1])) / n[2]
        return np.array([x, y, z])

    rows = []
    for first, second in sides(outline):
        start, end = lifted(first), lifted(second)
        size = np.linalg.norm(end - start)
        foot = np.array([-depth * c if c and depth else 0.0 for c in n])
        box = np.array([start, end, start + foot, end + foot])
        rows.append(
            (start, (end - start) / size, size, n, depth, material, box.min(0), box.max(0))
        )
    return rows


@surface_protocol.parts.register(Flats)
def _parts(kind: Flats) -> int:
    return len(kind.faces) + len(kind.edges)


@surface_protocol.next_part.register(Flats)
def _next_part(kind: Flats, part: int, low: Vector, high: Vector) -> int:
    faces = len(kind.faces)
    while part < faces + len(kind.edges):
        if part < faces:
            face = kind.faces[part]
            if meets(face, low, high) and not is_cut_away(kind, face, low, high):
                break
        elif meets(kind.edges[part - faces], low, high):
            break
        part += 1
    return part


@kernel
def meets(row: StructRecord, low: Vector, high: Vector) -> bool:
    """Whether the box of `row`, a face, edge or node, overlaps the box from `low` to `high`."""
    return not (
        low[2] > row['high'][2]
        or high[0] < row['low'][0]
        or low[0] > row['high'][0]
        or high[1] < row['low'][1]
        or low[1] > row['high'][1]
        or high[2] < row['low'][2]
    )


@kernel
def clamped(x: float, most: float) -> float:
    """Clamp `x` between -`most` and `most`."""
    return min(max(x, -most), most)


@kernel
def offset_from_face(face: StructRecord, point: Vector) -> tuple[Vector, float]:
    """Vector to `point` from the closest point of a face, and the height over its plane."""
    d = sub(point, load(face['center']))
    normal = load(face['normal'])
    a = dot(d, load(face['along']))
    b = dot(d, load(face['across']))
    h = dot(d, normal)
    offset = scale(h, normal)
    offset = add_scaled(offset, a - clamped(a, face['half_length']), load(face['along']))
    offset = add_scaled(offset, b - clamped(b, face['half_width']), load(face['across']))
    return offset, h


@kernel
def offset_from_edge(edge: StructRecord, point: Vector) -> Vector:
    """Vector to `point` from the closest point of a cut's edge, wall included."""
    d = sub(point, load(edge['start']))
    direction = load(edge['direction'])
    normal = load(edge['normal'])
    t = min(max(dot(d, direction), 0.0), edge['length'])
    down = max(min(dot(d, normal), 0.0), -edge['depth'])
    return add_scaled(add_scaled(d, -t, direction), -down, normal)


@surface_protocol.nearest.register(Flats)
def _nearest(kind: Flats, part: int, point: Vector) -> tuple[float, Vector]:
    if part < len(kind.faces):
        face = kind.faces[part]
        normal = load(face['normal'])
        if face['solid']:
            return dot(sub(point, load(face['center'])), normal), normal
        offset, _ = offset_from_face(face, point)
        return length(offset), unit(offset, normal)
    edge = kind.edges[part - len(kind.faces)]
    offset = offset_from_edge(edge, point)
    return length(offset), unit(offset, load(edge['normal']))


@surface_protocol.turn.register(Flats)
def _turn(kind: Flats, part: int, point: Vector, velocity: Vector) -> Vector:
    speed = length(velocity)
    if speed == 0.0:
        return ZERO
    ahead = add_scaled(point, AHEAD / speed, velocity)
    if part < len(kind.faces):
        face = kind.faces[part]
        if face['solid']:
            return ZERO
        offset, _ = offset_from_face(face, point)
        d = sub(ahead, load(face['center']))
        rate = in_direction(velocity, load(face['normal']))
        if abs(dot(d, load(face['along']))) > face['half_length']:
            rate = add(rate, in_direction(velocity, load(face['along'])))
        if abs(dot(d, load(face['across']))) > face['half_width']:
            rate = add(rate, in_direction(velocity, load(face['across'])))
    else:
        edge = kind.edges[part - len(kind.faces)]
        offset = offset_from_edge(edge, point)
        d = sub(ahead, load(edge['start']))
        rate = velocity
        if 0.0 < dot(d, load(edge['direction'])) < edge['length']:
            rate = sub(rate, in_direction(velocity, load(edge['direction'])))
        if -edge['depth'] < dot(d, load(edge['normal'])) < 0.0:
            rate = sub(rate, in_direction(velocity, load(edge['normal'])))
    away = length(offset)
    return scale(1.0 / away, tangential(rate, scale(1.0 / away, offset))) if away > 0.0 else ZERO


@kernel
def in_direction(velocity: Vector, direction: Vector) -> Vector:
    """Component of `velocity` along a unit `direction`, as a vector."""
    return scale(dot(velocity, direction), direction)


@kernel
def in_a_cut(flat: Flats, face: StructRecord, x: float, y: float) -> bool:
    """Whether the surface of `face` is cut away at `x`, `y`."""
    for i in range(face['first_cut'], face['last_cut']):
        if inside(flat.cuts, i, x, y):
            return True
    return False


@kernel
def is_cut_away(flat: Flats, face: StructRecord, low: Vector, high: Vector) -> bool:
    """Whether a level `face` has nothing over or below a box: a cut contains that in plan."""
    for i in range(face['first_cut'], face['last_cut']):
        if abs(face['normal'][2]) == 1.0 and contains_box(flat.cuts, i, low, high):
            return True
    return False


@surface_protocol.touchable.register(Flats)
def _touchable(kind: Flats, part: int, point: Vector) -> bool:
    if part >= len(kind.faces):
        return True
    face = kind.faces[part]
    _, h = offset_from_face(face, point)
    return not (face['one_sided'] and h < 0.0 or surface_protocol.in_cut(kind, part, point))


@surface_protocol.in_cut.register(Flats)
def _in_cut(kind: Flats, part: int, point: Vector) -> bool:
    if part >= len(kind.faces):
        return False
    face = kind.faces[part]
    offset, _ = offset_from_face(face, point)
    place = sub(point, offset)
    return in_a_cut(kind, face, place[0], place[1])


@surface_protocol.flat_under.register(Flats)
def _flat_under(kind: Flats, part: int, point: Vector) -> bool:
    if part >= len(kind.faces):
        return False
    face = kind.faces[part]
    d = sub(point, load(face['center']))
    return (
        abs(dot(d, load(face['along']))) <= face['half_length'] + PLANE_ROUNDING
        and abs(dot(d, load(face['across']))) <= face['half_width'] + PLANE_ROUNDING
    )


@surface_protocol.form.register(Flats)
def _form(kind: Flats, part: int) -> int:
    if part < len(kind.faces) and kind.faces[part]['solid']:
        return surface_protocol.PLANE_FORM
    return surface_protocol.ANY_FORM


@surface_protocol.is_below_plane.register(Flats)
def _is_below_plane(kind: Flats, part: int, point: Vector, normal: Vector) -> bool:
    if part < len(kind.faces):
        face = kind.faces[part]
        own = load(face['normal'])
        d = sub(load(face['center']), point)
        if not face['solid']:
            rise = face['half_length'] * abs(dot(load(face['along']), normal))
            rise += face['half_width'] * abs(dot(load(face['across']), normal))
            if dot(d, normal) + rise <= PLANE_ROUNDING:
                return True
    else:
        own = load(kind.edges[part - len(kind.faces)]['normal'])
        d = sub(load(kind.edges[part - len(kind.faces)]['start']), point)
    return abs(dot(own, normal)) > 1.0 - 1e-12 and abs(dot(d, own)) <= SAME_HEIGHT


@surface_protocol.material_of.register(Flats)
def _material_of(kind: Flats, part: int) -> int:
    if part < len(kind.faces):
        return kind.faces[part]['material']
    return kind.edges[part - len(kind.faces)]['material']


@surface_protocol.top.register(Flats)
def _top(kind: Flats, x: float, y: float) -> tuple[float, int]:
    best = -1e300
    who = -1
    for part in range(len(kind.faces)):
        face = kind.faces[part]
        if (
            x < face['low'][0]
            or x > face['high'][0]
            or y < face['low'][1]
            or y > face['high'][1]
            or abs(face['normal'][2]) < 1e-9
        ):
            continue
        dx = x - face['center'][0]
        dy = y - face['center'][1]
        n = face['normal']
        z = face['center'][2] - (n[0] * dx + n[1] * dy) / n[2]
        if z >= best - SAME_HEIGHT and _covers(kind, face, (x, y, z)):
            best = max(best, z)
            who = part
    return best, who


@kernel
def _covers(flat: Flats, face: StructRecord, place: Vector) -> bool:
    d = sub(place, load(face['center']))
    return (
        abs(dot(d, load(face['along']))) <= face['half_length'] + PLANE_ROUNDING
        and abs(dot(d, load(face['across']))) <= face['half_width'] + PLANE_ROUNDING
        and not in_a_cut(flat, face, place[0], place[1])
    )


def plan(shape: Union[Plane, Patch]) -> list[Outline]:
    """Outlines in plan, sequences of (x, y), across which `shape` begins or ends."""
    outlines: list[Outline] = [tuple(c) for c in shape.cut]
    if isinstance(shape, Patch):
        n, a, b = frame(shape.normal, shape.heading)
        turns = ((1, 1), (-1, 1), (-1, -1), (1, -1))
        outlines.append(
            tuple(
                tuple(
                    (
                        np.asarray(shape.center)
                        + i * 0.5 * shape.length * a
                        + j * 0.5 * shape.width * b
                    )[:2]
                )
                for i, j in turns
            )
        )
    return outlines


def heights(shape: Union[Plane, Patch]) -> tuple[float, float]:
    """Least and greatest height of a patch or a level plane.

    A tilted plane counts as having none.
    """
    if isinstance(shape, Plane):
        level = frame(shape.normal, 0.0)[0][2] == 1.0
        return (shape.point[2], shape.point[2]) if level else (-inf, -inf)
    _, a, b = frame(shape.normal, shape.heading)
    reach = 0.5 * shape.length * abs(a[2]) + 0.5 * shape.width * abs(b[2])
    return shape.center[2] - reach, shape.center[2] + reach


SHAPES = (Plane, Patch)
NUMBERED = 1
build = flats
