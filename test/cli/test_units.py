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

"""The units in which people type shots."""

from math import pi

from golf_sim_ros.shot_input.units import UNITS
import pytest

MPH, YARD, RPM = 1609.344 / 3600.0, 0.9144, 2.0 * pi / 60.0


@pytest.mark.parametrize(
    'name, sizes', [('golf', (MPH, pi / 180.0, RPM, YARD)), ('si', (1.0, pi / 180.0, 1.0, 1.0))]
)
def test_units_are_as_they_are_defined(name, sizes):
    assert [unit.size for unit in UNITS[name]] == pytest.approx(sizes, rel=1e-15)
