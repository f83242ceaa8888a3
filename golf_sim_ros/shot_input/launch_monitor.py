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

r"""Velocity and spin from what a launch monitor shows.

Seen from above, the target ahead:     Seen from behind, along the flight:

            x  target                              z
            |   /  flight                          |
            |  /                              \    |
            |-/  azimuth,                       \  |
            |/   positive to the right    y -------o-------
     y -----+                                      | \
                                                   |   \  spin axis, tilted to the right:
                                                          positive, curves to the right

The Magnus force points along spin x velocity. So backspin, which lifts, turns about the axis to
the right of the flight (-y for a shot along +x), and sidespin that curves to the right turns
clockwise seen from above.
"""

from collections.abc import Iterable
from math import cos, sin
from typing import NamedTuple

Vector = tuple[float, float, float]


class Launch(NamedTuple):
    """A launch as a launch monitor shows it.

    Parameters
    ----------
    speed : float
        Speed of the ball [m/s].
    launch : float
        Angle of the velocity above the horizontal [rad].
    azimuth : float
        Angle of the velocity from the target line, positive to the right [rad].
    backspin : float
        Spin that lifts the ball [rad/s].
    sidespin : float
        Spin that curves the ball, positive to the right [rad/s].
    """

    speed: float
    launch: float = 0.0
    azimuth: float = 0.0
    backspin: float = 0.0
    sidespin: float = 0.0


def parted(spin: float, axis: float) -> tuple[float, float]:
    """Backspin and sidespin of a `spin` whose `axis` [rad] is tilted, positive to the right."""
    return spin * cos(axis), spin * sin(axis)


def velocity_and_spin(launch: Launch, heading: float = 0.0) -> tuple[Vector, Vector]:
    """Velocity and angular velocity of a launched ball in the frame of the course.

    Parameters
    ----------
    launch : Launch
    heading : float
        Direction of the target: angle from x towards y, that is to the left [rad].

    Returns
    -------
    velocity : tuple of 3 float
        [m/s]; x to the target of the course, y to the left, z up.
    spin : tuple of 3 float
        [rad/s]; perpendicular to the velocity, for launch monitors show no other.
    """
    up, along = sin(launch.launch), cos(launch.launch)
    ahead_x, ahead_y = cos(heading - launch.azimuth), sin(heading - launch.azimuth)
    velocity = (launch.speed * along * ahead_x, launch.speed * along * ahead_y, launch.speed * up)
    right = (ahead_y, -ahead_x, 0.0)
    above = (-up * ahead_x, -up * ahead_y, along)  # right x velocity, of unit length
    spin = [launch.backspin * r - launch.sidespin * a for r, a in zip(right, above)]
    return _without_negative_zeros(velocity), _without_negative_zeros(spin)


def _without_negative_zeros(vector: Iterable[float]) -> Vector:
    x, y, z = vector
    return x + 0.0, y + 0.0, z + 0.0
