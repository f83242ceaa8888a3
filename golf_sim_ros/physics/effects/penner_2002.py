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

"""Soft turf as Penner (2002) published it: the contact normal's tilt grows without bound."""

from math import acos
from typing import NamedTuple

from . import protocol, Scene
from .turf import ANGLE, idle, SPEED, TILT, tilted  # noqa: F401  (idle where turf is)
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import dot, length, tangential

INSTEAD_OF = ('turf',)


class Penner2002(NamedTuple):
    """Tilt `rate` [s/m]: radians of tilt per m/s and radian from the normal.

    Penner, Can. J. Phys. 80 (2002) 931-940, from impacts of 18.6 m/s at 44.4 degrees from the
    vertical. Far from there, above some 30 m/s or where a ball skims, it turns the ground over;
    `turf` is bounded.
    """

    rate: float = TILT / (SPEED * ANGLE)


@protocol.contact_normal.register(Penner2002)
def _contact_normal(
    effect: Penner2002, normal: Vector, velocity: Vector, softness: float
) -> Vector:
    across = tangential(velocity, normal)
    if softness == 0.0 or length(across) == 0.0:
        return normal
    return tilted(normal, across, softness * effect.rate * steepness(velocity, normal))


@kernel
def steepness(velocity: Vector, normal: Vector) -> float:
    """Speed times angle from the `normal`, which Penner's tilt is proportional to [m/s rad]."""
    speed = length(velocity)
    return speed * acos(min(max(-dot(velocity, normal), 0.0) / speed, 1.0))


def record(scene: Scene) -> Penner2002:
    """Record for `scene`."""
    return Penner2002()
