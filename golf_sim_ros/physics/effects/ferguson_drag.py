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

"""Air resistance after Ferguson et al. (2022): drag coefficient quadratic in the spin ratio."""

from typing import NamedTuple

from . import protocol, Scene
from .drag import dynamic_push
from .protocol import Flow
from .published import spin_axis_terms
from ..kernel_types import Vector
from ..mechanics.vector import length, scale

# Ferguson, McNally, McPhee (2022), doi 10.5703/1288284317493: fitted to radar carry and apex of
# 1040 shots with a Pro V1, for spin ratios of 0.02 to 0.75. The parabola's vertex, 0.562, lies
# inside that range; the coefficient is held there, so that it never falls as spin grows.
FERGUSON_DRAG = (0.1304, 0.9287, -0.8259)

INSTEAD_OF = ('drag',)


class FergusonDrag(NamedTuple):
    """Drag of coefficient ``c0 + c1 S + c2 S^2``, held from its vertex on; S = spin radius/speed.

    `push` is rho A / (2 m) [1/m], `radius` the ball's [m].
    """

    push: float
    radius: float
    c0: float
    c1: float
    c2: float


@protocol.acceleration.register(FergusonDrag)
def _acceleration(effect: FergusonDrag, flow: Flow) -> Vector:
    if flow.speed == 0.0:
        return 0.0, 0.0, 0.0
    ratio = min(effect.radius * length(flow.spin) / flow.speed, -0.5 * effect.c1 / effect.c2)
    coefficient = effect.c0 + effect.c1 * ratio + effect.c2 * ratio * ratio
    return scale(-effect.push * coefficient * flow.speed, flow.velocity)


protocol.longest_step.register(FergusonDrag)(spin_axis_terms)


def record(scene: Scene) -> FergusonDrag:
    """Record for `scene`."""
    return FergusonDrag(dynamic_push(scene.course), scene.course.ball.radius, *FERGUSON_DRAG)


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
