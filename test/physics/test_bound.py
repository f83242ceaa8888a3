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

"""The bound on a path's segments: the same end at every rate, in any call, and in many shots.

The bound itself is half a minute of plain Python, so that these play with less.
"""

from math import atan, cos, sin, tan

from golf_sim_ros.physics import (
    Course,
    Heightmap,
    Material,
    Patch,
    Plane,
    Restitution,
    Shot,
    simulate,
    simulate_many,
    World,
)
from golf_sim_ros.physics.properties.material import STANDARD_GRAVITY
from golf_sim_ros.physics.trajectory import shot_record as shot_
import numpy as np
from other_process import run
import pytest

SMOOTH = Material('smooth', Restitution(0.5), 0.0, 0.0, 0.0, 0.0)
EASY, FEW = 1000.0, 2000
RATES = (50.0, 250.0, 1000.0)
ALONG, SPIN = (0.0, 2.0, 0.0), (0.0, 0.0, 0.0)


def groove():
    """Make a course whose tee is in a groove along y.

    What two surfaces hold takes 5000 segments a second.
    """
    half = 0.5**0.5
    sides = [
        Patch((side, 0.0, 1.0), (-side * half, 0.0, half), 0.0, 2.0 / half, 400.0, SMOOTH)
        for side in (1.0, -1.0)
    ]
    return Course((Plane((0.0, 0.0, -5.0), material=SMOOTH), *sides), effects=('gravity',))


def ends():
    """Figures of the failed shot at each rate, in one long call, in `simulate` and among many."""
    shot_.SUSTAINED_WORK, shot_.MOST_WORK = EASY, FEW
    told = []
    for rate in RATES:
        world = World(groove())
        world.strike('ball', ALONG, SPIN)
        events = []
        while world.moving:
            events += world.advance(1.0 / rate)
        told.append(events[-1])
        told.append((world.failures, world['ball'].position, world['ball'].phase.name))
    world = World(groove())
    world.strike('ball', ALONG, SPIN)
    told.append(world.advance(100.0)[-1])
    told.append(simulate(groove(), Shot(ALONG, SPIN)).result)
    many = simulate_many(groove(), [ALONG, ALONG], np.zeros((2, 3)))
    return told, [(str(one['status']), float(one['duration'])) for one in many]


@pytest.fixture(scope='module')
def told():
    return run(ends)


def test_a_shot_that_takes_too_much_work_fails_at_the_same_instant_at_every_rate_and_in_one_call(
    told,
):
    results = [one for one in told[0] if len(one) > 3]
    assert len(results) == len(RATES) + 2
    assert all(result[2] == 'failed' for result in results)
    for result in results:
        assert result == results[0]
    reason = results[0][19]
    assert reason.startswith('its path took more than ') and ' s after the strike' in reason
    assert 0.1 < results[0][9] < 1.0  # duration [s]


def test_the_ball_is_back_at_the_tee_and_the_failure_is_counted(told):
    for failures, position, phase in (one for one in told[0] if len(one) == 3):
        assert (failures, phase) == (1, 'REST') and position[:2] == [0.0, 0.0]


def test_among_many_shots_it_fails_at_the_same_instant(told):
    results, many = told
    assert many == [['failed', results[0][9]]] * 2


def test_what_two_surfaces_hold_adds_nothing_up():
    world = World(groove(), effects=('gravity',))
    world.strike('ball', ALONG, SPIN)
    for _ in range(2):
        assert world.advance(0.03) == []
        assert 0 < world._balls['segments_spent'][0] < 100


@pytest.mark.parametrize('speed', [1e-3, 1e-5, 1e-7])
@pytest.mark.parametrize('friction, lift', [(0.0, 0.0), (0.0, 1e-4), (0.5, 1.5e-5), (0.5, 1e-3)])
def test_slow_rolling_that_nothing_brakes_takes_few_segments(speed, friction, lift, monkeypatch):
    """Without grip, or in micro-bounces, rolling resistance has nothing to brake with."""
    monkeypatch.setattr(shot_, 'SUSTAINED_WORK', 0.0)
    turf = Material('turf', Restitution(0.5), 0.0, friction, friction, 0.1)
    heights = Heightmap(np.zeros((21, 21)), (-10.0, -10.0), 1.0, turf)
    world = World(Course((heights,), effects=('gravity',)), engine='python')
    height = world['ball'].position[2]
    spin = (0.0, speed / height, 0.0)
    world.place('ball', (0.0, 0.0, height + lift), (speed, 0.0, 0.0), spin)
    world.advance(1.0)
    assert world._balls['segments_spent'][0] < 100
    if friction == 0.0:
        assert world['ball'].position[0] == pytest.approx(speed, rel=1e-9)


@pytest.mark.parametrize('excess', [1e-2, 1e-3, 1e-5, -1e-5])
@pytest.mark.parametrize('aside', [0.0, 1e-4])
def test_a_slope_that_hardly_drives_a_ball_takes_few_segments(excess, aside, monkeypatch):
    """The direction of a slow ball is stiff: resistance turns it within speed over resistance."""
    monkeypatch.setattr(shot_, 'SUSTAINED_WORK', 0.0)
    resistance, speed, time = 0.05, 0.0 if excess > 0.0 else 1e-3, 0.5
    turf = Material('turf', Restitution(0.5), 0.0, 0.5, 0.4, resistance)
    # The component of weight along the slope, 5/7 of it, over resistance: 1 + excess.
    tilt = atan(1.4 * resistance * (1.0 + excess))
    x = np.arange(-10.0, 11.0)
    heights = Heightmap(np.tile(-tan(tilt) * x, (21, 1)), (-10.0, -10.0), 1.0, turf)
    world = World(Course((heights,), effects=('gravity',)), engine='python')
    start, radius = np.array(world['ball'].position), world['ball'].position[2] * cos(tilt)
    down, normal = np.array((cos(tilt), 0.0, -sin(tilt))), np.array((sin(tilt), 0.0, cos(tilt)))
    velocity = speed * down + (0.0, aside, 0.0)
    world.place('ball', start, velocity, np.cross(normal, velocity) / radius)
    world.advance(time)
    assert world._balls['segments_spent'][0] < 150
    net = resistance * STANDARD_GRAVITY * cos(tilt) * excess
    within = 1e-6 + aside * time
    assert (np.array(world['ball'].position) - start) @ down == pytest.approx(
        speed * time + 0.5 * net * time**2, abs=within
    )


def test_a_ball_in_a_narrow_hollow_does_not_use_up_its_work(monkeypatch):
    """Its centre is near several points of the ground there, and each takes a search."""
    monkeypatch.setattr(shot_, 'SUSTAINED_WORK', 0.0)
    heights = np.zeros((5, 5))
    heights[2, 2], heights[2, 4] = 0.375, 0.25
    ground = Heightmap(heights, (-1.0, -1.0), 0.5, SMOOTH)
    course = Course((Plane((0.0, 0.0, -1.0), material=SMOOTH), ground), tee=(9.0, 0.0))
    world = World(course, effects=('gravity',), accuracy='reference', engine='python')
    world.place('ball', (0.9, 0.0, 0.3), (-2.0, 0.0, 0.0))
    world.advance(0.45)
    assert 0 < world._balls['segments_spent'][0] < 10_000
