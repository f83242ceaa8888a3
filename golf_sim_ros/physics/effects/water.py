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

"""Water: drag and buoyancy of a ball under water."""

from math import pi
from typing import NamedTuple

from . import protocol, Scene
from ..kernel_types import Vector
from ..mechanics.vector import add, length, scale, sub
from ..properties.water import ADDED_MASS, WATER_DENSITY

# Of a smooth sphere at Reynolds numbers of 1e3 to 2e5, those of a sinking golf ball being about
# 2e4 (Schlichting, Boundary-Layer Theory). That dimples hardly count there is an estimate.
DRAG_COEFFICIENT = 0.45


class UnderWater(NamedTuple):
    """A ball of velocity v is accelerated by `share` times (1 - `buoyancy`) g - `push` |v| v.

    `push` is rho A cd / (2 m) [1/m]; `buoyancy` the water's density over the ball's; `share` the
    ball's mass over its mass with the water that it carries along.
    """

    push: float
    buoyancy: float
    share: float


@protocol.under_water.register(UnderWater)
def _under_water(effect: UnderWater, weight: Vector, velocity: Vector) -> Vector:
    felt = scale(1.0 - effect.buoyancy, weight)
    drag = scale(-effect.push * length(velocity), velocity)
    return sub(scale(effect.share, add(felt, drag)), weight)


def record(scene: Scene) -> UnderWater:
    """Record for `scene`."""
    ball = scene.course.ball
    buoyancy = 4.0 / 3.0 * pi * ball.radius**3 * WATER_DENSITY / ball.mass
    push = 0.5 * WATER_DENSITY * DRAG_COEFFICIENT * pi * ball.radius**2 / ball.mass
    return UnderWater(float(push), float(buoyancy), float(1.0 / (1.0 + ADDED_MASS * buoyancy)))


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no water, or ''."""
    return '' if scene.course.water else 'no water'


def dormant(scene: Scene) -> UnderWater:
    """Record where there is no water: no ball ever feels it.

    A course with some compiles nothing.
    """
    return record(scene)
