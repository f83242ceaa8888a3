# SPDX-License-Identifier: Apache-2.0
"""Boxes in boxes: what lies near a place is found in steps that go with the logarithm of how much there is.

Each box is halved across its longest side until few things are left in it. Nodes are stored depth first,
and so are the things: a walk goes on to the next node where a box is met and skips the whole box where
it is not. It needs no stack, and can begin at any leaf.
"""
from math import ceil, inf, log2

import numpy as np

FULL = 4  # things that a leaf may hold

BVH_NODE = np.dtype([('low', 'f8', 3), ('high', 'f8', 3), ('first', 'i8'), ('last', 'i8'), ('skip', 'i8')],
                    align=True)


def hierarchy(low, high):
    """Nodes over the boxes from `low` to `high`, both (n, 3), and the boxes' order depth first.

    In that order a leaf holds ``first`` to ``last``, any other node none; ``skip`` is the number of the
    node after all that is in it.
    """
    count = len(low)
    if count == 0:
        return np.zeros(0, BVH_NODE), np.zeros(0, np.int64)
    levels = max(0, ceil(log2(count / FULL)))
    rows = np.full((1, -(-count // 2 ** levels) << levels), -1)  # -1: filled up with boxes of nothing
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


def halved(rows, middle, axis):
    """Each of `rows` as two, split halfway in the order of its boxes' `middle` along its own `axis`."""
    keys = middle[rows, axis[:, np.newaxis]]
    # Stable, or equals would be ordered as the processor likes and parts be numbered by that.
    order = np.argsort(keys, axis=1, kind='stable')
    return np.take_along_axis(rows, order, 1).reshape(2 * len(rows), -1)
