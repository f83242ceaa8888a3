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

"""Workspace of the engine for one ball or several, its contacts, and the next event's ball."""

from typing import NamedTuple

import numpy as np

from ..jit import kernel
from ..kernel_types import WorkRecord

TREE_NODE = np.dtype(
    [
        ('low', 'f8', 3),
        ('high', 'f8', 3),
        ('skip', 'i8'),
        ('parent', 'i8'),
        ('ball', 'i8'),
        ('first', 'i8'),
        ('count', 'i8'),
    ],
    align=True,
)

# Contact of ball `a` with ball `b`, or, where `b` is -1, with a part of the ground, or in time
# stepping with a sleeping ball j, whose `part` is -2 - j. The normal points to `a`; a normal
# impulse is over mass [m/s], as it is solved for.
CONTACT = np.dtype(
    [
        ('a', 'i8'),
        ('b', 'i8'),
        ('part', 'i8'),
        ('normal', 'f8', 3),
        ('friction', 'f8'),
        ('normal_impulse', 'f8'),
        # of an impact: reduced mass [kg], normal relative velocity [m/s], impulses [N s]
        ('restitution', 'f8'),
        ('tangential_restitution', 'f8'),
        ('mass', 'f8'),
        ('active', 'i8'),
        ('rate', 'f8'),
        ('contact_count', 'f8'),
        ('friction_impulse', 'f8', 3),
        # of the same: normal impulses of the accelerated gradient method
        ('previous_impulse', 'f8'),
        ('extrapolated_impulse', 'f8'),
        # of the same, for the log: its whole impulse [N s], its greatest approach [m/s]
        ('impulse', 'f8', 3),
        ('approach_speed', 'f8'),
        # of time stepping: gap [m], tangential impulse over mass [m/s]
        ('separation', 'f8'),
        ('rolling_resistance', 'f8'),
        ('tangent_impulse', 'f8', 3),
    ],
    align=True,
)

CONTACTS_A_BALL = 12
MOST_NEIGHBOURS = 64  # balls that a time-stepped one may have in reach
INVOLVED, CONTACTS = range(2)  # indices of ``counts``


class ImpactScratch(NamedTuple):
    """Scratch of simultaneous impacts, a row a ball.

    ``contact_counts``: active contacts of each ball; ``velocity_change`` [m/s] by the extrapolated
    impulses; ``motion_before``: velocity and spin before the impact, for the log.
    """

    contact_counts: np.ndarray
    velocity_change: np.ndarray
    motion_before: np.ndarray


class SolverScratch(NamedTuple):
    """Scratch of the contact solver, a row a ball, for piles and a wedged ball.

    ``solved_motion``: velocity and spin; ``position_change`` [m] that corrects penetration;
    ``neighbours``: balls within reach of the one at hand.
    """

    solved_motion: np.ndarray
    position_change: np.ndarray
    neighbours: np.ndarray


class Tree(NamedTuple):
    """AABB tree of the broad phase.

    ``nodes`` of `TREE_NODE`, depth first; ``leaves``: each ball's node; ``order`` of the balls
    while the tree is built; ``age``, an array of one: segments since it was built.
    """

    nodes: np.ndarray
    leaves: np.ndarray
    order: np.ndarray
    age: np.ndarray


class Workspace(NamedTuple):
    """Workspace of an engine whose balls do not touch each other: its events, a scratch a solver.

    ``segment_ends``: when each ball's segment ends; ``involved``: balls of the event at hand;
    ``involved_index``: index of each ball among those, or -1; ``contacts`` of these balls, rows of
    `CONTACT`; ``counts`` of the involved balls and of contacts; ``asleep``, an array of one:
    whether any ball may be asleep on another; ``spent``: cycles by stage, empty unless they are
    measured.
    """

    segment_ends: np.ndarray
    involved: np.ndarray
    involved_index: np.ndarray
    contacts: np.ndarray
    counts: np.ndarray
    asleep: np.ndarray
    impact: ImpactScratch
    solver: SolverScratch
    tree: Tree
    spent: np.ndarray


class MultiBallWorkspace(Workspace):
    """Workspace of an engine whose balls touch each other: the type alone says that they do."""

    __slots__ = ()


def new_workspace(balls: int, collide: bool) -> Workspace:
    """`MultiBallWorkspace` for that many `balls` if they `collide`, else `Workspace`."""
    kind = MultiBallWorkspace if collide else Workspace
    return kind(
        segment_ends=np.full(balls, np.inf),
        involved=np.zeros(balls, np.int64),
        involved_index=np.full(balls, -1, np.int64),
        contacts=np.zeros(CONTACTS_A_BALL * balls + 8, CONTACT),
        counts=np.zeros(2, np.int64),
        asleep=np.zeros(1, np.int64),
        impact=ImpactScratch(np.zeros(balls), np.zeros((balls, 3)), np.zeros((balls, 6))),
        solver=SolverScratch(
            np.zeros((balls, 6)), np.zeros((balls, 3)), np.zeros(MOST_NEIGHBOURS, np.int64)
        ),
        tree=Tree(
            np.zeros(2 * balls - 1, TREE_NODE),
            np.zeros(balls, np.int64),
            np.arange(balls),
            np.array([balls]),  # as many segments as balls: it is built at the first call
        ),
        spent=np.zeros(0, np.int64),
    )


@kernel
def next_event_ball(work: WorkRecord, until: float) -> int:
    """Ball whose segment ends first, at `until` at the latest, or -1.

    A linear search: of equal times the lowest number comes first.
    """
    who = -1
    first = until
    for i in range(len(work.segment_ends)):
        if work.segment_ends[i] < first or who < 0 and work.segment_ends[i] == first:
            first = work.segment_ends[i]
            who = i
    return who
