# SPDX-License-Identifier: Apache-2.0
"""Dormand and Prince's method of order 5 with an embedded one of order 4 and adaptive steps.

J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae", J. Comput. Appl. Math. 6
(1980) 19-26.
"""
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from . import runge_kutta

TABLE = np.array([
    [0, 0, 0, 0, 0, 0],
    [1 / 5, 0, 0, 0, 0, 0],
    [3 / 40, 9 / 40, 0, 0, 0, 0],
    [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
    [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
    [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
    [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]])
ERROR = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
LEAST = 1e-9  # s
MOST_GROWTH = 4.0  # from one step to the next
ON_GROUND = 0.2  # of the tolerance: along the ground, where a ball must be slow to stop, errors count more,
MOST_ON_GROUND = 1e-5  # m: and coarser steps cost as much, for other things end them


class DormandPrince(NamedTuple):
    """Adaptive steps of order 5.

    ``tolerance`` [m] of the error of a step, velocity counting for a second; ``longest`` step [s].
    """

    tolerance: float
    longest: float = 2.0


@runge_kutta.table.register(DormandPrince)
def _table(method):
    return TABLE


@runge_kutta.error_weights.register(DormandPrince)
def _error_weights(method):
    return ERROR


@runge_kutta.first_step.register(DormandPrince)
def _first_step(method, speed, hop):
    # The error of a step goes with its fifth power. Air bends the path of a fast ball over a time that goes
    # with 1/speed, weight that of a slow one: a drive begins with 0.33 s for 5e-5 m, a ball that hops with
    # half a second. A little more than a hop takes: no more is used, and the air may carry it.
    far = min(175.0 / max(speed, 1.0), 3.5)
    short = 1.05 * hop + 1e-6
    part = short / far
    if part * part * part * part * part <= method.tolerance:
        return min(short, method.longest)
    return min(far * method.tolerance ** 0.2, method.longest)


@kernel
def allowed(method, flies):
    """How far [m] a step may err."""
    return method.tolerance if flies else min(ON_GROUND * method.tolerance, MOST_ON_GROUND)


@runge_kutta.stands.register(DormandPrince)
def _stands(method, h, error, flies):
    # Where a force jumps, nothing is gained below LEAST; the world refuses what is not finite.
    return error <= allowed(method, flies) or h < LEAST or not error < 1e300


@runge_kutta.next_step.register(DormandPrince)
def _next_step(method, h, error, flies):
    if h < LEAST:  # the jump is behind
        return MOST_GROWTH * h
    if not error < 1e300:
        return h
    grow = 0.9 * max(error / allowed(method, flies), 1e-4) ** -0.2
    return min(h * min(max(grow, 0.1), MOST_GROWTH), method.longest)


METHOD = DormandPrince
