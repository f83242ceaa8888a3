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

"""Every strike has exactly one result with its own number, in order, however weak it was."""

import json
from math import inf

from golf_sim_ros.course import load_course
from observed_game import ObservedGame
from processes import parameters, READY, wait_until
import pytest
from std_srvs.srv import SetBool

WEAK, GOOD = (1e-9, 0.0, 0.0), (2.0, 0.1, 0.5)
FACTORS = (1.0, 0.0, 20.0)


@pytest.fixture(params=FACTORS, ids=[f'factor {factor:g}' for factor in FACTORS])
def factor(request):
    return request.param


def game_of(monkeypatch, factor, balls=('ball',), rate=250.0):
    return ObservedGame(monkeypatch, load_course('golf_without_friends'), balls, factor, rate)


def check(observed, count):
    """Numbers 1 to `count` have each one result.

    Each strike in the journal stands before its rest.
    """
    assert sorted(result['shot'] for result in observed.results) == list(range(1, count + 1))
    struck, ended = [], []
    for entry in observed.entries:
        if entry['kind'] == 'strike':
            struck.append(entry['shot'])
        elif entry['kind'] == 'rest':
            assert entry['shot'] in struck
            ended.append(entry['shot'])
    assert struck == sorted(struck)
    assert sorted(ended) == struck
    assert observed.differences() == [None] * len(struck)


def test_two_weak_strikes_back_to_back_have_a_result_each(monkeypatch, factor):
    observed = game_of(monkeypatch, factor)
    observed.send('ball', WEAK)
    observed.send('ball', WEAK)
    observed.step()
    check(observed, 2)
    assert [result['status'] for result in observed.results] == ['at_rest', 'at_rest']
    kinds = [entry['kind'] for entry in observed.entries]
    assert kinds == ['config', 'strike', 'rest', 'strike', 'rest']


def test_weak_strikes_that_wait_while_paused_have_a_result_each(monkeypatch, factor):
    observed = game_of(monkeypatch, factor)
    observed.step(3)
    observed.game.paused = True
    observed.send('ball', WEAK)
    observed.send('ball', WEAK)
    observed.step(5)
    assert not observed.results
    observed.game.paused = False
    observed.step(2)
    check(observed, 2)


def test_a_weak_strike_among_good_ones_of_two_balls_is_reported_in_order(monkeypatch, factor):
    observed = game_of(monkeypatch, factor, ('red', 'blue'))
    observed.send('red', GOOD)
    observed.send('blue', WEAK)
    observed.send('blue', GOOD)
    observed.step(4)
    observed.send('blue', WEAK)  # in motion: rejected
    observed.play_on()
    observed.send('red', WEAK)
    observed.send('blue', GOOD)
    observed.send('red', GOOD)
    observed.play_on()
    assert sorted(result['shot'] for result in observed.results) == list(range(1, 8))
    played = [result['shot'] for result in observed.results if result['status'] != 'rejected']
    assert [entry['shot'] for entry in observed.entries if entry['kind'] == 'rest'] == played
    assert observed.differences() == [None] * len(played)


@pytest.mark.parametrize('rate', [10.0, 50.0, 100.0, 1000.0])
def test_a_weak_strike_stands_before_its_rest_in_the_journal_at_every_rate(monkeypatch, rate):
    observed = game_of(monkeypatch, 1.0, rate=rate)
    for _ in range(5):
        observed.send('ball', WEAK)
        observed.step()
    check(observed, 5)
    assert [result['shot'] for result in observed.results] == [1, 2, 3, 4, 5]


def test_a_weak_strike_before_a_reset_ends_by_itself_and_not_by_the_reset(monkeypatch):
    observed = game_of(monkeypatch, 1.0)
    observed.send('ball', WEAK)
    observed.game.inputs.append(observed.game.reset)
    observed.send('ball', GOOD)
    observed.game.inputs.append(observed.game.reset)
    observed.step()
    check(observed, 2)
    assert [result['status'] for result in observed.results] == ['at_rest', 'aborted']


@pytest.mark.parametrize('pace', [0.0, 1.0, 20.0])
def test_weak_strikes_over_dds_are_answered_running_and_paused(start, make_golfer, pace):
    name = f'/weak_{pace:g}'
    sim = start('sim_node', *parameters(name, real_time_factor=pace))
    sim.wait_for(READY)
    golfer = make_golfer(name)
    golfer.strike(WEAK)
    golfer.strike((0.0, 1e-9, 0.0))
    wait_until(lambda: len(golfer.results) == 2, 'both results came')
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=True))
    golfer.strike(WEAK)
    golfer.strike((0.0, 1e-9, 0.0))
    golfer.heartbeat()
    golfer.call(SetBool, 'golf_sim/pause', SetBool.Request(data=False))
    wait_until(lambda: len(golfer.results) == 4, 'all results came')
    results = [json.loads(message.data) for message in golfer.results]
    assert [result['shot'] for result in results] == [1, 2, 3, 4]
    assert golfer.play(GOOD)['shot'] == 5
    assert sim.stop() == 0


def test_a_failed_shot_is_reported_logged_and_recorded_and_the_play_goes_on(monkeypatch):
    course = load_course('golf_without_friends')
    observed = ObservedGame(monkeypatch, course._replace(air=course.air._replace(pressure=inf)))
    observed.send('ball', (60.0, 0.0, 15.0))
    observed.send('ball', (1.0, 0.0, 0.0))
    observed.step()
    observed.play_on()
    check(observed, 2)
    failed, good = observed.results
    assert (failed['status'], good['status']) == ('failed', 'at_rest')
    assert failed['position'] == [0.0, 0.0, 0.0213]
    kinds = [entry['kind'] for entry in observed.entries]
    assert kinds == ['config', 'strike', 'rest', 'drop', 'strike', 'rest']
    assert 'shot 1 failed' in observed.log.error.call_args.args[0]
    observed.game.diagnose()
    slow, values = observed.heard.diagnosed[-1]
    assert (
        values['balls that could not go on'] == '1' and failed['reason'] in values['last of them']
    )
