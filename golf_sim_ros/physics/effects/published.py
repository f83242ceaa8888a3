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

"""Shared part of the published laws of drag and lift: from coefficients to an acceleration."""

from math import sqrt

from . import protocol
from .drag import CREEPING
from .protocol import Flow
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import EffectRecord, Vector
from ..mechanics.vector import add, cross, length, scale

# The published laws give lift at no spin, where it has no direction, or let it set in infinitely
# steeply. Below this spin ratio it fades to zero smoothly. (Estimate; a drive flies at 0.08 and
# more.)
FADE = 0.01


@kernel
def spin_ratio(radius: float, flow: Flow) -> float:
    """Spin ratio, spin times radius over speed, of the whole spin, as in the published laws."""
    return radius * length(flow.spin) / flow.speed


@kernel
def drag_and_lift(push: float, flow: Flow, ratio: float, drag: float, lift: float) -> Vector:
    """Acceleration by coefficients `drag` and `lift` at the spin ratio `ratio`.

    `push` is rho A / (2 m).
    """
    across = cross(flow.spin, flow.velocity)
    size = length(across)
    braking = scale(-push * drag * flow.speed, flow.velocity)
    if size == 0.0:
        return braking
    fading = ratio / sqrt(ratio * ratio + FADE * FADE)
    return add(braking, scale(push * lift * fading * flow.speed * flow.speed / size, across))


def spin_axis_terms(
    effect: EffectRecord, ground: Ground, flow: Flow, force: Vector, wanted: float
) -> float:
    """Longest step [s] that can't overlook where drag or lift by a published law reverses."""
    blunt = FADE * flow.speed * flow.speed / effect.radius
    wanted = protocol.step_to_alignment(
        cross(flow.spin, flow.velocity), cross(flow.spin, force), blunt, wanted
    )
    return protocol.step_to_alignment(flow.velocity, force, CREEPING, wanted)
