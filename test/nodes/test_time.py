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

"""Simulated time over DDS: faster than the clock, on /clock, and standing still."""

from statistics import median

from geometry_msgs.msg import Vector3Stamped
from processes import LATCHED, parameters, READY, seconds, wait_until
import pytest
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rosgraph_msgs.msg import Clock
from std_srvs.srv import SetBool

DRIVE, DRIVE_SPIN = (20.0, 0.5, 11.0), (0.0, -280.0, 15.0)


@pytest.fixture(scope='module')
def hasty(start):
    """Start a sim that plays as fast as it can and publishes its time."""
    process = start('sim_node', *parameters('/hasty', real_time_factor=0.0, publish_clock='true'))
    process.wait_for(READY)
    return process


@pytest.fixture(scope='module')
def steady(start):
    """Start a sim in step with the clock."""
    process = start('sim_node', *parameters('/steady'))
    process.wait_for(READY)
    return process


@pytest.fixture
def golfer(hasty, make_golfer):
    """Put a golfer at the tee of the hasty sim."""
    golfer = make_golfer('/hasty')
    golfer.reset()
    return golfer


def test_a_shot_as_fast_as_can_be_is_the_same_and_has_as_many_poses(golfer, steady, make_golfer):
    other = make_golfer('/steady')
    slow, fast = other.play(DRIVE, DRIVE_SPIN), golfer.play(DRIVE, DRIVE_SPIN)
    for told in (slow, fast):
        del told['time'], told['shot']
    assert slow == fast
    stamps = sorted({seconds(pose.header.stamp) for pose in golfer.poses})
    moved = [stamp for stamp in stamps if stamp > stamps[-1] - fast['duration']]
    gaps = [after - before for before, after in zip(moved, moved[1:])]
    assert median(gaps) == pytest.approx(0.02, abs=1e-6)  # some may be lost on the way


def test_stamps_are_simulated_time_and_it_stands_still_while_the_ball_rests(golfer):
    result = golfer.play(DRIVE)
    wait_until(
        lambda: seconds(golfer.poses[-1].header.stamp) == pytest.approx(result['time'], abs=0.005),
        'the pose at rest came',
    )
    before = seconds(golfer.poses[-1].header.stamp)
    golfer.heartbeat()
    assert seconds(golfer.poses[-1].header.stamp) == before


def test_the_clock_never_goes_back_and_is_that_of_the_stamps(golfer):
    clocks = golfer.listen(Clock, '/clock', 1000)
    golfer.play(DRIVE)
    golfer.heartbeat()
    wait_until(
        lambda: seconds(clocks[-1].clock) == seconds(golfer.poses[-1].header.stamp), 'both agree'
    )
    times = [seconds(message.clock) for message in clocks]
    assert times == sorted(times) and len(set(times)) > 5


def test_a_paused_sim_stands_still_however_hasty(golfer):
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=True))
    golfer.strike(DRIVE)
    golfer.heartbeat()
    golfer.heartbeat()
    assert not golfer.results_of(DRIVE)
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False))
    wait_until(lambda: golfer.results_of(DRIVE), 'the result came')


def test_a_wind_node_on_simulated_time_draws_a_gust_every_ten_simulated_seconds(
    hasty, start, client
):
    set_factor(client, '/hasty', 25.0)
    start('wind_node', *parameters('/hasty', use_sim_time='true', seed=5))
    heard = client.listen(Vector3Stamped, '/hasty/wind', LATCHED)
    wait_until(lambda: heard, 'a wind came')
    began = seconds(heard[0].header.stamp)
    wait_until(lambda: seconds(heard[-1].header.stamp) > began + 60.0, 'a minute of wind')
    set_factor(client, '/hasty', 0.0)
    gusts = {}
    for message in heard:
        number, since = divmod(seconds(message.header.stamp), 10.0)
        if since > 1.0:  # eased in by then
            gusts.setdefault(number, set()).add((message.vector.x, message.vector.y))
    assert len(gusts) >= 6 and all(len(winds) == 1 for winds in gusts.values())
    assert len(set.union(*gusts.values())) == len(gusts)


def set_factor(client, namespace, factor):
    """Ask the sim for a new real-time factor: its answer."""
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=factor)
    request = SetParameters.Request(parameters=[Parameter(name='real_time_factor', value=value)])
    return client.call(SetParameters, f'{namespace}/golf_sim/set_parameters', request).results[0]


@pytest.mark.parametrize('factor', [0.05, -1.0, 1e4, float('nan')])
def test_a_factor_that_makes_no_sense_is_refused_with_a_reason(steady, client, factor):
    answer = set_factor(client, '/steady', factor)
    assert not answer.successful and answer.reason


def test_a_factor_set_while_the_ball_flies_counts_at_once(steady, make_golfer):
    golfer = make_golfer('/steady')
    golfer.reset()
    high = (1.0, 0.0, 140.0)  # nobody waits so long for what comes down
    golfer.strike(high)
    wait_until(lambda: golfer.poses[-1].pose.position.z > 1.0, 'the ball flies')
    assert set_factor(golfer, '/steady', 0.0).successful
    wait_until(lambda: golfer.results_of(high), 'the result came')
    assert set_factor(golfer, '/steady', 1.0).successful


@pytest.mark.parametrize('values', [{'real_time_factor': 0.01}, {'use_sim_time': 'true'}])
def test_a_start_that_makes_no_sense_is_one_line_and_exit_code_1(start, values):
    process = start('sim_node', *parameters('/wrong', **values))
    assert process.wait() == 1
    assert len(process.lines) == 1 and next(iter(values)) in process.output


def test_a_sim_that_publishes_its_clock_may_follow_it(start, make_golfer):
    process = start(
        'sim_node',
        *parameters('/follower', use_sim_time='true', publish_clock='true', real_time_factor=10.0),
    )
    process.wait_for(READY)
    assert make_golfer('/follower').play((9.0, 0.0, 5.0))['status'] == 'at_rest'


def test_a_sim_that_can_not_keep_up_leaves_out_no_tick_and_says_so_once_a_second(
    start, make_golfer, steady
):
    process = start('sim_node', *parameters('/slow', real_time_factor=15.0, rate=10000.0))
    process.wait_for(READY)
    golfer = make_golfer('/slow')
    result = golfer.play(DRIVE, DRIVE_SPIN)
    wait_until(
        lambda: process.output.count('slower than the clock') > 1, 'it told twice that it is slow'
    )
    assert process.stop() == 0
    times = [
        float(line.split('[')[2].split(']')[0]) for line in process.lines if 'slower than' in line
    ]
    assert all(after - before > 0.99 for before, after in zip(times, times[1:]))
    other = make_golfer('/steady')
    other.reset()
    told = other.play(DRIVE, DRIVE_SPIN)
    for one in (told, result):
        del one['time'], one['shot']
    assert told == result


def test_effects_asked_for_in_vain_are_one_line_of_the_log(start):
    process = start(
        'sim_node', *parameters('/vain', effects="['gravity', 'drag', 'foliage', 'ball_ball']")
    )
    process.wait_for(READY)
    told = [line for line in process.lines if 'foliage (no leaves)' in line]
    assert len(told) == 1 and 'ball_ball (one ball)' in told[0]
    assert len([line for line in process.lines if 'left out' in line]) == 1
    process = start('sim_node', *parameters('/unknown', effects="['gravity', 'rain']"))
    assert process.wait() == 1
    assert len(process.lines) == 1 and "'rain' is unknown" in process.output
