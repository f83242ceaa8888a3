# SPDX-License-Identifier: Apache-2.0
"""Every strike has exactly one result with its own number, in order, however weak it was."""
import json
from math import inf

import pytest
from std_srvs.srv import SetBool

from golf_sim_ros.course import load_course
from processes import parameters, READY, wait_until
from told_game import ToldGame

WEAK, GOOD = (1e-9, 0.0, 0.0), (2.0, 0.1, 0.5)
FACTORS = (1.0, 0.0, 20.0)


@pytest.fixture(params=FACTORS, ids=[f'factor {factor:g}' for factor in FACTORS])
def factor(request):
    return request.param


def game_of(monkeypatch, factor, balls=('ball',), rate=250.0):
    return ToldGame(monkeypatch, load_course('golf_without_friends'), balls, factor, rate)


def check(told, count):
    """Numbers 1 to `count` have each one result; each strike in the journal stands before its rest."""
    assert sorted(result['shot'] for result in told.results) == list(range(1, count + 1))
    struck, ended = [], []
    for entry in told.entries:
        if entry['kind'] == 'strike':
            struck.append(entry['shot'])
        elif entry['kind'] == 'rest':
            assert entry['shot'] in struck
            ended.append(entry['shot'])
    assert struck == sorted(struck)
    assert sorted(ended) == struck
    assert told.differences() == [None] * len(struck)


def test_two_weak_strikes_back_to_back_have_a_result_each(monkeypatch, factor):
    told = game_of(monkeypatch, factor)
    told.send('ball', WEAK)
    told.send('ball', WEAK)
    told.step()
    check(told, 2)
    assert [result['status'] for result in told.results] == ['at_rest', 'at_rest']
    kinds = [entry['kind'] for entry in told.entries]
    assert kinds == ['config', 'strike', 'rest', 'strike', 'rest']


def test_weak_strikes_that_wait_while_paused_have_a_result_each(monkeypatch, factor):
    told = game_of(monkeypatch, factor)
    told.step(3)
    told.game.paused = True
    told.send('ball', WEAK)
    told.send('ball', WEAK)
    told.step(5)
    assert not told.results
    told.game.paused = False
    told.step(2)
    check(told, 2)


def test_a_weak_strike_among_good_ones_of_two_balls_is_told_in_order(monkeypatch, factor):
    told = game_of(monkeypatch, factor, ('red', 'blue'))
    told.send('red', GOOD)
    told.send('blue', WEAK)
    told.send('blue', GOOD)
    told.step(4)
    told.send('blue', WEAK)  # in motion: rejected
    told.play_on()
    told.send('red', WEAK)
    told.send('blue', GOOD)
    told.send('red', GOOD)
    told.play_on()
    assert sorted(result['shot'] for result in told.results) == list(range(1, 8))
    played = [result['shot'] for result in told.results if result['status'] != 'rejected']
    assert [entry['shot'] for entry in told.entries if entry['kind'] == 'rest'] == played
    assert told.differences() == [None] * len(played)


@pytest.mark.parametrize('rate', [10.0, 50.0, 100.0, 1000.0])
def test_a_weak_strike_stands_before_its_rest_in_the_journal_at_every_rate(monkeypatch, rate):
    told = game_of(monkeypatch, 1.0, rate=rate)
    for _ in range(5):
        told.send('ball', WEAK)
        told.step()
    check(told, 5)
    assert [result['shot'] for result in told.results] == [1, 2, 3, 4, 5]


def test_a_weak_strike_before_a_reset_ends_by_itself_and_not_by_the_reset(monkeypatch):
    told = game_of(monkeypatch, 1.0)
    told.send('ball', WEAK)
    told.game.inputs.append(told.game.reset)
    told.send('ball', GOOD)
    told.game.inputs.append(told.game.reset)
    told.step()
    check(told, 2)
    assert [result['status'] for result in told.results] == ['at_rest', 'aborted']


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
    told = [json.loads(message.data) for message in golfer.results]
    assert [result['shot'] for result in told] == [1, 2, 3, 4]
    assert golfer.play(GOOD)['shot'] == 5
    assert sim.stop() == 0


def test_a_failed_shot_is_told_logged_and_recorded_and_the_play_goes_on(monkeypatch):
    course = load_course('golf_without_friends')
    told = ToldGame(monkeypatch, course._replace(air=course.air._replace(pressure=inf)))
    told.send('ball', (60.0, 0.0, 15.0))
    told.send('ball', (1.0, 0.0, 0.0))
    told.step()
    told.play_on()
    check(told, 2)
    failed, good = told.results
    assert (failed['status'], good['status']) == ('failed', 'at_rest')
    assert failed['position'] == [0.0, 0.0, 0.0213]
    assert [entry['kind'] for entry in told.entries] == ['config', 'strike', 'rest', 'drop', 'strike', 'rest']
    assert 'shot 1 failed' in told.log.error.call_args.args[0]
    told.game.diagnose()
    slow, values = told.heard.diagnosed[-1]
    assert values['balls that could not go on'] == '1' and failed['reason'] in values['last of them']
