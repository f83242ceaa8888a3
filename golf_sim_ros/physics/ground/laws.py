# SPDX-License-Identifier: Apache-2.0
"""What a kind of ground must be able to say. All shapes of a kind are one record of arrays.

A kind is made of convex parts, numbered from 0: convexity is what lets contacts be found without
ever stepping over one. A new kind registers a body for each of these laws.
"""
from .._compile import generic

NOTHING = (-1e300, -1)


@generic
def parts(kind):
    """Number of convex parts."""
    return 0


@generic
def out_of_reach(kind, part, low, high):
    """Whether no point of `part` lies in the box from `low` to `high`."""
    return True


@generic
def nearest(kind, part, point):
    """Distance of `point` from `part`, and the unit vector from there to `point`.

    Negative inside a solid part, where the vector still points out of it.
    """
    return 0.0, (0.0, 0.0, 1.0)


@generic
def touchable(kind, part, point):
    """Whether the surface exists where `part` is nearest to `point`, seen from there."""
    return True


@generic
def flat_under(kind, part, point):
    """Whether `part` is flat around the place nearest to `point`."""
    return False


@generic
def in_plane(kind, part, point, normal):
    """Whether `part` belongs to the plane through `point` with `normal`, as surface or edge."""
    return False


@generic
def material_of(kind, part):
    """Number of the material of `part`."""
    return 0


@generic
def top(kind, x, y):
    """Height of the highest surface at `x`, `y` and its part, or ``NOTHING``."""
    return NOTHING
