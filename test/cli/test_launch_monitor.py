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

"""What a launch monitor shows becomes the right velocity and spin."""

from math import atan2, cos, degrees, hypot, pi, radians, sin

from golf_sim_ros.shot_input.launch_monitor import Launch, parted, velocity_and_spin
from hypothesis import given
from hypothesis.strategies import floats
import numpy as np
import pytest

ANGLES = floats(-pi, pi)
SPINS = floats(-1000.0, 1000.0)


def magnus_direction(velocity, spin):
    """Magnus force points along spin x velocity."""
    return np.cross(spin, velocity)


def test_a_level_shot_at_the_target_flies_along_x():
    assert velocity_and_spin(Launch(50.0)) == ((50.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_positive_azimuth_starts_to_the_right_of_the_target():
    (x, y, _), _ = velocity_and_spin(Launch(50.0, azimuth=radians(3.0)))
    assert y < 0.0
    assert atan2(-y, x) == pytest.approx(radians(3.0), abs=1e-14)


def test_backspin_on_a_shot_along_x_is_negative_y_and_lifts():
    velocity, spin = velocity_and_spin(Launch(50.0, backspin=300.0))
    assert spin == (0.0, -300.0, 0.0)
    assert magnus_direction(velocity, spin) == pytest.approx([0.0, 0.0, 15000.0])


def test_positive_sidespin_curves_to_the_right():
    velocity, spin = velocity_and_spin(Launch(50.0, sidespin=100.0))
    assert spin == (0.0, 0.0, -100.0)
    assert magnus_direction(velocity, spin) == pytest.approx([0.0, -5000.0, 0.0])


def test_a_spin_axis_tilted_to_the_right_curves_to_the_right_and_still_lifts():
    backspin, sidespin = parted(300.0, radians(20.0))
    velocity, spin = velocity_and_spin(Launch(50.0, backspin=backspin, sidespin=sidespin))
    _, y, z = magnus_direction(velocity, spin)
    assert y < 0.0 < z
    assert degrees(atan2(-y, z)) == pytest.approx(20.0)
    assert np.linalg.norm(spin) == pytest.approx(300.0)


@given(ANGLES, floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_the_spin_has_the_size_of_its_parts_and_is_perpendicular_to_the_velocity(
    heading, launch, azimuth, backspin, sidespin
):
    velocity, spin = velocity_and_spin(Launch(70.0, launch, azimuth, backspin, sidespin), heading)
    assert np.linalg.norm(velocity) == pytest.approx(70.0)
    assert np.linalg.norm(spin) == pytest.approx(hypot(backspin, sidespin), abs=1e-9)
    assert np.dot(velocity, spin) == pytest.approx(0.0, abs=1e-9)


@given(ANGLES, floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_turning_the_target_turns_the_shot(heading, launch, azimuth, backspin, sidespin):
    shot = Launch(70.0, launch, azimuth, backspin, sidespin)
    turn = np.array(
        [[cos(heading), -sin(heading), 0.0], [sin(heading), cos(heading), 0.0], [0.0, 0.0, 1.0]]
    )
    for straight, turned in zip(velocity_and_spin(shot), velocity_and_spin(shot, heading)):
        assert turn @ straight == pytest.approx(turned, abs=1e-9)


@given(floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_a_shot_with_azimuth_and_sidespin_reversed_is_the_mirror_image(
    launch, azimuth, backspin, sidespin
):
    velocity, spin = velocity_and_spin(Launch(70.0, launch, azimuth, backspin, sidespin))
    mirrored = velocity_and_spin(Launch(70.0, launch, -azimuth, backspin, -sidespin))
    # Spin is a pseudovector: its part across the mirror stays, the others turn round.
    assert mirrored[0] == pytest.approx((velocity[0], -velocity[1], velocity[2]), abs=1e-9)
    assert mirrored[1] == pytest.approx((-spin[0], spin[1], -spin[2]), abs=1e-9)
