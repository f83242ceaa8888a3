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

"""Orientations against scipy's rotations."""

from golf_sim_ros.physics import Course, Plane, World
from golf_sim_ros.physics.engine.orientation import UPRIGHT
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

SPIN = (30.0, -280.0, 55.0)  # rad/s
TICK = 0.004  # s


def turned(world, ticks):
    orientations = np.tile(UPRIGHT, (len(world.names), 1))
    for _ in range(ticks):
        world.turn(orientations, TICK)
    return orientations


def test_a_spinning_ball_turns_as_its_rotation_vector_says():
    world = World(Course((Plane(),)), 2)
    world.strike('ball_1', (20.0, 0.0, 20.0), SPIN)
    still, flying = turned(world, 50)
    assert (still == UPRIGHT).all()
    whole = Rotation.from_rotvec(np.multiply(SPIN, 50 * TICK))
    assert (Rotation.from_quat(flying).inv() * whole).magnitude() == pytest.approx(0.0, abs=1e-12)


def test_turns_follow_each_other_in_the_course_frame():
    world = World(Course((Plane(),)))
    first, second = (250.0, 0.0, 0.0), (0.0, 0.0, 180.0)
    orientations = np.array([UPRIGHT])
    for spin in (first, second):
        world.place('ball', (0.0, 0.0, 5.0), (1.0, 0.0, 0.0), spin)
        world.turn(orientations, TICK)
    after, before = (Rotation.from_rotvec(np.multiply(spin, TICK)) for spin in (second, first))
    off = Rotation.from_quat(orientations[0]).inv() * after * before
    assert off.magnitude() == pytest.approx(0.0, abs=1e-12)
