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

r"""Soft turf: the ball pushes up a bank, so the contact normal tilts towards where it came from.

::

        v \      ^ n'            n   normal of the ground
           \    /  ^ n           n'  normal that the ball feels
            \  / t |             t   tilt
        ________\|_|________

Measured is one point, by Haake: at 18.6 m/s and 44.4 degrees from the vertical the tilt is 15.4
degrees (Penner, Can. J. Phys. 80 (2002) 931-940). How it changes from there is assumed. Penner's
assumption, proportional to the speed and to the angle from the vertical, turns the ground over
for a fast ball that skims, and throws a spinning ball that comes down steeply far back (that law
is `penner_2002`). Here the tilt

- goes with the speed and with the fourth power of the angle's sine (estimate);
- saturates at 25 degrees (estimate);
- fades for a ball that only grazes, with the square of the approach over that of 1.5 m/s
  (estimate): what does not dig in pushes up no bank.

And the bank is of turf, which yields. It brakes a ball, and can do no more:

- It does not throw the ball up. Of the normal speed turf gives back at most (1 + 2 e) / 3
  (estimate), with its restitution e at that approach, however fast the ball comes along. Haake's
  point gives 0.29 back, and the limit is 0.45 there.
- It does not throw the ball back. It pushes only as long as the ball moves into it; once friction
  on backspin and the bank have stopped the ball within the impact, only friction drives it back.
"""

from math import cos, pi, sin, sqrt
from typing import NamedTuple

from . import protocol, Scene
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import add, add_scaled, dot, length, scale, tangential, unit, ZERO

TILT = 15.4 * pi / 180
SPEED = 18.6  # m/s
ANGLE = 44.4 * pi / 180
MOST = 25.0 * pi / 180
TURF_FADE = 1.5  # m/s


class Turf(NamedTuple):
    """Tilt `rate` [s/m]: radians of tilt per m/s, of a ball that skims; `most` [rad].

    `fade` [m/s]: approach speed at which the tilt is half of that.
    """

    rate: float = TILT / (SPEED * sin(ANGLE) ** 4)
    most: float = MOST
    fade: float = TURF_FADE


@protocol.contact_normal.register(Turf)
def _contact_normal(effect: Turf, normal: Vector, velocity: Vector, softness: float) -> Vector:
    across = tangential(velocity, normal)
    along = dot(across, across)
    if softness * effect.rate == 0.0 or along == 0.0:
        return normal
    approach_speed = max(-dot(velocity, normal), 0.0)
    dug_in = (
        approach_speed
        * approach_speed
        / (approach_speed * approach_speed + effect.fade * effect.fade)
    )
    speed = sqrt(along + approach_speed * approach_speed)
    skimming = along * along / (speed * speed * speed)
    tilt = dug_in * saturated(softness * effect.rate * skimming, effect.most)
    return tilted(normal, across, tilt)


@kernel
def saturated(tilt: float, most: float) -> float:
    """Saturated `tilt`: itself where it is small, `most` where it is large, smoothly."""
    q = tilt * tilt / (most * most)
    return tilt / sqrt(sqrt(1.0 + q * q))


@kernel
def tilted(normal: Vector, across: Vector, tilt: float) -> Vector:
    """Turn `normal` by `tilt` [rad] against `across`, a motion along the ground."""
    return add(scale(cos(tilt), normal), scale(-sin(tilt) / length(across), across))


@protocol.departure.register(Turf)
def _departure(effect: Turf, hit: protocol.Hit, velocity: Vector) -> Vector:
    if hit.softness * effect.rate == 0.0:
        return velocity
    ahead = unit(tangential(hit.velocity, hit.normal), ZERO)
    onward = dot(velocity, ahead)
    bank = -dot(hit.push, hit.felt) * dot(hit.felt, ahead)
    if onward < 0.0 and bank > 0.0:
        friction = max(dot(hit.velocity, ahead) - onward - bank, 0.0)
        velocity = add_scaled(velocity, -onward * bank / (bank + friction), ahead)
    approach_speed = -dot(hit.velocity, hit.normal)
    most = max(approach_speed, 0.0) * (1.0 + 2.0 * hit.restitution) / 3.0
    return add_scaled(velocity, min(most - dot(velocity, hit.normal), 0.0), hit.normal)


def record(scene: Scene) -> Turf:
    """Record for `scene`."""
    return Turf()


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, hard ground, or ''."""
    soft = any(shape.material.softness > 0 for shape in scene.course.ground)
    return '' if soft else 'all ground is hard'


def dormant(scene: Scene) -> Turf:
    """Record that tilts nothing: a course of hard ground compiles nothing."""
    return Turf(rate=0.0)
