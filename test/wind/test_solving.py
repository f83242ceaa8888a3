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

"""Solving for the wind over a course."""

from functools import lru_cache
from math import cos, pi, sin
import subprocess
import sys

from golf_sim_ros.physics import Course, Plane, UniformProfile, Water
from golf_sim_ros.wind import FieldError, NotConverged, solve
import numpy as np
import pytest
from solvable import level, mounds, needs_numba, places

pytestmark = needs_numba
MIRROR = np.array([1.0, -1.0, 1.0])


@lru_cache(maxsize=None)
def field(side=1.0, accuracy='sketch'):
    """Field of the mounds, in six directions."""
    return solve(mounds(side), 6, accuracy)


@pytest.mark.parametrize('accuracy', ['mass', 'sketch'])
def test_over_level_ground_of_one_roughness_it_is_the_logarithmic_profile(accuracy):
    found = solve(level(), [0.0, 1.3, 2.8, 4.4], accuracy)
    where = places(found, 200)
    law = np.log1p(where[:, 2] / 0.02) / np.log1p(10.0 / 0.02)
    for wind in ((8.0, 0.0, 0.0), (-3.0, 4.0, 0.0), (1.0, -7.0, 0.0)):
        assert found.velocity(where, wind) == pytest.approx(np.outer(law, wind), abs=1e-5)


def test_twice_the_wind_is_twice_the_field():
    where = places(field(), 300)
    once, twice = (field().velocity(where, (s * 3.0, s * -4.0, 0.0)) for s in (1.0, 2.0))
    assert abs(twice - 2.0 * once).max() < 1e-8


def test_a_mirrored_course_has_a_mirrored_wind():
    where = places(field(), 500)
    for wind in ((8.0, 0.0, 0.0), (-3.0, 4.0, 0.0)):
        own = field().velocity(where, wind)
        image = field(-1.0).velocity(where * MIRROR, wind * MIRROR) * MIRROR
        assert abs(own - image).max() < 1e-6 * np.linalg.norm(wind)


def test_two_runs_give_the_same_bits():
    again = solve(mounds(), 6, 'sketch')
    assert again.cells.ratios.tobytes() == field().cells.ratios.tobytes()


def test_behind_a_tree_and_a_mound_the_wind_is_less():
    height = field().survey.heights_at(60.0, -20.0) + 4.0
    behind = field().velocity([[60.0, -20.0, height]], (8.0, 0.0, 0.0))[0]
    before = field().velocity([[15.0, -20.0, height]], (8.0, 0.0, 0.0))[0]
    assert behind[0] < 0.8 * before[0]
    bare = solve(mounds()._replace(obstacles=()), [0.0], 'sketch')
    without = bare.velocity([[60.0, -20.0, height]], (8.0, 0.0, 0.0))[0]
    assert behind[0] < without[0] - 0.3


def test_the_wind_follows_the_ground():
    slope = (field().survey.heights_at(44.0, 12.0) - field().survey.heights_at(36.0, 12.0)) / 8.0
    place = [40.0, 12.0, field().survey.heights_at(40.0, 12.0) + 0.5]
    air = field().velocity([place], (8.0, 0.0, 0.0))[0]
    assert air[2] / air[0] == pytest.approx(slope, abs=0.4 * slope)


def test_the_wind_goes_where_it_is_said_to_go():
    found = solve(level(), 8, 'mass')
    for angle in np.linspace(0.0, 2.0 * pi, 13):
        wind = 5.0 * cos(angle), 5.0 * sin(angle), 0.0
        assert found.velocity([[50.0, 0.0, 10.0]], wind)[0] == pytest.approx(wind, abs=1e-5)


def test_where_the_roughness_changes_the_wind_is_as_smooth_between_cells_as_at_them():
    pond = Water(((30.0, -30.0), (90.0, -30.0), (90.0, 30.0), (30.0, 30.0)), level=0.01)
    found = solve(level(0.03)._replace(water=(pond,)), [0.0], 'sketch')
    start, step, count = found.atlas.origin[0], found.atlas.spacing[0], found.cells.ratios.shape[1]
    cells, finer = start + step * np.arange(count), start + 0.1 * step * np.arange(10 * count - 9)
    for height in (2.0, 10.0, 30.0):
        at_cells, between = (
            found.velocity([(x, 0.0, height) for x in places], (8.0, 0.0, 0.0))[:, 0]
            for places in (cells, finer)
        )
        assert between == pytest.approx(np.interp(finer, cells, at_cells), rel=0.05)


def test_more_directions_than_a_field_may_have_are_refused(monkeypatch):
    from golf_sim_ros.wind import solving

    monkeypatch.setattr(solving, 'MOST_NUMBERS', 100000)
    with pytest.raises(ValueError, match='16 directions are too many for [0-9]+ x [0-9]+ x'):
        solve(level(), 16, 'sketch')


def test_progress_is_told_by_direction_step_and_change():
    told = []
    solve(mounds(), [0.0, 2.0], 'sketch', lambda *one: told.append(one))
    assert {number for number, _, _ in told} == {0, 1}
    steps = [step for number, step, _ in told if number == 1]
    assert steps == list(range(1, len(steps) + 1))
    assert told[-1][2] < 1e-3


def test_what_does_not_converge_is_an_error_of_one_line(monkeypatch):
    from golf_sim_ros.wind import accuracy

    hasty = accuracy.ACCURACY['sketch']
    march = hasty.march._replace(steps=2, allowed=1e-9)
    monkeypatch.setitem(accuracy.ACCURACY, 'sketch', hasty._replace(march=march))
    with pytest.raises(NotConverged, match='after 2 steps the flow still changes by') as told:
        solve(mounds(), 1, 'sketch')
    assert '\n' not in str(told.value)


@pytest.mark.parametrize('directions', [0, -3, 1.5, 1000, [], [float('nan')], [[1.0, 2.0]]])
def test_directions_that_make_no_sense_are_refused(directions):
    with pytest.raises(ValueError, match='directions'):
        solve(level(), directions)


def test_an_unknown_accuracy_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match="'good' is unknown; known: mass, sketch, standard"):
        solve(level(), 4, 'good')


def test_a_profile_that_is_no_logarithm_is_refused():
    course = Course((Plane(),), wind_profile=UniformProfile())
    with pytest.raises(FieldError, match='needs a logarithmic wind_profile'):
        solve(course, 4, 'sketch')


def test_solving_without_numba_says_in_one_line_what_to_install():
    code = (
        "import sys; sys.modules['numba'] = None\n"
        'from golf_sim_ros.wind import solve\n'
        'from golf_sim_ros.physics import Course, EngineUnavailable, Plane\n'
        'try: solve(Course((Plane(),)))\n'
        'except EngineUnavailable as error: print(error)'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True)
    (line,) = done.stdout.splitlines()
    assert line.startswith('solving for a wind field needs numba: ') and 'pip install' in line
