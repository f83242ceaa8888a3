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

"""How the benchmarks time: ours and a baseline in turns, in one run, medians of their ratios."""

from math import inf
from statistics import median
from time import process_time
from typing import NamedTuple

ROUNDS = 7


class Row(NamedTuple):
    """One line of the table: a `value` in its `unit`, wanted between `least` and `most`.

    ``times``: what it is made of [s], ours and the baseline's, for one of what is told. ``note``:
    with what settings.
    """

    name: str
    value: float
    unit: str = 'times'
    least: float = -inf
    most: float = inf
    times: tuple = ()
    note: str = ''

    @property
    def holds(self):
        """Whether the value is as wanted."""
        return self.least <= self.value <= self.most


def clocked(play, clock=process_time):
    """Time [s] of a call."""
    began = clock()
    play()
    return clock() - began


def lone(play, count=1, rounds=ROUNDS, clock=process_time):
    """Median time [s] of a call for one of the `count` that it does; it is tried before."""
    play()
    return median(clocked(play, clock) for _ in range(rounds)) / count


def faster(name, ours, baseline, counts=(1, 1), rounds=ROUNDS, clock=process_time, **wanted):
    """Time a call against the baseline's: a `Row` of how many times as fast it is.

    That is for one of the `counts` that each does.

    They are timed in turns, each tried before. Time is that of the process; where threads are
    compared, `clock` is that of the wall.
    """
    ours(), baseline()
    pairs = [
        (clocked(ours, clock) / counts[0], clocked(baseline, clock) / counts[1])
        for _ in range(rounds)
    ]
    return Row(
        name,
        median(theirs / mine for mine, theirs in pairs),
        times=tuple(map(median, zip(*pairs))),
        **wanted,
    )
