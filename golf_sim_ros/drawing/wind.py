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

"""The wind as arrows, seen from above."""

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Circle
import numpy as np

from .shots import DrawnShot
from .style import colors, GRID, PALE, SKY, SMALL

CALM = 0.05  # m/s: less is called calm


def blown(shot: DrawnShot) -> np.ndarray:
    """Find the winds that blew during `shot`, rows of x, y, z [m/s]."""
    began = max(np.searchsorted(shot.wind[:, 0], shot.times[0], 'right') - 1, 0)
    ended = max(np.searchsorted(shot.wind[:, 0], shot.times[-1], 'left'), began + 1)
    return shot.wind[began:ended, 1:]


def speeds(shots: Sequence[DrawnShot]) -> tuple[float, float]:
    """Least and greatest speed [m/s] of the wind during `shots`."""
    every = np.linalg.norm(np.vstack([blown(shot) for shot in shots]), axis=1)
    return every.min(), every.max()


def mean(shot: DrawnShot) -> float:
    """Mean speed [m/s] of the winds that blew during `shot`."""
    return float(np.linalg.norm(blown(shot), axis=1).mean())


def rose(axes: Axes, shots: Sequence[DrawnShot]) -> None:
    """Draw where the air went during each shot into square `axes`."""
    low, high = speeds(shots)
    strongest = (
        high if len(shots) == 1 else max(np.hypot(*blown(shot).mean(0)[:2]) for shot in shots)
    )
    axes.add_patch(Circle((0, 0), 1.0, facecolor=SKY, edgecolor=GRID, linewidth=0.8))
    for shot, color in zip(shots, colors(len(shots))):
        arrows(axes, blown(shot)[:, :2] / max(strongest, CALM), color, len(shots))
    seen = '\nseen from above' if high >= CALM else ''
    axes.text(
        -1.2, 0, caption(low, high) + seen, ha='right', va='center', fontsize=SMALL, color=PALE
    )
    axes.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05))
    axes.set_axis_off()


def arrows(axes: Axes, winds: np.ndarray, color: Any, shots: int) -> None:
    """Draw the mean of `winds`, rows of x, y, 1 being the strongest.

    Of a single shot, each of them too.
    """
    for wind in winds if shots == 1 and len(winds) > 1 else ():
        axes.plot(*zip((0, 0), wind), color=color, linewidth=0.6, alpha=0.45, zorder=3)
    x, y = 0.92 * winds.mean(0)
    if np.hypot(x, y) > 0.05:
        axes.annotate(
            '',
            (x, y),
            (0, 0),
            zorder=4,
            arrowprops={
                'arrowstyle': '-|>,head_length=0.35,head_width=0.16',
                'color': color,
                'linewidth': 1.3,
                'shrinkA': 0,
                'shrinkB': 0,
            },
        )


def caption(low: float, high: float) -> str:
    """Put the wind in words."""
    if high < CALM:
        return 'calm'
    return f'wind {high:.1f} m/s' if high - low < CALM else f'wind {low:.1f} to {high:.1f} m/s'
