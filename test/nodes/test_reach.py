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

"""Is the sim there? Its heartbeat says so, and `shoot` what it means for the shot."""

import json
import signal

from geometry_msgs.msg import PoseStamped
from processes import LASTING, parameters, READY, wait_until
import pytest
from std_msgs.msg import String
from std_srvs.srv import SetBool


@pytest.fixture
def sim_in(start):
    """Give a function of a namespace that starts a sim there, and waits until it is ready."""

    def make(namespace, **more):
        sim = start('sim_node', *parameters(namespace, **more))
        sim.wait_for(READY)
        return sim

    return make


def shooting(start, namespace, *more):
    """Start a `shoot` of a drive in `namespace`."""
    return start('cli.shoot', 'driver', '--timeout', '60', '--namespace', namespace, *more)


def struck(client):
    """Listen to the journal: a function that gives its strikes so far.

    The sim knows who listens before anybody strikes: a pose that arrives says so.
    """
    entries = client.listen(String, 'journal', 100)
    poses = client.listen(PoseStamped, 'ball/pose', 100)
    wait_until(lambda: poses, 'the ball told where it is')

    def strikes():
        told = (json.loads(message.data) for message in entries)
        return [entry for entry in told if entry['kind'] == 'strike']

    return strikes


def test_a_sim_tells_its_heartbeat_and_a_stopped_one_does_not(sim_in, make_client):
    sim = sim_in('/heart')
    beats = make_client('/heart').listen(String, 'heartbeat', 1)
    wait_until(lambda: len(beats) > 3, 'beats came')
    beat = json.loads(beats[-1].data)
    assert list(beat) == ['session', 'shots', 'paused']
    assert (beat['shots'], beat['paused']) == (0, False)
    sim.popen.send_signal(signal.SIGSTOP)
    try:
        wait_until(lambda: silent(beats), 'the beats ended')
    finally:
        sim.popen.send_signal(signal.SIGCONT)
    count = len(beats)
    wait_until(lambda: len(beats) > count, 'the sim was back')
    assert json.loads(beats[-1].data)['session'] == beat['session']


def silent(beats):
    """Whether no beat comes for as long as three of them take."""
    import threading

    count = len(beats)
    threading.Event().wait(1.5)
    return len(beats) == count


def test_a_sim_that_is_killed_in_flight_and_started_anew_has_lost_the_shot(
    start, sim_in, make_client
):
    sim = sim_in('/killed')
    strikes = struck(make_client('/killed'))
    shoot = shooting(start, '/killed')
    wait_until(strikes, 'the ball was struck')
    sim.stop(signal.SIGKILL)
    shoot.wait_for('shoot: the sim cannot be reached; waiting for it, 60 s at most')
    sim_in('/killed')
    assert shoot.wait() == 1
    assert shoot.lines[-1] == 'shoot: the sim was started anew: the shot is lost\n'


def test_a_sim_that_is_killed_in_flight_and_stays_away_is_given_up(start, sim_in, make_client):
    sim = sim_in('/gone')
    strikes = struck(make_client('/gone'))
    shoot = shooting(start, '/gone', '--wait', '3')
    wait_until(strikes, 'the ball was struck')
    sim.stop(signal.SIGKILL)
    assert shoot.wait() == 1
    assert shoot.lines[-1].endswith(
        'went away before the shot ended, and was not back within 3 s\n'
    )


def test_a_sim_that_was_killed_before_the_strike_is_not_struck(start, sim_in):
    sim_in('/dead').stop(signal.SIGKILL)  # its readers are matched for some more seconds
    shoot = start('cli.shoot', 'driver', '--timeout', '4', '--namespace', '/dead')
    assert shoot.wait() == 1
    assert shoot.lines == [
        'shoot: no sim answers on /dead/shot yet\n',
        'shoot: no sim answers on /dead/shot within 4 s\n',
    ]


def test_a_sim_that_was_killed_before_the_strike_and_starts_anew_is_struck(start, sim_in):
    sim_in('/late').stop(signal.SIGKILL)
    shoot = shooting(start, '/late')
    shoot.wait_for('no sim answers on /late/shot yet')
    sim_in('/late', real_time_factor=8.0)
    assert shoot.wait() == 0
    assert 'carry' in shoot.output


def test_a_sim_that_hangs_for_a_while_is_gone_and_back_and_the_shot_is_played(
    start, sim_in, make_client
):
    sim = sim_in('/hangs', real_time_factor=4.0)
    strikes = struck(make_client('/hangs'))
    shoot = shooting(start, '/hangs')
    wait_until(strikes, 'the ball was struck')
    sim.popen.send_signal(signal.SIGSTOP)
    try:
        shoot.wait_for('shoot: the sim cannot be reached')
    finally:
        sim.popen.send_signal(signal.SIGCONT)
    assert shoot.wait() == 0
    assert 'shoot: the sim plays on\n' in shoot.lines and 'carry' in shoot.output


def test_a_pause_is_told_and_waited_for(start, sim_in, make_client):
    sim_in('/pausing', real_time_factor=4.0)
    client = make_client('/pausing')
    strikes = struck(client)
    client.call(SetBool, 'golf_sim/pause', SetBool.Request(data=True))
    shoot = shooting(start, '/pausing')
    shoot.wait_for('shoot: the sim is paused; waiting until it goes on')
    assert not strikes()
    client.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False))
    assert shoot.wait() == 0
    assert len(strikes()) == 1 and 'carry' in shoot.output


def test_who_struck_and_was_not_heard_is_told_so(start, make_client):
    client = make_client('/deaf')
    beats = client.publisher(String, 'heartbeat', wait=False)
    client.node.create_timer(
        0.3, lambda: beats.publish(String(data='{"session": 1, "shots": 7, "paused": false}'))
    )
    listen_as_a_sim(client)
    shoot = shooting(start, '/deaf')
    assert shoot.wait() == 1
    assert (
        shoot.lines[-1] == 'shoot: nobody took the strike: it was lost on its way; strike again\n'
    )


FOREIGN = ('hi', '7', '[]', '{}', '{"session": 1}', '[' * 100_000)


def test_foreign_texts_on_a_sims_topics_are_nothing_to_shoot(start, sim_in, make_client):
    sim_in('/foreign')
    client = make_client('/foreign')
    strikes = struck(client)
    foreign = {
        topic: client.publisher(String, topic, LASTING, wait=False)
        for topic in ('heartbeat', 'shot/result', 'journal')
    }
    shoot = shooting(start, '/foreign')
    wait_until(strikes, 'the ball was struck')
    for publisher in foreign.values():
        for text in FOREIGN:
            publisher.publish(String(data=text))
    assert shoot.wait() == 0
    assert 'carry' in shoot.output


def listen_as_a_sim(client):
    """Match a strike's publisher and show a course, but take no strike."""
    from geometry_msgs.msg import Twist
    from processes import LATCHED
    from visualization_msgs.msg import Marker, MarkerArray

    client.node.create_subscription(Twist, 'shot', lambda message: None, 10)
    client.publisher(MarkerArray, 'course/markers', LATCHED, wait=False).publish(
        MarkerArray(markers=[Marker(ns='ground')])
    )
