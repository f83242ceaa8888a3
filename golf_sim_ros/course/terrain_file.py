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

"""Terrain as surveys give it.

ESRI ASCII grids are read here, GeoTIFF by rasterio where it is installed.
"""

from typing import Any
import warnings

import numpy as np

from .height_grid import Grid, UNITS
from .input_file import decoded
from .schema import CourseError, shown
from ..optional_packages import how_to_get

HINT = f'needs rasterio: {how_to_get("terrain", "rasterio")}'
MOST = 4_000_000  # heights: 2 km x 2 km at 1 m
PROJECT = (
    'project it to metres, as with `gdalwarp -t_srs EPSG:{zone} -tr 1 1 -r cubic in.tif out.tif`'
)
NAMES = (
    'ncols',
    'nrows',
    'xllcorner',
    'yllcorner',
    'xllcenter',
    'yllcenter',
    'cellsize',
    'dx',
    'dy',
    'nodata_value',
)
SQUARE = 1e-6  # relative: cells are as long as they are wide
DEGREES = 0.02  # of a cell: 2 km, or 2 cm
BAND_UNITS = {
    'm': 'metres',
    'metre': 'metres',
    'metres': 'metres',
    'meter': 'metres',
    'meters': 'metres',
    'ft': 'feet',
    'foot': 'feet',
    'feet': 'feet',
    'us-ft': 'us_feet',
    'us survey foot': 'us_feet',
    'us_survey_foot': 'us_feet',
    'foot_us': 'us_feet',
    'ftus': 'us_feet',
}


def esri(raw: bytes, unit: str | None) -> Grid:
    """`Grid` of an ESRI ASCII grid, .asc; `unit` as the course says it, or None."""
    said, values = esri_head(decoded(raw).split())
    try:
        columns, rows = int(said['ncols']), int(said['nrows'])
        dx, dy = (float(said[name] if name in said else said['cellsize']) for name in ('dx', 'dy'))
        corner = first_height(said, 'x', dx), first_height(said, 'y', dy)
        heights = np.array(values, float)
        none = float(said['nodata_value']) if 'nodata_value' in said else np.nan
    except KeyError as error:
        raise CourseError(f'is no ESRI ASCII grid: {error.args[0]!r} is missing') from None
    except (TypeError, ValueError, OverflowError) as error:
        raise CourseError(f'is no ESRI ASCII grid: {" ".join(str(error).split())}') from None
    if min(rows, columns) < 0 or rows * columns != len(heights):
        raise CourseError(
            f'is no ESRI ASCII grid: it tells of {shown(rows)} rows of {shown(columns)} heights'
            f' and has {len(heights)}'
        )
    check_square(dx, dy)
    if unit is None and 0 < dx < DEGREES and abs(corner[0]) <= 360 and abs(corner[1]) <= 90:
        raise CourseError(
            f'seems to be in degrees, at {corner[0]:g}, {corner[1]:g}: '
            + PROJECT.format(zone=utm(*corner))
            + ', or say `unit: metres`'
        )
    heights = heights.reshape(rows, columns)[::-1]
    return Grid(heights, heights == none, corner, dx)


def first_height(said: dict[str, str], axis: str, size: float) -> float:
    """Find x or y of the first column or row: the middle of its cells."""
    if f'{axis}llcenter' in said:
        return float(said[f'{axis}llcenter'])
    return float(said[f'{axis}llcorner']) + 0.5 * size


def esri_head(words: list[str]) -> tuple[dict[str, str], list[str]]:
    """Values of the header by name, and the words after it."""
    said: dict[str, str] = {}
    place = 0
    while place + 1 < len(words) and words[place].lower() in NAMES:
        said[words[place].lower()] = words[place + 1]
        place += 2
    if not said:
        raise CourseError('is no ESRI ASCII grid: it does not begin with ncols')
    return said, words[place:]


def check_square(dx: float, dy: float) -> None:
    """Refuse cells that are no squares."""
    if not (0 < dx < np.inf and abs(dx - dy) <= SQUARE * dx):
        raise CourseError(
            f'has cells of {dx:g} x {dy:g}, and they must be squares: resample it, as with '
            '`gdalwarp -tr 1 1 -r cubic in.tif out.tif`'
        )


def utm(longitude: float, latitude: float) -> int:
    """EPSG code of the UTM zone of a place in degrees."""
    zone = int((longitude + 180.0) // 6.0) % 60 + 1
    return (32600 if latitude >= 0 else 32700) + zone


def geotiff(raw: bytes, unit: str | None) -> Grid:
    """`Grid` of a GeoTIFF file; `unit` as the course says it, or None."""
    try:
        import rasterio
        from rasterio.errors import RasterioError
    except ImportError:
        raise CourseError(HINT) from None
    try:
        with warnings.catch_warnings(), rasterio.MemoryFile(raw) as memory:
            warnings.simplefilter('ignore')  # a file without coordinates is refused below
            with memory.open(driver='GTiff') as file:
                return grid_of(file)
    except (RasterioError, ValueError, OSError) as error:
        if isinstance(error, CourseError):
            raise
        reason = ' '.join(str(error.__cause__ or error).split())
        raise CourseError(f'cannot be read by rasterio: {reason}') from None


def grid_of(file: Any) -> Grid:
    """`Grid` of a file that rasterio has opened."""
    if file.count != 1:
        raise CourseError(f'has {file.count} bands, and a height map has one')
    if file.width * file.height > MOST:
        raise CourseError(
            f'has {file.width} x {file.height} heights, over {MOST}: cut out what is played on'
        )
    kind = file.dtypes[0]
    if not kind.startswith('float') and not np.issubdtype(np.dtype(kind), np.integer):
        raise CourseError(f'must hold numbers, not {kind}')
    raw = file.read(1)
    heights = raw.astype(float) * file.scales[0] + file.offsets[0]
    missing = file.read_masks(1) == 0
    way = file.transform
    if file.crs is None and way.is_identity:
        return Grid(heights[::-1], missing[::-1])
    if file.crs is not None and file.crs.is_geographic:
        raise CourseError('is in degrees: ' + PROJECT.format(zone=utm(way.c, way.f)))
    if way.b or way.d or way.a < 0:
        raise CourseError(
            'is turned against its coordinates: `gdalwarp -r cubic in.tif out.tif` turns it'
        )
    check_square(way.a, abs(way.e))
    low = way.f + way.e * (file.height - 0.5) if way.e < 0 else way.f + 0.5 * way.e
    if way.e < 0:
        heights, missing = heights[::-1], missing[::-1]
    return Grid(
        heights,
        missing,
        (way.c + 0.5 * way.a, low),
        way.a,
        unit_of(file.crs),
        BAND_UNITS.get((file.units[0] or '').lower()),
    )


def unit_of(crs: Any) -> str | None:
    """Name of the unit of a projection, or None where there is none."""
    if crs is None:
        return None
    try:
        _, metres = crs.linear_units_factor
    except Exception:  # of a system without a linear unit
        return None
    for name, size in UNITS.items():
        if abs(metres - size) < 1e-9:
            return name
    raise CourseError(f'is in units of {metres:g} m; known: {", ".join(UNITS)}')
