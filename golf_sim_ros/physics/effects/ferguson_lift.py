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

"""Magnus lift after Ferguson et al. (2022): lift coefficient quadratic in the spin ratio."""

from math import sqrt
from typing import NamedTuple

from . import protocol, Scene
from .drag import dynamic_push
from .protocol import Flow
from .published import FADE, spin_axis_terms
from ..kernel_types import Vector
from ..mechanics.vector import cross, length, scale

# Ferguson, McNally, McPhee (2022); see ferguson_drag.py. Held from the vertex of the parabola,
# 0.524, on.
FERGUSON_LIFT = (0.0504, 1.2031, -1.1490)

INSTEAD_OF = ('magnus',)


class FergusonLift(NamedTuple):
    """Lift along spin x velocity, of coefficient ``c0 + c1 S + c2 S^2``.

    S is the part of the spin across the velocity, times radius, over speed. Held from the vertex
    on; times S / sqrt(S^2 + `fade`^2), so that it is smooth where the spin vanishes. `push` is
    rho A / (2 m) [1/m].
    """

    push: float
    radius: float
    c0: float
    c1: float
    c2: float
    fade: float


@protocol.acceleration.register(FergusonLift)
def _acceleration(effect: FergusonLift, flow: Flow) -> Vector:
    if flow.speed == 0.0:
        return 0.0, 0.0, 0.0
    across = cross(flow.spin, flow.velocity)
    per_ratio = effect.radius / (flow.speed * flow.speed)
    ratio = per_ratio * length(across)
    held = min(ratio, -0.5 * effect.c1 / effect.c2)
    coefficient = effect.c0 + effect.c1 * held + effect.c2 * held * held
    # across / |across| * ratio / sqrt(ratio^2 + fade^2), with no division by a vanishing spin
    strength = coefficient * per_ratio / sqrt(ratio * ratio + effect.fade * effect.fade)
    return scale(effect.push * strength * flow.speed * flow.speed, across)


protocol.longest_step.register(FergusonLift)(spin_axis_terms)


def record(scene: Scene) -> FergusonLift:
    """Record for `scene`."""
    return FergusonLift(dynamic_push(scene.course), scene.course.ball.radius, *FERGUSON_LIFT, FADE)


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
