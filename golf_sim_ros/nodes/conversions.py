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

from geometry_msgs.msg import PointStamped, PoseStamped, Twist, TwistStamped
from rclpy.time import Time
from std_msgs.msg import Header


def header(frame, start, time):
    """Header in `frame` for simulated `time` [s] of a node that started at `start` [ns of ROS time]."""
    stamp = Time(nanoseconds=start + round(time * 1e9)).to_msg()
    return Header(stamp=stamp, frame_id=frame)


def triple(vector):
    """Three floats of a Vector3 or Point."""
    return vector.x, vector.y, vector.z


def fill(message, vector):
    """`message`, a Vector3 or Point, with `vector` written into it."""
    message.x, message.y, message.z = (float(number) for number in vector)
    return message


def pose(head, ball, orientation):
    """PoseStamped of `ball`, turned by the quaternion `orientation` (x, y, z, w)."""
    message = PoseStamped(header=head)
    fill(message.pose.position, ball.position)
    turn = message.pose.orientation
    turn.x, turn.y, turn.z, turn.w = orientation
    return message


def twist(head, ball):
    """TwistStamped of velocity and spin of `ball`."""
    message = TwistStamped(header=head)
    fill(message.twist.linear, ball.velocity)
    fill(message.twist.angular, ball.spin)
    return message


def strike(velocity, spin):
    """Twist that strikes a ball with this velocity and spin."""
    message = Twist()
    fill(message.linear, velocity)
    fill(message.angular, spin)
    return message


def contact(head, collision):
    """PointStamped where `collision` happened."""
    message = PointStamped(header=head)
    fill(message.point, collision.position)
    return message
