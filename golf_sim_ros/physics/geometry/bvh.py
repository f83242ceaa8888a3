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

"""Bounding volume hierarchy (BVH): a static tree of axis-aligned boxes over a mesh's triangles.

Each node is split at the median of its longest axis until few primitives are left. Nodes are
stored depth first, and so are primitives: a query goes on to the next node where a box overlaps
and skips the whole subtree where it does not. It needs no stack, and can start at any leaf. A grid
in plan tells between which leaves a small query may start and end: the root is far from both.
"""

from math import ceil, inf, log2, sqrt
from typing import NamedTuple

import numpy as np

from ..jit import kernel
from ..kernel_types import Vector

FULL = 4  # primitives that a leaf may hold
CELLS_A_LEAF = 8  # cells that a leaf may lie in, on average
LEAST_SIZE = 1e-9  # m: a grid that is no wider has one column
MANY_CELLS = 9  # a query that lies in more cells starts at the root

BVH_NODE = np.dtype(
    [('low', 'f8', 3), ('high', 'f8', 3), ('first', 'i8'), ('last', 'i8'), ('skip', 'i8')],
    align=True,
)


class LeafGrid(NamedTuple):
    """Grid in plan over the leaves of hierarchies: in each cell the first of them and the last.

    ``origin`` [m] and cells a metre, ``per_metre``, each by x and y; ``leaves``, (n, n, 2), are
    numbers of nodes, by x, then by y; ``nodes`` counts all. Whatever is beyond the grid counts to
    the cell next to it.
    """

    origin: np.ndarray
    per_metre: np.ndarray
    leaves: np.ndarray
    nodes: int


def build_bvh(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of a BVH over the boxes from `low` to `high`, both (n, 3).

    Also the boxes' order, depth first. In that order a leaf holds ``first`` to ``last``, any other
    node none; ``skip`` is the number of the node after its subtree.
    """
    count = len(low)
    if count == 0:
        return np.zeros(0, BVH_NODE), np.zeros(0, np.int64)
    # A complete tree, built a level at a time: numpy splits all nodes of a level at once.
    levels = max(0, ceil(log2(count / FULL)))
    rows = np.full((1, -(-count // 2**levels) << levels), -1)  # -1: padding with empty boxes
    rows[0, :count] = np.arange(count)
    middle = np.vstack((0.5 * (low + high), np.full(3, inf)))
    low, high = np.vstack((low, np.full(3, inf))), np.vstack((high, np.full(3, -inf)))
    numbers = [np.zeros(1, np.int64)]
    for level in range(levels):
        rows = halved(rows, middle, (high[rows].max(1) - low[rows].min(1)).argmax(1))
        numbers.append(np.stack((numbers[-1] + 1, numbers[-1] + 2 ** (levels - level)), 1).ravel())
    nodes = np.zeros(2 ** (levels + 1) - 1, BVH_NODE)
    held = (rows >= 0).sum(1)
    nodes['last'][numbers[-1]] = np.cumsum(held)
    nodes['first'][numbers[-1]] = np.cumsum(held) - held
    bottom, top = low[rows].min(1), high[rows].max(1)
    for level in range(levels, -1, -1):
        node = numbers[level]
        nodes['low'][node], nodes['high'][node] = bottom, top
        nodes['skip'][node] = node + 2 ** (levels - level + 1) - 1
        if level:
            bottom, top = np.minimum(bottom[::2], bottom[1::2]), np.maximum(top[::2], top[1::2])
    return nodes, rows[rows >= 0]


def halved(rows: np.ndarray, middle: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Halves of each of `rows`, split at its boxes' median `middle` along its own `axis`."""
    keys = middle[rows, axis[:, np.newaxis]]
    # Stable, or the order of equal keys, and with it the numbers of parts, would depend on the
    # processor.
    order = np.argsort(keys, axis=1, kind='stable')
    return np.take_along_axis(rows, order, 1).reshape(2 * len(rows), -1)


def leaf_grid(nodes: np.ndarray) -> LeafGrid:
    """`LeafGrid` over the leaves among `nodes`, hierarchies one after the other."""
    numbers = np.flatnonzero(nodes['last'] > nodes['first'])
    if len(numbers) == 0:
        return LeafGrid(np.zeros(2), np.zeros(2), np.full((1, 1, 2), -1), 0)
    low, high = nodes['low'][numbers, :2], nodes['high'][numbers, :2]
    origin, size = low.min(0), high.max(0) - low.min(0)
    side = ceil(sqrt(len(numbers)))
    while True:
        per_metre = np.divide(side, size, out=np.zeros(2), where=size > LEAST_SIZE)
        first, last = (
            np.clip((corner - origin) * per_metre, 0.0, side - 1.0).astype(np.int64)
            for corner in (low, high)
        )
        wide = last - first + 1
        cells = wide.prod(1)
        if side == 1 or cells.sum() <= CELLS_A_LEAF * len(numbers):
            break
        side = side // 2  # long leaves: a coarser grid keeps the table small
    which = np.repeat(np.arange(len(numbers)), cells)
    i, j = np.divmod(np.arange(len(which)) - (np.cumsum(cells) - cells)[which], wide[which, 1])
    i, j = i + first[which, 0], j + first[which, 1]
    leaves = np.empty((side, side, 2), np.int64)
    leaves[..., 0], leaves[..., 1] = len(nodes), -1  # of an empty cell
    np.minimum.at(leaves[..., 0], (i, j), numbers[which])
    np.maximum.at(leaves[..., 1], (i, j), numbers[which])
    return LeafGrid(origin, per_metre, leaves, len(nodes))


@kernel
def column(grid: LeafGrid, axis: int, at: float) -> int:
    """Compute the number of the grid's column along `axis` at a coordinate."""
    share = (at - grid.origin[axis]) * grid.per_metre[axis]
    return int(min(max(0.0, share), len(grid.leaves) - 1.0))


@kernel
def leaves_between(grid: LeafGrid, low: Vector, high: Vector) -> tuple[int, int]:
    """First and last leaf that the box from `low` to `high` may overlap; all if it is large."""
    i0, i1 = column(grid, 0, low[0]), column(grid, 0, high[0])
    j0, j1 = column(grid, 1, low[1]), column(grid, 1, high[1])
    if (i1 - i0 + 1) * (j1 - j0 + 1) > MANY_CELLS:
        return 0, grid.nodes - 1
    first, last = grid.nodes, -1
    for i in range(i0, i1 + 1):
        for j in range(j0, j1 + 1):
            first = min(first, grid.leaves[i, j, 0])
            last = max(last, grid.leaves[i, j, 1])
    return first, last
