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

"""Table of a `shot/result`, for people to read."""

from typing import Any

from ..shot_input.units import Units

Result = dict[str, Any]  # what `shot/result` says

ENDINGS = {
    'at_rest': 'at rest',
    'holed': 'in the hole',
    'water': 'in the water',
    'out_of_bounds': 'out of bounds',
    'time_limit': 'still moving at the time limit',
}
LABEL = 15  # width of the column of labels
WIDTH = 8  # of that of the numbers, two digits after the point, for putts


def result_table(result: Result, units: Units) -> str:
    """Lines of text for a shot's result.

    Parameters
    ----------
    result : dict
        What `shot/result` says of a shot that was played.
    units : golf_sim_ros.shot_input.units.Units

    Returns
    -------
    str
        A line for each value. A ball that never flew has no lines about the flight; lines that
        the result has no value for are left out.
    """
    flight = _flight(result, units) if result['flight_time'] > 0.0 else []
    rows = [('ball', result['ball']), ('ended', _ending(result)), *flight, *_whole(result, units)]
    return '\n'.join(f'{label:<{LABEL}}{value}' for label, value in rows)


def _ending(result: Result) -> str:
    ending = ENDINGS.get(result['status']) or str(result['status'])
    return (
        f'{ending}, {result["lie"]}' if result['status'] == 'at_rest' and result['lie'] else ending
    )


def _flight(result: Result, units: Units) -> list[tuple[str, str]]:
    return [
        ('carry', _length(result['carry'], units)),
        ('carry side', _side(result['carry_side'], units)),
        ('apex', _length(result['apex'], units)),
        ('flight time', _seconds(result['flight_time'])),
        ('landing speed', _amount(result['landing_speed'] / units.speed.size, units.speed.name)),
        ('landing angle', _amount(result['landing_angle'] / units.angle.size, units.angle.name)),
        ('bounces', f'{result["bounces"]:{WIDTH - 3}d}'),
    ]


def _whole(result: Result, units: Units) -> list[tuple[str, str]]:
    rows = [
        ('total', _length(result['total'], units)),
        ('side', _side(result['side'], units)),
        ('duration', _seconds(result['duration'])),
    ]
    if result['to_hole'] is not None:
        rows.append(('to the hole', _length(result['to_hole'], units)))
    return rows


def _length(length: float, units: Units) -> str:
    return _amount(length / units.length.size, units.length.name)


def _side(side: float, units: Units) -> str:
    towards = 'left' if side > 0.0 else 'right' if side < 0.0 else ''
    return f'{_length(abs(side), units)} {towards}'.rstrip()


def _seconds(time: float) -> str:
    return _amount(time, 's')


def _amount(number: float, unit: str) -> str:
    return f'{number:{WIDTH}.2f} {unit}'
