# SPDX-License-Identifier: Apache-2.0
"""What a kind of ground must be able to say. All shapes of a kind are one record of arrays.

A kind is made of parts, numbered from 0. They are convex, or their hollows have a bounded curvature:
that is what lets contacts be found without ever stepping over one. A new kind registers a body for
each of these laws that it has a word in.
"""
from ..jit import generic
from ..mechanics.vector import ZERO, add_scaled, length, scale, sub

NOTHING = (-1e300, -1)
GROUND_SORT, CUP_SORT, FLAGSTICK_SORT, OBSTACLE_SORT = range(4)


@generic
def parts(kind):
    """Number of convex parts."""
    return 0


@generic
def next_part(kind, part, low, high):
    """First part, from number `part` on, that may have a point in the box from `low` to `high`.

    Where there is none, the number of parts or more.
    """
    return 0


@generic
def nearest(kind, part, point):
    """Distance of `point` from `part`, and the unit vector from there to `point`.

    Negative inside a solid part, where the vector still points out of it.
    """
    return 0.0, (0.0, 0.0, 1.0)


@generic
def turn(kind, part, point, velocity):
    """Rate of change of the unit vector that `nearest` gives, as `point` moves at `velocity`."""
    speed = length(velocity)
    if speed == 0.0:
        return ZERO
    dt = 1e-6 / speed
    _, before = nearest(kind, part, add_scaled(point, -dt, velocity))
    _, after = nearest(kind, part, add_scaled(point, dt, velocity))
    return scale(0.5 / dt, sub(after, before))


@generic
def hollow(kind, part):
    """Greatest curvature [1/m] of the hollows of `part`, seen from outside; 0 of a convex part."""
    return 0.0


@generic
def effort(kind, part):
    """What it takes to find the place of `part` that is nearest to a ball near it, of a plane's 1."""
    return 1


@generic
def touchable(kind, part, point):
    """Whether the surface exists where `part` is nearest to `point`, seen from there."""
    return True


@generic
def in_cut(kind, part, point):
    """Whether `part` is cut away, within an outline in plan, where it would be nearest to `point`."""
    return False


@generic
def flat_under(kind, part, point):
    """Whether `part` is flat around the place nearest to `point`."""
    return False


@generic
def in_plane(kind, part, point, normal):
    """Whether `part` belongs to the plane through `point` with `normal`, as surface or edge."""
    return False


@generic
def is_plane(kind, part):
    """Whether `nearest` gives the same vector everywhere: of an endless plane, solid below."""
    return False


@generic
def limits(kind):
    """Number of straight lines at which flat parts end, beside outlines in plan."""
    return 0


@generic
def limit(kind, part, i):
    """Line `i` at which `part` ends: a point of it, and the unit vector from there into the part."""
    return ZERO, ZERO


@generic
def support_of(kind, part):
    """Part that a ball stands on where it touches `part`: of a smooth surface, all of it."""
    return part


@generic
def goes_on(kind, part, other):
    """Whether `other` is the same smooth surface as `part`, a support, and so no obstacle on it."""
    return False


@generic
def is_ground(kind):
    """Whether zones repaint it and the hole is cut into it."""
    return True


@generic
def sort(kind, part):
    """Whether `part` is GROUND, CUP, FLAGSTICK or OBSTACLE: what an impact with it is told as."""
    return GROUND_SORT


@generic
def material_of(kind, part):
    """Number of the material of `part`."""
    return 0


@generic
def top(kind, x, y):
    """Height of the highest surface at `x`, `y` and its part, or ``NOTHING``."""
    return NOTHING
