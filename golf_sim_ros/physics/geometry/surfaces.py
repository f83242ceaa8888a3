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

"""Ground as a whole: the parts of all kinds in one numbering, and borders.

At borders surface or material change. Queries for the closest point, the highest surface and the
material under a point, whatever kind of ground answers them.
"""

from math import sqrt
from typing import Any, Callable, NamedTuple

import numpy as np

from . import surface_protocol
from .plane_patch import SAME_HEIGHT
from .polygon import beside, in_region, inside, Polygons, Regions
from .water_surface import Waters
from ..jit import Answer, borrowed, entry, Function, kernel, literal_unroll, shared
from ..kernel_types import Box, KindRecord, StructRecord, Vector
from ..mechanics.vector import add_scaled, dot, scale, ZERO
from ..state.ball import NO_PART

NO_GROUND = -1e300
ALL_PARTS = 1 << 60  # more than there are
LOOK_AHEAD = 1e-7  # m: on a border, the support of a ball is decided this far ahead
RIM_REACH = 0.02  # m: within this of the height of its rim the hole cuts whatever ground is there

BORDER = np.dtype(
    [('start', 'f8', 2), ('direction', 'f8', 2), ('length', 'f8'), ('radius', 'f8')], align=True
)
# Borders `first` to before `last`, of one outline, lie between `low` and `high` in plan.
BORDER_LINE = np.dtype(
    [('first', 'i8'), ('last', 'i8'), ('low', 'f8', 2), ('high', 'f8', 2)], align=True
)


class Ground(NamedTuple):
    """All that a ball can touch.

    ``kinds`` are records of arrays, one a kind; ``borders`` are lines in plan across which another
    surface or material may begin, of a circle its centre and ``radius``, and ``border_lines`` the
    outlines that they belong to; ``zones`` are polygons
    painted with ``zone_materials``; ``bounds`` holds no polygon or one; ``hole``: none, or x, y,
    radius, least and greatest height of the rim, height of the bottom; ``waters`` lie over it all;
    all ground and water but tilted planes lies between ``lowest`` and ``highest``.
    """

    kinds: tuple[KindRecord, ...]
    borders: np.ndarray
    border_lines: np.ndarray
    zones: Regions
    zone_materials: np.ndarray
    bounds: Polygons
    hole: np.ndarray
    waters: Waters
    lowest: float
    highest: float


def of_its_kind(law: Callable[..., Answer], otherwise: Any) -> Callable[..., Answer]:
    """Kernel that calls `law` for the kind to which a part belongs.

    The part's number is among those of all kinds.
    """

    @shared
    def asked(ground: Ground, part: int, *more: Any) -> Any:
        result = otherwise
        for kind in literal_unroll(ground.kinds):
            n = surface_protocol.parts(kind)
            if 0 <= part < n:
                result = law(kind, part, *more)
            part -= n
        return result

    return named_after(law, asked)


def part_of_its_kind(law: Callable[..., int]) -> Callable[[Ground, int], int]:
    """`of_its_kind` for a `law` that answers with a part of the kind, or -1.

    The answer is that part's number among those of all kinds.
    """

    @shared
    def asked(ground: Ground, part: int) -> int:
        found = NO_PART
        before = 0
        for kind in literal_unroll(ground.kinds):
            n = surface_protocol.parts(kind)
            if before <= part < before + n:
                k = law(kind, part - before)
                if k >= 0:
                    found = before + k
            before += n
        return found

    return named_after(law, asked)


def named_after(law: Callable[..., Any], asked: Function) -> Function:
    """Give the kernel `asked` a name and the documentation of its `law`."""
    # Compiled code of two processes may be linked in a third, by name: no two kernels may share
    # one.
    asked.__name__ = asked.__qualname__ = f'{law.__name__}_of_its_kind'
    asked.__doc__ = law.__doc__
    return asked


nearest = of_its_kind(surface_protocol.nearest, (1e300, (0.0, 0.0, 1.0)))
turn = of_its_kind(surface_protocol.turn, ZERO)
nearest_turning = of_its_kind(
    surface_protocol.nearest_turning, (1e300, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
)
hollow = of_its_kind(surface_protocol.hollow, 0.0)
hollow_around = of_its_kind(surface_protocol.hollow_around, 0.0)
form = of_its_kind(surface_protocol.form, surface_protocol.ANY_FORM)
relief = of_its_kind(surface_protocol.relief, (0.0, 0.0))
height_above = of_its_kind(surface_protocol.height_above, (1e300, 0.0))
effort = of_its_kind(surface_protocol.effort, 1)
has_relief = of_its_kind(surface_protocol.has_relief, False)
flat_under = of_its_kind(surface_protocol.flat_under, False)
is_below_plane = of_its_kind(surface_protocol.is_below_plane, False)
face_plane = of_its_kind(surface_protocol.face_plane, (0.0, ZERO))
in_cut = of_its_kind(surface_protocol.in_cut, False)
limit = of_its_kind(surface_protocol.limit, (ZERO, ZERO))
_touchable = of_its_kind(surface_protocol.touchable, False)
_is_inner = of_its_kind(surface_protocol.is_inner, False)
sort = of_its_kind(surface_protocol.sort, surface_protocol.GROUND_SORT)
_own_material = of_its_kind(surface_protocol.material_of, 0)
limits = of_its_kind(surface_protocol.limits, 0)
is_ground = of_its_kind(surface_protocol.is_ground, False)
support_of = part_of_its_kind(surface_protocol.support_of)
_smooth_surface = part_of_its_kind(surface_protocol.smooth_surface)


# Of `parts`, `next_part`, `parts_within` and `top` each has a loop of its own: they ask all kinds,
# not the one of a part, and put the answers together in four ways, as a sum, the first, the first
# and the last, the highest.
@kernel
def parts(ground: Ground) -> int:
    """Count the parts of all kinds."""
    total = 0
    for kind in literal_unroll(ground.kinds):
        total += surface_protocol.parts(kind)
    return total


@shared
def next_part(ground: Ground, part: int, low: Vector, high: Vector) -> int:
    """First part, from `part` on, that may overlap the box from `low` to `high`, or NO_PART."""
    found = NO_PART
    before = 0
    for kind in literal_unroll(ground.kinds):
        n = surface_protocol.parts(kind)
        if found == NO_PART and part < before + n:
            k = surface_protocol.next_part(kind, max(part - before, 0), low, high)
            if k < n:
                found = before + k
        before += n
    return found


@shared
def parts_within(ground: Ground, low: Vector, high: Vector, most: int) -> tuple[int, int, int]:
    """First and last of the parts that `next_part` would find in a box, NO_PART without one.

    And their count. No more than `most` are looked for: the last is that of as many.
    """
    first = last = NO_PART
    count = 0
    before = 0
    for kind in literal_unroll(ground.kinds):
        n = surface_protocol.parts(kind)
        if n > 0 and count < most:
            begin, end, found = surface_protocol.parts_within(kind, low, high, most - count)
            if found > 0:
                first = before + begin if count == 0 else first
                last = before + end
                count += found
        before += n
    return first, last, count


@kernel
def part_after(ground: Ground, part: int, last: int, low: Vector, high: Vector) -> int:
    """Part after `part` of those in a box of which `last` is the last, or NO_PART."""
    return next_part(ground, part + 1, low, high) if part < last else NO_PART


@kernel
def goes_on(ground: Ground, part: int, other: int) -> bool:
    """Whether `other` continues the smooth surface `part`, a support: no obstacle on it."""
    return part != NO_PART and part == _smooth_surface(ground, other)


@shared
def touchable(ground: Ground, part: int, point: Vector) -> bool:
    """Whether the surface exists at the point of `part` nearest to `point`, and faces it."""
    if not _touchable(ground, part, point):
        return False
    if len(ground.hole) == 0 or not is_ground(ground, part):
        return True
    distance, normal = nearest(ground, part, point)
    return not in_hole(ground.hole, add_scaled(point, -distance, normal))


@shared
def touchable_at(
    ground: Ground, part: int, point: Vector, distance: float, normal: Vector
) -> bool:
    """`touchable`, where `nearest` has given `distance` and `normal` already."""
    foot = add_scaled(point, -distance, normal)
    if len(ground.hole) > 0 and is_ground(ground, part) and in_hole(ground.hole, foot):
        return False
    return _is_inner(ground, part, foot) or _touchable(ground, part, point)


@kernel
def touchable_within(ground: Ground, part: int, point: Vector, reach: float) -> bool:
    """`touchable`, of a `part` that is no further than `reach` from `point`.

    Where the hole is further away no closest point is searched for it.
    """
    if len(ground.hole) > 0:
        dx = point[0] - ground.hole[0]
        dy = point[1] - ground.hole[1]
        far = ground.hole[2] + reach
        if dx * dx + dy * dy <= far * far:
            return touchable(ground, part, point)
    return _touchable(ground, part, point)


@kernel
def in_hole(hole: np.ndarray, place: Vector) -> bool:
    """Whether the ground at `place` is cut away by the hole."""
    dx = place[0] - hole[0]
    dy = place[1] - hole[1]
    return (
        dx * dx + dy * dy < hole[2] * hole[2]
        and hole[3] - RIM_REACH < place[2] < hole[4] + RIM_REACH
    )


@kernel
def room_in_hole(hole: np.ndarray, place: Vector) -> float:
    """Way [m] that the ground at `place`, cut away by the hole, is at least from what is not."""
    dx = place[0] - hole[0]
    dy = place[1] - hole[1]
    return min(
        hole[2] - sqrt(dx * dx + dy * dy),
        place[2] - hole[3] + RIM_REACH,
        hole[4] + RIM_REACH - place[2],
    )


@kernel
def in_cup(hole: np.ndarray, place: Vector) -> bool:
    """Whether `place` lies in the hole, below all of its rim."""
    dx = place[0] - hole[0]
    dy = place[1] - hole[1]
    return dx * dx + dy * dy < hole[2] * hole[2] and hole[5] < place[2] < hole[3]


@shared
def material_of(ground: Ground, part: int, point: Vector) -> int:
    """Look up the number of the material of `part` at the contact `point`.

    It is that of the last zone there, if any.
    """
    if len(ground.zone_materials) > 0 and is_ground(ground, part):
        for back in range(1, len(ground.zone_materials) + 1):
            i = len(ground.zone_materials) - back
            if in_region(ground.zones, i, point[0], point[1]):
                return ground.zone_materials[i]
    return _own_material(ground, part)


@shared
def top(ground: Ground, x: float, y: float) -> tuple[float, int]:
    """Height of the highest surface at `x`, `y`, and its part; NO_GROUND, NO_PART without one."""
    best = NO_GROUND
    who = NO_PART
    before = 0
    for kind in literal_unroll(ground.kinds):
        z, part = surface_protocol.top(kind, x, y)
        if part >= 0 and z >= best - SAME_HEIGHT:
            best = max(best, z)
            who = before + part
        before += surface_protocol.parts(kind)
    return best, who


@entry
def look_down(ground: Ground, x: float, y: float) -> tuple[float, int, int]:
    """Height of the highest surface at `x`, `y`, its part, and its material's number.

    For Python.
    """
    ground = borrowed(ground)
    z, part = top(ground, x, y)
    return z, part, material_of(ground, part, (x, y, z))


@kernel
def around(point: Vector, reach: float) -> Box:
    """Box of half width `reach` around `point`."""
    box = (reach, reach, reach)
    return add_scaled(point, -1.0, box), add_scaled(point, 1.0, box)


@kernel
def ground_level(ground: Ground, x: float, y: float) -> float:
    """Height [m] of the highest surface at `x`, `y`; 0 where there is none."""
    z, part = top(ground, x, y)
    return z if part >= 0 else 0.0


@kernel
def out_of_bounds(ground: Ground, x: float, y: float) -> float:
    """Distance [m] in plan by which the point is out of bounds.

    -1 within bounds, or if there are none.
    """
    if len(ground.bounds.first) < 2 or inside(ground.bounds, 0, x, y):
        return -1.0
    return beside(ground.bounds, 0, x, y)


@shared
def is_alone(ground: Ground, part: int, point: Vector, radius: float) -> bool:
    """Whether a ball at `point` that touches `part` can touch no other part."""
    low, high = around(point, radius + SAME_HEIGHT)
    first, _, count = parts_within(ground, low, high, 2)
    return first == part and count == 1


@shared
def touched(ground: Ground, point: Vector, radius: float, ahead: Vector) -> tuple[int, Vector]:
    """Part that supports a ball at `point`, the latest of equals, and the normal there.

    A part counts if its gap is within SAME_HEIGHT. Faces count where they exist `ahead`, a unit
    vector, of here: on a border that decides which is next. A face has priority over an edge.
    """
    best = NO_PART
    best_flat = False
    best_normal = (0.0, 0.0, 1.0)
    low, high = around(point, radius + SAME_HEIGHT)
    next_point = add_scaled(point, LOOK_AHEAD, ahead)
    part, last, _ = parts_within(ground, low, high, ALL_PARTS)
    while part >= 0:
        distance, normal = nearest(ground, part, point)
        if abs(distance - radius) <= SAME_HEIGHT and touchable(ground, part, next_point):
            flat = flat_under(ground, part, next_point)
            if (flat or not best_flat) and (
                best == NO_PART or flat > best_flat or normal[2] > best_normal[2] - 1e-9
            ):
                best = support_of(ground, part)
                best_flat = flat
                best_normal = normal
        part = part_after(ground, part, last, low, high)
    return best, best_normal


@shared
def under(ground: Ground, part: int, point: Vector, ahead: Vector) -> tuple[float, Vector]:
    """`nearest`, for the support `part` of a ball at `point` that moves along `ahead`.

    That is a unit vector, or zero. On a border a flat part that continues ahead counts as flat: a
    corner that is passed by is no edge.
    """
    next_point = add_scaled(point, LOOK_AHEAD, ahead)
    if flat_under(ground, part, next_point):
        distance, normal = nearest(ground, part, next_point)
        return distance - LOOK_AHEAD * dot(ahead, normal), normal
    return nearest(ground, part, point)


@kernel
def depth(ground: Ground, point: Vector, radius: float) -> float:
    """Greatest penetration depth [m] of a ball at `point`; 0 where it is clear."""
    deepest = 0.0
    low, high = around(point, radius)
    part = next_part(ground, 0, low, high)
    while part >= 0:
        distance, _ = nearest(ground, part, point)
        if radius - distance > deepest and touchable(ground, part, point):
            deepest = radius - distance
        part = next_part(ground, part + 1, low, high)
    return deepest


@kernel
def room_in_plan(ground: Ground, point: Vector) -> float:
    """Distance in plan of `point` from the nearest border."""
    room = 1e300
    for k in range(len(ground.border_lines)):
        line = ground.border_lines[k]
        dx = max(line['low'][0] - point[0], point[0] - line['high'][0], 0.0)
        dy = max(line['low'][1] - point[1], point[1] - line['high'][1], 0.0)
        if dx * dx + dy * dy >= room * room:
            continue
        for i in range(line['first'], line['last']):
            away, _ = distance_in_plan(ground.borders[i], point[0], point[1])
            room = min(room, away)
    return room


@kernel
def distance_in_plan(border: StructRecord, x: float, y: float) -> tuple[float, Vector]:
    """Distance of `x`, `y` from a border, and the direction from there."""
    dx = x - border['start'][0]
    dy = y - border['start'][1]
    ex = border['direction'][0]
    ey = border['direction'][1]
    t = min(max(dx * ex + dy * ey, 0.0), border['length'])
    if border['radius'] == 0.0 and 0.0 < t < border['length']:
        # Beside a straight border the direction is its normal: the difference of near points is
        # rounding, by which a ball that crosses obliquely would miss it.
        left = dy * ex - dx * ey
        return abs(left), (-ey, ex, 0.0) if left >= 0.0 else (ey, -ex, 0.0)
    ox = dx - t * ex
    oy = dy - t * ey
    size = sqrt(ox * ox + oy * oy)
    if size == 0.0:
        return border['radius'], (-ey, ex, 0.0)
    out = (ox / size, oy / size, 0.0)
    if size < border['radius']:
        return border['radius'] - size, scale(-1.0, out)
    return size - border['radius'], out


@kernel
def slope(pull: Vector, normal: Vector) -> tuple[float, Vector]:
    """Split `pull` into the press on a surface of `normal`, and the pull along it."""
    press = -dot(pull, normal)
    return press, add_scaled(pull, press, normal)
