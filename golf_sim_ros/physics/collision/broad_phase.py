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

r"""Broad phase: which balls may touch, by a tree of axis-aligned bounding boxes (AABB tree).

Every ball's segment has a swept box. The boxes are the leaves of a binary tree, stored depth
first, so that a query needs no stack: a node whose box is missed is skipped with all below it::

        0                nodes  0 1 2 3 4     node 1 has the leaves 2 and 3;
       / \               skip   5 4 3 4 5     missing 1, go on at 4
      1   4
     / \
    2   3

A new segment of a ball refits the boxes above its leaf; after as many segments as there are balls
the tree is rebuilt, for refitting keeps balls together that have moved apart.
"""

import numpy as np

from . import ball_interactions
from .conservative_advancement import swept_box
from .workspace import MultiBallWorkspace, Tree
from ..jit import kernel, shared
from ..kernel_types import BallRecord, Box, StructRecord, Vector
from ..mechanics.vector import add_scaled, load, store
from ..state.ball import moves, STEPPED

LEAF_MARGIN = 1e-3  # m around the box of a time-stepped ball, which seldom goes far: a fat AABB


@ball_interactions.prepare_broad_phase.register(MultiBallWorkspace)
def _prepare_broad_phase(work: MultiBallWorkspace, balls: np.ndarray, radius: float) -> None:
    work.asleep[0] = 0
    for i in range(len(balls)):
        if balls[i]['sleeps_on_ball']:
            work.asleep[0] = 1
    if work.tree.age[0] >= len(balls):
        rebuild(work.tree, balls, radius)


@kernel
def segment_box(ball: BallRecord, radius: float, room: float) -> Box:
    """Swept box of the ball on its whole segment, with `room` around it."""
    if moves(ball['phase']) and ball['time_stepping'] != STEPPED:
        return swept_box(ball, 0.0, ball['end'] - ball['begin'], radius + room)
    # Straight segments: the ends bound them.
    half = (radius + room, radius + room, radius + room)
    here = load(ball['origin']) if moves(ball['phase']) else load(ball['position'])
    there = (
        add_scaled(here, 1.0, load(ball['position_coefficients'][5]))
        if moves(ball['phase'])
        else here
    )
    low = min(here[0], there[0]), min(here[1], there[1]), min(here[2], there[2])
    high = max(here[0], there[0]), max(here[1], there[1]), max(here[2], there[2])
    return add_scaled(low, -1.0, half), add_scaled(high, 1.0, half)


@kernel
def write_leaf(ball: BallRecord, node: StructRecord, radius: float) -> None:
    """Put the swept box of the ball's segment into its leaf, a fat one if it is time-stepped.

    Writes nodes.
    """
    low, high = segment_box(ball, radius, LEAF_MARGIN if ball['time_stepping'] == STEPPED else 0.0)
    store(node['low'], low)
    store(node['high'], high)


@kernel
def leaf_serves(ball: BallRecord, node: StructRecord, radius: float) -> bool:
    """Whether the fat box of a time-stepped ball still serves for its segment.

    It does where it contains that and is not far too large.
    """
    if ball['time_stepping'] != STEPPED:
        return False
    # Neither too small, which would miss contacts, nor so large that queries find balls far away.
    low, high = segment_box(ball, radius, 0.0)
    for k in range(3):
        if not (
            0.0 <= low[k] - node['low'][k] <= 3.0 * LEAF_MARGIN
            and 0.0 <= node['high'][k] - high[k] <= 3.0 * LEAF_MARGIN
        ):
            return False
    return True


@kernel
def refit(tree: Tree, i: int) -> None:
    """Put the box of node `i` around those of its children. Writes nodes."""
    node = tree.nodes[i]
    one = tree.nodes[i + 1]
    other = tree.nodes[one['skip']]
    for k in range(3):
        node['low'][k] = min(one['low'][k], other['low'][k])
        node['high'][k] = max(one['high'][k], other['high'][k])


@shared
def rebuild(tree: Tree, balls: np.ndarray, radius: float) -> None:
    """Build the tree top down, with median splits of the longest axis.

    Writes tree.
    """
    tree.age[0] = 0
    for i in range(len(balls)):
        tree.order[i] = i
    tree.nodes[0]['first'] = 0
    tree.nodes[0]['count'] = len(balls)
    tree.nodes[0]['parent'] = -1
    for i in range(len(tree.nodes)):
        node = tree.nodes[i]
        n = node['count']
        node['skip'] = i + 2 * n - 1  # a subtree of n leaves has 2 n - 1 nodes
        node['ball'] = -1
        if n == 1:
            number = tree.order[node['first']]
            node['ball'] = number
            tree.leaves[number] = i
            write_leaf(balls[number], node, radius)
            continue
        half = n // 2
        partition(tree.order, balls, node['first'], node['first'] + n, node['first'] + half)
        set_node(tree.nodes[i + 1], i, node['first'], half)
        set_node(tree.nodes[i + 2 * half], i, node['first'] + half, n - half)
    # Children stand behind their parents: refit from the back.
    for back in range(1, len(tree.nodes) + 1):
        i = len(tree.nodes) - back
        if tree.nodes[i]['ball'] < 0:
            refit(tree, i)


@kernel
def set_node(node: StructRecord, parent: int, first: int, count: int) -> None:
    """Set a node's parent and its range of balls. Writes nodes."""
    node['parent'] = parent
    node['first'] = first
    node['count'] = count


@kernel
def partition(order: np.ndarray, balls: np.ndarray, first: int, last: int, middle: int) -> None:
    """Partition balls `first` to `last` at index `middle` along the longest axis. Writes order."""
    axis = 0
    widest = -1.0
    for k in range(3):
        low = 1e300
        high = -1e300
        for i in range(first, last):
            low = min(low, balls[order[i]]['position'][k])
            high = max(high, balls[order[i]]['position'][k])
        if high - low > widest:
            widest = high - low
            axis = k
    last -= 1
    while first < last:  # Hoare's quickselect: halves need not be sorted
        pivot = balls[order[(first + last) // 2]]['position'][axis]
        i = first
        j = last
        while i <= j:
            while balls[order[i]]['position'][axis] < pivot:
                i += 1
            while balls[order[j]]['position'][axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i += 1
                j -= 1
        if middle <= j:
            last = j
        elif middle >= i:
            first = i
        else:
            break


@ball_interactions.update_tree.register(MultiBallWorkspace)
def _update_tree(work: MultiBallWorkspace, balls: np.ndarray, i: int, radius: float) -> None:
    update_leaf(work.tree, balls, i, radius)


@shared
def update_leaf(tree: Tree, balls: np.ndarray, i: int, radius: float) -> None:
    """Update the tree for ball `i`'s new segment. Writes tree."""
    # A pile moves so little that most of its segments change nothing in the tree.
    leaf = tree.leaves[i]
    if leaf_serves(balls[i], tree.nodes[leaf], radius):
        return
    tree.age[0] += 1
    if tree.age[0] > len(balls):
        rebuild(tree, balls, radius)
        return
    write_leaf(balls[i], tree.nodes[leaf], radius)
    at = tree.nodes[leaf]['parent']
    while at >= 0:
        refit(tree, at)
        at = tree.nodes[at]['parent']


@kernel
def next_node(tree: Tree, at: int, low: Vector, high: Vector) -> int:
    """First leaf from node `at` on whose box overlaps that from `low` to `high`, or -1."""
    while at < len(tree.nodes):
        node = tree.nodes[at]
        if (
            node['low'][0] > high[0]
            or node['high'][0] < low[0]
            or node['low'][1] > high[1]
            or node['high'][1] < low[1]
            or node['low'][2] > high[2]
            or node['high'][2] < low[2]
        ):
            at = node['skip']
        elif node['ball'] >= 0:
            return at
        else:
            at += 1
    return -1
