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

"""The wind generator: publishes gusts, a new one every ten seconds, on `wind`."""

from collections.abc import Sequence
import sys
from typing import Any, Optional

from geometry_msgs.msg import Vector3Stamped
import numpy as np
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.time import Time

from .command_line import Program
from .lifecycle import run
from .older_rclpy import after_set
from .parameter_values import fit, warn_of_unknown
from ..wind.gusts import Gusts, GustSettings

# A late subscription gets the last wind at once; only the newest one counts.
WIND_QOS = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)

DEFAULTS = {**GustSettings()._asdict(), 'seed': -1, 'publish_rate': 10.0, 'frame_id': 'course'}
MEANING = {
    'speed': 'mean speed of the gusts, 10 m above the ground [m/s]',
    'speed_spread': 'speeds are uniform in speed +- this, never below 0 [m/s]',
    'direction': 'mean direction in which the air goes, from x towards y [rad]',
    'direction_spread': 'directions are uniform in direction +- this [rad]',
    'interval': 'time from one gust to the next [s of ROS time]',
    'ramp': 'time over which a gust is eased in, at most interval [s]',
    'turbulence': 'standard deviation of the turbulence over the speed of the gust; 0: none',
    'seed': 'the same seed gives the same gusts; -1: fresh each start, and logged',
    'publish_rate': 'messages a second of ROS time',
    'frame_id': 'frame in which the wind is given',
}
RANGES = {
    'speed': (0.0, 60.0),
    'speed_spread': (0.0, 40.0),
    'direction': (-6.2832, 6.2832),
    'direction_spread': (0.0, 6.2832),
    'interval': (0.1, 86400.0),
    'ramp': (0.0, 3600.0),
    'turbulence': (0.0, 1.0),
    'seed': (-1, 2**63 - 1),
    'publish_rate': (0.1, 1000.0),
}
READ_ONLY = ('seed', 'publish_rate')
PROGRAM = Program(
    'wind_node',
    'Generates wind and publishes it on `wind`: a new gust every `interval`, eased in.',
    {
        **{name: (default, MEANING[name]) for name, default in DEFAULTS.items()},
        'use_sim_time': (False, 'whether to follow /clock'),
    },
    'speed:=8',
)


class WindNode(Node):
    """The node `wind_generator`.

    Parameters
    ----------
    context : rclpy.context.Context, optional
    namespace : str, optional
    parameter_overrides : list of rclpy.parameter.Parameter, optional
    """

    def __init__(
        self,
        *,
        context: Optional[Context] = None,
        namespace: str | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            'wind_generator',
            context=context,
            namespace=namespace,
            parameter_overrides=parameter_overrides,
        )
        fit(self, DEFAULTS)
        given = {name: self._declare(name) for name in DEFAULTS}
        warn_of_unknown(self, DEFAULTS)
        self._gusts = Gusts(self._settings(), self._seed(given['seed']))
        self._started_at = self.get_clock().now()
        self._publisher = self.create_publisher(Vector3Stamped, 'wind', WIND_QOS)
        after_set(self, self._take_over)
        self._timer = self.create_timer(1.0 / given['publish_rate'], self._publish)

    def _declare(self, name: str) -> Any:
        """Declare the parameter `name` with its range and description, and give its value."""
        default, (least, greatest) = DEFAULTS[name], RANGES.get(name, (None, None))
        descriptor = ParameterDescriptor(description=MEANING[name], read_only=name in READ_ONLY)
        if isinstance(default, float):
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=least, to_value=greatest)
            ]
        elif isinstance(default, int):
            descriptor.integer_range = [IntegerRange(from_value=least, to_value=greatest)]
        return self.declare_parameter(name, default, descriptor).value

    def _seed(self, wanted: int) -> int:
        """Seed that is `wanted`, or a fresh one for -1; logged."""
        seed = int(np.random.SeedSequence().generate_state(1)[0]) if wanted == -1 else wanted
        self.get_logger().info(f'seed {seed}: the same gusts come again with -p seed:={seed}')
        return seed

    def _settings(self) -> GustSettings:
        return GustSettings(
            **{name: self.get_parameter(name).value for name in GustSettings._fields}
        )

    def _time(self, now: Time) -> float:
        """Time of the gusts [s]: simulated time itself, or wall time since the start.

        So equal seeds blow equal winds whenever nodes join a simulation, and one that starts again
        meets the same gusts again.
        """
        since = 0 if self.get_clock().ros_time_is_active else self._started_at.nanoseconds
        return (now.nanoseconds - since) / 1e9

    def _take_over(self, parameters: Sequence[Parameter]) -> None:
        if any(parameter.name in GustSettings._fields for parameter in parameters):
            self._gusts.change(self._settings(), self._time(self.get_clock().now()))

    def _publish(self) -> None:
        now = self.get_clock().now()
        message = Vector3Stamped()
        message.header.stamp = now.to_msg()
        message.header.frame_id = self.get_parameter('frame_id').value
        vector = message.vector
        vector.x, vector.y, vector.z = self._gusts.wind(self._time(now))
        self._publisher.publish(message)


def main(args: list[str] | None = None) -> int:
    """Run the wind generator until a signal ends it; return the exit code."""
    return run(WindNode, PROGRAM, args)


if __name__ == '__main__':
    sys.exit(main())
