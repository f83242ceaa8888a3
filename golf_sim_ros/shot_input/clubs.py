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

"""Clubs, each with the average shot of the PGA Tour."""

from collections.abc import Iterator
from typing import NamedTuple

from .launch_monitor import Launch
from .units import UNITS

# TrackMan, "PGA Tour averages", the edition circulated from about 2010 to 2019 (that of 2023 is 2
# to 4 mph faster). Taken from three transcriptions that agree, not from TrackMan itself. Averages
# over many shots, in conditions TrackMan does not state.
#      club      ball speed mph, launch deg, spin rpm, carry yd
TOUR_AVERAGES = (
    ('driver', 167, 10.9, 2686, 275),
    ('3w', 158, 9.2, 3655, 243),
    ('5w', 152, 9.4, 4350, 230),
    ('hybrid', 146, 10.2, 4437, 225),
    ('3i', 142, 10.4, 4630, 212),
    ('4i', 137, 11.0, 4836, 203),
    ('5i', 132, 12.1, 5361, 194),
    ('6i', 127, 14.1, 6231, 183),
    ('7i', 120, 16.3, 7097, 172),
    ('8i', 115, 18.1, 7998, 160),
    ('9i', 109, 20.4, 8647, 148),
    ('pw', 102, 24.2, 9304, 136),
)
PUTTER = 'putter'
OTHER_NAMES = {
    'd': 'driver',
    '1w': 'driver',
    'h': 'hybrid',
    'rescue': 'hybrid',
    'pitchingwedge': 'pw',
    'putt': PUTTER,
}


class Club(NamedTuple):
    """A club and its average shot.

    Parameters
    ----------
    name : str
    launch : Launch or None
        None for the putter, which has no average.
    carry : float or None
        How far that shot carries according to the same table [m].
    """

    name: str
    launch: Launch | None = None
    carry: float | None = None


def _clubs() -> Iterator[tuple[str, Club]]:
    speed, angle, spin, length = UNITS['golf']
    for name, mph, degrees, rpm, yards in TOUR_AVERAGES:
        launch = Launch(
            speed=mph * speed.size, launch=degrees * angle.size, backspin=rpm * spin.size
        )
        yield name, Club(name, launch, yards * length.size)
    yield PUTTER, Club(PUTTER)


CLUBS = dict(_clubs())


def club(text: str) -> Club:
    """Club of a name as people write it: ``7i``, ``7-iron``, ``3 wood``, ``Driver``.

    Parameters
    ----------
    text : str

    Returns
    -------
    Club

    Raises
    ------
    ValueError
        If there is no such club; the message names those there are.
    """
    name = ''.join(letter for letter in text.lower() if letter.isalnum())
    name = name.replace('iron', 'i').replace('wood', 'w')
    name = OTHER_NAMES.get(name, name)
    if name not in CLUBS:
        raise ValueError(f'unknown club {text!r}; known: {", ".join(CLUBS)}')
    return CLUBS[name]
