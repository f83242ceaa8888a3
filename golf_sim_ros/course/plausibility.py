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

"""Plausibility of a course: meshes on their side or far from the tee."""

from collections.abc import Callable, Sequence
from math import dist
from pathlib import Path

import numpy as np

from ..physics import Course, Material
from ..physics.geometry.heightmap import corners as map_corners
from ..physics.geometry.heightmap import Heightmap
from ..physics.geometry.mesh import Mesh
from ..physics.geometry.surfaces import look_down
from ..physics.scene.kernel_model import bare_ground, materials

SMALL = 10.0  # m: smaller ones are bunkers and the like, which nobody tees up on


def misplaced(course: Course, files: Sequence[str | None]) -> list[str]:
    """Note meshes that are large enough to be the ground, and are not.

    That is, to be the ground between tee and hole, and are not under them.

    Parameters
    ----------
    course : Course
    files : sequence of str or None
        Names of the files of what is in ``course.ground``.
    """
    meshes = [
        (shape, Path(file or '').name)
        for shape, file in zip(course.ground, files)
        if isinstance(shape, Mesh)
    ]
    places = [('tee', course.tee), ('hole', course.hole)]
    asked = [
        (what, place)
        for what, place in places
        if place is not None and not any(is_under(mesh, place) for mesh, _ in meshes)
    ]
    apart = dist(course.tee, course.hole) if course.hole else 0.0
    return [
        f'{name}: has no ground where the {what} is, {list(place)}: it reaches {reach(mesh)}'
        for mesh, name in meshes
        if max(sizes(mesh)) >= max(SMALL, 0.5 * apart)
        for what, place in asked
    ]


def looker(course: Course) -> Callable[[float, float], tuple[float, Material] | None]:
    """Make the function that looks down at x, y.

    It gives height [m] and `Material` of the highest ground there, or None without any.
    """
    ground, known = bare_ground(course), materials(course)

    def look(x: float, y: float) -> tuple[float, Material] | None:
        z, part, number = look_down(ground, float(x), float(y))
        return None if part < 0 else (z, known[number])

    return look


def sizes(mesh: Mesh) -> np.ndarray:
    """How long and how wide a mesh is, seen from above."""
    return np.ptp(mesh.vertices[mesh.faces].reshape(-1, 3)[:, :2], 0)


def reach(mesh: Mesh) -> str:
    """From where to where a mesh goes, in words."""
    corners = mesh.vertices[mesh.faces].reshape(-1, 3)
    return ', '.join(
        f'{axis} {low:g} to {high:g}'
        for axis, low, high in zip('xyz', corners.min(0), corners.max(0))
    )


def reach_of_map(shape: Heightmap) -> str:
    """`reach` of a height map."""
    return ', '.join(
        f'{axis} {low:g} to {high:g}' for axis, low, high in zip('xy', *map_corners(shape))
    )


def is_under(mesh: Mesh, place: tuple[float, float]) -> bool:
    """Whether some triangle of a mesh lies under or over a place in plan."""
    corners = mesh.vertices[mesh.faces][:, :, :2] - place
    near = ((corners.min(1) <= 0.0) & (corners.max(1) >= 0.0)).all(1)
    a, b, c = corners[near].transpose(1, 0, 2)
    turns = np.stack(
        [p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] for p, q in ((a, b), (b, c), (c, a))], 1
    )
    upright = np.abs(turns.sum(1)) <= 1e-12
    return bool((((turns >= 0.0).all(1) | (turns <= 0.0).all(1)) & ~upright).any())


def files_reach(course: Course, files: Sequence[str | None]) -> str:
    """Say where meshes and height maps of a course are; '' without any.

    For a message where tee or hole has no ground.
    """
    told = []
    for shape, file in zip(course.ground, files):
        if isinstance(shape, (Mesh, Heightmap)):
            there = reach(shape) if isinstance(shape, Mesh) else reach_of_map(shape)
            told.append(f'{Path(file or "").name} reaches {there}')
    return f'; {"; ".join(told[:3])}' if told else ''
