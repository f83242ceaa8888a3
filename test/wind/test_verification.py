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

"""The solver against closed forms and published figures."""

from math import log2
import subprocess
import sys

from golf_sim_ros.physics.engine.engines import missing
import numpy as np
import pytest

if missing():
    pytest.skip(missing(), allow_module_level=True)

from golf_sim_ros.wind import verification  # noqa: E402, I100


def test_the_taylor_green_vortex_decays_with_an_error_of_second_order():
    (coarse, _), (fine, divergence) = (verification.taylor_green(n) for n in (16, 128))
    assert log2(coarse / fine) / 3 >= 1.9
    assert divergence < 1e-10


@pytest.mark.parametrize('reynolds, most', [(100, 0.005), (400, 0.015), (1000, 0.02)])
def test_the_lid_driven_cavity_is_that_of_ghia(reynolds, most):
    z, u, divergence = verification.cavity(reynolds, 32)
    found = np.interp(verification.GHIA_HEIGHTS, z, u)
    assert abs(found - verification.GHIA[reynolds]).max() < most
    assert divergence < 1e-10


@pytest.mark.parametrize('steepness', [0.05, 0.1])
def test_potential_flow_over_a_ridge_is_that_of_linear_theory(steepness):
    found, linear, divergence = verification.ridge(steepness)
    assert found == pytest.approx(linear, rel=0.03)
    assert divergence < 1e-10


def test_the_wind_over_a_hill_is_that_of_taylor_and_lee_and_of_a_finer_grid():
    found, expected, divergence = verification.hill(0.1)
    assert found == pytest.approx(expected, rel=0.1)
    assert divergence < 1e-10
    finer, _, _ = verification.hill(0.1, cell=10.0)
    assert finer == pytest.approx(found, rel=0.05)


@pytest.mark.parametrize('angle', [0.0, 0.3])
def test_over_level_ground_the_logarithmic_profile_stays(angle):
    kept, disturbed, divergence = verification.flat(angle)
    assert kept < 1e-6
    assert disturbed < 0.005
    assert divergence < 1e-10


def test_behind_a_row_of_trees_the_wind_is_that_of_shelterbelts():
    x, ratio, divergence = verification.trees()
    assert 2.0 <= x[ratio.argmin()] <= 6.0
    assert 0.65 <= np.interp(15.0, x, ratio) <= 0.9
    assert ratio.min() < 0.6
    assert divergence < 1e-10


def test_the_command_prints_the_centre_line():
    words = [sys.executable, '-m', 'golf_sim_ros.wind.verification', 'cavity', '--cells', '16']
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    title, *rows = [line for line in done.stdout.splitlines() if not line.startswith('#')]
    assert title == 'z u' and len(rows) == 18
    assert rows[0].split() == ['0.000000', '0.000000']
    assert rows[-1].split() == ['1.000000', '1.000000']
