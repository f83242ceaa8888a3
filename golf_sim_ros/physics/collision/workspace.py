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

from typing import NamedTuple, Union

import numpy as np

from .ball_interactions import SingleBallWorkspace
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
# stepping with a sleeping ball j, whose `part` is -2 - j. The normal points to `a`; `mass` [kg] is
# the reduced mass; `rate` [m/s] the normal relative velocity. Impulses are over mass [m/s] in the
# solvers; those of an impact are in N s once they are applied.
CONTACT = np.dtype(
    [
        ('a', 'i8'),
        ('b', 'i8'),
        ('part', 'i8'),
        ('normal', 'f8', 3),
        ('restitution', 'f8'),
        ('tangential_restitution', 'f8'),
        ('friction', 'f8'),
        ('mass', 'f8'),
        ('active', 'i8'),
        ('rate', 'f8'),
        ('normal_impulse', 'f8'),
        ('tangent_impulse', 'f8', 3),
        # of generalized reflections: normal impulses of the accelerated gradient method
        ('previous_impulse', 'f8'),
        ('extrapolated_impulse', 'f8'),
        ('contact_count', 'f8'),
        # of time stepping
        ('separation', 'f8'),
        ('rolling_resistance', 'f8'),
        # of an impact, for the log: its whole impulse [N s], its greatest approach
        ('impulse', 'f8', 3),
        ('approach_speed', 'f8'),
    ],
    align=True,
)

CONTACTS_A_BALL = 12
MOST_NEIGHBOURS = 64  # balls that a time-stepped one may have in reach
INVOLVED, CONTACTS, TREE_AGE, ASLEEP = range(4)  # indices of ``count``


class MultiBallWorkspace(NamedTuple):
    """Workspace of an engine whose balls touch each other.

    That of `SingleBallWorkspace`, and the AABB tree: ``nodes`` of the tree, depth first;
    ``leaves``: each ball's node; ``order`` of the balls while the tree is built; ``neighbours``:
    balls within reach of the one at hand.
    """

    segment_ends: np.ndarray
    involved: np.ndarray
    involved_index: np.ndarray
    contacts: np.ndarray
    contact_counts: np.ndarray
    velocity_change: np.ndarray
    position_change: np.ndarray
    motion_before: np.ndarray
    solved_motion: np.ndarray
    count: np.ndarray  # type: ignore[assignment]  # hides tuple.count
    spent: np.ndarray
    nodes: np.ndarray
    leaves: np.ndarray
    order: np.ndarray
    neighbours: np.ndarray


def new_workspace(balls: int, collide: bool) -> Union[SingleBallWorkspace, MultiBallWorkspace]:
    """`MultiBallWorkspace` for that many `balls` if they `collide`, else `SingleBallWorkspace`."""
    single = SingleBallWorkspace(
        segment_ends=np.full(balls, np.inf),
        involved=np.zeros(balls, np.int64),
        involved_index=np.full(balls, -1, np.int64),
        contacts=np.zeros(CONTACTS_A_BALL * balls + 8, CONTACT),
        contact_counts=np.zeros(balls),
        velocity_change=np.zeros((balls, 3)),
        position_change=np.zeros((balls, 3)),
        motion_before=np.zeros((balls, 6)),
        # As many segments as balls since the tree was built: it is built at the first call.
        solved_motion=np.zeros((balls, 6)),
        count=np.array([0, 0, balls, 0]),
        spent=np.zeros(0, np.int64),
    )
    if not collide:
        return single
    return MultiBallWorkspace(
        *single,
        nodes=np.zeros(2 * balls - 1, TREE_NODE),
        leaves=np.zeros(balls, np.int64),
        order=np.arange(balls),
        neighbours=np.zeros(MOST_NEIGHBOURS, np.int64),
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
