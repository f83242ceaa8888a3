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

"""The play as a handful of markers: balls, trails, last contacts, wind."""

from collections import deque
from collections.abc import Sequence
from math import hypot, inf

from std_msgs.msg import Header
from visualization_msgs.msg import Marker, MarkerArray

from .course_markers import marker, points, put
from ...physics import Course, ground_height, Result, World
from ...physics.geometry.solid import FLAGSTICK_HEIGHT

TRAIL = 300  # points at most of a trail
TRAILS = 3000  # points at most of all trails,
LEAST = 20  # but so many every trail may have
CONTACTS = 20  # last contacts that are shown
TRAIL_WIDTH = 0.2  # m: less is no pixel from afar
HALO = 0.6  # m across, around a ball that is no pixel either
SHEER = 0.3  # how much of the halo is seen
TEXT_SHARE = 1 / 60  # height of texts, of the way from the tee to the hole,
LEAST_TEXT, MOST_TEXT = 0.15, 5.0  # m, within these
NEAR = 20.0  # m below which the distance is told to a decimetre
CONTACT_SIZE = 0.15  # m
ARROW = (0.15, 0.4, 0.5)  # m: diameters of shaft and head, length of the head
ARROW_HEIGHT = 10.0  # m over the tee, where wind is given
BALL = (1.0, 1.0, 1.0)
PATH = (1.0, 0.9, 0.2)
HIT = (0.9, 0.3, 0.1)
AIR = (0.3, 0.6, 1.0)


class Trail:
    """Places where a ball was since it was struck, at most `most`, evenly spread over its way.

    When full, every other place is dropped and from then on half as many are taken.
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self.clear()

    def clear(self) -> None:
        """Drop all places."""
        self.places: list[tuple[float, ...]] = []
        self.every = 1
        self.seen = 0

    def add(self, place: Sequence[float]) -> None:
        """Add `place`, unless it is one that is left out."""
        if self.seen % self.every == 0:
            self.places.append(tuple(place))
        self.seen += 1
        if len(self.places) >= self.most:
            self.places = self.places[::2]
            self.every *= 2


class Scene:
    """Trails and last contacts of the play in `world`, as markers."""

    def __init__(self, world: World) -> None:
        most = max(LEAST, min(TRAIL, TRAILS // len(world.names)))
        self.trails = {name: Trail(most) for name in world.names}
        self.contacts: deque[tuple] = deque(maxlen=CONTACTS)
        self.size = 2 * world.course.ball.radius
        x, y = world.course.tee
        found = ground_height(world.course, x, y)
        assert found is not None, 'a course is refused that has no ground under its tee'
        self.place = x, y, found[0]
        self.ended: Result | None = None  # the last shot that did
        self.pin = hole_of(world.course)
        self.letter = letter_height(world.course)
        self.flag = FLAGSTICK_HEIGHT if world.course.flagstick else 0.0

    def markers(self, head: Header, world: World, wind: Sequence[float]) -> MarkerArray:
        """Make the MarkerArray of now.

        `world` has the balls, `wind` [m/s] an arrow, a metre for each m/s.
        """
        found = [self.hits(), self.arrow(wind), self.distance(world), self.result()]
        for number, (name, trail) in enumerate(self.trails.items()):
            ball = marker('ball', number, Marker.SPHERE, (self.size,) * 3, BALL)
            put(ball, *world[name].position)
            path = marker('trail', number, Marker.LINE_STRIP, (TRAIL_WIDTH, 0.0, 0.0), PATH)
            path.points = points([*trail.places, world[name].position])
            halo = marker('halo', number, Marker.SPHERE, (HALO,) * 3, BALL)
            halo.color.a = SHEER
            put(halo, *world[name].position)
            found += [ball, halo, path]
        for made in found:
            made.header = head
        return MarkerArray(markers=found)

    def hits(self) -> Marker:
        """Spheres at the last contacts."""
        made = marker('contacts', 0, Marker.SPHERE_LIST, (CONTACT_SIZE,) * 3, HIT)
        made.points = points(self.contacts)
        return hidden(made, not self.contacts)

    def arrow(self, wind: Sequence[float]) -> Marker:
        """Arrow to where the air goes."""
        x, y, z = self.place
        z += ARROW_HEIGHT
        made = marker('wind', 0, Marker.ARROW, ARROW, AIR)
        made.points = points([(x, y, z), (x + wind[0], y + wind[1], z + wind[2])])
        return hidden(made, not any(wind))

    def distance(self, world: World) -> Marker:
        """Text over the pin: how far the ball in play is from it."""
        if self.pin is None:
            return hidden(text(0, '', self.place, self.letter), True)
        x, y, z = self.pin
        ball = world[world.names[0]].position
        way = hypot(ball[0] - x, ball[1] - y)
        above = (x, y, z + self.flag + self.letter)
        return text(0, f'{way:.{int(way < NEAR)}f} m', above, self.letter)

    def result(self) -> Marker:
        """Text over where the last shot ended: how far it went, and on what it lies."""
        if self.ended is None:
            return hidden(text(1, '', self.place, self.letter), True)
        x, y, z = self.ended.position
        end = self.ended.lie if self.ended.status == 'at_rest' else self.ended.status
        told = f'{self.ended.total:.1f} m, {end.replace("_", " ")}'
        return text(1, told, (x, y, z + HALO + self.letter), self.letter)


def hole_of(course: Course) -> tuple[float, float, float] | None:
    """Middle of the hole on the ground; None where there is none."""
    found = ground_height(course, *course.hole) if course.hole else None
    return (*course.hole, found[0]) if course.hole and found else None


def letter_height(course: Course) -> float:
    """Height of texts [m]: as much of the view of a long hole as of a short one's."""
    x, y = course.tee
    way = hypot(course.hole[0] - x, course.hole[1] - y) if course.hole else inf
    return min(max(LEAST_TEXT, TEXT_SHARE * way), MOST_TEXT)


def text(number: int, words: str, place: Sequence[float], height: float) -> Marker:
    """Words at a place, facing who looks, `height` [m] high."""
    made = marker('text', number, Marker.TEXT_VIEW_FACING, (0.0, 0.0, height), BALL)
    made.text = words
    put(made, *place)
    return made


def hidden(made: Marker, empty: bool) -> Marker:
    """Make a marker one that takes it away, where it is `empty`; return it."""
    if empty:
        made.action = Marker.DELETE
        made.points = []
    return made
