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

"""Laws of ball against ball. Where there is one ball, nothing of them is in the machine code.

The engine's workspace is a record: its type says whether balls touch each other. These laws have
bodies for `workspace.MultiBallWorkspace`; for `workspace.Workspace` the defaults hold.
"""

import numpy as np

from ..jit import generic
from ..kernel_types import SceneRecord, WorkRecord
from ..state.events import Log


@generic
def prepare_broad_phase(work: WorkRecord, balls: np.ndarray, radius: float) -> None:
    """Prepare the broad phase for a call of the engine. Writes tree, asleep."""


@generic
def update_tree(work: WorkRecord, balls: np.ndarray, i: int, radius: float) -> None:
    """Update the broad phase for ball `i`'s new segment. Writes tree."""


@generic
def first_ball_contact(
    work: WorkRecord, balls: np.ndarray, i: int, radius: float, now: float
) -> tuple[float, int, bool]:
    """First time at which ball `i`'s segment may touch a ball, which, and whether it hits it."""
    return balls[i]['end'], -1, False


@generic
def interrupt_segments(
    work: WorkRecord, balls: np.ndarray, i: int, radius: float, now: float
) -> None:
    """End the segments of moving balls where they hit ball `i`, which rests from now on.

    Writes end, ending, target, segment_ends.
    """


@generic
def collect_ball_contacts(
    work: WorkRecord, land: SceneRecord, balls: np.ndarray, i: int, now: float
) -> None:
    """Add the contacts of ball `i` with other balls, which become involved, at the present.

    Writes contacts, involved, motion, end, ending, apex.
    """


@generic
def resolve_ball_impact(
    work: WorkRecord, land: SceneRecord, balls: np.ndarray, i: int, now: float, log: Log
) -> None:
    """Resolve the impact of ball `i` with its target and all that touches, and log it.

    Writes ball, work.
    """


@generic
def step_together(
    work: WorkRecord, land: SceneRecord, balls: np.ndarray, i: int, now: float
) -> bool:
    """Whether ball `i` is time-stepped with others; solves their step if one is due.

    Writes ball, work.
    """
    return False


@generic
def wake(work: WorkRecord, balls: np.ndarray, radius: float, now: float) -> None:
    """Wake sleepers that touch involved balls; they wake others as they move.

    Writes involved, phase, step, stepping, moved_by_ball, struck_at.
    """


@generic
def log_ball_impacts(work: WorkRecord, balls: np.ndarray, now: float, log: Log) -> None:
    """Log the impacts of balls with balls among the contacts."""
