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

"""The journal over DDS: what is recorded of a sim runs again to the bit."""

import json
import signal

from geometry_msgs.msg import PointStamped, Vector3Stamped
from golf_sim_ros.cli.resimulate import main
from golf_sim_ros.recording.bag import read_bag
from golf_sim_ros.recording.journal import opened
from processes import LASTING, parameters, place, READY, wait_until
import pytest
from std_msgs.msg import String
from std_srvs.srv import SetBool

pytest.importorskip('rosbags')

SHOTS = (
    ((12.0, 1.0, 9.0), (0.0, -150.0, 20.0)),
    ((10.0, -2.0, 8.0), (5.0, 100.0, 0.0)),
    ((3.0, 0.5, 0.0), (0.0, 0.0, 0.0)),
)
TOPICS = {
    '/recorded/' + name
    for name in (
        'shot',
        'wind',
        'collisions',
        'shot/result',
        'journal',
        'course/markers',
        'play/markers',
        'ball/shot',
        'ball/place',
        'ball/pose',
        'ball/twist',
        'ball/contact',
    )
} | {'/diagnostics'}


HASTY = {'real_time_factor': 0.0, 'publish_clock': 'true'}
IN_A_FIELD = {'course': 'links', 'turbulence': 0.145, 'turbulence_seed': 3}


def blow(winds, wind):
    """Send a wind."""
    message = Vector3Stamped()
    message.vector.x, message.vector.y, message.vector.z = wind
    winds.publish(message)


def play_in_gusts(golfer, poses):
    """Play `SHOTS`, with a new wind whenever `poses` have come, and a pause in the first."""
    winds = golfer.publisher(Vector3Stamped, 'wind')
    pauses = [True, False]
    for velocity, spin in SHOTS:
        golfer.strike(velocity, spin)
        while not golfer.results_of(velocity, spin):
            seen = len(golfer.poses)
            blow(winds, (0.01 * seen, -3.0 + 0.1 * (seen % 40), 0.0))
            wait_until(
                lambda: (
                    len(golfer.poses) >= seen + poses
                    or golfer.results_of(velocity, spin)
                    or len(pauses) == 1
                ),
                'the ball moved or stopped',
            )
            if pauses:
                golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=pauses.pop(0)))


@pytest.mark.parametrize(
    'storage, more',
    [('mcap', IN_A_FIELD), ('sqlite3', HASTY)],
    ids=['mcap, wind field and turbulence', 'sqlite3, hasty'],
)
def test_three_shots_in_gusts_are_recorded_and_run_again_to_the_bit(
    start, make_golfer, tmp_path, capsys, storage, more
):
    hasty = more is HASTY
    path = tmp_path / 'bag'
    recorder = start(
        'cli.record_play', '-o', str(path), '--namespace', '/recorded', '--storage', storage
    )
    sim = start('sim_node', *parameters('/recorded', **more))
    sim.wait_for(READY)
    recorder.wait_for('recording ball')
    golfer = make_golfer('/recorded')
    play_in_gusts(golfer, 1 if hasty else 12)
    golfer.heartbeat()
    assert recorder.stop(signal.SIGTERM if storage == 'mcap' else signal.SIGINT) == 0
    assert sim.stop() == 0
    (recording,) = read_bag(path)
    gusts = [entry for entry in recording.journal if entry['kind'] == 'wind']
    assert len(gusts) > (0 if hasty else 3)
    assert [entry['kind'] for entry in recording.journal].count('strike') == len(SHOTS)
    assert topics(path) == TOPICS | ({'/clock'} if hasty else set())
    assert len(recording.tracks['ball'].times) > 50 and len(recording.collisions) > 2
    assert main([str(path)]) == 0
    assert f'{len(SHOTS)} of {len(SHOTS)} identical' in capsys.readouterr().out


def topics(path):
    """Names of the topics in a bag; their publishers' qualities of service are kept."""
    from rosbags.highlevel import AnyReader

    with AnyReader([path]) as reader:
        durabilities = {
            connection.topic: [
                profile.durability.name for profile in connection.ext.offered_qos_profiles
            ]
            for connection in reader.connections
        }
        assert durabilities['/recorded/journal'] == ['TRANSIENT_LOCAL']
        assert durabilities['/recorded/ball/pose'] == ['VOLATILE']
        assert all(
            connection.msgcount
            for connection in reader.connections
            if connection.topic.startswith('/recorded/ball/p') and 'place' not in connection.topic
        )
        return set(durabilities)


@pytest.fixture(scope='module')
def sim(start):
    """Start a sim whose journal is read."""
    process = start('sim_node', *parameters('/journal', real_time_factor=0.0))
    process.wait_for(READY)
    return process


def test_who_comes_late_gets_the_last_of_the_journal_and_the_configuration(
    sim, make_golfer, make_client
):
    golfer = make_golfer('/journal')
    golfer.play((8.0, 0.3, 5.0))
    golfer.heartbeat()
    places = golfer.publisher(PointStamped, 'ball/place')
    for i in range(120):  # more than the journal's publisher keeps
        message = PointStamped()
        message.point.x = 1.0 + 0.01 * i
        places.publish(message)
        wait_until(
            lambda: abs(place(golfer.poses[-1])[0] - message.point.x) < 1e-9, 'the ball was placed'
        )
    golfer.reset()
    client = make_client('/journal')
    late, beats = client.listen(String, 'journal', LASTING), client.listen(String, 'heartbeat')
    wait_until(
        lambda: '"kind": "config"' in ''.join(message.data for message in late), 'the journal came'
    )
    config, *entries = sorted(
        (opened(message.data) for message in late), key=lambda entry: entry['entry']
    )
    wait_until(lambda: beats, 'the heart beat')
    assert config['session'] == json.loads(beats[0].data)['session']
    assert config['parameters']['balls'] == ['ball'] and len(config['course']['digest']) == 64
    assert {entry['kind'] for entry in entries[:-1]} == {'place'} and entries[-1][
        'kind'
    ] == 'reset'
    assert [entry['entry'] for entry in entries] == list(range(entries[0]['entry'], 124))
    assert 99 <= len(entries) <= 100 and entries[-2]['position'] == [1.0 + 0.01 * 119, 0.0]


def test_a_recorder_that_cannot_write_says_so_in_one_line(start, tmp_path):
    process = start('cli.record_play', '-o', str(tmp_path))
    assert process.wait() == 1
    assert process.output.startswith('record_play: ') and process.output.count('\n') == 1


@pytest.mark.parametrize('arguments', ['-r foo', '-p foo', '--foo'])
def test_wrong_arguments_for_ros_end_a_recorder_with_two_and_no_traceback(
    start, tmp_path, arguments
):
    bag = tmp_path / 'bag'
    process = start('cli.record_play', '-o', str(bag), '--ros-args', *arguments.split())
    assert process.wait() == 2
    assert process.lines[-1].startswith('record_play: arguments for ROS: ')
    assert 'Traceback' not in process.output and not bag.exists()


@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
@pytest.mark.parametrize('argument', ['--namespace', '--balls'])
def test_a_recorder_that_cannot_begin_leaves_no_bag(start, tmp_path, argument, storage):
    bag = tmp_path / 'bag'
    process = start('cli.record_play', '-o', str(bag), '--storage', storage, argument, 'a b')
    assert process.wait() == 1
    assert process.lines[-1].startswith('record_play: Invalid ')
    assert process.output.count('record_play: ') == 1 and not bag.exists()


def test_a_recorder_without_a_sim_leaves_a_complete_bag(start, tmp_path):
    arguments = ('-o', str(tmp_path / 'bag'), '--namespace', '/nowhere', '--balls', 'red')
    process = start('cli.record_play', *arguments)
    process.wait_for('recording red of /nowhere')
    assert process.stop() == 0
    assert topics_without_messages(tmp_path / 'bag') >= {'/nowhere/red/pose', '/nowhere/journal'}


def topics_without_messages(path):
    """Names of the empty topics in a bag."""
    from rosbags.highlevel import AnyReader

    with AnyReader([path]) as reader:
        return {connection.topic for connection in reader.connections if not connection.msgcount}
