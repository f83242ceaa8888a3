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
and skips the whole subtree where it does not. It needs no stack, and can start at any leaf.
"""

from math import ceil, inf, log2

import numpy as np

FULL = 4  # primitives that a leaf may hold

BVH_NODE = np.dtype(
    [('low', 'f8', 3), ('high', 'f8', 3), ('first', 'i8'), ('last', 'i8'), ('skip', 'i8')],
    align=True,
)


def hierarchy(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
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
