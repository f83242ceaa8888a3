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

"""Colours, sizes and strokes that the parts of a picture share."""

from typing import Any

from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
import numpy as np

INK = '#22282b'
PALE = '#68747a'
GRID = '#d9dfe2'
SKY = '#f1f6f9'
SMALL = 8.0  # points
TEXT = 9.0
TITLE = 14.0

# Colours that stay apart on grass, sand and paper, for colour-blind eyes too: after Okabe and Ito.
FEW = ('#d55e00', '#0072b2', '#e6a100', '#b0468c', '#39a7e0', '#22282b')
CASING = [withStroke(linewidth=2.6, foreground='white', alpha=0.85)]
THIN_CASING = [withStroke(linewidth=1.7, foreground='white', alpha=0.6)]
HALO = [withStroke(linewidth=2.2, foreground='white')]


def colors(number: int) -> list[Any]:
    """Pick colours for `number` shots: a few stand apart, many are a scale from first to last."""
    if number <= len(FEW):
        return list(FEW[:number])
    return [colormaps['plasma'](0.9 * i / (number - 1)) for i in range(number)]


def stroke(number: int) -> dict[str, Any]:
    """Say how the paths of `number` shots are drawn, for ``plot``."""
    if number <= len(FEW):
        return {'linewidth': 1.5, 'path_effects': CASING}
    return {'linewidth': 0.9, 'path_effects': THIN_CASING}


def bare(axes: Axes, title: str = '', x: str = '', y: str = '') -> None:
    """Make `axes` look as all do: labels, a light grid, no box."""
    axes.set_title(title, loc='left', fontsize=TEXT, color=INK, pad=4, fontweight='bold')
    axes.set_xlabel(x, fontsize=SMALL, color=PALE, labelpad=2, loc='left')
    axes.set_ylabel(y, fontsize=SMALL, color=PALE, labelpad=3)
    axes.tick_params(labelsize=SMALL, colors=PALE, length=2.5)
    for side in ('top', 'right', 'bottom', 'left'):
        axes.spines[side].set_color(GRID)


def legible(places: np.ndarray, least: float) -> list[int]:
    """Choose those of `places`, rows of (x, y), that lie apart.

    Returns the numbers of those that are at least `least` from every one taken before.
    """
    taken: list[int] = []
    for i, (x, y) in enumerate(places):
        if all((x - places[j][0]) ** 2 + (y - places[j][1]) ** 2 >= least * least for j in taken):
            taken.append(i)
    return taken
