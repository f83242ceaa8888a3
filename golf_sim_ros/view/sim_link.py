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

"""The page's link to a sim over ROS 2: listens to its topics in a thread of its own.

It has a publisher of strikes only where it may strike.
"""

import asyncio
from collections.abc import Callable
from functools import partial
import os
import threading
from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped, Twist, Vector3Stamped
import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.validate_namespace import validate_namespace
from std_msgs.msg import String
from std_srvs.srv import Trigger

from .course_data import course_data
from .session import Session
from ..course import CourseError, load_course
from ..nodes.conversions import strike, triple, Vector
from ..nodes.lifecycle import EventsExecutor
from ..nodes.reachability import ours, Reach, RESULT
from ..recording.bag import BagError
from ..recording.journal import beginning, JournalError, opened
from ..recording.replay import course_of

LASTING = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
STREAM = QoSProfile(depth=100)
LOOK = 0.25  # s from one look at the heartbeat to the next
POLL = 0.2  # s in which the thread notices that it is to end


def check_namespace(name: str | None) -> None:
    """Check the name of a namespace as a node does; ValueError where it is none."""
    if name:
        try:
            validate_namespace(name if name.startswith('/') else f'/{name}')
        except NameValidationException as error:
            raise ValueError(error) from None


class SimLink:
    """Link to the sim in a namespace.

    Parameters
    ----------
    session : Session
        Is told what happens, in the event loop's thread.
    namespace : str or None
    may_strike : bool
    course : str or None
        Name or path of the course, where it is not where the sim says.

    Raises
    ------
    ValueError
        The namespace is none.
    """

    def __init__(
        self, session: Session, namespace: str | None, may_strike: bool, course: str | None
    ) -> None:
        self.session, self.namespace, self.may_strike = session, namespace, may_strike
        self.given_course = course
        check_namespace(namespace)
        self.ended = threading.Event()
        self.start: int | None = None
        self.beginning: tuple[int, int] | None = None
        self.of_balls: list[Any] = []
        self.names: list[str] = []
        self.told: tuple[bool, ...] | None = None
        self.thread: threading.Thread | None = None

    def connect(self) -> None:
        """Begin to listen; called in the event loop."""
        self.loop = asyncio.get_running_loop()
        rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
        self.node = Node(
            f'{"play_hole" if self.may_strike else "view_play"}_{os.getpid()}',
            namespace=self.namespace,
            start_parameter_services=False,
            enable_rosout=False,
        )
        listen = self.node.create_subscription
        listen(String, 'journal', self.on_journal, LASTING)
        listen(String, 'shot/result', self.on_result, LASTING)
        listen(Vector3Stamped, 'wind', self.on_wind, NEWEST)
        self.reach = Reach(self.node)
        self.node.create_timer(LOOK, self.look)
        if self.may_strike:
            self.shots = self.node.create_publisher(Twist, 'shot', 10)
            self.resets = self.node.create_client(Trigger, 'golf_sim/reset')
        self.thread = threading.Thread(target=self.spin, name='ros')
        self.thread.start()

    def spin(self) -> None:
        """Listen until told to end."""
        executor = EventsExecutor()
        executor.add_node(self.node)
        while rclpy.ok() and not self.ended.is_set():
            executor.spin_once(timeout_sec=POLL)
        executor.remove_node(self.node)

    def close(self) -> None:
        """Stop to listen."""
        self.ended.set()
        if self.thread is not None:
            self.thread.join(2.0)
            self.node.destroy_node()
        rclpy.try_shutdown()

    def tell(self, act: Callable[..., Any], *given: Any) -> None:
        """Have the event loop's thread call `act`."""
        if not self.loop.is_closed():
            self.loop.call_soon_threadsafe(act, *given)

    def strike(self, velocity: Vector, spin: Vector) -> None:
        """Strike the ball in play."""
        self.shots.publish(strike(velocity, spin))

    def reset(self) -> None:
        """Tee the ball up again."""
        self.resets.call_async(Trigger.Request())

    def look(self) -> None:
        """Tell whether the sim can be reached, where that has changed."""
        offered, lost = self.reach.is_offered(), self.reach.is_lost()
        state = (not lost, bool(self.reach.last and self.reach.last['paused']), offered)
        if state != self.told:
            self.told = state
            self.tell(self.session.on_reach, *state)

    def on_journal(self, message: String) -> None:
        """Take the sim's configuration, each strike and each reset."""
        try:
            entry = opened(message.data)
        except JournalError:
            return
        if entry['kind'] == 'config' and beginning(entry) != self.beginning:
            self.begin(entry)
        elif entry['kind'] == 'strike' and self.start is not None and entry['ball'] in self.names:
            time = entry['tick'] / self.rate
            self.tell(self.session.on_strike, entry['ball'], time, entry['shot'])
        elif entry['kind'] == 'reset' and self.start is not None:
            self.tell(self.session.on_reset)

    def begin(self, config: dict[str, Any]) -> None:
        """Follow a sim that has just been started, or that is newly seen."""
        self.beginning = beginning(config)
        self.start, self.rate = config['start'], config['parameters']['rate']
        for subscription in self.of_balls:
            self.node.destroy_subscription(subscription)
        self.of_balls, self.names = [], []
        try:
            given = self.given_course
            course = load_course(given) if given else course_of(config, None)
            data = course_data(course)
        except (BagError, CourseError) as error:
            self.tell(self.session.on_no_course, ' '.join(str(error).split()))
            return
        self.names = config['parameters']['balls']
        self.tell(self.session.on_begin, course, data, self.names)
        for number, name in enumerate(self.names):
            for kind, topic, take in (
                (PoseStamped, 'pose', self.on_pose),
                (PointStamped, 'contact', self.on_contact),
            ):
                subscription = self.node.create_subscription(
                    kind, f'{name}/{topic}', partial(take, number), STREAM
                )
                self.of_balls.append(subscription)

    def time_of(self, message: Any) -> float:
        """Reckon the simulated time of a stamp [s]."""
        stamp = message.header.stamp
        return 1e-9 * (stamp.sec * 10**9 + stamp.nanosec - self.start)

    def on_pose(self, number: int, message: PoseStamped) -> None:
        """Tell where a ball is."""
        place = triple(message.pose.position)
        self.tell(self.session.on_pose, number, self.time_of(message), place, False)

    def on_contact(self, number: int, message: PointStamped) -> None:
        """Tell where a ball hit something."""
        place = triple(message.point)
        self.tell(self.session.on_pose, number, self.time_of(message), place, True)

    def on_result(self, message: String) -> None:
        """Tell how a shot ended."""
        result = ours(message.data, RESULT)
        if result:
            self.tell(self.session.on_result, result)

    def on_wind(self, message: Vector3Stamped) -> None:
        """Tell the wind."""
        self.tell(self.session.on_wind, triple(message.vector))
