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

"""The classical Runge-Kutta method of order 4 with fixed steps."""

from typing import NamedTuple

import numpy as np

from . import runge_kutta

# fmt: off
TABLE = np.array([
    [0,     0,     0,     0],
    [1 / 2, 0,     0,     0],
    [0,     1 / 2, 0,     0],
    [0,     0,     1,     0],
    [1 / 6, 1 / 3, 1 / 3, 1 / 6],
])
# fmt: on


class RungeKutta4(NamedTuple):
    """Fixed steps of ``length`` [s], of order 4."""

    length: float


@runge_kutta.tableau.register(RungeKutta4)
def _table(method: RungeKutta4, brief: bool) -> np.ndarray:
    return TABLE


@runge_kutta.first_step.register(RungeKutta4)
def _first_step(method: RungeKutta4, speed: float, hop: float, most: float) -> tuple[float, bool]:
    return method.length, False


@runge_kutta.next_step.register(RungeKutta4)
def _next_step(method: RungeKutta4, h: float, error: float, most: float) -> float:
    return method.length  # however short an event has made this one


METHOD = RungeKutta4
