# SPDX-License-Identifier: Apache-2.0
"""Scenes of the accuracy study: a shot, where, and in what wind."""
from math import cos, pi, sin
from typing import NamedTuple

from ..materials import materials, shipped
from ..physics import Course, Material, Plane, Restitution, Shot
from ..tools.clubs import CLUBS
from ..tools.launch_monitor import velocity_and_spin
from ..wind.gusts import Gusts, GustSettings

# Every scene asks for the same effects, so that all of them share their machine code.
EFFECTS = ('gravity', 'drag', 'magnus', 'spin_decay', 'turf')
GUST_STEP = 0.5  # s between the winds of a gusty scene
STEEP = 0.02  # slope of the greens: 2 %


class Scene(NamedTuple):
    """A shot to study; ``flies`` where its flight is worth studying by itself.

    ``wind`` is as in `simulate`; with wind the effect `wind` comes to `EFFECTS`.
    """

    name: str
    course: Course
    shot: Shot
    wind: tuple = (0.0, 0.0, 0.0)
    flies: bool = True

    @property
    def effects(self):
        """Names of the effects that the scene is studied with."""
        windy = not isinstance(self.wind[0], float)
        return (*EFFECTS, 'wind') if windy else EFFECTS


def gusty(seconds=10.0, seed=1):
    """Rows of time and wind [m/s]: gusts of 8 +- 4 m/s, another every two seconds, and turbulence."""
    gusts = Gusts(GustSettings(8.0, 4.0, 0.0, pi, interval=2.0, turbulence=0.1), seed)
    steps = int(seconds / GUST_STEP)
    return tuple((i * GUST_STEP, *gusts.wind(i * GUST_STEP)) for i in range(steps))


def club_shot(name):
    """`Shot` of a club's tour average, along +x."""
    return Shot(*velocity_and_spin(CLUBS[name].launch, 0.0))


def level(material):
    """A level `Course` of one material."""
    return Course(ground=(Plane(material=material),))


def sloping(material):
    """A `Course` of one material that falls to the right."""
    return Course(ground=(Plane((0.0, 0.0, 0.0), (0.0, -STEEP, 1.0), material),))


def scenes():
    """Scenes of the quick study.

    Returns
    -------
    tuple of Scene

    Raises
    ------
    CourseError
        A shipped material can't be read.
    """
    found = materials({}, shipped()[0])
    hard = Material('hard', Restitution(0.8), 0.0, 0.5, 0.3, 0.02, 0.003)
    drop = 40 * pi / 180
    return (
        Scene('drive in gusty wind', level(found['fairway']), club_shot('driver'), gusty()),
        Scene('iron into a green', level(found['green']), club_shot('7i')),
        Scene('putt across a slope', sloping(found['green']), Shot((2.0, 0.0, 0.0)), flies=False),
        Scene('bouncing on hard ground', level(hard), Shot((10 * cos(drop), 0.0, 10 * sin(drop)))),
    )
