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

"""Drag and lift after Smits and Smith (1994), in spin ratio and Reynolds number."""

from math import pi, sin
from typing import NamedTuple

from . import protocol, Scene
from .drag import dynamic_push, reynolds_number
from .protocol import Flow
from .published import drag_and_lift, spin_axis_terms, spin_ratio
from ..kernel_types import Vector
from ..mechanics.vector import ZERO

INSTEAD_OF = ('drag', 'magnus')


class SmitsSmith1994(NamedTuple):
    """CD = 0.24 + 0.18 S + 0.06 sin(pi (Re - 90000) / 200000), CL = 0.54 S^0.4.

    Science and Golf II, 340-347 (as transcribed by others): drivers, Re 7e4 to 2.1e5, S 0.08 to
    0.2. Re is held between 0 and 2.4e5. `push` is rho A / (2 m) [1/m], `reynolds` the Reynolds
    number at 1 m/s.
    """

    push: float
    radius: float
    reynolds: float


@protocol.acceleration.register(SmitsSmith1994)
def _acceleration(effect: SmitsSmith1994, flow: Flow) -> Vector:
    if flow.speed == 0.0:
        return ZERO
    ratio = spin_ratio(effect.radius, flow)
    reynolds = min(effect.reynolds * flow.speed, 2.4e5)
    drag = 0.24 + 0.18 * ratio + 0.06 * sin(pi * (reynolds - 9e4) / 2e5)
    return drag_and_lift(effect.push, flow, ratio, drag, 0.54 * ratio**0.4)


protocol.longest_step.register(SmitsSmith1994)(spin_axis_terms)


def record(scene: Scene) -> SmitsSmith1994:
    """Record for `scene`."""
    course = scene.course
    return SmitsSmith1994(dynamic_push(course), course.ball.radius, reynolds_number(course))


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
