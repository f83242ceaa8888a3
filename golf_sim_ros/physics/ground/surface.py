# SPDX-License-Identifier: Apache-2.0
"""The ground as a whole: every kind's parts in one numbering, and lines where things change.

The closest point, the highest surface and the material under a point are asked for here, whatever
kind of ground gives the answer.
"""
from math import sqrt
from typing import NamedTuple

import numpy as np

from .._compile import entry, kernel, literal_unroll, shared
from ..state import NO_PART
from ..vector import along, dot
from . import laws
from .flat import SAME_HEIGHT
from .polygon import Polygons, inside

NO_GROUND = -1e300
LOOK_AHEAD = 1e-7  # m: on a border, what a ball is on is decided this far ahead

BORDER = np.dtype([('start', 'f8', 2), ('direction', 'f8', 2), ('length', 'f8'), ('bounds', 'i8')],
                  align=True)


class Ground(NamedTuple):
    """Everything that a ball can touch.

    ``kinds`` are records of arrays, one a kind; ``borders`` are lines in plan across which another
    surface may begin; ``bounds`` holds no polygon or one; all ground but tilted planes lies between
    the heights ``lowest`` and ``highest``.
    """

    kinds: tuple
    borders: np.ndarray
    bounds: Polygons
    lowest: float
    highest: float


@kernel
def parts(ground):
    """Number of parts of all kinds."""
    total = 0
    for kind in literal_unroll(ground.kinds):
        total += laws.parts(kind)
    return total


@kernel
def out_of_reach(ground, part, low, high):
    """Whether `part` has no point in the box from `low` to `high`."""
    result = True
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            result = laws.out_of_reach(kind, part, low, high)
        part -= n
    return result


@shared
def nearest(ground, part, point):
    """Distance of `point` from `part` and the unit vector from there to `point`."""
    distance = 1e300
    normal = (0.0, 0.0, 1.0)
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            distance, normal = laws.nearest(kind, part, point)
        part -= n
    return distance, normal


@shared
def touchable(ground, part, point):
    """Whether the surface exists where `part` is nearest to `point`, seen from there."""
    result = False
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            result = laws.touchable(kind, part, point)
        part -= n
    return result


@kernel
def flat_under(ground, part, point):
    """Whether `part` is flat around the place nearest to `point`."""
    result = False
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            result = laws.flat_under(kind, part, point)
        part -= n
    return result


@kernel
def in_plane(ground, part, point, normal):
    """Whether `part` belongs to the plane through `point` with `normal`, as surface or edge."""
    result = False
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            result = laws.in_plane(kind, part, point, normal)
        part -= n
    return result


@entry
def material_of(ground, part):
    """Number of the material of `part`."""
    result = 0
    for kind in literal_unroll(ground.kinds):
        n = laws.parts(kind)
        if 0 <= part < n:
            result = laws.material_of(kind, part)
        part -= n
    return result


@entry
def top(ground, x, y):
    """Height of the highest surface at `x`, `y`, and its part; NO_GROUND, NO_PART without one."""
    best = NO_GROUND
    who = NO_PART
    before = 0
    for kind in literal_unroll(ground.kinds):
        z, part = laws.top(kind, x, y)
        if part >= 0 and z >= best - SAME_HEIGHT:
            best = max(best, z)
            who = before + part
        before += laws.parts(kind)
    return best, who


@kernel
def ground_height(ground, x, y):
    """Height [m] of the highest surface at `x`, `y`; 0 where there is none."""
    z, part = top(ground, x, y)
    return z if part >= 0 else 0.0


@kernel
def in_bounds(ground, x, y):
    """Whether the course's bounds, if any, contain the point."""
    return len(ground.bounds.first) < 2 or inside(ground.bounds, 0, x, y)


@shared
def touched(ground, point, radius, ahead):
    """Part that a ball at `point` stands on, the latest of equals, and the normal there.

    A part counts if it lies within SAME_HEIGHT of touching. Faces count where they reach `ahead`,
    a unit vector, from here: on a border it decides who is next. A face beats an edge.
    """
    best = NO_PART
    best_flat = False
    best_normal = (0.0, 0.0, 1.0)
    reach = radius + SAME_HEIGHT
    low = along(point, -1.0, (reach, reach, reach))
    high = along(point, 1.0, (reach, reach, reach))
    next_point = along(point, LOOK_AHEAD, ahead)
    for part in range(parts(ground)):
        if out_of_reach(ground, part, low, high):
            continue
        distance, normal = nearest(ground, part, point)
        if abs(distance - radius) > SAME_HEIGHT or not touchable(ground, part, next_point):
            continue
        flat = flat_under(ground, part, next_point)
        if flat or not best_flat:
            if best == NO_PART or flat > best_flat or normal[2] > best_normal[2] - 1e-9:
                best = part
                best_flat = flat
                best_normal = normal
    return best, best_normal


@kernel
def depth(ground, point, radius):
    """How deep [m] a ball at `point` lies in the ground; 0 where it is clear."""
    deepest = 0.0
    low = along(point, -1.0, (radius, radius, radius))
    high = along(point, 1.0, (radius, radius, radius))
    for part in range(parts(ground)):
        if not out_of_reach(ground, part, low, high):
            distance, _ = nearest(ground, part, point)
            if radius - distance > deepest and touchable(ground, part, point):
                deepest = radius - distance
    return deepest


@kernel
def distance_in_plan(border, x, y):
    """Distance of `x`, `y` from a border, and the direction from there."""
    dx = x - border['start'][0]
    dy = y - border['start'][1]
    ex = border['direction'][0]
    ey = border['direction'][1]
    t = min(max(dx * ex + dy * ey, 0.0), border['length'])
    ox = dx - t * ex
    oy = dy - t * ey
    size = sqrt(ox * ox + oy * oy)
    if size == 0.0:
        return 0.0, (-ey, ex, 0.0)
    return size, (ox / size, oy / size, 0.0)


@kernel
def slope(pull, normal):
    """How hard `pull` presses on a surface of `normal`, and its part along the surface."""
    press = -dot(pull, normal)
    return press, along(pull, press, normal)
