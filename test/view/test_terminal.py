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

from types import SimpleNamespace

from golf_sim_ros.course import load_course
from golf_sim_ros.view import terminal
from golf_sim_ros.view.caddie import putt_speed, Stroke
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


def test_a_course_that_cannot_be_read_and_a_sim_that_ended_are_told(session):
    game = SimpleNamespace(session=session, own=SimpleNamespace(has_ended=False))
    assert terminal.trouble(game) == ''
    game.own.has_ended = True
    assert 'ended' in terminal.trouble(game)
    session.on_no_course('there is no course')
    assert 'there is no course' in terminal.trouble(game)
