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

"""The effect wind_field: what of a field a ball in flight feels, and when it is on."""

from math import cos, pi, sin

from driving_range import DRIVE, TURF
from golf_sim_ros.course import load_course
from golf_sim_ros.course.package_files import share
from golf_sim_ros.physics import Course, LogProfile, Plane, Shot, simulate, World
from golf_sim_ros.physics.effects import choose, EFFECTS, protocol, Scene, wind_at, wind_field
from golf_sim_ros.physics.effects.wind_field import blended, directions_beside, WindAtlas
from golf_sim_ros.physics.engine.engines import missing
from golf_sim_ros.physics.jit import borrowed, compiled, entry
from golf_sim_ros.physics.scene.kernel_model import bare_ground
from golf_sim_ros.wind import WindField
import numpy as np
import pytest

ROUGHNESS = 0.02


def atlas(directions=8, disturbed=0.0):
    """Field over level ground, with disturbances of that size."""
    angles = 2.0 * pi * np.arange(directions) / directions
    ratios = np.zeros((directions, 6, 5, 7, 4), np.float32)
    ratios[..., 0] = np.cos(angles)[:, None, None, None]
    ratios[..., 1] = np.sin(angles)[:, None, None, None]
    ratios[..., 3] = 0.15
    ratios += disturbed * np.random.default_rng(1).standard_normal(ratios.shape)
    rough = np.full((6, 5), -np.log(ROUGHNESS))
    return WindAtlas(
        angles,
        ratios.astype(np.float32),
        rough,
        (0.0, -60.0),
        (40.0, 30.0),
        3.0,
        0.2,
        0.0,
        300.0,
        ROUGHNESS,
    )


def course(field=None):
    """Level turf with a field, or with the logarithmic profile that it is of."""
    return Course((Plane(material=TURF),), wind_profile=LogProfile(ROUGHNESS), wind_field=field)


def drive(played, wind, **more):
    """Play a drive; its result."""
    return simulate(played, Shot(*map(tuple, DRIVE)), wind=wind, rate=5.0, **more).result


def test_where_a_course_has_a_field_it_blows_in_place_of_the_profile():
    windy = Scene(course(atlas()), live={'wind': (5.0, 0.0, 0.0)})
    chosen = choose('auto', windy)
    assert 'wind_field' in chosen.on and chosen.off['wind'] == 'the course has a wind field'
    chosen = choose('auto', windy._replace(course=course()))
    assert 'wind' in chosen.on and chosen.off['wind_field'] == 'the course has no wind field'
    assert choose('auto', windy._replace(live={})).off['wind_field'] == 'no wind'


def test_both_at_once_are_refused_where_both_would_blow():
    with pytest.raises(ValueError, match="'wind' and 'wind_field' are two laws for the same here"):
        World(course(atlas()), effects=('gravity', 'wind', 'wind_field'))
    World(course(), effects=('gravity', 'wind', 'wind_field'))


@pytest.mark.parametrize('wind', [(8.0, 0.0, 0.0), (-8.0, 0.0, 0.0), (1.5, 7.0, 0.0)])
def test_over_level_ground_a_drive_lands_as_in_the_logarithmic_law(wind):
    by_field = drive(course(atlas()), wind, accuracy='reference', engine='python')
    by_law = drive(course(), wind, accuracy='reference', engine='python')
    assert by_field.carry == pytest.approx(by_law.carry, abs=1e-3)
    assert by_field.carry_side == pytest.approx(by_law.carry_side, abs=1e-3)


@pytest.mark.parametrize('turbulence', [0.0, (0.145, 2)])
def test_a_putt_is_moved_by_its_gusts_as_by_those_of_the_law(turbulence):
    speed, radius = 2.0, 0.021335
    shot = Shot((speed, 0.0, 0.0), (0.0, speed / radius, 0.0))
    gusts = [(0.0, 0.0, 9.0, 0.0), (0.7, 3.0, 12.0, 0.0), (1.6, -4.0, 10.0, 0.0)]
    by_field, by_law = (
        simulate(played, shot, wind=gusts, turbulence=turbulence, engine='python').result
        for played in (course(atlas()), course())
    )
    still = simulate(course(), shot, engine='python').result
    assert by_law.side - still.side > 0.005
    if turbulence:  # whose strength is that of the field, here nearly the same
        assert by_field.side - still.side > 0.005
    else:
        assert by_field.position == pytest.approx(by_law.position, abs=1e-5)


def test_it_is_what_the_field_says_at_every_place():
    played = load_course('tall_pines')
    field = WindField.load(share('config', 'courses', 'tall_pines_wind.npz'))
    ground = bare_ground(played)
    wind = (5.0, -3.0, 0.0)
    effect = blended(played.wind_field, wind)
    random = np.random.default_rng(2)
    for x, y in random.uniform((-20.0, -60.0), (200.0, 60.0), (60, 2)):
        # heights as the field knows them, for its raster is not the height map
        ground_here = float(field.survey.heights_at(x, y))
        place = (x, y, ground_here + random.uniform(0.0, 40.0))
        above = place[2] - ground_here
        found = wind_field.wind_above(effect, place, above)
        assert found == pytest.approx(field.velocity([place], wind)[0], abs=1e-9)
    assert wind_at((effect,), ground, (-500.0, 0.0, 5.0)) == pytest.approx(
        wind_at((effect,), ground, (-5000.0, 0.0, 5.0)), abs=1e-9
    )  # beyond the land it goes on as at its edge


def test_it_and_its_gradient_are_continuous():
    effect = blended(atlas(disturbed=0.3), (6.0, 2.0, 0.0))
    step = 1e-4
    for axis, reach in ((0, 280.0), (1, 190.0), (2, 120.0)):
        line = np.zeros((int(reach / 0.5), 3))
        line[:] = (70.0, -13.0, 9.0)
        line[:, axis] = np.arange(len(line)) * 0.5 - (40.0 if axis == 0 else 95.0 if axis else 0.0)
        if axis == 2:
            line[:, 2] = 0.01 + np.arange(len(line)) * 0.5

        def at(where):
            return np.array(wind_field.wind_above(effect, tuple(where), where[2]))

        shift = step * np.eye(3)[axis]
        for place in line:
            before, here, after = at(place - shift), at(place), at(place + shift)
            assert abs(after - before).max() < 0.3  # of 7 m/s
            bend = (after - 2.0 * here + before) / step  # jump of the gradient, if any
            assert abs(bend).max() < (60.0 * step if place[2] > 1.0 else 1e3)


def test_below_the_lowest_cell_it_is_the_wall_law():
    effect = blended(atlas(disturbed=0.2), (6.0, 2.0, 0.0))
    low, lower = (
        np.array(wind_field.wind_above(effect, (70.0, -13.0, z), z)) for z in (0.2, 0.02)
    )
    assert lower == pytest.approx(
        low * np.log1p(0.02 / ROUGHNESS) / np.log1p(0.2 / ROUGHNESS), rel=1e-9
    )
    assert wind_field.wind_above(effect, (70.0, -13.0, 0.0), 0.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize('directions', [3, 4, 8, 16])
def test_between_two_directions_their_vectors_make_the_wind(directions):
    angles = 2.0 * pi * np.arange(directions) / directions
    for angle in np.linspace(-7.0, 7.0, 57):
        wind = 3.0 * cos(angle), 3.0 * sin(angle), 0.0
        low, high, first, second = directions_beside(angles, wind)
        made = [first * f(angles[low]) + second * f(angles[high]) for f in (np.cos, np.sin)]
        assert made == pytest.approx(wind[:2], abs=1e-12)
        assert first >= -1e-12 and second >= -1e-12


@pytest.mark.parametrize('angles', [[4.0, 5.0, 6.0], [3.5, 5.0], [0.1, 2.0, 6.2]])
def test_uneven_directions_have_the_wind_between_them(angles):
    for angle in np.linspace(-7.0, 7.0, 57):
        _, _, first, second = directions_beside(np.array(angles), (cos(angle), sin(angle), 0.0))
        assert first >= -1e-12 and second >= -1e-12


@pytest.mark.parametrize('angles', [[0.5], [0.0, pi]])
def test_with_few_directions_the_speed_is_shared(angles):
    for angle in np.linspace(0.0, 2.0 * pi, 13):
        _, _, first, second = directions_beside(np.array(angles), (cos(angle), sin(angle), 0.0))
        assert first + second == pytest.approx(1.0) and min(first, second) >= -1e-12


def test_a_gust_scales_and_turns_it():
    one = blended(atlas(disturbed=0.2), (4.0, 1.0, 0.0))
    wind = (-3.0, 2.0, 0.0)
    protocol.set_live(one, np.array(wind))
    assert one.now == pytest.approx(blended(atlas(disturbed=0.2), wind).now, abs=1e-12)
    twice = blended(atlas(disturbed=0.2), (-6.0, 4.0, 0.0))
    assert twice.now == pytest.approx(2.0 * one.now, abs=1e-12)


def test_live_wind_on_a_course_with_a_field_changes_a_flight():
    ends = []
    for gust in ((0.0, 0.0, 0.0), (0.0, 6.0, 0.0)):
        world = World(course(atlas()), wind=(3.0, 0.0, 0.0), engine='python')
        world.strike('ball', *map(tuple, DRIVE))
        world.advance(1.0)
        world.set_wind(gust)
        world.advance(2.0)
        ends.append(world['ball'].position)
    assert ends[1][1] - ends[0][1] > 1.0


def test_a_course_without_a_field_needs_the_program_that_it_needed_before():
    for wind in ((0.0, 0.0, 0.0), (5.0, 0.0, 0.0)):
        program = World(course(), wind=wind, engine='python').program
        assert 'WindField' not in program and 'Turbulence' not in program


def test_on_a_course_with_a_field_no_wind_needs_the_program_that_wind_needs():
    programs = {
        World(course(atlas()), wind=wind, engine='python').program
        for wind in ((0.0, 0.0, 0.0), (5.0, 0.0, 0.0))
    }
    assert len(programs) == 1 and 'WindField' in programs.pop()


def test_air_that_stands_still_does_nothing():
    effect = EFFECTS['wind_field'].dormant(Scene(course(atlas())))
    ground = bare_ground(course())
    assert wind_at((effect,), ground, (10.0, 0.0, 5.0)) == (0.0, 0.0, 0.0)
    assert EFFECTS['wind_field'].dormant(Scene(course())) is None


@entry
def read(effect, places):
    """Sum of the winds at `places`."""
    effect = borrowed(effect)
    x = y = z = 0.0
    for i in range(len(places)):
        u, v, w = wind_field.wind_above(
            effect, (places[i, 0], places[i, 1], places[i, 2]), places[i, 2]
        )
        x += u
        y += v
        z += w
    return x, y, z


def test_compiled_it_says_the_same():
    if missing():
        pytest.skip(missing())
    effect = blended(atlas(disturbed=0.3), (6.0, 2.0, 0.0))
    places = np.random.default_rng(0).uniform((-50, -90, 0), (250, 90, 60), (50, 3))
    assert compiled(read)(effect, places) == pytest.approx(read(effect, places), rel=1e-12)
