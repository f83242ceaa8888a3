# SPDX-License-Identifier: Apache-2.0
"""The units in which people type shots."""
from math import pi

import pytest

from golf_sim_ros.shot_input.units import UNITS

MPH, YARD, RPM = 1609.344 / 3600.0, 0.9144, 2.0 * pi / 60.0


@pytest.mark.parametrize('name, sizes', [
    ('golf', (MPH, pi / 180.0, RPM, YARD)), ('si', (1.0, pi / 180.0, 1.0, 1.0))])
def test_units_are_as_they_are_defined(name, sizes):
    assert [unit.size for unit in UNITS[name]] == pytest.approx(sizes, rel=1e-15)
