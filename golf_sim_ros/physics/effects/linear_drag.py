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

"""Air resistance proportional to speed, as in the report "Golf Without Friends" (KTH 2019)."""

from typing import NamedTuple

from . import protocol, Scene
from .protocol import Flow
from ..kernel_types import Vector
from ..mechanics.vector import scale

INSTEAD_OF = ('drag',)


class LinearDrag(NamedTuple):
    """Drag force -c v, `rate` = c/m [1/s].

    The default is an estimate: it gives the deceleration of a golf ball's quadratic drag of
    coefficient 0.25 at 40 m/s.
    """

    rate: float = 0.18


@protocol.acceleration.register(LinearDrag)
def _acceleration(effect: LinearDrag, flow: Flow) -> Vector:
    return scale(-effect.rate, flow.velocity)


def record(scene: Scene) -> LinearDrag:
    """Record for `scene`."""
    return LinearDrag()


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
