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

from math import inf, nan
import re

from golf_sim_ros.physics import ACCURACY, ground_height, simulate_many
from golf_sim_ros.study import against_scipy, grounds, promises, tables
from golf_sim_ros.study.effects import EffectRow
from golf_sim_ros.study.grounds import GroundRow
from golf_sim_ros.study.measure import played, Row, Stage, ticked, Truth
from golf_sim_ros.study.methods import dial
from golf_sim_ros.study.scenes import as_heights, hills, quick_scenes, rack, scenes
from golf_sim_ros.study.sizes import SizeRow
from golf_sim_ros.study.ticks import STEPPED, TickRow
import numpy as np
import pytest

SCENES = {scene.name: scene for scene in quick_scenes()}


@pytest.mark.parametrize('name', ['iron into a green', 'drive in gusty wind'])
def test_scipy_flies_to_where_the_engine_first_touches(name):
    fly = pytest.importorskip('golf_sim_ros.study.scipy_flight').fly
    scene = SCENES[name]
    end = fly(scene, 'DOP853', 1e-12)
    assert played(scene, ACCURACY['reference']).touch == pytest.approx(tuple(end[:2]), abs=1e-6)


def test_scipy_started_anew_at_each_impact_bounces_where_the_engine_does():
    scene = SCENES['bouncing on hard ground']
    true = against_scipy.true_touches(scene, against_scipy.IMPACTS)
    found = against_scipy.theirs(scene, 'a', lambda: true, 'DOP853', 1e-12)
    assert len(true) > 10 and found.error < 1e-8
    assert against_scipy.farthest(against_scipy.touches(scene, 'reference'), true) < 1e-7


@pytest.mark.parametrize('name', ['drive in gusty wind', 'bouncing on hard ground'])
def test_a_shot_ends_where_it_lands_on_ground_that_stops_it_dead(name):
    scene = SCENES[name]
    trap = against_scipy.trapped(scene)
    (told,) = simulate_many(
        trap.course, [trap.shot.velocity], [trap.shot.spin], trap.wind, trap.effects
    )
    assert told['bounces'] == 1 and told['duration'] == told['flight_time']
    assert told['total'] == told['carry']
    assert played(trap, 'standard').touch == played(scene, 'standard').touch


def test_a_touch_that_is_missing_is_infinitely_far_off():
    true = np.array([[1.0, 0.0], [3.0, 0.0]])
    assert against_scipy.farthest(true[:1], true) == inf
    assert against_scipy.farthest(np.array([[1.0, 2.0], [3.0, 1.0], [9.0, 9.0]]), true) == 2.0


@pytest.mark.parametrize('name', ACCURACY)
def test_the_dial_passes_through_the_presets(name):
    preset = ACCURACY[name]
    turned = dial(preset.method.tolerance)
    assert turned.method == preset.method
    assert turned.limits == pytest.approx(preset.limits, rel=0.05)


def test_hills_as_heights_are_those_of_the_mesh():
    mesh = hills(20_000)
    heights = as_heights(mesh)
    corners = mesh.ground[0].vertices
    for x, y, z in corners[::1999]:
        assert ground_height(heights, x, y)[0] == pytest.approx(z, abs=1e-9)
    for x, y in np.random.default_rng(1).uniform(-50.0, 50.0, (20, 2)):
        z = ground_height(mesh, x, y)[0]
        assert ground_height(heights, x, y)[0] == pytest.approx(z, abs=0.02)


def test_wide_hills_have_the_shape_of_narrow_ones():
    narrow, wide = (hills(800, width).ground[0].vertices for width in (120.0, 600.0))
    assert wide == pytest.approx(5.0 * narrow)


def test_strikes_are_each_a_little_other_and_spin_about_a_level_axis_across():
    velocities, spins = grounds.spread('drive', 50)
    assert len({tuple(velocity) for velocity in velocities}) == 50
    assert np.einsum('ij,ij->i', velocities, spins) == pytest.approx(0.0, abs=1e-9)
    assert velocities.mean(0) == pytest.approx(grounds.STRIKES['drive'].velocity, rel=0.1, abs=3.0)


def test_errors_of_a_volley_leave_out_what_the_truth_did_not_end():
    volley = grounds.Volley(SCENES['iron into a green'].course, 'chip', 3)
    ended = volley.played('standard', 3)
    lost = ended.copy()
    lost['status'][1], lost['position'][1] = 'failed', 99.0
    volley.truth = lambda: lost
    touch, rest = volley.errors('standard')
    assert touch.tolist() == rest.tolist() == [0.0, 0.0]


def ground_row(ground, setting, time, rest=1e-6):
    return GroundRow('putt', ground, setting, 9, nan, nan, nan, rest, rest, rest, time, 1e-3)


def ground_rows():
    return [
        ground_row(ground, setting, time, rest)
        for ground, time, rest in (('plane', 1e-5, 1e-7), ('mesh', 3e-5, 2e-2))
        for setting in (*ACCURACY, 'tolerance 1')
    ]


def test_the_table_of_grounds_compares_with_the_plane_at_the_same_preset():
    lines = tables.ground_table(ground_rows()).splitlines()
    assert len(lines) == 2 + 2 * len(ACCURACY)
    assert '| putt | mesh | standard | 30.0 us | 3.0 x | - | - | 2.0e-02 m |' in lines[6]


def test_the_page_tells_where_a_preset_is_further_off_than_it_promises():
    told = tables.beyond_promise(ground_rows()).splitlines()
    assert [line.split(',')[0] for line in told] == ['- standard', '- reference']
    assert 'none' in tables.beyond_promise(ground_rows()[:4])


def scipy_rows():
    return [
        against_scipy.ScipyRow('a', 'first touch', method, 'x', error, time)
        for method, error, time in (
            (against_scipy.OURS, 1e-3, 1e-6),
            (against_scipy.OURS, 1e-12, 1e-5),
            ('scipy RK45', 1e-3, 2e-4),
            ('scipy DOP853', 1e-5, 3e-4),
        )
    ]


def test_at_each_level_the_fastest_that_are_exact_enough_are_compared():
    lines = tables.scipy_table(scipy_rows()).splitlines()[2:]
    assert [line.split('|')[-2].strip() for line in lines] == 4 * ['200 x'] + 2 * ['30 x'] + 4 * [
        '-'
    ]
    assert tables.least_ratios(scipy_rows()) == '- a, to the first touch: 30 to 200 times.'


@pytest.mark.parametrize('values', [[3.0, 4.0], [0.0, nan, 1e-13, 1e2], [5e-6, 3e6]])
def test_scales_have_ticks_at_powers_of_ten_that_can_be_read(values):
    figures = pytest.importorskip('golf_sim_ros.study.figures')
    figure, panels = figures.pyplot.subplots(1, 2)
    figures.scale(panels, 'y', values)
    low, high = panels[0].get_ylim()
    assert panels[1].get_ylim() == (low, high)
    seen = [tick for tick in panels[0].get_yticks() if low <= tick <= high]
    assert 2 <= len(seen) <= figures.MOST_TICKS + 1 and not len(panels[0].get_yticks(minor=True))
    assert all(low < value < high for value in values if value > 0.0)
    figures.pyplot.close(figure)


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
        'grounds': ground_rows(),
        'methods': [*presets, row('dormand_prince', 1e-9, 1.0)],
        'scipy': scipy_rows(),
        'effects': [EffectRow('a', 'drag', nan, 1.0, -5.0, 1.0)],
        'ticks': [TickRow(scene, 'standard', 10.0, 0.0, 1.0, 1.0) for scene in 'ab'],
        'sizes': [SizeRow(what, 3, 1e-3) for what in ('balls', 'contacts')],
    }
    page.write(found, tmp_path, 'a test')
    text = (tmp_path / 'accuracy.md').read_text()
    named = set(re.findall(r'\((accuracy\w*\.png)\)', text))
    assert named == {path.name for path in tmp_path.glob('*.png')} and len(named) == 5
    assert len((tmp_path / 'accuracy_effects.csv').read_text().splitlines()) == 2
    assert '{' not in text


def test_many_shots_are_within_what_the_presets_promise():
    for job in promises.jobs(SCENES['iron into a green'].course.ground[0].material, 300):
        found = job()
        preset = ACCURACY[found.accuracy]
        assert found.shots == 300 and 0.0 < found.touch_median < found.touch_most < preset.touch
        assert 0.0 < found.rest_median < found.rest_most < preset.rest
        if found.ground == 'level':
            assert found.touch_worst < preset.touch and found.rest_worst < preset.rest
            assert found.touch_beyond == found.rest_beyond == 0


def test_what_errors_are_within_is_told_with_how_many_are_beyond_the_promise():
    median, most, worst, beyond = promises.spread(np.arange(1.0, 202.0), 199.0)
    assert (median, most, worst, beyond) == (101.0, 199.0, 201.0, 2)
