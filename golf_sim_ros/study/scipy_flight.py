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

"""Flight by scipy's solve_ivp, as one would write it without this package: a yardstick."""

from collections.abc import Callable, Sequence
from math import log, sqrt
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from .scenes import Scene as StudyScene
from ..physics.effects import choose, Scene
from ..physics.effects.drag import drag_coefficient
from ..physics.effects.magnus import lift_per_ratio
from ..physics.simulation import checked_gusts

LONGEST = 60.0  # s


def fly(scene: StudyScene, method: str, rtol: float) -> np.ndarray:
    """State (x, y, z, velocity, spin) where a shot first touches level ground at height 0.

    The right-hand side is in scalar arithmetic, which is several times as fast as small arrays.
    """
    records = choose(scene.effects, Scene(scene.course)).on
    radius = scene.course.ball.radius
    gusts = checked_gusts(scene.wind)

    def height(time: float, state: Sequence[float]) -> float:
        return state[2] - radius

    vars(height).update(terminal=True, direction=-1)  # to end there, on the way down

    state = [0.0, 0.0, radius, *scene.shot.velocity, *scene.shot.spin]
    ends = [*gusts[1:, 0], LONGEST]
    for (begin, *wind), end in zip(gusts, ends):
        part = solve_ivp(
            rates(records, wind, radius),
            (begin, end),
            state,
            method,
            rtol=rtol,
            atol=rtol,
            events=height,
        )
        if len(part.t_events[0]):
            return part.y_events[0][-1]
        state = part.y[:, -1]
    raise ValueError(f'{scene.name}: still in the air after {LONGEST:g} s')


def rates(
    records: dict[str, Any], wind: Sequence[float], radius: float
) -> Callable[[float, Sequence[float]], tuple[float, ...]]:
    """Right-hand side for the effects' `records` in a `wind` at 10 m over level ground."""
    drag, magnus, decay = records['drag'], records['magnus'], records['spin_decay']
    g = records['gravity'].g
    profile = records.get('wind')
    cd, cl = drag_coefficient, lift_per_ratio

    def right_hand_side(time: float, state: Sequence[float]) -> tuple[float, ...]:
        _, _, z, vx, vy, vz, wx, wy, wz = state
        share = profile.weight * log(1.0 + max(z, 0.0) / profile.parameter) if profile else 0.0
        ux, uy, uz = vx - share * wind[0], vy - share * wind[1], vz - share * wind[2]
        vv = ux * ux + uy * uy + uz * uz
        speed, rr = sqrt(vv), magnus.reynolds * magnus.reynolds * vv
        ss = radius * radius * (wx * wx + wy * wy + wz * wz) / vv
        k = -drag.push * cd(drag.law, ss, rr) * speed
        cx, cy, cz = wy * uz - wz * uy, wz * ux - wx * uz, wx * uy - wy * ux
        ss = radius * radius * (cx * cx + cy * cy + cz * cz) / (vv * vv)
        lift = magnus.push * radius * cl(magnus.law, ss, rr)
        d = -decay.rate * speed
        return (
            vx,
            vy,
            vz,
            k * ux + lift * cx,
            k * uy + lift * cy,
            k * uz + lift * cz - g,
            d * wx,
            d * wy,
            d * wz,
        )

    return right_hand_side
