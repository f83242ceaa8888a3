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

"""The wind generator over DDS, on simulated time and on the wall clock."""

from math import hypot
import re
import signal

from geometry_msgs.msg import Vector3Stamped
from golf_sim_ros.wind.gusts import Gusts, GustSettings
from processes import parameters, wait_until
import pytest
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosgraph_msgs.msg import Clock

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class SimulatedTime:
    """Turns /clock and hears the wind that a node in `namespace` answers with."""

    def __init__(self, client, namespace):
        self.clock = client.publisher(Clock, '/clock')
        self.heard = client.listen(Vector3Stamped, f'{namespace}/wind', LATCHED)

    def wind_at(self, seconds):
        """Set the time, as often as it takes to arrive: the wind (x, y, z) published at it."""
        now = Time(seconds=seconds)

        def answer():
            self.clock.publish(Clock(clock=now.to_msg()))
            stamps = [Time.from_msg(message.header.stamp) for message in self.heard[-1:]]
            return stamps and stamps[0].nanoseconds == now.nanoseconds

        wait_until(answer, f'a wind stamped {seconds} s')
        vector = self.heard[-1].vector
        return vector.x, vector.y, vector.z

    def start_again(self):
        """Let time run from 0 until the node has noticed; its timer waits for a period to pass."""
        ticks = iter(range(1000))
        self.heard.clear()

        def noticed():
            self.clock.publish(Clock(clock=Time(nanoseconds=next(ticks) * 1000000).to_msg()))
            return self.heard

        wait_until(noticed, 'a wind after time started again')


@pytest.fixture
def simulated_time(start, client):
    """Give a function of a namespace and a seed that starts a wind node on /clock."""

    def begin(namespace, **values):
        start('wind_node', *parameters(namespace, use_sim_time='true', **values))
        return SimulatedTime(client, namespace)

    return begin


def test_a_new_gust_comes_every_ten_seconds_of_ros_time_and_blows_steadily_between(simulated_time):
    time = simulated_time('/gusts', seed=7)
    gusts = []
    for number in range(5):
        steady = {time.wind_at(10.0 * number + since) for since in (1.5, 4.0, 7.0, 9.9)}
        assert len(steady) == 1
        gusts += steady
    assert len(set(gusts)) == 5
    assert all(1.0 <= hypot(x, y) <= 7.0 and z == 0.0 for x, y, z in gusts)


def test_a_gust_is_eased_in_over_a_second(simulated_time):
    time = simulated_time('/easing', seed=7)
    old, halfway, new = (time.wind_at(seconds) for seconds in (9.9, 10.5, 11.0))
    assert old != new
    assert halfway == pytest.approx([(a + b) / 2.0 for a, b in zip(old, new)], abs=1e-12)


def test_the_wind_is_published_ten_times_a_second_of_ros_time(simulated_time):
    time = simulated_time('/rate', seed=7)
    time.wind_at(1.0)
    time.heard.clear()
    for tick in range(1020, 2020, 20):
        time.clock.publish(Clock(clock=Time(nanoseconds=tick * 1000000).to_msg()))
        if tick % 100 == 0:
            time.wind_at(tick / 1000)
    stamps = [Time.from_msg(message.header.stamp).nanoseconds for message in time.heard]
    assert stamps == list(range(1100000000, 2000000001, 100000000))


def test_the_same_seed_gives_the_same_gusts_to_a_node_that_starts_later(simulated_time):
    first, other = simulated_time('/first', seed=3), simulated_time('/other', seed=4)
    first.wind_at(5.0)
    later = simulated_time('/later', seed=3)
    winds = [
        [node.wind_at(seconds) for node in (first, later, other)] for seconds in (15.0, 25.0, 35.0)
    ]
    of_first, of_later, of_other = zip(*winds)
    assert of_later == of_first
    assert len({*of_first, *of_other}) == 6


def test_a_clock_that_jumps_back_meets_the_same_gusts_again(simulated_time):
    time = simulated_time('/again', seed=3)
    winds = [time.wind_at(seconds) for seconds in (5.0, 15.0, 25.0)]
    time.start_again()
    assert [time.wind_at(seconds) for seconds in (5.0, 15.0, 25.0)] == winds


def test_every_parameter_of_the_gusts_does_what_the_process_says(simulated_time):
    values = {
        'speed': 12.0,
        'speed_spread': 5.0,
        'direction': 1.0,
        'direction_spread': 0.25,
        'interval': 3.0,
        'ramp': 2.0,
        'turbulence': 0.3,
    }
    time = simulated_time('/all', seed=5, frame_id='links', **values)
    gusts = Gusts(GustSettings(**values), 5)
    for seconds in (0.5, 4.0, 5.5, 300.25):
        assert time.wind_at(seconds) == gusts.wind(seconds)
    assert time.heard[-1].header.frame_id == 'links'


@pytest.fixture(scope='module')
def wind_node(start):
    """Start a wind node on the wall clock, in the namespace /wall."""
    return start('wind_node', *parameters('/wall'))


@pytest.mark.parametrize(
    'qos',
    [
        10,
        LATCHED,
        qos_profile_sensor_data,
        QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT),
    ],
)
def test_subscribers_of_every_quality_of_service_hear_the_wind(wind_node, client, qos):
    heard = client.listen(Vector3Stamped, '/wall/wind', qos)
    wait_until(lambda: len(heard) >= 3, 'three winds came')
    assert {message.header.frame_id for message in heard} == {'course'}
    assert hypot(heard[-1].vector.x, heard[-1].vector.y) <= 7.0


def test_the_wind_is_offered_reliable_and_latched(wind_node, client):
    def offered():
        found = client.node.get_publishers_info_by_topic('/wall/wind')
        return [info for info in found if info.node_name == 'wind_generator']

    infos = wait_until(offered, 'the wind is found')
    assert infos[0].qos_profile.reliability == ReliabilityPolicy.RELIABLE
    assert infos[0].qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL


def test_every_parameter_is_described_and_every_number_has_a_range(wind_node, client):
    service = '/wall/wind_generator/'
    names = client.call(
        ListParameters, service + 'list_parameters', ListParameters.Request()
    ).result.names
    own = {
        'speed',
        'speed_spread',
        'direction',
        'direction_spread',
        'interval',
        'ramp',
        'turbulence',
        'seed',
        'publish_rate',
        'frame_id',
    }
    assert own <= set(names)
    request = DescribeParameters.Request(names=sorted(own))
    described = client.call(
        DescribeParameters, service + 'describe_parameters', request
    ).descriptors
    assert all(one.description for one in described)
    assert {one.name for one in described if one.read_only} == {'seed', 'publish_rate'}
    without_range = {
        one.name for one in described if not (one.floating_point_range or one.integer_range)
    }
    assert without_range == {'frame_id'}


def set_parameter(client, name, value):
    """Ask the node in /wall for a new value: its answer."""
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    return client.call(SetParameters, '/wall/wind_generator/set_parameters', request).results[0]


@pytest.mark.parametrize(
    'name, value',
    [
        ('speed', -1.0),
        ('speed', float('nan')),
        ('speed', float('inf')),
        ('speed', 'strong'),
        ('speed', 1e9),
        ('speed_spread', -0.1),
        ('direction', 10.0),
        ('direction_spread', -1.0),
        ('interval', 0.0),
        ('ramp', -1.0),
        ('turbulence', 2.0),
        ('seed', 5),
        ('publish_rate', 20.0),
        ('frame_id', 1.0),
    ],
)
def test_a_bad_or_read_only_value_is_refused_with_a_reason_and_nothing_changes(
    wind_node, client, name, value
):
    request = GetParameters.Request(names=[name])
    service = '/wall/wind_generator/get_parameters'
    before = client.call(GetParameters, service, request).values
    assert before[0].type != ParameterType.PARAMETER_NOT_SET
    answer = set_parameter(client, name, value)
    assert not answer.successful and answer.reason
    assert client.call(GetParameters, service, request).values == before


def test_new_settings_and_a_new_frame_apply_while_the_node_runs(wind_node, client):
    heard = client.listen(Vector3Stamped, '/wall/wind')
    steady = {'speed': 20.0, 'speed_spread': 0.0, 'direction_spread': 0.0, 'frame_id': 'links'}
    for name, value in steady.items():
        assert set_parameter(client, name, value).successful

    def arrived():
        last = heard[-1] if heard else Vector3Stamped()
        return last.header.frame_id == 'links' and (last.vector.x, last.vector.y) == (20.0, 0.0)

    wait_until(arrived, 'a wind of 20 m/s along x in the frame links')


def test_seed_minus_one_is_fresh_each_start_and_logged(start):
    seeds = {
        re.search(
            r'seed (\d+)', start('wind_node', *parameters('/fresh', seed=-1)).wait_for('seed')
        )[1]
        for _ in range(2)
    }
    assert len(seeds) == 2


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_node_with_exit_code_zero(start, number):
    process = start('wind_node', *parameters('/ending'))
    process.wait_for('seed')
    assert process.stop(number) == 0
    assert 'Traceback' not in process.output


@pytest.mark.parametrize(
    'name, value',
    [
        ('speed', '-1.0'),
        ('interval', '0.0'),
        ('seed', '-2'),
        ('publish_rate', '0.0'),
        ('speed', 'strong'),
    ],
)
def test_a_bad_parameter_at_the_start_ends_the_node_with_one_line_and_exit_code_one(
    start, name, value
):
    process = start('wind_node', *parameters('/wrong', **{name: value}))
    assert process.wait() == 1
    assert len(process.lines) == 1 and name in process.output


def test_the_shipped_parameter_file_holds_the_defaults(start, client):
    service = 'wind_generator/get_parameters'
    names = [*GustSettings._fields, 'seed', 'publish_rate', 'frame_id']
    request = GetParameters.Request(names=names)
    start('wind_node', '--ros-args', '-r', '__ns:=/filed', '--params-file', 'config/wind.yaml')
    start('wind_node', *parameters('/bare'))
    filed, bare = (
        client.call(GetParameters, f'{space}/{service}', request).values
        for space in ('/filed', '/bare')
    )
    assert [one.type for one in filed] == [one.type for one in bare]
    assert [one.double_value for one in filed] == pytest.approx(
        [one.double_value for one in bare], abs=1e-5
    )
    assert filed[-3:] == bare[-3:]
