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

"""Bags of recorded play: both storages, damage, and what is not a play."""

import json
from math import pi
import sqlite3

from golf_sim_ros.recording.bag import BagError, read_bag
from golf_sim_ros.recording.journal import Journal, JournalError, opened, sealed
import pytest
import recorded_play
from recorded_play import (
    bag,
    changed,
    CHIP,
    made,
    PITCH,
    RATE,
    replaced,
    SPIN,
    START,
    TYPES,
    without,
)
from rosbags.rosbag2 import StoragePlugin, Writer
import yaml

STORAGES = ('mcap', 'sqlite3')


@pytest.fixture(scope='module')
def told():
    """Messages of a sim: a chip in a gust."""
    inputs = [(3, 'strike', ('red', CHIP, SPIN)), (50, 'wind', ((3.0, 0.0, 0.0),))]
    return recorded_play.Sim().play(inputs, 1500)


@pytest.fixture(params=STORAGES)
def storage(request):
    """Each of the storages of rosbag2."""
    return request.param


def test_both_storages_give_the_play(told, tmp_path, storage):
    (recording,) = read_bag(bag(tmp_path / 'bag', told, storage))
    assert recording.namespace == '' and recording.start == START
    assert [entry['kind'] for entry in recording.journal] == ['config', 'strike', 'wind', 'rest']
    assert recording.config['course']['name'] == 'Golf without friends'
    (strike,) = recording.strikes
    assert strike[1:] == ('red', CHIP, SPIN)
    (result,) = recording.results
    assert result['shot'] == 1 and result['bounces'] == len(recording.collisions) > 2
    assert recording.winds.tolist() == [[3.0, 0.0, 0.0]]
    track = recording.tracks['red']
    assert list(recording.tracks) == ['red', 'blue']
    assert (
        track.positions.shape
        == track.velocities.shape
        == track.spins.shape
        == (len(track.times), 3)
    )
    assert track.orientations.shape == (len(track.times), 4)
    first = track.positions[track.velocities[:, 2] > 0][0]
    assert first[2] > 0.02
    ticks = recording.seconds(track.times) * RATE
    assert ticks == pytest.approx([round(tick) for tick in ticks], abs=1e-3)


def test_what_is_told_twice_counts_once_and_the_journal_is_in_order(told, tmp_path):
    later = [
        (topic, kind, received + 10**10, message) for topic, kind, received, message in told[::-1]
    ]
    (once,) = read_bag(bag(tmp_path / 'once', told))
    (again,) = read_bag(bag(tmp_path / 'twice', told + later))
    assert again.journal == once.journal
    assert again.results == once.results and again.collisions == once.collisions


def test_each_sim_and_each_of_its_starts_is_a_recording_of_its_own(told, tmp_path):
    restarted = recorded_play.Sim(start=START + 10**12)
    other = recorded_play.Sim('/links/east')
    for sim in (restarted, other):
        sim.play([(3, 'strike', ('blue', CHIP, SPIN))], 100)
    plays = read_bag(bag(tmp_path / 'bag', [*told, *other.told, *restarted.told]))
    assert sorted((play.namespace, play.start) for play in plays) == [
        ('', START),
        ('', START + 10**12),
        ('/links/east', START),
    ]
    assert all(
        play.journal[1]['ball']
        == ('red' if (play.namespace, play.start) == ('', START) else 'blue')
        for play in plays
    )


def test_a_start_at_the_same_time_is_another_one(told, tmp_path):
    again = recorded_play.Sim(session=7)
    again.play([(3, 'strike', ('blue', CHIP, SPIN))], 100)
    later = [
        (topic, kind, received + 10**12, message) for topic, kind, received, message in again.told
    ]
    plays = read_bag(bag(tmp_path / 'bag', [*told, *later]))
    assert [(play.start, play.config['session']) for play in plays] == [(START, 0), (START, 7)]
    assert [play.journal[1]['ball'] for play in plays] == ['red', 'blue']


def test_journals_and_results_of_others_beside_ours_do_no_harm(told, tmp_path):
    (whole,) = read_bag(bag(tmp_path / 'bag', told))
    diary = made('std_msgs/msg/String', data='dear diary')
    more = [
        *told,
        ('/robot/journal', 'std_msgs/msg/String', START, diary),
        ('/gun/shot/result', 'std_msgs/msg/String', START, diary),
    ]
    (found,) = read_bag(bag(tmp_path / 'more', more))
    assert same(found, whole)


def test_a_play_without_journal_can_be_read(told, tmp_path):
    (recording,) = read_bag(bag(tmp_path / 'bag', without(told, 'journal')))
    assert recording.journal == () and recording.config is None
    assert recording.start == recording.tracks['red'].times[0]


def test_a_byte_changed_in_a_strike_is_noticed(told, tmp_path):
    changed_one = changed(told, replaced('"velocity": [9.0', '"velocity": [9.1'), 'journal')
    with pytest.raises(BagError, match='entry 1 strike was changed'):
        read_bag(bag(tmp_path / 'bag', changed_one))


def test_a_byte_changed_in_the_file_itself_is_noticed(told, tmp_path, storage):
    path = bag(tmp_path / 'bag', told, storage)
    (file,) = (file for file in path.iterdir() if file.suffix != '.yaml')
    content = file.read_bytes()
    strike = b'"ball": "red", "velocity": [9.0'
    assert content.count(strike) == 1
    file.write_bytes(content.replace(strike, strike.replace(b'9.0', b'9.4')))
    with pytest.raises(BagError, match='entry 1 strike was changed'):
        read_bag(path)


@pytest.mark.parametrize('part', [0.0, 0.02, 0.5, 0.9, 0.999])
def test_a_truncated_bag_is_refused_in_one_line(told, tmp_path, storage, part):
    path = bag(tmp_path / 'bag', told, storage)
    (file,) = (file for file in path.iterdir() if file.suffix != '.yaml')
    content = file.read_bytes()
    file.write_bytes(content[: int(part * len(content))])
    with pytest.raises(BagError) as refusal:
        read_bag(path)
    assert '\n' not in str(refusal.value) and str(path) in str(refusal.value)


def test_no_bag_and_nothing_are_refused(tmp_path):
    (tmp_path / 'file').write_text('no bag')
    (tmp_path / 'folder').mkdir()
    for name, said in (
        ('file', 'is no bag'),
        ('nothing', 'no such bag'),
        ('folder', 'neither a metadata'),
    ):
        with pytest.raises(BagError, match=f'{name}: .*{said}'):
            read_bag(tmp_path / name)


def same(recording, other):
    """Whether two recordings tell the same."""
    return repr(recording._replace(tracks={})) == repr(other._replace(tracks={})) and all(
        repr(recording.tracks[ball]) == repr(other.tracks[ball]) for ball in ('red', 'blue')
    )


def test_a_bag_without_metadata_says_what_to_do_and_its_file_alone_will_do(
    told, tmp_path, storage
):
    path = bag(tmp_path / 'bag', told, storage)
    (whole,) = read_bag(path)
    (file,) = (file for file in path.iterdir() if file.suffix != '.yaml')
    (path / 'metadata.yaml').unlink()
    with pytest.raises(BagError) as refusal:
        read_bag(path)
    assert str(refusal.value) == (
        f'{path}: has no metadata.yaml: `ros2 bag reindex {path}` makes one, '
        f'or name its file {file}'
    )
    (alone,) = read_bag(file)
    assert same(alone, whole)


@pytest.mark.parametrize(
    'content', ['', '- 1', 'a: [', 'rosbag2_bagfile_information: {version: 9}']
)
def test_metadata_that_cannot_be_used_says_what_to_do(told, tmp_path, content):
    path = bag(tmp_path / 'bag', told)
    (path / 'metadata.yaml').write_text(content)
    with pytest.raises(
        BagError, match='its metadata.yaml cannot be used .*: `ros2 bag reindex .*` makes'
    ):
        read_bag(path)


def test_a_bag_whose_metadata_tells_of_other_qos_and_counts_is_sound(told, tmp_path, storage):
    path = bag(tmp_path / 'bag', told, storage)
    (whole,) = read_bag(path)
    about = yaml.safe_load((path / 'metadata.yaml').read_text())
    for topic in about['rosbag2_bagfile_information']['topics_with_message_count']:
        topic['topic_metadata']['offered_qos_profiles'] = [
            {
                'history': 'keep_last',
                'depth': 7,
                'reliability': 'best_effort',
                'durability': 'volatile',
                'deadline': {'sec': 1, 'nsec': 0},
                'lifespan': {'sec': 1, 'nsec': 0},
                'liveliness': 'automatic',
                'liveliness_lease_duration': {'sec': 1, 'nsec': 0},
                'avoid_ros_namespace_conventions': False,
            }
        ]
        topic['message_count'] += 3
    (path / 'metadata.yaml').write_text(yaml.safe_dump(about))
    (found,) = read_bag(path)
    assert same(found, whole)


@pytest.mark.parametrize(
    'kind, text, form',
    [
        (
            'example_interfaces/srv/AddTwoInts_Event',
            'service_msgs/msg/ServiceEventInfo i\n<<<not parsed',
            'cdr',
        ),
        ('somebody/msg/Else', '', 'cdr'),
        ('somebody/msg/Else', 'int32 x', 'json'),
        ('std_msgs/msg/String', 'string data', 'cdr'),
        ('geometry_msgs/msg/PoseStamped', 'pose', 'cdr'),
    ],
)
def test_what_others_said_never_makes_a_bag_unreadable(told, tmp_path, storage, kind, text, form):
    (whole,) = read_bag(bag(tmp_path / 'bag', told, storage))
    path = tmp_path / 'more'
    with Writer(path, version=9, storage_plugin=StoragePlugin[storage.upper()]) as writer:
        other = writer.add_connection(
            '/other/thing/pose', kind, msgdef=text, rihs01='RIHS01_0', serialization_format=form
        )
        topics = {
            topic: writer.add_connection(topic, kind, typestore=TYPES)
            for topic, kind in dict(one[:2] for one in told).items()
        }
        for topic, kind, received, message in told:
            writer.write(topics[topic], received, TYPES.serialize_cdr(message, kind))
            writer.write(other, received, b'\xff\xff')
    (found,) = read_bag(path)
    assert same(found, whole)
    if storage == 'sqlite3':  # as rosbag2 writes where it does not find a definition
        (file,) = path.glob('*.db3')
        with sqlite3.connect(file) as database:
            database.execute("UPDATE message_definitions SET encoding = 'unknown'")
        (found,) = read_bag(path)
        assert same(found, whole)


def test_schemas_of_other_kinds_do_not_matter(told, tmp_path):
    path = bag(tmp_path / 'bag', told)
    (whole,) = read_bag(path)
    (file,) = path.glob('*.mcap')
    content = file.read_bytes()
    assert content.count(b'ros2msg') > 5
    file.write_bytes(content.replace(b'ros2msg', b'flatbuf'))
    (found,) = read_bag(path)
    assert same(found, whole)


def test_a_file_of_a_bag_that_is_missing_is_named(told, tmp_path, storage):
    path = bag(tmp_path / 'bag', told, storage)
    (file,) = (file for file in path.iterdir() if file.suffix != '.yaml')
    file.unlink()
    with pytest.raises(BagError, match=f'is damaged: its file {file.name} is missing'):
        read_bag(path)


def test_what_is_cut_off_is_told(told, tmp_path):
    path = bag(tmp_path / 'bag', told)
    (file,) = path.glob('*.mcap')
    file.write_bytes(file.read_bytes()[:-100])
    with pytest.raises(
        BagError, match='its end is missing, as of a recording or copy that was cut off'
    ):
        read_bag(path)


@pytest.mark.parametrize(
    'topic, old, new, missing',
    [
        ('shot/result', '"shot"', '"shoT"', 'shot'),
        ('shot/result', '"ball": "red"', '"ball": [red]', 'JSON'),
        ('shot/result', '"status": "at_rest"', '"status": [3]', 'status'),
        ('collisions', '"kind"', '"kine"', 'kind'),
    ],
)
def test_a_result_or_collision_that_is_none_is_refused(told, tmp_path, topic, old, new, missing):
    with pytest.raises(BagError, match=f'is damaged: .*{missing}'):
        read_bag(bag(tmp_path / 'bag', changed(told, replaced(old, new), topic)))


def test_a_foreign_bag_is_refused(tmp_path, storage):
    told = [('/chatter', 'std_msgs/msg/String', 1, made('std_msgs/msg/String', data='hello'))]
    with pytest.raises(BagError, match='no play'):
        read_bag(bag(tmp_path / 'bag', told, storage))


def test_a_journal_of_somebody_else_is_refused(tmp_path):
    told = [('/journal', 'std_msgs/msg/String', 1, made('std_msgs/msg/String', data='dear diary'))]
    with pytest.raises(BagError, match='dear diary'):
        read_bag(bag(tmp_path / 'bag', told))


def test_an_entry_comes_back_to_the_bit_and_what_is_not_a_number_as_text():
    lines = []
    journal = Journal(lines.append)
    values = [0.1 + 0.2, pi * 1e-300, -0.0, 5e-324, 1.7976931348623157e308]
    journal.note('wind', 7, wind=values)
    journal.note('wind', 8, wind=values)
    assert [opened(line)['entry'] for line in lines] == [0, 1]
    entry = opened(lines[0])
    assert list(entry)[:3] == ['entry', 'kind', 'tick'] and entry['tick'] == 7
    assert [value.hex() for value in entry['wind']] == [value.hex() for value in values]
    assert json.loads(lines[0])['wind'] == values
    journal.note('wind', 9, wind=[float('nan'), -float('inf')])  # JSON has no such numbers
    assert json.loads(lines[2])['wind'] == ['nan', '-inf']


def test_any_changed_byte_of_an_entry_is_noticed():
    line = sealed({'entry': 3, 'kind': 'strike', 'tick': 5, 'velocity': list(PITCH)})
    for i, letter in enumerate(line):
        changed_line = list(line)
        changed_line[i] = chr(ord(letter) ^ 1)
        with pytest.raises(JournalError):
            opened(''.join(changed_line))
