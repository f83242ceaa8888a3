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

"""A ROS node that strikes a ball and waits for the result."""

from collections.abc import Callable
from math import atan2, hypot
import os
import sys
import time
from typing import Any

from geometry_msgs.msg import Point, PoseStamped, Twist
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.subscription import Subscription
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from ..nodes.conversions import strike, Vector
from ..nodes.older_rclpy import publisher_count
from ..nodes.reachability import ours, Reach, RESULT, SILENT
from ..recording.journal import JournalError, opened

# A result repeats the strike rounded to 1e-4.
ROUNDING = 0.6e-4

# A sim rejects a shot in its next step, unless it is paused.
AT_ONCE = 1.0  # s

# Volatile, so that no earlier shot's result is taken for ours.
RESULT_QOS = QoSProfile(depth=100)
# Of a sim with a heartbeat: what is published while the link is cut arrives later.
LASTING_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NOTICE = 2.9  # s without a sim, after which a line says so
MARKERS_QOS = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class NoShot(RuntimeError):
    """There is no result, and the message says why."""


class Player(Node):
    """A node beside a sim.

    Parameters
    ----------
    ball : str or None
        The ball to strike, or None for the ball in play.
    namespace : str or None
    timeout : float
        For how long to look for a sim [s].
    wait : float
        For how long to wait for a sim that cannot be reached any more once it was struck [s].
    """

    def __init__(
        self,
        ball: str | None = None,
        namespace: str | None = None,
        timeout: float = 5.0,
        wait: float = 60.0,
    ) -> None:
        super().__init__(
            f'shoot_{os.getpid()}',
            namespace=namespace,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self.ball = ball
        self.timeout = timeout
        self.wait = wait
        self.received = 0
        self.number: int | None = None
        self.said = ''
        self._lasting: list[Subscription] = []
        self._matched_at: float | None = None
        self.results: list[dict[str, Any]] = []
        self.position: Point | None = None
        self.markers: list[Marker] | None = None
        self.struck_at = time.monotonic()
        self.first_position: Point | None = None
        self._shots = self.create_publisher(Twist, f'{ball}/shot' if ball else 'shot', 10)
        self._results = self.create_subscription(
            String, 'shot/result', self._take_result, RESULT_QOS
        )
        self.reach = Reach(self)
        self._poses = self.create_subscription(
            PoseStamped, f'{ball or "ball"}/pose', self._take_pose, 10
        )
        # Last: subscriptions are announced in order, so the sim that sends us its course has
        # already found the one for results.
        self.create_subscription(MarkerArray, 'course/markers', self._take_markers, MARKERS_QOS)

    @property
    def shot_topic(self) -> str:
        """Name of the topic to which the shot goes, with namespace and remappings."""
        return self._shots.topic_name

    def find_sim(self) -> None:
        """Wait until publisher and subscriptions match those of a sim.

        Raises
        ------
        NoShot
            If there is none.
        """
        if not self._wait(self._is_reachable, self.timeout, self._notice_absence):
            raise NoShot(f'no sim answers on {self.shot_topic} within {self.timeout:g} s')
        if not self._wait(lambda: self.markers is not None, self.timeout):
            raise NoShot(
                f'a sim listens on {self.shot_topic}, but shows no course within '
                f'{self.timeout:g} s'
            )

    def _is_reachable(self) -> bool:
        if not self._shots.get_subscription_count():
            return False
        return self.reach.is_fresh() if self.reach.is_offered() else not self._hopes()

    def _hopes(self) -> bool:
        """Whether it is too early to say that a sim publishes no heartbeat."""
        self._matched_at = self._matched_at or time.monotonic()
        return time.monotonic() < self._matched_at + AT_ONCE

    def _notice_absence(self, since: float) -> None:
        absent = not self._shots.get_subscription_count() or self.reach.is_offered()
        if absent and time.monotonic() > since + NOTICE:
            self._say(f'no sim answers on {self.shot_topic} yet')

    def _say(self, what: str) -> None:
        """Print a line for the user, once."""
        if what != self.said:
            self.said = what
            print(f'shoot: {what}', file=sys.stderr, flush=True)

    def way_to_hole(self) -> tuple[float, float]:
        """Direction and distance from the ball to the hole.

        Returns
        -------
        heading : float
            Angle from x towards y [rad].
        distance : float
            Horizontal distance [m].

        Raises
        ------
        NoShot
            If there is no hole or the ball cannot be found.
        """
        self.find_sim()
        holes = [
            marker.pose.position
            for marker in self.markers or ()
            if (marker.ns, marker.id) == ('hole', 0)
        ]
        if not holes:
            raise NoShot('this course has no hole to aim at')
        self._wait(lambda: self.position is not None, self.timeout)
        if self.position is None:
            raise NoShot(
                f'no ball on {self._poses.topic_name}; name the one to strike with --ball'
            )
        x, y = holes[0].x - self.position.x, holes[0].y - self.position.y
        return atan2(y, x), hypot(x, y)

    def strike(self, velocity: Vector, spin: Vector) -> dict[str, Any]:
        """Strike the ball and wait until the shot has ended.

        Parameters
        ----------
        velocity, spin : tuple of 3 float

        Returns
        -------
        dict
            What `shot/result` says.

        Raises
        ------
        NoShot
            If there is no sim, or it rejects the shot, aborts it, or goes away.
        """
        self.find_sim()
        self.said = ''  # that it was not there yet is settled
        self.results.clear()
        beat = self._listen_for_good(velocity, spin) if self.reach.is_offered() else None
        self.struck_at = time.monotonic()
        self.first_position = None
        self._shots.publish(strike(velocity, spin))
        while not self._wait(lambda: self._own_result(velocity, spin), 0.5):
            if beat:
                self._look_after(beat)
            elif not publisher_count(self, self._results):
                raise NoShot('the sim went away before the shot ended')
        result = self._own_result(velocity, spin)
        assert result is not None  # it was waited for
        if result['status'] in ('rejected', 'aborted', 'failed'):
            raise NoShot(': '.join(filter(None, (result['status'], result['reason']))))
        return result

    def _listen_for_good(self, velocity: Vector, spin: Vector) -> dict[str, Any]:
        """Subscribe also to what is published while the link is cut; return the last heartbeat."""
        beat = self.reach.beat
        self.received = beat['shots']
        self._lasting = [
            self.create_subscription(String, 'shot/result', self._take_result, LASTING_QOS),
            self.create_subscription(
                String,
                'journal',
                lambda message: self._take_entry(message, list(velocity), list(spin)),
                LASTING_QOS,
            ),
        ]
        return beat

    def _take_entry(self, message: String, velocity: list[float], spin: list[float]) -> None:
        try:
            entry = opened(message.data)
        except JournalError:
            return
        if entry['kind'] != 'strike' or entry['shot'] <= self.received or self.number is not None:
            return
        if (entry['velocity'], entry['spin']) == (velocity, spin) and self.ball in (
            None,
            entry['ball'],
        ):
            self.number = entry['shot']

    def _look_after(self, struck: dict[str, Any]) -> None:
        """Say what became of the sim; raise `NoShot` where it or the strike was lost."""
        now = self.reach.beat
        if now['session'] != struck['session']:
            raise NoShot('the sim was started anew: the shot is lost')
        if self.reach.silence() > SILENT + self.wait:
            raise NoShot(
                f'the sim went away before the shot ended, and was not back within {self.wait:g} s'
            )
        if self.reach.is_lost():
            self._say(f'the sim cannot be reached; waiting for it, {self.wait:g} s at most')
        elif now['paused']:
            self._say('the sim is paused; waiting until it goes on')
        elif self.said:
            self._say('the sim plays on')
        if self.number is None and self.reach.has_had_time(self.struck_at):
            raise NoShot('nobody took the strike: it was lost on its way; strike again')

    def _own_result(self, velocity: Vector, spin: Vector) -> dict[str, Any] | None:
        return next(
            (result for result in self.results if self._is_own(result, velocity, spin)), None
        )

    def _is_own(self, result: dict[str, Any], velocity: Vector, spin: Vector) -> bool:
        if self.ball and result['ball'] != self.ball or result['shot'] <= self.received:
            return False
        if self.number is not None:
            return result['shot'] == self.number
        told, struck = [*result['velocity'], *result['spin']], [*velocity, *spin]
        return all(a is not None and abs(a - b) <= ROUNDING for a, b in zip(told, struck))

    def _wait(
        self,
        condition: Callable[[], Any],
        seconds: float,
        meanwhile: Callable[[float], None] = lambda since: None,
    ) -> bool:
        """Whether `condition()` became true within so many `seconds`, spinning meanwhile."""
        since = time.monotonic()
        while not condition():
            if time.monotonic() > since + seconds:
                return False
            meanwhile(since)
            rclpy.spin_once(self, timeout_sec=0.05)
        return True

    def _take_result(self, message: String) -> None:
        result = ours(message.data, RESULT)
        if result and not (result['status'] == 'rejected' and self._is_under_way()):
            self.results.append(result)

    def _is_under_way(self) -> bool:
        """Whether our shot is played, so that a rejection is that of another just like it."""
        late = time.monotonic() > self.struck_at + AT_ONCE
        return late and self.position != self.first_position

    def _take_pose(self, message: PoseStamped) -> None:
        self.position = message.pose.position
        self.first_position = self.first_position or self.position

    def _take_markers(self, message: MarkerArray) -> None:
        self.markers = message.markers
