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

"""Protocol of an effect: its laws. An effect registers a body for each law in which it takes part.

Every effect is a record, a ``NamedTuple`` of floats: its type is chosen when the kernel compiles,
its fields are free to change while running.
"""

from math import sqrt
from typing import Any, Callable, Mapping, NamedTuple, Optional

import numpy as np

from ..geometry.surfaces import Ground
from ..jit import generic, kernel, shared
from ..kernel_types import EffectRecord, Vector
from ..mechanics.vector import dot, ZERO

BRIEF = 2e-3  # s: shorter steps are left to the error control, however suddenly a force reverses


class Live(NamedTuple):
    """Live parameter of an effect: what may change while balls move.

    ``check``: makes a tuple of floats of a value, or raises ValueError; ``default``: such a tuple.
    ``carried``: of an effect in the air that wind carries along, its value at another time, whose
    last three numbers are the drift, see `set_drift`. From all live parameters by name, the time
    on the clock [s], and the time to which the clock is set then.
    """

    check: Callable[[Any], tuple[float, ...]]
    default: tuple[float, ...]
    carried: Optional[Callable[[Mapping[str, Any], float, float], tuple[float, ...]]] = None


class Flow(NamedTuple):
    """Air flow around a ball in flight.

    ``velocity`` and ``speed`` of the ball through the air [m/s]; ``spin`` [rad/s]; ``position``;
    ``over_ground``: velocity relative to the ground.
    """

    velocity: Vector
    speed: float
    spin: Vector
    position: Vector
    over_ground: Vector


@generic
def air_velocity(effect: EffectRecord, ground: Ground, position: Vector) -> Vector:
    """Velocity [m/s] that `effect` adds to the air at `position`."""
    return ZERO


@generic
def acceleration(effect: EffectRecord, flow: Flow) -> Vector:
    """Acceleration [m/s^2] of a ball in flight by `effect` in `flow`."""
    return ZERO


@generic
def spin_rate(effect: EffectRecord, flow: Flow) -> Vector:
    """Angular acceleration [rad/s^2] of a ball in flight by `effect` in `flow`."""
    return ZERO


@generic
def longest_step(
    effect: EffectRecord, ground: Ground, flow: Flow, force: Vector, wanted: float
) -> float:
    """Longest step [s], `wanted` at most, that can't overlook `effect`.

    Of a ball in `flow` that `force` accelerates [m/s^2].
    """
    return wanted


@kernel
def step_to_alignment(arrow: Vector, change: Vector, blunt: float, wanted: float) -> float:
    """Longest step [s] that can't overlook how `arrow` passes near zero.

    It changes by `change` a second. A force along it reverses there all at once, within `blunt` of
    its length. To first order the arrow is shortest some time ahead, or was so before, and the
    force changes within some width of that. A `wanted` step no longer than half of that time, or
    than the width, is safe: this usual case is tested without division and root.
    """
    turning = dot(change, change)
    closing = -dot(arrow, change)
    off = dot(arrow, arrow)
    least = wanted * turning
    if (
        abs(closing) >= 2.0 * least
        or (off + blunt * blunt) * turning - closing * closing >= least * least
    ):
        return wanted
    return slowed(turning, closing, off, blunt, wanted)


@shared
def slowed(turning: float, closing: float, off: float, blunt: float, wanted: float) -> float:
    """Step of `step_to_alignment` where it is cut; apart, or its root would be taken each time."""
    ahead = closing / turning
    width = sqrt((max(off - closing * ahead, 0.0) + blunt * blunt) / turning)
    return min(max(0.5 * abs(ahead), width, BRIEF), wanted)


@generic
def gravity(effect: EffectRecord, position: Vector) -> Vector:
    """Acceleration [m/s^2] by `effect` that acts on every ball, in contact or not."""
    return ZERO


@generic
def under_water(effect: EffectRecord, weight: Vector, velocity: Vector) -> Vector:
    """Acceleration [m/s^2] by `effect` of a ball under water, beside `weight`, that by gravity."""
    return ZERO


@generic
def contact_normal(
    effect: EffectRecord, normal: Vector, velocity: Vector, softness: float
) -> Vector:
    """Effective contact normal of a ball that hits ground at `velocity`.

    The ground has a `normal` and a `softness`.
    """
    return normal


class Hit(NamedTuple):
    """Impact with ground of a `normal`, after which a ball would leave by `push` alone.

    ``velocity``: before [m/s]; ``felt``: effective contact normal; ``push``: impulse over mass
    [m/s]; ``restitution``: at the approach along ``normal``; ``softness`` of the ground.
    """

    velocity: tuple
    normal: tuple
    felt: tuple
    push: tuple
    restitution: float
    softness: float


@generic
def departure(effect: EffectRecord, hit: Hit, velocity: Vector) -> Vector:
    """Velocity [m/s] after a `hit` of a ball that without `effect` would leave at `velocity`."""
    return velocity


@generic
def at_time(effect: EffectRecord, time: float) -> None:
    """Tell an `effect` that changes with time which `time` [s] it is asked about next."""


@generic
def set_drift(effect: EffectRecord, drift: Vector) -> None:
    """Set how far the wind has carried what is in an `effect`: x and y [m], at a time [s]."""


@generic
def set_live(effect: EffectRecord, value: np.ndarray) -> None:
    """Set the live parameter that is in the record of an `effect`, if it holds any.

    For schedules: it changes within a call of the engine. What the wind drives takes the wind.
    """
