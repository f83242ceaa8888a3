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

"""Whatever happens in the physics, a shot has an end: what is not a number any more has failed."""

import json
from math import inf, isfinite, nan
from pathlib import Path
import shutil

from driving_range import level, TURF
from golf_sim_ros.course import load_course, shipped_courses
from golf_sim_ros.physics import Phase, Result, simulate_many, World
from golf_sim_ros.physics.properties.air import Air
from golf_sim_ros.physics.result import Collision
from golf_sim_ros.physics.state.ball import BALL
from golf_sim_ros.physics.state.serialize import restored
from golf_sim_ros.recording.json_format import ball_text, collision_text, result_text
import numpy as np
import pytest

CASES = Path(__file__).parents[1] / 'data' / 'cases'
DRIVE, PUTT = (60.0, 1.0, 15.0), (2.0, 0.0, 0.0)


@pytest.fixture
def case(tmp_path):
    """Give a function of a case file's name that loads its course."""
    shutil.copy(shipped_courses()['putting_green'].with_suffix('.npy'), tmp_path)

    def load(name):
        return load_course(shutil.copy(CASES / f'{name}.yaml', tmp_path))

    return load


def played(world, seconds=400.0, tick=0.02):
    """Play all that moves, so many seconds at most: the results."""
    events = []
    while world.moving and world.time < seconds:
        events += world.advance(tick)
    return [event for event in events + world.happened() if isinstance(event, Result)]


def told_well(result):
    """Assert that all numbers of a result are finite and that it can be told."""
    numbers = [x for x in result if isinstance(x, float)]
    assert all(map(isfinite, (*numbers, *result.position)))
    json.loads(result_text(result, 1))


@pytest.mark.parametrize(
    'velocity', [DRIVE, (70.0, 0.0, 14.0), (0.0, 0.0, 150.0), (-100.0, 0.0, 1.0)]
)
def test_a_ball_of_a_metre_in_air_of_100_bar_is_stopped_by_it_and_comes_to_rest(case, velocity):
    world = World(case('not_a_number'))
    world.strike('ball', velocity)
    (result,) = played(world)
    told_well(result)
    assert result.status == 'at_rest'
    assert result.total < 3.0


def test_the_recorded_shots_of_a_ball_of_a_milligram_have_finite_ends(case):
    world = World(case('not_a_number_2'), accuracy='sketch')
    for velocity, spin, place in json.loads((CASES / 'not_a_number_2.json').read_text())['par'][
        'shots'
    ]:
        if place:
            world.place('ball', place)
        if world['ball'].phase != Phase.REST:
            world.reset()
        world.strike('ball', velocity, spin)
        for result in played(world, world.time + 400.0, 0.1):
            told_well(result)
            assert result.status in ('at_rest', 'out_of_bounds', 'failed', 'holed')
        assert world['ball'].phase in (Phase.REST, Phase.HOLED)


def test_air_that_is_no_number_ends_the_shot_as_failed_and_the_ball_goes_back():
    world = World(level(TURF)._replace(air=Air(pressure=inf)))
    before = world['ball']
    world.strike('ball', DRIVE)
    (result,) = world.happened()
    assert (result.status, result.shot, result.velocity) == ('failed', 1, DRIVE)
    assert result.reason == 'its motion was not a number any more, 0 s after the strike'
    told_well(result)
    assert world['ball'] == before
    world.strike('ball', PUTT)
    (result,) = played(world)
    assert (result.status, result.shot) == ('at_rest', 2)
    assert world.failures == 1 and world.last_failure.startswith('ball: its motion')


@pytest.mark.parametrize('field', ['origin', 'position_coefficients', 'spin_coefficients'])
@pytest.mark.parametrize('number', [nan, inf])
def test_a_state_that_is_no_number_ends_its_own_shot_only(field, number):
    world = World(level(TURF), ('red', 'blue'))
    world.strike('red', DRIVE)
    world.strike('blue', DRIVE)
    alone = World(level(TURF), ('red', 'blue'))
    alone.strike('red', DRIVE)
    alone.strike('blue', DRIVE)
    for one in (world, alone):
        assert one.advance(1.0) == []
    world._balls[field][1] = number
    for one in (world, alone):
        one.set_wind((0.0, 0.0, 0.001))  # segments begin anew from the state as it is
    expected = {result.ball: result for result in played(alone)}
    found = {result.ball: result for result in played(world)}
    assert found['blue'].status == 'failed' and found['blue'].carry == found['blue'].total == 0.0
    # It begins a new segment.
    assert found['red'].position == pytest.approx(expected['red'].position, abs=1e-2)
    told_well(found['blue'])
    assert world['blue'].phase == Phase.REST and world['blue'].position[:2] == world.course.tee[
        :1
    ] + (0.25,)


def test_a_placed_ball_that_is_no_number_goes_back_to_where_it_was_placed():
    world = World(level(TURF))
    world.place('ball', (3.0, 4.0), velocity=(1.0, 0.0, 0.0))
    world._balls['spin'][0] = nan
    world._balls['end'], world._balls['ending'] = world._now, 6  # LAUNCH
    assert played(world) == []
    assert world.failures == 1
    assert world['ball'].phase == Phase.REST and world['ball'].position[:2] == (3.0, 4.0)


def test_of_many_shots_those_that_are_no_number_have_failed():
    course = level(TURF)._replace(air=Air(pressure=inf))
    ends = simulate_many(course, [DRIVE, PUTT, DRIVE], np.zeros((3, 3)))
    assert list(ends['status']) == ['failed', 'at_rest', 'failed']
    good = simulate_many(level(TURF), [PUTT], np.zeros((1, 3)))
    assert ends['position'][1].tolist() == good['position'][0].tolist()


def test_a_collision_that_is_no_number_is_told_with_null():
    collision = Collision(1.0, 'ball', 'bounce', 'turf', *[(nan, inf, -0.0)] * 7)
    told = json.loads(collision_text(collision))
    assert told['position'] == [None, None, -0.0] and told['impulse'] == [None, None, -0.0]


def test_a_ball_whose_record_holds_no_numbers_comes_back_from_the_journal_to_the_bit():
    ball = np.zeros((), BALL)
    ball['phase'], ball['end'], ball['span'], ball['micro_bounce_end'] = (
        Phase.FLIGHT,
        1.5,
        1.5,
        inf,
    )
    ball['stages'][3, 4], ball['time_stepping'] = nan, 1
    again = restored(json.loads(ball_text(ball)))
    for name in BALL.names:
        assert np.array_equal(again[name], ball[name], equal_nan=True), name


def test_a_ball_from_an_older_journal_has_zeros_in_what_it_lacks():
    ball = np.zeros((), BALL)
    ball['phase'], ball['end'], ball['begin'] = Phase.FLIGHT, 1.5, 0.5
    values = json.loads(ball_text(ball))
    for name in ('failed', 'counted_until', 'segments_spent'):
        del values[name]
    assert restored(values)['segments_spent'] == 0
