# SPDX-License-Identifier: Apache-2.0
"""Workspace of the engine for one ball or several, and whose segment ends first."""
from typing import NamedTuple

import numpy as np

from ..jit import kernel
from .ball_interactions import SingleBallWorkspace

TREE_NODE = np.dtype([('low', 'f8', 3), ('high', 'f8', 3), ('skip', 'i8'), ('parent', 'i8'), ('ball', 'i8'),
                      ('first', 'i8'), ('count', 'i8')], align=True)

CONTACT = np.dtype([
    ('a', 'i8'), ('b', 'i8'), ('part', 'i8'), ('normal', 'f8', 3), ('restitution', 'f8'),
    ('tangential_restitution', 'f8'), ('friction', 'f8'), ('mass', 'f8'), ('active', 'i8'), ('rate', 'f8'),
    ('normal_impulse', 'f8'), ('tangent_impulse', 'f8', 3),
    # of generalized reflections
    ('previous_impulse', 'f8'), ('extrapolated_impulse', 'f8'), ('contact_count', 'f8'),
    # of time stepping
    ('separation', 'f8'), ('rolling_resistance', 'f8'),
    ('impulse', 'f8', 3), ('approach_speed', 'f8')], align=True)

CONTACTS_A_BALL = 12
MOST_NEIGHBOURS = 64  # balls that a time-stepped one may have in reach
INVOLVED, CONTACTS, TREE_AGE, ASLEEP = range(4)


class MultiBallWorkspace(NamedTuple):
    """Workspace of an engine whose balls touch each other: that of `SingleBallWorkspace`, and the tree.

    ``nodes``: depth first; ``leaves``: each ball's node; ``order``: scratch of its making; ``neighbours``:
    balls around the one at hand.
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
    count: np.ndarray
    spent: np.ndarray
    nodes: np.ndarray
    leaves: np.ndarray
    order: np.ndarray
    neighbours: np.ndarray


def new_workspace(balls, collide):
    """`MultiBallWorkspace` of that many balls, which `collide`, or `SingleBallWorkspace`."""
    single = SingleBallWorkspace(
        segment_ends=np.full(balls, np.inf), involved=np.zeros(balls, np.int64),
        involved_index=np.full(balls, -1, np.int64), contacts=np.zeros(CONTACTS_A_BALL * balls + 8, CONTACT),
        contact_counts=np.zeros(balls), velocity_change=np.zeros((balls, 3)),
        position_change=np.zeros((balls, 3)), motion_before=np.zeros((balls, 6)),
        solved_motion=np.zeros((balls, 6)), count=np.array([0, 0, balls, 0]), spent=np.zeros(0, np.int64))
    if not collide:
        return single
    return MultiBallWorkspace(*single, nodes=np.zeros(2 * balls - 1, TREE_NODE),
                              leaves=np.zeros(balls, np.int64), order=np.arange(balls),
                              neighbours=np.zeros(MOST_NEIGHBOURS, np.int64))


@kernel
def next_event_ball(work, until):
    """Ball whose segment ends first, at `until` at the latest, or -1."""
    who = -1
    first = until
    for i in range(len(work.segment_ends)):
        if work.segment_ends[i] < first or who < 0 and work.segment_ends[i] == first:
            first = work.segment_ends[i]
            who = i
    return who
