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

"""Scenes of the accuracy study: a shot, where, and in what wind.

Or several strikes of several balls.
"""

from math import cos, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from ..course import load_course
from ..course.material_file import materials, shipped
from ..physics import Ball, Course, Heightmap, Material, Mesh, Plane, Restitution, Shot
from ..shot_input.clubs import CLUBS
from ..shot_input.launch_monitor import velocity_and_spin
from ..wind.gusts import Gusts, GustSettings

# Every scene asks for the same effects, so that all of them share their machine code.
EFFECTS = ('gravity', 'drag', 'magnus', 'spin_decay', 'turf')
GUST_STEP = 0.5  # s between the winds of a gusty scene
STEEP = 0.02  # slope of the greens: 2 %
HEAVY_GOING = 0.1  # rolling resistance of the hills, so that a ball stops on their slopes
BUNKER = (317.0, -15.5)  # m, in the one before the green of golf_without_friends


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
    def effects(self) -> tuple[str, ...]:
        """Names of the effects that the scene is studied with."""
        windy = not isinstance(self.wind[0], float)
        return (*EFFECTS, 'wind') if windy else EFFECTS


class Game(NamedTuple):
    """Balls at `places`, struck one after another.

    Each strike comes when all balls rest, or all `together`. ``strikes``: number of the ball,
    velocity [m/s], spin [rad/s].
    """

    name: str
    course: Course
    places: tuple
    strikes: tuple
    effects: tuple
    wind: tuple = (0.0, 0.0, 0.0)
    together: bool = False
    flies: bool = False


def gusty(seconds: float = 10.0, seed: int = 1) -> tuple[tuple[float, ...], ...]:
    """Rows of time and wind [m/s]: gusts of 8 +- 4 m/s, another every two seconds, turbulence."""
    gusts = Gusts(GustSettings(8.0, 4.0, 0.0, pi, interval=2.0, turbulence=0.1), seed)
    steps = int(seconds / GUST_STEP)
    return tuple((i * GUST_STEP, *gusts.wind(i * GUST_STEP)) for i in range(steps))


def club_shot(name: str) -> Shot:
    """`Shot` of a club's tour average, along +x."""
    launch = CLUBS[name].launch
    assert launch is not None, f'{name} has no average shot'
    return Shot(*velocity_and_spin(launch, 0.0))


def level(material: Material) -> Course:
    """Make a level `Course` of one material."""
    return Course(ground=(Plane(material=material),))


def sloping(material: Material) -> Course:
    """Make a `Course` of one material that falls to the right."""
    return Course(ground=(Plane((0.0, 0.0, 0.0), (0.0, -STEEP, 1.0), material),))


def lofted(speed: float, degrees: float, backspin: float) -> Shot:
    """`Shot` along +x at a launch angle."""
    angle = degrees * pi / 180
    return Shot((speed * cos(angle), 0.0, speed * sin(angle)), (0.0, -backspin, 0.0))


def quick_scenes() -> tuple[Scene, ...]:
    """Scenes of the quick study; CourseError where a shipped material can't be read."""
    found = materials({}, shipped()[0])
    return (
        Scene('drive in gusty wind', level(found['fairway']), club_shot('driver'), gusty()),
        Scene('iron into a green', level(found['green']), club_shot('7i')),
        Scene('putt across a slope', sloping(found['green']), Shot((2.0, 0.0, 0.0)), flies=False),
        Scene('bouncing on hard ground', level(hard()), lofted(10.0, 40.0, 0.0)),
    )


def scenes() -> tuple[Scene | Game, ...]:
    """Scenes of the full study; CourseError as in `quick_scenes`."""
    green = materials({}, shipped()[0])['green']
    in_sand = load_course('golf_without_friends')._replace(tee=BUNKER)
    return (
        *quick_scenes(),
        Scene('chip and run', level(green), lofted(11.0, 24.0, 150.0)),
        Scene('bunker shot', in_sand, Shot(*turned(lofted(16.0, 50.0, 400.0), 40.0)), flies=False),
        Scene('breaking putt', load_course('putting_green'), Shot((2.6, 1.6, 0.0)), flies=False),
        Scene('mesh bounce', hills(20_000), lofted(10.0, 40.0, 0.0), flies=False),
        rack(15),
        hole(),
    )


def hard(rolling_resistance: float = 0.02) -> Material:
    """Make a `Material` off which a ball bounces often."""
    return Material('hard', Restitution(0.8), 0.0, 0.5, 0.3, rolling_resistance, 0.003)


def hills(triangles: int, width: float = 120.0) -> Course:
    """Make a `Course` of a mesh of about as many `triangles`.

    It is a bowl with gentle hills in it, `width` [m] wide, and of the same shape at every width.
    """
    across, scale = round(sqrt(triangles / 2)) + 1, width / 120.0
    x, y = map(np.ravel, np.meshgrid(*2 * [np.linspace(-60.0, 60.0, across)]))
    z = 0.0005 * (x * x + y * y) - 0.15 * np.cos(0.4 * x) * np.cos(0.5 * y)
    i = np.add.outer(across * np.arange(across - 1), np.arange(across - 1)).ravel()
    faces = [
        np.transpose([i, i + 1, i + across + 1]),
        np.transpose([i, i + across + 1, i + across]),
    ]
    vertices = scale * np.transpose([x, y, z])
    return Course((Mesh(vertices, np.concatenate(faces), hard(HEAVY_GOING)),))


def as_heights(course: Course) -> Course:
    """`course`, a mesh over a square grid, such as `hills` makes, as a height map."""
    (mesh,) = course.ground
    across = round(len(mesh.vertices) ** 0.5)
    x, y, z = mesh.vertices.T.reshape(3, across, across)
    heights = Heightmap(z, (x[0, 0], y[0, 0]), x[0, 1] - x[0, 0], mesh.material)
    return course._replace(ground=(heights,))


def of_material(course: Course, material: Material) -> Course:
    """`course` with all its ground of one `material`."""
    ground = tuple(shape._replace(material=material) for shape in course.ground)
    return course._replace(ground=ground)


def rack(balls: int) -> Game:
    """Make a `Game`: the last ball breaks a rack of the others on cloth."""
    radius = Ball().radius
    rows = [(row, k) for row in range(balls) for k in range(row + 1)][:balls]
    places = [(row * sqrt(3) * radius, (2 * k - row) * radius, radius) for row, k in rows]
    cloth = Material('cloth', Restitution(0.5), 0.0, 0.2, 0.2, 0.01)
    course = Course(
        (Plane(material=cloth),), tee=(0.0, 500.0), ball=Ball(restitution=0.9, friction=0.05)
    )
    strike = (balls, (3.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    return Game(
        f'rack of {balls}',
        course,
        (*places, (-0.3, 0.0, radius)),
        (strike,),
        ('gravity', 'ball_ball'),
    )


def hole() -> Game:
    """Make a `Game`: a drive, a pitch and two putts on `links` until it is holed, in wind."""
    course = load_course('links')
    shots = (
        (club_shot('driver'), 4.0),
        (lofted(32.0, 28.0, 700.0), 8.0),
        (Shot((4.0, 0.0, 0.0)), 0.5),
        (Shot((1.6, 0.0, 0.0)), -21.0),
    )
    strikes = tuple((0, *turned(shot, degrees)) for shot, degrees in shots)
    return Game(
        'a whole hole on links',
        course,
        (course.tee,),
        strikes,
        (*EFFECTS, 'wind', 'water', 'foliage'),
        (-2.0, -3.0, 0.0),
    )


def turned(shot: Shot, degrees: float) -> tuple[tuple[float, float, float], ...]:
    """Velocity and spin of a `Shot` turned to the left."""
    c, s = cos(degrees * pi / 180), sin(degrees * pi / 180)
    return tuple((c * x - s * y, s * x + c * y, z) for x, y, z in shot)
