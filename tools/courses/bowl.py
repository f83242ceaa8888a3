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

"""A shallow bowl of triangles under a cut in the ground."""

import numpy as np

UNDER = 0.15  # m that the bowl reaches under the rim, where nobody can get
RINGS = (1.0, 0.78, 0.5, 0.22)  # of the way from the middle to the rim
SIDE = 2  # triangles to a side of the outline


def bowl(outline, rim, lip, depth):
    """Triangles (n, 3, 3), facing up, of a bowl in `outline`.

    The outline is of corners (x, y) that go round counterclockwise. The bowl begins `lip` [m]
    below the height of the `rim` and is `depth` [m] deep from the rim to its middle.
    """
    corners = np.asarray(outline, float)
    middle = corners.mean(0)
    after = np.roll(corners, -1, axis=0)
    edge = np.concatenate(
        [corners + (after - corners) * i / SIDE for i in range(SIDE)], 1
    ).reshape(-1, 2)
    reach = np.linalg.norm(edge - middle, axis=1, keepdims=True)
    rings = [middle + share * (edge - middle) for share in RINGS]
    rings[0] = middle + (edge - middle) * (1.0 + UNDER / reach)
    heights = [rim - lip - (depth - lip) * (1.0 - share * share) for share in RINGS]
    levels = [np.column_stack((ring, np.full(len(ring), z))) for ring, z in zip(rings, heights)]
    bottom = np.array((*middle, rim - depth))
    triangles = []
    for outer, inner in zip(levels, levels[1:]):
        for i in range(len(edge)):
            j = (i + 1) % len(edge)
            triangles += [(outer[i], outer[j], inner[j]), (outer[i], inner[j], inner[i])]
    triangles += [
        (levels[-1][i], levels[-1][(i + 1) % len(edge)], bottom) for i in range(len(edge))
    ]
    return np.array(triangles)
