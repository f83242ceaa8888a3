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

"""Units in which people type shots and read results."""

from math import pi
from typing import NamedTuple


class Unit(NamedTuple):
    """A unit with its name.

    Parameters
    ----------
    name : str
    size : float
        One of it in SI.
    """

    name: str
    size: float


class Units(NamedTuple):
    """The units of speeds, angles, spins and lengths."""

    speed: Unit
    angle: Unit
    spin: Unit
    length: Unit


DEGREE = Unit('deg', pi / 180.0)

# The international yard is 0.9144 m and the mile 1760 yards, both exactly.
UNITS = {
    'golf': Units(Unit('mph', 0.44704), DEGREE, Unit('rpm', 2.0 * pi / 60.0), Unit('yd', 0.9144)),
    'si': Units(Unit('m/s', 1.0), DEGREE, Unit('rad/s', 1.0), Unit('m', 1.0)),
}
