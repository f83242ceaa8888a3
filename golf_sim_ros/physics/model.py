# SPDX-License-Identifier: Apache-2.0
"""What kernels need to know of a world: the ball, the effects, the ground, and how exact to be."""
from typing import NamedTuple

import numpy as np

from . import effects as effects_
from . import ground as ground_
from .course import Ball
from .effects import Scene
from .ground.surface import Ground
from .material import table


class Limits(NamedTuple):
    """How exact to be.

    ``settle`` [m/s]: rebounds slower than this are summed in closed form instead of followed one
    by one; ``path`` [m]: how far the curve that ticks read may lie from a closed form.
    """

    settle: float
    path: float


class Model(NamedTuple):
    """A world for kernels."""

    ball: Ball
    effects: tuple
    ground: Ground
    materials: np.ndarray
    method: NamedTuple
    limits: Limits


def material_names(course):
    """Names of the materials of a course, in the order of their numbers."""
    return tuple(material.name for material in _materials(course))


def _materials(course):
    return tuple(dict.fromkeys(shape.material for shape in course.ground))


def build(course, records, preset):
    """`Model` of `course` with effect `records` and an accuracy `preset`.

    Types are cast here, once: a kernel would compile anew for an int in place of a float.
    """
    materials = _materials(course)
    number = {material: i for i, material in enumerate(materials)}
    return Model(Ball(*map(float, course.ball)), tuple(records),
                 ground_.build(course.ground, course.bounds, number), table(materials),
                 preset.method, preset.limits)


def choose(names, course, balls, wind):
    """Effect records of a scene and reasons of those left out; see `effects.choose`."""
    return effects_.choose(names, Scene(course, balls, tuple(map(float, wind))))
