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

"""Density and viscosity of the air."""

from math import exp
from typing import NamedTuple

GAS_CONSTANT = 8.314462618  # J/(mol K)
DRY_AIR = 0.0289652  # kg/mol
WATER_VAPOUR = 0.01801528  # kg/mol
ABSOLUTE_ZERO = -273.15  # degrees Celsius


class Air(NamedTuple):
    """Weather at the course.

    Parameters
    ----------
    temperature : float
        [K]
    pressure : float
        [Pa]
    relative_humidity : float
        0..1
    """

    temperature: float = 298.15
    pressure: float = 101325.0
    relative_humidity: float = 0.5


def density(air: Air) -> float:
    """Density [kg/m^3] of moist `air`: an ideal mixture of dry air and water vapour.

    The vapour's saturation pressure is Magnus's formula with the coefficients of Alduchov and
    Eskridge (1996), good to 0.4 % between -40 and 50 degrees Celsius.
    """
    celsius = air.temperature + ABSOLUTE_ZERO
    saturation = 610.94 * exp(17.625 * celsius / (celsius + 243.04))
    vapour = air.relative_humidity * saturation
    moles = GAS_CONSTANT * air.temperature
    return ((air.pressure - vapour) * DRY_AIR + vapour * WATER_VAPOUR) / moles


def viscosity(air: Air) -> float:
    """Dynamic viscosity [Pa s] of `air` by Sutherland's law."""
    return 1.458e-6 * air.temperature**1.5 / (air.temperature + 110.4)


def standard_atmosphere(altitude: float) -> Air:
    """Dry `Air` at `altitude` [m] of the ISO 2533 standard atmosphere (below 11 km)."""
    temperature = 288.15 - 0.0065 * altitude
    pressure = 101325.0 * (temperature / 288.15) ** 5.2558797
    return Air(temperature, pressure, 0.0)
