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

"""Table of the results of the shots."""

from collections.abc import Callable, Sequence
from math import degrees, hypot
from typing import Any

from matplotlib.axes import Axes
import numpy as np

from . import wind
from .shots import DrawnShot
from .style import colors, GRID, INK, PALE, SMALL
from ..physics import Result

ROW = 0.22  # inches
ENDINGS = {'at_rest': 'at rest', 'out_of_bounds': 'out of bounds', 'time_limit': 'time limit'}


def length(metres: float | None) -> str:
    """Text of a length."""
    return '' if metres is None else f'{metres:.2f}'


def aside(metres: float) -> str:
    """Say how far to the left or right."""
    amount = length(abs(metres))
    return amount if float(amount) == 0.0 else f'{amount} {"L" if metres > 0.0 else "R"}'


def flight(value: Callable[[Result], str]) -> Callable[[DrawnShot], str]:
    """Make the function that writes a value of a shot, or a dash where the ball did not fly."""
    return lambda shot: value(shot.result) if shot.flew else '–'


# Columns of words stand to the left, those of numbers to the right.
WORDS = ('ball', 'ended', 'lie')
GAP = 0.015

# Heading, unit, width against the others, text of a shot.
Column = tuple[str, str, float, Callable[[DrawnShot], str]]
COLUMNS: tuple[Column, ...] = (
    ('shot', '', 0.7, lambda s: str(s.result.shot)),
    ('ball', '', 1.0, lambda s: s.result.ball),
    ('ended', '', 1.5, lambda s: ENDINGS.get(s.result.status, s.result.status)),
    ('lie', '', 1.1, lambda s: s.result.lie or '–'),
    ('speed', 'm/s', 0.9, lambda s: f'{hypot(*s.result.velocity):.1f}'),
    ('spin', 'rad/s', 0.9, lambda s: f'{hypot(*s.result.spin):.0f}'),
    ('carry', 'm', 0.9, flight(lambda r: length(r.carry))),
    ('apex', 'm', 0.9, flight(lambda r: length(r.apex))),
    ('flight', 's', 0.9, flight(lambda r: f'{r.flight_time:.2f}')),
    ('landing', 'deg', 1.0, flight(lambda r: f'{degrees(r.landing_angle):.1f}')),
    ('bounces', '', 1.0, lambda s: str(s.result.bounces)),
    ('total', 'm', 0.9, lambda s: length(s.result.total)),
    ('side', 'm', 1.0, lambda s: aside(s.result.side)),
    ('duration', 's', 1.0, lambda s: f'{s.result.duration:.2f}'),
    ('to hole', 'm', 1.0, lambda s: length(s.result.to_hole)),
    ('wind', 'm/s', 0.9, lambda s: f'{wind.mean(s):.1f}'),
)


def height(shots: Sequence[DrawnShot]) -> float:
    """Inches that a table of `shots` takes."""
    return ROW * (len(shots) + 1.5)


def table(axes: Axes, shots: Sequence[DrawnShot]) -> None:
    """Write a row for each of `shots` into `axes`."""
    axes.set_axis_off()
    axes.set(xlim=(0.0, 1.0), ylim=(len(shots), -1.5))
    shown = columns(shots)
    ends = np.cumsum([width for _, _, width, _ in shown])
    ends = ends / ends[-1]
    for (heading, unit, _, text), left, right in zip(shown, [0.0, *ends], ends):
        words = heading in WORDS
        place, align = (left + GAP, 'left') if words else (right, 'right')
        write(axes, place, -1.1, heading, align, INK)
        write(axes, place, -0.4, unit, align, PALE)
        for row, shot in enumerate(shots):
            write(axes, place, row + 0.5, text(shot), align, INK)
    for row, color in enumerate(colors(len(shots))):
        axes.plot([0.0, 0.012], [row + 0.5] * 2, color=color, linewidth=4.0, solid_capstyle='butt')
        axes.axhline(row, color=GRID, linewidth=0.6)


def columns(shots: Sequence[DrawnShot]) -> list[Column]:
    """Columns that are not empty for `shots`."""
    useless = set()
    if len({shot.result.ball for shot in shots}) == 1:
        useless.add('ball')
    if all(shot.result.to_hole is None for shot in shots):
        useless.add('to hole')
    return [column for column in COLUMNS if column[0] not in useless]


def write(axes: Axes, x: float, y: float, text: str, align: str, color: Any) -> None:
    """Write one cell."""
    axes.text(x, y, text, ha=align, va='center', fontsize=SMALL, color=color)
