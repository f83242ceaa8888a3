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

r"""Soft turf: the ball pushes up a bank, so the contact normal tilts towards where it came from.

::

        v \      ^ n'            n   normal of the ground
           \    /  ^ n           n'  normal that the ball feels
            \  / t |             t   tilt
        ________\|_|________
"""

from math import acos, cos, exp, pi, sin
from typing import NamedTuple

from . import protocol, Scene
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import add, dot, length, scale, tangential

# Penner, Can. J. Phys. 80 (2002) 931-940: 15.4 degrees at 18.6 m/s and 44.4 degrees from the
# vertical, proportional to both. As published it grows without bound (95 degrees for a skimmer of
# 60 m/s); here it saturates smoothly below 30 degrees. It was measured on impacts that dig in; one
# that only grazes must not tilt, or a ball that skims along would be thrown up for ever. So the
# tilt fades with the approach speed's square over that of FADE (estimate).
TILT = 15.4 * pi / 180
SPEED = 18.6  # m/s
ANGLE = 44.4 * pi / 180
MOST = 30.0 * pi / 180
TURF_FADE = 1.5  # m/s


class Turf(NamedTuple):
    """Tilt `rate` [s/m]: radians of tilt per m/s and radian from the normal; `most` [rad].

    `fade` [m/s]: approach speed at which the tilt is half of that.
    """

    rate: float = TILT / (SPEED * ANGLE)
    most: float = MOST
    fade: float = TURF_FADE


@protocol.contact_normal.register(Turf)
def _contact_normal(effect: Turf, normal: Vector, velocity: Vector, softness: float) -> Vector:
    across = tangential(velocity, normal)
    if softness * effect.rate == 0.0 or length(across) == 0.0:
        return normal
    approach = max(-dot(velocity, normal), 0.0)
    dug_in = approach * approach / (approach * approach + effect.fade * effect.fade)
    tilt = softness * effect.rate * steepness(velocity, normal) * dug_in
    return tilted(normal, across, saturated(tilt, effect.most))


@kernel
def saturated(tilt: float, most: float) -> float:
    """Saturated tilt: `most` tanh(`tilt` / `most`), to an absolute rounding error.

    It takes half the time of tanh.
    """
    q = exp(-2.0 * tilt / most)
    return most * (1.0 - q) / (1.0 + q)


@kernel
def steepness(velocity: Vector, normal: Vector) -> float:
    """Speed times angle from the `normal`, which Penner's tilt is proportional to [m/s rad]."""
    speed = length(velocity)
    return speed * acos(min(max(-dot(velocity, normal), 0.0) / speed, 1.0))


@kernel
def tilted(normal: Vector, across: Vector, tilt: float) -> Vector:
    """Turn `normal` by `tilt` [rad] against `across`, a motion along the ground."""
    return add(scale(cos(tilt), normal), scale(-sin(tilt) / length(across), across))


def record(scene: Scene) -> Turf:
    """Record for `scene`."""
    return Turf()


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, hard ground, or ''."""
    soft = any(shape.material.softness > 0 for shape in scene.course.ground)
    return '' if soft else 'all ground is hard'


def dormant(scene: Scene) -> Turf:
    """Record that tilts nothing: a course of hard ground compiles nothing."""
    return Turf(rate=0.0)
