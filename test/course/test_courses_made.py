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

"""The shipped courses: their files are those that the script makes, and they can be played."""

from math import cos, sin
import os
from pathlib import Path
import subprocess
import sys

from golf_sim_ros import physics
from golf_sim_ros.course import load_course, shipped_courses
from golf_sim_ros.course.package_files import share
import numpy as np
import pytest

SCRIPT = Path(__file__).resolve().parents[2] / 'tools' / 'make_courses.py'
MANY = int(os.environ.get('GOLF_SIM_SHOTS', '50'))
DROP = 12.0  # m: higher than all ground and trees
LONGEST = 300.0  # s
ENDS = {physics.Phase.REST, physics.Phase.OUT, physics.Phase.WATER, physics.Phase.HOLED}
AROUND = [(-20.0, -40.0), (370.0, 50.0)]  # where balls are dropped on a course without bounds


@pytest.fixture(scope='module')
def made(tmp_path_factory):
    """Folder with what the script makes."""
    folder = tmp_path_factory.mktemp('made')
    subprocess.run([sys.executable, SCRIPT, folder], check=True)
    return folder


def test_the_script_makes_the_shipped_files_to_the_byte(made):
    names = {path.name for path in made.iterdir()}
    shipped = {path.name for path in share('config', 'courses').iterdir()}
    solved = {name for name in shipped if name.endswith('_wind.npz')}  # by make_wind_fields.py
    assert names == shipped - {'golf_without_friends.yaml'} - solved
    for name in names:
        assert (made / name).read_bytes() == share('config', 'courses', name).read_bytes(), name


def test_the_shipped_courses_are_small():
    sizes = {path.name: path.stat().st_size for path in share('config', 'courses').iterdir()}
    winds = {name for name in sizes if name.endswith('_wind.npz')}
    assert sum(size for name, size in sizes.items() if name not in winds) < 1e6
    assert max(sizes[name] for name in winds) < 1e6


@pytest.mark.parametrize('name', shipped_courses())
def test_every_shipped_course_has_ground_under_tee_and_hole(name):
    course = load_course(name)
    for place in (course.tee, course.hole):
        assert physics.ground_height(course, *place) is not None


@pytest.mark.parametrize('name', shipped_courses())
def test_a_ball_dropped_anywhere_ends_on_the_ground_or_in_water(name):
    course = load_course(name)
    world = physics.World(course)
    low, high = np.min(course.bounds or AROUND, 0), np.max(course.bounds or AROUND, 0)
    for x, y in np.random.default_rng(5).uniform(low, high, (MANY, 2)):
        world.place('ball', (x, y, DROP))
        begin = world.time
        while world.moving and world.time < begin + LONGEST:
            world.advance(5.0)
        ball = world['ball']
        assert ball.phase in ENDS, (x, y, ball)
        if ball.phase != physics.Phase.WATER:
            world.place('ball', ball.position)  # refused where it would lie in the ground


def test_a_putt_of_3_m_on_the_putting_green_is_holed():
    course = load_course('putting_green')
    speed, left = 2.6, 0.065  # m/s, rad: it breaks to the right
    velocity = (speed * cos(left), speed * sin(left), 0.0)
    assert physics.simulate(course, physics.Shot(velocity)).result.status == 'holed'
    straight = physics.simulate(course, physics.Shot((speed, 0.0, 0.0))).result
    assert straight.position[1] < -0.15
