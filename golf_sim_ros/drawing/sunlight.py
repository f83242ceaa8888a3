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

"""Sun and mowing stripes on triangles of the ground, for viewers that show colours as they are."""

from collections.abc import Sequence
from math import floor
from typing import Any

import numpy as np

from ..physics import Material

SUN = np.array([-0.676, 0.586, 0.446])  # unit vector towards it: low, from behind on the left
SHADE = 0.5  # brightness of what the sun does not reach; level ground has 1
BRIGHTEST = 1.5
STRIPES = {'fairway': 7.0, 'tee': 1.5, 'green': 1.8, 'firm_green': 1.8, 'soft_green': 1.8}  # m
CONTRAST = 0.07  # of a stripe to either side


def lit(corners: np.ndarray, material: Material) -> np.ndarray:
    """Colours of triangles of one material in the sun.

    Parameters
    ----------
    corners : ndarray, (n, 3, 3)
        x, y, z of the corners of each [m].
    material : Material

    Returns
    -------
    ndarray, (n, 3)
        RGB, each 0 to 1.
    """
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(lengths > 0.0, lengths, 1.0)
    normals = np.where(normals[:, 2:] < 0.0, -normals, normals)
    light = SHADE + (1.0 - SHADE) * np.clip(normals @ SUN, 0.0, None) / SUN[2]
    width = STRIPES.get(material.name)
    if width:
        band = np.floor(corners[:, :, 0].mean(1) / width).astype(int)
        light = light * np.where(band % 2 == 0, 1.0 + CONTRAST, 1.0 - CONTRAST)
    shaded = np.minimum(light, BRIGHTEST)[:, np.newaxis] * np.array(material.color, float)
    return np.clip(shaded, 0.0, 1.0)


def banded(triangles: Sequence[Any], material: Material) -> Sequence[Any]:
    """Triangles of (x, y), cut where stripes of their material meet; as they are without any."""
    width = STRIPES.get(material.name)
    if not width:
        return triangles
    found = []
    for triangle in triangles:
        low, high = min(corner[0] for corner in triangle), max(corner[0] for corner in triangle)
        for band in range(floor(low / width), floor(high / width) + 1):
            part = beyond(triangle, band * width, 1.0)
            part = beyond(part, (band + 1) * width, -1.0)
            found += [(part[0], b, c) for b, c in zip(part[1:], part[2:])]
    return found


def beyond(polygon: Sequence[Any], edge: float, side: float) -> list:
    """Part of a convex polygon of (x, y) where `side` (x - edge) is not negative."""
    kept = []
    for (ax, ay), (bx, by) in zip(polygon, [*polygon[1:], *polygon[:1]]):
        a, b = side * (ax - edge), side * (bx - edge)
        if a >= 0.0:
            kept.append((ax, ay))
        if (a > 0.0 > b) or (a < 0.0 < b):
            kept.append((edge, ay + (by - ay) * (edge - ax) / (bx - ax)))
    return kept
