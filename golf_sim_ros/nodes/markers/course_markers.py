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

"""The course as markers: one list of triangles a material, and what stands on the ground."""

from collections.abc import Callable, Iterable, Sequence
from functools import singledispatch
from typing import Any

from geometry_msgs.msg import Point
import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from ...drawing.polygon_triangles import Polygon, triangles
from ...drawing.relief import relief
from ...drawing.sunlight import banded, lit
from ...drawing.zone_triangles import cells, curved, flat, sheet
from ...physics import Course, geometry, ground_height, Material
from ...physics.geometry.cup import DEPTH, RADIUS
from ...physics.geometry.heightmap import corners as corners_of_map
from ...physics.geometry.heightmap import Heightmap
from ...physics.geometry.mesh import Mesh
from ...physics.geometry.patch import Patch
from ...physics.geometry.plane import Plane
from ...physics.geometry.plane_patch import frame
from ...physics.geometry.solid import FLAGSTICK_HEIGHT, FLAGSTICK_RADIUS, Sphere

Corner = Sequence[float]  # x, y, z
Painted = list[tuple[Material, Any]]  # materials, and triangles of each

MARGIN = 60.0  # m of an endless plane that are drawn around everything else
HOLE_DIAMETER = 2 * RADIUS
FLAG = ((0.0, 2.13), (0.0, 1.73), (-0.6, 1.93))  # m: along x and over the stick's foot
TEE_MARKERS = 4.0  # m from one to the other
UPRIGHT = 1e-3  # a normal's z below which a shape is a line from above
BLACK = (0.0, 0.0, 0.0)
WHITE = (1.0, 1.0, 1.0)
RED = (0.85, 0.1, 0.1)
SHADES = 255  # of red, green and blue that a screen shows
GRID = 33  # heights a side of ground that is shown by its heights
BLUE = (0.15, 0.4, 0.75)  # water
CLEAR = 0.6  # how much of it is seen


def course_markers(course: Course, frame_id: str) -> MarkerArray:
    """Make the MarkerArray of `course`, stamp 0 so that viewers use their newest transform."""
    by_material: dict[Material, list[np.ndarray]] = {}
    for number, shape in enumerate(course.ground):
        for material, pieces in surface(shape, course, number):
            corners = np.asarray(pieces, float).reshape(-1, 3, 3)
            by_material.setdefault(material, []).append(corners)
    lists = [
        ground_marker(number, material, np.concatenate(corners))
        for number, (material, corners) in enumerate(by_material.items())
        if any(map(len, corners))
    ]
    markers = [*lists, *tee(course), *hole(course), *obstacles(course), *water(course)]
    for marker in markers:
        marker.header.frame_id = frame_id
    return MarkerArray(markers=markers)


def ground_marker(number: int, material: Material, corners: np.ndarray) -> Marker:
    """Make the TRIANGLE_LIST of all that is of `material`: triangles (n, 3, 3).

    Viewers light a list without colours of its own, half of it ambient, and show it nearly black:
    each point has a colour, in which the sun is baked.
    """
    made = marker('ground', number, Marker.TRIANGLE_LIST, (1.0, 1.0, 1.0), material.color)
    places = banded(corners, material)
    made.points = shared(point, places.reshape(-1, 3))
    shades = np.round(SHADES * lit(places, material)) / SHADES
    made.colors = shared(rgb, np.repeat(shades, 3, axis=0))
    return made


def shared(message: Callable[..., Any], rows: np.ndarray) -> list[Any]:
    """Make the messages of `rows`, an array (n, k); equal rows have the same one.

    A message takes some 140 bytes, and neighbouring triangles share their corners.
    """
    kinds, numbers = np.unique(rows, axis=0, return_inverse=True)
    made = [message(row) for row in kinds.tolist()]
    return [made[number] for number in numbers.reshape(-1).tolist()]


@singledispatch
def surface(shape: Any, course: Course, number: int) -> Painted:
    """Materials, and triangles of three (x, y, z) of each, that show entry `number` of the ground.

    A kind of ground that has no function of its own here is shown by its heights on a grid.
    """
    low, high = geometry.extent(shape)
    x, y = (np.linspace(low[axis], high[axis], GRID) for axis in (0, 1))
    heights, _ = relief(course._replace(ground=(shape,), hole=None, zones=()), x, y[:, np.newaxis])
    corners = sheet(x, y, heights)
    return curved(corners[np.isfinite(corners).all((1, 2))], shape.material, course.zones)


@surface.register
def _plane(shape: Plane, course: Course, number: int) -> Painted:
    if abs(shape.normal[2]) < UPRIGHT:
        return wall(shape)
    pieces = flat(outskirts(course), covered(shape, course, number), shape.material, course.zones)
    return lifted(shape.point, shape.normal, pieces)


@surface.register
def _patch(shape: Patch, course: Course, number: int) -> Painted:
    if abs(shape.normal[2]) < UPRIGHT:
        return standing(shape)
    outline = [tuple(corner[:2]) for corner in rectangle(shape)]
    pieces = flat(outline, covered(shape, course, number), shape.material, course.zones)
    return lifted(shape.center, shape.normal, pieces)


@surface.register
def _mesh(shape: Mesh, course: Course, number: int) -> Painted:
    return curved(shape.vertices[shape.faces], shape.material, course.zones)


@surface.register
def _heightmap(shape: Heightmap, course: Course, number: int) -> Painted:
    return curved(cells(shape.heights, shape.origin, shape.spacing), shape.material, course.zones)


def rectangle(patch: Patch) -> list[np.ndarray]:
    """Four corners of `patch`."""
    _, along, across = frame(patch.normal, patch.heading)
    along, across = 0.5 * patch.length * along, 0.5 * patch.width * across
    return [
        np.add(patch.center, turn)
        for turn in (along + across, across - along, -along - across, along - across)
    ]


def wall(plane: Plane) -> Painted:
    """Two triangles of an upright `plane`, as wide and high as `MARGIN`."""
    return standing(Patch(plane.point, plane.normal, 0.0, MARGIN, MARGIN, plane.material))


def standing(patch: Patch) -> Painted:
    """Two triangles of an upright `patch`."""
    corners = rectangle(patch)
    return [(patch.material, [corners[:3], [corners[0], *corners[2:]]])]


def lifted(place: Corner, normal: Corner, pieces: Painted) -> Painted:
    """`pieces`, pairs of a material and triangles of (x, y), with z of the plane at `place`."""

    def height(x: float, y: float) -> float:
        return place[2] - (normal[0] * (x - place[0]) + normal[1] * (y - place[1])) / normal[2]

    return [
        (material, [[(x, y, height(x, y)) for x, y in corners] for corners in found])
        for material, found in pieces
    ]


def covered(shape: Plane | Patch, course: Course, number: int) -> list[Polygon]:
    """Polygons where `shape` is not seen: its cuts, and later patches in the same plane."""
    after = number + 1
    later = [
        patch
        for patch in course.ground[after:]
        if isinstance(patch, Patch) and not patch.cut and coplanar(shape, patch)
    ]
    return [*shape.cut, *([tuple(corner[:2]) for corner in rectangle(patch)] for patch in later)]


def coplanar(shape: Plane | Patch, patch: Patch) -> bool:
    """Whether `patch` lies in the plane of `shape`."""
    normal = frame(shape.normal, 0.0)[0]
    place = shape.point if isinstance(shape, Plane) else shape.center
    parallel = abs(frame(patch.normal, 0.0)[0] @ normal) > 1 - 1e-12
    return parallel and abs(np.subtract(patch.center, place) @ normal) < 1e-6


def outskirts(course: Course) -> Polygon:
    """Corners of a rectangle around all that lies on `course`, `MARGIN` wide."""
    places = [course.tee, *([course.hole] if course.hole else []), *(course.bounds or ())]
    for shape in course.ground:
        places += [tuple(corner[:2]) for corner in extent(shape)]
    low, high = np.min(places, 0) - MARGIN, np.max(places, 0) + MARGIN
    return (low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])


def extent(shape: Any) -> Sequence[Any]:
    """Points around what is finite of `shape`."""
    if isinstance(shape, Mesh):
        used = shape.vertices[shape.faces].reshape(-1, 3)
        return used.min(0), used.max(0)
    if isinstance(shape, Heightmap):
        return corners_of_map(shape)
    if isinstance(shape, Plane):
        return [corner for cut in shape.cut for corner in cut]
    return rectangle(shape) if isinstance(shape, Patch) else geometry.extent(shape)


def tee(course: Course) -> list[Marker]:
    """Make the two balls between which the tee is."""
    made = marker('tee', 0, Marker.SPHERE_LIST, (0.15, 0.15, 0.15), WHITE)
    sides = [(course.tee[0], course.tee[1] + 0.5 * side * TEE_MARKERS) for side in (1, -1)]
    found = [ground_height(course, *side) for side in sides]
    made.points = points((*side, place[0]) for side, place in zip(sides, found) if place)
    return [made]


def hole(course: Course) -> list[Marker]:
    """Disc, flagstick and flag; nothing without a hole."""
    if course.hole is None:
        return []
    x, y = course.hole
    found = ground_height(course, x, y)
    assert found is not None, 'a course is refused that has no ground around its hole'
    z, _ = found
    disc = marker('hole', 0, Marker.CYLINDER, (HOLE_DIAMETER, HOLE_DIAMETER, 0.004), BLACK)
    put(disc, x, y, z)
    return [disc, *flagstick(x, y, z - DEPTH)] if course.flagstick else [disc]


def flagstick(x: float, y: float, z: float) -> list[Marker]:
    """Stick and flag over a hole whose bottom is at `x`, `y`, `z`."""
    diameter, height = 2 * FLAGSTICK_RADIUS, FLAGSTICK_HEIGHT
    stick = marker('hole', 1, Marker.CYLINDER, (diameter, diameter, height), WHITE)
    put(stick, x, y, z + 0.5 * height)
    flag = marker('hole', 2, Marker.TRIANGLE_LIST, (1.0, 1.0, 1.0), RED)
    flag.points = points((x + ahead, y, z + over) for ahead, over in FLAG)
    flag.colors = [rgb(RED)] * len(flag.points)
    return [stick, flag]


def water(course: Course) -> list[Marker]:
    """Make the TRIANGLE_LIST of all water; nothing on dry land.

    The ground below shines through.
    """
    if not course.water:
        return []
    # Its own colour is opaque: RViz multiplies it with those of the points.
    made = marker('water', 0, Marker.TRIANGLE_LIST, (1.0, 1.0, 1.0), BLUE)
    made.points = points(
        (x, y, pond.level)
        for pond in course.water
        for triangle in triangles(pond.polygon, pond.cut)
        for x, y in triangle
    )
    made.colors = [rgb(BLUE, CLEAR)] * len(made.points)
    return [made]


def obstacles(course: Course) -> list[Marker]:
    """Cylinders and spheres."""
    return [obstacle(number, shape) for number, shape in enumerate(course.obstacles)]


def obstacle(number: int, shape: Any) -> Marker:
    """Marker of a cylinder or sphere."""
    across = 2 * shape.radius
    if isinstance(shape, Sphere):
        made = marker(
            'obstacles', number, Marker.SPHERE, (across, across, across), shape.material.color
        )
        put(made, *shape.center)
    else:
        size = (across, across, shape.height)
        made = marker('obstacles', number, Marker.CYLINDER, size, shape.material.color)
        x, y, z = shape.base
        put(made, x, y, z + 0.5 * shape.height)
    return made


def marker(
    namespace: str, number: int, kind: int, scale: Sequence[float], color: Sequence[float]
) -> Marker:
    """Marker of `kind` at the origin."""
    made = Marker(ns=namespace, id=number, type=kind, action=Marker.ADD)
    made.scale.x, made.scale.y, made.scale.z = scale
    made.color = rgb(color)
    made.pose.orientation.w = 1.0
    return made


def rgb(color: Sequence[float], alpha: float = 1.0) -> ColorRGBA:
    """Make the message of a colour."""
    return ColorRGBA(r=float(color[0]), g=float(color[1]), b=float(color[2]), a=alpha)


def put(made: Marker, x: float, y: float, z: float) -> None:
    """Move the marker `made`."""
    place = made.pose.position
    place.x, place.y, place.z = float(x), float(y), float(z)


def point(corner: Corner) -> Point:
    """Make the message of x, y, z."""
    x, y, z = corner
    return Point(x=float(x), y=float(y), z=float(z))


def points(corners: Iterable[Corner]) -> list[Point]:
    """Point messages of triples."""
    return [point(corner) for corner in corners]
