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

"""Conversions between records of the physics and ROS messages."""

from collections.abc import Iterable
from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped, Twist, TwistStamped
import numpy as np
from rclpy.time import Time
from std_msgs.msg import Header

from ..physics import BallState, Collision

Vector = tuple[float, float, float]


def header(frame: str, start: int, time: float) -> Header:
    """Make a header in `frame` for simulated `time` [s].

    `start` is the ROS time [ns] at which the node started.
    """
    stamp = Time(nanoseconds=start + round(time * 1e9)).to_msg()
    return Header(stamp=stamp, frame_id=frame)


def triple(vector: Any) -> Vector:
    """Three floats of a Vector3 or Point."""
    return vector.x, vector.y, vector.z


def fill(message: Any, vector: Iterable[float]) -> Any:
    """Write `vector` into `message`, a Vector3 or Point, and return that."""
    message.x, message.y, message.z = (float(number) for number in vector)
    return message


def pose(head: Header, ball: BallState, orientation: np.ndarray) -> PoseStamped:
    """Make the PoseStamped of `ball`, turned by the quaternion `orientation` (x, y, z, w)."""
    message = PoseStamped(header=head)
    fill(message.pose.position, ball.position)
    turn = message.pose.orientation
    turn.x, turn.y, turn.z, turn.w = orientation
    return message


def twist(head: Header, ball: BallState) -> TwistStamped:
    """Make the TwistStamped of velocity and spin of `ball`."""
    message = TwistStamped(header=head)
    fill(message.twist.linear, ball.velocity)
    fill(message.twist.angular, ball.spin)
    return message


def strike(velocity: Vector, spin: Vector) -> Twist:
    """Make the Twist that strikes a ball with this velocity and spin."""
    message = Twist()
    fill(message.linear, velocity)
    fill(message.angular, spin)
    return message


def contact(head: Header, collision: Collision) -> PointStamped:
    """Make the PointStamped where `collision` happened."""
    message = PointStamped(header=head)
    fill(message.point, collision.position)
    return message
