# SPDX-License-Identifier: Apache-2.0
"""The accuracy study: its yardsticks agree with the engine, its tables with its rows."""
from math import nan

import pytest

from golf_sim_ros.study import page
from golf_sim_ros.study.measure import played, Row
from golf_sim_ros.study.scenes import scenes
from golf_sim_ros.physics import ACCURACY

SCENES = {scene.name: scene for scene in scenes()}


@pytest.mark.parametrize('name', ['iron into a green', 'drive in gusty wind'])
def test_scipy_flies_to_where_the_engine_first_touches(name):
    fly = pytest.importorskip('golf_sim_ros.study.scipy_flight').fly
    scene = SCENES[name]
    end = fly(scene, 'DOP853', 1e-12)
    assert played(scene, ACCURACY['reference']).touch == pytest.approx(tuple(end[:2]), abs=1e-6)


def row(method, error, time):
    return Row('a', method, '', error, nan, time, 0.0)


def test_time_at_equal_error_is_that_of_the_fastest_setting_that_is_exact_enough():
    rows = [row('rk4', 1e-2, 1.0), row('rk4', 1e-4, 3.0), row('rk4', 1e-5, 2.0), row('euler', 1.0, 0.1)]
    assert page.seconds_at(rows, 'rk4', 1e-3) == 2.0
    assert page.seconds_at(rows, 'euler', 1e-3) is None


def test_the_page_says_where_dormand_prince_is_not_the_fastest():
    rows = [row('dormand_prince', 1e-9, 2.0), row('rk4', 1e-9, 1.0)]
    assert 'RK4 took 0.50 of the time' in page.exceptions(rows)
    assert 'none' in page.exceptions([row('dormand_prince', 1e-9, 1.0), row('rk4', 1e-9, 2.0)])
