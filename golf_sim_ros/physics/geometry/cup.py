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

r"""Cup of the hole: a rim along the ground around it, an upright wall below, a level bottom.

Parts come in pairs: the side, rim and wall in one, hit from within and above; and the bottom.

::

    ground ____.  rim                .____   height of the rim, at the angle phi:
               |\                   /|           a0 + a1 cos + b1 sin
               | n                 n |           + a2 cos 2 phi + b2 sin 2 phi
               |wall                 |       over the wall's top the rim is nearest,
               '------- bottom ------'       below it the wall
"""

from math import cos, hypot, pi, sin, sqrt
from typing import Mapping, NamedTuple, Sequence

import numpy as np

from . import surface_protocol, surfaces
from .plane_patch import meets, PLANE_ROUNDING, SAME_HEIGHT
from .polygon import Circle
from .surfaces import Ground
from ..jit import kernel
from ..kernel_types import StructRecord, Vector
from ..mechanics.vector import add_scaled, dot, length, scale, sub, tangential
from ..properties.material import Material, Restitution

RADIUS = 0.054  # m: Rules of Golf, definition of hole: 108 mm across
DEPTH = 0.1016  # m: and at least that deep
CUP_SAMPLES = 64  # of the ground's height around the rim
UNEVEN = 0.005  # m: where the ground deviates more from the rim's curve there can be no hole
MOST_CUP_STEPS = 30  # of Newton's method
MOST_CUP_TURN = 0.3  # rad in one of them
LAST_CUP_TURN = 1e-12  # rad: the last of them; what it leaves goes with its square

# A plastic liner in soil. Estimates: between turf, 0.5, and a hard plastic plate, 0.8, and well
# damped; friction as of plastic on plastic.
CUP_MATERIAL = Material(
    'cup', Restitution(0.4), 0.0, 0.3, 0.25, 0.1, 0.002, 0.0, color=(0.9, 0.9, 0.9)
)

CUPS = np.dtype(
    [
        ('center', 'f8', 2),
        ('radius', 'f8'),
        ('rim', 'f8', 5),
        ('bottom', 'f8'),
        ('hollow', 'f8'),
        ('side_material', 'i8'),
        ('bottom_material', 'i8'),
        ('low', 'f8', 3),
        ('high', 'f8', 3),
    ],
    align=True,
)


class Cup(NamedTuple):
    """Hole of `radius` around `x`, `y`, its bottom `depth` below the lowest of the rim [m].

    `rim` holds a0, a1, b1, a2, b2 of the rim's height; `side` is the material of rim and wall.
    """

    x: float
    y: float
    rim: tuple[float, float, float, float, float]
    side: Material
    material: Material = CUP_MATERIAL
    depth: float = DEPTH
    radius: float = RADIUS


class Cups(NamedTuple):
    """All cups of a course: none, or the one of its hole."""

    cups: np.ndarray


def cup_in(
    ground: Ground, x: float, y: float, names: Sequence[Material], material: Material
) -> Cup:
    """`Cup` at `x`, `y` with a rim along `ground`, a `Ground` without hole.

    `names` are the materials by number; rim and wall are of the ground's, the bottom of
    `material`.

    Raises
    ------
    ValueError
        There is no ground all round, or it is too uneven.
    """
    angles = 2 * pi * np.arange(CUP_SAMPLES) / CUP_SAMPLES
    found = [surfaces.look_down(ground, x + RADIUS * cos(a), y + RADIUS * sin(a)) for a in angles]
    if any(part < 0 for _, part, _ in found):
        raise ValueError(f'hole ({x:g}, {y:g}) must have ground all round')
    # Least squares of the Fourier series up to the second order: it is exact for a tilted plane,
    # which is the first, and follows a curved green by the second.
    z = np.array([height for height, _, _ in found])
    waves = np.array(
        [
            np.ones(CUP_SAMPLES),
            np.cos(angles),
            np.sin(angles),
            np.cos(2 * angles),
            np.sin(2 * angles),
        ]
    )
    rim = np.linalg.lstsq(waves.T, z, rcond=None)[0]
    if np.abs(rim @ waves - z).max() > UNEVEN:
        raise ValueError(
            f'hole ({x:g}, {y:g}) must have ground all round that is even to {UNEVEN:g} m'
        )
    a0, a1, b1, a2, b2 = rim.tolist()
    return Cup(float(x), float(y), (a0, a1, b1, a2, b2), names[found[0][2]], material)


def heights_of_rim(cup: Cup) -> tuple[float, float]:
    """Bounds on the height of a cup's rim, exact where the rim lies in a plane."""
    a0, a1, b1, a2, b2 = cup.rim
    reach = hypot(a1, b1) + hypot(a2, b2)
    return a0 - reach, a0 + reach


def opening(cup: Cup) -> tuple[float, float, float, float, float, float]:
    """Give the opening of a cup, as in `Ground.hole`.

    x, y, radius, bounds of the rim's height, height of the bottom.
    """
    lowest, highest = heights_of_rim(cup)
    return cup.x, cup.y, cup.radius, lowest, highest, lowest - cup.depth


def build(shapes: Sequence[Cup], material_number: Mapping[Material, int]) -> Cups:
    """`Cups` of `Cup` records; `material_number` maps a material to its row."""
    rows = []
    for cup in shapes:
        x, y, radius, _, highest, bottom = opening(cup)
        # Curvature of the rim as a curve in space: |second derivative| over radius^2, at most.
        _, a1, b1, a2, b2 = cup.rim
        waving = hypot(a1, b1) + 4.0 * hypot(a2, b2)
        rows.append(
            (
                (x, y),
                radius,
                cup.rim,
                bottom,
                hypot(radius, waving) / radius**2,
                material_number[cup.side],
                material_number[cup.material],
                (x - radius, y - radius, bottom),
                (x + radius, y + radius, highest),
            )
        )
    return Cups(np.array(rows, CUPS))


def plan(shape: Cup) -> list[Circle]:
    """Outline in plan: the rim, across which the ground ends."""
    return [Circle(shape.x, shape.y, shape.radius)]


def heights(shape: Cup) -> tuple[float, float]:
    """Height of the bottom, and greatest height of the rim."""
    _, _, _, _, highest, bottom = opening(shape)
    return bottom, highest


@kernel
def rim_height(cup: StructRecord, c: float, s: float) -> float:
    """Height of the rim in the direction of cosine `c` and sine `s`."""
    w = cup['rim']
    return w[0] + w[1] * c + w[2] * s + w[3] * (c * c - s * s) + w[4] * 2.0 * s * c


@kernel
def polar_from_axis(cup: StructRecord, point: Vector) -> Vector:
    """Polar coordinates of `point` about the axis: distance, and cosine and sine of the angle."""
    dx = point[0] - cup['center'][0]
    dy = point[1] - cup['center'][1]
    away = sqrt(dx * dx + dy * dy)
    if away == 0.0:
        return 0.0, 1.0, 0.0
    return away, dx / away, dy / away


@kernel
def rim_at(cup: StructRecord, c: float, s: float) -> tuple[Vector, Vector, Vector]:
    """Point of the rim in the direction of cosine `c` and sine `s`.

    And its first and second derivative by the angle.
    """
    r = cup['radius']
    w = cup['rim']
    twice = c * c - s * s
    climb = -w[1] * s + w[2] * c - 4.0 * w[3] * s * c + 2.0 * w[4] * twice
    bend = -w[1] * c - w[2] * s - 4.0 * w[3] * twice - 8.0 * w[4] * s * c
    place = (cup['center'][0] + r * c, cup['center'][1] + r * s, rim_height(cup, c, s))
    return place, (-r * s, r * c, climb), (-r * c, -r * s, bend)


@kernel
def first_guess(cup: StructRecord, point: Vector) -> tuple[float, float]:
    """Guess the direction of the rim's nearest point: that of `point`, or the best of eight."""
    away, c, s = polar_from_axis(cup, point)
    if away > 0.5 * cup['radius']:
        return c, s
    best = 1.0, 0.0
    least = 1e300
    for i in range(8):
        c, s = cos(i * pi / 4.0), sin(i * pi / 4.0)
        place, _, _ = rim_at(cup, c, s)
        away = length(sub(point, place))
        if away < least:
            least = away
            best = c, s
    return best


@kernel
def nearest_on_rim(cup: StructRecord, point: Vector) -> tuple[float, float]:
    """Cosine and sine of the direction of the rim's point nearest to `point`.

    By Newton's method on half the squared distance.
    """
    c, s = first_guess(cup, point)
    for _ in range(MOST_CUP_STEPS):
        place, ahead, bend = rim_at(cup, c, s)
        offset = sub(place, point)
        fall = -dot(ahead, offset)
        rise = dot(ahead, ahead) + dot(bend, offset)
        # Where the second derivative is negative, no minimum is near: the longest step downhill.
        step = fall / rise if rise > 0.0 else (MOST_CUP_TURN if fall > 0.0 else -MOST_CUP_TURN)
        step = min(max(step, -MOST_CUP_TURN), MOST_CUP_TURN)
        # Turned by the arc tangent of the step, which takes no function of an angle.
        size = sqrt(1.0 + step * step)
        c, s = (c - s * step) / size, (s + c * step) / size
        if abs(step) <= LAST_CUP_TURN:
            break
    return c, s


@surface_protocol.parts.register(Cups)
def _parts(kind: Cups) -> int:
    return 2 * len(kind.cups)


@surface_protocol.next_part.register(Cups)
def _next_part(kind: Cups, part: int, low: Vector, high: Vector) -> int:
    while part < 2 * len(kind.cups):
        cup = kind.cups[part // 2]
        if meets(cup, low, high) and (part % 2 == 0 or low[2] <= cup['bottom']):
            break
        part += 1
    return part


@surface_protocol.nearest.register(Cups)
def _nearest(kind: Cups, part: int, point: Vector) -> tuple[float, Vector]:
    cup = kind.cups[part // 2]
    away, c, s = polar_from_axis(cup, point)
    if part % 2 == 1:  # a disc, hit from above
        over = point[2] - cup['bottom']
        beyond = max(away - cup['radius'], 0.0)
        distance = sqrt(over * over + beyond * beyond)
        if distance == 0.0:
            return 0.0, (0.0, 0.0, 1.0)
        return distance, (beyond * c / distance, beyond * s / distance, over / distance)
    # Below the rim's height the wall is nearest, above it the rim.
    if point[2] <= rim_height(cup, c, s):
        if away > cup['radius']:
            return away - cup['radius'], (c, s, 0.0)
        return cup['radius'] - away, (-c, -s, 0.0)
    c, s = nearest_on_rim(cup, point)
    place, _, _ = rim_at(cup, c, s)
    offset = sub(point, place)
    return length(offset), scale(1.0 / length(offset), offset)


@surface_protocol.turn.register(Cups)
def _turn(kind: Cups, part: int, point: Vector, velocity: Vector) -> Vector:
    cup = kind.cups[part // 2]
    if part % 2 == 1:
        return 0.0, 0.0, 0.0
    away, c, s = polar_from_axis(cup, point)
    if point[2] <= rim_height(cup, c, s):
        around = (-s, c, 0.0)
        return scale(-dot(velocity, around) / max(away, PLANE_ROUNDING), around)
    # The nearest point moves along the rim as well: implicit differentiation of its condition
    # gives its rate.
    c, s = nearest_on_rim(cup, point)
    place, ahead, bend = rim_at(cup, c, s)
    offset = sub(point, place)
    distance = length(offset)
    rate = dot(ahead, velocity) / (dot(ahead, ahead) - dot(bend, offset))
    relative = add_scaled(velocity, -rate, ahead)
    return scale(1.0 / distance, tangential(relative, scale(1.0 / distance, offset)))


@surface_protocol.hollow.register(Cups)
def _hollow(kind: Cups, part: int) -> float:
    # Within 1 / (2 K) of a curve of curvature at most K the distance's second derivative is 2 K
    # v^2 at most.
    return kind.cups[part // 2]['hollow'] if part % 2 == 0 else 0.0


@surface_protocol.touchable.register(Cups)
def _touchable(kind: Cups, part: int, point: Vector) -> bool:
    cup = kind.cups[part // 2]
    if part % 2 == 1:
        return point[2] >= cup['bottom']
    away, c, s = polar_from_axis(cup, point)
    # From outside below the rim there is ground, which has no wall on that side.
    return away <= cup['radius'] or point[2] > rim_height(cup, c, s)


@surface_protocol.flat_under.register(Cups)
def _flat_under(kind: Cups, part: int, point: Vector) -> bool:
    cup = kind.cups[part // 2]
    away, _, _ = polar_from_axis(cup, point)
    return part % 2 == 1 and away <= cup['radius'] + PLANE_ROUNDING


@surface_protocol.is_below_plane.register(Cups)
def _is_below_plane(kind: Cups, part: int, point: Vector, normal: Vector) -> bool:
    cup = kind.cups[part // 2]
    if part % 2 == 1:
        return abs(normal[2]) > 1.0 - 1e-12 and abs(point[2] - cup['bottom']) <= SAME_HEIGHT
    for i in range(5):  # five points determine the rim's five coefficients
        angle = i * 2.0 * pi / 5.0
        place, _, _ = rim_at(cup, cos(angle), sin(angle))
        if abs(dot(sub(place, point), normal)) > SAME_HEIGHT:
            return False
    return True


@surface_protocol.is_ground.register(Cups)
def _is_ground(kind: Cups, part: int) -> bool:
    return False


@surface_protocol.sort.register(Cups)
def _sort(kind: Cups, part: int) -> int:
    return surface_protocol.CUP_SORT


@surface_protocol.material_of.register(Cups)
def _material_of(kind: Cups, part: int) -> int:
    cup = kind.cups[part // 2]
    return cup['side_material'] if part % 2 == 0 else cup['bottom_material']


SHAPES = (Cup,)
NUMBERED = 0
