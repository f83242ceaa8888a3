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

"""Events that the engine logs for the world to report: impacts, and the ends of shots."""

from typing import NamedTuple

import numpy as np

from ..jit import kernel
from ..kernel_types import StructRecord

# Kinds of event.
BOUNCE, SHOT_ENDS, BALL_HIT, LOST, WATER_HIT, WENT_OUT = range(6)

# Of a BALL_HIT `material` is the number of the other ball.
EVENT = np.dtype(
    [
        ('time', 'f8'),
        ('ball', 'i8'),
        ('kind', 'i8'),
        ('material', 'i8'),
        ('sort', 'i8'),
        # the vectors of a `Collision`, in its order
        ('position', 'f8', 3),
        ('normal', 'f8', 3),
        ('velocity_before', 'f8', 3),
        ('velocity_after', 'f8', 3),
        ('spin_before', 'f8', 3),
        ('spin_after', 'f8', 3),
        ('impulse', 'f8', 3),
    ],
    align=True,
)


class Log(NamedTuple):
    """Event log of one call: ``events[:count[0]]`` are filled.

    ``count[1]``: whether a shot has ended.
    """

    events: np.ndarray
    count: np.ndarray  # type: ignore[assignment]  # hides tuple.count


def new_log(capacity: int = 64) -> Log:
    """Empty `Log` for up to `capacity` events."""
    return Log(np.zeros(capacity, EVENT), np.zeros(2, np.int64))


@kernel
def next_event(log: Log) -> StructRecord:
    """Next event of the log, to be written; the last one again where the log is full.

    Writes log.
    """
    log.count[0] = min(log.count[0] + 1, len(log.events))
    return log.events[log.count[0] - 1]
