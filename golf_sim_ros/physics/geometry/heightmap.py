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

"""Height maps: curved ground from heights on a grid.

Parts are its cells, the walls around it, and each map as a whole. They are numbered cells first,
of all maps, row by row; then walls, one for each cell's side on the outline, that go down without
end; then maps. A map whose hollows are wide touches a ball at one point: it is hit as a whole, but
near its outline, and supports the ball as a whole. On a map with a narrow hollow a ball hits cells
and rolls from cell to cell.

::

    heights[iy, ix]    ^ y
                       |  6 7 8      cells of a map with 3 x 3
      origin: of       |  3 4 5      walls: along y least, y greatest,
      heights[0, 0]    o--0-1-2-> x         x least, x greatest
"""

from math import floor, hypot
from typing import Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import surface_protocol
from .bicubic import bicubic, bounds, cell_at, GRID, nodes, steepest
from .closest_point import closest_point, curvatures, descend, held, pulls
from .plane_patch import SAME_HEIGHT
from .polygon import Outline
from ..jit import kernel, shared
from ..kernel_types import Rectangle, StructRecord, SurfacePoint, Vector
from ..mechanics.vector import dot, length, scale, sub, tangential, unit, ZERO
from ..properties.material import Material

# 1/m: hollows of less curvature touch a ball of 5 cm at one point only, with room to spare.
WIDE = 10.0
SEVERAL = 256  # effort of a cell where the distance may have several minima
ON_SEAM = 1e-9  # rad: above a seam but for this angle, a ball is above both cells
MOST_AROUND = 36  # cells around a point whose own bounds are asked, and not that of the map
INNER = 1e-6  # of the spacing: a foot so far within a cell is on no seam


class Heightmap(NamedTuple):
    """Surface through heights on a grid, solid below.

    ``heights[iy][ix]`` [m], at least 2 x 2: an array, or rows of numbers; ``origin``: x, y of
    ``heights[0][0]``; ``spacing`` [m] of the grid along x and y.
    """

    heights: Union[np.ndarray, Sequence[Sequence[float]]]
    origin: tuple[float, float] = (0.0, 0.0)
    spacing: float = 1.0
    material: Material = Material()


class Foot(NamedTuple):
    """Closest point of a cell or a map: `x`, `y`, and `bicubic` there.

    ``box``: the part's rectangle; ``below``: whether the point that asks is under the part.
    Coordinates are metres from the map's origin.
    """

    box: Rectangle
    x: float
    y: float
    at: SurfacePoint
    below: bool


class Maps(NamedTuple):
    """All height maps of a course.

    ``grids``: a row a map; ``nodes``: height and derivatives by x, y and both, per grid step;
    ``cells``: least and greatest height, bounds on the curvature of hollows and on any curvature
    [1/m].
    """

    grids: np.ndarray
    nodes: np.ndarray
    cells: np.ndarray


def build(shapes: Sequence[Heightmap], material_number: Mapping[Material, int]) -> Maps:
    """Build `Maps` of `Heightmap` records; `material_number` gives a material's row."""
    rows, tables, cells = [], [np.empty((0, 4))], [np.empty((0, 4))]
    counts = [(len(shape.heights) - 1, len(shape.heights[0]) - 1) for shape in shapes]
    node = cell = 0
    wall = sum(ny * nx for ny, nx in counts)
    number = wall + sum(2 * (nx + ny) for ny, nx in counts)
    for shape, (ny, nx) in zip(shapes, counts):
        table, limits = spline(shape)
        hollow = limits[..., 2].max()
        rows.append(
            (
                shape.origin,
                shape.spacing,
                1.0 / shape.spacing,
                nx,
                ny,
                node,
                cell,
                wall,
                number,
                material_number[shape.material],
                hollow < WIDE,
                limits[..., 1].max(),
                hollow,
                hypot(1.0, steepest(table, shape.spacing)),
                limits[..., 3].max(),
            )
        )
        tables.append(table.reshape(-1, 4))
        cells.append(limits.reshape(-1, 4))
        node, cell, wall, number = (
            node + table[..., 0].size,
            cell + nx * ny,
            wall + 2 * (nx + ny),
            number + 1,
        )
    return Maps(np.array(rows, GRID), np.concatenate(tables), np.concatenate(cells))


def spline(shape: Heightmap) -> tuple[np.ndarray, np.ndarray]:
    """Node values of a map's spline, and bounds of its cells."""
    table = nodes(np.array(shape.heights, float))
    return table, bounds(table, shape.spacing)


def corners(shape: Heightmap) -> tuple[tuple[float, float], tuple[float, float]]:
    """Least and greatest x and y of a map's outline."""
    size = shape.spacing * (np.array((len(shape.heights[0]), len(shape.heights))) - 1)
    (x, y), (width, depth) = shape.origin, size
    return (x, y), (x + width, y + depth)


def plan(shape: Heightmap) -> list[Outline]:
    """Outline in plan, a rectangle."""
    (x0, y0), (x1, y1) = corners(shape)
    return [((x0, y0), (x1, y0), (x1, y1), (x0, y1))]


def heights(shape: Heightmap) -> tuple[float, float]:
    """Least and greatest height."""
    limits = spline(shape)[1]
    return float(limits[..., 0].min()), float(limits[..., 1].max())


SHAPES = (Heightmap,)
NUMBERED = 2


@surface_protocol.parts.register(Maps)
def _parts(kind: Maps) -> int:
    n = len(kind.grids)
    return kind.grids[n - 1]['number'] + 1 if n > 0 else 0


@shared
def grid_of(kind: Maps, part: int) -> int:
    """Find the number of the map that `part` belongs to."""
    for i in range(len(kind.grids)):
        grid = kind.grids[i]
        if (
            part < grid['first_cell'] + grid['nx'] * grid['ny']
            or len(kind.cells) <= part < grid['first_wall'] + 2 * (grid['nx'] + grid['ny'])
            or part == grid['number']
        ):
            return i
    return 0


@shared
def wall_side(grid: StructRecord, part: int) -> tuple[int, int]:
    """Cell to which a wall belongs, and its side.

    0 is at the least y, 1 at the greatest, 2 and 3 are those of x.
    """
    k = part - grid['first_wall']
    nx = grid['nx']
    ny = grid['ny']
    if k < nx:
        return k, 0
    if k < 2 * nx:
        return (ny - 1) * nx + k - nx, 1
    if k < 2 * nx + ny:
        return (k - 2 * nx) * nx, 2
    return (k - 2 * nx - ny) * nx + nx - 1, 3


@kernel
def wall_number(grid: StructRecord, side: int, k: int) -> int:
    """Part number of wall `k` of a side."""
    before = (side > 0) * grid['nx'] + (side > 1) * grid['nx'] + (side > 2) * grid['ny']
    return grid['first_wall'] + before + k


@shared
def bounds_of(kind: Maps, part: int) -> int:
    """Row of the bounds of the cell `part`, or of the cell to which the wall `part` belongs."""
    if part < len(kind.cells):
        return part
    grid = kind.grids[grid_of(kind, part)]
    cell, _ = wall_side(grid, part)
    return grid['first_cell'] + cell


@shared
def rectangle(kind: Maps, grid: StructRecord, part: int) -> Rectangle:
    """Rectangle in plan [m] of `part` from the map's origin; that of a wall has no width."""
    size = grid['spacing']
    if part == grid['number']:
        return 0.0, 0.0, grid['nx'] * size, grid['ny'] * size
    side = -1
    cell = part - grid['first_cell']
    if part >= len(kind.cells):
        cell, side = wall_side(grid, part)
    column = cell % grid['nx']
    row = cell // grid['nx']
    x0 = (column + 1 if side == 3 else column) * size
    y0 = (row + 1 if side == 1 else row) * size
    return (
        x0,
        y0,
        (column if side == 2 else column + 1) * size,
        (row if side == 0 else row + 1) * size,
    )


@kernel
def place_under(
    kind: Maps, grid: StructRecord, part: int, box: Rectangle, point: Vector
) -> tuple[float, float, SurfacePoint]:
    """Closest point of the surface of `part`, of a wall's upper edge, and `bicubic` there.

    `box` is the part's rectangle.
    """
    if part == grid['number']:  # one minimum, for its hollows are wide
        x, y = min(max(point[0], box[0]), box[2]), min(max(point[1], box[1]), box[3])
        return descend(kind.nodes, grid, box, x, y, point)
    # Curvature times height over or under the cell tells `closest_point` whether the minimum is
    # unique.
    bend = 0.0
    if part < len(kind.cells):
        cell = kind.cells[part]
        bend = cell[3] * max(point[2] - cell[0], cell[1] - point[2])
    else:
        cell = kind.cells[bounds_of(kind, part)]
        bend = cell[3] * max(point[2] - cell[0], cell[1] - point[2])
    return closest_point(kind.nodes, grid, box, bend, point)


@kernel
def from_origin(grid: StructRecord, point: Vector) -> Vector:
    """Coordinates of `point` with x and y from the map's origin."""
    return point[0] - grid['origin'][0], point[1] - grid['origin'][1], point[2]


@shared
def beside_wall(
    kind: Maps, grid: StructRecord, part: int, local: Vector
) -> tuple[bool, float, float]:
    """Whether a point is nearest to a wall's upright face, and x, y of the closest point there."""
    x0, y0, x1, y1 = rectangle(kind, grid, part)
    x = min(max(local[0], x0), x1)
    y = min(max(local[1], y0), y1)
    return local[2] < bicubic(kind.nodes, grid, x, y)[0], x, y


@kernel
def is_wall(kind: Maps, grid: StructRecord, part: int) -> bool:
    """Whether `part` is a wall."""
    return len(kind.cells) <= part < grid['number']


@surface_protocol.nearest.register(Maps)
def _nearest(kind: Maps, part: int, point: Vector) -> tuple[float, Vector]:
    grid = kind.grids[grid_of(kind, part)]
    local = from_origin(grid, point)
    if is_wall(kind, grid, part):
        beside, x, y = beside_wall(kind, grid, part, local)
        if beside:
            offset = (local[0] - x, local[1] - y, 0.0)
            return length(offset), unit(offset, outward(kind, grid, part))
    return distance_from(foot_under(kind, grid, part, local), local)


@kernel
def distance_from(foot: Foot, local: Vector) -> tuple[float, Vector]:
    """Signed distance of a point from its `foot`, and the unit normal there."""
    offset = (local[0] - foot.x, local[1] - foot.y, local[2] - foot.at[0])
    upright = unit((-foot.at[1], -foot.at[2], 1.0), ZERO)
    sign = -1.0 if foot.below else 1.0
    if is_within(foot.box, foot.x, foot.y):
        # The slopes give the normal more exactly than a short offset.
        away = dot(offset, upright)
        facing = -1.0 if away < 0.0 < sign else 1.0  # past a wall, towards the back
        return facing * away, scale(facing, upright)
    return sign * length(offset), unit(scale(sign, offset), upright)


@kernel
def is_within(box: Rectangle, x: float, y: float) -> bool:
    """Whether a point in plan is within a rectangle, and not on its sides."""
    return box[0] < x < box[2] and box[1] < y < box[3]


@kernel
def is_over_map(grid: StructRecord, local: Vector) -> bool:
    """Whether a point is within the map's outline, seen from above."""
    size = grid['spacing']
    return 0.0 <= local[0] <= grid['nx'] * size and 0.0 <= local[1] <= grid['ny'] * size


@kernel
def foot_under(kind: Maps, grid: StructRecord, part: int, local: Vector) -> Foot:
    """Closest point of `part`, a cell, a map, or a wall's upper edge.

    Beyond a wall a point is not below, even if it is nearest to the back of ground that falls away
    from there.
    """
    box = rectangle(kind, grid, part)
    x, y, at = place_under(kind, grid, part, box, local)
    if is_within(box, x, y):
        offset = (local[0] - x, local[1] - y, local[2] - at[0])
        below = dot(offset, (-at[1], -at[2], 1.0)) < 0.0 and is_over_map(grid, local)
    else:
        below = (
            is_within(box, local[0], local[1])
            and local[2] < bicubic(kind.nodes, grid, local[0], local[1])[0]
        )
    return Foot(box, x, y, at, below)


@shared
def outward(kind: Maps, grid: StructRecord, part: int) -> Vector:
    """Outward unit normal of a wall."""
    _, side = wall_side(grid, part)
    if side < 2:
        return 0.0, -1.0 if side == 0 else 1.0, 0.0
    return -1.0 if side == 2 else 1.0, 0.0, 0.0


@surface_protocol.turn.register(Maps)
def _turn(kind: Maps, part: int, point: Vector, velocity: Vector) -> Vector:
    grid = kind.grids[grid_of(kind, part)]
    local = from_origin(grid, point)
    if is_wall(kind, grid, part):
        beside, x, y = beside_wall(kind, grid, part, local)
        if beside:
            x0, y0, x1, y1 = rectangle(kind, grid, part)
            offset = (local[0] - x, local[1] - y, 0.0)
            moving = (
                velocity[0] if x0 < x < x1 else 0.0,
                velocity[1] if y0 < y < y1 else 0.0,
                velocity[2],
            )
            return turned(sub(velocity, moving), offset)
    foot = foot_under(kind, grid, part, local)
    return turn_over(foot, local, velocity, distance_from(foot, local))


@surface_protocol.nearest_turning.register(Maps)
def _nearest_turning(
    kind: Maps, part: int, point: Vector, velocity: Vector
) -> tuple[float, Vector, Vector]:
    grid = kind.grids[grid_of(kind, part)]
    if is_wall(kind, grid, part):
        distance, normal = surface_protocol.nearest(kind, part, point)
        return distance, normal, surface_protocol.turn(kind, part, point, velocity)
    local = from_origin(grid, point)
    foot = foot_under(kind, grid, part, local)
    distance, normal = away = distance_from(foot, local)
    return distance, normal, turn_over(foot, local, velocity, away)


@kernel
def turn_over(foot: Foot, local: Vector, velocity: Vector, away: tuple[float, Vector]) -> Vector:
    """Rate of change of the unit normal at the `foot` of a point that moves at `velocity`.

    The closest point moves so that it stays closest (implicit differentiation, with the Hessian
    of half the squared distance); held by a border, it moves along that only. ``away``: the
    `distance_from` the foot.
    """
    distance, normal = away
    x0, y0, x1, y1 = foot.box
    at = foot.at
    gx, gy = pulls(local, foot.x, foot.y, at)
    fixed_x = x0 == x1 or held(foot.x, x0, x1, gx)
    fixed_y = y0 == y1 or held(foot.y, y0, y1, gy)
    a, b, c = curvatures(local, at)
    p = velocity[0] + at[1] * velocity[2]
    q = velocity[1] + at[2] * velocity[2]
    dx = 0.0
    dy = 0.0
    if fixed_x and not fixed_y:
        dy = q / c
    elif fixed_y and not fixed_x:
        dx = p / a
    elif not fixed_x and not fixed_y:
        each = 1.0 / (a * c - b * b)
        dx = (c * p - b * q) * each
        dy = (a * q - b * p) * each
    rate = sub(velocity, (dx, dy, at[1] * dx + at[2] * dy))
    return scale(1.0 / distance, tangential(rate, normal)) if distance != 0.0 else ZERO


@kernel
def turned(rate: Vector, offset: Vector) -> Vector:
    """Rate of change of the unit vector along `offset`, which changes by `rate`."""
    away = length(offset)
    return scale(1.0 / away, tangential(rate, scale(1.0 / away, offset))) if away > 0.0 else ZERO


@surface_protocol.touchable.register(Maps)
def _touchable(kind: Maps, part: int, point: Vector) -> bool:
    # Where the surface continues beyond the border that holds the closest point, a neighbour is
    # nearer. A wall's upper edge belongs to its cell.
    grid = kind.grids[grid_of(kind, part)]
    local = from_origin(grid, point)
    if is_wall(kind, grid, part):
        return beside_wall(kind, grid, part, local)[0]
    if part == grid['number']:
        return True
    x0, y0, x1, y1 = box = rectangle(kind, grid, part)
    x, y, at = place_under(kind, grid, part, box, local)
    gx, gy = pulls(local, x, y, at)
    free = ON_SEAM * length((local[0] - x, local[1] - y, local[2] - at[0]))
    column, row = (
        (part - grid['first_cell']) % grid['nx'],
        (part - grid['first_cell']) // grid['nx'],
    )
    return not (
        x <= x0
        and gx > free
        and column > 0
        or x >= x1
        and gx < -free
        and column < grid['nx'] - 1
        or y <= y0
        and gy > free
        and row > 0
        or y >= y1
        and gy < -free
        and row < grid['ny'] - 1
    )


@surface_protocol.is_inner.register(Maps)
def _is_inner(kind: Maps, part: int, foot: Vector) -> bool:
    grid = kind.grids[grid_of(kind, part)]
    if is_wall(kind, grid, part):
        return False
    x, y, _ = from_origin(grid, foot)
    x0, y0, x1, y1 = rectangle(kind, grid, part)
    room = INNER * grid['spacing']
    return is_within((x0 + room, y0 + room, x1 - room, y1 - room), x, y)


@surface_protocol.hollow.register(Maps)
def _hollow(kind: Maps, part: int) -> float:
    grid = kind.grids[grid_of(kind, part)]
    return grid['hollow'] if part == grid['number'] else kind.cells[bounds_of(kind, part), 2]


@surface_protocol.hollow_around.register(Maps)
def _hollow_around(kind: Maps, part: int, point: Vector, reach: float) -> float:
    grid = kind.grids[grid_of(kind, part)]
    if part != grid['number']:
        return kind.cells[bounds_of(kind, part), 2]
    x, y, _ = from_origin(grid, point)
    left, front = cell_at(grid, x - reach, y - reach)
    right, back = cell_at(grid, x + reach, y + reach)
    if (right - left + 1) * (back - front + 1) > MOST_AROUND:
        return grid['hollow']
    greatest = 0.0
    for row in range(front, back + 1):
        first = grid['first_cell'] + row * grid['nx']
        for k in range(first + left, first + right + 1):
            greatest = max(greatest, kind.cells[k, 2])
    return greatest


@surface_protocol.form.register(Maps)
def _form(kind: Maps, part: int) -> int:
    whole = part == kind.grids[grid_of(kind, part)]['number']
    return surface_protocol.RELIEF_FORM if whole else surface_protocol.ANY_FORM


@surface_protocol.relief.register(Maps)
def _relief(kind: Maps, part: int) -> tuple[float, float]:
    grid = kind.grids[grid_of(kind, part)]
    return (grid['steep'], grid['bend']) if part == grid['number'] else (0.0, 0.0)


@surface_protocol.height_above.register(Maps)
def _height_above(kind: Maps, part: int, point: Vector, velocity: Vector) -> tuple[float, float]:
    grid = kind.grids[grid_of(kind, part)]
    x, y, z = from_origin(grid, point)
    at = bicubic(kind.nodes, grid, x, y)
    return z - at[0], velocity[2] - at[1] * velocity[0] - at[2] * velocity[1]


@surface_protocol.has_relief.register(Maps)
def _has_relief(kind: Maps, part: int) -> bool:
    return True


@surface_protocol.effort.register(Maps)
def _effort(kind: Maps, part: int) -> int:
    if part >= len(kind.cells):
        return 1
    cell = kind.cells[part]
    return SEVERAL if cell[3] * (cell[1] - cell[0]) >= 1.0 else 1


@surface_protocol.support_of.register(Maps)
def _support_of(kind: Maps, part: int) -> int:
    grid = kind.grids[grid_of(kind, part)]
    return grid['number'] if part < len(kind.cells) and grid['gentle'] else part


@surface_protocol.smooth_surface.register(Maps)
def _smooth_surface(kind: Maps, part: int) -> int:
    # With a map's own walls: a ball on the map touches only their upper edge, which is the map's.
    return kind.grids[grid_of(kind, part)]['number']


@surface_protocol.material_of.register(Maps)
def _material_of(kind: Maps, part: int) -> int:
    return kind.grids[grid_of(kind, part)]['material']


@surface_protocol.top.register(Maps)
def _top(kind: Maps, x: float, y: float) -> tuple[float, int]:
    best = -1e300
    who = -1
    for i in range(len(kind.grids)):
        grid = kind.grids[i]
        u, v, _ = local = from_origin(grid, (x, y, 0.0))
        if is_over_map(grid, local):
            z = bicubic(kind.nodes, grid, u, v)[0]
            if z >= best - SAME_HEIGHT:
                best = max(best, z)
                column, row = cell_at(grid, u, v)
                who = grid['first_cell'] + row * grid['nx'] + column
    return best, who


@surface_protocol.next_part.register(Maps)
def _next_part(kind: Maps, part: int, low: Vector, high: Vector) -> int:
    for i in range(len(kind.grids)):
        grid = kind.grids[i]
        if (
            part < grid['first_cell'] + grid['nx'] * grid['ny']
            and reached(grid, low, high)
            and not is_hit_whole(grid, low, high)
        ):
            found = next_cell(kind, grid, part, low, high)
            if found >= 0:
                return found
    for i in range(len(kind.grids)):
        grid = kind.grids[i]
        if part < grid['first_wall'] + 2 * (grid['nx'] + grid['ny']) and reached(grid, low, high):
            found = next_wall(kind, grid, part, low, high)
            if found >= 0:
                return found
    for i in range(len(kind.grids)):
        grid = kind.grids[i]
        if (
            part <= grid['number']
            and is_hit_whole(grid, low, high)
            and next_cell(kind, grid, 0, low, high) >= 0
        ):
            return grid['number']
    return surface_protocol.parts(kind)


@kernel
def reached(grid: StructRecord, low: Vector, high: Vector) -> bool:
    """Whether the box overlaps the map in plan, and reaches down to it."""
    x = grid['origin'][0]
    y = grid['origin'][1]
    return (
        low[2] <= grid['high']
        and high[0] >= x
        and low[0] <= x + grid['nx'] * grid['spacing']
        and high[1] >= y
        and low[1] <= y + grid['ny'] * grid['spacing']
    )


@kernel
def is_hit_whole(grid: StructRecord, low: Vector, high: Vector) -> bool:
    """Whether the map is one part to a ball in the box: its hollows are wide, its outline far."""
    x = grid['origin'][0] + SAME_HEIGHT
    y = grid['origin'][1] + SAME_HEIGHT
    return (
        grid['gentle'] != 0
        and low[2] <= grid['high']
        and low[0] > x
        and high[0] < x + grid['nx'] * grid['spacing'] - 2.0 * SAME_HEIGHT
        and low[1] > y
        and high[1] < y + grid['ny'] * grid['spacing'] - 2.0 * SAME_HEIGHT
    )


@kernel
def columns_in(grid: StructRecord, axis: int, low: Vector, high: Vector) -> tuple[int, int]:
    """First and last cell along an axis that the box may overlap."""
    # A little more on both sides: on a seam both cells count, whatever the rounding.
    count = grid['ny'] if axis else grid['nx']
    first = floor((low[axis] - grid['origin'][axis]) / grid['spacing'] - 1e-9)
    last = floor((high[axis] - grid['origin'][axis]) / grid['spacing'] + 1e-9)
    return int(min(max(first, 0.0), count - 1.0)), int(max(min(last, count - 1.0), 0.0))


@shared
def next_cell(kind: Maps, grid: StructRecord, part: int, low: Vector, high: Vector) -> int:
    """First cell of a map, from `part` on, that reaches up into the box, or -1."""
    left, right = columns_in(grid, 0, low, high)
    front, back = columns_in(grid, 1, low, high)
    begin = max(part - grid['first_cell'], 0)
    for row in range(max(front, begin // grid['nx']), back + 1):
        before = grid['first_cell'] + row * grid['nx']
        for k in range(max(before + left, part), before + right + 1):
            if low[2] <= kind.cells[k, 1]:
                return k
    return -1


@shared
def next_wall(kind: Maps, grid: StructRecord, part: int, low: Vector, high: Vector) -> int:
    """First wall of a map, from `part` on, that reaches up into the box, or -1."""
    for side in range(4):
        axis = 0 if side < 2 else 1
        edge = grid['origin'][1 - axis]
        if side % 2 == 1:
            edge += (grid['ny'] if axis == 0 else grid['nx']) * grid['spacing']
        if low[1 - axis] > edge + SAME_HEIGHT or high[1 - axis] < edge - SAME_HEIGHT:
            continue
        first, last = columns_in(grid, axis, low, high)
        for k in range(
            max(wall_number(grid, side, first), part), wall_number(grid, side, last) + 1
        ):
            if low[2] <= kind.cells[bounds_of(kind, k), 1]:
                return k
    return -1
