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

"""Values of parameters as people type them, in the type of the default; names that are mistyped.

`rate:=250` is an integer to ROS, `balls:=a` a string and `frame_id:=1` no string. They are
converted before they are declared, so that types and ranges stay what `ros2 param describe` says.
"""

from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
import re
import sys
from typing import Any

from rclpy.exceptions import ParameterNotDeclaredException
from rclpy.node import Node
from rclpy.parameter import Parameter

from .command_line import only_for_all_nodes

SWITCH = {
    'true': True,
    'yes': True,
    'on': True,
    '1': True,
    'false': False,
    'no': False,
    'off': False,
    '0': False,
}
KIND = {
    float: 'a number, as in 2.5',
    int: 'a whole number of 64 bits at most',
    bool: 'true or false',
    str: 'text; what YAML reads as something else is quoted, as in \'"on"\'',
    tuple: (
        'names, as in a or [a, b]; what YAML reads as something else is quoted, as in \'["on"]\''
    ),
}


def number(value: Any) -> float:
    """`value` as a float; ValueError where it is none."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError
    return float(value)


def whole(value: Any) -> int:
    """`value` as an int; ValueError where it is none, has a fraction, or is too long for ROS."""
    if not isinstance(value, (int, str)) and not number(value).is_integer():
        raise ValueError
    made = int(value)
    if isinstance(value, bool) or abs(made) >= 2**63:
        raise ValueError
    return made


def switch(value: Any) -> bool:
    """`value` as a bool; ValueError where it is none."""
    if str(value).lower() not in SWITCH:
        raise ValueError
    return SWITCH[str(value).lower()]


def text(value: Any) -> str:
    """`value` as a str; ValueError where YAML may have read something else than was typed."""
    if isinstance(value, bool) or not isinstance(value, (int, str)):
        raise ValueError
    return str(value)


def names(value: Any) -> list[str] | None:
    """`value` as a list of str, or None.

    It is a list, or one name, or several with commas or spaces between.
    """
    if value is None or value == '':  # ROS has no type for []
        return None
    if isinstance(value, str):
        return [name for name in re.split(r'[,\s]+', value) if name]
    return [text(name) for name in value] if hasattr(value, '__iter__') else [text(value)]


AS: dict[type, Callable[[Any], Any]] = {
    float: number,
    int: whole,
    bool: switch,
    str: text,
    tuple: names,
}


def fitted(parameter: Parameter, default: Any) -> Parameter:
    """`Parameter` of the type of `default` that means the same as `parameter`.

    Raises
    ------
    ValueError
        There is none; the message names the parameter, its value and what it can be.
    """
    try:
        return Parameter(parameter.name, value=AS[type(default)](parameter.value))
    except ValueError:
        given = 'without a value' if parameter.value is None else repr(parameter.value)
        raise ValueError(
            f'{parameter.name} must be {KIND[type(default)]}; it is {given}'
        ) from None


def fit(node: Node, defaults: Mapping[str, Any]) -> None:
    """Convert what was given to `node` for the parameters `defaults` to their types.

    Now, and while it runs. To be called before they are declared. Raises ValueError as `fitted`
    does; while the node runs, what does not fit is left to rclpy, which refuses it.
    """
    overrides = node._parameter_overrides  # rclpy offers them nowhere before they are declared
    for name in defaults.keys() & overrides.keys():
        overrides[name] = fitted(overrides[name], defaults[name])
    if hasattr(node, 'add_pre_set_parameters_callback'):  # without it rclpy refuses an integer
        node.add_pre_set_parameters_callback(
            lambda changes: [live(node, each, defaults) for each in changes]
        )


def live(node: Node, parameter: Parameter, defaults: Mapping[str, Any]) -> Parameter:
    """`parameter`, fitted where it can be; an `Unknown` one is refused."""
    if not node.has_parameter(parameter.name):
        raise Unknown(parameter.name, known(defaults))
    if parameter.value is None or parameter.name not in defaults:
        return parameter
    try:
        return fitted(parameter, defaults[parameter.name])
    except ValueError:
        return parameter


class Unknown(ParameterNotDeclaredException):
    """Answer of `ros2 param set` to a name that is not known, which has the name.

    In the line of rclpy itself it is missing.
    """

    def __init__(self, name: str, names: Sequence[str]) -> None:
        Exception.__init__(self, unknown(name, names))


def unknown(name: str, names: Sequence[str]) -> str:
    """Write one line about a parameter that is none of `names`."""
    (nearest,) = get_close_matches(name, names, n=1, cutoff=0.0)
    return f'parameter {name!r} is unknown and does nothing; nearest known: {nearest}'


def known(defaults: Mapping[str, Any]) -> list[str]:
    """Names of the parameters that a user may set."""
    return [*defaults, 'use_sim_time']


def warn_of_unknown(
    node: Node, defaults: Mapping[str, Any], words: Sequence[str] | None = None
) -> None:
    """Warn once of each parameter given to `node` that it has not declared.

    What a params file says to all nodes (`/**`) may well be for another one: of that there is no
    warning. `words` are the arguments of the process, `sys.argv[1:]` if not given.
    """
    shared = only_for_all_nodes(sys.argv[1:] if words is None else words, node.get_name())
    for name in node._parameter_overrides:
        if not node.has_parameter(name) and name not in shared:
            node.get_logger().warning(unknown(name, known(defaults)))
