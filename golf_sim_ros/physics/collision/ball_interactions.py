# SPDX-License-Identifier: Apache-2.0
"""What a ball has to do with others. Where there is one ball, nothing of it is in the machine code.

The engine's scratch is a record: its type says whether balls touch each other. These laws have bodies for
`Crowd`; for `SingleBallWorkspace` the defaults hold.
"""
from typing import NamedTuple

import numpy as np

from ..jit import generic


class SingleBallWorkspace(NamedTuple):
    """Workspace of an engine whose balls do not touch each other.

    ``segment_ends``: when each ball's segment ends; ``involved``: balls of the event at hand;
    ``involved_index``: where each ball stands among those, or -1; ``contacts``: theirs; ``contact_counts``:
    active contacts of each ball; ``velocity_change`` [m/s] by the impulses that are tried;
    ``position_change`` [m] that takes overlaps away; ``motion_before`` an impact and ``solved_motion`` of a
    time step: velocity and spin; ``count``: of involved balls, of contacts, of segments since the tree was
    built, and whether any ball may be asleep on another; ``spent``: cycles by stage, empty if nobody asks.
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


@generic
def prepare_broad_phase(work, balls, radius):
    """Make ready for advancing."""


@generic
def update_tree(work, balls, i, radius):
    """Take note of ball `i`'s new segment."""


@generic
def first_ball_contact(work, balls, i, radius, now):
    """First time at which ball `i`'s segment touches another ball, which, and whether it really does."""
    return balls[i]['end'], -1, False


@generic
def interrupt_segments(work, balls, i, radius, now):
    """Let balls that move end their segments where they meet ball `i`, which rests from now on."""


@generic
def collect_ball_contacts(work, land, balls, i, now):
    """Add contacts of ball `i` with other balls, which become involved."""


@generic
def resolve_ball_impact(work, land, balls, i, now, log):
    """Let ball `i` collide with the ball that it meets, and all that touch. Writes motion; logs impacts."""


@generic
def step_together(work, land, balls, i, now):
    """Let a ball that others hold move with them. Returns whether it is such a ball."""
    return False


@generic
def wake(work, balls, radius, now):
    """Wake sleepers that lean on involved balls; those wake others as they move. Writes involved, phase."""


@generic
def log_ball_impacts(work, balls, now, log):
    """Log the impacts of balls among the contacts."""
