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

"""The score counts what results tell."""

from golf_sim_ros.course import load_course
from golf_sim_ros.view.game import Hole, par_of, Round
import pytest


def result(shot, status='at_rest', penalty=0, stroke=None, velocity=(1.0, 2.0, 3.0)):
    """Make a result as a sim publishes it, as far as scores go."""
    return {
        'shot': shot,
        'status': status,
        'penalty': penalty,
        'stroke': stroke or shot,
        'velocity': list(velocity),
        'spin': [0.0, 0.0, 0.0],
    }


@pytest.mark.parametrize(
    'name, par',
    [('golf_without_friends', 4), ('links', 4), ('playground', 3), ('putting_green', 2)],
)
def test_par_follows_the_length(name, par):
    assert par_of(load_course(name)) == par


def test_water_and_out_of_bounds_cost_what_results_say():
    hole = Hole(1, 'Links', 4)
    hole.add(result(1, 'water', 1), '7i')
    hole.add(result(2, 'out_of_bounds', 1), '7i')
    hole.add(result(3), '7i')
    hole.add(result(4, 'holed'), 'putter')
    assert hole.strokes == 6 and hole.holed
    assert [line.stroke for line in hole.lines] == [1, 3, 5, 6]
    assert hole.verdict() == 'double bogey'


@pytest.mark.parametrize('status', ['rejected', 'failed', 'aborted'])
def test_what_was_not_played_counts_nothing(status):
    hole = Hole(1, 'Links', 4)
    hole.add(result(1, status), '7i')
    assert hole.strokes == 0


def test_a_ball_that_is_teed_anew_begins_anew():
    hole = Hole(1, 'Links', 4)
    for shot in (1, 2):
        hole.add(result(shot), '7i')
    hole.add(result(3, stroke=1), 'driver')
    assert hole.strokes == 1


@pytest.mark.parametrize(
    'strokes, words', [(1, 'hole in one'), (3, 'birdie'), (4, 'par'), (8, '+4')]
)
def test_the_score_in_words(strokes, words):
    hole = Hole(1, 'Links', 4)
    for shot in range(1, strokes + 1):
        hole.add(result(shot, 'holed' if shot == strokes else 'at_rest'), '')
    assert hole.verdict() == words


def test_the_club_is_that_of_the_strike_as_it_was_sent():
    round_ = Round()
    round_.begin(load_course('links'))
    round_.strike('7i', (10.00004, 2.0, 3.0), (0.0, 0.0, 0.0))
    round_.end(result(1, velocity=(10.0, 2.0, 3.0)))
    round_.end(result(2, velocity=(11.0, 2.0, 3.0)))
    assert [line.club for line in round_.hole.lines] == ['7i', '']


def test_the_head_tells_the_next_stroke():
    round_ = Round()
    assert round_.score() == {}
    round_.begin(load_course('links'))
    round_.end(result(1, 'water', 1))
    assert round_.score() == {'hole': '', 'par': 4, 'stroke': 3, 'name': 'Links'}
    round_.begin(load_course('putting_green'))
    assert round_.score()['hole'] == '2' and round_.score()['stroke'] == 1
