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

from math import ceil, floor

import numpy as np

from .parted_triangles import ON_LINE, parted
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
        x, y, z of the corners of each [m]; each lies in one stripe, as `banded` makes them.
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
        band = np.floor((corners[:, :, 0].min(1) + 2.0 * ON_LINE) / width).astype(int)
        light = light * np.where(band % 2 == 0, 1.0 + CONTRAST, 1.0 - CONTRAST)
    shaded = np.minimum(light, BRIGHTEST)[:, np.newaxis] * np.array(material.color, float)
    return np.clip(shaded, 0.0, 1.0)


def banded(corners: np.ndarray, material: Material) -> np.ndarray:
    """Triangles (n, 3, 3), cut where stripes of their material meet; as they are without any."""
    width = STRIPES.get(material.name)
    if not width or not len(corners):
        return corners
    x = corners[:, :, 0]
    for band in range(ceil(x.min() / width), floor(x.max() / width) + 1):
        corners = parted(corners, corners[:, :, 0] - band * width)
    return corners
