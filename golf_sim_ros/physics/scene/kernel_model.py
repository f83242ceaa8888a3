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

"""Model of a world for kernels: ball, effects, ground and accuracy limits, as one record."""

from __future__ import annotations

from typing import Any, NamedTuple, TYPE_CHECKING

import numpy as np

from .course_record import Ball, Course
from .kept import kept
from .. import geometry as ground_
from ..effects import protocol
from ..geometry.cup import cup_in, opening
from ..geometry.solid import Flagstick
from ..geometry.surfaces import Ground
from ..jit import GenericKernel
from ..kernel_types import Effects, MethodRecord, ShapeRecord
from ..properties.material import Material, table

if TYPE_CHECKING:
    from .presets import Preset

# Fields of a course that its ground depends on.
OF_GROUND = (
    'ground',
    'hole',
    'flagstick',
    'cup',
    'stick',
    'bounds',
    'zones',
    'obstacles',
    'water',
)


class Nothing(NamedTuple):
    """Effect that does nothing, since numba can't iterate over an empty tuple."""

    amount: float = 0.0


class Limits(NamedTuple):
    """Limits of accuracy.

    ``settle`` [m/s], the restitution threshold: bounces of slower rebound are summed in closed
    form, as micro-bounces, instead of followed one by one; ``path`` [m]: how far a segment's curve
    may lie from a closed form or off the ground.
    """

    settle: float
    path: float


class GroundScene(NamedTuple):
    """Model for a ball in contact.

    ``effects`` act on it as on any ball; ``air`` are those by which moving air pushes it, or
    `Nothing` where the air is still.
    """

    ball: Ball
    effects: Effects
    air: Effects
    ground: Ground
    materials: np.ndarray
    limits: Limits


class Model(NamedTuple):
    """Model of a world: the ground scene, the effects in flight, the integrator."""

    land: GroundScene
    effects: Effects
    method: MethodRecord


def material_names(course: Course) -> tuple[str, ...]:
    """Names of the materials of a course, in the order of their numbers."""
    return tuple(material.name for material in materials(course))


def materials(course: Course) -> tuple[Material, ...]:
    """Materials of a course, in the order of their numbers."""
    return tuple(
        dict.fromkeys(
            [
                *(shape.material for shape in shapes(course)),
                *(zone[0] for zone in course.zones),
                *((course.cup, course.stick) if course.hole else ()),
            ]
        )
    )


def shapes(course: Course) -> tuple[ShapeRecord, ...]:
    """Shapes of a course that balls can touch, ground and obstacles: they pass through leaves."""
    return course.ground + tuple(o for o in course.obstacles if o.material.drag == 0.0)


def build_model(course: Course, records: Effects, preset: Preset) -> Model:
    """`Model` of `course` with effect `records` and an accuracy `preset`.

    Types are cast here, once: a kernel would be recompiled for an int in place of a float.
    """
    on_land = speaking(records, protocol.gravity, protocol.contact_normal)
    land = GroundScene(
        Ball(*map(float, course.ball)),
        on_land,
        by_air(records),
        ground(course),
        table(materials(course)),
        preset.limits,
    )
    return Model(land, in_flight(records), preset.method)


def with_effects(model: Model, records: Effects) -> Model:
    """`Model` with other effect `records`, which have changed with the air only."""
    return model._replace(
        land=model.land._replace(air=by_air(records)), effects=in_flight(records)
    )


def in_flight(records: Effects) -> Effects:
    """Effects among `records` that act on a ball in flight or under water."""
    return speaking(
        records,
        protocol.gravity,
        protocol.air_velocity,
        protocol.acceleration,
        protocol.spin_rate,
        protocol.under_water,
    )


def by_air(records: Effects) -> Effects:
    """Effects among `records` by which moving air acts on a ball in contact.

    `Nothing` where no air moves.
    """
    if not any(type(r) in protocol.air_velocity.cases for r in records):
        return (Nothing(),)
    return speaking(records, protocol.air_velocity, protocol.acceleration)


def speaking(records: Effects, *some: GenericKernel[..., Any]) -> Effects:
    """Effects among `records` that have a body for one of `some` laws.

    `Nothing` where none has.
    """
    return tuple(r for r in records if any(type(r) in law.cases for law in some)) or (Nothing(),)


def of_ground(course: Course) -> Course:
    """Return `course` without what does not matter to its ground."""
    return Course(**{name: getattr(course, name) for name in OF_GROUND})


def ground(course: Course) -> Ground:
    """`Ground` of a course for kernels.

    It is built once a course, and shared, so nobody writes into it.

    ValueError where the hole is in ground that is too uneven.
    """
    return built(of_ground(course))


@kept
def built(course: Course) -> Ground:
    """`Ground` of a `course`, in all that matters to it."""
    number = {material: i for i, material in enumerate(materials(course))}
    if course.hole is None:
        return ground_.build(
            shapes(course), course.zones, course.bounds, None, number, course.water
        )
    cup = cup_in(bare_ground(course), *course.hole, materials(course), course.cup)
    bottom = (*course.hole, opening(cup)[-1])
    stick = (Flagstick(bottom, material=course.stick),) if course.flagstick else ()
    return ground_.build(
        (*shapes(course), cup, *stick),
        course.zones,
        course.bounds,
        opening(cup),
        number,
        course.water,
    )


def bare_ground(course: Course) -> Ground:
    """`Ground` of a course without obstacles, hole and flagstick, for queries of its height."""
    return built_bare(of_ground(course))


@kept
def built_bare(course: Course) -> Ground:
    """`bare_ground` of a `course`, in all that matters to it."""
    number = {material: i for i, material in enumerate(materials(course))}
    return ground_.build(course.ground, course.zones, course.bounds, None, number)
