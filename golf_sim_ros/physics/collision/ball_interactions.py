# SPDX-License-Identifier: Apache-2.0
"""What a ball has to do with others. Where there is one ball, nothing of it is in the machine code.

The engine's scratch is a record: its type says whether balls touch each other. These laws have bodies for
`Crowd`; for `SingleBallWorkspace` the defaults hold.
"""
from typing import NamedTuple

import numpy as np

from ..jit import generic


class SingleBallWorkspace(NamedTuple):
    """Scratch of an engine whose balls do not touch each other.

    ``ends``: when each ball's piece ends; ``members``, ``contacts``: of the impact at hand; ``places``: index
    among the members of each ball, or -1; ``flow``: change of each member's velocity; ``before``: its motion
    before the impact; ``count``: of members, of contacts, of new pieces since the tree was built; and whether
    any balls may be asleep that lean on others; ``spent``: cycles by stage, or empty where nobody asks.
    """

    ends: np.ndarray
    members: np.ndarray
    places: np.ndarray
    flow: np.ndarray
    before: np.ndarray
    contacts: np.ndarray
    count: np.ndarray
    spent: np.ndarray


@generic
def prepare_broad_phase(crowd, balls, radius):
    """Make ready for advancing."""


@generic
def update_tree(crowd, balls, i, radius):
    """Take note of ball `i`'s new piece."""


@generic
def first_ball_contact(crowd, balls, i, radius, now):
    """First time at which ball `i`'s piece touches another ball, which, and whether it really does."""
    return balls[i]['end'], -1, False


@generic
def interrupt_segments(crowd, balls, i, radius, now):
    """Let balls that move end their pieces where they meet ball `i`, which rests from now on."""


@generic
def collect_ball_contacts(crowd, land, balls, i, now):
    """Add contacts of member `i` with other balls; they become members."""


@generic
def resolve_ball_impact(crowd, land, balls, i, now, log):
    """Let ball `i` collide with the ball that it meets, and all that touch. Writes motion; logs impacts."""


@generic
def step_together(crowd, land, balls, i, now):
    """Let a ball that others hold move with them. Returns whether it is such a ball."""
    return False


@generic
def wake(crowd, balls, radius, now):
    """Wake the sleepers that lean on members; those wake others as they move. Writes members, phases."""


@generic
def log_ball_impacts(crowd, balls, now, log):
    """Log the impacts of balls among the contacts."""
