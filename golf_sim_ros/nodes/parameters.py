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

"""Parameters of `sim_node`: declared with description, type and range, and checked."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

from . import transforms
from .command_line import Program
from .parameter_values import fit, warn_of_unknown
from ..physics import ACCURACY


class Parameters(NamedTuple):
    """Values of the parameters at the start, with their defaults."""

    course: str = 'golf_without_friends'
    rate: float = 250.0
    publish_rate: float = 50.0
    real_time_factor: float = 1.0
    accuracy: str = 'standard'
    effects: tuple[str, ...] = ('auto',)
    balls: tuple[str, ...] = ('ball',)
    frame_id: str = 'course'
    publish_tf: bool = transforms.IS_HERE
    parent_frame: str = 'map'
    publish_clock: bool = False
    engine: str = 'auto'
    turbulence: float = 0.0
    turbulence_seed: int = 0


ENGINES = ('auto', 'python', 'compiled')
MEANING = {
    'course': 'name of a shipped course, or path of a course file',
    'rate': 'physics ticks a second of simulated time',
    'publish_rate': 'pose and twist messages a second while a ball moves; at most rate',
    'real_time_factor': 'simulated seconds a wall second, from 0.1; 0: as fast as it can, and '
    'time stands still while every ball rests; may be changed while running',
    'accuracy': f'one of {", ".join(ACCURACY)}; may be changed while running',
    'effects': "effects to simulate, or ['auto']: just those that the scene calls for",
    'balls': 'names of the balls; the first one is in play',
    'frame_id': 'frame of every stamp, and the frame in which inputs are understood',
    'publish_tf': 'whether to publish transforms of course, tee, hole and balls; needs tf2_msgs',
    'parent_frame': 'frame around that of the course, for publish_tf',
    'publish_clock': 'whether to publish simulated time on /clock, and to stamp with it',
    'engine': 'what runs the physics: python, plain Python; compiled, the compiled engine; auto, '
    'Python until it takes too much of a core',
    'turbulence': 'intensity of the eddies that balls fly through: their standard deviation along '
    'the wind over the wind at 10 m, some 0.1 to 0.2; on a course with a wind field any over 0 '
    'means its own; 0: none',
    'turbulence_seed': 'which eddies; the same seed has the same ones',
}
RANGE = {
    'rate': (10.0, 10000.0),
    'publish_rate': (1.0, 1000.0),
    'real_time_factor': (0.0, 100.0),
    'turbulence': (0.0, 1.0),
}
LIVE = ('accuracy', 'real_time_factor')
SLOWEST = 0.1  # real-time factor
OWN_TIME = 'this node makes simulated time; to follow it itself, it must publish_clock'
FOLLOWED = 'whether to follow /clock; only with publish_clock: this node makes simulated time'
PROGRAM = Program(
    'sim_node',
    'Simulates golf: a Twist on `shot` strikes the ball, and `ball/pose` tells where it is.',
    {
        **{name: (default, MEANING[name]) for name, default in Parameters()._asdict().items()},
        'use_sim_time': (False, FOLLOWED),
    },
    'course:=links',
)


def declared(node: Node) -> Parameters:
    """Declare the `Parameters` of `node`; ValueError where they do not fit together."""
    defaults = Parameters()._asdict()
    fit(node, defaults)
    values = Parameters(
        **{name: declare(node, name, default) for name, default in defaults.items()}
    )
    warn_of_unknown(node, defaults)
    if values.engine not in ENGINES:
        raise ValueError(f'engine {values.engine!r} is unknown; known: {", ".join(ENGINES)}')
    if values.publish_rate > values.rate:
        raise ValueError(
            f'publish_rate {values.publish_rate:g} must be at most rate, {values.rate:g}'
        )
    if node.get_parameter('use_sim_time').value and not values.publish_clock:
        raise ValueError(f'use_sim_time must be false: {OWN_TIME}')
    if 0.0 < values.real_time_factor < SLOWEST:
        raise ValueError(too_slow(values.real_time_factor))
    reason = transforms.objection(values) if values.publish_tf else ''
    if reason:
        raise ValueError(reason)
    return values


def too_slow(factor: float) -> str:
    """Say why a real-time `factor` is refused."""
    return f'real_time_factor {factor:g} must be 0, as fast as it can, or at least {SLOWEST:g}'


def declare(node: Node, name: str, default: Any) -> Any:
    """Declare the parameter `name` of `node`, and give its value."""
    ranges = (
        [FloatingPointRange(from_value=RANGE[name][0], to_value=RANGE[name][1])]
        if name in RANGE
        else []
    )
    descriptor = ParameterDescriptor(
        description=MEANING[name], read_only=name not in LIVE, floating_point_range=ranges
    )
    value = list(default) if isinstance(default, tuple) else default
    value = node.declare_parameter(name, value, descriptor).value
    # ROS has no type for [], only None.
    return tuple(value or ()) if isinstance(default, tuple) else value


def checked(publishes_clock: bool, parameters: Sequence[Parameter]) -> SetParametersResult:
    """Whether `parameters` may be set while the node runs, and why not."""
    for parameter in parameters:
        reason = objection(publishes_clock, parameter.name, parameter.value)
        if reason:
            return SetParametersResult(successful=False, reason=reason)
    return SetParametersResult(successful=True)


def objection(publishes_clock: bool, name: str, value: Any) -> str:
    """Say why the parameter `name` can't become `value`, or ''."""
    if name == 'accuracy' and value not in ACCURACY:
        return f'accuracy {value!r} is unknown; known: {", ".join(ACCURACY)}'
    if name == 'real_time_factor' and 0.0 < value < SLOWEST:
        return too_slow(value)
    if name == 'use_sim_time' and value and not publishes_clock:
        return OWN_TIME
    return ''
