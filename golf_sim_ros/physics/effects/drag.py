# SPDX-License-Identifier: Apache-2.0
"""Air resistance of a golf ball: drag coefficient smooth in spin ratio and Reynolds number."""
from math import pi
from typing import NamedTuple

from .. import air
from .._compile import kernel
from ..vector import length, scale
from . import laws


class DragLaw(NamedTuple):
    """Drag coefficient for a spin ratio S >= 0 and a Reynolds number Re, bounded and positive.

    ``CD = base + high h + spin (1 + slow b) S^2 / (S^2 + half^2) + crisis c / (1 + (S / fade)^2)`` with
    ``c = 1 / (1 + (Re / crisis_at)^4)``, ``b = 1 / (1 + (Re / slow_at)^4)``,
    ``h = q / (1 + q), q = (Re / high_at)^2``.

    c is the drag crisis of a ball that hardly spins: below it the flow leaves the ball early. Fitted by
    tools/fit_aerodynamics.py to tour averages (PGA 2010s and 2023), a driver chart and wind-tunnel points
    together: Re of 5e4 to 2.5e5, S of 0 to 0.32, and what irons do up to 0.6; beyond, it only stays sensible.
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
def drag_coefficient(law, ratio, reynolds):
    """Drag coefficient at the spin ratio `ratio` and Reynolds number `reynolds`; see `DragLaw`."""
    ss = ratio * ratio
    c = reynolds * reynolds / (law.crisis_at * law.crisis_at)
    b = reynolds * reynolds / (law.slow_at * law.slow_at)
    q = reynolds * reynolds / (law.high_at * law.high_at)
    return (law.base + law.high * q / (1.0 + q)
            + law.spin * (1.0 + law.slow / (1.0 + b * b)) * ss / (ss + law.half * law.half)
            + law.crisis / ((1.0 + c * c) * (1.0 + ss / (law.fade * law.fade))))


@laws.acceleration.register(Drag)
def _acceleration(effect, flow):
    if flow.speed == 0.0:
        return 0.0, 0.0, 0.0
    ratio = effect.radius * length(flow.spin) / flow.speed
    coefficient = drag_coefficient(effect.law, ratio, effect.reynolds * flow.speed)
    return scale(-effect.push * coefficient * flow.speed, flow.velocity)


def dynamic_push(course):
    """rho A / (2 m) [1/m] of the course's ball in the course's air."""
    ball = course.ball
    return 0.5 * air.density(course.air) * pi * ball.radius * ball.radius / ball.mass


def reynolds_number(course):
    """Reynolds number of the course's ball at 1 m/s through the course's air, by its diameter."""
    return 2.0 * course.ball.radius * air.density(course.air) / air.viscosity(course.air)


def record(scene):
    """Record for `scene`."""
    course = scene.course
    return Drag(dynamic_push(course), course.ball.radius, reynolds_number(course), DragLaw())


def idle(scene):
    """Why `scene` can do without: in no air."""
    return '' if scene.course.air.pressure > 0 else 'no air'
