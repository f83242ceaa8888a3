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

"""What the panel foretells is what the sim will do, and the caddie holes out everywhere."""

from math import hypot

from golf_sim_ros.course import load_course
from golf_sim_ros.course.package_files import share
from golf_sim_ros.physics import ground_height, Shot, simulate
from golf_sim_ros.view import caddie
from golf_sim_ros.view.caddie import Stroke
from golf_sim_ros.view.game import par_of
import numpy as np
import pytest

CALM = (0.0, 0.0, 0.0)
WITH_HOLE = [
    name
    for name in sorted(path.stem for path in share('config', 'courses').glob('*.yaml'))
    if load_course(name).hole
]


def test_a_prediction_is_what_simulate_plays():
    course, wind = load_course('links'), (2.0, -1.0, 0.0)
    stroke = Stroke('7i', 0.9, 3.0, 0.4)
    told = caddie.prediction(course, course.tee, stroke, wind)
    play = simulate(
        course, Shot(*caddie.launch(course.hole, course.tee, stroke)), wind, engine='python'
    )
    np.testing.assert_allclose(told['end'], play.result.position, atol=0.02)
    np.testing.assert_allclose(told['landing'], play.collisions[0].position, atol=0.02)
    assert told['carry'] == pytest.approx(play.result.carry, abs=0.02)
    assert len(told['path']) <= 2 * caddie.POINTS


def test_what_cannot_be_played_has_no_prediction():
    course = load_course('links')
    assert caddie.prediction(course, (150.0, -34.0), Stroke('7i', 1.0), CALM) is None  # a pond


def test_aim_and_curve_are_positive_to_the_right():
    course = load_course('links')
    straight, right, slice_ = (
        caddie.play_out(course, course.tee, stroke, CALM).result.position[1]
        for stroke in (Stroke('7i', 1.0), Stroke('7i', 1.0, 5.0), Stroke('7i', 1.0, 0.0, 0.5))
    )
    assert right < straight - 5.0 and slice_ < straight - 5.0


def test_slopes_are_those_of_the_ground():
    course = load_course('putting_green')
    rows = caddie.slopes(course, course.tee)
    assert len(rows) > 50
    for x, y, z, along, up in rows[:: len(rows) // 20]:
        here, east, north = (
            ground_height(course, x + a, y + b)[0] for a, b in ((0, 0), (0.01, 0), (0, 0.01))
        )
        assert z == pytest.approx(here, abs=1e-4)
        assert along == pytest.approx((east - here) / 0.01, abs=4e-3)
        assert up == pytest.approx((north - here) / 0.01, abs=4e-3)
        assert ground_height(course, x, y)[1] in caddie.GREENS


@pytest.mark.parametrize('place', [(0.0, 0.0), (1.0, 2.0), (6.0, -3.0), (3.0, 1.2)])
def test_the_line_that_is_shown_holes(place):
    course = load_course('putting_green')
    line = np.array(caddie.line(course, place, CALM))
    assert hypot(*(line[0, :2] - place)) < 1e-3
    assert hypot(*(line[-1, :2] - course.hole)) < 0.054


@pytest.mark.parametrize('name', WITH_HOLE)
def test_the_caddie_holes_out_in_par_plus_four(name):
    course, wind = load_course(name), (1.5, 1.0, 0.0)
    place, strokes, holed = course.tee, 0, False
    while not holed and strokes <= par_of(course) + 4:
        flight = caddie.play_out(course, place, caddie.choose(course, place, wind), wind)
        lost = flight.result.status in ('water', 'out_of_bounds')
        strokes += 1 + lost
        holed = flight.result.status == 'holed'
        place = place if lost else flight.result.position[:2]
    assert holed and strokes <= par_of(course) + 4
