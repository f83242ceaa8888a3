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

"""Levels of accuracy of a wind field: how fine the grid is, how far a flow is marched to rest."""

from typing import NamedTuple

from .march import March


class Level(NamedTuple):
    """Level of accuracy.

    ``cells`` along the longer side of the land, none smaller than ``smallest`` [m]; layers from
    ``lowest`` [m] on, growing by ``growth``; ``march``, or None for the mass-consistent model,
    which knows neither lees nor trees; ``use``: what it is for.
    """

    cells: int
    smallest: float
    lowest: float
    growth: float
    march: March | None
    use: str


ACCURACY = {
    'mass': Level(50, 3.0, 0.6, 1.2, None, 'a first look: no lees, and trees do nothing'),
    'sketch': Level(
        32, 4.0, 0.8, 1.25, March(6.0, 120, 1e-3, 5e-3), 'trying out where trees shall stand'
    ),
    'standard': Level(50, 3.0, 0.6, 1.2, March(5.0, 400, 1e-4, 2e-3), 'play'),
    'reference': Level(
        100, 1.5, 0.5, 1.15, March(5.0, 900, 2e-5, 5e-4), 'what the others are measured by'
    ),
}


def level_of(accuracy: str | Level) -> Level:
    """`Level` of a name, or a `Level` itself; ValueError that names those there are."""
    if isinstance(accuracy, Level):
        return accuracy
    if accuracy not in ACCURACY:
        raise ValueError(f'accuracy {accuracy!r} is unknown; known: {", ".join(ACCURACY)}')
    return ACCURACY[accuracy]
