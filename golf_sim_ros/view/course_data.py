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

"""A course as one compact block of bytes for the page: heights, materials, water, obstacles.

Layout, little endian; a height is the sum of the differences before it in its row, in steps::

    'GOLF'  u32 length of JSON  JSON  i16 differences[ny][nx]  u8 materials[my][mx]
"""

from collections.abc import Iterable
import gzip
import json
from math import ceil, sqrt
import struct
from typing import Any, NamedTuple
import zlib

import numpy as np

from .raster import extent, ground_grid, is_wall, rectangle
from ..physics import Course, ground_height, Patch, Plane, Sphere
from ..physics.geometry.zone import zones_of
from ..physics.scene.kernel_model import materials

MARGIN = 0.15  # of the longer side, around all that is finite
MARGINS = 10.0, 45.0  # m: the least and the widest margin
CELLS = 130_000  # heights at most
TEXELS = 2_800_000  # places at most of which the material is told
FINEST = 0.25  # m between heights at least
TEXEL = 5  # materials to a height, along each axis
RANGE = 16_000  # steps of height on either side of the mean: 16 bits hold any difference


class CourseData(NamedTuple):
    """A course for the page: `packed` by gzip; `tag` names the content."""

    packed: bytes
    tag: str
    name: str


def course_data(course: Course) -> CourseData:
    """Compact data of a course, compressed."""
    raw = pack(course)
    return CourseData(gzip.compress(raw, 9, mtime=0), f'{zlib.crc32(raw):08x}', course.name)


def pack(course: Course) -> bytes:
    """Compact data of a course."""
    x, y = grid(course)
    heights, _ = ground_grid(course, x, y)
    lowest = np.nanmin(heights) if np.isfinite(heights).any() else 0.0
    heights = np.nan_to_num(heights, nan=lowest)
    mean = float(np.mean(heights))
    step = max(2e-3 if x[1] - x[0] >= 0.9 else 4e-4, np.abs(heights - mean).max() / RANGE)
    steps = np.round((heights - mean) / step).astype(np.int32)
    differences = np.diff(steps, axis=1, prepend=0).astype(np.int16)
    spacing = x[1] - x[0]
    finer = texels_a_cell(len(x), len(y), spacing)
    columns, rows = (
        places[0] + (np.arange((len(places) - 1) * finer) + 0.5) * spacing / finer
        for places in (x, y)
    )
    _, numbers = ground_grid(course, columns, rows)
    about = description(course)
    about['grid'] = {
        'nx': len(x),
        'ny': len(y),
        'mx': len(columns),
        'my': len(rows),
        'x': float(x[0]),
        'y': float(y[0]),
        'spacing': float(spacing),
        'mean': mean,
        'step': float(step),
    }
    head = json.dumps(about).encode()
    head += b' ' * (len(head) % 2)
    return (
        b'GOLF' + struct.pack('<I', len(head)) + head + differences.tobytes() + numbers.tobytes()
    )


def grid(course: Course) -> tuple:
    """Places along x and y of the heights, on multiples of their spacing."""
    low, high = surroundings(course)
    size = high - low
    margin = min(max(MARGIN * size.max(), MARGINS[0]), MARGINS[1])
    low, high = low - margin, high + margin
    size = high - low
    spacing = max(FINEST, sqrt(size[0] * size[1] / CELLS))
    spacing = 2.0 ** ceil(np.log2(spacing) - 1e-9)
    first, last = np.floor(low / spacing), np.ceil(high / spacing)
    return tuple(spacing * np.arange(first[axis], last[axis] + 1) for axis in (0, 1))


def surroundings(course: Course) -> tuple:
    """Corners of a rectangle around all that is finite, except the bounds."""
    places: list[Any] = [course.tee[:2], *([course.hole[:2]] if course.hole else [])]
    for shape in course.ground:
        whole = isinstance(shape, Plane)
        places += [corner for cut in shape.cut for corner in cut] if whole else extent(shape)
    for shape in course.obstacles:
        x, y = (shape.center if isinstance(shape, Sphere) else shape.base)[:2]
        places += [(x - shape.radius, y - shape.radius), (x + shape.radius, y + shape.radius)]
    for polygon in [
        *(zone.polygon for zone in zones_of(course.zones)),
        *(pond.polygon for pond in course.water),
    ]:
        places += [corner[:2] for corner in polygon]
    low, high = np.min(places, 0), np.max(places, 0)
    return low.astype(float), high.astype(float)


def texels_a_cell(nx: int, ny: int, spacing: float) -> int:
    """How many materials are told to each height, along each axis."""
    most = int(sqrt(TEXELS / (nx * ny)))
    return max(1, min(TEXEL, most, ceil(spacing / 0.05)))


def description(course: Course) -> dict[str, Any]:
    """All of a course that is neither heights nor the grid of materials."""
    return {
        'name': course.name,
        'digest': course.digest,
        'around': points(surroundings(course)),
        'radius': course.ball.radius,
        'materials': [
            {'name': material.name, 'color': [round(float(c), 3) for c in material.color]}
            for material in materials(course)
        ],
        'tee': on_ground(course, course.tee),
        'hole': on_ground(course, course.hole) if course.hole else None,
        'flagstick': bool(course.hole) and course.flagstick,
        'bounds': points(course.bounds or ()),
        'water': [
            {
                'polygon': points(pond.polygon),
                'cut': [points(cut) for cut in pond.cut],
                'level': float(pond.level),
            }
            for pond in course.water
        ],
        'obstacles': [obstacle(shape) for shape in course.obstacles],
        'walls': [wall(shape) for shape in course.ground if is_wall(shape)],
    }


def on_ground(course: Course, place: tuple) -> list:
    """x, y and height of the ground at `place`."""
    found = ground_height(course, float(place[0]), float(place[1]))
    return points([(place[0], place[1], found[0] if found else 0.0)])[0]


def points(places: Iterable[Any]) -> list:
    """Round to lists of numbers, to a millimetre."""
    return [[round(float(number), 3) for number in place] for place in places]


def obstacle(shape: Any) -> dict[str, Any]:
    """Describe a sphere or an upright cylinder, for JSON."""
    is_sphere = isinstance(shape, Sphere)
    return {
        'kind': 'sphere' if is_sphere else 'cylinder',
        'place': points([shape.center if is_sphere else shape.base])[0],
        'radius': float(shape.radius),
        'height': 0.0 if is_sphere else float(shape.height),
        'material': shape.material.name,
        'color': [round(float(c), 3) for c in shape.material.color],
    }


def wall(patch: Patch) -> dict[str, Any]:
    """Corners of an upright rectangle, for JSON."""
    return {
        'corners': points(rectangle(patch)),
        'color': [round(float(c), 3) for c in patch.material.color],
    }
