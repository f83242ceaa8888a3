# SPDX-License-Identifier: Apache-2.0
"""How many ticks of simulated time are due by the wall clock."""
from time import monotonic


class Pace:
    """An accumulator of wall time that gives it out in whole ticks.

    A timer may call late or skip calls; the time that passed counts all the same, so simulated
    time keeps up. After a stop longer than `limit` (a suspended laptop, a debugger) the rest of it
    is lost, not caught up in one leap.

    Parameters
    ----------
    tick : float
        Length of a tick [s].
    """

    def __init__(self, tick):
        self.tick = tick
        self.seen = monotonic()
        self.saved = 0.0
        self.lost = 0.0

    def due(self, limit):
        """Ticks to do now; at most `limit` [s] of wall time count."""
        now = monotonic()
        elapsed = now - self.seen
        self.seen = now
        self.lost += max(0.0, elapsed - limit)
        self.saved += min(elapsed, limit)
        ticks = int(self.saved / self.tick)
        self.saved -= ticks * self.tick
        return ticks

    def skip(self):
        """Forget the time since the last call: the simulation was told to stand still."""
        self.seen = monotonic()
