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

"""All topics of a play, with their types and the QoS that is offered on them."""

from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PointStamped, PoseStamped, Twist, TwistStamped, Vector3Stamped
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from ..nodes.publishers import EVENTS, LATCHED, POINTS, STREAM

DEEP = 1000  # messages that may wait to be written
# Topics that any node may publish: the least QoS matches all of them.
ANYBODYS = ('wind', '/clock', '/diagnostics')


class Topic(NamedTuple):
    """A topic's name, message class, and the QoS usually offered on it."""

    name: str
    kind: type
    offered: QoSProfile

    @property
    def type_name(self) -> str:
        """Name of the type, as in 'std_msgs/msg/String'."""
        package, *_, name = self.kind.__module__.split('.')[0], self.kind.__name__
        return f'{package}/msg/{name}'

    def requested(self) -> QoSProfile:
        """Give the QoS of a subscription that gets every message."""
        asked = QoSProfile(depth=DEEP, durability=self.offered.durability)
        if self.name in ANYBODYS:
            asked.reliability = ReliabilityPolicy.BEST_EFFORT
            asked.durability = DurabilityPolicy.VOLATILE
        return asked


OF_SIM = (
    Topic('shot', Twist, STREAM),
    Topic('wind', Vector3Stamped, LATCHED),
    Topic('collisions', String, EVENTS),
    Topic('shot/result', String, EVENTS),
    Topic('journal', String, EVENTS),
    Topic('course/markers', MarkerArray, LATCHED),
    Topic('play/markers', MarkerArray, STREAM),
    Topic('/diagnostics', DiagnosticArray, STREAM),
    Topic('/clock', Clock, STREAM),
)
OF_BALL = (
    Topic('shot', Twist, STREAM),
    Topic('place', PointStamped, STREAM),
    Topic('pose', PoseStamped, STREAM),
    Topic('twist', TwistStamped, STREAM),
    Topic('contact', PointStamped, POINTS),
)


def of_ball(name: str) -> tuple[Topic, ...]:
    """Topics of the ball `name`."""
    return tuple(topic._replace(name=f'{name}/{topic.name}') for topic in OF_BALL)
