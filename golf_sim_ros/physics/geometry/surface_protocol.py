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

"""Protocol of a kind of ground: its laws. All shapes of a kind are one record of arrays.

A kind consists of parts, numbered from 0. They are convex, or their hollows have bounded
curvature, which is what conservative advancement needs. A new kind registers a body for each law
where the default does not do.
"""

from ..jit import generic
from ..kernel_types import KindRecord, Vector
from ..mechanics.vector import add_scaled, length, scale, sub, ZERO

NOTHING = (-1e300, -1)
# Forms of a part: an endless plane, solid below; a flat face of limited size, with a `face_plane`;
# a smooth surface over all of the plan, with a `relief`.
ANY_FORM, PLANE_FORM, FACE_FORM, RELIEF_FORM = range(4)
GROUND_SORT, CUP_SORT, FLAGSTICK_SORT, OBSTACLE_SORT = range(4)


@generic
def parts(kind: KindRecord) -> int:
    """Count the parts."""
    return 0


@generic
def next_part(kind: KindRecord, part: int, low: Vector, high: Vector) -> int:
    """First part, from number `part` on, that may overlap the box from `low` to `high`.

    Where there is none, the number of parts or more.
    """
    return 0


@generic
def parts_within(kind: KindRecord, low: Vector, high: Vector, most: int) -> tuple[int, int, int]:
    """First and last of the parts that `next_part` would find in a box, and their count.

    No more than `most` are looked for: the last is that of as many.
    """
    first = next_part(kind, 0, low, high)
    last = -1
    part = first
    count = 0
    while part < parts(kind):
        last = part
        count += 1
        if count == most:
            break
        part = next_part(kind, part + 1, low, high)
    return first, last, count


@generic
def nearest(kind: KindRecord, part: int, point: Vector) -> tuple[float, Vector]:
    """Signed distance of `point` from `part`, and the unit normal there, towards `point`.

    The distance is negative inside a solid part, where the normal still points out of it.
    """
    return 0.0, (0.0, 0.0, 1.0)


@generic
def turn(kind: KindRecord, part: int, point: Vector, velocity: Vector) -> Vector:
    """Rate of change of the unit normal that `nearest` gives, as `point` moves at `velocity`."""
    # The default, for kinds without a closed form: central differences over a micrometre to each
    # side.
    speed = length(velocity)
    if speed == 0.0:
        return ZERO
    dt = 1e-6 / speed
    _, before = nearest(kind, part, add_scaled(point, -dt, velocity))
    _, after = nearest(kind, part, add_scaled(point, dt, velocity))
    return scale(0.5 / dt, sub(after, before))


@generic
def nearest_turning(
    kind: KindRecord, part: int, point: Vector, velocity: Vector
) -> tuple[float, Vector, Vector]:
    """`nearest` and `turn` in one, where one search for the closest point does for both."""
    distance, normal = nearest(kind, part, point)
    return distance, normal, turn(kind, part, point, velocity)


@generic
def hollow(kind: KindRecord, part: int) -> float:
    """Greatest concave curvature [1/m] of `part`, seen from outside; 0 if it is convex."""
    return 0.0


@generic
def hollow_around(kind: KindRecord, part: int, point: Vector, reach: float) -> float:
    """`hollow` of what of `part` is no further than `reach` from `point`, or a greater bound."""
    return hollow(kind, part)


@generic
def form(kind: KindRecord, part: int) -> int:
    """Form of `part`: ANY_FORM, or one to which the time of impact is found faster."""
    return ANY_FORM


@generic
def relief(kind: KindRecord, part: int) -> tuple[float, float]:
    """Bounds of a `part` of RELIEF_FORM; else zeros.

    The greatest length of its upward normal (-dz/dx, -dz/dy, 1), and the greatest second
    derivative [1/m] of its height in any direction.
    """
    return 0.0, 0.0


@generic
def height_above(
    kind: KindRecord, part: int, point: Vector, velocity: Vector
) -> tuple[float, float]:
    """Height [m] of `point` straight over a `part` of RELIEF_FORM, and its rate [m/s]."""
    return 1e300, 0.0


@generic
def effort(kind: KindRecord, part: int) -> int:
    """Work of finding the point of `part` nearest to a ball near it, over that of a plane."""
    return 1


@generic
def has_relief(kind: KindRecord, part: int) -> bool:
    """Whether the slope around `part` may be another at the next bounce."""
    return False


@generic
def touchable(kind: KindRecord, part: int, point: Vector) -> bool:
    """Whether the surface exists at the point of `part` nearest to `point`, and faces it."""
    return True


@generic
def is_inner(kind: KindRecord, part: int, foot: Vector) -> bool:
    """Whether a closest point `foot` is so far within `part` that it is surely touchable."""
    return False


@generic
def in_cut(kind: KindRecord, part: int, point: Vector) -> bool:
    """Whether `part` is cut away, within an outline in plan, at its point nearest to `point`."""
    return False


@generic
def flat_under(kind: KindRecord, part: int, point: Vector) -> bool:
    """Whether `part` is flat around its point nearest to `point`."""
    return False


@generic
def is_below_plane(kind: KindRecord, part: int, point: Vector, normal: Vector) -> bool:
    """Whether no point of `part` is above the plane through `point` with `normal`.

    A ball on that plane can't hit it.
    """
    return False


@generic
def face_plane(kind: KindRecord, part: int, point: Vector) -> tuple[float, Vector]:
    """Distance of `point` from the plane of a `part` of FACE_FORM, and the normal towards it.

    `nearest` is at least as far.
    """
    return 0.0, ZERO


@generic
def limits(kind: KindRecord, part: int) -> int:
    """Count the straight lines at which `part` ends, beside outlines in plan."""
    return 0


@generic
def limit(kind: KindRecord, part: int, i: int) -> tuple[Vector, Vector]:
    """Point of line `i` at which `part` ends, and the unit vector from there into the part."""
    return ZERO, ZERO


@generic
def support_of(kind: KindRecord, part: int) -> int:
    """Part that supports a ball which touches `part`: a smooth surface does so as a whole."""
    return part


@generic
def smooth_surface(kind: KindRecord, part: int) -> int:
    """Part that is the whole of the smooth surface to which `part` belongs, -1 if there is none.

    To a ball which that whole supports, `part` is no obstacle.
    """
    return -1


@generic
def is_ground(kind: KindRecord, part: int) -> bool:
    """Whether zones repaint `part` and the hole is cut into it."""
    return True


@generic
def sort(kind: KindRecord, part: int) -> int:
    """Sort of `part`, GROUND_SORT, CUP_SORT, ...: what an impact with it is reported as."""
    return GROUND_SORT


@generic
def material_of(kind: KindRecord, part: int) -> int:
    """Look up the number of the material of `part`."""
    return 0


@generic
def top(kind: KindRecord, x: float, y: float) -> tuple[float, int]:
    """Height of the highest surface at `x`, `y` and its part, or ``NOTHING``."""
    return NOTHING
