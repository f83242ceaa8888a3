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

"""All that `sim_node` publishes, with the QoS of each topic and why."""

from collections.abc import Callable
from time import monotonic, time_ns
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped, PoseStamped, TwistStamped
import numpy as np
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header, String
from visualization_msgs.msg import MarkerArray

from . import conversions
from .diagnostics import diagnostic
from .markers.course_markers import course_markers
from .markers.play_markers import Scene
from .memory import give_back_memory
from .older_rclpy import on_match, watch
from .parameters import Parameters
from .transforms import Transforms
from ..physics import BallState, Collision, Result, World
from ..recording.json_format import collision_text, rejection_text, result_text, text

STREAM = QoSProfile(depth=10)  # reliable, volatile: only what is new counts
POINTS = QoSProfile(depth=100)  # a bouncing ball makes many at once
# Nothing of it may be missed: who subscribes late, or loses the link, gets the last ones.
EVENTS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
CLOCK_PERIOD = 0.01  # s of wall time at least
# Only the last one counts; reliable, so that it matches whatever is asked for.
BEAT = QoSProfile(depth=1)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Publishers:
    """Publishers of all topics of a game, and the messages on them: a `listener.Listener`.

    Parameters
    ----------
    node : rclpy.node.Node
        The node that publishes. Simulated time begins now, on its clock.
    world : World
    given : Parameters
        Has the frame of every stamp, and whether simulated time itself is the stamp and on /clock.
    on_viewer, on_follower : callable
        Called when a node subscribes to the course's markers, or to a ball.
    """

    def __init__(
        self,
        node: Node,
        world: World,
        given: Parameters,
        on_viewer: Callable[[], None],
        on_follower: Callable[[], None],
    ) -> None:
        self.node = node
        self.world = world
        self.frame = given.frame_id
        self.began = 0 if given.publish_clock else node.get_clock().now().nanoseconds
        self.clock = (
            node.create_publisher(Clock, '/clock', STREAM) if given.publish_clock else None
        )
        self.next_clock = monotonic()
        self.markers = Scene(world)
        self.transforms = None
        if given.publish_tf:
            parent, head = given.parent_frame, self.head(world.time)
            self.transforms = Transforms(node, world.course, parent, self.frame, head)
        self.config = ''
        self.entries_since = 0
        self.open_balls(on_match(on_follower))
        watch(node, [*self.poses.values(), *self.twists.values()], on_follower)
        make = node.create_publisher
        self.of_collisions = make(String, 'collisions', EVENTS)
        self.of_results = make(String, 'shot/result', EVENTS)
        self.of_journal = make(
            String, 'journal', EVENTS, event_callbacks=on_match(self.repeat_config)
        )
        self.of_course = make(
            MarkerArray, 'course/markers', LATCHED, event_callbacks=on_match(on_viewer)
        )
        watch(node, [self.of_journal], self.repeat_config)
        watch(node, [self.of_course], on_viewer)
        self.of_play = make(MarkerArray, 'play/markers', STREAM)
        self.of_diagnostics = make(DiagnosticArray, '/diagnostics', STREAM)
        self.of_heartbeat = make(String, 'heartbeat', BEAT)
        self.session = time_ns()

    def open_balls(self, matched: Any) -> None:
        """Create the publishers of each ball, by name."""
        make, names = self.node.create_publisher, self.world.names
        self.poses = {
            name: make(PoseStamped, f'{name}/pose', STREAM, event_callbacks=matched)
            for name in names
        }
        self.twists = {
            name: make(TwistStamped, f'{name}/twist', STREAM, event_callbacks=matched)
            for name in names
        }
        self.contacts = {name: make(PointStamped, f'{name}/contact', POINTS) for name in names}

    def head(self, time: float) -> Header:
        """Header of a message about simulated `time`."""
        return conversions.header(self.frame, self.began, time)

    def publish_time(self) -> None:
        """Publish simulated time on /clock, where wanted, once in `CLOCK_PERIOD` at most."""
        now = monotonic()
        if self.clock and now >= self.next_clock:
            self.next_clock = now + CLOCK_PERIOD
            self.clock.publish(Clock(clock=self.head(self.world.time).stamp))

    def balls(
        self, balls: dict[str, BallState], orientations: dict[str, np.ndarray], moving: set[str]
    ) -> None:
        """Publish the time, and poses and twists of `balls`, by name."""
        self.publish_time()
        head = self.head(self.world.time)
        for name, ball in balls.items():
            if heard(self.poses[name]):
                self.poses[name].publish(conversions.pose(head, ball, orientations[name]))
            if heard(self.twists[name]):
                self.twists[name].publish(conversions.twist(head, ball))
            if name in moving:
                self.markers.trails[name].add(ball.position)
        if self.transforms:
            self.transforms.balls(head, balls, orientations)

    def path_begins(self, ball: str) -> None:
        """Begin the ball's trail anew."""
        self.markers.trails[ball].clear()

    def collision(self, collision: Collision) -> None:
        """Publish a collision, as JSON and as a point."""
        self.of_collisions.publish(String(data=collision_text(collision)))
        both = [collision.ball] + [collision.with_] * (collision.kind == 'ball')
        for name in both:
            if heard(self.contacts[name]):
                self.contacts[name].publish(
                    conversions.contact(self.head(collision.time), collision)
                )
        self.markers.contacts.append(collision.position)

    def result(self, result: Result, shot: int) -> None:
        """Publish the end of strike number `shot`."""
        self.markers.ended = result if result.status != 'failed' else None
        self.of_results.publish(String(data=result_text(result, shot)))

    def rejection(self, shot: int, ball: str, velocity: tuple, spin: tuple, reason: str) -> None:
        """Publish that strike number `shot` was not played, and why."""
        self.of_results.publish(String(data=rejection_text(shot, ball, velocity, spin, reason)))

    def journal_entry(self, text: str) -> None:
        """Publish an entry of the journal; the first one is the configuration."""
        self.config = self.config or text
        self.entries_since += 1
        self.of_journal.publish(String(data=text))

    def repeat_config(self) -> None:
        """Publish the configuration once more, unless who subscribes late gets it anyway."""
        if self.entries_since > EVENTS.depth:
            self.entries_since = 1
            self.of_journal.publish(String(data=self.config))

    def heartbeat(self, shots: int, paused: bool) -> None:
        """Publish the heartbeat: session, strikes taken or rejected, whether it is paused."""
        self.of_heartbeat.publish(
            String(data=text({'session': self.session, 'shots': shots, 'paused': paused}))
        )

    def scene(self, wind: tuple) -> None:
        """Publish markers of the play."""
        if heard(self.of_play):
            self.of_play.publish(
                self.markers.markers(self.head(self.world.time), self.world, wind)
            )

    def course(self) -> None:
        """Publish markers of the course; what making them took is given back."""
        self.of_course.publish(course_markers(self.world.course, self.frame))
        give_back_memory()

    def diagnostics(self, slow: bool, values: dict[str, str]) -> None:
        """Publish how well the simulation keeps up."""
        now = self.node.get_clock().now().to_msg()
        name = f'{self.node.get_fully_qualified_name()}: play'
        self.of_diagnostics.publish(diagnostic(now, name, slow, values))


def heard(publisher: Publisher) -> bool:
    """Whether `publisher` has subscriptions; if not, a volatile message need not be made."""
    return publisher.get_subscription_count() > 0
