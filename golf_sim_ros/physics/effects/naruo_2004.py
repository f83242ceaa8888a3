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

"""Drag and lift after Naruo, Mizota and Shimozono (2004), in spin ratio alone."""

from typing import NamedTuple

from . import protocol, Scene
from .drag import dynamic_push
from .protocol import Flow
from .published import drag_and_lift, spin_axis_terms, spin_ratio
from ..kernel_types import Vector
from ..mechanics.vector import ZERO

MOST_RATIO = 1.13  # measured for S of 0.03 to this, Re of 7.1e4 to 1.25e5

INSTEAD_OF = ('drag', 'magnus')


class Naruo2004(NamedTuple):
    """CD and CL of degree four in S, held from S = 1.13 on; `push` is rho A / (2 m) [1/m].

    Trans. JSME B 70 (2004) 2371, doi 10.1299/kikaib.70.2371 (as transcribed by others): one
    commercial ball.
    """

    push: float
    radius: float


@protocol.acceleration.register(Naruo2004)
def _acceleration(effect: Naruo2004, flow: Flow) -> Vector:
    if flow.speed == 0.0:
        return ZERO
    ratio = spin_ratio(effect.radius, flow)
    s = min(ratio, MOST_RATIO)
    drag = 0.2049 + s * (0.2148 + s * (1.098 + s * (-1.760 + s * 0.7510)))
    lift = 0.0616 + s * (1.250 + s * (-1.644 + s * (1.006 - s * 0.2158)))
    return drag_and_lift(effect.push, flow, ratio, drag, lift)


protocol.longest_step.register(Naruo2004)(spin_axis_terms)


def record(scene: Scene) -> Naruo2004:
    """Record for `scene`."""
    return Naruo2004(dynamic_push(scene.course), scene.course.ball.radius)


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
