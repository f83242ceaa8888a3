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

"""Searches that are not made: what stands in for them is what they would have found."""

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import Shot, simulate, World
from golf_sim_ros.physics.engine import planner
from golf_sim_ros.physics.geometry import surfaces
from golf_sim_ros.physics.integrators import dormand_prince, runge_kutta
from golf_sim_ros.physics.state.ball import FLIGHT, ROLL, SLIDE
from golf_sim_ros.physics.trajectory.equations_of_motion import turning_surface
import numpy as np
from oracles import RADIUS
import pytest


def ground_of(name):
    """Ground of a shipped course, as kernels get it."""
    return World(load_course(name), engine='python')._model.land.ground


def test_the_room_around_a_place_is_that_to_the_nearest_of_all_borders():
    ground = ground_of('golf_without_friends')
    borders = ground.borders
    assert len(borders) > 10
    low = np.min([line['low'] for line in ground.border_lines], axis=0) - 5.0
    high = np.max([line['high'] for line in ground.border_lines], axis=0) + 5.0
    for x, y in np.random.default_rng(5).uniform(low, high, (200, 2)):
        least = min(surfaces.distance_in_plan(border, x, y)[0] for border in borders)
        assert surfaces.room_in_plan(ground, (x, y, 0.0)) == least


def test_the_hole_counts_wherever_its_edge_is_within_reach():
    """Of the ground near the hole, and of nothing that the hole has no part in."""
    ground = ground_of('putting_green')
    x, y, radius = ground.hole[:3]
    part = World(load_course('putting_green'), engine='python')._balls['support'][0]
    asked = cut = 0
    for away in np.linspace(0.0, 4.0 * radius, 60):
        for angle in np.linspace(0.0, 6.2, 9):
            px, py = x + away * np.cos(angle), y + away * np.sin(angle)
            place = (px, py, surfaces.top(ground, px, py)[0] + 0.5 * RADIUS)
            distance, _ = surfaces.nearest(ground, part, place)
            if abs(distance) < 2.0 * RADIUS:
                whole = surfaces.touchable(ground, part, place)
                assert surfaces.touchable_within(ground, part, place, 2.0 * RADIUS) == whole
                asked += 1
                cut += not whole
    assert asked > 200 and 50 < cut < asked


@pytest.mark.parametrize('accuracy', ['sketch', 'standard', 'reference'])
def test_a_step_on_the_ground_begins_with_the_surface_that_the_one_before_found(
    accuracy, monkeypatch
):
    kept = []

    def compare(land, ball, now):
        goes_on = ball['stages'][-1][7] == 1.0 and ball['stages'][-1][8] == now
        place, motion = tuple(ball['position']), tuple(ball['velocity'])
        found = turning_surface(land, ball, place, motion)
        surface = plain(land, ball, now)
        if goes_on:
            kept.append(
                (
                    abs(surface[0] - found[0]),
                    np.abs(np.subtract(surface[1], found[1])).max(),
                    np.abs(np.subtract(surface[2], found[2])).max()
                    / (1e-3 + np.abs(found[2]).max()),
                )
            )
        return surface

    plain = planner.surface_at_start
    monkeypatch.setattr(planner, 'surface_at_start', compare)
    course = load_course('putting_green')
    for velocity in ((1.5, 0.3, 0.0), (2.5, -0.4, 0.0), (1.0, 1.0, 1.0)):
        simulate(course, Shot(velocity), accuracy=accuracy, engine='python')
    assert len(kept) > 10
    distance, normal, turn = np.max(kept, axis=0)
    assert distance < 1e-9 and normal < 1e-7 and turn < 1e-4


def test_what_is_kept_is_of_no_use_where_the_ball_is_moved():
    """A ball that is struck or put elsewhere where its step ended begins with a search."""
    world = World(load_course('putting_green'), engine='python')
    world.strike('ball', (1.5, 0.2, 0.0))
    world.advance(1.0)
    other = World(load_course('putting_green'), engine='python')
    other.strike('ball', (1.5, 0.2, 0.0))
    other.advance(1.0)
    for one in (world, other):
        one.place('ball', (3.0, 1.0))
    other._balls['stages'][:] = 0.0
    for one in (world, other):
        one.strike('ball', (1.0, 0.0, 0.0))
        one.advance(3.0)
    assert world['ball'] == other['ball']


@pytest.mark.parametrize(
    'tolerance, phase, brief',
    [
        (dormand_prince.ROUGH, ROLL, True),
        (dormand_prince.ROUGH, SLIDE, True),
        (dormand_prince.ROUGH, FLIGHT, False),
        (0.1 * dormand_prince.ROUGH, ROLL, False),
    ],
)
def test_rough_steps_along_the_ground_take_two_stages_fewer(tolerance, phase, brief):
    method = dormand_prince.DormandPrince(tolerance)
    assert runge_kutta.is_brief(method, {'phase': phase}) is brief
    stages = [len(runge_kutta.tableau(method, short)) for short in (False, True)]
    assert stages[0] - stages[1] == 2
