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

"""How many ticks of simulated time are due by the wall clock."""

from collections.abc import Iterator
from time import monotonic

LONGEST = 0.25  # s of wall time after which ticks stop: callbacks wait for them


class RealTime:
    """Accumulator of wall time that gives it out in whole ticks.

    A timer may call late or skip calls; the time that passed counts all the same, so simulated
    time keeps up. After a stop longer than `limit` (a suspended laptop, a debugger) the rest of it
    is lost, not caught up in one leap. So is what takes longer to simulate than `LONGEST`.

    Parameters
    ----------
    tick : float
        Length of a tick [s].
    usual : int
        Ticks from one publication to the next.
    factor : float
        Simulated seconds a wall second; 0: as fast as it can. May be set.
    """

    def __init__(self, tick: float, usual: int, factor: float = 1.0) -> None:
        self.tick = tick
        self.usual = usual
        self.factor = factor
        self.seen = monotonic()
        self.saved = 0.0
        self.lost = 0.0

    @property
    def hurries(self) -> bool:
        """Whether time passes as fast as it can."""
        return self.factor == 0.0

    def ticks(self, limit: float, busy: float) -> Iterator[bool]:
        """Yield for each tick to do now whether it is time to publish before it.

        At most `limit` [s] of wall time count, and the ticks go on for `LONGEST` of it; where time
        `hurries`, for `busy` [s].
        """
        if self.hurries:
            self.skip()
            yield from self.ticks_until(monotonic() + busy)
            return
        due = self.due(limit)
        until = monotonic() + LONGEST
        for done in range(due):
            if done and monotonic() > until:
                self.lost += (due - done) * self.tick / self.factor
                return
            # After the last ticks the step publishes anyway.
            yield done > 0 and done % self.usual == 0 and due - done >= self.usual

    def ticks_until(self, end: float) -> Iterator[bool]:
        """Yield as `ticks` does until the clock shows `end` [s]."""
        done = 0
        while monotonic() < end:
            yield done > 0 and done % self.usual == 0
            done += 1

    def due(self, limit: float) -> int:
        """Count the ticks to do now; at most `limit` [s] of wall time count."""
        now = monotonic()
        elapsed = now - self.seen
        self.seen = now
        self.lost += max(0.0, elapsed - limit)
        self.saved += min(elapsed, limit) * self.factor
        ticks = int(self.saved / self.tick)
        self.saved -= ticks * self.tick
        return ticks

    def skip(self) -> None:
        """Drop the wall time since the last call: the simulation was paused."""
        self.seen = monotonic()
