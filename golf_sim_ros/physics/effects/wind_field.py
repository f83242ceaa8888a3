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

"""Wind over uneven ground, read from a field that was solved for beforehand.

At a place it is the logarithmic law of the roughness there, times the ratio to that which the
field holds, between the two directions beside that of the wind. Below the middle of the lowest
cell the ratio is constant: the wall law. Ratio and roughness are quadratic splines, so the wind
and its gradient are continuous.
"""

from math import atan2, exp, floor, log, pi, sin, sqrt
from typing import NamedTuple, Optional, Sequence

import numpy as np

from . import protocol, Scene
from .wind import from_ground, GROWTH, REFERENCE_HEIGHT
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import load, store, ZERO

Weights = tuple[float, float, float]
Nodes = tuple[int, int, int]
Near = tuple[Nodes, Weights]  # nodes near a place, and their weights
SAME_AS = ('wind',)
WIDEST = (
    0.75 * pi
)  # rad between two directions: beyond, their vectors say nothing of what is between


class WindAtlas(NamedTuple):
    """Wind fields over one ground, by direction, as spline coefficients.

    Parameters
    ----------
    angles : ndarray, (n,)
        Directions into which the wind goes far upstream, from x towards y, rising from 0 [rad].
    ratios : ndarray, (n, nx, ny, nz, 4)
        Velocity over the logarithmic law of the local roughness, and the standard deviation of its
        turbulence along the wind over the wind at 10 m.
    roughness : ndarray, (nx, ny)
        -ln z0, z0 [m].
    origin, spacing : (float, float)
        x, y of the first cell's middle, and from one to the next [m].
    first, growth : float
        Of the layers: their faces are at ``first (exp(growth k) - 1)`` [m].
    datum, top : float
        Height of the level ground far around, and of the lid over it [m].
    upstream : float
        Roughness length far upstream [m].
    """

    angles: np.ndarray
    ratios: np.ndarray
    roughness: np.ndarray
    origin: tuple
    spacing: tuple
    first: float
    growth: float
    datum: float
    top: float
    upstream: float


class Layout(NamedTuple):
    """Where the numbers of an atlas are; see `WindAtlas`.

    ``shift``: number of a cell's middle along zeta; ``weight``: 1 / ln(1 + 10 m / z0) upstream.
    """

    x: float
    y: float
    along_x: float
    along_y: float
    first: float
    along_z: float
    shift: float
    datum: float
    top: float
    weight: float
    cell: float


class WindField(NamedTuple):
    """Wind of `velocity`, an array of 3 [m/s] at 10 m far upstream, in an atlas.

    `now` (nx, ny, nz, 4) holds the coefficients blended for that wind, in m/s.
    """

    velocity: np.ndarray
    now: np.ndarray
    angles: np.ndarray
    ratios: np.ndarray
    roughness: np.ndarray
    layout: Layout


@kernel
def spline_weights(at: float) -> Weights:
    """Weights of a quadratic B-spline `at` from the nearest node: before it, its own, after it."""
    before = 0.5 - at
    after = 0.5 + at
    return 0.5 * before * before, 0.75 - at * at, 0.5 * after * after


@kernel
def held_in(place: float, count: int) -> float:
    """`place` among so many nodes, the outermost one where it is beyond."""
    return min(max(place, 0.0), count - 1.0)


@kernel
def neighbours(place: float, count: int) -> Near:
    """Nearest node to a `place`, the ones before and after it, and the weights of the three.

    Beyond the outermost node they are mirrored: there the slope is 0.
    """
    middle = int(floor(place + 0.5))
    before = middle - 1 if middle > 0 else min(1, count - 1)
    after = middle + 1 if middle + 1 < count else max(count - 2, 0)
    return (before, middle, after), spline_weights(place - middle)


@kernel
def upright(field: np.ndarray, i: int, j: int, levels: Nodes, weights: Weights) -> Vector:
    """Sum of a column of coefficients with the `weights` of three levels."""
    k, m, n = levels
    a, b, c = weights
    return (
        a * field[i, j, k, 0] + b * field[i, j, m, 0] + c * field[i, j, n, 0],
        a * field[i, j, k, 1] + b * field[i, j, m, 1] + c * field[i, j, n, 1],
        a * field[i, j, k, 2] + b * field[i, j, m, 2] + c * field[i, j, n, 2],
    )


@kernel
def mixed(weights: Weights, first: Vector, second: Vector, third: Vector) -> Vector:
    """Sum of three vectors with three `weights`."""
    a, b, c = weights
    return (
        a * first[0] + b * second[0] + c * third[0],
        a * first[1] + b * second[1] + c * third[1],
        a * first[2] + b * second[2] + c * third[2],
    )


@kernel
def smooth_vector(field: np.ndarray, columns: Near, rows: Near, height: Near) -> Vector:
    """Vector of a field, between three columns, three rows and three levels with their weights."""
    (i, p, q), along = columns
    (j, r, s), across = rows
    levels, up = height
    return mixed(
        along,
        mixed(
            across,
            upright(field, i, j, levels, up),
            upright(field, i, r, levels, up),
            upright(field, i, s, levels, up),
        ),
        mixed(
            across,
            upright(field, p, j, levels, up),
            upright(field, p, r, levels, up),
            upright(field, p, s, levels, up),
        ),
        mixed(
            across,
            upright(field, q, j, levels, up),
            upright(field, q, r, levels, up),
            upright(field, q, s, levels, up),
        ),
    )


@kernel
def place_in_plan(layout: Layout, position: Vector, shape: tuple[int, ...]) -> tuple[float, float]:
    """Place of `position` among the columns of a field of that `shape`."""
    return (
        held_in((position[0] - layout.x) * layout.along_x, shape[0]),
        held_in((position[1] - layout.y) * layout.along_y, shape[1]),
    )


@kernel
def place_in_height(layout: Layout, position: Vector, above: float, levels: int) -> float:
    """Place among the `levels` of a position `above` the ground."""
    stretch = 1.0 - (position[2] - above - layout.datum) / layout.top
    zeta = max(above, 0.0) / max(stretch, 0.1)
    return held_in(log(1.0 + zeta / layout.first) * layout.along_z - layout.shift, levels)


@kernel
def nodes_near(
    layout: Layout, position: Vector, above: float, shape: tuple[int, ...]
) -> tuple[Near, Near, Near]:
    """Columns, rows and levels near a `position` that is that height `above` the ground."""
    x, y = place_in_plan(layout, position, shape)
    z = place_in_height(layout, position, above, shape[2])
    return neighbours(x, shape[0]), neighbours(y, shape[1]), neighbours(z, shape[2])


@kernel
def smooth_map(values: np.ndarray, columns: Near, rows: Near) -> float:
    """Value of a map in plan, between three columns and three rows with their weights."""
    (i, p, q), (a, b, c) = columns
    (j, r, s), (d, e, f) = rows
    return (
        a * (d * values[i, j] + e * values[i, r] + f * values[i, s])
        + b * (d * values[p, j] + e * values[p, r] + f * values[p, s])
        + c * (d * values[q, j] + e * values[q, r] + f * values[q, s])
    )


@kernel
def wind_above(effect: WindField, position: Vector, above: float) -> Vector:
    """Wind [m/s] at a `position` at that height `above` the ground."""
    field = effect.now
    layout = effect.layout
    columns, rows, height = nodes_near(layout, position, above, field.shape)
    ratio = smooth_vector(field, columns, rows, height)
    over_roughness = max(above, 0.0) * exp(smooth_map(effect.roughness, columns, rows))
    share = layout.weight * log(1.0 + over_roughness)
    return share * ratio[0], share * ratio[1], share * (ratio[2] + effect.velocity[2])


@protocol.air_velocity.register(WindField)
def _air_velocity(effect: WindField, ground: Ground, position: Vector) -> Vector:
    if effect.velocity[0] == 0.0 and effect.velocity[1] == 0.0 and effect.velocity[2] == 0.0:
        return ZERO
    return wind_above(effect, position, from_ground(ground, position))


@protocol.longest_step.register(WindField)
def _longest_step(
    effect: WindField, ground: Ground, flow: protocol.Flow, force: Vector, wanted: float
) -> float:
    if effect.velocity[0] == 0.0 and effect.velocity[1] == 0.0 and effect.velocity[2] == 0.0:
        return wanted
    # as in still profiles, and no farther than a cell
    bending = max(from_ground(ground, flow.position), 0.0) + exp(-effect.roughness[0, 0])
    u, v, w = flow.over_ground
    most = min(
        GROWTH * bending / max(abs(w), 1e-9), effect.layout.cell / max(sqrt(u * u + v * v), 1e-9)
    )
    return min(max(most, protocol.BRIEF), wanted)


@kernel
def directions_beside(angles: np.ndarray, wind: Sequence[float]) -> tuple[int, int, float, float]:
    """Numbers of the two directions beside a `wind`, and the speeds [m/s] that it has in each.

    As vectors the two make the wind: exact over level ground. Where they are too far apart for
    that, its speed is shared by the angles.
    """
    count = len(angles)
    speed = sqrt(wind[0] * wind[0] + wind[1] * wind[1])
    if count == 1 or speed == 0.0:
        return 0, 0, speed, 0.0
    turn = 2.0 * pi
    angle = atan2(wind[1], wind[0])
    while angle < angles[0]:
        angle += turn
    low = count - 1
    while low > 0 and angles[low] > angle:
        low -= 1
    high = low + 1 if low + 1 < count else 0
    width = angles[high] - angles[low]
    if width <= 0.0:
        width += turn
    into = angle - angles[low]
    if width > WIDEST:
        return low, high, speed * (1.0 - into / width), speed * into / width
    return low, high, speed * sin(width - into) / sin(width), speed * sin(into) / sin(width)


@protocol.set_live.register(WindField)
def _set_live(effect: WindField, value: np.ndarray) -> None:
    wind = load(value)
    old = effect.velocity
    if old[0] == wind[0] and old[1] == wind[1] and old[2] == wind[2]:
        return
    store(effect.velocity, wind)
    low, high, first, second = directions_beside(effect.angles, wind)
    one = effect.ratios[low]
    other = effect.ratios[high]
    now = effect.now
    for i in range(now.shape[0]):
        for j in range(now.shape[1]):
            for k in range(now.shape[2]):
                for n in range(4):
                    now[i, j, k, n] = first * float(one[i, j, k, n])
                    now[i, j, k, n] += second * float(other[i, j, k, n])


def blended(atlas: WindAtlas, wind: Sequence[float]) -> WindField:
    """`WindField` record of an `atlas` in a `wind` [m/s] at 10 m far upstream."""
    low, high, first, second = directions_beside(atlas.angles, wind)
    now = first * atlas.ratios[low].astype(float)
    now += second * atlas.ratios[high].astype(float)
    return WindField(
        np.array(wind, float), now, atlas.angles, atlas.ratios, atlas.roughness, layout_of(atlas)
    )


def layout_of(atlas: WindAtlas) -> Layout:
    """`Layout` of an atlas."""
    x, y = atlas.origin
    along_x, along_y = atlas.spacing
    return Layout(
        float(x),
        float(y),
        1.0 / along_x,
        1.0 / along_y,
        float(atlas.first),
        1.0 / atlas.growth,
        log(0.5 * (1.0 + np.exp(atlas.growth))) / atlas.growth,
        float(atlas.datum),
        float(atlas.top),
        1.0 / log(1.0 + REFERENCE_HEIGHT / atlas.upstream),
        float(min(atlas.spacing)),
    )


def record(scene: Scene) -> WindField:
    """Record for `scene`; of a course without a field, of air that stands still."""
    atlas = scene.course.wind_field
    return blended(atlas, scene.live_value('wind')) if atlas else blended(still(), ZERO)


def still() -> WindAtlas:
    """`WindAtlas` of air that stands still whatever the wind."""
    zeros = np.zeros((1, 1, 1, 1, 4), np.float32)
    wide = (1e9, 1e9)  # no step ends at a cell, or near the ground
    return WindAtlas(
        np.zeros(1), zeros, np.full((1, 1), -20.0), (0.0, 0.0), wide, 1.0, 1.0, 0.0, 1e3, 0.01
    )


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, or ''."""
    if scene.course.wind_field is None:
        return 'the course has no wind field'
    return '' if any(scene.live_value('wind')) else 'no wind'


def dormant(scene: Scene) -> Optional[WindField]:
    """Record of a field in which no wind blows, of a course that has one; else None."""
    return blended(scene.course.wind_field, ZERO) if scene.course.wind_field else None
