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

"""Lines of the log: one for each shot, and what is simulated."""

from collections.abc import Mapping, Sequence
from math import atan2, hypot, pi

from ..physics import Result, World

DEGREE = pi / 180
# Least speed [m/s] and greatest launch angle [rad] of what a shot resembles, first that fits:
# between the averages of the clubs on tour (driver 75 m/s at 11 deg, 5 iron 59 m/s at 12, wedge 46
# m/s at 24).
KINDS = (
    ('driver-like shot', 65.0, 16 * DEGREE),
    ('iron-like shot', 48.0, 22 * DEGREE),
    ('wedge-like shot', 20.0, pi),
    ('putt', 0.0, 2 * DEGREE),
    ('chip', 0.0, pi),
)
LONG = 20.0  # m; of shorter shots a player wants to know the centimetres


def kind(velocity: Sequence[float]) -> str:
    """Kind of shot that a launch at `velocity` resembles, by name."""
    x, y, z = velocity
    level = hypot(x, y)
    speed, angle = hypot(level, z), atan2(z, level)
    return next(name for name, least, most in KINDS if speed >= least and angle <= most)


def line(result: Result) -> str:
    """Write the line for the log about `result`.

    Such as ``driver-like shot: carry 251 m, total 268 m, 3 m left, fairway, 112 m to the hole``.
    """
    digits = 0 if result.total >= LONG else 2
    parts = [f'total {result.total:.{digits}f} m', side(result.side, digits), place(result)]
    if result.carry > 0.0:
        parts.insert(0, f'carry {result.carry:.{digits}f} m')
    if result.to_hole is not None and result.status != 'holed':
        parts.append(f'{result.to_hole:.{digits}f} m to the hole')
    return f'{kind(result.velocity)}: {", ".join(parts)}'


def effect_lines(world: World) -> list[str]:
    """Lines for the log about what is simulated, and what is not and why."""
    lines = [f'simulated: {", ".join(world.effects_on) or "nothing"}; accuracy {world.accuracy}']
    if world.effects_off:
        lines.append(f'left out: {with_reasons(world.effects_off)}')
    return lines


def with_reasons(reasons: Mapping[str, str]) -> str:
    """Names with their `reasons`, a dict by name.

    Such as ``wind (no wind); drag, magnus (no air)``.
    """
    names: dict[str, list[str]] = {}
    for name, reason in reasons.items():
        names.setdefault(reason, []).append(name)
    return '; '.join(f'{", ".join(some)} ({reason})' for reason, some in names.items())


def side(metres: float, digits: int) -> str:
    """Say how far left or right of the line a shot ended."""
    distance = f'{abs(metres):.{digits}f}'
    if float(distance) == 0.0:
        return 'straight'
    return f'{distance} m {"left" if metres > 0 else "right"}'


def place(result: Result) -> str:
    """Say where the ball lies, or why the shot ended."""
    return result.lie if result.status == 'at_rest' else result.status.replace('_', ' ')
