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

"""Leaves: they brake a ball that passes through them, and do not turn it."""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from . import protocol, Scene
from .protocol import Flow
from ..geometry.solid import solid_box, Sphere
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import CourseRecord, ShapeRecord, StructRecord, Vector
from ..mechanics.vector import length, scale, ZERO

LEAF = np.dtype(
    [
        ('center', 'f8', 3),
        ('radius', 'f8'),
        ('low', 'f8'),
        ('high', 'f8'),
        ('is_sphere', 'i8'),
        ('drag', 'f8'),
    ],
    align=True,
)
FINE = 0.1  # of a body's radius: the longest way in a step near it and in it


class Foliage(NamedTuple):
    """Bodies of leaves: in one a ball of velocity v is braked by drag |v| v, drag in 1/m."""

    bodies: np.ndarray


@kernel
def clearance(body: StructRecord, point: Vector) -> float:
    """Lower bound on the distance of `point` from a body of leaves; 0 or less in it."""
    dx = point[0] - body['center'][0]
    dy = point[1] - body['center'][1]
    if body['is_sphere']:
        dz = point[2] - body['center'][2]
        return sqrt(dx * dx + dy * dy + dz * dz) - body['radius']
    over = max(point[2] - body['high'], body['low'] - point[2])
    return max(over, sqrt(dx * dx + dy * dy) - body['radius'])


@protocol.acceleration.register(Foliage)
def _acceleration(effect: Foliage, flow: Flow) -> Vector:
    total = 0.0
    for i in range(len(effect.bodies)):
        if clearance(effect.bodies[i], flow.position) < 0.0:
            total += effect.bodies[i]['drag']
    if total == 0.0:
        return ZERO
    return scale(-total * length(flow.over_ground), flow.over_ground)


@protocol.longest_step.register(Foliage)
def _longest_step(
    effect: Foliage, ground: Ground, flow: Flow, force: Vector, wanted: float
) -> float:
    speed = length(flow.over_ground)
    way = inf
    for i in range(len(effect.bodies)):
        body = effect.bodies[i]
        way = min(way, max(clearance(body, flow.position), FINE * body['radius']))
    return min(way / speed, wanted) if speed > 0.0 else wanted


def leafy(course: CourseRecord) -> list[ShapeRecord]:
    """Obstacles of a course that are leaves."""
    return [shape for shape in course.obstacles if shape.material.drag > 0.0]


def record(scene: Scene) -> Foliage:
    """Record for `scene`."""
    rows = []
    for shape in leafy(scene.course):
        is_sphere = isinstance(shape, Sphere)
        low, high = solid_box(shape)
        rows.append(
            (
                shape.center if is_sphere else shape.base,
                shape.radius,
                low[2],
                high[2],
                is_sphere,
                shape.material.drag,
            )
        )
    return Foliage(np.array(rows, LEAF))


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no leaves, or ''."""
    return '' if leafy(scene.course) else 'no leaves'


def dormant(scene: Scene) -> Foliage:
    """Record of no leaves: a course with some compiles nothing."""
    return Foliage(np.zeros(0, LEAF))
