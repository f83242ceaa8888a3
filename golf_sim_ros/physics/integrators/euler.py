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

"""Semi-implicit (symplectic) Euler, of order 1: a baseline, as in most game engines."""

from typing import NamedTuple

from . import runge_kutta
from ..kernel_types import BallRecord, ModelRecord
from ..mechanics.vector import add_scaled, load, scale, store
from ..state.ball import FLIGHT, STEP_END
from ..trajectory.equations_of_motion import keep_surface, turning_surface
from ..trajectory.segment import fit_segment


class SemiImplicitEuler(NamedTuple):
    """Fixed steps of ``length`` [s]: velocity first, then position with the new velocity."""

    length: float


@runge_kutta.step_by.register(SemiImplicitEuler)
def _step(method: SemiImplicitEuler, model: ModelRecord, ball: BallRecord) -> None:
    h = min(ball['step'], method.length) if ball['step'] > 0.0 else method.length
    if ball['phase'] == FLIGHT:  # a ball in contact has it: see `runge_kutta.start`
        now = runge_kutta.state_after(ball, runge_kutta.NO_CHANGE)
        runge_kutta.stage(model, ball, 0, now, ball['begin'])
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
    if ball['phase'] != FLIGHT:
        end = add_scaled(load(ball['position']), h, v1)
        keep_surface(ball, turning_surface(model.land, ball, end, v1))


METHOD = SemiImplicitEuler
