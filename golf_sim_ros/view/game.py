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

"""A round of golf: holes, strokes, penalties, a card. Counts what results tell."""

from math import hypot
from typing import Any, NamedTuple

from ..physics import Course, ground_height

# Rules of Handicapping, appendix F: a par 3 is up to 260 yd long, a par 4 240 to 490, a par 5
# from 450; between two ranges the middle. On a green a hole takes two putts.
LONGEST_PAR_3, LONGEST_PAR_4 = 250 * 0.9144, 470 * 0.9144  # m
ROUNDING = 0.6e-4  # results round the strike as it was received
NAMES = {-3: 'albatross', -2: 'eagle', -1: 'birdie', 0: 'par', 1: 'bogey', 2: 'double bogey'}


class Line(NamedTuple):
    """A stroke on the card: its number, club, result, and the penalty that it cost."""

    stroke: int
    club: str
    result: dict[str, Any]
    penalty: int


def par_of(course: Course) -> int:
    """Par of a course's hole, by its length."""
    hole = course.hole or course.tee
    way = hypot(hole[0] - course.tee[0], hole[1] - course.tee[1])
    found = ground_height(course, *map(float, course.tee[:2]))
    if found and found[1].endswith('green'):
        return 2
    return 3 if way <= LONGEST_PAR_3 else 4 if way <= LONGEST_PAR_4 else 5


class Hole:
    """One hole as it is played.

    Parameters
    ----------
    number : int
    name : str
    par : int
    """

    def __init__(self, number: int, name: str, par: int) -> None:
        self.number, self.name, self.par = number, name, par
        self.lines: list[Line] = []
        self.holed = False

    @property
    def strokes(self) -> int:
        """Strokes and penalties so far."""
        return sum(1 + line.penalty for line in self.lines)

    def add(self, result: dict[str, Any], club: str) -> None:
        """Count a shot, if it was one: not where it was rejected, failed or ended by a reset."""
        if result['status'] in ('rejected', 'failed', 'aborted'):
            return
        if result.get('stroke') == 1:
            self.lines.clear()  # teed anew
        penalty = int(result.get('penalty') or 0)
        self.lines.append(Line(self.strokes + 1, club, result, penalty))
        self.holed = result['status'] == 'holed'

    def verdict(self) -> str:
        """Call the score by its name."""
        if self.strokes == 1:
            return 'hole in one'
        over = self.strokes - self.par
        return NAMES.get(over, f'{over:+d}')


class Round:
    """Holes one after the other, and the strikes that were sent but are not yet told of."""

    def __init__(self) -> None:
        self.holes: list[Hole] = []
        self.sent: list[tuple[str, tuple[float, ...]]] = []

    @property
    def hole(self) -> Hole:
        """The hole that is played."""
        return self.holes[-1]

    def begin(self, course: Course) -> None:
        """Begin the next hole."""
        self.holes.append(Hole(len(self.holes) + 1, course.name, par_of(course)))
        self.sent.clear()

    def strike(self, club: str, velocity: tuple[float, ...], spin: tuple[float, ...]) -> None:
        """Note with which club a strike was sent."""
        self.sent = [*self.sent[-9:], (club, (*velocity, *spin))]

    def end(self, result: dict[str, Any]) -> None:
        """Count a result; the club is known of what was sent from here."""
        told = [*(result['velocity'] or ()), *(result['spin'] or ())]
        club = next((club for club, sent in self.sent if is_same(told, sent)), '')
        if self.holes:
            self.hole.add(result, club)

    def score(self) -> dict[str, Any]:
        """Sum up what pages show at their heads."""
        if not self.holes:
            return {}
        hole = self.hole
        more = len(self.holes) > 1
        return {
            'hole': str(hole.number) if more else '',
            'par': hole.par,
            'stroke': hole.strokes + (0 if hole.holed else 1),
            'name': hole.name,
        }


def is_same(told: list[Any], sent: tuple[float, ...]) -> bool:
    """Whether a strike as a result tells it is the one that was sent."""
    pairs = list(zip(told, sent))
    return len(pairs) == 6 and all(a is not None and abs(a - b) <= ROUNDING for a, b in pairs)
