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

"""Triangles in space, cut along lines in plan."""

from collections.abc import Sequence

import numpy as np

ON_LINE = 1e-6  # m: a corner so near to the line is on it


def parted(corners: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Triangles cut where distances from a line change their sign; as they are elsewhere.

    Parameters
    ----------
    corners : ndarray, (n, 3, 3)
        x, y, z of the corners of each [m].
    distances : ndarray, (n, 3)
        Of each corner from the line, positive to one side of it [m].

    Returns
    -------
    ndarray, (m, 3, 3)
    """
    side = np.where(np.abs(distances) > ON_LINE, np.sign(distances), 0.0)
    cut = (side.min(1) < 0.0) & (side.max(1) > 0.0)
    if not cut.any():
        return corners
    # the corner that is alone on its side comes first
    alone = np.argmax(np.where(side.sum(1, keepdims=True) > 0.0, -side, side)[cut], 1)
    turn = (alone[:, np.newaxis] + range(3)) % 3
    rows = np.flatnonzero(cut)[:, np.newaxis]
    (a, b, c), (da, db, dc) = corners[rows, turn].swapaxes(0, 1), distances[rows, turn].T
    ab = a + (da / (da - db))[:, np.newaxis] * (b - a)
    ac = a + (da / (da - dc))[:, np.newaxis] * (c - a)
    pieces = [np.stack(piece, 1) for piece in ((a, ab, ac), (ab, b, c), (ab, c, ac))]
    whole = side[rows, turn][:, 1] != 0.0  # else ab is b, and no triangle is between them and c
    return np.concatenate([corners[~cut], pieces[0], pieces[1][whole], pieces[2]])


def parted_along(corners: np.ndarray, start: Sequence[float], end: Sequence[float]) -> np.ndarray:
    """Triangles (n, 3, 3), those cut that meet the straight way in plan from `start` to `end`."""
    way = np.subtract(end, start)
    length = np.hypot(*way)
    if length <= ON_LINE:
        return corners
    low, high = np.minimum(start, end), np.maximum(start, end)
    least, most = boxes(corners)
    near = ((least < high) & (low < most)).all(1)
    if not near.any():
        return corners
    off = corners[near, :, :2] - start
    distances = (off[:, :, 1] * way[0] - off[:, :, 0] * way[1]) / length
    return np.concatenate([corners[~near], parted(corners[near], distances)])


def boxes(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest x, y of triangles (n, 3, 3), (n, 2) each."""
    a, b, c = corners[:, :, :2].swapaxes(0, 1)  # many times as fast as min and max along an axis
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
