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

"""Recorded play runs again to the bit, and what does not is found."""

import json
from math import nextafter

from golf_sim_ros.cli.resimulate import main
from golf_sim_ros.course import shipped_courses
from golf_sim_ros.recording.journal import opened, sealed
import pytest
from recorded_play import bag, changed, LAST, made, replaced, Sim, STRIKES, without


@pytest.fixture(scope='module')
def told():
    """Messages of a sim: two balls in gusts, struck in flight, placed, reset."""
    told = Sim().play()
    entries = [opened(one[3].data) for one in told if one[0] == '/journal']
    assert sum(entry['kind'] == 'strike' for entry in entries) == STRIKES
    assert sum(entry['kind'] == 'rest' for entry in entries) == STRIKES
    assert {entry['kind'] for entry in entries} >= {'wind', 'place', 'reset', 'accuracy'}
    return told


def lines(captured):
    """Find what was printed of shots."""
    return [line for line in captured.out.splitlines() if line.startswith('shot')]


@pytest.mark.parametrize('storage', ['mcap', 'sqlite3'])
def test_all_shots_are_identical(told, tmp_path, capsys, storage):
    assert main([str(bag(tmp_path / 'bag', told, storage))]) == 0
    captured = capsys.readouterr()
    assert captured.out.endswith(f'{STRIKES} of {STRIKES} identical\n') and not captured.err
    assert lines(captured) == [
        f'shot {number} ({ball}): identical'
        for number, ball in ((1, 'red'), (2, 'blue'), (4, 'blue'), (5, 'red'), (6, 'red'))
    ]


def ulp(message, field):
    """Change a number of a message by as little as can be."""
    *path, last = field.split('.')
    for name in path:
        message = getattr(message, name)
    setattr(message, last, nextafter(getattr(message, last), 1e9))


def flying(message):
    """Whether a pose or twist is that of a ball in mid-flight."""
    if hasattr(message, 'pose'):
        return message.pose.position.z > 1.0
    return message.twist.linear.z < -1.0


@pytest.mark.parametrize(
    'topic, number, field',
    [
        ('red/pose', 'pose.position.z', 'position'),
        ('red/twist', 'twist.linear.x', 'velocity'),
        ('red/twist', 'twist.angular.z', 'spin'),
    ],
)
def test_a_bit_of_a_pose_or_twist_is_found_at_its_tick(
    told, tmp_path, capsys, topic, number, field
):
    def change(message):
        if flying(message):
            ulp(message, number)
            stamps.append(message.header.stamp)
            return True
        return False

    stamps = []
    assert main([str(bag(tmp_path / 'bag', changed(told, change, topic)))]) == 1
    first, *others = lines(capsys.readouterr())
    start = told_start(told)
    tick = round((stamps[0].sec * 10**9 + stamps[0].nanosec - start) * 250e-9)
    assert (
        first.startswith(f'shot 1 (red): differs first at tick {tick}, ')
        and f'in {field}: ' in first
    )
    assert all(line.endswith('identical') for line in others)


def told_start(told):
    return opened(told[0][3].data)['start']


@pytest.mark.parametrize(
    'topic, old_and_new, field',
    [
        ('collisions', ('"spin_after": [', '"spin_after": [1e-9, '), 'spin_after of a collision'),
        ('shot/result', ('"apex": ', '"apex": 1'), 'apex of the result'),
        ('shot/result', ('"lie": "', '"lie": "x'), 'lie of the result'),
    ],
)
def test_a_changed_collision_or_result_is_found(told, tmp_path, capsys, topic, old_and_new, field):
    path = bag(tmp_path / 'bag', changed(told, replaced(*old_and_new), topic))
    assert main([str(path)]) == 1
    captured = capsys.readouterr()
    assert f'in {field}: ' in captured.out
    assert captured.out.endswith(f'{STRIKES - 1} of {STRIKES} identical\n')


def reseal(kind, change):
    """Change an entry of the journal so that its checksum does not tell."""

    def edit(message):
        entry = {key: value for key, value in opened(message.data).items() if key != 'crc32'}
        if entry['kind'] != kind:
            return False
        change(entry)
        message.data = sealed(entry)
        return True

    return edit


def test_another_strike_in_the_journal_gives_another_play(told, tmp_path, capsys):
    def harder(entry):
        entry['velocity'][0] *= 1.0 + 1e-13

    path = bag(
        tmp_path / 'bag', changed(without(told, 'red/shot'), reseal('strike', harder), 'journal')
    )
    assert main([str(path)]) == 1
    first = lines(capsys.readouterr())[0]
    assert first.startswith('shot 1 (red): differs first at tick ') and 'in position: ' in first


def test_another_rest_in_the_journal_is_found(told, tmp_path, capsys):
    def further(entry):
        entry['state']['position'][1] += 1e-9

    path = bag(tmp_path / 'bag', changed(told, reseal('rest', further), 'journal'))
    assert main([str(path)]) == 1
    assert 'in position of the rest: ' in capsys.readouterr().out


def test_an_input_that_does_not_fit_is_found(told, tmp_path, capsys):
    def lonely(entry):
        entry['balls'] = {'red': entry['balls']['red']}

    path = bag(tmp_path / 'other', changed(told, reseal('strike', lonely), 'journal'))
    assert main([str(path)]) == 1
    assert "'blue'" in lines(capsys.readouterr())[0]


def test_a_strike_that_was_sent_otherwise_is_found(told, tmp_path, capsys):
    def change(message):
        ulp(message, 'linear.y')
        return True

    assert main([str(bag(tmp_path / 'bag', changed(told, change, 'red/shot')))]) == 1
    first, *others = lines(capsys.readouterr())
    assert 'in velocity sent: ' in first and all(line.endswith('identical') for line in others)


def test_what_was_told_before_the_first_strike_in_the_bag_does_not_count(told, tmp_path, capsys):
    strikes = [
        i for i, one in enumerate(told) if one[0] == '/journal' and '"strike"' in one[3].data
    ]
    third = strikes[2]
    late = [told[0], *without(told[:third], 'journal', 'pose', 'twist'), *told[third:]]
    assert main([str(bag(tmp_path / 'bag', late))]) == 0
    assert capsys.readouterr().out.endswith('3 of 3 identical\n')


def test_a_configuration_told_last_will_do(told, tmp_path):
    late = [*told[1:], (*told[0][:2], told[-1][2], told[0][3])]
    assert main([str(bag(tmp_path / 'bag', late))]) == 0


def test_a_recording_that_ends_in_a_shot_is_compared_as_far_as_it_goes(told, tmp_path, capsys):
    cut = [one for one in told if one[2] < told_start(told) + 17 * 10**9]
    assert len(cut) < len(told) and LAST / 250 > 17
    assert main([str(bag(tmp_path / 'bag', cut))]) == 0
    assert lines(capsys.readouterr())[-1] == 'shot 6 (red): identical, as far as it was recorded'


def test_a_shot_with_missing_entries_is_named_and_the_others_run(told, tmp_path, capsys):
    gust = next(
        i for i, one in enumerate(told) if one[0] == '/journal' and '"kind": "wind"' in one[3].data
    )
    after = gust + 1
    assert main([str(bag(tmp_path / 'bag', told[:gust] + told[after:]))]) == 1
    first, *others = lines(capsys.readouterr())
    assert first.startswith('shot 1 (red): journal entries 2 to 2 are missing')
    assert all(line.endswith('identical') for line in others)


TEXT = 'std_msgs/msg/String'


def digest_changed(entry):
    entry['course']['digest'] = '0' * 64


def effects_unknown(entry):
    entry['parameters']['effects'] = ['gravity', 'rain']


@pytest.mark.parametrize(
    'change, reason',
    [
        (lambda told: without(told, 'journal'), 'no strike is in a journal'),
        (lambda told: [('/chatter', TEXT, 1, made(TEXT, data='hello'))], 'no play'),
        (
            lambda told: changed(told, replaced('"spin": [3.0', '"spin": [3.1'), 'journal'),
            'strike was changed',
        ),
        (
            lambda told: changed(told, reseal('config', digest_changed), 'journal'),
            'is not the one',
        ),
        (
            lambda told: changed(told, reseal('config', effects_unknown), 'journal'),
            "effect 'rain' is unknown",
        ),
        (lambda told: told[1:], 'the beginning of its journal'),
    ],
    ids=[
        'no journal',
        'foreign',
        'a byte of a strike',
        'another course',
        'an effect',
        'no configuration',
    ],
)
def test_what_cannot_be_run_again_is_one_line_and_exit_code_1(
    told, tmp_path, capsys, change, reason
):
    assert main([str(bag(tmp_path / 'bag', change(told)))]) == 1
    captured = capsys.readouterr()
    assert captured.err.startswith('resimulate: ') and captured.err.count('\n') == 1
    assert reason in captured.err and not captured.out


def test_a_truncated_bag_is_one_line_and_exit_code_1(told, tmp_path, capsys):
    path = bag(tmp_path / 'bag', told)
    file = path / 'bag.mcap'
    file.write_bytes(file.read_bytes()[:-5000])
    assert main([str(path)]) == 1
    captured = capsys.readouterr()
    assert captured.err.count('\n') == 1 and not captured.out


def test_the_course_may_have_moved_but_not_changed(told, tmp_path, capsys):
    path, course = str(bag(tmp_path / 'bag', told)), shipped_courses()['golf_without_friends']
    for mesh in course.parent.glob('golf_without_friends*.stl'):
        (tmp_path / mesh.name).write_bytes(mesh.read_bytes())
    (tmp_path / 'same.yaml').write_bytes(course.read_bytes())
    (tmp_path / 'other.yaml').write_bytes(course.read_bytes() + b'\n')
    assert main([path, '--course', str(tmp_path / 'same.yaml')]) == 0
    assert main([path, '--course', str(tmp_path / 'other.yaml')]) == 1
    assert main([path, '--course', str(tmp_path / 'none.yaml')]) == 1
    assert capsys.readouterr().err.count('\n') == 2


def test_another_accuracy_tells_how_far_each_rest_moves_and_both_times(told, tmp_path, capsys):
    path = str(bag(tmp_path / 'bag', told))
    assert main([path, '--accuracy', 'reference']) == 0
    told_of = [line for line in capsys.readouterr().out.splitlines() if line.startswith('  ')]
    assert len(told_of) == STRIKES
    assert sum('ended by a reset' in line for line in told_of) == 1
    moves = [float(line.split()[3]) for line in told_of if 'moves' in line]
    assert 0.0 < max(moves) < 5.0
    assert all(' ms at reference' in line for line in told_of)


def test_the_accuracy_of_the_play_itself_moves_nothing(told, tmp_path, capsys):
    chip = without(Sim().play([(3, 'strike', ('red', (9.0, 0.5, 6.0), (0.0, -90.0, 0.0)))], 1500))
    assert main([str(bag(tmp_path / 'bag', chip)), '--accuracy', 'standard']) == 0
    assert '  rest moves by 0 m; ' in capsys.readouterr().out


def test_json_of_the_journal_has_the_keys_of_a_strike(told):
    strike = next(
        opened(one[3].data) for one in told if one[0] == '/journal' and '"strike"' in one[3].data
    )
    assert list(strike) == [
        'entry',
        'kind',
        'tick',
        'shot',
        'ball',
        'velocity',
        'spin',
        'time',
        'clock',
        'engine',
        'accuracy',
        'turbulence',
        'wind',
        'balls',
    ]
    assert list(strike['balls']) == ['red', 'blue']
    assert json.loads(sealed(strike)) == {**strike, 'crc32': json.loads(sealed(strike))['crc32']}


def test_who_runs_it_again_on_something_else_is_told(told, tmp_path, capsys):
    def older(entry):
        entry['made_with']['physics'] = 'older'

    path = bag(tmp_path / 'bag', changed(told, reseal('config', older), 'journal'))
    assert main([str(path)]) == 0
    assert 'note: physics older then, ' in capsys.readouterr().out
