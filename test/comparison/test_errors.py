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

"""Errors against what monitors tell: by law, by club, by bin."""

from golf_sim_ros.comparison.errors import bias_and_spread, by_bin, by_club, compare, LAWS
from golf_sim_ros.physics import EFFECTS
from golf_sim_ros.shot_input.launch_monitor import Launch
from golf_sim_ros.shot_input.monitor_columns import UNKNOWN
from golf_sim_ros.shot_input.monitor_file import MonitorShots
from golf_sim_ros.shot_input.units import UNITS
import numpy as np
import pytest

LAUNCHES = (
    Launch(70.0, 0.2, 0.1, 280.0, 10.0),
    Launch(70.0, 0.2, 0.0, 280.0, -10.0),
    Launch(30.0, 0.5, 0.0, 600.0, 0.0),
)


@pytest.fixture(autouse=True)
def in_plain_python(monkeypatch):
    """Play in plain Python: few shots, of which each law would be compiled apart."""
    monkeypatch.setenv('GOLF_SIM_ROS_ENGINE', 'python')


def compared(told, laws=('fitted',), **more):
    """Compare the launches with what was told."""
    shots = MonitorShots(('a', 'b', 'a'), LAUNCHES, told, UNKNOWN, {})
    return compare(shots, laws, UNITS['si'], **more)


def test_an_error_is_simulated_less_told():
    nothing = np.zeros((4, 3))
    flown = compared(nothing).errors['fitted']
    told = np.array([[1.0, 2.0, np.nan], [0.5, 0.0, 0.0], [0.1, 0.0, 0.0], [np.nan, 0.0, 1.0]])
    errors = compared(told).errors['fitted']
    assert np.array_equal(np.isnan(errors), np.isnan(told))
    assert np.nanmax(np.abs(errors - (flown - told))) == 0.0
    # The direction does not count, nor does the side to which it curves.
    assert flown[:, 0] == pytest.approx(flown[:, 1], rel=1e-4)


def test_laws_are_sets_of_effects_that_there_are():
    assert {name for law in LAWS.values() for name in law} <= set(EFFECTS)
    errors = compared(np.zeros((4, 3)), list(LAWS)).errors
    carries = np.array([errors[law][0] for law in LAWS])
    assert np.isfinite(carries).all() and len(np.unique(carries[:, 0].round(3))) == len(LAWS)


def test_wind_is_felt():
    still, tail = (
        compared(np.zeros((4, 3)), wind=wind).errors['fitted'][0]
        for wind in ((0.0, 0.0, 0.0), (5.0, 0.0, 0.0))
    )
    assert (tail > still + 1.0).all()


def test_groups_are_clubs_and_bins():
    groups = compared(np.zeros((4, 3))).groups
    assert {name: [group.label for group in found] for name, found in groups.items()} == {
        'club': ['a', 'b'],
        'ball speed [m/s]': ['20 to 40', '60 to 80'],
        'spin ratio': ['0.06 to 0.09', '0.3 to 0.5'],
    }
    assert groups['club'][0].shots.tolist() == [True, False, True]
    assert by_club(('', '')) == []
    (first, last) = by_bin(np.array([0.0, 0.7]), (0.0, 0.5, np.inf))
    assert (first.label, last.label) == ('0 to 0.5', 'over 0.5')


def test_bias_and_spread_are_of_what_is_known():
    assert bias_and_spread(np.array([1.0, 3.0, np.nan])) == (2.0, 1.0, 2)
    assert bias_and_spread(np.array([np.nan]))[2] == 0
