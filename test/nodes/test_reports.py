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

"""What a sim logs of things that go wrong around it: once, short, and only if they do."""

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist, Vector3Stamped
from golf_sim_ros.course import load_course
from golf_sim_ros.nodes.diagnostics import Diagnostics
from observed_game import ObservedGame
from processes import parameters, READY, wait_until
import pytest
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_srvs.srv import SetBool


def diagnosed(diagnostics, name, key):
    """Find what the last diagnostics of the node `name` say of `key`; '' before they came."""
    found = [
        status for message in list(diagnostics) for status in message.status if status.name == name
    ]
    return (
        next((value.value for value in found[-1].values if value.key == key), '') if found else ''
    )


def test_no_warning_follows_a_pause(monkeypatch):
    observed = ObservedGame(monkeypatch, load_course('golf_without_friends'))
    clock = observed.clock
    monkeypatch.setattr('golf_sim_ros.nodes.diagnostics.monotonic', clock)
    observed.game.diagnostics = Diagnostics()
    observed.send('ball', (50.0, 0.0, 20.0))
    observed.step(50)
    observed.game.diagnose()
    observed.step(10)
    observed.game.paused = True
    observed.step(20)
    observed.game.paused = False
    observed.step(20)
    observed.game.diagnose()  # of a second of which 0.4 s stood still
    assert not observed.log.warning.called
    observed.step(10)
    clock.now += 5.0  # now it is slow in earnest
    observed.step()
    observed.game.diagnose()
    assert observed.log.warning.called


@pytest.fixture(scope='module')
def sim(start):
    process = start('sim_node', *parameters('/reports'))
    process.wait_for(READY)
    return process


def test_a_long_frame_is_cut_in_the_log(sim, make_client):
    client = make_client('/reports')
    winds = client.publisher(Vector3Stamped, 'wind')
    message = Vector3Stamped()
    message.header.frame_id = 'x' * 100000
    client.node.create_timer(0.05, lambda: winds.publish(message))
    line = sim.wait_for('wind refused')
    assert f"frame '{'x' * 80}...' is not 'course'" in line and len(line) < 300


def test_a_best_effort_publisher_of_shots_gets_one_warning_that_names_the_mismatch(
    sim, make_client
):
    client = make_client('/reports')
    unheard = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
    client.node.create_publisher(Twist, 'shot', unheard)
    sim.wait_for('a publisher of shot is not heard: its RELIABILITY does not match')
    client.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False))
    assert len([line for line in sim.lines if 'is not heard' in line]) == 1


def test_strikes_that_were_lost_unseen_are_counted_in_the_diagnostics(sim, make_client):
    client = make_client('/reports')
    diagnostics = client.listen(DiagnosticArray, '/diagnostics')
    wait_until(
        lambda: diagnosed(diagnostics, '/reports/golf_sim: play', 'strikes lost unseen').isdigit(),
        'the diagnostics tell of lost strikes',
    )


def test_security_without_a_keystore_is_one_line(start):
    asked = {
        'ROS_SECURITY_ENABLE': 'true',
        'ROS_SECURITY_STRATEGY': 'Enforce',
        'ROS_SECURITY_KEYSTORE': '',
    }
    for module in ('sim_node', 'wind_node', 'cli.shoot', 'cli.record_play'):
        node = start(module, *(['driver'] if module == 'cli.shoot' else []), environment=asked)
        assert node.wait() == 1
        (line,) = node.lines
        assert "ROS_SECURITY_KEYSTORE '' is no keystore" in line
