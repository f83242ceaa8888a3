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

"""Wind field of a course: saved, loaded, and read at places."""

from collections.abc import Sequence
from io import BytesIO
import os
from os import fspath
from pathlib import Path
from typing import NamedTuple
from zipfile import ZIP_DEFLATED, ZIP_LZMA, ZipFile, ZipInfo

import numpy as np
from numpy.typing import ArrayLike

from .errors import FieldError
from .land_survey import land_digest, log_profile, Survey
from ..physics.effects.wind_field import directions_beside, layout_of, WindAtlas
from ..physics.scene.course_record import Course

Triple = tuple[np.ndarray, np.ndarray, np.ndarray]

FORMAT = 1
STEP = 2e-3  # of what is kept in whole numbers: of the local wind
MOST = 30.0  # times the logarithmic law: no field has more
MOST_NUMBERS = 2**27  # of ratios: a hundred directions at `reference`
MOST_BYTES = 5 * MOST_NUMBERS  # of all arrays, unpacked
NAMES = (
    *('format', 'ratios', 'roughness', 'residuals', 'angles', 'plan', 'heights'),
    *('ground_x', 'ground_y', 'ground', 'ground_roughness', 'digest', 'accuracy'),
)


class Cells(NamedTuple):
    """What was solved for, at the middles of cells.

    ``ratios`` (n, nx, ny, nz, 4): velocity over the logarithmic law of the local roughness, and
    the standard deviation of turbulence along the wind over the wind at 10 m; ``roughness`` (nx,
    ny): length [m]; ``residuals`` (n, steps): change of the flow in each step that it was marched
    to rest, 0 once it was; see `march.March`.
    """

    ratios: np.ndarray
    roughness: np.ndarray
    residuals: np.ndarray


class WindField:
    """Wind over a course by direction.

    Parameters
    ----------
    cells : Cells
    atlas : WindAtlas
        Its numbers; the coefficients ``ratios`` and ``roughness`` are made of `cells`.
    survey : Survey
        Of the ground, for `velocity`.
    digest : str
        Of the land that it was solved for; see `land_survey.land_digest`.
    accuracy : str

    Attributes
    ----------
    atlas : WindAtlas
        What the effect ``wind_field`` reads.
    """

    def __init__(
        self, cells: Cells, atlas: WindAtlas, survey: Survey, digest: str, accuracy: str
    ) -> None:
        self.cells, self.survey, self.digest, self.accuracy = cells, survey, digest, accuracy
        self.atlas = atlas._replace(
            ratios=coefficients(cells.ratios), roughness=-np.log(cells.roughness)
        )

    @property
    def angles(self) -> np.ndarray:
        """Directions that were solved for [rad]."""
        return self.atlas.angles

    def fits(self, course: Course) -> None:
        """Check that this is the field of a `course`; `FieldError` where its land is another."""
        log_profile(course)
        if self.digest != land_digest(course):
            raise FieldError(
                'was made for another ground, other trees or another roughness; make it anew: '
                'ros2 run golf_sim_ros wind_field COURSE -o FILE.npz'
            )

    def velocity(self, points: ArrayLike, wind: Sequence[float]) -> np.ndarray:
        """Velocity of the air.

        Parameters
        ----------
        points : array_like, (n, 3)
            Places [m].
        wind : (float, float, float), or (float, float)
            10 m over level ground far upstream [m/s].

        Returns
        -------
        ndarray, (n, 3)
            [m/s]
        """
        points = np.asarray(points, float).reshape(-1, 3)
        blown = np.append(np.asarray(wind, float), 0.0)[:3]
        atlas, layout = self.atlas, layout_of(self.atlas)
        low, high, first, second = directions_beside(atlas.angles, blown.tolist())
        now = first * atlas.ratios[low].astype(float) + second * atlas.ratios[high].astype(float)
        ground = self.survey.heights_at(points[:, 0], points[:, 1])
        above = np.maximum(points[:, 2] - ground, 0.0)
        stretch = np.maximum(1.0 - (ground - layout.datum) / layout.top, 0.1)
        levels = np.log(1.0 + above / stretch / layout.first) * layout.along_z - layout.shift
        plan = [
            spline((points[:, axis] - start) * along, count)
            for axis, start, along, count in (
                (0, layout.x, layout.along_x, now.shape[0]),
                (1, layout.y, layout.along_y, now.shape[1]),
            )
        ]
        up = spline(levels, now.shape[2])
        ratio, smooth = np.zeros((len(points), 3)), np.zeros(len(points))
        for i, a in zip(*plan[0]):
            for j, b in zip(*plan[1]):
                smooth = smooth + a * b * atlas.roughness[i, j]
                for k, c in zip(*up):
                    ratio = ratio + (a * b * c)[:, None] * now[i, j, k, :3]
        ratio[:, 2] += blown[2]
        return (layout.weight * np.log(1.0 + above * np.exp(smooth)))[:, None] * ratio

    def save(self, path: str | os.PathLike, compact: bool = False) -> None:
        """Save as a .npz file, which `load` reads.

        Parameters
        ----------
        path : str or path
        compact : bool
            In steps of `STEP` of the local wind, in a tenth of the space.
        """
        ratios = self.cells.ratios
        if compact:
            ratios = differences(np.round(ratios / STEP).astype(np.int16))
        atlas, survey = self.atlas, self.survey
        content = {
            'format': FORMAT,
            'ratios': ratios,
            'roughness': self.cells.roughness,
            'residuals': self.cells.residuals,
            'angles': atlas.angles,
            'plan': [atlas.origin, atlas.spacing],
            'heights': [atlas.first, atlas.growth, atlas.datum, atlas.top, atlas.upstream],
            'ground_x': survey.x,
            'ground_y': survey.y,
            'ground': survey.heights.astype(np.float32),
            'ground_roughness': survey.roughness.astype(np.float32),
            'digest': self.digest,
            'accuracy': self.accuracy,
        }
        with ZipFile(path, 'w', ZIP_LZMA if compact else ZIP_DEFLATED) as archive:
            for name, values in content.items():
                member = ZipInfo(f'{name}.npy')
                member.compress_type = archive.compression
                with archive.open(member, 'w') as file:
                    np.lib.format.write_array(file, np.asarray(values), allow_pickle=False)

    @classmethod
    def load(cls, path: str | os.PathLike) -> 'WindField':
        """Load a field that `save` wrote.

        Raises
        ------
        FieldError
            The file cannot be read, is no wind field, or holds what none can; one line.
        """
        try:
            return cls.read(Path(path).read_bytes())
        except (FieldError, OSError) as error:
            reason = getattr(error, 'strerror', None) or error
            raise FieldError(f'{fspath(path)}: {reason}') from None

    @classmethod
    def read(cls, raw: bytes) -> 'WindField':
        """Return the field in the bytes of a file that `save` wrote; else raise `FieldError`."""
        try:
            with ZipFile(BytesIO(raw)) as archive:
                return cls._of(unpacked(archive))
        except FieldError:
            raise
        except Exception as error:  # zip, compression and numpy raise a dozen kinds of their own
            reason = ' '.join(str(error).split())[:160] or type(error).__name__
            raise FieldError(f'is no wind field: {reason}') from None

    @classmethod
    def _of(cls, content: dict[str, np.ndarray]) -> 'WindField':
        number = content['format'] if 'format' in content else None
        if number is None or number.shape or number != FORMAT:
            raise FieldError(f'is no wind field of format {FORMAT}')
        ratios = content['ratios']
        if ratios.size > MOST_NUMBERS:
            raise FieldError(f'ratios are too many: {ratios.size}')
        if ratios.dtype == np.int16 and ratios.ndim == 5:
            ratios = in_steps(summed(ratios))
        if ratios.dtype.kind != 'f' or ratios.ndim != 5 or ratios.shape[-1] != 4:
            raise FieldError(f'ratios have the type {ratios.dtype} and the shape {ratios.shape}')
        n, nx, ny, _, _ = ratios.shape
        shapes = {
            'roughness': (nx, ny),
            'residuals': (n, content['residuals'].shape[-1]),
            'angles': (n,),
            'plan': (2, 2),
            'heights': (5,),
            'ground_x': None,
            'ground_y': None,
            'ground': (content['ground_x'].size, content['ground_y'].size),
            'ground_roughness': (content['ground_x'].size, content['ground_y'].size),
        }
        numbers = {name: checked(content, name, shape) for name, shape in shapes.items()}
        if not min(ratios.shape) or not (-MOST <= ratios.min() <= ratios.max() <= MOST):
            raise FieldError('ratios are not finite, too large, or none')
        check_axes(numbers)
        first, growth, datum, top, upstream = numbers['heights'].tolist()
        (x, y), spacing = numbers['plan'].tolist()
        cells = Cells(
            ratios.astype(np.float32, copy=False), numbers['roughness'], numbers['residuals']
        )
        atlas = WindAtlas(
            numbers['angles'],
            cells.ratios,
            cells.roughness,
            (x, y),
            tuple(spacing),
            first,
            growth,
            datum,
            top,
            upstream,
        )
        survey = Survey(
            numbers['ground_x'],
            numbers['ground_y'],
            numbers['ground'],
            numbers['ground_roughness'],
            upstream,
        )
        return cls(cells, atlas, survey, str(content['digest']), str(content['accuracy']))


def unpacked(archive: ZipFile) -> dict[str, np.ndarray]:
    """Arrays of an `archive`, by name; `FieldError` where they say that they are too large."""
    members = {info.filename: info for info in archive.infolist()}
    found = {name: members[f'{name}.npy'] for name in NAMES if f'{name}.npy' in members}
    size = sum(info.file_size for info in found.values())
    if size > MOST_BYTES:
        raise FieldError(f'is no wind field: unpacked it has {size} bytes')
    content = {}
    for name, info in found.items():
        with archive.open(info) as file:
            content[name] = np.lib.format.read_array(file, allow_pickle=False)
    return content


def differences(ratios: np.ndarray) -> np.ndarray:
    """Differences along x and zeta of whole numbers (n, nx, ny, nz, 4), the components first.

    They pack well.
    """
    for axis in (1, 3):
        ratios = np.diff(ratios, axis=axis, prepend=np.int16(0))
    return np.ascontiguousarray(np.moveaxis(ratios, -1, 0))


def summed(steps: np.ndarray) -> np.ndarray:
    """Sum up what `differences` were taken of."""
    steps = np.moveaxis(steps, 0, -1)
    for axis in (3, 1):
        steps = np.cumsum(steps, axis=axis, dtype=np.int16)
    return steps


def in_steps(counts: np.ndarray) -> np.ndarray:
    """Numbers of so many `STEP`, by direction: all at once would take the space twice."""
    numbers = np.empty(counts.shape, np.float32)
    for row, count in zip(numbers, counts):
        row[:] = STEP * count
    return numbers


def checked(
    content: dict[str, np.ndarray], name: str, shape: tuple[int, ...] | None
) -> np.ndarray:
    """Finite numbers called `name` of that `shape`, or of one axis; else `FieldError`."""
    values = content[name]
    if values.dtype.kind not in 'if' or (shape or (values.size,)) != values.shape:
        raise FieldError(f'{name} has the type {values.dtype} and the shape {values.shape}')
    values = values.astype(float)
    if not np.isfinite(values).all():
        raise FieldError(f'{name} is not finite')
    return values


def check_axes(numbers: dict[str, np.ndarray]) -> None:
    """Check that axes rise and that lengths are over 0; `FieldError` where not."""
    for name in ('ground_x', 'ground_y', 'angles'):
        least = 1 if name == 'angles' else 2
        if len(numbers[name]) < least or (np.diff(numbers[name]) <= 0.0).any():
            raise FieldError(f'{name} does not rise')
    first, growth, _, top, upstream = numbers['heights']
    lengths = (first, growth, top, upstream, *numbers['plan'][1], numbers['roughness'].min())
    if min(lengths) <= 0.0 or growth > 5.0:
        raise FieldError('a length is not over 0')
    if numbers['angles'][0] < 0.0 or numbers['angles'][-1] >= 2.0 * np.pi:
        raise FieldError('an angle is not from 0 to below a whole turn')


def coefficients(values: np.ndarray) -> np.ndarray:
    """Coefficients of quadratic splines through `values` (n, nx, ny, nz, 4), along x, y and zeta.

    At the ends they are mirrored, as the effect reads them.
    """
    found = np.empty(values.shape, np.float32)
    for one, given in zip(found, values):
        solved = np.array(given, float)
        for axis in (0, 1, 2):
            along = np.moveaxis(solved, axis, 0)
            if len(along) > 1:
                eliminate(along)
        one[:] = solved
    return found


def eliminate(values: np.ndarray) -> None:
    """Solve for the coefficients along the first axis, in place.

    A value is 1/8, 6/8, 1/8 of those beside it, at the ends 6/8 and 2/8.
    """
    last = len(values) - 1
    kept = np.empty(last)
    for n in range(last + 1):
        below = 0.25 if n == last else 0.125
        pivot = 0.75
        if n:
            pivot -= below * kept[n - 1]
            values[n] -= below * values[n - 1]
        values[n] /= pivot
        if n < last:
            kept[n] = (0.25 if n == 0 else 0.125) / pivot
    for n in range(last - 1, -1, -1):
        values[n] -= kept[n] * values[n + 1]


def spline(places: np.ndarray, count: int) -> tuple[Triple, Triple]:
    """Three nodes and weights of a quadratic spline at `places` among so many nodes."""
    places = np.clip(places, 0.0, count - 1.0)
    nearest = np.floor(places + 0.5).astype(np.int64)
    at = places - nearest
    before = np.where(nearest > 0, nearest - 1, min(1, count - 1))
    after = np.where(nearest + 1 < count, nearest + 1, max(count - 2, 0))
    return (before, nearest, after), (0.5 * (0.5 - at) ** 2, 0.75 - at * at, 0.5 * (0.5 + at) ** 2)
