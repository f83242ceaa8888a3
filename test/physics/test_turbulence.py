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

"""Turbulence: the box of eddies, and how balls fly through it."""

from math import sqrt

from driving_range import DRIVE, TURF
from golf_sim_ros.physics import Course, Plane, Shot, simulate, simulate_many, World
from golf_sim_ros.physics.effects import EFFECTS, Scene
from golf_sim_ros.physics.effects import turbulence as turbulence_
from golf_sim_ros.physics.effects.turbulence import box_of, eddies, eddy_at, energy, wave_angles
from golf_sim_ros.physics.scene.kernel_model import bare_ground
import numpy as np
import pytest
from test_wind_field import atlas

NODES, SPACING, SCALE = (64, 64, 32), 4.0, 30.0
FLAT = Course((Plane(material=TURF),))
WIND = (8.0, 0.0, 0.0)
STRIKE = tuple(map(tuple, DRIVE))


def record(wind=WIND, intensity=0.145, seed=1, course=FLAT):
    """Record of the effect."""
    return EFFECTS['turbulence'].record(
        Scene(course, live={'wind': wind, 'turbulence': (intensity, float(seed), 0.0, 0.0, 0.0)})
    )


def transformed(box):
    """Fourier coefficients of a box, and the wave numbers that they are of [rad/m]."""
    waves = [angle / SPACING for angle in wave_angles(box.shape[:3])]
    return np.fft.rfftn(box, axes=(0, 1, 2)), waves


def test_the_box_has_no_divergence():
    coefficients, waves = transformed(eddies(3, NODES, SPACING, SCALE))
    divergence = sum(k * coefficients[..., axis] for axis, k in enumerate(waves))
    size = np.sqrt(sum(k * k for k in waves)) * np.linalg.norm(coefficients, axis=-1)
    assert abs(divergence).max() < 1e-10 * size.max()


def test_its_spectrum_is_that_of_von_karman():
    shells = np.linspace(0.02, 0.6, 12)
    found, expected = np.zeros(11), np.zeros(11)
    for seed in range(6):
        coefficients, waves = transformed(eddies(seed, NODES, SPACING, SCALE))
        size = np.sqrt(sum(k * k for k in waves))
        power = (abs(coefficients) ** 2).sum(-1)
        for n in range(11):
            shell = (size >= shells[n]) & (size < shells[n + 1])
            found[n] += power[shell].mean()
            expected[n] += (energy(size[shell], SCALE) / size[shell] ** 2).mean()
    ratio = found / expected
    assert ratio / ratio.mean() == pytest.approx(1.0, abs=0.12)


def test_its_variance_is_that_of_the_waves_that_it_resolves():
    coefficients, waves = transformed(eddies(0, NODES, SPACING, SCALE))
    square = sum(k * k for k in waves)
    square[0, 0, 0] = 1.0
    expected = 2.0 * energy(np.sqrt(square), SCALE) / square  # of three components, two are free
    expected[0, 0, 0] = 0.0
    for angle in wave_angles(NODES):
        expected[abs(angle) == np.pi] = 0.0
    twice = np.full(square.shape, 2.0)
    twice[..., 0] = twice[..., -1] = 1.0
    theory = (twice * expected).sum() / np.prod(NODES)
    found = np.mean(
        [(eddies(seed, NODES, SPACING, SCALE) ** 2).sum(-1).mean() for seed in range(8)]
    )
    assert found == pytest.approx(theory, rel=0.1)


def test_what_is_read_has_the_variance_that_is_said():
    effect = record()
    places = np.random.default_rng(0).uniform(0.0, 512.0, (4000, 3))
    effect.clock[0] = 0.0
    read = np.array([eddy_at(effect, tuple(place)) for place in places])
    assert read.std(0) == pytest.approx(1.0, abs=0.06)
    assert read.mean(0) == pytest.approx(0.0, abs=0.08)


def winds(effect, course=FLAT, height=20.0, count=3000, seed=0):
    """Winds of an effect at random places of that height."""
    ground = bare_ground(course)
    places = np.random.default_rng(seed).uniform(0.0, 512.0, (count, 2))
    say = turbulence_.protocol.air_velocity
    return np.array([say(effect, ground, (x, y, height)) for x, y in places])


@pytest.mark.parametrize('wind', [(8.0, 0.0, 0.0), (0.0, -5.0, 0.0)])
def test_its_deviation_is_the_intensity_of_the_wind_less_across_and_up(wind):
    speed = np.linalg.norm(wind)
    told = winds(record(wind)) / (0.145 * speed)
    along = told @ np.array(wind) / speed
    across = told[:, :2] @ np.array([-wind[1], wind[0]]) / speed
    # the box is 128 m high: at one height it does not pass all of its eddies
    assert (along.std(), across.std(), told[:, 2].std()) == pytest.approx(
        (1.0, 0.8, 0.55), rel=0.25
    )


def test_in_a_field_its_deviation_is_that_of_the_field():
    course = FLAT._replace(wind_field=atlas())
    inside, outside = (winds(record(intensity=0.9, course=course)), winds(record(intensity=0.15)))
    assert inside == pytest.approx(outside, rel=1e-5)


def test_near_the_ground_no_air_goes_up():
    effect = record()
    assert abs(winds(effect, height=0.0, count=50)[:, 2]).max() == 0.0
    assert abs(winds(effect, height=0.5, count=200)[:, 2]).max() < 0.05
    assert winds(effect, height=15.0, count=200)[:, 2].std() > 0.2


def test_the_same_seed_has_the_same_eddies_and_another_one_others():
    one, same, other = (winds(record(seed=seed), count=20) for seed in (5, 5, 6))
    assert one.tobytes() == same.tobytes() and abs(one - other).max() > 0.3
    assert box_of(2).tobytes() == box_of(2).tobytes()


def test_the_wind_carries_it():
    effect = record()
    place, later = (100.0, 50.0, 20.0), (100.0 + 8.0 * 3.0, 50.0, 20.0)
    effect.clock[0] = 1.0
    before = eddy_at(effect, place)
    effect.clock[0] = 4.0
    assert eddy_at(effect, later) == pytest.approx(before, abs=1e-9)


def test_a_gust_does_not_make_it_jump():
    effect = record()
    place = (30.0, 20.0, 15.0)
    effect.clock[0] = 2.5
    before = eddy_at(effect, place)
    turbulence_.protocol.set_live(effect, np.array([-3.0, 9.0, 0.0]))
    assert eddy_at(effect, place) == pytest.approx(before, abs=1e-9)
    effect.clock[0] = 3.5
    carried = (30.0 - 3.0, 20.0 + 9.0, 15.0)
    assert eddy_at(effect, carried) == pytest.approx(before, abs=1e-9)


def test_it_is_on_only_where_it_is_asked_for():
    assert 'turbulence' not in World(FLAT, wind=WIND).effects_on
    world = World(FLAT, wind=WIND, turbulence=(0.1, 3))
    assert 'turbulence' in world.effects_on
    assert world.live['turbulence'][:2] == (0.1, 3.0)
    assert World(FLAT, turbulence=0.1).effects_off['turbulence'] == 'no wind'


@pytest.mark.parametrize(
    'value, reason',
    [
        (-0.1, 'not from 0 to 1'),
        (2.0, 'not from 0 to 1'),
        (float('nan'), 'not an intensity, a seed, and a drift'),
        ((0.1, 0.0, 0.0, 0.0, 0.0, 0.0), 'not an intensity, a seed, and a drift'),
        ((0.1, -1), 'not a whole number'),
        ((0.1, 1.5), 'not a whole number'),
    ],
)
def test_what_makes_no_sense_is_refused(value, reason):
    with pytest.raises(ValueError, match=reason):
        World(FLAT, turbulence=value)


def flown(world, gusts, ticks=500):
    """States at every tenth tick, of a flight in `gusts`, winds by tick."""
    told = []
    for tick in range(ticks):
        if tick in gusts:
            world.set_wind(gusts[tick])
        world.advance(1.0 / 250.0)
        if tick % 10 == 0:
            told.append((*world['ball'].position, *world['ball'].velocity))
    return told


GUSTS = {0: (7.0, 1.0, 0.0), 90: (4.0, -3.0, 0.0), 200: (9.0, 2.0, 0.0), 330: (2.0, 6.0, 0.0)}


@pytest.mark.parametrize('course', [FLAT, FLAT._replace(wind_field=atlas())], ids=['law', 'field'])
def test_a_world_restored_in_mid_flight_goes_on_to_the_bit(course):
    world = World(course, wind=WIND, turbulence=(0.145, 4), engine='python')
    world.advance(3.7)  # the air drifts while the ball rests, too
    world.strike('ball', *STRIKE)
    flown(world, {30: (3.0, 5.0, 0.0)}, 60)
    state = world.state()
    again = World(course, engine='python')
    again.restore(state)
    assert flown(again, GUSTS) == flown(world, GUSTS)
    assert again.live == world.live


def test_a_path_does_not_depend_on_the_tick():
    ends = []
    for ticks in (50, 400):
        world = World(FLAT, wind=WIND, turbulence=(0.145, 4), engine='python')
        world.strike('ball', *STRIKE)
        for _ in range(ticks):
            world.advance(4.0 / ticks)
        ends.append(world['ball'].position)
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)


def test_the_air_that_drifted_before_a_strike_is_other_air():
    ends = []
    for wait in (0.0, 10.0):
        world = World(FLAT, wind=WIND, turbulence=(0.145, 4), engine='python')
        world.advance(wait)
        world.strike('ball', *STRIKE)
        world.advance(4.0)
        ends.append(world['ball'].position)
    assert abs(ends[0][1] - ends[1][1]) > 0.1


def test_each_shot_of_a_batch_meets_other_eddies_and_the_first_those_of_a_single_one():
    velocities, spins = np.tile(STRIKE[0], (3, 1)), np.tile(STRIKE[1], (3, 1))
    more = {'wind': WIND, 'turbulence': (0.145, 2), 'engine': 'python'}
    found = simulate_many(FLAT, velocities, spins, **more)
    assert len(set(found['carry'])) == 3
    single = simulate(FLAT, Shot(*STRIKE), rate=5.0, **more).result
    assert single.carry == pytest.approx(found['carry'][0], abs=1e-9)


def test_a_batch_in_gusts_is_as_its_first_shot_alone():
    gusts = np.array([[0.0, 8.0, 0.0, 0.0], [1.5, 2.0, 5.0, 0.0], [3.0, -4.0, 1.0, 0.0]])
    more = {'wind': gusts, 'turbulence': (0.2, 2), 'engine': 'python'}
    for course in (FLAT, FLAT._replace(wind_field=atlas(disturbed=0.1))):
        found = simulate_many(course, [STRIKE[0]], [STRIKE[1]], **more)
        single = simulate(course, Shot(*STRIKE), rate=50.0, **more).result
        assert single.carry == pytest.approx(found['carry'][0], abs=1e-6)
        assert single.carry_side == pytest.approx(found['carry_side'][0], abs=1e-6)


def test_drives_scatter_as_far_as_they_should():
    carries, sides = [], []
    count = 12
    velocities, spins = np.tile(STRIKE[0], (count, 1)), np.tile(STRIKE[1], (count, 1))
    for seed in range(2):
        for wind in ((8.0, 0.0, 0.0), (-8.0, 0.0, 0.0), (0.0, 8.0, 0.0)):
            found = simulate_many(
                FLAT,
                velocities,
                spins,
                wind,
                turbulence=(0.145, seed),
                accuracy='sketch',
                engine='python',
            )
            carries.append(found['carry'].var())
            sides.append(found['carry_side'].var())
    assert 2.0 < sqrt(np.mean(carries)) < 6.5  # some 3.5 over many seeds
    assert 0.8 < sqrt(np.mean(sides)) < 2.6  # some 1.5
