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

"""Columns of launch monitors' exports: their names and units, and whose they are."""

from collections.abc import Collection
import re
from typing import NamedTuple

from .units import DEGREE, Unit, UNITS

MPH, _, RPM, YARD = UNITS['golf']
FOOT = Unit('ft', YARD.size / 3.0)
SPEEDS = {
    **dict.fromkeys(('mph', 'mi/h'), MPH.size),
    **dict.fromkeys(('m/s', 'mps', 'm/sec'), 1.0),
    **dict.fromkeys(('km/h', 'kmh', 'kph'), 1.0 / 3.6),
    **dict.fromkeys(('ft/s', 'fps'), FOOT.size),
}
ANGLES = {
    **dict.fromkeys(('deg', 'degs', 'degree', 'degrees', '\N{DEGREE SIGN}'), DEGREE.size),
    'rad': 1.0,
}
SPINS = {**dict.fromkeys(('rpm', 'r/min', '1/min'), RPM.size), 'rad/s': 1.0}
LENGTHS = {
    **dict.fromkeys(('yd', 'yds', 'yard', 'yards'), YARD.size),
    **dict.fromkeys(('m', 'meter', 'meters', 'metre', 'metres'), 1.0),
    **dict.fromkeys(('ft', 'feet', 'foot'), FOOT.size),
}
TIMES = dict.fromkeys(('s', 'sec', 'secs', 'second', 'seconds'), 1.0)
ALL_UNITS = {*SPEEDS, *ANGLES, *SPINS, *LENGTHS, *TIMES}


class Field(NamedTuple):
    """A figure of a shot: units it may have, and names, as `plain` leaves them, best first."""

    units: dict[str, float]
    names: tuple[str, ...]
    # The unit where none is told: angles and spins have no other in use.
    default: float | None = None


FIELDS = {
    'club': Field({}, ('clubname', 'club', 'clubtype', 'clubused', 'clubid')),
    'ball_speed': Field(SPEEDS, ('ballspeed', 'ball', 'ballvelocity', 'ballspd', 'speed')),
    'launch': Field(
        ANGLES,
        (
            'launchangle',
            'launchv',
            'vla',
            'verticallaunchangle',
            'launchanglevertical',
            'verticallaunch',
            'vertlaunch',
            'launchang',
            'launch',
        ),
        DEGREE.size,
    ),
    'azimuth': Field(
        ANGLES,
        (
            'launchdirection',
            'launchh',
            'hla',
            'horizontallaunchangle',
            'launchanglehorizontal',
            'horizontallaunch',
            'launchdir',
            'azimuth',
            'direction',
        ),
        DEGREE.size,
    ),
    'spin': Field(SPINS, ('spinrate', 'totalspin', 'spin', 'totalspinrate'), RPM.size),
    'backspin': Field(SPINS, ('backspin', 'backspinrate', 'spinback'), RPM.size),
    'sidespin': Field(SPINS, ('sidespin', 'sidespinrate', 'spinside'), RPM.size),
    'axis': Field(ANGLES, ('spinaxis', 'axis', 'spinaxistilt', 'spintilt'), DEGREE.size),
    'carry': Field(
        LENGTHS,
        (
            'carry',
            'carrydistance',
            'carrydist',
            'carrylength',
            'carryflatlength',
            'carryflat',
            'carryflatcarry',
        ),
    ),
    'apex': Field(
        LENGTHS,
        (
            'apex',
            'apexheight',
            'maxheight',
            'peakheight',
            'height',
            'maxheightheight',
            'heightapex',
            'peak',
        ),
    ),
    'landing_angle': Field(
        ANGLES,
        (
            'landangle',
            'landingangle',
            'descentangle',
            'angleofdescent',
            'descentv',
            'descent',
            'carryflatlandangle',
            'vertlandingangle',
            'decentangle',
        ),
        DEGREE.size,
    ),
    'flight_time': Field(
        TIMES,
        ('flighttime', 'hangtime', 'airtime', 'timeofflight', 'carryflattime', 'flightt'),
        1.0,
    ),
}
COMPARED = ('carry', 'apex', 'landing_angle', 'flight_time')
SIDED = ('azimuth', 'sidespin', 'axis')  # figures that are to the left or to the right


class Monitor(NamedTuple):
    """A make of launch monitors: columns that only its exports have, and what its carry is."""

    title: str
    columns: frozenset[str]
    carry: str


MONITORS = {
    'trackman': Monitor(
        'TrackMan',
        frozenset(
            (
                'carryflatlength',
                'maxheightheight',
                'esttotalflatlength',
                'lowpointdistance',
                'dynlie',
                'dynamiclie',
                'swingplane',
                'landangle',
                'spinloft',
            )
        ),
        'TrackMan follows the ball by radar outdoors, and normalises what it saw by its own model '
        'of flight; indoors it sees the first metres, and carry, height, landing angle and time '
        'are that model.',
    ),
    'flightscope': Monitor(
        'FlightScope',
        frozenset(('launchv', 'launchh', 'ball', 'descentv', 'vertlandingangle', 'lateral')),
        'FlightScope follows the ball by radar outdoors; indoors, and beyond what it could see, '
        'carry, height, landing angle and time are its own model of flight.',
    ),
    'garmin': Monitor(
        'Garmin Approach R10',
        frozenset(
            (
                'spinratetype',
                'carrydeviationangle',
                'carrydeviationdistance',
                'totaldeviationangle',
                'totaldeviationdistance',
                'apexheight',
            )
        ),
        'The R10 sees the first metres: carry and height are its own model of flight, and so is '
        'the spin where Spin Rate Type does not say measured.',
    ),
    'camera': Monitor(
        'a camera monitor',
        frozenset(('vla', 'hla')),
        'Cameras (Foresight, Bushnell, SkyTrak, Uneekor, Rapsodo) see the launch: all that '
        'comes after it is their own model of flight.',
    ),
}
UNKNOWN = Monitor(
    'a launch monitor',
    frozenset(),
    'Whose export this is cannot be seen. Camera monitors, and radars indoors, see the launch: '
    'all that comes after it is their own model of flight.',
)
SIGNS = 2  # columns of its own, by which a monitor is known


def plain(header: str) -> tuple[str, str]:
    """Name of a column, lower-case letters and digits, and its unit or '', of what a file says.

    ``Ball Speed (mph)``, ``ball_speed [mph]`` and ``ball_speed_mph`` are the same.
    """
    text = header.strip().lower()
    found = re.search(r'[(\[]([^)\]]*)[)\]]', text)
    unit = ''
    if found:
        unit, text = found[1].strip(), text.replace(found[0], ' ', 1)
    else:
        last = re.search(r'[\s_,-]+([^\s_,-]+)$', text)
        if last and last[1] in ALL_UNITS:
            unit, text = last[1], text[: last.start()]
    return ''.join(re.findall(r'[a-z0-9]+', text)), unit


def monitor_of(names: Collection[str]) -> Monitor:
    """`Monitor` that has columns of these names, plain ones."""
    best = max(MONITORS.values(), key=lambda monitor: len(monitor.columns & set(names)))
    return best if len(best.columns & set(names)) >= SIGNS else UNKNOWN
