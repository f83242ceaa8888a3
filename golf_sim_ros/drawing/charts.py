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

"""Speed, height and spin over the time since the strike."""

from collections.abc import Sequence

from matplotlib.axes import Axes
import numpy as np

from .shots import DrawnShot
from .style import bare, colors, GRID
from .views import path, touches


def charts(axes: Sequence[Axes], shots: Sequence[DrawnShot]) -> None:
    """Draw the three charts into three `axes`."""
    for place, (title, amount, at_bounce) in zip(axes, CHARTS):
        for shot, color in zip(shots, colors(len(shots))):
            path(place, shot, shot.times - shot.times[0], amount(shot), color, len(shots))
            touches(
                place,
                [(c.time - shot.times[0], at_bounce(shot, c)) for c in shot.collisions],
                color,
                len(shots),
            )
        place.set_xlim(0.0, max(shot.times[-1] - shot.times[0] for shot in shots) * 1.02 + 1e-3)
        place.grid(color=GRID, linewidth=0.6, zorder=0)
        place.set_axisbelow(True)
        bare(place, title, 'time since the strike [s]')
        for side in ('top', 'right'):
            place.spines[side].set_visible(False)
    for place in axes:
        low, high = place.dataLim.intervaly
        place.set_ylim(low - 0.04 * (high - low) if low < 0.0 else 0.0)


def speed(shot: DrawnShot) -> np.ndarray:
    """Speed of the ball [m/s]."""
    return np.linalg.norm(shot.velocities, axis=1)


def height(shot: DrawnShot) -> np.ndarray:
    """Height over the strike [m]."""
    return shot.positions[:, 2] - shot.positions[0, 2]


def spin(shot: DrawnShot) -> np.ndarray:
    """Rate of spin [rad/s]."""
    return np.linalg.norm(shot.spins, axis=1)


CHARTS = (
    ('Speed [m/s]', speed, lambda shot, hit: np.linalg.norm(hit.velocity_after)),
    (
        'Height over the strike [m]',
        height,
        lambda shot, hit: hit.position[2] - shot.positions[0, 2],
    ),
    ('Spin [rad/s]', spin, lambda shot, hit: np.linalg.norm(hit.spin_after)),
)
