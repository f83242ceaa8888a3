# SPDX-License-Identifier: Apache-2.0
"""The parameters of `sim_node`, declared with description, type, range, and checked."""
from typing import NamedTuple

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult

from .physics import ACCURACY


class Parameters(NamedTuple):
    """Values at the start, with their defaults."""

    course: str = 'golf_without_friends'
    rate: float = 250.0
    publish_rate: float = 50.0
    accuracy: str = 'standard'
    effects: tuple = ('auto',)
    balls: tuple = ('ball',)
    frame_id: str = 'course'


MEANING = {
    'course': 'name of a shipped course, or path of a course file',
    'rate': 'physics ticks a second of simulated time',
    'publish_rate': 'pose and twist messages a second while a ball moves; at most rate',
    'accuracy': f'one of {", ".join(ACCURACY)}; may be changed while running',
    'effects': "effects to simulate, or ['auto']: just those that the scene calls for",
    'balls': 'names of the balls; the first one is in play',
    'frame_id': 'frame of every stamp, and the frame in which inputs are understood',
}
RANGE = {'rate': (10.0, 10000.0), 'publish_rate': (1.0, 1000.0)}
LIVE = ('accuracy',)


def declared(node):
    """`Parameters` of `node` after all were declared; ValueError where they do not fit together."""
    values = {name: declare(node, name, default) for name, default in Parameters()._asdict().items()}
    values = Parameters(**values)
    if values.publish_rate > values.rate:
        raise ValueError(f'publish_rate {values.publish_rate:g} must be at most rate, {values.rate:g}')
    if node.get_parameter('use_sim_time').value:
        raise ValueError('use_sim_time must be false: this node makes simulated time, it does not follow it')
    return values


def declare(node, name, default):
    """Value of parameter `name` of `node`."""
    ranges = [FloatingPointRange(from_value=RANGE[name][0], to_value=RANGE[name][1])] if name in RANGE else []
    descriptor = ParameterDescriptor(
        description=MEANING[name], read_only=name not in LIVE, floating_point_range=ranges)
    value = list(default) if isinstance(default, tuple) else default
    value = node.declare_parameter(name, value, descriptor).value
    return tuple(value) if isinstance(default, tuple) else value


def checked(parameters):
    """Whether `parameters` may be set while the node runs, and why not."""
    for parameter in parameters:
        if parameter.name == 'accuracy' and parameter.value not in ACCURACY:
            reason = f'accuracy {parameter.value!r} is unknown; known: {", ".join(ACCURACY)}'
            return SetParametersResult(successful=False, reason=reason)
        if parameter.name == 'use_sim_time' and parameter.value:
            return SetParametersResult(successful=False, reason='this node makes simulated time')
    return SetParametersResult(successful=True)
