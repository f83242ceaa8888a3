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
from math import inf, log, sqrt
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from .scenes import Scene as StudyScene
from ..physics import ACCURACY
from ..physics.effects import choose, Scene
from ..physics.effects.drag import drag_coefficient
from ..physics.effects.magnus import lift_per_ratio
from ..physics.mechanics.vector import UP
from ..physics.response.ground_impact import bounced
from ..physics.scene.kernel_model import build_model
from ..physics.simulation import checked_gusts

LONGEST = 60.0  # s


def fly(scene: StudyScene, method: str, rtol: float) -> np.ndarray:
    """State (x, y, z, velocity, spin) where a shot first touches level ground at height 0."""
    return flyer(scene, method, rtol)(1)[0]


def flyer(scene: StudyScene, method: str, rtol: float) -> Callable[[int], list[np.ndarray]]:
    """Make the function that plays a shot onto level ground at height 0, hop by hop.

    ``play(count)`` gives the states (x, y, z, velocity, spin) in which the ball comes down at its
    first `count` touches. Between them scipy starts anew, from where the ball leaves the ground by
    this package's law of impact, in plain Python. The right-hand side is in scalar arithmetic,
    which is several times as fast as small arrays.
    """
    chosen = choose(scene.effects, Scene(scene.course))
    land = build_model(scene.course, chosen.records, ACCURACY['reference']).land
    radius, g = scene.course.ball.radius, chosen.on['gravity'].g
    gusts = checked_gusts(scene.wind)
    parts = [
        (begin, end, rates(chosen.on, wind, radius))
        for (begin, *wind), end in zip(gusts, [*gusts[1:, 0], LONGEST])
    ]

    def height(time: float, state: Sequence[float]) -> float:
        return state[2] - radius

    vars(height).update(terminal=True, direction=-1)  # to end there, on the way down

    def down(time: float, state: Sequence[float], rising: float) -> tuple[float, np.ndarray]:
        """Time and state at the next touch; a first step of at most `rising` [s]."""
        for begin, end, right_hand_side in parts:
            if end <= time:
                continue
            first = None if rising == inf else min(rising, end - time)
            part = solve_ivp(
                right_hand_side,
                (time, end),
                state,
                method,
                rtol=rtol,
                atol=rtol,
                events=height,
                first_step=first,
            )
            if len(part.t_events[0]):
                return part.t_events[0][-1], part.y_events[0][-1]
            time, state, rising = end, part.y[:, -1], inf
        raise ValueError(f'{scene.name}: still in the air after {LONGEST:g} s')

    def play(count: int) -> list[np.ndarray]:
        time, rising = 0.0, inf
        state: Sequence[float] = [0.0, 0.0, radius, *scene.shot.velocity, *scene.shot.spin]
        touches: list[np.ndarray] = []
        while len(touches) < count:
            if touches:
                x, y, _, *motion = touches[-1].tolist()
                velocity, spin = bounced(
                    land, (tuple(motion[:3]), tuple(motion[3:])), UP, land.materials[0]
                )
                # Up to the top of the hop: a first step over all of it would see no way down.
                rising = velocity[2] / g
                state = [x, y, radius, *velocity, *spin]
            time, touch = down(time, state, rising)
            touches.append(touch)
        return touches

    return play


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
