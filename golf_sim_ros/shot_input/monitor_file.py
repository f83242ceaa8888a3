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

"""Shots from a launch monitor's export: any table as CSV, in the units and spellings it has."""

from collections.abc import Mapping, Sequence
import csv
from io import StringIO
from math import hypot, isfinite, isnan, nan, sin
from pathlib import Path
import re
from typing import NamedTuple

import numpy as np

from .launch_monitor import Launch, parted
from .monitor_columns import ALL_UNITS, COMPARED, Field, FIELDS, Monitor, monitor_of, plain, SIDED

LARGEST = 50_000_000  # bytes of a file
DELIMITERS = ',;\t|'
PREAMBLE = 60  # lines before the header at most
KNOWN_AT_LEAST = 2  # columns of a header
NOTHING = {'', '-', '--', '\u2013', '\u2014', 'n/a', 'na', 'nan', 'null', 'none', '#n/a', '?'}
SUMMARIES = (
    'average|averages|avg|mean|means|median|min|max|minimum|maximum|consistency|'
    'deviation|std|stdev|std dev|st dev|standard deviation|sd|\u00b1|session average'
).split('|')
SUMMARY = 'of averages'
SIDES = {'l': -1.0, 'left': -1.0, 'r': 1.0, 'right': 1.0}
FASTEST, FASTEST_SPIN = 150.0, 2500.0  # m/s, rad/s: what can be simulated

Read = tuple[str, Launch, list[float]]  # club, launch and told figures of a row


class TableError(ValueError):
    """A table that cannot be used: one line that says where and why."""

    def __init__(self, message: object) -> None:
        letters = (letter if letter.isprintable() else '?' for letter in str(message))
        super().__init__(''.join(letters))


class MonitorShots(NamedTuple):
    """Shots of a launch monitor, and what it told of them.

    Parameters
    ----------
    clubs : tuple of str
        '' where no club is named.
    launches : tuple of Launch
    told : numpy.ndarray, shape (4, n)
        Carry [m], apex [m], landing angle [rad] and flight time [s]; nan where it told none.
    monitor : Monitor
        Whose export it is.
    left_out : dict
        How many rows were left out, by reason.
    """

    clubs: tuple[str, ...]
    launches: tuple[Launch, ...]
    told: np.ndarray
    monitor: Monitor
    left_out: dict[str, int]


class Column(NamedTuple):
    """Column of a file: number, what the file calls it, and one of its units in SI, or None."""

    index: int  # type: ignore[assignment]  # hides tuple.index
    header: str
    unit: float | None


class How(NamedTuple):
    """What a file does not say by itself.

    Parameters
    ----------
    columns : dict
        Headers of the file by field, for those it calls by other names.
    units : dict
        Units by field, such as ``{'carry': 'yd'}``: in place of what the file says.
    default : dict
        Units of those fields for which neither says any.
    """

    columns: dict[str, str] = {}
    units: dict[str, str] = {}
    default: dict[str, str] = {}


AS_TOLD = How()


def read_monitor_file(path: str | Path, how: How = AS_TOLD) -> MonitorShots:
    """Read the shots of a launch monitor's export.

    Parameters
    ----------
    path : str or Path
    how : How

    Returns
    -------
    MonitorShots

    Raises
    ------
    TableError
        The file cannot be read, has no such columns, or a cell is no number.
    """
    try:
        return shots_of(text_of(Path(path)), how)
    except (TableError, csv.Error) as error:
        raise TableError(f'{path}: {error}') from None
    except OSError as error:
        raise TableError(f'{path}: {error.strerror or error}') from None


def text_of(path: Path) -> str:
    """Text of a file, in whatever encoding spreadsheets write."""
    if path.exists() and not path.is_file():
        raise TableError('is no file')
    with path.open('rb') as file:
        raw = file.read(LARGEST + 1)
    if len(raw) > LARGEST:
        raise TableError(f'is larger than {LARGEST // 1_000_000} MB')
    if raw[:2] in (b'\xff\xfe', b'\xfe\xff'):
        return raw.decode('utf-16', 'replace').lstrip('\ufeff')
    if b'\0' in raw:
        raise TableError('is no text')
    try:
        return raw.decode('utf-8-sig')
    except UnicodeDecodeError:
        return raw.decode('cp1252', 'replace')


def shots_of(text: str, how: How = AS_TOLD) -> MonitorShots:
    """`MonitorShots` of the text of a table."""
    delimiter, start, rows = header_of(text, how)
    header = [cell.strip() for cell in rows[start]]
    columns = columns_of(header, how)
    first = start + 1
    body = list(enumerate(rows[first:], first + 1))
    if body and is_units(body[0][1]):
        words = [cell.strip(' []()').lower() for cell in body[0][1]]
        columns = {name: with_unit(name, column, words) for name, column in columns.items()}
        body = body[1:]
    columns = {name: settled(name, column, how) for name, column in columns.items()}
    check_needed(columns, header)
    kept: list[Read] = []
    left_out: dict[str, int] = {}
    for line, row in body:
        if not is_data(row, header):
            continue
        shot = SUMMARY if is_summary(row) else shot_of(row, columns, (line, delimiter != ','))
        if isinstance(shot, str):
            left_out[shot] = left_out.get(shot, 0) + 1
        else:
            kept.append(shot)
    if not kept:
        why = '; '.join(f'{count} {reason}' for reason, count in left_out.items())
        raise TableError(f'no shot in it can be compared{": " if why else ""}{why}')
    clubs, launches, told = zip(*kept)
    monitor = monitor_of([plain(cell)[0] for cell in header])
    return MonitorShots(clubs, launches, np.array(told).T, monitor, left_out)


def header_of(text: str, how: How) -> tuple[str, int, list[list[str]]]:
    """Delimiter, the one that shows most columns, number of the header's row, and all rows."""
    best: tuple[int, str, int, list[list[str]]] = 0, '', 0, []
    for delimiter in DELIMITERS:
        rows = list(csv.reader(StringIO(text, newline=''), delimiter=delimiter))
        for number, row in enumerate(rows[:PREAMBLE]):
            known = len(named(row, how))
            if known > best[0]:
                best = known, delimiter, number, rows
    known, delimiter, number, rows = best
    if known < KNOWN_AT_LEAST:
        first = next((line.strip() for line in text.splitlines() if line.strip()), '')
        raise TableError(
            f'no header with known columns is in its first {PREAMBLE} lines, which begin with '
            f'{first[:60]!r}; --map names columns, as in --map ball_speed=COLUMN'
            if first
            else 'is empty'
        )
    return delimiter, number, rows


def named(header: Sequence[str], how: How) -> dict[str, Column]:
    """`Column` by field of what is known in a header."""
    cells = [plain(cell) for cell in header]
    found = {}
    for name, field in FIELDS.items():
        wanted = how.columns.get(name)
        if wanted is not None:
            places = [
                i
                for i, cell in enumerate(header)
                if cell.strip() == wanted.strip() or cells[i][0] == plain(wanted)[0]
            ]
            places.sort(key=lambda i: header[i].strip() != wanted.strip())
        else:
            places = [
                i
                for alias in field.names
                for i, (cell, unit) in enumerate(cells)
                if cell == alias and (not unit or unit in field.units)
            ]
        if places:
            index = places[0]
            unit = field.units.get(cells[index][1])
            found[name] = Column(index, header[index].strip(), unit)
    return found


def columns_of(header: Sequence[str], how: How) -> dict[str, Column]:
    """`Column` by field, with all that `how` names."""
    found = named(header, how)
    for name, wanted in how.columns.items():
        if name not in found:
            raise TableError(f'has no column {wanted!r} for {name}; it has: {listed(header)}')
    return found


def listed(header: Sequence[str]) -> str:
    """Headers of a file, shortened."""
    text = ', '.join(cell for cell in header if cell)
    return text if len(text) <= 160 else text[:150] + ' ...'


def is_units(row: Sequence[str]) -> bool:
    """Whether a row tells units, and nothing else."""
    cells = [cell.strip(' []()').lower() for cell in row if cell.strip(' []()')]
    return bool(cells) and all(cell in ALL_UNITS for cell in cells)


def with_unit(name: str, column: Column, told: Sequence[str]) -> Column:
    """`Column` with its unit from a row of units, if that tells one that fits."""
    unit = told[column.index] if column.index < len(told) else ''
    size = FIELDS[name].units.get(unit, column.unit)
    return column._replace(unit=size)


def settled(name: str, column: Column, how: How) -> Column:
    """`Column` with a unit: what the caller says, else the file, else what is usual."""
    field: Field = FIELDS[name]
    if name in how.units:
        return column._replace(unit=field.units[how.units[name]])
    if column.unit is None and field.default is None and name in how.default:
        return column._replace(unit=field.units[how.default[name]])
    return column if column.unit is not None else column._replace(unit=field.default)


def check_needed(columns: Mapping[str, Column], header: Sequence[str]) -> None:
    """Refuse a table without launch, or without anything to compare."""
    missing = [name for name in ('ball_speed', 'launch') if name not in columns]
    if 'spin' not in columns and 'backspin' not in columns:
        missing.append('spin')
    if not any(name in columns for name in COMPARED):
        missing.append(' or '.join(COMPARED))
    if missing:
        raise TableError(
            f'has no column for {", ".join(missing)}; it has: {listed(header)}; '
            f'--map names one, as in --map {missing[0].split()[0]}=COLUMN'
        )


def is_data(row: Sequence[str], header: list[str]) -> bool:
    """Whether a row is one of shots: not empty, no comment, no repeated header or units."""
    cells = [cell.strip() for cell in row]
    if not any(cells) or cells[0].startswith('#') or is_units(row):
        return False
    return cells[: len(header)] != header[: len(cells)]


def is_summary(row: Sequence[str]) -> bool:
    """Whether a row is no shot but an average or the like of shots."""
    return any(cell.lower().strip(' .:') in SUMMARIES for cell in row)


def shot_of(
    row: Sequence[str], columns: Mapping[str, Column], place: tuple[int, bool]
) -> Read | str:
    """Club, `Launch` and told figures of a row, or why it is left out."""
    value = {
        name: figure(row, name, column, place)
        for name, column in columns.items()
        if name != 'club'
    }
    told = [value.get(name, nan) for name in COMPARED]
    club = columns.get('club')
    label = row[club.index].strip() if club and club.index < len(row) else ''
    speed, angle = value['ball_speed'], value['launch']
    back, side = spins_of(value)
    reason = next(
        (
            reason
            for reason, wrong in (
                ('without ball speed', isnan(speed)),
                ('without launch angle', isnan(angle)),
                ('without spin', isnan(back)),
                ('without anything to compare', all(map(isnan, told))),
                ('that leave no tee upwards', not (speed > 0.0 and sin(angle) > 0.0)),
                ('too fast to be simulated', speed > FASTEST or hypot(back, side) > FASTEST_SPIN),
            )
            if wrong
        ),
        None,
    )
    if reason:
        return reason
    azimuth = value.get('azimuth', nan)
    launch = Launch(speed, angle, 0.0 if isnan(azimuth) else azimuth, back, side)
    return label, launch, told


def spins_of(value: Mapping[str, float]) -> tuple[float, float]:
    """Backspin and sidespin, from both, or from spin and axis; nan for none."""
    back, side = value.get('backspin', nan), value.get('sidespin', nan)
    spin, axis = value.get('spin', nan), value.get('axis', nan)
    if isnan(spin) or not (isnan(back) or isnan(side)):
        return back, 0.0 if isnan(side) else side
    return parted(spin, 0.0 if isnan(axis) else axis)


def figure(row: Sequence[str], name: str, column: Column, place: tuple[int, bool]) -> float:
    """Read a cell as a number in SI, or nan."""
    line, decimal_comma = place
    cell = row[column.index] if column.index < len(row) else ''
    try:
        number, unit = parsed(cell, FIELDS[name], name, decimal_comma)
    except ValueError:
        raise TableError(
            f'line {line}, {column.header!r}: {cell.strip()[:40]!r} is no number'
        ) from None
    size = FIELDS[name].units[unit] if unit else column.unit
    if size is None and not isnan(number):
        usual = ', '.join(dict.fromkeys(FIELDS[name].units))
        raise TableError(
            f'{column.header!r} has no unit; --unit {name}=UNIT says it, one of: {usual}'
        )
    return number * (size or 1.0)


PARTS = re.compile(
    r'(?P<side>left|right|[lr])?\s*(?P<number>[-+]?\d[\d.,\'\s]*(?:e[-+]?\d+)?|[-+]?[.,]\d+)'
    r'\s*(?P<rest>.*)'
)


GROUPED = re.compile(r"[-+]?\d{1,3}([\s']\d{3})+([.,]\d+)?")


def parsed(cell: str, field: Field, name: str, decimal_comma: bool) -> tuple[float, str]:
    """Parse a number and its unit or '', as in ``12.5``, ``2.2 L`` or ``150 mph``."""
    text = re.sub(r'[\u00a0\u202f\u2009]', ' ', cell).replace('\u2212', '-').strip().lower()
    if text in NOTHING:
        return nan, ''
    found = PARTS.fullmatch(text)
    if not found:
        raise ValueError(text)
    unit, side = '', found['side']
    rest = found['rest'].replace('\N{DEGREE SIGN}', ' \N{DEGREE SIGN} ')
    for word in rest.split():
        if word in field.units and not unit:
            unit = word
        elif word in SIDES and not side:
            side = word
        else:
            raise ValueError(text)
    if side and name not in SIDED:
        raise ValueError(text)
    number = float(with_point(found['number'], name, decimal_comma))
    if not isfinite(number):
        raise ValueError(text)
    return number * (SIDES[side] if side else 1.0), unit


def with_point(number: str, name: str, decimal_comma: bool) -> str:
    """Digits of a number with a decimal point, and nothing between thousands."""
    number = number.strip()
    if re.search(r"[\s']", number) and not GROUPED.fullmatch(number):
        raise ValueError(number)
    digits = re.sub(r"[\s']", '', number)
    if ',' in digits and '.' in digits:
        whole, _, part = digits.rpartition(max(',.', key=digits.rfind))
        return f'{re.sub("[.,]", "", whole)}.{part}'
    if re.fullmatch(r'[-+]?\d{1,3}(,\d{3})+', digits) and (
        not decimal_comma or name in ('spin', 'backspin', 'sidespin')
    ):
        return digits.replace(',', '')
    if digits.count(',') > 1 or digits.count('.') > 1:
        raise ValueError(number)
    return digits.replace(',', '.')
