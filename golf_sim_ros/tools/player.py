# SPDX-License-Identifier: Apache-2.0
"""A ROS node that hits one shot and hears how it ends."""
import json
from math import atan2, hypot
import os
import time

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from ..messages import fill

# A result repeats the strike rounded to 1e-4.
ROUNDING = 0.6e-4

# A sim rejects a shot in its next step, unless it is paused.
AT_ONCE = 1.0   # s

# Volatile, so that no earlier shot's result is taken for ours.
RESULT_QOS = QoSProfile(depth=100)
MARKERS_QOS = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class NoShot(RuntimeError):
    """There is no result, and the message says why."""


class Player(Node):
    """
    A node beside a sim.

    Parameters
    ----------
    ball : str or None
        The ball to strike, or None for the ball in play.
    namespace : str or None
    timeout : float
        For how long a sim may be silent before it is taken to be absent [s].
    """

    def __init__(self, ball=None, namespace=None, timeout=5.0):
        super().__init__(f'shoot_{os.getpid()}', namespace=namespace, start_parameter_services=False,
                         enable_rosout=False)
        self.ball = ball
        self.timeout = timeout
        self.results, self.position, self.markers = [], None, None
        self.struck_at, self.first_position = time.monotonic(), None
        self._shots = self.create_publisher(Twist, f'{ball}/shot' if ball else 'shot', 10)
        self._results = self.create_subscription(String, 'shot/result', self._take_result, RESULT_QOS)
        self._poses = self.create_subscription(PoseStamped, f'{ball or "ball"}/pose', self._take_pose, 10)
        # Last: subscriptions are announced in order, so the sim that sends us its course has already
        # found the one for results.
        self.create_subscription(MarkerArray, 'course/markers', self._take_markers, MARKERS_QOS)

    @property
    def shot_topic(self):
        """Name of the topic to which the shot goes, with namespace and remappings."""
        return self._shots.topic_name

    def find_sim(self):
        """
        Wait until a sim would hear a shot and its result would be heard.

        Raises
        ------
        NoShot
            If there is none.
        """
        if not self._wait(self._shots.get_subscription_count, self.timeout):
            raise NoShot(f'no sim answers on {self.shot_topic} within {self.timeout:g} s')
        if not self._wait(lambda: self.markers is not None, self.timeout):
            raise NoShot(f'a sim listens on {self.shot_topic}, but shows no course within {self.timeout:g} s')

    def way_to_hole(self):
        """
        Return direction and distance from the ball to the hole.

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
        holes = [marker.pose.position for marker in self.markers if (marker.ns, marker.id) == ('hole', 0)]
        if not holes:
            raise NoShot('this course has no hole to aim at')
        if not self._wait(lambda: self.position is not None, self.timeout):
            raise NoShot(f'no ball on {self._poses.topic_name}; name the one to strike with --ball')
        x, y = holes[0].x - self.position.x, holes[0].y - self.position.y
        return atan2(y, x), hypot(x, y)

    def strike(self, velocity, spin):
        """
        Strike the ball and wait until the shot has ended.

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
        self.results.clear()
        self.struck_at, self.first_position = time.monotonic(), None
        self._shots.publish(twist(velocity, spin))
        while not self._wait(lambda: self._own_result(velocity, spin), 1.0):
            if not self._results.get_publisher_count():
                raise NoShot('the sim went away before the shot ended')
        result = self._own_result(velocity, spin)
        if result['status'] in ('rejected', 'aborted', 'failed'):
            raise NoShot(': '.join(filter(None, (result['status'], result['reason']))))
        return result

    def _own_result(self, velocity, spin):
        return next((result for result in self.results if self._is_own(result, velocity, spin)), None)

    def _is_own(self, result, velocity, spin):
        if self.ball and result['ball'] != self.ball:
            return False
        told, struck = [*result['velocity'], *result['spin']], [*velocity, *spin]
        return all(a is not None and abs(a - b) <= ROUNDING for a, b in zip(told, struck))

    def _wait(self, condition, seconds):
        """Return whether `condition()` became true within so many seconds."""
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline:
                return False
            rclpy.spin_once(self, timeout_sec=0.05)
        return True

    def _take_result(self, message):
        result = json.loads(message.data)
        if not (result['status'] == 'rejected' and self._is_under_way()):
            self.results.append(result)

    def _is_under_way(self):
        """Return whether our shot is played, so that a rejection is that of another just like it."""
        late = time.monotonic() > self.struck_at + AT_ONCE
        return late and self.position != self.first_position

    def _take_pose(self, message):
        self.position = message.pose.position
        self.first_position = self.first_position or self.position

    def _take_markers(self, message):
        self.markers = message.markers


def twist(velocity, spin):
    """Return the message that strikes a ball with this velocity and spin."""
    message = Twist()
    fill(message.linear, velocity)
    fill(message.angular, spin)
    return message
