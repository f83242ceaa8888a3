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

"""Height maps from files, checked: arrays of NumPy, GeoTIFF, and the ASCII grids of ESRI."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .height_grid import Grid, npy, UNITS
from .input_file import beside, content
from .missing_heights import CUSTOMARY, filled
from .schema import below, Checker, CourseError, FAR, fields, flag, number, one_of, text, vector
from .terrain_file import esri, geotiff
from ..physics.geometry.heightmap import Heightmap
from ..physics.properties.material import Material

READERS = {'.npy': npy, '.asc': esri, '.tif': geotiff, '.tiff': geotiff}
JUMP = 100.0  # m between neighbours: no ground that golf is played on; a value for no data is
SIZE = number(1e-3)


def heightmap_of(
    known: Mapping[str, Material], folder: Path, sources: dict[str, bytes], notes: list[str]
) -> Checker:
    """Make the checker of a height map, an entry of ``ground``, that returns a `Heightmap`.

    `known` holds the materials by name, `folder` is that of the course; the file's bytes are put
    into `sources` under its name, and what looks wrong is added to `notes`. It raises
    `CourseError`, one line with file and reason.
    """
    units = one_of({name: name for name in UNITS})
    read = fields(
        {
            'heights': text,
            'material': one_of(known),
            'origin': vector(2),
            'spacing': SIZE,
            'subtract': subtract,
            'unit': units,
            'height_unit': units,
            'fill': flag,
            'no_data': number(-4e38, 4e38),
        },
        ('heights', 'material'),
    )

    def check(value: Any, key: str) -> Heightmap:
        entry, place = read(value, key), below(key, 'heights')
        name = entry['heights']
        try:
            path = beside(folder, name)
            sources[name] = content(path)
            with np.errstate(all='ignore'):  # whatever is not finite is refused
                return placed(grid_in(sources[name], path, entry), entry, path.name, notes)
        except MemoryError:
            raise CourseError(f'{place} {name}: is too large for the memory there is') from None
        except CourseError as error:
            raise CourseError(f'{place} {name}: {error}') from None

    return check


def subtract(value: Any, key: str) -> tuple[float, ...]:
    """Check x, y, and perhaps z, of the origin of the course in the file's own coordinates.

    These may be far.
    """
    far = number(-1e9, 1e9)
    if isinstance(value, list) and len(value) == 3:
        return vector(3, -1e9, 1e9)(value, key)
    return (*vector(2, -1e9, 1e9)(value, key), far(0, key))


def grid_in(raw: bytes, path: Path, entry: dict[str, Any]) -> Grid:
    """`Grid` in a file's bytes.

    CourseError where it holds anything else, or `entry` does not fit it.
    """
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise CourseError(f'is no height map; known: {", ".join(sorted(READERS))}')
    grid = READERS[suffix](raw, entry.get('unit'))
    if grid.heights.ndim != 2 or min(grid.heights.shape) < 2:
        raise CourseError(
            f'must hold rows of heights, 2 x 2 or more; its shape is {grid.heights.shape}'
        )
    if grid.spacing is None and 'spacing' not in entry:
        raise CourseError("says nothing of its cell size, so key 'spacing' is needed [m]")
    if grid.spacing is not None and 'spacing' in entry:
        raise CourseError(f"says its cell size itself, {grid.spacing:g}: leave out 'spacing'")
    if 'origin' in entry and 'subtract' in entry:
        raise CourseError("both 'origin' and 'subtract' are given; one is allowed")
    if grid.corner is None and 'subtract' in entry:
        raise CourseError("says nothing of where it lies: 'origin' does, leave out 'subtract'")
    return grid


def placed(grid: Grid, entry: dict[str, Any], name: str, notes: list[str]) -> Heightmap:
    """`Heightmap` of a `Grid`, in metres of the course; adds to `notes`."""
    said = grid.unit or entry.get('unit', 'metres')
    unit, height_unit = UNITS[said], UNITS[entry.get('height_unit') or grid.height_unit or said]
    spacing = (
        entry['spacing'] if grid.spacing is None else SIZE(grid.spacing * unit, 'its cell size')
    )
    less_x, less_y, less_z = entry.get('subtract', (0.0, 0.0, 0.0))
    origin = entry.get('origin', (0.0, 0.0))
    if grid.corner is not None and 'origin' not in entry:
        x, y = grid.corner
        origin = (x - less_x) * unit, (y - less_y) * unit
        if not max(map(abs, origin)) <= FAR:
            raise CourseError(
                f'lies at {x:.10g}, {y:.10g}: say where the course has its origin there, as '
                f'with `subtract: [{x:.0f}, {y:.0f}]`'
            )
    heights, where = (grid.heights - less_z) * height_unit, Places(origin, spacing)
    absent = absent_of(grid, entry)
    if absent.any():
        notes.append(f'{name}: {filling(grid, absent, where, entry.get("fill", False))}')
        heights = filled(np.where(absent, np.nan, heights))
    check_reach(heights, where)
    notes += [f'{name}: {note}' for note in jumps(heights, where)]
    heights.setflags(write=False)
    return Heightmap(heights, origin, spacing, entry['material'])


class Places:
    """Where on the course the heights of a map are, in words."""

    def __init__(self, origin: tuple[float, float], spacing: float) -> None:
        self.origin = origin
        self.spacing = spacing

    def __call__(self, row: int, column: int) -> str:
        """Say where a height is, by its row and column."""
        x, y = self.origin
        return f'at x {x + column * self.spacing:g}, y {y + row * self.spacing:g}'


def absent_of(grid: Grid, entry: dict[str, Any]) -> np.ndarray:
    """Mask of the heights of a grid that stand for no data."""
    values = (entry['no_data'],) if 'no_data' in entry else CUSTOMARY
    return ~np.isfinite(grid.heights) | grid.missing | np.isin(grid.heights, values)


def filling(grid: Grid, absent: np.ndarray, where: Places, fill: bool) -> str:
    """Note which heights of a grid are `absent` and filled; CourseError where they may not be.

    `where` tells where on the course one is.
    """
    if absent.all():
        raise CourseError('holds no heights: all stand for no data')
    place = tuple(map(int, np.argwhere(absent)[0]))
    of_all = f'{absent.sum()} of {absent.size}'
    if not fill:
        raise CourseError(
            f'height {list(map(int, place))} is {grid.heights[place]:g}, {where(*place)}: '
            f'{of_all} stand for no data; `fill: true` fills them from those around'
        )
    return (
        f'{of_all} heights stood for no data, the first {where(*place)}, and were filled from '
        'those around'
    )


def check_reach(heights: np.ndarray, where: Places) -> None:
    """Check that no height is out of reach or not a number; CourseError where one is."""
    if not (np.abs(heights) <= FAR).all():
        place = tuple(np.argwhere(~(np.abs(heights) <= FAR))[0])
        raise CourseError(
            f'height {list(map(int, place))} is {heights[place]}, {where(*place)}, and must be '
            f'a number from {-FAR:g} to {FAR:g}'
        )


def jumps(heights: np.ndarray, where: Places) -> list[str]:
    """Note where neighbours differ by more than ground does."""
    for axis in (0, 1):
        steps = np.abs(np.diff(heights, axis=axis))
        place = np.unravel_index(steps.argmax(), steps.shape)
        if steps[place] > JUMP:
            return [
                f'heights jump by {steps[place]:.4g} m beside the one {where(*map(int, place))}, '
                'and the surface swings there; if a value stands for no data, say `no_data: VALUE`'
            ]
    return []
