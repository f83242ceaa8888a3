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

"""Dormand-Prince 5(4): an embedded Runge-Kutta method with adaptive steps.

J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae", J. Comput. Appl. Math. 6
(1980) 19-26.
"""

from math import inf, sqrt
from typing import NamedTuple

import numpy as np

from . import rk4, runge_kutta
from ..jit import kernel
from ..kernel_types import BallRecord
from ..mechanics.vector import dot, load
from ..state.ball import FLIGHT, ROLL

# fmt: off
TABLE = np.array([
    [0,            0,             0,            0,          0,             0],
    [1 / 5,        0,             0,            0,          0,             0],
    [3 / 40,       9 / 40,        0,            0,          0,             0],
    [44 / 45,      -56 / 15,      32 / 9,       0,          0,             0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0,             0],
    [9017 / 3168,  -355 / 33,     46732 / 5247, 49 / 176,   -5103 / 18656, 0],
    [35 / 384,     0,             500 / 1113,   125 / 192,  -2187 / 6784,  11 / 84],
])
# fmt: on
ERROR = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
# Of RK4 to a rule of order 3: the last stage for the fourth.
HOP_ERROR = np.array([0, 0, 0, 1 / 6, -1 / 6])
LEAST = 1e-9  # s: a shorter step is accepted whatever its error
MOST_GROWTH = 4.0  # from one step to the next
# Hops of less than STEP_SAFETY times the tolerance's fourth root are flown by RK4, with two stages
# fewer. Its error would allow twice that, but a ball that skids over rough amplifies it by
# hundreds.
STEP_SAFETY = 0.9  # s
LANDED = 0.65  # of the tolerance: hops multiply the errors of those before them
# Along the ground, where a ball must be slow to stop, errors count more.
ON_GROUND = 0.08  # of the tolerance
MOST_ON_GROUND = 4e-4  # m: with 1 mm a swing in a bowl took 0.8 % too long
# A rougher slide would err in energy by more than ground may give: see docs/stability.md.
MOST_SLIDING = 2e-4  # m
LEAST_LEFT = 0.1  # s
# m: to such a tolerance RK4's steps along the ground are nearly as long, with two stages fewer
ROUGH = 1e-3


class DormandPrince(NamedTuple):
    """Adaptive steps of order 5.

    ``tolerance`` [m] of a step's error, weighted as in `runge_kutta.error_in_metres`; ``longest``
    step [s].
    """

    tolerance: float
    longest: float = 2.0


@runge_kutta.tableau.register(DormandPrince)
def _table(method: DormandPrince, brief: bool) -> np.ndarray:
    return rk4.TABLE if brief else TABLE


@runge_kutta.error_weights.register(DormandPrince)
def _error_weights(method: DormandPrince, brief: bool) -> np.ndarray:
    return HOP_ERROR if brief else ERROR


@runge_kutta.allowed.register(DormandPrince)
def _allowed(method: DormandPrince, ball: BallRecord) -> float:
    if ball['phase'] != FLIGHT:
        most = MOST_ON_GROUND if ball['phase'] == ROLL else MOST_SLIDING
        return min(ON_GROUND * method.tolerance, most) / time_left(ball)
    return LANDED * method.tolerance if ball['landed'] else method.tolerance


@kernel
def time_left(ball: BallRecord) -> float:
    """Time [s] for which an error of velocity acts on the ground: until a rolling ball stops.

    It is never so short that a ball which turns back on a slope would go astray, nor longer than
    the weight of such errors says.
    """
    if ball['phase'] != ROLL:
        return runge_kutta.VELOCITY_WEIGHT
    v = load(ball['stages'][0, 0:3])
    slowing = -dot(v, load(ball['stages'][0, 3:6]))
    left = dot(v, v) / slowing if slowing > 0.0 else inf
    return min(max(left, LEAST_LEFT), runge_kutta.VELOCITY_WEIGHT)


@runge_kutta.first_step.register(DormandPrince)
def _first_step(
    method: DormandPrince, speed: float, hop: float, most: float
) -> tuple[float, bool]:
    # The error of a step goes with its fifth power. Air bends the path of a fast ball over a time
    # that goes with 1/speed, gravity that of a slow one: a drive starts with 0.33 s for 5e-5 m, a
    # ball that hops with half a second. The step is a little longer than the hop: no more is used,
    # and lift may prolong that.
    far = min(175.0 / max(speed, 1.0), 3.5)
    short = 1.05 * hop + 1e-6
    part = short / far
    if part * part * part * part * part > most:
        return min(far * most**0.2, method.longest), False
    part = short / STEP_SAFETY
    return min(short, method.longest), part * part * part * part <= most


@runge_kutta.is_brief.register(DormandPrince)
def _is_brief(method: DormandPrince, ball: BallRecord) -> bool:
    return ball['phase'] != FLIGHT and method.tolerance >= ROUGH


@runge_kutta.stands.register(DormandPrince)
def _stands(method: DormandPrince, h: float, error: float, most: float) -> bool:
    # At a discontinuity of a force, steps below LEAST gain nothing. A step that is not a number is
    # accepted, or the loop would not end.
    return error <= most or not h >= LEAST


@runge_kutta.next_step.register(DormandPrince)
def _next_step(method: DormandPrince, h: float, error: float, most: float) -> float:
    if h < LEAST:  # the discontinuity has been passed
        return MOST_GROWTH * h
    if not error < 1e300:  # the stages diverged, as where dense air stops a light ball at once
        return 0.1 * h
    # As good a guess as the fifth root, and cheaper.
    grow = 0.9 / sqrt(sqrt(max(error / most, 1e-3)))
    return min(h * min(max(grow, 0.1), MOST_GROWTH), method.longest)


METHOD = DormandPrince
