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

"""Magnus force, lift by spin: a coefficient smooth in spin ratio and Reynolds number."""

from math import sqrt
from typing import NamedTuple

from . import protocol, Scene
from .drag import dynamic_push, NO_FLOW, reynolds_number
from .protocol import Flow
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import cross, dot, scale, ZERO

BEND = 0.7  # of `early_at`: within this spin ratio of zero the lift is nearly linear


class LiftLaw(NamedTuple):
    """Lift coefficient over the spin ratio S >= 0, for a Reynolds number Re.

    S times it is bounded.

    ``CL = S (early (1 - lost b) / sqrt(S^2 + early_at^2) + late / sqrt(S^2 + late_at^2))`` with
    ``b = 1 / (1 + (Re / slow_at)^4)``: a part that sets in with the first spin, less at low
    Reynolds numbers, and one that grows with it. Fitted together with `drag.DragLaw`.
    """

    early: float = 0.07761
    early_at: float = 0.02
    lost: float = 0.4113
    slow_at: float = 1.267e5
    late: float = 0.3755
    late_at: float = 0.3335


class Magnus(NamedTuple):
    """Lift along spin x velocity by a `law`.

    S is the part of the spin across the velocity, times radius, over speed; `push` is
    rho A / (2 m) [1/m], `reynolds` the Reynolds number at 1 m/s.
    """

    push: float
    radius: float
    reynolds: float
    law: LiftLaw


@kernel
def lift_per_ratio(law: LiftLaw, ss: float, rr: float, flow: float = 1.0) -> float:
    """Lift coefficient over the spin ratio, at the squares of that and of the Reynolds number.

    These are `ss` and `rr`. See `LiftLaw`. `ss` may be given times `flow` squared: that spares a
    division before the roots.
    """
    slow = law.slow_at * law.slow_at * law.slow_at * law.slow_at
    sped = slow + rr * rr
    early = sqrt(ss + law.early_at * law.early_at * flow * flow)
    late = sqrt(ss + law.late_at * law.late_at * flow * flow)
    return flow * law.early * (sped - law.lost * slow) / sped / early + flow * law.late / late


@protocol.acceleration.register(Magnus)
def _acceleration(effect: Magnus, flow: Flow) -> Vector:
    vv = dot(flow.velocity, flow.velocity)
    if vv < NO_FLOW or effect.push == 0.0:
        return ZERO
    # push v^2 CL across / |across|, where S is |across| / v^2: no division by a vanishing spin.
    across = cross(scale(effect.radius, flow.spin), flow.velocity)
    per_ratio = lift_per_ratio(
        effect.law, dot(across, across), effect.reynolds * effect.reynolds * vv, vv
    )
    return scale(per_ratio, scale(effect.push, across))


@protocol.longest_step.register(Magnus)
def _longest_step(
    effect: Magnus, ground: Ground, flow: Flow, force: Vector, wanted: float
) -> float:
    if effect.push == 0.0:
        return wanted
    # Lift reverses where the velocity passes the axis of spin.
    blunt = BEND * effect.law.early_at * flow.speed * flow.speed / effect.radius
    return protocol.step_to_alignment(
        cross(flow.spin, flow.velocity), cross(flow.spin, force), blunt, wanted
    )


def record(scene: Scene) -> Magnus:
    """Record for `scene`."""
    course = scene.course
    return Magnus(dynamic_push(course), course.ball.radius, reynolds_number(course), LiftLaw())


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'


def dormant(scene: Scene) -> Magnus:
    """Record that does nothing: a course without air compiles nothing."""
    return record(scene)._replace(push=0.0)
