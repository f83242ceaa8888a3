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

import subprocess
import sys
from types import SimpleNamespace

from golf_sim_ros.course import load_course
from golf_sim_ros.view import terminal
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
