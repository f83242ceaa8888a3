# SPDX-License-Identifier: Apache-2.0
"""Scratch of the engine for one ball or several, and whose segment ends first."""
from typing import NamedTuple
import numpy as np

from ..jit import kernel
from .ball_interactions import SingleBallWorkspace

TREE_NODE = np.dtype([('low', 'f8', 3), ('high', 'f8', 3), ('skip', 'i8'), ('parent', 'i8'), ('ball', 'i8'),
                 ('first', 'i8'), ('count', 'i8')], align=True)

CONTACT = np.dtype([
    ('a', 'i8'), ('b', 'i8'), ('part', 'i8'), ('normal', 'f8', 3), ('restitution', 'f8'),
    ('tangential', 'f8'), ('friction', 'f8'), ('mass', 'f8'), ('active', 'i8'), ('rate', 'f8'),
    ('push', 'f8'), ('before', 'f8'), ('ahead', 'f8'), ('shared', 'f8'), ('rub', 'f8', 3),
    ('impulse', 'f8', 3), ('approach', 'f8')], align=True)

CONTACTS_A_BALL = 12
MOST_NEIGHBOURS = 64  # balls that one of a pile may have in reach
INVOLVED, CONTACTS, TREE_AGE, ASLEEP = range(4)


class MultiBallWorkspace(NamedTuple):
    """Scratch of an engine whose balls touch each other: that of `SingleBallWorkspace`, and the tree.

    ``nodes``: depth first; ``leaves``: each ball's node; ``order``: scratch of its making; ``near``: balls
    around the one at hand.
    """

    ends: np.ndarray
    members: np.ndarray
    places: np.ndarray
    flow: np.ndarray
    before: np.ndarray
    contacts: np.ndarray
    count: np.ndarray
    spent: np.ndarray
    nodes: np.ndarray
    leaves: np.ndarray
    order: np.ndarray
    near: np.ndarray


def new_workspace(balls, collide):
    """`MultiBallWorkspace` of that many balls, which `collide`, or `SingleBallWorkspace`."""
    solo = SingleBallWorkspace(np.full(balls, np.inf), np.zeros(balls, np.int64), np.full(balls, -1, np.int64),
                np.zeros((balls, 3)), np.zeros((balls, 6)), np.zeros(CONTACTS_A_BALL * balls + 8, CONTACT),
                np.array([0, 0, balls, 0]),
                np.zeros(0, np.int64))
    if not collide:
        return solo
    return MultiBallWorkspace(*solo, np.zeros(2 * balls - 1, TREE_NODE), np.zeros(balls, np.int64), np.arange(balls),
                 np.zeros(MOST_NEIGHBOURS, np.int64))


@kernel
def next_event_ball(crowd, until):
    """Ball whose piece ends first, at `until` at the latest, or -1."""
    who = -1
    first = until
    for i in range(len(crowd.ends)):
        if crowd.ends[i] < first or who < 0 and crowd.ends[i] == first:
            first = crowd.ends[i]
            who = i
    return who
