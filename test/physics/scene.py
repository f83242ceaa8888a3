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

"""What a ball's place and motion on the shapes mean, worked out apart from the physics.

The shapes are planes, patches and meshes.
"""

from functools import lru_cache
from math import cos, inf, pi, sin
from typing import NamedTuple

from golf_sim_ros.physics import Mesh, Plane
import numpy as np

GRAVITY = 9.80665


def energy(course, ball):
    """Energy over mass [J/kg] of a ball, with its height counted from z = 0."""
    v, w = np.array(ball.velocity), np.array(ball.spin)
    turning = course.ball.inertia * course.ball.radius**2 * (w @ w)
    return 0.5 * (v @ v + turning) + GRAVITY * ball.position[2]


class Faces(NamedTuple):
    """Rectangles: centres, normals, unit vectors along and across with half sizes.

    A row a shape.
    """

    centers: np.ndarray
    normals: np.ndarray
    sides: np.ndarray
    halves: np.ndarray
    solid: np.ndarray
    cuts: tuple
    one_sided: np.ndarray


def sides_of(shape):
    """Find the unit vectors along and across a shape."""
    normal = np.array(shape.normal, float) / np.linalg.norm(shape.normal)
    heading = getattr(shape, 'heading', 0.0)
    ahead = np.array([cos(heading), sin(heading), 0.0])
    ahead -= (ahead @ normal) * normal
    if np.linalg.norm(ahead) < 1e-9:
        ahead = np.cross([0.0, 0.0, 1.0], normal)
    ahead /= np.linalg.norm(ahead)
    return ahead, np.cross(normal, ahead)


def gaps_to_triangles(corners, point):
    """Distances of `point` from triangles with `corners`, (n, 3, 3)."""
    to, sides = point - corners, np.roll(corners, -1, axis=1) - corners
    normals = np.cross(sides[:, 0], sides[:, 1])
    over = (np.cross(sides, to) * normals[:, np.newaxis]).sum(2).min(1) >= 0
    heights = abs((to[:, 0] * normals).sum(1)) / np.linalg.norm(normals, axis=1)
    t = np.clip((to * sides).sum(2) / (sides * sides).sum(2), 0, 1)
    to_sides = np.linalg.norm(to - t[..., np.newaxis] * sides, axis=2).min(1)
    return np.where(over, heights, to_sides)


@lru_cache
def faces(ground):
    """`Faces` of planes and patches."""
    solid = np.array([isinstance(shape, Plane) for shape in ground])
    return Faces(
        np.array(
            [shape.point if plane else shape.center for shape, plane in zip(ground, solid)], float
        ),
        np.array([np.array(shape.normal) / np.linalg.norm(shape.normal) for shape in ground]),
        np.array([sides_of(shape) for shape in ground]),
        np.array(
            [
                (inf, inf) if plane else (0.5 * shape.length, 0.5 * shape.width)
                for shape, plane in zip(ground, solid)
            ]
        ),
        solid,
        tuple(shape.cut for shape in ground),
        np.array([getattr(shape, 'one_sided', False) for shape in ground]),
    )


@lru_cache
def rims(ground):
    """Find starts and ends of the edges of all cuts, two (n, 3) arrays."""
    lines = [
        (lifted(shape, a), lifted(shape, b))
        for shape in ground
        for cut in shape.cut
        for a, b in zip(cut, (*cut[1:], cut[0]))
    ]
    return np.array(lines, float).reshape(-1, 2, 3).transpose(1, 0, 2)


def lifted(shape, corner):
    """Point of a shape's plane at `corner`, x and y."""
    (x, y), n = corner, shape.normal
    px, py, pz = shape.point if isinstance(shape, Plane) else shape.center
    return x, y, pz - (n[0] * (x - px) + n[1] * (y - py)) / n[2]


def inside(outline, x, y):
    """Whether a polygon contains the point."""
    odd = False
    for (ax, ay), (bx, by) in zip(outline, (*outline[1:], outline[0])):
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            odd = not odd
    return odd


def gaps(course, point):
    """Distances of a ball at `point` from each shape and rim: inf where it has been cut away.

    Under a plane they are negative. Meshes and rims come after the shapes, one-sided shapes last.
    """
    ground = tuple(shape for shape in course.ground if not isinstance(shape, Mesh))
    meshes = [
        gaps_to_triangles(np.asarray(mesh.vertices)[mesh.faces], np.asarray(point))
        for mesh in course.ground
        if isinstance(mesh, Mesh)
    ]
    all_faces = faces(ground)
    d = np.asarray(point, float) - all_faces.centers
    on_sides = np.einsum('ijk,ik->ij', all_faces.sides, d)
    heights = np.einsum('ij,ij->i', all_faces.normals, d)
    over = on_sides - np.clip(on_sides, -all_faces.halves, all_faces.halves)
    offsets = heights[:, np.newaxis] * all_faces.normals + np.einsum(
        'ij,ijk->ik', over, all_faces.sides
    )
    away = np.where(all_faces.solid, heights, np.linalg.norm(offsets, axis=1))
    feet = np.asarray(point) - offsets
    for i in np.flatnonzero(away < 2 * course.ball.radius):
        if any(inside(cut, *feet[i, :2]) for cut in all_faces.cuts[i]):
            away[i] = inf
    starts, ends = rims(ground)
    way = ends - starts
    t = np.clip(((point - starts) * way).sum(1) / (way * way).sum(1), 0, 1)
    to_rims = np.linalg.norm(point - starts - t[:, np.newaxis] * way, axis=1)
    both = np.concatenate(
        [away[~all_faces.one_sided], *meshes, to_rims, away[all_faces.one_sided]]
    )
    return both - course.ball.radius, all_faces.one_sided.sum()


def depth(course, point):
    """How deep [m] a ball at `point` is in the ground.

    It may pass a one-sided sheet from behind.
    """
    found, one_sided = gaps(course, point)
    return -min(0.0, *found[: len(found) - one_sided])


def touches(course, point, within=1e-6):
    """Whether a ball at `point` touches any ground."""
    return bool((np.abs(gaps(course, point)[0]) <= within).any())


def bowl(rings=8, spokes=24, radius=0.6, depth=0.2):
    """Make a dish of triangles around the z axis, in facets."""
    places = [(0.0, 0.0, 0.0)]
    for ring in range(1, rings + 1):
        for spoke in range(spokes):
            angle = 2 * pi * (spoke + 0.5 * (ring % 2)) / spokes
            r = radius * ring / rings
            places.append((r * cos(angle), r * sin(angle), depth * (r / radius) ** 2))
    faces = [(0, 1 + k, 1 + (k + 1) % spokes) for k in range(spokes)]
    for ring in range(1, rings):
        for k in range(spokes):
            a, b = 1 + (ring - 1) * spokes + k, 1 + (ring - 1) * spokes + (k + 1) % spokes
            c, d = a + spokes, b + spokes
            faces += [(a, b, d), (a, d, c)] if ring % 2 == 0 else [(a, b, c), (b, d, c)]
    return np.array(places), np.array(faces)
