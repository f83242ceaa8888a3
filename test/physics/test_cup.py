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

"""The hole: which putts it takes follows from contact alone; what it takes lies on its bottom."""

from math import cos, hypot, sin, sqrt
import os

from golf_sim_ros.physics import (
    Collision,
    Course,
    ground_height,
    Material,
    Patch,
    PENNER,
    Phase,
    Plane,
    Rejected,
    Result,
    rolling_resistance_of_stimp,
    World,
)
from golf_sim_ros.physics.geometry.cup import DEPTH
from golf_sim_ros.physics.geometry.cup import RADIUS as HOLE
from golf_sim_ros.physics.geometry.solid import FLAGSTICK_RADIUS
import numpy as np
from oracles import RADIUS
import pytest
from scene import energy

PUTTS = int(os.environ.get('RANDOM_SHOTS', 300)) // 20
GREEN = Material('green', PENNER, 0.0, 0.45, 0.40, rolling_resistance_of_stimp(10), 0.002, 1.0)
SOON = 1e-4  # m before the rim
FAR = 0.3  # m from the hole: what gets there is not in it


def green(slope=0.0, heading=0.0, flagstick=False, patch=False):
    """World of a green with a hole at the origin; it rises by `slope` along `heading`."""
    normal = (-slope * cos(heading), -slope * sin(heading), 1.0)
    normal = tuple(part / sqrt(1 + slope * slope) for part in normal)
    middle = (0.0, 0.0, 0.0)
    ground = Patch(middle, normal, 0.0, 4.0, 4.0, GREEN) if patch else Plane(middle, normal, GREEN)
    return World(
        Course(
            (Plane((0.0, 0.0, -1.0), material=GREEN), ground),
            tee=(-1.0, 0.0),
            hole=(0.0, 0.0),
            flagstick=flagstick,
            effects=('gravity', 'turf'),
        )
    )


def roll(world, speed, aside, heading=0.0):
    """Let a ball roll at `speed` towards the hole, `aside` of its middle; return what it hits."""
    normal = np.array(world.course.ground[1].normal)
    ahead = np.array((cos(heading), sin(heading), 0.0))
    left = np.array((-ahead[1], ahead[0], 0.0))
    place = -(sqrt(max(HOLE**2 - aside**2, 0.0)) + SOON) * ahead + aside * left
    place[2] = -(normal @ place) / normal[2]
    velocity = ahead - (ahead @ normal) * normal
    velocity *= speed / np.linalg.norm(velocity)
    world.place('ball', place + RADIUS * normal, velocity, np.cross(normal, velocity) / RADIUS)
    hits = []
    while world.moving and hypot(*world['ball'].position[:2]) < FAR:
        last, start = energy(world.course, world['ball']), world.time
        hits += [event for event in world.advance(0.02) if isinstance(event, Collision)]
        ball = world['ball']
        inside(ball.position, world.course.flagstick)
        assert energy(world.course, ball) <= last + 1e-7, (start, speed, aside, heading)
    return hits


def inside(position, flagstick):
    """Assert that a ball in the hole is in neither wall, bottom nor flagstick."""
    away = hypot(*position[:2])
    if position[2] < -0.01 and away < HOLE:
        assert away < HOLE - RADIUS + 2e-6
    if flagstick and away < HOLE:
        assert away > FLAGSTICK_RADIUS + RADIUS - 2e-6


def escape_speed(world, aside, low, high):
    """Lowest speed, to 0.02 m/s, between `low`, which is holed, and `high`, which is not."""

    def is_holed(speed):
        roll(world, speed, aside)
        return world['ball'].phase == Phase.HOLED

    assert is_holed(low) and not is_holed(high)
    while high - low > 0.02:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_holed(middle) else (low, middle)
    return high


@pytest.mark.parametrize(
    'aside, low, high', [(0.0, 1.31, 2.3), (0.01, 1.40, 1.70), (0.5 * HOLE, 1.0, 1.4)]
)
def test_a_putt_is_too_fast_for_the_hole_where_published_analyses_say(aside, low, high):
    # Holmes, Am. J. Phys. 59 (1991) 129; Penner, Can. J. Phys. 80 (2002) 83. At 1.31 m/s a ball
    # across the middle has fallen by its radius when it meets the far rim.
    assert low <= escape_speed(green(), aside, low, high) <= high


@pytest.mark.parametrize('aside', [0.0, 0.005, -0.02, 0.03, 0.045])
def test_no_putt_of_3_m_s_is_holed(aside):
    world = green()
    roll(world, 3.0, aside)
    assert world['ball'].phase != Phase.HOLED and world['ball'].position[0] > 0


def test_a_lip_out_leaves_in_another_direction():
    world = green()
    hits = roll(world, 1.5, 0.5 * HOLE)
    x, y, _ = world['ball'].velocity
    assert hits and world['ball'].phase != Phase.HOLED
    assert abs(np.arctan2(y, x)) > np.radians(10)


@pytest.mark.parametrize('slope, patch', [(0.0, True), (0.02, False), (0.05, True)])
@pytest.mark.parametrize('flagstick', [False, True])
def test_a_holed_ball_rests_on_the_bottom(slope, patch, flagstick):
    world = green(slope, 0.7, flagstick, patch)
    for speed, heading in ((0.4, 0.0), (0.9, 2.0), (0.7, 4.0)):
        roll(world, speed, 0.012, heading)
        ball = world['ball']
        assert ball.phase == Phase.HOLED and np.linalg.norm(ball.velocity) < 1e-6
        assert ball.position[2] == pytest.approx(RADIUS - DEPTH - HOLE * slope, abs=1e-6)
        assert hypot(*ball.position[:2]) < HOLE - RADIUS + 1e-6 and ball.lie == 'cup'


def test_any_putt_at_the_hole_ends_holed_or_out_of_it_and_gains_no_energy():
    random = np.random.default_rng(4)
    worlds = [
        green(slope, heading, flagstick)
        for slope, heading, flagstick in (
            (0.0, 0.0, False),
            (0.0, 0.0, True),
            (0.03, 1.0, False),
            (0.05, 4.0, True),
        )
    ]
    for i in range(PUTTS):
        world = worlds[i % len(worlds)]
        roll(world, random.uniform(0.1, 3), random.uniform(-0.05, 0.05), random.uniform(0, 6.3))
        ball = world['ball']
        assert ball.phase == Phase.HOLED or hypot(*ball.position[:2]) > HOLE - 1e-6


def test_a_ball_dropped_between_flagstick_and_wall_falls_to_the_bottom():
    world = green(flagstick=True)
    middle = 0.5 * (HOLE + FLAGSTICK_RADIUS)
    world.place('ball', (middle, 0, 0.1))
    world.advance(3.0)
    assert world['ball'].phase == Phase.HOLED and world['ball'].position[2] == pytest.approx(
        RADIUS - DEPTH
    )


def test_a_fat_ball_wedged_between_flagstick_and_wall_comes_to_rest_there():
    world = green(flagstick=True)
    fat = world.course._replace(ball=world.course.ball._replace(radius=0.0235))
    world = World(fat)
    world.place('ball', (FLAGSTICK_RADIUS + fat.ball.radius + 1e-3, 0, 0.1))
    world.advance(5.0)
    ball = world['ball']
    assert not world.moving and -0.03 < ball.position[2] < 0.03


def test_the_flagstick_stops_a_putt_that_would_be_too_fast():
    bare, flagged = green(), green(flagstick=True)
    roll(bare, 2.3, 0.0)
    kinds = [hit.kind for hit in roll(flagged, 2.3, 0.0)]
    assert bare['ball'].phase != Phase.HOLED and flagged['ball'].phase == Phase.HOLED
    assert kinds[0] == 'flagstick' and 'cup' in kinds


def test_a_struck_ball_in_the_hole_is_holed_with_nothing_left_and_may_not_be_struck():
    world = green()
    world.strike('ball', (1.8, 0, 0))
    result = next(event for event in world.advance(20.0) if isinstance(event, Result))
    assert (result.status, result.to_hole, result.lie) == ('holed', 0.0, 'cup')
    with pytest.raises(Rejected, match='ball is holed'):
        world.strike('ball', (1, 0, 1))
    world.place('ball', (-0.5, 0.0))
    assert world['ball'].phase == Phase.REST


def test_a_putt_that_stops_short_or_passes_beside_is_left_on_the_green():
    world = green()
    world.strike('ball', (1.0, 0.0, 0))
    assert next(e for e in world.advance(20.0) if isinstance(e, Result)).status == 'at_rest'
    world.place('ball', (-1, 2 * HOLE))
    world.strike('ball', (1.8, 0, 0))
    result = next(e for e in world.advance(20.0) if isinstance(e, Result))
    assert result.status == 'at_rest' and result.position[1] == pytest.approx(2 * HOLE)


def test_the_ground_of_the_hole_is_that_around_it():
    assert ground_height(green(0.05, flagstick=True).course, 0.0, 0.0) == (
        pytest.approx(0.0),
        'green',
    )
