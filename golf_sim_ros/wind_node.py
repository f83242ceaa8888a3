# SPDX-License-Identifier: Apache-2.0
"""The wind generator: a new gust every ten seconds, published on `wind`."""
import sys

import numpy as np
from geometry_msgs.msg import Vector3Stamped
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from .older_rclpy import after_set
from .spinning import run
from .wind.gusts import Gusts, GustSettings

# Who subscribes late gets the last wind at once; only the newest one counts.
WIND_QOS = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)

# For each of the gust settings: least value, greatest value, description.
GUST_PARAMETERS = {
    'speed': (0.0, 60.0, 'mean speed of the gusts, 10 m above the ground [m/s]'),
    'speed_spread': (0.0, 40.0, 'speeds are uniform in speed +- this, never below 0 [m/s]'),
    'direction': (-6.2832, 6.2832, 'mean direction in which the air goes, from x towards y [rad]'),
    'direction_spread': (0.0, 6.2832, 'directions are uniform in direction +- this [rad]'),
    'interval': (0.1, 86400.0, 'time from one gust to the next [s of ROS time]'),
    'ramp': (0.0, 3600.0, 'time over which a gust is eased in, at most interval [s]'),
    'turbulence': (0.0, 1.0, 'standard deviation of the turbulence over the speed of the gust; 0: none'),
}


class WindNode(Node):
    """
    The node `wind_generator`.

    Parameters
    ----------
    context : rclpy.context.Context, optional
    namespace : str, optional
    parameter_overrides : list of rclpy.parameter.Parameter, optional
    """

    def __init__(self, *, context=None, namespace=None, parameter_overrides=None):
        super().__init__('wind_generator', context=context, namespace=namespace,
                         parameter_overrides=parameter_overrides)
        self._declare_gust_parameters()
        publish_rate = self._declare_publish_rate()
        self._declare_frame_id()
        self._gusts = Gusts(self._settings(), self._seed(self._declare_seed()))
        self._started_at = self.get_clock().now()
        self._publisher = self.create_publisher(Vector3Stamped, 'wind', WIND_QOS)
        after_set(self, self._take_over)
        self._timer = self.create_timer(1.0 / publish_rate, self._publish)

    def _declare_gust_parameters(self):
        defaults = GustSettings()
        for name, (least, greatest, description) in GUST_PARAMETERS.items():
            self.declare_parameter(name, getattr(defaults, name), ParameterDescriptor(
                description=description,
                floating_point_range=[FloatingPointRange(from_value=least, to_value=greatest)]))

    def _declare_publish_rate(self):
        return self.declare_parameter('publish_rate', 10.0, ParameterDescriptor(
            description='messages a second of ROS time', read_only=True,
            floating_point_range=[FloatingPointRange(from_value=0.1, to_value=1000.0)])).value

    def _declare_frame_id(self):
        self.declare_parameter('frame_id', 'course', ParameterDescriptor(
            description='frame in which the wind is given'))

    def _declare_seed(self):
        return self.declare_parameter('seed', -1, ParameterDescriptor(
            description='the same seed gives the same gusts; -1: fresh each start, and logged',
            read_only=True, integer_range=[IntegerRange(from_value=-1, to_value=2**63 - 1)])).value

    def _seed(self, wanted):
        """Return the seed that is `wanted`, or a fresh one for -1; log it."""
        seed = int(np.random.SeedSequence().generate_state(1)[0]) if wanted == -1 else wanted
        self.get_logger().info(f'seed {seed}: the same gusts come again with -p seed:={seed}')
        return seed

    def _settings(self):
        return GustSettings(**{name: self.get_parameter(name).value for name in GUST_PARAMETERS})

    def _time(self, now):
        """
        Return the time of the gusts [s]: simulated time itself, or wall time since the start.

        So equal seeds blow equal winds whenever nodes join a simulation, and one that starts again
        meets the same gusts again.
        """
        since = 0 if self.get_clock().ros_time_is_active else self._started_at.nanoseconds
        return (now.nanoseconds - since) / 1e9

    def _take_over(self, parameters):
        if any(parameter.name in GUST_PARAMETERS for parameter in parameters):
            self._gusts.change(self._settings(), self._time(self.get_clock().now()))

    def _publish(self):
        now = self.get_clock().now()
        message = Vector3Stamped()
        message.header.stamp = now.to_msg()
        message.header.frame_id = self.get_parameter('frame_id').value
        vector = message.vector
        vector.x, vector.y, vector.z = self._gusts.wind(self._time(now))
        self._publisher.publish(message)


def main(args=None):
    """Run the wind generator until it is told to stop."""
    return run(WindNode, args)


if __name__ == '__main__':
    sys.exit(main())
