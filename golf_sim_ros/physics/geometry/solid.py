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

"""Solids on the ground: upright cylinders with flat ends, and spheres."""

from math import sqrt
from typing import Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import surface_protocol
from .plane_patch import meets, PLANE_ROUNDING, SAME_HEIGHT
from .polygon import Circle
from .surfaces import Ground
from ..jit import kernel
from ..kernel_types import Box, StructRecord, Vector
from ..mechanics.vector import add_scaled, dot, length, load, scale, sub, tangential, unit
from ..properties.material import Material, Restitution

SOLID = np.dtype(
    [
        ('center', 'f8', 3),
        ('radius', 'f8'),
        ('height', 'f8'),
        ('is_sphere', 'i8'),
        ('sort', 'i8'),
        ('material', 'i8'),
        ('low', 'f8', 3),
        ('high', 'f8', 3),
    ],
    align=True,
)

FLAGSTICK_RADIUS = 0.0095  # m: the Equipment Rules allow 50.8 mm across; sticks in use have 19 mm
FLAGSTICK_HEIGHT = 2.13  # m: 7 ft, as the USGA recommends

# A stick of glass fibre that gives way. Estimates: it takes most of the approach, and is smooth;
# livelier or rougher, 0.35 and 0.2, it would turn back putts of 1.5 m/s that the bare hole takes.
FLAGSTICK_MATERIAL = Material(
    'flagstick', Restitution(0.15), 0.0, 0.15, 0.1, 0.05, 0.002, 0.0, color=(1.0, 1.0, 1.0)
)


class Cylinder(NamedTuple):
    """Upright cylinder with flat ends: `base` is the centre of the lower one."""

    base: Vector
    radius: float
    height: float
    material: Material = Material()


class Sphere(NamedTuple):
    """Fixed sphere."""

    center: Vector
    radius: float
    material: Material = Material()


class Flagstick(NamedTuple):
    """Flagstick: a `Cylinder` in the hole; impacts with it are reported as such."""

    base: Vector
    radius: float = FLAGSTICK_RADIUS
    height: float = FLAGSTICK_HEIGHT
    material: Material = FLAGSTICK_MATERIAL


class Solids(NamedTuple):
    """All solids of a course."""

    solids: np.ndarray


def build(
    shapes: Sequence[Union[Cylinder, Sphere, Flagstick]], material_number: Mapping[Material, int]
) -> Solids:
    """`Solids` of records; `material_number` maps a material to its row.

    A cylinder's center is its base.
    """
    rows = []
    for shape in shapes:
        is_sphere = isinstance(shape, Sphere)
        center, height = (
            (shape.center, 0.0) if isinstance(shape, Sphere) else (shape.base, shape.height)
        )
        low, high = solid_box(shape)
        is_flagstick = isinstance(shape, Flagstick)
        sort = surface_protocol.FLAGSTICK_SORT if is_flagstick else surface_protocol.OBSTACLE_SORT
        rows.append(
            (
                center,
                shape.radius,
                height,
                is_sphere,
                sort,
                material_number[shape.material],
                low,
                high,
            )
        )
    return Solids(np.array(rows, SOLID))


def without(ground: Ground) -> Ground:
    """`Ground` without solids: no obstacles, no flagstick.

    The types are the same, so nothing recompiles.
    """
    return ground._replace(
        kinds=tuple(
            Solids(kind.solids[:0]) if isinstance(kind, Solids) else kind for kind in ground.kinds
        )
    )


def solid_box(shape: Union[Cylinder, Sphere, Flagstick]) -> Box:
    """Least and greatest x, y, z of a solid."""
    x, y, z = shape.center if isinstance(shape, Sphere) else shape.base
    r = shape.radius
    bottom, top = (z - r, z + r) if isinstance(shape, Sphere) else (z, z + shape.height)
    return (x - r, y - r, bottom), (x + r, y + r, top)


def plan(shape: Union[Cylinder, Sphere, Flagstick]) -> list[Circle]:
    """Outline in plan: the rim of a cylinder's flat top; a sphere has nothing flat that ends."""
    return (
        [] if isinstance(shape, Sphere) else [Circle(shape.base[0], shape.base[1], shape.radius)]
    )


def heights(shape: Union[Cylinder, Sphere, Flagstick]) -> tuple[float, float]:
    """Least and greatest height of a solid."""
    low, high = solid_box(shape)
    return low[2], high[2]


@kernel
def from_axis(solid: StructRecord, point: Vector) -> tuple[float, Vector]:
    """Distance of `point` from the upright axis, and the horizontal unit vector from there."""
    dx = point[0] - solid['center'][0]
    dy = point[1] - solid['center'][1]
    away = sqrt(dx * dx + dy * dy)
    return away, unit((dx, dy, 0.0), (1.0, 0.0, 0.0))


@kernel
def over_ends(solid: StructRecord, point: Vector) -> tuple[float, Vector]:
    """Distance of `point` beyond the nearer end of a cylinder, and that end's normal.

    It is negative between the ends.
    """
    h = point[2] - solid['center'][2]
    return max(h - solid['height'], -h), (0.0, 0.0, 1.0 if h > 0.5 * solid['height'] else -1.0)


@surface_protocol.parts.register(Solids)
def _parts(kind: Solids) -> int:
    return len(kind.solids)


@surface_protocol.next_part.register(Solids)
def _next_part(kind: Solids, part: int, low: Vector, high: Vector) -> int:
    while part < len(kind.solids) and not meets(kind.solids[part], low, high):
        part += 1
    return part


@surface_protocol.nearest.register(Solids)
def _nearest(kind: Solids, part: int, point: Vector) -> tuple[float, Vector]:
    solid = kind.solids[part]
    if solid['is_sphere']:
        offset = sub(point, load(solid['center']))
        return length(offset) - solid['radius'], unit(offset, (0.0, 0.0, 1.0))
    away, out = from_axis(solid, point)
    beyond = away - solid['radius']
    over, upright = over_ends(solid, point)
    if beyond > 0.0 and over > 0.0:
        distance = sqrt(beyond * beyond + over * over)
        return distance, add_scaled(scale(beyond / distance, out), over / distance, upright)
    if beyond > over:
        return beyond, out
    return over, upright


@surface_protocol.turn.register(Solids)
def _turn(kind: Solids, part: int, point: Vector, velocity: Vector) -> Vector:
    solid = kind.solids[part]
    if solid['is_sphere']:
        offset = sub(point, load(solid['center']))
        distance = max(length(offset), PLANE_ROUNDING)
        return scale(1.0 / distance, tangential(velocity, scale(1.0 / distance, offset)))
    away, out = from_axis(solid, point)
    over, upright = over_ends(solid, point)
    beyond = away - solid['radius']
    if beyond < -PLANE_ROUNDING:  # beside an end
        return 0.0, 0.0, 0.0
    around = (-out[1], out[0], 0.0)
    circling = dot(velocity, around) / away
    if over < -PLANE_ROUNDING:
        return scale(circling, around)
    # Around the rim, whose closest point follows the motion about the axis.
    relative = add_scaled(velocity, -circling * solid['radius'], around)
    normal = add_scaled(scale(max(beyond, 0.0), out), max(over, 0.0), upright)
    distance = max(length(normal), PLANE_ROUNDING)
    return scale(1.0 / distance, tangential(relative, scale(1.0 / distance, normal)))


@surface_protocol.flat_under.register(Solids)
def _flat_under(kind: Solids, part: int, point: Vector) -> bool:
    solid = kind.solids[part]
    away, _ = from_axis(solid, point)
    over, _ = over_ends(solid, point)
    return not solid['is_sphere'] and over > 0.0 and away <= solid['radius'] + PLANE_ROUNDING


@surface_protocol.is_below_plane.register(Solids)
def _is_below_plane(kind: Solids, part: int, point: Vector, normal: Vector) -> bool:
    solid = kind.solids[part]
    top = solid['center'][2] + solid['height']
    return (
        not solid['is_sphere'] and normal[2] > 1.0 - 1e-12 and abs(point[2] - top) <= SAME_HEIGHT
    )


@surface_protocol.is_ground.register(Solids)
def _is_ground(kind: Solids, part: int) -> bool:
    return False


@surface_protocol.sort.register(Solids)
def _sort(kind: Solids, part: int) -> int:
    return kind.solids[part]['sort']


@surface_protocol.material_of.register(Solids)
def _material_of(kind: Solids, part: int) -> int:
    return kind.solids[part]['material']


@surface_protocol.top.register(Solids)
def _top(kind: Solids, x: float, y: float) -> tuple[float, int]:
    best = -1e300
    who = -1
    for part in range(len(kind.solids)):
        solid = kind.solids[part]
        dx = x - solid['center'][0]
        dy = y - solid['center'][1]
        rest = solid['radius'] * solid['radius'] - dx * dx - dy * dy
        if rest >= 0.0:
            z = solid['center'][2] + (sqrt(rest) if solid['is_sphere'] else solid['height'])
            if z >= best - SAME_HEIGHT:
                best = max(best, z)
                who = part
    return best, who


SHAPES = (Cylinder, Sphere, Flagstick)
NUMBERED = 4
