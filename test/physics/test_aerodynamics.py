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

"""Drag and lift against published measurements: tour averages, a driver chart; and as laws."""

import csv
from math import pi
from pathlib import Path

from driving_range import launched, level, TURF
from golf_sim_ros.physics import Air, LogProfile, PowerProfile, simulate_many, UniformProfile
from golf_sim_ros.physics.effects.drag import drag_coefficient, DragLaw
from golf_sim_ros.physics.effects.magnus import lift_per_ratio, LiftLaw
from golf_sim_ros.physics.effects.wind import blowing, share
import numpy as np
import pytest

DATA = Path(__file__).parents[1] / 'data'
MPH, YARD, RPM, DEGREE = 0.44704, 0.9144, pi / 30, pi / 180
PGA = ('trackman_pga_2010s.csv', 'trackman_pga_2023.csv')


def table(name):
    """Columns of numbers of a table; nan where there is none."""
    lines = [line for line in (DATA / name).read_text().splitlines() if not line.startswith('#')]
    rows = list(csv.DictReader(lines))

    def column(key):
        return np.array([float(row.get(key) or 'nan') for row in rows])

    return column


def flown(name, **more):
    """Play a table's shots: what becomes of them."""
    column = table(name)
    velocities = launched(column('ball_speed_mph') * MPH, column('launch_deg') * DEGREE)
    return play(velocities, column('spin_rpm') * RPM, **more)


def play(velocities, backspin, air=None, **more):
    """Play shots on level turf: what becomes of them."""
    course = level(TURF) if air is None else level(TURF, air=air)
    spins = np.zeros((len(velocities), 3))
    spins[:, 1] = -backspin
    return simulate_many(course, velocities, spins, **more)


@pytest.mark.parametrize('name', PGA)
def test_the_tour_averages_are_met_by_every_club(name):
    column, shots = table(name), flown(name)
    carry = shots['carry'] / YARD - column('carry_yd')
    apex = shots['apex'] / YARD - column('max_height_yd')
    angle = shots['landing_angle'] / DEGREE - column('land_angle_deg')
    assert np.abs(carry).mean() <= 3.0 and np.abs(carry).max() <= 7.0, carry
    assert np.abs(apex).mean() <= 1.5, apex
    assert np.abs(angle).mean() <= 3.5, angle


def test_the_driver_chart_is_met():
    name = 'trackman_driver_chart_2010_aoa0.csv'
    assert np.abs(flown(name)['carry'] / YARD - table(name)('carry_yd')).mean() <= 4.0


DRIVER = launched(np.array([74.7]), np.array([10.9 * DEGREE]))
DRIVER_SPIN = np.array([2686 * RPM])


def carry(**more):
    """Carry [m] of a drive."""
    return play(DRIVER, DRIVER_SPIN, **more)['carry'][0]


def test_headwind_costs_more_than_tailwind_gives():
    still = carry()
    assert still - carry(wind=(-5.0, 0.0, 0.0)) > carry(wind=(5.0, 0.0, 0.0)) - still > 0.0


def test_thin_air_and_warm_air_carry_farther():
    still = carry()
    high = carry(
        air=Air(288.15 - 0.0065 * 1600, 101325 * (1 - 0.0065 * 1600 / 288.15) ** 5.2558797, 0.0)
    )
    assert 1.04 <= high / carry(air=Air(288.15, 101325.0, 0.0)) <= 1.09
    assert 1.005 <= carry(air=Air(temperature=308.15)) / still <= 1.02


def test_a_tilted_spin_axis_curves_a_drive():
    tilt = 10 * DEGREE
    spin = DRIVER_SPIN[0] * np.array([[0.0, -np.cos(tilt), -np.sin(tilt)]])
    curved = simulate_many(level(TURF), DRIVER, spin)['carry_side'][0] / YARD
    assert -30.0 <= curved <= -15.0


RATIO, REYNOLDS = np.meshgrid(np.geomspace(1e-6, 3.0, 120), np.geomspace(1e3, 4e5, 60))


def coefficients(ratio, reynolds):
    """Drag and lift coefficients."""
    cd, cl = drag_coefficient, lift_per_ratio
    return np.array(
        [
            (cd(DragLaw(), s * s, re * re), s * cl(LiftLaw(), s * s, re * re))
            for s, re in zip(ratio.ravel(), reynolds.ravel())
        ]
    ).T


def test_the_laws_are_positive_and_bounded():
    drag, lift = coefficients(RATIO, REYNOLDS)
    assert 0.1 < drag.min() and drag.max() < 1.5
    assert 0.0 < lift.min() and lift.max() < 0.6


def test_the_laws_have_no_step_and_no_kink():
    for size in (1e-3, 1e-4):
        ahead, here, behind = (
            coefficients(RATIO + 0.01 * k * size, REYNOLDS * (1 + k * size)) for k in (1, 0, -1)
        )
        # Second differences of a smooth function go with the step's square.
        assert np.abs(ahead - 2 * here + behind).max() < 60 * size * size


def test_neighbouring_shots_carry_nearly_the_same():
    rng = np.random.default_rng(5)
    speed, angle = rng.uniform(20, 80, 1000), rng.uniform(5, 50, 1000) * DEGREE
    backspin = rng.uniform(100, 1000, 1000)
    near = 1.0 + 1e-4 * rng.choice((-1, 1), (3, 1000))
    one = play(launched(speed, angle), backspin)['carry']
    other = play(launched(speed * near[0], angle * near[1]), backspin * near[2])['carry']
    assert np.abs(one - other).max() < 0.1 * YARD


@pytest.mark.parametrize(
    'profile', (LogProfile(), LogProfile(0.3), PowerProfile(), UniformProfile())
)
def test_wind_grows_with_height_without_a_kink(profile):
    height = np.geomspace(0.02, 100.0, 400)
    wind = blowing(profile, (1.0, 0.0, 0.0))
    size = 1e-4 * height

    def at(heights):
        return np.array([share(wind, h) for h in heights])

    assert (np.diff(at(height)) >= 0.0).all()
    second = at(height + size) - 2.0 * at(height) + at(height - size)
    assert np.abs(second).max() < 1e-7
