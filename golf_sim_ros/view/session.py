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

"""A play as the page knows it: what was heard from the sim, whether its ball can be struck."""

from collections.abc import Callable
from time import monotonic
from typing import Any, NamedTuple

from .course_data import CourseData
from .feed import Feed
from .game import Round
from ..physics import Course

TAKEN = 3.0  # s in which a sim that can be reached has taken a strike, or it was lost
Place = tuple[float, float, float]

AWAY = 'The sim cannot be reached'
NOT_YET = 'Looking for a sim ...'


class Lie(NamedTuple):
    """A ball that lies somewhere: course, x, y, z, and the wind there."""

    course: Course
    place: Place
    wind: Place


class Session:
    """What is heard of one sim, for all browsers.

    Parameters
    ----------
    is_game : bool
        Whether strokes are counted.
    """

    def __init__(self, is_game: bool = False) -> None:
        self.feed, self.round = Feed(), Round()
        self.is_game = is_game
        self.course: Course | None = None
        self.names: list[str] = []
        self.reached, self.problem = False, ''
        self.sent_at: float | None = None
        self.outcome: dict[str, Any] | None = None  # of what was sent last, as soon as it is told
        self.flying: dict[int, int] = {}  # shots by ball
        self.ended: set[int] = set()  # numbers of shots that are over
        self.struck = 0  # number of the last strike
        self.places: dict[int, Place] = {}
        self.wind: Place = (0.0, 0.0, 0.0)
        self.changed: list[Callable[[], Any]] = []  # called after each change, by pages

    def listen(self, act: Callable[[], Any]) -> Callable[[], None]:
        """Call `act` after each change, until the function that is given back is called."""
        self.changed.append(act)

        def forget() -> None:
            if act in self.changed:
                self.changed.remove(act)

        return forget

    def notify(self) -> None:
        """Tell the pages that something changed."""
        self.feed.tell_score(self.round.score() if self.is_game else {})
        for act in list(self.changed):
            act()

    @property
    def lie(self) -> Lie | None:
        """Where the ball in play is, and on which course; None where that is not known yet."""
        place = self.places.get(0)
        return Lie(self.course, place, self.wind) if self.course and place else None

    @property
    def is_over(self) -> bool:
        """Whether the hole that is played is finished."""
        return bool(self.round.holes) and self.round.hole.holed

    def can_strike(self) -> bool:
        """Whether the ball in play waits to be struck."""
        waits = self.sent_at is not None and monotonic() < self.sent_at + TAKEN
        return bool(
            self.reached and self.lie and not waits and not self.flying.get(0) and not self.is_over
        )

    def sent(self, club: str, velocity: Place, spin: Place) -> None:
        """Note a strike that is being sent."""
        self.sent_at, self.outcome = monotonic(), None
        self.round.strike(club, velocity, spin)
        self.notify()

    def on_reach(self, reached: bool, paused: bool, offered: bool) -> None:
        """Take whether the sim can be reached."""
        self.reached = reached
        text = self.problem or ('The sim is paused' if paused else '')
        if not reached:
            text = self.problem or (AWAY if self.course or offered else NOT_YET)
        self.feed.say(reached, text)
        self.notify()

    def on_no_course(self, reason: str) -> None:
        """Take that the sim's course cannot be read here."""
        self.problem = f'{reason}; --course names the course'
        self.feed.say(self.reached, self.problem)

    def on_ending(self, reason: str) -> None:
        """Take that a process of one's own has ended, and does not come back."""
        self.problem = f'{reason}: start play_hole anew'
        self.feed.say(False, self.problem)

    def on_begin(self, course: Course, data: CourseData, names: list[str]) -> None:
        """Take a sim's start: course and balls."""
        self.course, self.names, self.problem = course, names, ''
        self.flying, self.ended, self.struck = {}, set(), 0
        self.places, self.sent_at = {}, None
        self.feed.show_course(data, names)
        self.feed.say(self.reached, '' if self.reached else self.feed.status['text'])
        if self.is_game and course.hole:
            self.round.begin(course)
        self.notify()

    def on_reset(self) -> None:
        """Take that all balls are back at the start, where the hole begins anew."""
        late = (
            max(self.ended, default=0) > self.struck
        )  # told of again, and shots since were heard
        if self.course is None or self.feed.course is None or late:
            return
        self.flying, self.places, self.sent_at = {}, {}, None
        self.feed.show_course(self.feed.course, self.names)
        if self.is_game and self.round.holes:
            self.round.holes.pop()
            self.round.begin(self.course)
        self.notify()

    def on_strike(self, ball: str, time: float, shot: int) -> None:
        """Take that a strike was played."""
        self.struck = max(self.struck, shot)
        if shot in self.ended or ball not in self.names:
            return
        number = self.names.index(ball)
        self.flying[number] = shot
        self.sent_at = None
        self.feed.strike(number, time)
        self.notify()

    def on_pose(self, number: int, time: float, place: Place, exact: bool) -> None:
        """Take where a ball is."""
        if number >= len(self.names):
            return
        known = number in self.places
        if not exact:
            self.places[number] = place
        self.feed.pose(number, time, place, exact)
        if not known:
            self.notify()

    def on_result(self, result: dict[str, Any]) -> None:
        """Take the end of a shot."""
        if result['ball'] not in self.names or result['shot'] in self.ended:
            return
        number = self.names.index(result['ball'])
        self.ended.add(result['shot'])
        if result['status'] != 'rejected':
            self.flying.pop(number, None)
        if number == 0:
            self.sent_at, self.outcome = None, result
            if self.is_game:
                self.round.end(result)
        self.feed.result(result)
        self.notify()

    def on_wind(self, wind: Place) -> None:
        """Take the wind."""
        self.wind = wind
        self.feed.blow(wind, monotonic())
