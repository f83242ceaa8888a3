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

"""Grids of heights as files have them, and the plainest of these: arrays of NumPy."""

from io import BytesIO
from math import prod
from typing import NamedTuple
import warnings

import numpy as np

from .schema import CourseError, shown

# Metres in each; the last is that of US state planes.
UNITS = {'metres': 1.0, 'feet': 0.3048, 'us_feet': 1200.0 / 3937.0}
HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


class Grid(NamedTuple):
    """Heights as they are in a file, rows from south to north.

    ``heights`` (ny, nx) float; ``missing`` (ny, nx) bool: what the file says is none. ``corner``:
    x, y of the first height of the first row, and ``spacing``, in the file's unit; None where the
    file does not say. ``unit``, ``height_unit``: names in `UNITS`, or None.
    """

    heights: np.ndarray
    missing: np.ndarray
    corner: tuple[float, float] | None = None
    spacing: float | None = None
    unit: str | None = None
    height_unit: str | None = None


def npy(raw: bytes, unit: str | None) -> Grid:
    """`Grid` of a .npy file."""
    if not raw.startswith(b'\x93NUMPY'):
        raise CourseError('is no .npy file')
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('ignore')
            check_size(raw)
            found = np.load(BytesIO(raw), allow_pickle=False)
    except (CourseError, MemoryError):
        raise
    except Exception as error:  # numpy has many ways of saying that a file is broken
        reason = ' '.join(str(error).split())
        raise CourseError(f'is no .npy file that can be read: {reason}') from None
    if not isinstance(found, np.ndarray) or found.dtype.kind not in 'fiu':
        raise CourseError(
            f'must hold numbers, not {getattr(found, "dtype", type(found).__name__)}'
        )
    return Grid(found.astype(float), np.zeros(found.shape, bool))


def check_size(raw: bytes) -> None:
    """Refuse an array whose header says more than its file holds.

    Numpy would allocate it first.
    """
    file = BytesIO(raw)
    version = np.lib.format.read_magic(file)
    if version in HEADERS:  # the others are of tables with names, and no heights
        shape, _, kind = HEADERS[version](file)
        if prod(map(int, shape)) * kind.itemsize > len(raw):
            raise CourseError(
                f'is no .npy file to be read: it tells of {shown(shape)} numbers, and ends'
            )
