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

"""Shots to be drawn, from a simulation or a recording."""

from typing import Any, NamedTuple

import numpy as np

from ..physics.mechanics.vector import ZERO
from ..physics.result import Collision, Result
from ..physics.simulation import checked_gusts, Play


class DrawnShot(NamedTuple):
    """A shot to be drawn; SI units, the course's frame, all times on one clock.

    Parameters
    ----------
    result : golf_sim_ros.physics.Result
    collisions : tuple of golf_sim_ros.physics.Collision
    times : ndarray, (n,)
        The first is that of the strike, the last that of the end.
    positions, velocities, spins : ndarray, (n, 3)
    wind : ndarray, (m, 4)
        Rows of a time and the wind from then on; the first not after the strike.
    """

    result: Result
    collisions: tuple[Collision, ...]
    times: np.ndarray
    positions: np.ndarray
    velocities: np.ndarray
    spins: np.ndarray
    wind: np.ndarray

    @property
    def flew(self) -> bool:
        """Whether the ball left the ground when it was struck."""
        return self.result.apex > 0.0


def drawn(play: Play, wind: Any = ZERO) -> DrawnShot:
    """Make the `DrawnShot` of a `Play`; `wind` is what was given to `simulate`."""
    return DrawnShot(
        play.result,
        play.collisions,
        play.times,
        play.positions,
        play.velocities,
        play.spins,
        checked_gusts(wind),
    )


def detailed(shot: DrawnShot) -> DrawnShot:
    """`shot` with two more rows for each collision, just before and just after it."""
    hits = [hit for hit in shot.collisions if shot.times[0] <= hit.time <= shot.times[-1]]
    if not hits:
        return shot
    places = np.searchsorted(shot.times, np.repeat([hit.time for hit in hits], 2))

    def with_hits(rows: np.ndarray, before: str, after: str) -> np.ndarray:
        more = [getattr(hit, name) for hit in hits for name in (before, after)]
        return np.insert(rows, places, more, axis=0)

    return shot._replace(
        times=with_hits(shot.times, 'time', 'time'),
        positions=with_hits(shot.positions, 'position', 'position'),
        velocities=with_hits(shot.velocities, 'velocity_before', 'velocity_after'),
        spins=with_hits(shot.spins, 'spin_before', 'spin_after'),
    )
