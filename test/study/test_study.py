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

"""The accuracy study: its yardsticks agree with the engine, its tables with its rows."""

from math import nan
import re

from golf_sim_ros.physics import ACCURACY
from golf_sim_ros.study import promises, tables
from golf_sim_ros.study.effects import EffectRow
from golf_sim_ros.study.measure import played, Row, Stage, ticked, Truth
from golf_sim_ros.study.scenes import quick_scenes, rack, scenes
from golf_sim_ros.study.sizes import SizeRow
from golf_sim_ros.study.ticks import STEPPED, TickRow
import pytest

SCENES = {scene.name: scene for scene in quick_scenes()}


@pytest.mark.parametrize('name', ['iron into a green', 'drive in gusty wind'])
def test_scipy_flies_to_where_the_engine_first_touches(name):
    fly = pytest.importorskip('golf_sim_ros.study.scipy_flight').fly
    scene = SCENES[name]
    end = fly(scene, 'DOP853', 1e-12)
    assert played(scene, ACCURACY['reference']).touch == pytest.approx(tuple(end[:2]), abs=1e-6)


def row(method, error, time):
    return Row('a', method, '', error, nan, time, 0.0)


def test_time_at_equal_error_is_that_of_the_fastest_setting_that_is_exact_enough():
    rows = [
        row('rk4', 1e-2, 1.0),
        row('rk4', 1e-4, 3.0),
        row('rk4', 1e-5, 2.0),
        row('euler', 1.0, 0.1),
    ]
    assert tables.seconds_at(rows, 'rk4', 1e-3) == 2.0
    assert tables.seconds_at(rows, 'euler', 1e-3) is None


def test_the_page_says_where_dormand_prince_is_not_the_fastest():
    rows = [row('dormand_prince', 1e-9, 2.0), row('rk4', 1e-9, 1.0)]
    assert 'RK4 took 0.50 of the time' in tables.exceptions(rows)
    assert 'none' in tables.exceptions([row('dormand_prince', 1e-9, 1.0), row('rk4', 1e-9, 2.0)])


def test_errors_are_of_the_ball_that_is_farthest_off():
    there = Truth((1.0, 2.0), ((0.0, 0.0, 0.0), (1.0, 1.0, 0.0)))
    assert there.errors(Truth((4.0, 6.0), ((0.0, 0.0, 1.0), (1.0, 4.0, 4.0)))) == (5.0, 5.0)


def test_tick_by_tick_a_shot_ends_where_it_does_at_once():
    scene = SCENES['iron into a green']
    ends = [ticked(scene, 'standard', rate)[0] for rate in (50.0, 1000.0)]
    for end in ends:
        assert max(played(scene, 'standard').errors(end)) < 1e-9


def test_a_game_plays_the_same_again_and_its_rack_is_mirror_symmetric():
    stage = Stage(rack(15), 'standard')
    once, again = stage(), stage(2)
    assert once == again
    places = {(round(x, 6), round(y, 6)) for x, y, _ in once.rest}
    assert places == {(x, -y) for x, y in places} and len(places) == 16


def test_the_full_study_has_the_scenes_that_were_asked_for():
    names = {scene.name for scene in scenes()}
    assert names > {
        'chip and run',
        'bunker shot',
        'breaking putt',
        'rack of 15',
        'mesh bounce',
        'a whole hole on links',
    }


def test_an_effect_can_be_left_out_where_the_rest_moves_less_than_a_centimetre():
    rows = [
        EffectRow('a', 'drag', 1.0, 1.0, 5.0, 1.0),
        EffectRow('a', 'wind', 0.0, 1e-3, 5.0, 1.0),
    ]
    assert tables.dispensable(rows) == '- a: wind (0.001 m)'


def test_the_spread_over_tick_rates_is_that_of_one_scene_and_preset():
    rows = [
        TickRow('a', 'standard', 10.0, 0.0, 1.0, 1.0),
        TickRow('a', 'standard', 50.0, 0.0, 3.0, 1.0),
        TickRow('b', 'standard', 10.0, 0.0, 9.0, 1.0),
        TickRow('a', STEPPED, 10.0, 0.0, 99.0, nan),
    ]
    assert tables.spread(rows) == 2.0


def test_the_page_shows_each_picture_and_table_that_is_written(tmp_path):
    page = pytest.importorskip('golf_sim_ros.study.page')
    presets = [Row('a', 'preset', name, 1e-3, 1e-2, 1e-5, 0.0) for name in ACCURACY]
    found = {
        'methods': [*presets, row('dormand_prince', 1e-9, 1.0)],
        'effects': [EffectRow('a', 'drag', nan, 1.0, -5.0, 1.0)],
        'ticks': [TickRow(scene, 'standard', 10.0, 0.0, 1.0, 1.0) for scene in 'ab'],
        'sizes': [SizeRow(what, 3, 1e-3) for what in ('balls', 'contacts')],
    }
    page.write(found, tmp_path, 'a test')
    text = (tmp_path / 'accuracy.md').read_text()
    named = set(re.findall(r'\((accuracy\w*\.png)\)', text))
    assert named == {path.name for path in tmp_path.glob('*.png')} and len(named) == 4
    assert len((tmp_path / 'accuracy_effects.csv').read_text().splitlines()) == 2
    assert '{' not in text


def test_many_shots_are_within_what_the_presets_promise():
    for job in promises.jobs(SCENES['iron into a green'].course.ground[0].material, 300):
        found = job()
        preset = ACCURACY[found.accuracy]
        assert found.shots == 300 and 0.0 < found.touch_median < found.touch_worst < preset.touch
        assert 0.0 < found.rest_worst < preset.rest
