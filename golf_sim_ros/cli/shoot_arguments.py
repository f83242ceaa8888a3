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

"""The command line of `shoot`: its options, its help, and which texts are refused."""

import argparse
from math import isfinite
import re

from ..shot_input.clubs import Club, club, PUTTER, TOUR_AVERAGES
from ..shot_input.units import UNITS

EXAMPLES = """
examples:
  shoot driver                                    the average drive of the PGA Tour
  shoot 7i --aim hole --azimuth -2                two degrees left of the hole
  shoot pw --power 0.6 --aim hole                 with 0.6 of the ball speed and spin
  shoot putter --speed 4 --aim hole               level and without spin, at 4 mph
  shoot --speed 150 --launch 12 --spin 3000 --axis 10          a fade
  shoot --units si --speed 60 --launch 15 --backspin 400 --sidespin -30
  shoot driver --ball red --namespace /range      one ball of many, one sim of many
  shoot driver --print                            only the line for ros2 topic pub

Signs: azimuth, spin axis and sidespin are positive to the right of the target. The target is the
+x axis of the course, or the hole with --aim hole. Arguments after --ros-args go to ROS.

exit code: 0 when the shot was played, 1 when it was not (one line says why), 2 for wrong
arguments.
"""


def parser() -> argparse.ArgumentParser:
    """Parser of the command line, without ROS's arguments."""
    made = argparse.ArgumentParser(
        prog='shoot',
        usage='shoot [CLUB] [OPTION ...] [--ros-args ...]',
        description='Hit one shot, typed as a launch monitor shows it, and print how it ends.',
        epilog=_club_table() + EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument(
        'club',
        nargs='?',
        metavar='CLUB',
        type=_club,
        help=('driver, 3w, hybrid, 7i, pw, putter, ...'),
    )
    _add_launch(made.add_argument_group("the launch; what is given replaces the club's"))
    _add_sim(made.add_argument_group('the sim'))
    return made


def _add_launch(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        '--units',
        choices=UNITS,
        default='golf',
        help=('golf: mph, deg, rpm, yd (default); si: m/s, deg, rad/s, m'),
    )
    group.add_argument('--speed', type=_not_negative, metavar='V', help='ball speed')
    group.add_argument('--launch', type=finite, metavar='DEG', help='angle above the horizontal')
    group.add_argument(
        '--azimuth',
        type=finite,
        metavar='DEG',
        default=0.0,
        help=('direction, positive to the right of the target'),
    )
    group.add_argument('--backspin', type=finite, metavar='W', help='spin that lifts the ball')
    group.add_argument(
        '--sidespin', type=finite, metavar='W', help=('spin that curves it, positive to the right')
    )
    group.add_argument(
        '--spin',
        type=_not_negative,
        metavar='W',
        help=('total spin, with --axis instead of --backspin and --sidespin'),
    )
    group.add_argument(
        '--axis', type=finite, metavar='DEG', help=('tilt of the spin axis, positive to the right')
    )
    group.add_argument(
        '--power',
        type=_not_negative,
        metavar='P',
        help=("part of the club's ball speed and spin, such as 0.8"),
    )
    group.add_argument(
        '--aim', choices=['hole'], help='the target is the hole, from where the ball lies'
    )


def _add_sim(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        '--ball', type=_ball, metavar='NAME', help='ball to strike; default: the one in play'
    )
    group.add_argument('--namespace', metavar='NS', help='namespace of the sim')
    group.add_argument(
        '--timeout',
        type=_not_negative,
        metavar='S',
        default=5.0,
        help=('for how many seconds to look for a sim (default: 5)'),
    )
    group.add_argument(
        '--wait',
        type=_not_negative,
        metavar='S',
        default=60.0,
        help=(
            'for how many seconds to wait for a struck sim that cannot be reached any more '
            '(default: 60)'
        ),
    )
    group.add_argument(
        '--print',
        action='store_true',
        help=('print the ros2 topic pub line and do not shoot; needs no sim, except with --aim'),
    )


def _club_table() -> str:
    rows = [
        f'  {name:<8}{mph:>6} mph {degrees:>6} deg {rpm:>6} rpm {yards:>6} yd'
        for name, mph, degrees, rpm, yards in TOUR_AVERAGES
    ]
    title = "clubs: ball speed, launch angle, backspin and carry of the PGA Tour's averages"
    return '\n'.join([title, *rows, f'  {PUTTER:<8}   give --speed; launch and spin are 0', ''])


def _club(text: str) -> Club:
    try:
        return club(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def finite(text: str) -> float:
    """Parse a finite number."""
    try:
        number = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f'{text!r} is not a number') from None
    if not isfinite(number):
        raise argparse.ArgumentTypeError(f'{text} is not a finite number')
    return number


def _not_negative(text: str) -> float:
    number = finite(text)
    if number < 0.0:
        raise argparse.ArgumentTypeError(f'{text} is negative')
    return number


def _ball(text: str) -> str:
    if not re.fullmatch('[a-z][a-z0-9_]*', text):
        raise argparse.ArgumentTypeError(
            f'{text!r} is no name of a ball: a-z first, then a-z, 0-9 and _'
        )
    return text
