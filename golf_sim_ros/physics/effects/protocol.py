# SPDX-License-Identifier: Apache-2.0
"""What an effect can say. An effect registers a body for each law it has a word in.

Every effect is a record, a ``NamedTuple`` of floats: its type is chosen when the kernel compiles,
its fields are free to change while running.
"""
from math import sqrt
from typing import NamedTuple

from ..jit import generic, kernel, shared
from ..mechanics.vector import ZERO, dot

BRIEF = 2e-3  # s: a step that the error control can be left to, however suddenly a law turns about


class Flow(NamedTuple):
    """The air as a flying ball meets it.

    ``velocity`` and ``speed`` of the ball through the air [m/s]; ``spin`` [rad/s]; ``position``;
    ``over_ground``: velocity as the ground sees it.
    """

    velocity: tuple
    speed: float
    spin: tuple
    position: tuple
    over_ground: tuple


@generic
def air_velocity(effect, ground, position):
    """Velocity [m/s] that `effect` adds to the air at `position`."""
    return ZERO


@generic
def acceleration(effect, flow):
    """Acceleration [m/s^2] of a flying ball by `effect` in `flow`."""
    return ZERO


@generic
def spin_rate(effect, flow):
    """Rate of change of spin [rad/s^2] of a flying ball by `effect` in `flow`."""
    return ZERO


@generic
def longest_step(effect, ground, flow, force, wanted):
    """Longest step [s], `wanted` at most, that can't overlook `effect`.

    Of a ball in `flow` that `force` accelerates [m/s^2].
    """
    return wanted


@kernel
def step_to_alignment(arrow, change, blunt, wanted):
    """Longest step [s] that can't overlook how `arrow`, changed by `change` a second, passes through zero.

    A law that follows its direction turns about at once there, within `blunt` of its length. To first
    order the arrow is shortest after a while, or was so before, and the law bends within some width of that.
    Where the step that is `wanted` is no longer than half of the former or than the latter, it will do: told
    without division and root, for that is the rule.
    """
    turning = dot(change, change)
    closing = -dot(arrow, change)
    off = dot(arrow, arrow)
    least = wanted * turning
    if (abs(closing) >= 2.0 * least
            or (off + blunt * blunt) * turning - closing * closing >= least * least):
        return wanted
    return slowed(turning, closing, off, blunt, wanted)


@shared
def slowed(turning, closing, off, blunt, wanted):
    """`step_to_alignment`, where it cuts the step; apart, or a root would be taken each time."""
    ahead = closing / turning
    width = sqrt((max(off - closing * ahead, 0.0) + blunt * blunt) / turning)
    return min(max(0.5 * abs(ahead), width, BRIEF), wanted)


@generic
def gravity(effect, position):
    """Acceleration [m/s^2] by `effect` that acts on every ball, in contact or not."""
    return ZERO


@generic
def under_water(effect, weight, velocity):
    """Acceleration [m/s^2] by `effect` of a ball under water, beside its `weight`: that by gravity."""
    return ZERO


@generic
def contact_normal(effect, normal, velocity, softness):
    """Normal that a ball of `velocity` meets on ground of `normal` and `softness`."""
    return normal


@generic
def set_wind(effect, wind):
    """Let `effect` go on with another `wind` [m/s at 10 m]; of an effect that keeps the wind."""
