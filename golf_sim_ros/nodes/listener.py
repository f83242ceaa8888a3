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

"""What a `Game` reports, to whoever listens: publishers of topics, a page, a test."""

from typing import Protocol

import numpy as np

from ..physics import BallState, Collision, Result


class Listener(Protocol):
    """All that happens in a game, in the order in which it happens."""

    def journal_entry(self, text: str) -> None:
        """Hear one more entry of the journal, an object of JSON; the first one configures."""

    def collision(self, collision: Collision) -> None:
        """Hear of an impact."""

    def result(self, result: Result, shot: int) -> None:
        """Hear of the end of strike number `shot`."""

    def rejection(self, shot: int, ball: str, velocity: tuple, spin: tuple, reason: str) -> None:
        """Hear that strike number `shot` was not played."""

    def path_begins(self, ball: str) -> None:
        """Hear that the path of a ball is over: it was struck, placed or put back to the start."""

    def balls(
        self, balls: dict[str, BallState], orientations: dict[str, np.ndarray], moving: set[str]
    ) -> None:
        """Hear that the time of the world has gone on.

        `balls` move or have just stopped; those named in `moving` move.
        """

    def scene(self, wind: tuple) -> None:
        """Show the whole play, with the wind that blows: seldom, but always where balls stop."""

    def course(self) -> None:
        """Show the course: somebody new looks at it."""

    def diagnostics(self, slow: bool, values: dict[str, str]) -> None:
        """Hear how well the simulation keeps up, once a second."""
