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

"""How well the simulation keeps up with the clock, for /diagnostics."""

from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import ceil
from time import monotonic, perf_counter, process_time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from .log_lines import with_reasons
from ..physics import ACCURACY, cycles_now, World

SLOW = 0.95  # simulated seconds a wall second; below this a viewer notices


class Diagnostics:
    """Figures gathered while the simulation runs.

    Real-time factor, ticks made up, shares of a core.
    """

    def __init__(self) -> None:
        self.durations = deque([0.0], maxlen=1000)
        self.made_up = self.strikes_lost = 0
        self.wind_came: float | None = None
        self.last = monotonic(), 0.0
        self.factor = 1.0
        self.publish_time = self.tick_time = 0.0
        self.account: dict[str, float] | None = None
        self.shares: dict[str, float] = {}

    def note_tick(self, duration: float) -> None:
        """Note that a tick took `duration` [s]."""
        self.durations.append(duration)
        self.tick_time += duration

    @contextmanager
    def publishing(self) -> Iterator[None]:
        """Count what is done in this context as publishing."""
        began = perf_counter()
        yield
        self.publish_time += perf_counter() - began

    def note_wind(self) -> None:
        """Note that a wind message arrived."""
        self.wind_came = monotonic()

    def count(self, ticks: int, usual: float) -> None:
        """Count the ticks made up by a step of `ticks`, where one that is on time has `usual`."""
        self.made_up += max(0, ticks - ceil(usual))

    def mark(self, world: World) -> None:
        """Note the time of `world`: real-time factor and shares are those since the last mark."""
        time = world.time
        self.take_account(world.spent)
        now, (then, before) = monotonic(), self.last
        self.factor = (time - before) / max(now - then, 1e-9)
        self.last = now, time

    def take_account(self, spent: Mapping[str, float]) -> None:
        """Update the shares [%] of time since the last call.

        `spent` are cycles of the engine by stage.
        """
        new: dict[str, float] = {
            'clock': perf_counter(),
            'cycles': cycles_now(),
            'process': process_time(),
            'tick': self.tick_time,
            'publish': self.publish_time,
            **spent,
        }
        old, self.account = self.account, new
        if old is None:
            return
        passed = {name: new[name] - old[name] for name in new}
        wall, cycles = 0.01 * passed['clock'], 0.01 * passed['cycles']
        stages = {name: passed[name] / cycles for name in spent} if cycles else {}
        self.shares = {
            **stages,
            'all of a tick': passed['tick'] / wall,
            'publish': passed['publish'] / wall,
            'all of the process': passed['process'] / wall,
        }

    def values(self, world: World, lost: float) -> dict[str, str]:
        """Values to publish about `world`, texts by name.

        `lost` [s] of wall time were given up.
        """
        ordered, accuracy = sorted(self.durations), str(world.accuracy)
        return {
            'real-time factor': f'{self.factor:.3f}',
            'tick time p50 [us]': f'{1e6 * ordered[len(ordered) // 2]:.1f}',
            'tick time p99 [us]': f'{1e6 * ordered[int(0.99 * len(ordered))]:.1f}',
            'tick time max [us]': f'{1e6 * ordered[-1]:.1f}',
            **{
                f'share of a core, {name} [%]': f'{share:.3f}'
                for name, share in self.shares.items()
            },
            'balls that could not go on': str(world.failures),
            'last of them': world.last_failure or 'none',
            'strikes lost unseen': str(self.strikes_lost),
            'ticks made up': str(self.made_up),
            'wall time given up [s]': f'{lost:.3f}',
            'accuracy': accuracy,
            'error at most, first touch [m]': f'{ACCURACY[accuracy].touch:g}',
            'error at most, rest [m]': f'{ACCURACY[accuracy].rest:g}',
            'effects on': ', '.join(world.effects_on) or 'none',
            **{f'effect off: {name}': why for name, why in world.effects_off.items()},
            'effects asked for in vain': with_reasons(world.effects_needless) or 'none',
            'wind age [s]': self.wind_age(),
        }

    def wind_age(self) -> str:
        """Seconds since a wind message arrived, as text."""
        return 'no wind yet' if self.wind_came is None else f'{monotonic() - self.wind_came:.1f}'


def diagnostic(stamp: Any, name: str, slow: bool, values: dict[str, str]) -> DiagnosticArray:
    """Make a DiagnosticArray with one status; a warning if the simulation is `slow`."""
    status = DiagnosticStatus(
        level=DiagnosticStatus.OK, name=name, message='keeps up with the clock'
    )
    if slow:
        status.level, status.message = DiagnosticStatus.WARN, 'slower than the clock'
    status.values = [KeyValue(key=key, value=value) for key, value in values.items()]
    array = DiagnosticArray(status=[status])
    array.header.stamp = stamp
    return array
