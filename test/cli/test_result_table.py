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

"""The table that `shoot` prints."""

from golf_sim_ros.cli.result_table import result_table
from golf_sim_ros.shot_input.units import UNITS

RESULT = {
    'shot': 3,
    'ball': 'ball',
    'status': 'at_rest',
    'carry': 251.46,
    'carry_side': -9.144,
    'total': 274.32,
    'side': 0.9144,
    'apex': 29.2608,
    'flight_time': 6.51,
    'duration': 13.2,
    'to_hole': 68.58,
    'lie': 'fairway',
    'landing_speed': 26.8224,
    'landing_angle': 0.6632,
    'bounces': 6,
    'time': 90.1,
    'position': [274.0, 0.9, 0.02],
    'velocity': [73.3, 0.0, 14.1],
    'spin': [0.0, -281.3, 0.0],
    'reason': '',
}


def test_a_result_is_an_aligned_table_in_the_units_of_golf():
    assert result_table(RESULT, UNITS['golf']).splitlines() == [
        'ball           ball',
        'ended          at rest, fairway',
        'carry            275.00 yd',
        'carry side        10.00 yd right',
        'apex              32.00 yd',
        'flight time        6.51 s',
        'landing speed     60.00 mph',
        'landing angle     38.00 deg',
        'bounces            6',
        'total            300.00 yd',
        'side               1.00 yd left',
        'duration          13.20 s',
        'to the hole       75.00 yd',
    ]


def test_a_result_in_si_keeps_metres():
    table = result_table(RESULT, UNITS['si'])
    assert 'carry            251.46 m\n' in table
    assert 'landing speed     26.82 m/s\n' in table


def test_a_putt_has_no_lines_about_a_flight_and_a_hole_that_is_not_there_none_either():
    putt = {
        **RESULT,
        'status': 'holed',
        'carry': 0.0,
        'carry_side': 0.0,
        'apex': 0.0,
        'flight_time': 0.0,
        'landing_speed': 0.0,
        'landing_angle': 0.0,
        'bounces': 0,
        'to_hole': None,
        'side': 0.0,
    }
    labels = [line[:15].strip() for line in result_table(putt, UNITS['si']).splitlines()]
    assert labels == ['ball', 'ended', 'total', 'side', 'duration']
    assert 'in the hole' in result_table(putt, UNITS['si'])
