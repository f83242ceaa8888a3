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

"""One Runge-Kutta step of flight, or along ground that is not flat, by any method's tableau."""

from math import inf, sqrt

import numpy as np

from ..effects import at_time, gravity_at, longest_allowed_step, wind_at
from ..jit import generic, kernel
from ..kernel_types import BallRecord, MethodRecord, ModelRecord, MotionState, Vector
from ..mechanics.vector import add_scaled, dot, length, load, store, sub
from ..state.ball import FLIGHT, STEP_END
from ..trajectory.equations_of_motion import LEAST_SPEED, rates
from ..trajectory.segment import fit_segment

# Weights that turn errors of velocity and spin into metres: they act for about a second, in which
# 100 rad/s bend a drive by about a metre.
VELOCITY_WEIGHT = 1.0  # s
SPIN_WEIGHT = 0.01  # m s

NO_TABLE = np.zeros((1, 1))
NO_ERROR = np.zeros(1)
NO_CHANGE = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@generic
def tableau(method: MethodRecord, brief: bool) -> np.ndarray:
    """Butcher tableau of `method`: a row a stage; the last row is the solution's weights.

    So the last stage is evaluated at the step's end and is the first of the next step (FSAL). For
    a `brief` step the tableau may have fewer stages.
    """
    return NO_TABLE


@generic
def error_weights(method: MethodRecord, brief: bool) -> np.ndarray:
    """Weights of the stages in the embedded error estimate; zero where there is none."""
    return NO_ERROR


@generic
def allowed(method: MethodRecord, ball: BallRecord) -> float:
    """Error tolerance [m] of a step of the ball."""
    return inf


@generic
def first_step(method: MethodRecord, speed: float, hop: float, most: float) -> tuple[float, bool]:
    """Length [s] of the first step, and whether it is brief; see `tableau`.

    At `speed` [m/s] through the air, of a flight of about `hop` seconds, with a tolerance of
    `most` [m].
    """
    return 0.01, False


@generic
def is_brief(method: MethodRecord, ball: BallRecord) -> bool:
    """Whether a step that is not the first is brief: see `tableau`."""
    return False


@generic
def stands(method: MethodRecord, h: float, error: float, most: float) -> bool:
    """Whether a step of `h` [s] with that `error` [m] is accepted at the tolerance `most`."""
    return True


@generic
def next_step(method: MethodRecord, h: float, error: float, most: float) -> float:
    """Length [s] of the step after one of `h` with that `error` [m].

    Of its repetition, if it was rejected.
    """
    return h


@kernel
def stage(model: ModelRecord, ball: BallRecord, i: int, state: MotionState, time: float) -> None:
    """Evaluate stage `i` at `state`, position, velocity and spin in one tuple, and at that `time`.

    Writes stages, evaluations.
    """
    x, y, z, u, v, w, p, q, r = state
    at_time(model.effects, time)
    force, torque = rates(model, ball, (x, y, z), (u, v, w), (p, q, r))
    store_stage(ball, i, (u, v, w), force, torque)


@kernel
def store_stage(ball: BallRecord, i: int, velocity: Vector, force: Vector, torque: Vector) -> None:
    """Store the rates of stage `i`. Writes stages, evaluations."""
    row = ball['stages'][i]
    store(row[0:3], velocity)
    store(row[3:6], force)
    store(row[6:9], torque)
    ball['evaluations'] += 1


@kernel
def total(row: np.ndarray, count: int) -> float:
    """Sum of the first `count` weights of a tableau's `row`: where in the step its stage is."""
    share = 0.0
    for j in range(count):
        share += row[j]
    return share


@kernel
def mix(ball: BallRecord, weights: np.ndarray, count: int, h: float) -> MotionState:
    """Linear combination of the first `count` stages by `weights`, times `h`, as one tuple."""
    k = ball['stages']
    x = y = z = u = v = w = p = q = r = 0.0
    for j in range(count):
        f = h * weights[j]
        x += f * k[j, 0]
        y += f * k[j, 1]
        z += f * k[j, 2]
        u += f * k[j, 3]
        v += f * k[j, 4]
        w += f * k[j, 5]
        p += f * k[j, 6]
        q += f * k[j, 7]
        r += f * k[j, 8]
    return x, y, z, u, v, w, p, q, r


@kernel
def state_after(ball: BallRecord, change: MotionState) -> MotionState:
    """State of the ball plus `change`, as one tuple."""
    a = ball['position']
    b = ball['velocity']
    c = ball['spin']
    return (
        a[0] + change[0],
        a[1] + change[1],
        a[2] + change[2],
        b[0] + change[3],
        b[1] + change[4],
        b[2] + change[5],
        c[0] + change[6],
        c[1] + change[7],
        c[2] + change[8],
    )


@kernel
def error_in_metres(ball: BallRecord, weights: np.ndarray, h: float) -> float:
    """Embedded error estimate [m]: a weighted Euclidean norm."""
    e = mix(ball, weights, len(weights), h)
    return sqrt(
        e[0] * e[0]
        + e[1] * e[1]
        + e[2] * e[2]
        + VELOCITY_WEIGHT * VELOCITY_WEIGHT * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5])
        + SPIN_WEIGHT * SPIN_WEIGHT * (e[6] * e[6] + e[7] * e[7] + e[8] * e[8])
    )


@kernel
def start(model: ModelRecord, ball: BallRecord, last: int) -> None:
    """Begin with the first stage.

    After a whole step it is that step's `last` one (FSAL), else a new evaluation. A ball in
    contact has it already: its rates told how long the step may be. Writes stages, evaluations.
    """
    if ball['phase'] != FLIGHT:
        return
    goes_on = (
        ball['step'] > 0.0
        and ball['last_stage_time'] == ball['begin']
        and not ball['time_stepping']
    )
    if goes_on:
        ball['stages'][0] = ball['stages'][last]
    else:
        stage(model, ball, 0, state_after(ball, NO_CHANGE), ball['begin'])


@kernel
def longest(model: ModelRecord, ball: BallRecord, wanted: float) -> float:
    """Longest step [s], `wanted` at most, that can't overlook any effect.

    It is found by the rates of the first stage.
    """
    if ball['phase'] != FLIGHT:
        return wanted
    state = load(ball['position']), load(ball['velocity']), load(ball['spin'])
    return longest_allowed_step(
        model.effects, model.land.ground, state, load(ball['stages'][0, 3:6]), wanted
    )


@kernel
def airspeed(model: ModelRecord, ball: BallRecord) -> float:
    """Airspeed [m/s] of the ball."""
    return length(
        sub(
            load(ball['velocity']),
            wind_at(model.effects, model.land.ground, load(ball['position'])),
        )
    )


@kernel
def hop(model: ModelRecord, ball: BallRecord) -> float:
    """Estimate of the time [s] for which a ball that has just left a surface stays off it.

    Without air.
    """
    normal = load(ball['normal'])
    pressing = -dot(gravity_at(model.effects, load(ball['position'])), normal)
    leaving = dot(load(ball['velocity']), normal)
    return 2.0 * leaving / pressing if pressing > 0.0 and leaving > LEAST_SPEED else inf


@generic
def step_by(method: MethodRecord, model: ModelRecord, ball: BallRecord) -> None:
    """Plan the next segment: one step from the ball's state.

    Writes curve, ending, integrator.
    """
    h = ball['step']
    begins = h == 0.0
    most = allowed(method, ball)
    brief = is_brief(method, ball)
    if begins:
        h, brief = first_step(method, airspeed(model, ball), hop(model, ball), most)
    rows = tableau(method, brief)
    weights = error_weights(method, brief)
    last = len(rows) - 1
    start(model, ball, last)
    whole = h
    # What an effect does between the stages would not show in the error estimate.
    h = longest(model, ball, h)
    while True:
        change = NO_CHANGE
        for i in range(1, last + 1):
            change = mix(ball, rows[i], i, h)
            time = ball['begin'] + h * total(rows[i], i)
            stage(model, ball, i, state_after(ball, change), time)
        error = error_in_metres(ball, weights, h)
        if stands(method, h, error, most):
            break
        h = next_step(method, h, error, most)
    # The first step is often the last one: unless it was cut, the next is as long, which saves a
    # root.
    ball['step'] = h if begins and h == whole else next_step(method, h, error, most)
    first = ball['stages'][0]
    final = ball['stages'][last]
    ball['span'] = h
    # After a brief step the last stage stands in another row than the next step looks for it.
    ball['last_stage_time'] = -1.0 if brief else ball['begin'] + h
    store(ball['origin'], load(ball['position']))
    store(
        ball['spin_coefficients'][3],
        add_scaled(load(ball['spin']), 1.0, (change[6], change[7], change[8])),
    )
    fit_segment(
        ball,
        (change[0], change[1], change[2]),
        (load(first[0:3]), load(final[0:3])),
        (load(first[3:6]), load(final[3:6])),
        (load(first[6:9]), load(final[6:9])),
    )
    ball['ending'] = STEP_END
