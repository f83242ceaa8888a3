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

    ``CD = base + high h + spin (1 + slow b) S^2 / (S^2 + half^2) + crisis c / (1 + (S / fade)^2)``
    with ``c = 1 / (1 + (Re / crisis_at)^4)``, ``b = 1 / (1 + (Re / slow_at)^4)``,
    ``h = q / (1 + q), q = (Re / high_at)^2``.

    c is the drag crisis of a ball that hardly spins: below it the flow separates early. Fitted by
    tools/fit_aerodynamics.py to tour averages (PGA 2010s and 2023), a driver chart and wind-tunnel
    points together: Re of 5e4 to 2.5e5, S of 0 to 0.32, and what irons do up to 0.6; beyond, it
    only stays sensible.
    """

    base: float = 0.11
    high: float = 0.1529
    high_at: float = 1.564e5
    spin: float = 0.1591
    half: float = 0.1649
    slow: float = 4.198
    slow_at: float = 5.133e4
    crisis: float = 0.5955
    crisis_at: float = 5.519e4
    fade: float = 0.05


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
    slow = law.slow_at * law.slow_at * law.slow_at * law.slow_at
    crisis = law.crisis_at * law.crisis_at * law.crisis_at * law.crisis_at
    half = law.half * law.half
    fade = law.fade * law.fade
    return (law.base + law.high * rr / (high + rr)) + (
        law.spin
        * ss
        * (slow * (1.0 + law.slow) + rr * rr)
        / ((slow + rr * rr) * (ss + half * flow))
        + law.crisis * crisis * fade * flow / ((crisis + rr * rr) * (ss + fade * flow))
    )


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
    """Longest step [s] that can't overlook where drag reverses.

    That of a throw straight up does.
    """
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
