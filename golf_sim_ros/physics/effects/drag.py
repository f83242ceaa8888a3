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

"""Air resistance of a golf ball: drag coefficient smooth in spin ratio and Reynolds number."""

from math import pi
from typing import NamedTuple

from . import protocol, Scene
from .protocol import Flow
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import CourseRecord, Vector
from ..mechanics.vector import dot, scale, ZERO
from ..properties import air

CREEPING = 0.5  # m/s through the air: below this a reversal of drag hardly matters
NO_FLOW = 1e-18  # m^2/s^2: below this square of airspeed there is no aerodynamic force


class DragLaw(NamedTuple):
    """Drag coefficient for a spin ratio S >= 0 and a Reynolds number Re, bounded and positive.

    ``CD = (1 - c) (base + high h + spin s) + c (laminar + laminar_spin s)`` with
    ``s = S^2 / (S^2 + half^2)``, ``h = q / (1 + q), q = (Re / high_at)^2`` and
    ``c = 1 / (1 + (Re / crisis_at)^8)``.

    c is the drag crisis: below `crisis_at` the boundary layer stays laminar and the flow separates
    early, as from a smooth sphere. Fitted by tools/fit_aerodynamics.py to tour averages, a driver
    chart, two launch monitors' models of flight and wind-tunnel points together: Re of 5e4 to
    2.5e5 (a sphere from 3e3), S of 0 to 1; docs/validation.md says how well.
    """

    base: float = 0.1319
    high: float = 0.1209
    high_at: float = 1.672e5
    spin: float = 0.2242
    half: float = 0.2114
    laminar: float = 0.4507
    laminar_spin: float = 0.0682
    crisis_at: float = 6.531e4


class Drag(NamedTuple):
    """Drag by a `law`; `push` is rho A / (2 m) [1/m], `reynolds` the Reynolds number at 1 m/s."""

    push: float
    radius: float
    reynolds: float
    law: DragLaw


@kernel
def drag_coefficient(law: DragLaw, ss: float, rr: float, flow: float = 1.0) -> float:
    """Drag coefficient at the squares of spin ratio, `ss`, and Reynolds number, `rr`.

    See `DragLaw`. `ss` may be given times `flow`: that spares a division.
    """
    # Most of the time of a flight is spent here: squares need no roots, and quotients are
    # independent.
    high = law.high_at * law.high_at
    crisis = law.crisis_at * law.crisis_at
    crisis = crisis * crisis
    crisis = crisis * crisis
    fast = rr * rr
    spun = ss / (ss + law.half * law.half * flow)
    laminar = crisis / (crisis + fast * fast)
    turbulent = law.base + law.high * rr / (high + rr) + law.spin * spun
    return turbulent + laminar * (law.laminar + law.laminar_spin * spun - turbulent)


@protocol.acceleration.register(Drag)
def _acceleration(effect: Drag, flow: Flow) -> Vector:
    vv = dot(flow.velocity, flow.velocity)
    if vv < NO_FLOW or effect.push == 0.0:
        return ZERO
    turning = effect.radius * effect.radius * dot(flow.spin, flow.spin)
    coefficient = drag_coefficient(effect.law, turning, effect.reynolds * effect.reynolds * vv, vv)
    return scale(coefficient * (-effect.push * flow.speed), flow.velocity)


@protocol.longest_step.register(Drag)
def turning_about(effect: Drag, ground: Ground, flow: Flow, force: Vector, wanted: float) -> float:
    """Longest step [s] that can't overlook where drag reverses, as on a throw straight up."""
    return (
        protocol.step_to_alignment(flow.velocity, force, CREEPING, wanted)
        if effect.push > 0.0
        else wanted
    )


def dynamic_push(course: CourseRecord) -> float:
    """Factor rho A / (2 m) [1/m] of dynamic pressure, of the course's ball in the course's air."""
    ball = course.ball
    return 0.5 * air.density(course.air) * pi * ball.radius * ball.radius / ball.mass


def reynolds_number(course: CourseRecord) -> float:
    """Reynolds number of the course's ball at 1 m/s through the course's air, by its diameter."""
    return 2.0 * course.ball.radius * air.density(course.air) / air.viscosity(course.air)


def record(scene: Scene) -> Drag:
    """Record for `scene`."""
    course = scene.course
    return Drag(dynamic_push(course), course.ball.radius, reynolds_number(course), DragLaw())


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'


def dormant(scene: Scene) -> Drag:
    """Record that does nothing: a course without air compiles nothing."""
    return record(scene)._replace(push=0.0)
