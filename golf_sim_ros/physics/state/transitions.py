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

"""Transitions of a ball between phases: nothing else in the kernels writes a ball's `phase`.

A phase comes with what goes along with it: motion that ends, or an integrator that starts anew.
They stand beside the record, low in the layers, and not with the responses: the record of a shot
stops and fails balls, and contact lets them slide, roll and rest. Which transition it is is
decided there.
"""

from .ball import FAILED, FLIGHT, HOLED, OUT, REST, ROLL, SLIDE, WATER
from ..jit import kernel
from ..kernel_types import BallRecord
from ..mechanics.vector import load, store, ZERO


@kernel
def take_off(ball: BallRecord) -> None:
    """Let the ball fly: the integrator starts anew with a first step. Writes phase, step."""
    ball['phase'] = FLIGHT
    ball['step'] = 0.0


@kernel
def begin_sliding(ball: BallRecord) -> None:
    """Let the ball slide on its support. Writes phase."""
    ball['phase'] = SLIDE


@kernel
def begin_rolling(ball: BallRecord) -> None:
    """Let the ball roll on its support. Writes phase."""
    ball['phase'] = ROLL


@kernel
def come_to_rest(ball: BallRecord) -> None:
    """Stop the ball where it is. Writes phase, velocity, spin."""
    ball['phase'] = REST
    stand_still(ball)


@kernel
def hole_out(ball: BallRecord) -> None:
    """Hole the ball, which rests in the hole. Writes phase."""
    ball['phase'] = HOLED


@kernel
def sink(ball: BallRecord) -> None:
    """End the ball's path in the water. Writes phase, velocity, spin."""
    ball['phase'] = WATER
    stand_still(ball)


@kernel
def leave_bounds(ball: BallRecord) -> None:
    """Lose the ball out of bounds, or below all ground. Writes phase."""
    ball['phase'] = OUT


@kernel
def put_back(ball: BallRecord) -> None:
    """Put a ball whose shot fails back to where it was struck. Writes phase, motion."""
    ball['phase'] = FAILED
    store(ball['position'], load(ball['struck_at']))
    stand_still(ball)


@kernel
def stand_still(ball: BallRecord) -> None:
    """Take all motion from the ball. Writes velocity, spin."""
    store(ball['velocity'], ZERO)
    store(ball['spin'], ZERO)
