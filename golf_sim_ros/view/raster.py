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

"""The ground from above on a grid, all places at once, for display.

`drawing.relief` asks the physics place by place, which takes 50 us each in plain Python. A page
needs two million places: here each shape fills its part of the grid.
"""

from functools import singledispatch
from typing import Any

import numpy as np

from ..physics import Course, geometry, ground_height, Heightmap, Mesh, Patch, Plane
from ..physics.geometry.bicubic import hermite, slopes
from ..physics.geometry.heightmap import corners
from ..physics.geometry.plane_patch import frame
from ..physics.geometry.zone import places_inside, zones_of
from ..physics.scene.kernel_model import materials

SAME_HEIGHT = 1e-6  # m: at equal height the later shape counts
UPRIGHT = 1e-3  # a normal's z below which a shape is a line from above
NO_GROUND = 255


def ground_grid(course: Course, x: np.ndarray, y: np.ndarray) -> tuple:
    """Heights and materials of the highest ground on a grid.

    Parameters
    ----------
    course : Course
    x, y : ndarray
        Rising, (nx,) and (ny,), places along both axes [m].

    Returns
    -------
    heights : ndarray, (ny, nx)
        [m]; not a number where there is no ground.
    numbers : ndarray of uint8, (ny, nx)
        Rows of `materials(course)`; `NO_GROUND` where there is no ground.
    """
    heights = np.full((len(y), len(x)), -np.inf)
    numbers = np.full((len(y), len(x)), NO_GROUND, np.uint8)
    number_of = {material: number for number, material in enumerate(materials(course))}
    for shape in course.ground:
        part = window(shape, x, y)
        z = height_on(shape, x[part[1]], y[part[0]])
        seen = z >= heights[part] - SAME_HEIGHT
        heights[part] = np.where(seen, np.maximum(z, heights[part]), heights[part])
        numbers[part][seen] = number_of[shape.material]
    ground = numbers != NO_GROUND
    heights[~ground] = np.nan
    for zone in zones_of(course.zones):
        part = box(np.min(zone.polygon, 0), np.max(zone.polygon, 0), x, y)
        painted = covered(zone.polygon, zone.cut, x[part[1]], y[part[0]]) & ground[part]
        numbers[part][painted] = number_of[zone.material]
    return heights, numbers


def window(shape: Any, x: np.ndarray, y: np.ndarray) -> tuple:
    """Slices of rows and columns of a grid over which `shape` may lie."""
    if isinstance(shape, Plane):
        return np.s_[:, :]
    if is_wall(shape):
        return np.s_[:0, :0]
    low, high = extent(shape)
    return box(low, high, x, y)


def extent(shape: Any) -> tuple:
    """Corners (x, y) of the rectangle around a shape that is not endless."""
    if isinstance(shape, Mesh):
        places = np.asarray(shape.vertices, float)[np.asarray(shape.faces)].reshape(-1, 3)
    elif isinstance(shape, Heightmap):
        places = np.array(corners(shape))
    elif isinstance(shape, Patch):
        places = np.array(rectangle(shape))
    else:
        places = np.array(geometry.extent(shape))
    return places[:, :2].min(0), places[:, :2].max(0)


def rectangle(patch: Patch) -> list:
    """Four corners of `patch`."""
    _, along, across = frame(patch.normal, patch.heading)
    along, across = 0.5 * patch.length * along, 0.5 * patch.width * across
    turns = (along + across, across - along, -along - across, along - across)
    return [np.add(patch.center, turn) for turn in turns]


def is_wall(shape: Any) -> bool:
    """Whether a shape is a rectangle that stands upright: a line from above."""
    return isinstance(shape, Patch) and abs(shape.normal[2]) < UPRIGHT * np.linalg.norm(
        shape.normal
    )


def box(low: np.ndarray, high: np.ndarray, x: np.ndarray, y: np.ndarray) -> tuple:
    """Slices of rows and columns of a grid within the rectangle from `low` to `high`."""
    rows, columns = (
        slice(*np.searchsorted(places, (low[axis] - 1e-9, high[axis] + 1e-9)))
        for axis, places in ((1, y), (0, x))
    )
    return rows, columns


def covered(polygon: Any, cuts: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether `polygon`, without `cuts`, holds each place of a grid."""
    places = [grid.ravel() for grid in np.meshgrid(x, y)]
    inside = places_inside(polygon, *places)
    for cut in cuts:
        inside &= ~places_inside(cut, *places)
    return inside.reshape(len(y), len(x))


@singledispatch
def height_on(shape: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights of one shape on a grid; minus infinity where it is not.

    A kind of ground that has no function of its own here is asked place by place.
    """
    alone = Course(ground=(shape,))
    found = [[ground_height(alone, float(a), float(b)) for a in x] for b in y]
    rows = [[place[0] if place else -np.inf for place in row] for row in found]
    return np.array(rows, float).reshape(len(y), len(x))


@height_on.register
def _plane(shape: Plane, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return without(shape.cut, incline(shape.point, shape.normal, x, y), x, y)


@height_on.register
def _patch(shape: Patch, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    heights = incline(shape.center, shape.normal, x, y)
    if not np.isfinite(heights).any():
        return heights
    _, along, across = frame(shape.normal, shape.heading)
    way = [
        np.broadcast_to(x, heights.shape) - shape.center[0],
        np.broadcast_to(y[:, np.newaxis], heights.shape) - shape.center[1],
        heights - shape.center[2],
    ]
    for direction, length in ((along, shape.length), (across, shape.width)):
        place = sum(d * w for d, w in zip(direction, way))
        heights[np.abs(place) > 0.5 * length + 1e-9] = -np.inf
    return without(shape.cut, heights, x, y)


@height_on.register
def _heightmap(shape: Heightmap, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    along, up = ((p - o) / shape.spacing for p, o in zip((x, y), shape.origin))
    return spline(spline(np.asarray(shape.heights, float), up).T, along).T


@height_on.register
def _mesh(shape: Mesh, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    heights = np.full((len(y), len(x)), -np.inf)
    for triangle in np.asarray(shape.vertices, float)[np.asarray(shape.faces)]:
        part = box(triangle[:, :2].min(0), triangle[:, :2].max(0), x, y)
        a, b, c = triangle
        normal = np.cross(b - a, c - a)
        if abs(normal[2]) < 1e-12 or not heights[part].size:
            continue
        across, up = x[part[1]] - a[0], (y[part[0]] - a[1])[:, np.newaxis]
        v = (across * (c - a)[1] - up * (c - a)[0]) / normal[2]
        w = (up * (b - a)[0] - across * (b - a)[1]) / normal[2]
        inside = (v >= -1e-9) & (w >= -1e-9) & (v + w <= 1.0 + 1e-9)
        z = a[2] + v * (b - a)[2] + w * (c - a)[2]
        heights[part] = np.where(inside, np.maximum(heights[part], z), heights[part])
    return heights


def incline(place: tuple, normal: tuple, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights on a grid of the plane through `place`; minus infinity where it is upright."""
    if abs(normal[2]) < UPRIGHT * np.linalg.norm(normal):
        return np.full((len(y), len(x)), -np.inf)
    along, up = x - place[0], (y - place[1])[:, np.newaxis]
    return place[2] - (normal[0] * along + normal[1] * up) / normal[2]


def without(cuts: tuple, heights: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """`heights` on a grid, minus infinity within the polygons `cuts`."""
    for cut in cuts:
        part = box(np.min(cut, 0), np.max(cut, 0), x, y)
        heights[part][covered(cut, (), x[part[1]], y[part[0]])] = -np.inf
    return heights


def spline(values: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Natural cubic splines through the columns of `values`, (n, m), at `places` in rows."""
    slope = slopes(values)
    row = np.clip(places.astype(int), 0, len(values) - 2)
    t = (places - row)[:, np.newaxis]
    return np.asarray(hermite(values[row], slope[row], values[row + 1], slope[row + 1], t)[0])
