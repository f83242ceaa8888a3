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

"""The gusts keep their settings, are repeatable, and have no jumps."""

from math import atan2, exp, hypot, pi

from golf_sim_ros.wind.gusts import gust, gust_wind, Gusts, GustSettings, turbulence
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis.strategies import floats, integers
import numpy as np
import pytest

BREEZE = GustSettings(speed=4.0, speed_spread=3.0, direction=0.5, direction_spread=1.0)
TURBULENT = BREEZE._replace(turbulence=0.2)


def test_a_gust_blows_steadily_from_the_end_of_its_ramp_to_the_next_gust():
    for number in range(5):
        start = number * BREEZE.interval
        steady = {gust_wind(BREEZE, 1, start + since) for since in (1.0, 2.0, 5.0, 9.999)}
        assert steady == {gust(BREEZE, 1, number)}


def test_every_interval_brings_another_gust():
    gusts = [gust_wind(BREEZE, 1, 10.0 * number + 5.0) for number in range(100)]
    assert len(set(gusts)) == 100


@pytest.mark.parametrize('ramp', [0.5, 1.0, 10.0, 25.0])
def test_the_wind_has_no_jump_where_a_gust_begins_or_is_eased_in(ramp):
    breeze = BREEZE._replace(ramp=ramp)
    largest_change = 2.0 * (breeze.speed + breeze.speed_spread)
    times = np.arange(-20.0, 60.0, 0.001)
    winds = np.array([gust_wind(breeze, 3, time) for time in times])
    # The steepest point of 3 s^2 - 2 s^3 rises by 1.5 a ramp.
    steepest = 1.5 * largest_change / min(ramp, breeze.interval)
    assert np.abs(np.diff(winds, axis=0)).max() <= steepest * 0.001


def test_halfway_through_the_ramp_the_wind_is_halfway_between_two_gusts():
    old, new = gust(BREEZE, 7, 2), gust(BREEZE, 7, 3)
    halfway = [(a + b) / 2.0 for a, b in zip(old, new)]
    assert gust_wind(BREEZE, 7, 30.5) == pytest.approx(halfway, abs=1e-12)


def test_without_a_ramp_a_gust_is_there_at_once():
    assert gust_wind(BREEZE._replace(ramp=0.0), 7, 30.0) == gust(BREEZE, 7, 3)


def test_speed_and_direction_fill_their_ranges_evenly():
    gusts = [gust(BREEZE, 11, number) for number in range(4000)]
    speeds = np.array([hypot(x, y) for x, y in gusts])
    directions = np.array([atan2(y, x) for x, y in gusts])
    for values, middle, spread in ((speeds, 4.0, 3.0), (directions, 0.5, 1.0)):
        assert values.min() >= middle - spread and values.max() <= middle + spread
        counts, _ = np.histogram(values, bins=10, range=(middle - spread, middle + spread))
        # 400 in each tenth; the standard deviation of a count is 19.
        assert np.abs(counts - 400).max() < 5 * 19


def test_speed_and_direction_of_gusts_are_independent():
    gusts = [gust(BREEZE, 5, number) for number in range(4000)]
    speeds = [hypot(x, y) for x, y in gusts]
    directions = [atan2(y, x) for x, y in gusts]
    assert abs(np.corrcoef(speeds, directions)[0, 1]) < 5.0 / 4000**0.5
    assert abs(np.corrcoef(speeds[1:], speeds[:-1])[0, 1]) < 5.0 / 4000**0.5


def test_a_spread_over_the_speed_gives_calms_but_never_a_wind_from_behind():
    light = GustSettings(speed=1.0, speed_spread=3.0, direction_spread=0.0)
    gusts = [gust(light, 2, number) for number in range(1000)]
    assert min(x for x, _ in gusts) == 0.0
    # A third of -2 .. 4 m/s is below 0.
    assert sum(x == 0.0 for x, _ in gusts) == pytest.approx(333, abs=75)


@pytest.mark.parametrize('direction', [0.0, pi / 2, pi, -2.0])
def test_without_spread_every_gust_is_the_wind_that_was_asked_for(direction):
    steady = GustSettings(speed=6.0, speed_spread=0.0, direction=direction, direction_spread=0.0)
    wind = Gusts(steady, 9).wind(1234.5)
    assert wind == pytest.approx(
        (6.0 * np.cos(direction), 6.0 * np.sin(direction), 0.0), abs=1e-12
    )


@given(seed=integers(0, 2**63 - 1), time=floats(-1e6, 2e9))
@hypothesis_settings(max_examples=50, deadline=None)
def test_the_same_seed_gives_the_same_wind_whatever_was_asked_before(seed, time):
    asked_before = Gusts(TURBULENT, seed)
    for other in (time + 5000.0, time - 5000.0, time - 0.1):
        asked_before.wind(other)
    assert asked_before.wind(time) == Gusts(TURBULENT, seed).wind(time)


def test_different_seeds_give_different_gusts():
    assert len({Gusts(BREEZE, seed).wind(5.0) for seed in range(50)}) == 50


def test_the_wind_blows_level_and_is_finite_long_after_the_start():
    for time in (-1e9, 0.0, 1.8e9):
        x, y, z = Gusts(TURBULENT, 1).wind(time)
        assert z == 0.0 and np.isfinite([x, y]).all()


def turbulence_of(seed, length=2000.0, step=0.1):
    return np.array([turbulence(seed, time) for time in np.arange(0.0, length, step)])


def test_the_turbulence_has_mean_zero_and_variance_one():
    values = turbulence_of(4)
    # 2000 correlation times: the mean is known to sqrt(2 / 2000), the variance to sqrt(2 / 2000).
    assert np.abs(values.mean(axis=0)).max() < 5 * 0.032
    assert np.abs(values.var(axis=0) - 1.0).max() < 5 * 0.032


def test_the_turbulence_forgets_exponentially():
    values = turbulence_of(4)
    for lag in (0.1, 0.5, 1.0, 2.0):
        shift = round(lag / 0.1)
        covariance = (values[:-shift] * values[shift:]).mean(axis=0)
        assert np.abs(covariance - exp(-lag)).max() < 5 * 0.032


def test_the_two_components_of_the_turbulence_are_independent():
    values = turbulence_of(4)
    # Both have correlation time 1, their product 1/2: known to sqrt(1 / 2000).
    assert abs((values[:, 0] * values[:, 1]).mean()) < 5 * 0.0224


def test_the_steps_of_the_turbulence_go_on_over_the_edge_of_a_block():
    edge = 40.0
    steps = np.array([turbulence(8, edge + 0.01 * number) for number in range(-500, 500)])
    kicks = steps[1:] - exp(-0.01) * steps[:-1]
    # Every kick has the deviation sqrt(1 - exp(-0.02)) = 0.1407, the one at the edge too.
    assert np.abs(kicks).max() < 5 * 0.1407
    assert kicks.std() == pytest.approx(0.1407, rel=0.1)


def test_turbulence_is_relative_to_the_speed_of_the_gust():
    steady = GustSettings(speed=10.0, speed_spread=0.0, direction_spread=0.0, turbulence=0.2)
    winds = np.array([Gusts(steady, 6).wind(time)[:2] for time in np.arange(0.0, 15000.0, 7.5)])
    assert winds.mean(axis=0) == pytest.approx([10.0, 0.0], abs=5 * 2.0 * 0.045)
    assert winds.std(axis=0) == pytest.approx([2.0, 2.0], rel=5 * 0.045)


def test_new_settings_take_over_without_a_jump_and_leave_no_trace_after_the_ramp():
    gusts = Gusts(BREEZE, 1)
    before = gusts.wind(13.0)
    stronger = GustSettings(speed=12.0, interval=3.0, ramp=2.0)
    gusts.change(stronger, 13.0)
    assert gusts.wind(13.0) == pytest.approx(before, abs=1e-12)
    assert gusts.wind(14.0) not in (before, Gusts(stronger, 1).wind(14.0))
    for time in (15.0, 18.5, 1000.0):
        assert gusts.wind(time) == Gusts(stronger, 1).wind(time)


def test_settings_changed_twice_within_a_ramp_make_no_jump_either():
    gusts = Gusts(BREEZE, 1)
    gusts.change(BREEZE._replace(speed=12.0), 13.0)
    before = gusts.wind(13.4)
    gusts.change(BREEZE._replace(direction=2.0), 13.4)
    assert gusts.wind(13.4) == pytest.approx(before, abs=1e-12)


def test_a_clock_that_starts_again_finds_the_gusts_of_the_settings_now():
    gusts = Gusts(BREEZE, 1)
    gusts.change(TURBULENT, 500.0)
    assert gusts.wind(3.0) == Gusts(TURBULENT, 1).wind(3.0)
