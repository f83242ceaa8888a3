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

"""Compare a launch monitor's export with the simulation: a Markdown page and a picture.

Needs no ROS.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path
import sys

from .closed_pipe import in_pipes
from .shoot_arguments import finite
from ..comparison.errors import compare, Comparison, Figures, figures, LAWS
from ..comparison.page import draw, everything, PAGE, page, PICTURE, table
from ..course.course_file import air
from ..course.schema import CourseError
from ..optional_packages import how_to_get
from ..physics import Air
from ..physics.engine.engines import prefer_compiled
from ..shot_input.launch_monitor import Vector
from ..shot_input.monitor_columns import FIELDS, MONITORS
from ..shot_input.monitor_file import How, read_monitor_file, TableError
from ..shot_input.units import UNITS

EPILOG = f"""Exports of TrackMan, FlightScope, Garmin (R10) and others are read as they come: their
columns, units in the header or in a row below it, values such as "2.2 L", decimal commas, rows of
averages. Another table is read where --map names its columns. Fields for --map and --unit:
{', '.join(FIELDS)}.

examples:
  compare_shots range.csv -o range
  compare_shots range.csv --laws fitted ferguson_2022 --altitude 1600 --temperature 30C
  compare_shots mine.csv --map ball_speed='Ball (mph)' --unit carry=yd --wind 3 0

exit code: 0 when there is a page, 2 for wrong arguments and for a file that cannot be used (one
line says why)."""
NEEDED = f'no picture: matplotlib is missing: {how_to_get("plot", "matplotlib")}'
WRONG = 2


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Compare the shots of a file and write the page; return the exit code."""
    options = parser().parse_args(args)
    try:
        how = How(dict(options.map), dict(options.unit), defaults(options.units))
        shots = read_monitor_file(options.file, how)
        weather = air(air_of(options), 'air')
    except (TableError, CourseError) as error:
        return failed(error)
    if options.monitor:
        shots = shots._replace(monitor=MONITORS[options.monitor])
    units = UNITS[options.units or 'golf']
    prefer_compiled()
    wind = (*options.wind, 0.0)
    comparison = compare(shots, list(dict.fromkeys(options.laws)), units, weather, wind)
    shown = figures(units)
    try:
        options.output.mkdir(parents=True, exist_ok=True)
        drawn = PICTURE if picture(options.output / PICTURE, comparison, shown) else ''
        told = conditions(weather, wind)
        text = page(options.file.name, shots, comparison, shown, told, drawn)
        (options.output / PAGE).write_text(text, encoding='utf-8')
    except OSError as error:
        return failed(error)
    print(table('', everything(comparison), comparison.errors, shown))
    print(shots.monitor.carry)
    print(f'{options.output / PAGE}: {len(shots.launches)} shots')
    return 0


def failed(why: Exception) -> int:
    """Say why there is no page in one line; the exit code."""
    print(f'compare_shots: {" ".join(str(why).split())}', file=sys.stderr)
    return WRONG


def picture(path: Path, comparison: Comparison, shown: Figures) -> bool:
    """Draw the picture, or say what is missing for it; whether it is there."""
    try:
        draw(path, comparison, shown)
    except ImportError as error:
        print(f'{NEEDED} ({error})', file=sys.stderr)
        return False
    return True


def defaults(name: str | None) -> dict[str, str]:
    """Units by field of columns that have none, of the set of units asked for."""
    if name is None:
        return {}
    units = UNITS[name]
    return {'ball_speed': units.speed.name, 'carry': units.length.name, 'apex': units.length.name}


def air_of(options: argparse.Namespace) -> dict[str, float]:
    """Entry ``air`` of a course file that the options mean."""
    given = {
        'altitude': options.altitude,
        'temperature': options.temperature,
        'pressure': options.pressure,
        'relative_humidity': options.humidity,
    }
    return {name: value for name, value in given.items() if value is not None}


def conditions(weather: Air, wind: Vector) -> list[str]:
    """Sentences about the air."""
    told = (
        f'Air: {weather.temperature - 273.15:.1f} degrees Celsius, '
        f'{weather.pressure / 100:.0f} hPa, '
        f'relative humidity {weather.relative_humidity:g};'
    )
    if not any(wind):
        return [told, 'no wind.']
    return [told, f'wind {wind[0]:+g} m/s towards the target and {wind[1]:+g} m/s to the left.']


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    made = argparse.ArgumentParser(
        prog='compare_shots',
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument('file', type=Path, metavar='FILE.csv', help="a launch monitor's export")
    made.add_argument(
        '-o',
        '--output',
        type=Path,
        default=Path('comparison'),
        metavar='DIR',
        help=f'where {PAGE} and {PICTURE} go (%(default)s)',
    )
    made.add_argument(
        '--laws',
        nargs='+',
        choices=list(LAWS),
        default=['fitted'],
        metavar='LAW',
        help=f'laws of drag and lift, side by side: {", ".join(LAWS)} (fitted)',
    )
    made.add_argument(
        '--monitor', choices=list(MONITORS), help='whose export it is, if that is not seen'
    )
    add_table(made.add_argument_group('the table'))
    add_air(made.add_argument_group('the air; without options 25 degrees Celsius at sea level'))
    return made


def add_table(group: argparse._ArgumentGroup) -> None:
    """Add the options on columns and units."""
    group.add_argument(
        '--map',
        action='append',
        type=named_column,
        default=[],
        metavar='FIELD=COLUMN',
        help="the column of a field, as in ball_speed='Ball (mph)'",
    )
    group.add_argument(
        '--unit',
        action='append',
        type=named_unit,
        default=[],
        metavar='FIELD=UNIT',
        help='the unit of a field, in place of what the file says, as in apex=ft',
    )
    group.add_argument(
        '--units',
        choices=list(UNITS),
        help='units of columns for which nothing says any, and of the results (golf)',
    )


def add_air(group: argparse._ArgumentGroup) -> None:
    """Add the options on air and wind."""
    group.add_argument('--altitude', type=finite, metavar='M', help='pressure of this height')
    group.add_argument(
        '--temperature', type=kelvin, metavar='T', help='in kelvin, or as 30C or 86F'
    )
    group.add_argument('--pressure', type=finite, metavar='PA', help='in pascal')
    group.add_argument('--humidity', type=finite, metavar='H', help='relative humidity, 0 to 1')
    group.add_argument(
        '--wind',
        nargs=2,
        type=breeze,
        default=(0.0, 0.0),
        metavar=('AHEAD', 'LEFT'),
        help='where the air goes, 10 m above the ground [m/s]: to the target, and to the left',
    )


def breeze(text: str) -> float:
    """Parse a part of the wind [m/s]."""
    number = finite(text)
    if abs(number) > 70.0:
        raise argparse.ArgumentTypeError(f'{text} is not -70 to 70 m/s')
    return number


def kelvin(text: str) -> float:
    """Parse a temperature [K]."""
    scale, number = text[-1:].upper(), text[:-1]
    if scale == 'C':
        return finite(number) + 273.15
    if scale == 'F':
        return (finite(number) + 459.67) / 1.8
    return finite(text)


def pair(text: str) -> tuple[str, str]:
    """Parse FIELD=VALUE, with a known field."""
    name, sign, value = text.partition('=')
    if not sign or not value.strip():
        raise argparse.ArgumentTypeError(f'{text!r} is not FIELD=VALUE')
    if name not in FIELDS:
        raise argparse.ArgumentTypeError(f'field {name!r} is unknown; known: {", ".join(FIELDS)}')
    return name, value.strip()


def named_column(text: str) -> tuple[str, str]:
    """Parse FIELD=COLUMN."""
    return pair(text)


def named_unit(text: str) -> tuple[str, str]:
    """Parse FIELD=UNIT, with a unit that the field may have."""
    name, unit = pair(text)
    known = FIELDS[name].units
    if unit.lower() not in known:
        raise argparse.ArgumentTypeError(
            f'unit {unit!r} of {name} is unknown; known: {", ".join(known) or "none"}'
        )
    return name, unit.lower()


if __name__ == '__main__':
    sys.exit(main())
