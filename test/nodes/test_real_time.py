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

"""How wall time becomes ticks."""

from golf_sim_ros.nodes import real_time
from golf_sim_ros.nodes.real_time import RealTime
import pytest


@pytest.fixture
def clock(monkeypatch):
    """Replace the wall clock [s]: by a list of one that tests set."""
    now = [100.0]
    monkeypatch.setattr(real_time, 'monotonic', lambda: now[0])
    return now


def ticks(real_time, limit=10.0):
    return sum(1 for _ in real_time.ticks(limit, 0.0))


@pytest.mark.parametrize('factor', [0.1, 1.0, 2.5, 30.0])
def test_time_passes_at_the_factor_however_late_the_timer_calls(clock, factor):
    steady, done = RealTime(0.004, 5, factor), 0
    for late in (0.02, 0.031, 0.0001, 0.5, 0.02, 0.4299):
        clock[0] += late
        done += ticks(steady)
    assert done == int(factor * 1.001 / 0.004)


def test_a_stop_longer_than_the_limit_is_lost_and_counted(clock):
    steady = RealTime(0.01, 2)
    clock[0] += 60.0
    assert ticks(steady, 0.255) == 25
    assert steady.lost == pytest.approx(59.745)


def test_what_the_simulation_stood_still_for_does_not_count(clock):
    steady = RealTime(0.01, 2)
    clock[0] += 60.0
    steady.skip()
    assert ticks(steady) == 0 and steady.lost == 0.0


def test_between_many_ticks_it_is_time_to_publish_after_the_usual_number(clock):
    steady = RealTime(0.01, 5)
    clock[0] += 0.1401
    told = list(steady.ticks(1.0, 0.0))
    assert len(told) == 14 and [number for number, due in enumerate(told) if due] == [5]


def test_ticks_that_take_too_long_stop_and_the_rest_is_lost_and_counted(clock):
    steady, done = RealTime(0.001, 1000, 2.0), 0
    clock[0] += 1.00001
    for _ in steady.ticks(2.0, 0.0):
        done += 1
        clock[0] += 0.1
    assert done == 3
    assert steady.lost == pytest.approx((2000 - done) * 0.001 / 2.0)
    assert ticks(steady, 0.0) == 0  # nothing of it is made up


def test_a_changed_factor_counts_from_then_on(clock):
    steady = RealTime(0.01, 5)
    clock[0] += 0.1001
    assert ticks(steady) == 10
    steady.factor = 0.5
    clock[0] += 0.1001
    assert ticks(steady) == 5


def test_who_hurries_goes_on_for_as_long_as_it_may(clock):
    hasty, told = RealTime(0.01, 5, 0.0), []
    for due in hasty.ticks(1.0, 0.05):
        told.append(due)
        clock[0] += 0.00402
    assert len(told) == 13 and hasty.lost == 0.0
    assert [number for number, due in enumerate(told) if due] == [5, 10]
