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

"""Spin decay: the air brakes the spin in proportion to the path flown."""

from typing import NamedTuple

from . import protocol, Scene
from .protocol import Flow
from ..kernel_types import Vector
from ..mechanics.vector import scale, ZERO
from ..properties import air

# Smits and Smith, Science and Golf II (1994) 340-347: dw/dt = -2.0e-5 V w / r, in air of 1.18.
SMITS_SMITH = 2.0e-5
SMITS_SMITH_DENSITY = 1.18  # kg/m^3


class SpinDecay(NamedTuple):
    """Spin falls by the factor exp(-`rate` s) over a path of s through the air; `rate` [1/m]."""

    rate: float


@protocol.spin_rate.register(SpinDecay)
def _spin_rate(effect: SpinDecay, flow: Flow) -> Vector:
    return scale(-effect.rate * flow.speed, flow.spin) if effect.rate > 0.0 else ZERO


def record(scene: Scene) -> SpinDecay:
    """Record for `scene`."""
    thickness = air.density(scene.course.air) / SMITS_SMITH_DENSITY
    return SpinDecay(SMITS_SMITH * thickness / scene.course.ball.radius)


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'


def dormant(scene: Scene) -> SpinDecay:
    """Record that does nothing: a course without air compiles nothing."""
    return SpinDecay(0.0)
