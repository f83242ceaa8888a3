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

"""What is typed in the terminal, and what is told there."""

import asyncio
import os
import subprocess
import sys
from types import SimpleNamespace

from golf_sim_ros.course import load_course
from golf_sim_ros.view import session as session_module, terminal
from golf_sim_ros.view.caddie import putt_speed, Stroke
from golf_sim_ros.view.own_sim import OwnSim
from golf_sim_ros.view.session import Session
import pytest


@pytest.fixture
def session():
    """Make a session with a ball on the tee of links."""
    made = Session(is_game=True)
    made.course, made.places = load_course('links'), {0: (0.0, 0.0, 0.02)}
    made.round.begin(made.course)
    return made


@pytest.mark.parametrize(
    'typed, stroke',
    [
        ('7i', Stroke('7i', 1.0)),
        ('7-iron 80', Stroke('7i', 0.8)),
        ('driver 100 -2 50', Stroke('driver', 1.0, -2.0, 0.5)),
        ('putter 3.5 1', Stroke('putter', 3.5, 1.0)),
    ],
)
def test_words_are_a_stroke(session, typed, stroke):
    assert terminal.stroke_of(typed.split(), session) == stroke


def test_a_putt_without_a_speed_is_one_to_the_hole(session):
    stroke = terminal.stroke_of(['putter'], session)
    assert stroke.power == pytest.approx(putt_speed(terminal.way_to_hole(session) + 0.3))


@pytest.mark.parametrize('typed', ['spoon', '7i hard', '7i 80 1 2 3'])
def test_what_is_no_stroke_is_refused(session, typed):
    with pytest.raises(ValueError, match='.'):
        terminal.stroke_of(typed.split(), session)


def test_advice_can_be_typed(session):
    advice = terminal.advice(Stroke('7i', 0.8, -2.0))
    assert terminal.stroke_of(advice.split(), session) == Stroke('7i', 0.8, -2.0)


def test_where_the_ball_lies_is_told(session):
    assert terminal.situation(session, 'si').startswith('stroke 1, 346.1 m to the hole [driver')
    session.wind = (3.0, -4.0, 0.0)
    assert ', wind 5.0 m/s ' in terminal.situation(session, 'si')
    assert ', wind 11.2 mph ' in terminal.situation(session, 'golf')


def test_a_course_that_cannot_be_read_and_a_sim_that_ended_are_told(session):
    game = SimpleNamespace(session=session, own=SimpleNamespace(ending=''))
    assert terminal.trouble(game) == ''
    game.own.ending = 'sim_node has ended by itself, with code -9'
    assert 'ended' in terminal.trouble(game)
    session.on_no_course('there is no course')
    assert 'there is no course' in terminal.trouble(game)


def test_a_sim_of_others_that_is_gone_and_back_is_told_once_each(session, capsys):
    tell = terminal.tell_status(SimpleNamespace(session=session, own=None))
    forget = session.listen(tell)
    for reached in (True, False, False, True):
        session.on_reach(reached, False, True)
    forget()
    assert capsys.readouterr().err.splitlines() == [
        'play_hole: The sim cannot be reached',
        'play_hole: The sim is reached',
    ]


@pytest.mark.parametrize(
    'result, told',
    [
        ({'status': 'rejected', 'reason': 'over 150 m/s'}, 'rejected: over 150 m/s'),
        ({'status': 'failed', 'reason': 'too many segments'}, 'failed: too many segments'),
        (None, 'no result came: the strike was lost, or the sim is paused'),
    ],
)
def test_a_strike_that_is_no_stroke_is_told_with_its_reason(
    session, result, told, capsys, monkeypatch
):
    monkeypatch.setattr(session_module, 'TAKEN', 0.0)
    session.names = ['ball']
    session.on_reach(True, False, True)

    def strike(velocity, spin):
        if result:
            about = {'shot': 1, 'ball': 'ball', 'velocity': velocity, 'spin': spin}
            session.on_result({**about, **result})

    async def play():
        lines = SimpleNamespace(read=iter_of(['driver 250', None]))
        game = SimpleNamespace(link=SimpleNamespace(strike=strike))
        return await terminal.typed(session, None, game, 'si', lines)

    assert not asyncio.run(play())
    assert f'  {told}\n' in capsys.readouterr().out


def iter_of(lines):
    """Give a function of these lines one after the other, to be awaited."""
    left = iter(lines)

    async def following():
        return next(left)

    return following


def test_lines_that_are_pasted_together_come_one_by_one(monkeypatch):
    reading, writing = os.pipe()

    async def read_all():
        lines = terminal.Lines()
        os.write(writing, b'7i\n\ndriver 9')
        found = [await asyncio.wait_for(lines.read(), 20.0) for _ in range(2)]
        os.write(writing, b'0\nq')
        found.append(await asyncio.wait_for(lines.read(), 20.0))
        os.close(writing)
        return found + [await lines.read(), await lines.read()]

    with os.fdopen(reading) as stdin:
        monkeypatch.setattr(sys, 'stdin', stdin)
        assert asyncio.run(read_all()) == ['7i\n', '\n', 'driver 90\n', 'q', None]


def test_lines_of_a_file_come_one_by_one(monkeypatch, tmp_path):
    path = tmp_path / 'strokes'
    path.write_text('7i\nq\n')

    async def read_all():
        lines = terminal.Lines()
        return [await lines.read() for _ in range(3)]

    with path.open() as stdin:
        monkeypatch.setattr(sys, 'stdin', stdin)
        assert asyncio.run(read_all()) == ['7i\n', 'q\n', None]


def test_one_stroke_is_one_stroke(session):
    session.round.hole.add({'status': 'holed', 'stroke': 1, 'penalty': 0}, '7i')
    assert terminal.card(session.round.hole) == 'Links: 1 stroke, hole in one (par 4)'


def test_own_processes_that_are_ended_on_purpose_have_not_ended_by_themselves():
    own = OwnSim('/x')
    own.processes = [subprocess.Popen([sys.executable, '-c', 'input()'], stdin=subprocess.PIPE)]
    own.programs = ['sim_node']
    process = own.processes[0]
    assert own.ending == ''
    process.kill()
    process.wait()
    assert own.ending == 'sim_node has ended by itself, with code -9'
    own.stop()
    assert own.ending == ''
    process.stdin.close()
