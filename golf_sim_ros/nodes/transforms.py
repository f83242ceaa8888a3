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

"""Transforms (TF) of the course, its tee and hole, and the balls, where `tf2_msgs` is installed.

Frames are named after `frame_id`, so that several sims on one graph need several of them::

    parent_frame -> frame_id -> frame_id/tee, frame_id/hole, frame_id/BALL
"""

from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from typing import Any

from geometry_msgs.msg import TransformStamped
import numpy as np
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Header

from .conversions import fill
from ..physics import Course, ground_height

IS_HERE = find_spec('tf2_msgs') is not None  # the wheels of ROS 2 have none
MISSING = 'publish_tf needs tf2_msgs: install it (apt: ros-DISTRO-tf2-msgs), or leave it false'
STREAM = QoSProfile(depth=100)
LASTING = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
UPRIGHT = (0.0, 0.0, 0.0, 1.0)

Vector = Sequence[float] | np.ndarray


class Transforms:
    """Publishes on /tf and /tf_static.

    Parameters
    ----------
    node : rclpy.node.Node
    course : Course
    parent, frame : str
        The frame around the course's, which is `frame`.
    head : std_msgs.msg.Header
        Has the stamp of what does not move.
    """

    def __init__(self, node: Node, course: Course, parent: str, frame: str, head: Header) -> None:
        from tf2_msgs.msg import TFMessage

        self.message, self.frame = TFMessage, frame
        self.moving = node.create_publisher(TFMessage, '/tf', STREAM)
        self.static = node.create_publisher(TFMessage, '/tf_static', LASTING)
        self.static.publish(TFMessage(transforms=of_course(course, parent, frame, head)))

    def balls(self, head: Header, balls: dict[str, Any], turns: Mapping[str, Vector]) -> None:
        """Publish where balls are, by name, and how they are turned."""
        self.moving.publish(self.message(transforms=of_balls(self.frame, head, balls, turns)))


def of_course(course: Course, parent: str, frame: str, head: Header) -> list[TransformStamped]:
    """Make the transforms of the course's frame, the tee and the hole."""
    places = {'tee': course.tee, **({'hole': course.hole} if course.hole else {})}
    found = {name: (place, ground_height(course, *place)) for name, place in places.items()}
    return [
        transform(head, parent, frame, (0.0, 0.0, 0.0), UPRIGHT),
        *(
            transform(head, frame, f'{frame}/{name}', (*place, ground[0]), UPRIGHT)
            for name, (place, ground) in found.items()
            if ground is not None
        ),
    ]


def of_balls(
    frame: str, head: Header, balls: dict[str, Any], turns: Mapping[str, Vector]
) -> list[TransformStamped]:
    """Make the transforms of balls, by name."""
    return [
        transform(head, frame, f'{frame}/{name}', ball.position, turns[name])
        for name, ball in balls.items()
    ]


def transform(
    head: Header, parent: str, child: str, place: Vector, turn: Vector
) -> TransformStamped:
    """Make the transform of a frame at `place`, turned by a quaternion."""
    made = TransformStamped(header=Header(stamp=head.stamp, frame_id=parent))
    made.child_frame_id = child
    fill(made.transform.translation, place)
    rotation = made.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = map(float, turn)
    return made


def objection(given: Any) -> str:
    """Why transforms cannot be published as parameters ask for them; '' where they can."""
    if not IS_HERE:
        return MISSING
    if not given.frame_id:
        return 'frame_id must be a name: transforms lead to it'
    taken = {'tee', 'hole'} & set(given.balls)
    if taken:
        return f'a ball {min(taken)!r} would take the frame that the course has of that name'
    if given.parent_frame in ('', given.frame_id):
        return f'parent_frame {given.parent_frame!r} must be another frame than frame_id'
    return ''
