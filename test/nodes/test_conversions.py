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

"""Messages say what the records say, and JSON keeps its order and rounding."""

import json
from math import inf, nan

from golf_sim_ros.nodes import conversions, log_lines
from golf_sim_ros.physics import Collision, Result
from golf_sim_ros.recording.json_format import collision_text, rejection_text, result_text
import pytest

# fmt: off
RESULT = Result(
    7, 'ball', 'at_rest', 251.23456, -2.00001, 268.04999, 3.49999, 31.0, 6.12345678, 14.0, 112.4,
    'fairway', 25.0, 0.7, 4, 123.456789012, (268.0, 3.5, -0.00001), (73.35, 0.0, 14.1),
    (0.0, -281.28111, 0.0), '',
)
# fmt: on


def test_a_result_has_its_keys_in_order_and_is_rounded_for_people():
    told = json.loads(result_text(RESULT, 9))
    assert list(told) == [
        'shot',
        'ball',
        'status',
        'carry',
        'carry_side',
        'total',
        'side',
        'apex',
        'flight_time',
        'duration',
        'to_hole',
        'lie',
        'landing_speed',
        'landing_angle',
        'bounces',
        'time',
        'position',
        'velocity',
        'spin',
        'reason',
        'stroke',
        'penalty',
    ]
    assert (told['shot'], told['carry'], told['time']) == (9, 251.2346, 123.456789)
    assert told['spin'] == [0.0, -281.2811, 0.0] and told['bounces'] == 4


def test_no_number_is_told_as_minus_zero():
    assert '-0.0,' not in result_text(RESULT, 1)
    assert '-0.0]' not in result_text(RESULT, 1)


def test_without_a_hole_to_hole_is_null():
    assert json.loads(result_text(RESULT._replace(to_hole=None), 1))['to_hole'] is None


def test_a_rejection_tells_what_was_not_finite_as_null_in_strict_json():
    data = rejection_text(3, 'red', (nan, 1.0, -inf), (0.0, 0.0, 2.0), 'because')
    told = json.loads(data, parse_constant=pytest.fail)
    assert list(told) == ['shot', 'ball', 'status', 'velocity', 'spin', 'reason']
    assert told == {
        'shot': 3,
        'ball': 'red',
        'status': 'rejected',
        'velocity': [None, 1.0, None],
        'spin': [0.0, 0.0, 2.0],
        'reason': 'because',
    }


def test_a_collision_is_told_in_full_precision():
    third = (1 / 3, 0.0, 0.0)
    data = collision_text(Collision(0.1, 'ball', 'bounce', 'sand', *[third] * 7))
    told = json.loads(data)
    assert (told['with'], told['normal'][0], told['time']) == ('sand', 1 / 3, 0.1)
    assert 'with_' not in told


def test_a_stamp_is_the_start_plus_simulated_time_to_the_nanosecond():
    stamp = conversions.header('course', 1_700_000_000_900_000_000, 0.104).stamp
    assert (stamp.sec, stamp.nanosec) == (1_700_000_001, 4_000_000)


def test_the_log_tells_a_drive_as_a_player_would():
    assert log_lines.line(RESULT) == (
        'driver-like shot: carry 251 m, total 268 m, 3 m left, fairway, 112 m to the hole'
    )


def test_the_log_tells_a_putt_to_the_centimetre_and_without_carry():
    putt = RESULT._replace(
        velocity=(2.0, 0.0, 0.0), carry=0.0, total=3.456, side=-0.021, lie='green', to_hole=0.5
    )
    assert log_lines.line(putt) == 'putt: total 3.46 m, 0.02 m right, green, 0.50 m to the hole'


def test_the_log_tells_how_a_shot_ended_that_did_not_come_to_rest():
    assert 'out of bounds' in log_lines.line(RESULT._replace(status='out_of_bounds', lie='rough'))
    assert 'to the hole' not in log_lines.line(RESULT._replace(status='holed'))


@pytest.mark.parametrize(
    'velocity, kind',
    [
        ((73.0, 0.0, 14.0), 'driver-like shot'),
        ((50.0, 0.0, 15.0), 'iron-like shot'),
        ((35.0, 0.0, 20.0), 'wedge-like shot'),
        ((8.0, 0.0, 6.0), 'chip'),
        ((3.0, -1.0, 0.0), 'putt'),
        ((0.0, 0.0, 60.0), 'wedge-like shot'),
    ],
)
def test_a_shot_is_called_after_its_launch(velocity, kind):
    assert log_lines.kind(velocity) == kind
