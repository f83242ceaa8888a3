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

"""Bytes of the files that a course consists of.

Heights and corners are rounded, so that they do not depend on the last digit of anybody's sine.
"""

from io import BytesIO

import numpy as np

HEIGHTS_TO = 4  # decimals of a metre
CORNERS_TO = 3
STL_TRIANGLE = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])


def npy(heights):
    """.npy file of `heights` [m], (ny, nx), in single precision."""
    file = BytesIO()
    np.save(file, rounded(heights).astype('<f4'))
    return file.getvalue()


def rounded(heights):
    """`heights` as they are written."""
    return np.round(heights, HEIGHTS_TO) + 0.0  # + 0.0: there is no -0


def stl(corners):
    """Binary STL file of triangles, (n, 3, 3) [m]."""
    triangles = np.zeros(len(corners), STL_TRIANGLE)
    triangles['corners'] = np.round(corners, CORNERS_TO) + 0.0
    return bytes(80) + len(corners).to_bytes(4, 'little') + triangles.tobytes()


def place(numbers):
    """Coordinates as a YAML list."""
    return '[' + ', '.join(f'{round(float(n), 2) + 0.0:g}' for n in numbers) + ']'


def polygon(corners):
    """Polygon as a YAML list."""
    return '[' + ', '.join(map(place, corners)) + ']'


def rectangle(low, high):
    """Corners of the rectangle between two (x, y)."""
    return [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]


def map_course(name, text, land, extent, zones, **values):
    """Names and bytes of the files of a course in one height map, `land`, painted with `zones`.

    `extent`: its corners of least and greatest x, y, and its spacing. `text` takes these and the
    `values` in.
    """
    low, high, spacing = extent
    painted = [
        f'  - {{material: {material}, polygon: {polygon(corners)}}}' for material, corners in zones
    ]
    content = text.format(
        outline=polygon(rectangle(low, high)),
        low=list(low),
        spacing=spacing,
        zones='\n'.join(painted),
        **values,
    )
    return {f'{name}.yaml': content.encode(), f'{name}.npy': npy(land)}
