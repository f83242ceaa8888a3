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

"""Zones: polygons in plan that paint the ground with another material."""

from typing import Any, Iterable, NamedTuple, Union

import numpy as np

from .polygon import Outline
from ..properties.material import Material


class Zone(NamedTuple):
    """Zone with corners (x, y) of its `polygon`.

    `cut` holds polygons within that it does not repaint.
    """

    material: Material
    polygon: Outline
    cut: tuple[Outline, ...] = ()


def zones_of(zones: Iterable[Union[Zone, tuple[Any, ...]]]) -> tuple[Zone, ...]:
    """`Zone` records of `zones`, which may also be pairs of material and polygon."""
    return tuple(Zone(*zone) for zone in zones)


def places_inside(polygon: Any, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether `polygon` holds each place: a ray to the right leaves it an odd number of times.

    `x` and `y` are arrays of the same shape.
    """
    odd = np.zeros(np.shape(x), bool)
    before = polygon[-1]
    for corner in polygon:
        (ax, ay), (bx, by) = before, corner
        crossed = (ay > y) != (by > y)
        odd[crossed] ^= x[crossed] < ax + (bx - ax) * (y[crossed] - ay) / (by - ay)
        before = corner
    return odd
