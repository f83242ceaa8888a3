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

"""With as little as the rclpy of ROS 2 Humble has, the nodes do what they do with more."""

from functools import partial
import os
from pathlib import Path
from types import SimpleNamespace

from geometry_msgs.msg import PoseStamped, Vector3Stamped
from golf_sim_ros.nodes import older_rclpy
from processes import parameters, READY, wait_until
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from visualization_msgs.msg import MarkerArray

FOLDER = Path(__file__).parent / 'as_humble'
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def start_as_humble(start):
    """Start a node whose rclpy has no more than that of Humble, but what is named in `kept`."""

    def begin(*arguments, kept=''):
        path = os.pathsep.join([str(FOLDER), os.environ['PYTHONPATH']])
        process = start(*arguments, environment={'PYTHONPATH': path, 'AS_HUMBLE': kept})
        process.wait_for('as in Humble')
        return process

    return begin


def test_the_wind_follows_its_parameters(start_as_humble, client):
    start_as_humble(
        'wind_node',
        *parameters('/old_wind', speed=2.0, speed_spread=0.0, turbulence=0.0, ramp=0.0),
    )
    heard = client.listen(Vector3Stamped, '/old_wind/wind', LATCHED)
    wait_until(lambda: heard and speed(heard[-1]) == pytest.approx(2.0), 'a wind of 2 m/s')
    faster = [Parameter('speed', value=9.0).to_parameter_msg()]
    answer = client.call(
        SetParameters,
        '/old_wind/wind_generator/set_parameters',
        SetParameters.Request(parameters=faster),
    )
    assert answer.results[0].successful
    wait_until(lambda: speed(heard[-1]) == pytest.approx(9.0), 'a wind of 9 m/s')


def speed(message):
    return (message.vector.x**2 + message.vector.y**2) ** 0.5


def test_a_sim_is_told_once_of_each_that_joins(monkeypatch):
    monkeypatch.setattr(older_rclpy, 'PublisherEventCallbacks', None)
    counts, told, timers = [0, 0], [], []
    node = SimpleNamespace(create_timer=lambda period, look, clock: timers.append(look))
    publishers = [
        SimpleNamespace(get_subscription_count=partial(counts.__getitem__, i)) for i in (0, 1)
    ]
    older_rclpy.watch(node, publishers, partial(told.append, 'joined'))
    steps = ((0, 0), 0), ((0, 1), 1), ((0, 1), 1), ((1, 0), 2), ((0, 0), 2), ((1, 1), 3)
    for counts[:], sum_of_told in steps:
        timers[0]()
        assert len(told) == sum_of_told


def test_where_events_tell_who_joins_nobody_looks():
    assert older_rclpy.on_match(print) is not None
    older_rclpy.watch(None, [None], None)  # makes no timer


def test_the_sim_notices_who_joins_and_plays(start_as_humble, client, make_golfer):
    sim = start_as_humble('sim_node', *parameters('/old_sim', real_time_factor=10.0))
    sim.wait_for(READY)
    # volatile: only what is sent again
    markers = client.listen(MarkerArray, '/old_sim/course/markers')
    poses = client.listen(PoseStamped, '/old_sim/ball/pose')
    wait_until(lambda: markers and poses, 'the course and the ball are told to who joins')
    result = make_golfer('/old_sim').play((20.0, 0.0, 5.0), (0.0, -100.0, 0.0))
    assert result['status'] == 'at_rest'
    shoot = start_as_humble('cli.shoot', '7i', *parameters('/old_sim'))
    assert shoot.wait() == 0, shoot.output
