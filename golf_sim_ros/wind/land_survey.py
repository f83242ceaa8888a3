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

"""Survey of a course's land: heights and roughness on a raster, as the wind feels them.

Heights of all kinds of ground as one field; water is level ground. Around the land that a course
describes the ground goes on at the height of its edge and fades to level.
"""

from collections.abc import Sequence
from hashlib import sha256
from typing import Any, NamedTuple

import numpy as np

from .errors import FieldError
from ..physics.effects.wind import LogProfile
from ..physics.geometry import extent
from ..physics.geometry.mesh import Mesh
from ..physics.geometry.plane import Plane
from ..physics.geometry.solid import Sphere
from ..physics.geometry.surfaces import material_of, top
from ..physics.geometry.zone import places_inside, zones_of
from ..physics.mechanics.vector import ZERO
from ..physics.properties.material import Material
from ..physics.scene.course_record import Course
from ..physics.scene.kernel_model import bare_ground, materials

Box = tuple[tuple[float, float], tuple[float, float]]  # least and greatest x, and y [m]

WATER_ROUGHNESS = 2e-4  # m: open water (Wieringa, Boundary-Layer Meteorol. 63 (1993) 323-363)
AROUND = 20.0  # m of endless ground around what stands on it
LEAST_SIDE = 40.0  # m of the land that is looked at
STEEPEST = 1.0  # slope of the ground that the wind feels: what is steeper is smoothed
SWEEPS = 2000  # of that smoothing at most


class Survey(NamedTuple):
    """Land at the nodes of a raster: ``heights`` and ``roughness`` (nx, ny) [m] at ``x``, ``y``.

    ``upstream``: roughness length of the land far around.
    """

    x: np.ndarray
    y: np.ndarray
    heights: np.ndarray
    roughness: np.ndarray
    upstream: float

    def heights_at(self, x: Any, y: Any) -> np.ndarray:
        """Heights [m] of the raster at places, straight in between, beyond it as at its edge."""
        return between(self.x, self.y, self.heights, x, y)

    @property
    def datum(self) -> float:
        """Height [m] of the level ground far around: the mean along the edge."""
        h = self.heights
        return float(np.mean(np.concatenate([h[0], h[-1], h[1:-1, 0], h[1:-1, -1]])))

    @property
    def relief(self) -> float:
        """Greatest height over, or depth under, the ground far around [m]."""
        return float(abs(self.heights - self.datum).max())


def land_box(course: Course) -> Box:
    """Least and greatest x and y of the land that a course describes: ((x, x), (y, y)) [m]."""
    places = [course.tee, *((course.hole,) if course.hole else ()), *(course.bounds or ())]
    for shape in course.ground:
        if isinstance(shape, Mesh):
            corners = np.asarray(shape.vertices, float).reshape(-1, 3)
            places += [corners.min(0)[:2], corners.max(0)[:2]]
        elif isinstance(shape, Plane):
            places += [corner for cut in shape.cut for corner in cut]
        else:
            places += list(extent(shape))
    finite = len(places) > 1 and not any(isinstance(shape, Plane) for shape in course.ground)
    for zone in zones_of(course.zones):
        places += zone.polygon
    for solid in course.obstacles:
        centre = solid.center if isinstance(solid, Sphere) else solid.base
        places += [np.subtract(centre[:2], solid.radius), np.add(centre[:2], solid.radius)]
    low, high = np.min(places, 0), np.max(places, 0)
    margin = np.maximum(0.5 * (LEAST_SIDE - (high - low)), 0.0 if finite else AROUND)
    (left, front), (right, back) = (low - margin).tolist(), (high + margin).tolist()
    return (left, right), (front, back)


def survey(course: Course, box: Box, spacing: float) -> Survey:
    """`Survey` of a course over a `box` as of `land_box`, with nodes about `spacing` [m] apart."""
    axes = [np.linspace(low, high, max(2, round((high - low) / spacing) + 1)) for low, high in box]
    x, y = np.meshgrid(*axes, indexing='ij')
    upstream = log_profile(course).roughness
    bare = course._replace(zones=())
    ground = bare_ground(bare)
    rough = [material.roughness or upstream for material in materials(bare)]
    found = [top(ground, px, py) for px, py in zip(x.ravel().tolist(), y.ravel().tolist())]
    heights = np.array([z if part >= 0 else np.nan for z, part in found]).reshape(x.shape)
    if np.isnan(heights).all():
        raise FieldError('the course has no ground where its land is')
    known = {part: rough[material_of(ground, part, ZERO)] for _, part in found if part >= 0}
    roughness = np.array([known.get(part, upstream) for _, part in found]).reshape(x.shape)
    for zone in zones_of(course.zones):
        roughness[inside(zone, x, y)] = zone.material.roughness or upstream
    heights = without_gaps(heights)
    for pond in course.water:
        wet = inside(pond, x, y) & (heights < pond.level)
        heights[wet], roughness[wet] = pond.level, WATER_ROUGHNESS
    return Survey(axes[0], axes[1], heights, roughness, upstream)


def log_profile(course: Course) -> LogProfile:
    """Profile of the wind of a course, which has to be logarithmic; else `FieldError`."""
    if not isinstance(course.wind_profile, LogProfile):
        raise FieldError(
            'a wind field needs a logarithmic wind_profile, and this is '
            f'{type(course.wind_profile).__name__}'
        )
    return course.wind_profile


def inside(region: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether a zone or a pond, without its cuts, holds each place."""
    held = holds(region.polygon, x, y)
    for cut in region.cut:
        held &= ~holds(cut, x, y)
    return held


def holds(polygon: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether a polygon holds each place, outline included: a mirrored land is a mirror image."""
    corners = np.asarray(polygon, float)
    held = np.zeros(np.shape(x), bool)
    for sx, sy in ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)):
        held |= places_inside((corners * (sx, sy)).tolist(), sx * x, sy * y)
    return held


def without_gaps(heights: np.ndarray) -> np.ndarray:
    """Heights (nx, ny) whose gaps, not numbers, have grown shut from their edges."""
    heights = heights.copy()
    while np.isnan(heights).any():
        padded = np.pad(heights, 1, constant_values=np.nan)
        beside = np.stack(
            [padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
        )
        known = ~np.isnan(beside)
        mean = np.where(known, beside, 0.0).sum(0) / np.maximum(known.sum(0), 1)
        gap = np.isnan(heights) & known.any(0)
        heights[gap] = mean[gap]
    return heights


def between(x: np.ndarray, y: np.ndarray, values: np.ndarray, at_x: Any, at_y: Any) -> np.ndarray:
    """Values of a raster (nx, ny) at places, straight in between, beyond it those of its edge."""
    i, s = cell_and_share(x, at_x)
    j, t = cell_and_share(y, at_y)
    near = (1.0 - t) * values[i, j] + t * values[i, j + 1]
    far = (1.0 - t) * values[i + 1, j] + t * values[i + 1, j + 1]
    return (1.0 - s) * near + s * far


def cell_and_share(nodes: np.ndarray, at: Any) -> tuple[np.ndarray, np.ndarray]:
    """Find the interval of equidistant `nodes` that each place is in, and how far into it."""
    place = (np.asarray(at, float) - nodes[0]) / (nodes[1] - nodes[0])
    place = np.clip(place, 0.0, len(nodes) - 1.0)
    number = np.minimum(place.astype(np.int64), len(nodes) - 2)
    return number, place - number


def smoothed(survey: Survey, cell: float) -> Survey:
    """`Survey` as such cells see it: means over a cell, and nothing steeper than `STEEPEST`."""
    means = [
        mean_over(
            np.asarray(values), [cell / (axis[1] - axis[0]) for axis in (survey.x, survey.y)]
        )
        for values in (survey.heights, np.log(survey.roughness))
    ]
    gentle = [STEEPEST * (axis[1] - axis[0]) for axis in (survey.x, survey.y)]
    return survey._replace(heights=flattened(means[0], gentle), roughness=np.exp(means[1]))


def mean_over(values: np.ndarray, widths: Sequence[float]) -> np.ndarray:
    """Means over boxes of so many nodes along both axes; beyond the edge its values go on."""
    for axis, width in enumerate(widths):
        half = max(1, round(0.5 * width))
        padded = np.pad(values, [(half, half) if n == axis else (0, 0) for n in (0, 1)], 'edge')
        weights = np.ones(2 * half + 1)
        weights[[0, -1]] = 0.5
        weights /= weights.sum()
        parts = [
            weight * np.take(padded, np.arange(n, n + values.shape[axis]), axis)
            for n, weight in enumerate(weights)
        ]
        values = np.sum(parts, axis=0)
    return values


def flattened(heights: np.ndarray, steps: Sequence[float]) -> np.ndarray:
    """Heights of which no two neighbours along an axis differ by more than `steps` says.

    What is too much is taken half from the higher and half from the lower one, over and over.
    """
    heights = heights.copy()
    for _ in range(SWEEPS):
        change = np.zeros_like(heights)
        for axis, most in enumerate(steps):
            along, moved = heights.swapaxes(0, axis), change.swapaxes(0, axis)
            rise = np.diff(along, axis=0)
            excess = 0.25 * (rise - np.clip(rise, -most, most))
            moved[:-1] += excess
            moved[1:] -= excess
        if abs(change).max() < 1e-3 * min(steps):
            break
        heights += change
    return heights


def land_digest(course: Course) -> str:
    """Hash of all that a course's wind depends on: ground, water, roughness, trees, profile."""
    total = sha256()
    trees = [solid for solid in course.obstacles if solid.material.canopy_drag > 0.0]
    for part in (course.ground, zones_of(course.zones), course.water, trees, course.wind_profile):
        feed(total, part)
    return total.hexdigest()


def as_numbers(value: Any) -> np.ndarray | None:
    """Array of a number, or of rows of them however they are held; None of anything else."""
    if isinstance(value, (str, type(None))) or hasattr(value, '_fields'):
        return None
    if isinstance(value, (tuple, list)) and any(hasattr(part, '_fields') for part in value):
        return None
    try:
        return np.ascontiguousarray(value, float)
    except (TypeError, ValueError):
        return None


def feed(total: Any, value: Any) -> None:
    """Add a record, a sequence, a number or an array to a hash."""
    if isinstance(value, Material):
        value = np.array([value.roughness, value.canopy_drag])
    if hasattr(value, '_fields'):
        total.update(type(value).__name__.encode())
    array = as_numbers(value)
    if array is not None:
        total.update(repr(array.shape).encode() + array.tobytes())
    elif isinstance(value, (tuple, list)):
        total.update(b'(%d' % len(value))
        for part in value:
            feed(total, part)
    else:
        total.update(repr(value).encode())
