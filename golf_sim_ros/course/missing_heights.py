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

"""Missing heights: values that stand for no data, and how they are filled."""

import numpy as np

# What programs write where there is no height, by custom: of Arc/Info, SRTM, GDAL and the like.
CUSTOMARY = (-9999.0, -99999.0, -32768.0, -32767.0, -3.4028234663852886e38)
SWEEPS = 50  # towards the mean of the neighbours, at each scale


def filled(heights: np.ndarray) -> np.ndarray:
    """`heights` with smooth ground in place of what is not a number.

    It is that of Laplace's equation, as a skin is stretched over a hole: within the heights
    around. It is solved on a grid half as fine, and so on, for a first guess; then towards the
    mean of the neighbours.
    """
    known = np.isfinite(heights)
    if known.all():
        return heights
    rows, columns = heights.shape
    guess = np.kron(filled(halved(heights, known)), np.ones((2, 2)))[:rows, :columns]
    heights = np.where(known, heights, guess)
    for _ in range(SWEEPS):
        edge = np.pad(heights, 1, 'edge')
        mean = 0.25 * (edge[:-2, 1:-1] + edge[2:, 1:-1] + edge[1:-1, :-2] + edge[1:-1, 2:])
        heights = np.where(known, heights, mean)
    return heights


def halved(heights: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Means of the `known` heights of each two by two; not a number where there is none."""
    rows, columns = heights.shape
    pad = ((0, rows % 2), (0, columns % 2))
    sums = np.pad(np.where(known, heights, 0.0), pad)
    counts = np.pad(known.astype(float), pad)
    sums, counts = (
        part[::2, ::2] + part[1::2, ::2] + part[::2, 1::2] + part[1::2, 1::2]
        for part in (sums, counts)
    )
    with np.errstate(invalid='ignore', divide='ignore'):
        return sums / counts
