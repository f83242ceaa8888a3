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

"""A contact is told when the ball touches, not when it would have, had it gone on straight."""

from driving_range import HARD
from golf_sim_ros.physics import ACCURACY, Collision, Course, Mesh, Patch, Plane, World
import numpy as np
from oracles import RADIUS
import pytest
from scene import touches

SLOPE = (0.5, -0.3, 0.7)
SHEETS = {
    'patch': Patch((0, 0, 0), SLOPE, 0.4, 2.0, 0.8, HARD),
    'mesh': Mesh(
        [(-1, -1, 0.2), (1, -1, -0.1), (1, 1, 0.3), (-1, 1, -0.2)], [(0, 1, 2), (0, 2, 3)], HARD
    ),
}
sheets = pytest.mark.parametrize('sheet', SHEETS.values(), ids=SHEETS)


@pytest.mark.parametrize('accuracy', ACCURACY)
@pytest.mark.parametrize('velocity', [(0, 0, -80), (60, 0, -60), (30, 0, -30)])
def test_a_ball_that_the_air_brakes_in_its_fall_bounces_off_the_ground(velocity, accuracy):
    world = World(Course((Plane(material=HARD),)), accuracy=accuracy)
    world.place('ball', (0, 0, 20), velocity, (0, -400, 0))
    bounce = next(event for event in world.advance(2.0) if isinstance(event, Collision))
    assert bounce.position[2] == pytest.approx(RADIUS, abs=1e-9)


@sheets
def test_a_ball_put_down_over_a_sheet_and_its_sides_lies_on_something(sheet):
    course = Course((Plane((0, 0, -2), material=HARD), sheet), tee=(5.0, 5.0))
    world = World(course)
    for x, y in np.random.default_rng(1).uniform(-1.2, 1.2, (200, 2)):
        world.place('ball', (x, y))
        assert touches(course, world['ball'].position, 1e-7), (x, y)


@sheets
def test_a_ball_that_nothing_bends_touches_the_sides_of_a_sheet_where_it_is_told_to(sheet):
    course = Course((Plane((0, 0, -2), material=HARD), sheet), tee=(5.0, 5.0), effects=())
    world = World(course)
    random = np.random.default_rng(2)
    bounces = 0
    for start, aim in zip(random.normal(size=(300, 3)), random.uniform(-1.1, 1.1, (300, 3))):
        start *= 2.5 / np.linalg.norm(start)
        start[2] = abs(start[2]) + 0.1
        world.place('ball', start, 20 * (aim * (1, 1, 0.2) - start))
        for event in world.advance(0.1):
            if isinstance(event, Collision):
                assert touches(course, event.position, 1e-9), event
                bounces += 1
    assert bounces > 100
