# SPDX-License-Identifier: Apache-2.0
"""Semi-implicit (symplectic) Euler, of order 1: a baseline, as in most game engines."""
from typing import NamedTuple

from ..mechanics.vector import add_scaled, store, scale, load
from ..state.ball import STEP_END
from ..trajectory.segment import fit_segment
from . import runge_kutta


class SemiImplicitEuler(NamedTuple):
    """Fixed steps of ``length`` [s]: velocity first, then position with the new velocity."""

    length: float


@runge_kutta.step_by.register(SemiImplicitEuler)
def _step(method, model, ball):
    h = min(ball['step'], method.length) if ball['step'] > 0.0 else method.length
    runge_kutta.stage(model, ball, 0, runge_kutta.state_after(ball, runge_kutta.NO_CHANGE))
    h = runge_kutta.longest(model, ball, h)
    rates = ball['stages'][0]
    force = load(rates[3:6])
    torque = load(rates[6:9])
    v1 = add_scaled(load(ball['velocity']), h, force)
    ball['span'] = h
    ball['step'] = method.length
    store(ball['origin'], load(ball['position']))
    store(ball['spin_coefficients'][3], add_scaled(load(ball['spin']), h, torque))
    # A straight line at the new velocity, as such an engine moves the ball.
    fit_segment(ball, scale(h, v1), (v1, v1), ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), (torque, torque))
    ball['ending'] = STEP_END


METHOD = SemiImplicitEuler
