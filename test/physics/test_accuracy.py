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

"""What the presets promise, and that a path depends on its strike alone.

It depends on no tick, process or compiler.
"""

from driving_range import (
    DRIVE,
    EVERYTHING,
    first_touches,
    HARD,
    hilly,
    launched,
    level,
    random_shots,
    TURF,
)
from golf_sim_ros.physics import ACCURACY, Collision, Result, Shot, simulate, simulate_many, World
from golf_sim_ros.physics.effects.wind import LogProfile, PowerProfile
import numpy as np
from other_process import run
import pytest

MATERIALS = {'turf': TURF, 'hard': HARD}


def distances(places, others):
    """Distance of each place from the other."""
    return np.linalg.norm(places - others, axis=1)


@pytest.fixture(scope='module', params=MATERIALS)
def thousands(request):
    """Thousands of shots over level ground: their velocities, and how they end by preset.

    Among those of seed 25 are some whose velocity sweeps past the spin's axis near the apex, so
    that the lift turns about within less than a step: they were 8 mm off once.
    """
    velocities, spins = map(
        np.concatenate, zip(*(random_shots(1000, seed) for seed in (9, 24, 25, 27)))
    )
    return velocities, {
        accuracy: simulate_many(
            level(MATERIALS[request.param]),
            velocities,
            spins,
            effects=EVERYTHING,
            accuracy=accuracy,
        )
        for accuracy in ACCURACY
    }


@pytest.mark.parametrize('accuracy', ['sketch', 'standard'])
def test_first_touches_are_as_close_to_reference_as_promised(thousands, accuracy):
    velocities, shots = thousands
    wrong = distances(
        *(first_touches(shots[name], velocities) for name in (accuracy, 'reference'))
    )
    assert (shots['reference']['flight_time'] > 0).all()
    assert 0 < wrong.max() < ACCURACY[accuracy].touch


@pytest.mark.parametrize('accuracy', ['sketch', 'standard'])
def test_rests_on_level_ground_are_as_close_to_reference_as_promised(thousands, accuracy):
    _, shots = thousands
    wrong = distances(shots[accuracy]['position'], shots['reference']['position'])
    assert (shots[accuracy]['status'] == 'at_rest').all()
    assert 0 < wrong.max() < ACCURACY[accuracy].rest


@pytest.mark.parametrize('profile', [LogProfile(), LogProfile(0.001), PowerProfile()])
def test_a_wind_that_sets_in_steeply_at_the_ground_is_not_overlooked(profile):
    course = level(TURF)._replace(wind_profile=profile)
    velocities, spins = map(np.array, zip(DRIVE, SHOTS['approach'], SHOTS['chip']))
    for wind in ((8.0, 0.0, 0.0), (0.0, 8.0, 0.0), (-8.0, 3.0, 0.0)):
        shots = [
            simulate_many(course, velocities, spins, wind=wind, accuracy=accuracy)
            for accuracy in ('standard', 'reference')
        ]
        wrong = distances(*(first_touches(ends, velocities) for ends in shots))
        assert 0 < wrong.max() < ACCURACY['standard'].touch


def test_the_promises_are_those_of_the_documentation():
    told = [(preset.touch, preset.rest) for preset in ACCURACY.values()]
    assert told == [(0.5, 1.0), (1e-3, 1e-2), (1e-6, 1e-4)]


SHOTS = {
    'drive': DRIVE,
    'approach': (launched(35.0, 0.5, 0.1), (20.0, -500.0, 60.0)),
    'chip': (launched(9.0, 0.6, -0.3), (0.0, -150.0, 0.0)),
    'putt': ((3.0, 1.0, 0.0), (0.0, 0.0, 0.0)),
    'into the ground': ((6.0, -2.0, -3.0), (100.0, 50.0, 300.0)),
}


def advanced(velocity, spin, accuracy, rate):
    """Play a shot in ticks: result, collisions, and places after every fiftieth of a second."""
    world = World(hilly(), effects=EVERYTHING, accuracy=accuracy)
    world.strike('ball', velocity, spin)
    events, places = [], [world['ball'].position]
    while not any(isinstance(event, Result) for event in events):
        for _ in range(rate // 50):
            events += world.advance(1 / rate)
        places.append(world['ball'].position)
    end = next(event for event in events if isinstance(event, Result))
    return end, [event for event in events if isinstance(event, Collision)], np.array(places)


def figures(record):
    """Numbers of a result or a collision, in one row; text and None left out."""
    return [
        number
        for field in record
        if field is not None and not isinstance(field, str)
        for number in np.atleast_1d(field)
    ]


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('name', SHOTS)
def test_a_path_does_not_depend_on_the_tick(name, accuracy):
    velocity, spin = SHOTS[name]
    whole = simulate(
        hilly(), Shot(velocity, spin), effects=EVERYTHING, accuracy=accuracy, rate=50.0
    )
    for rate in (50, 250, 1000):
        end, collisions, places = advanced(velocity, spin, accuracy, rate)
        assert (end.status, end.lie) == (whole.result.status, whole.result.lie)
        np.testing.assert_allclose(figures(end), figures(whole.result), rtol=0, atol=1e-9)
        assert len(collisions) == len(whole.collisions)
        for told, known in zip(collisions, whole.collisions):
            assert told.with_ == known.with_
            np.testing.assert_allclose(figures(told), figures(known), rtol=1e-12, atol=1e-9)
        np.testing.assert_allclose(
            places[:-1], whole.positions[: len(places) - 1], rtol=0, atol=1e-9
        )


def ends_of(n, accuracy='standard'):
    """Figures of `n` random shots to their end, over level turf and over hills."""
    velocities, spins = random_shots(n, seed=10)
    many = [
        simulate_many(course, velocities, spins, effects=EVERYTHING, accuracy=accuracy)
        for course in (level(TURF), hilly())
    ]
    keys = (
        'carry',
        'carry_side',
        'total',
        'side',
        'apex',
        'flight_time',
        'duration',
        'landing_speed',
    )
    return [
        [*(float(end[key]) for key in keys), *end['position'].tolist()]
        for ends in many
        for end in ends
    ]


@pytest.mark.parametrize('accuracy', ACCURACY)
def test_two_processes_agree_to_the_bit(accuracy):
    assert run(ends_of, 100, accuracy, plain=False) == ends_of(100, accuracy)


def test_a_world_that_played_before_agrees_to_the_bit_with_a_new_one():
    world = World(level(TURF), effects=EVERYTHING)
    rests = []
    for _ in range(3):
        world.place('ball', (0.0, 0.0))
        world.strike('ball', *DRIVE)
        rests.append(
            [event for event in world.advance(60.0) if isinstance(event, Result)][0].position
        )
        world.advance(0.1)
    assert len(set(rests)) == 1
    assert rests[0] == simulate(level(TURF), Shot(*DRIVE), effects=EVERYTHING).result.position


@pytest.mark.parametrize('accuracy', ACCURACY)
def test_plain_python_agrees_with_compiled_code(accuracy):
    np.testing.assert_allclose(
        run(ends_of, 10, accuracy), ends_of(10, accuracy), rtol=0, atol=1e-9
    )
