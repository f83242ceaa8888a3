# SPDX-License-Identifier: Apache-2.0
"""How well the simulation keeps up, for /diagnostics."""
from collections import deque
from math import ceil
from time import monotonic

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

SLOW = 0.95  # simulated seconds a wall second; below this a viewer notices


class Diagnosis:
    """Figures gathered while the simulation runs."""

    def __init__(self):
        self.durations = deque([0.0], maxlen=1000)
        self.made_up = 0
        self.wind_came = None
        self.last = monotonic(), 0.0
        self.factor = 1.0

    def note_wind(self):
        """Note that a wind came."""
        self.wind_came = monotonic()

    def count(self, ticks, usual):
        """Note that a step did `ticks` where in time it would do `usual`."""
        self.made_up += max(0, ticks - ceil(usual))

    def mark(self, time):
        """Note that it is now simulated `time` [s]: the real-time factor is that since the last mark."""
        now, (then, before) = monotonic(), self.last
        self.factor = (time - before) / max(now - then, 1e-9)
        self.last = now, time

    def values(self, world, lost):
        """Dict of names to what a person reads about `world`, which lost `lost` [s] of wall time."""
        ordered = sorted(self.durations)
        return {
            'real-time factor': f'{self.factor:.3f}',
            'tick time p50 [us]': f'{1e6 * ordered[len(ordered) // 2]:.1f}',
            'tick time p99 [us]': f'{1e6 * ordered[int(0.99 * len(ordered))]:.1f}',
            'ticks made up': str(self.made_up),
            'wall time given up [s]': f'{lost:.3f}',
            'accuracy': world.accuracy,
            'effects on': ', '.join(world.effects_on) or 'none',
            **{f'effect off: {name}': why for name, why in world.effects_off.items()},
            'wind age [s]': self.wind_age(),
        }

    def wind_age(self):
        """Seconds since a wind came, as text."""
        return 'no wind yet' if self.wind_came is None else f'{monotonic() - self.wind_came:.1f}'


def diagnostic(stamp, name, slow, values):
    """DiagnosticArray with one status; a warning if the simulation is `slow`."""
    status = DiagnosticStatus(level=DiagnosticStatus.OK, name=name, message='keeps up with the clock')
    if slow:
        status.level, status.message = DiagnosticStatus.WARN, 'slower than the clock'
    status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
    array = DiagnosticArray(status=[status])
    array.header.stamp = stamp
    return array
