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

"""The simulator, the wind and, if wanted, RViz.

``ros2 launch golf_sim_ros golf.launch.py rviz:=true`` starts them.

An argument that is left out is not passed to the nodes, so it never overrides a params file.
"""

import atexit
from pathlib import Path
import tempfile
from typing import List

from golf_sim_ros.course import CourseError, load_course
from golf_sim_ros.drawing.rviz_view import rviz_view
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction, Shutdown
from launch.conditions import evaluate_condition_expression, InvalidConditionExpressionError
from launch.substitutions import SubstitutionFailure, TextSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import ExecutableInPackage, FindPackageShare
import yaml

DEFAULT_COURSE = 'golf_without_friends'  # the simulator's
# Arguments that are parameters of the simulator; their defaults are in config/sim.yaml.
TEXTS = {
    'course': 'name of a shipped course, or path of a course file',
    'accuracy': 'sketch, standard or reference: how exactly to simulate',
    'engine': 'auto, python or compiled: what runs the physics',
}
LISTS = {
    'balls': 'names of the balls, as in a or [a, b]',
    'effects': 'effects to simulate, as in auto or [gravity, drag]',
}
NUMBERS = {
    'rate': 'physics ticks a second of simulated time',
    'publish_rate': 'pose and twist messages a second while a ball moves',
    'real_time_factor': 'simulated seconds a wall second; 0: as fast as it can',
}
OTHERS = {
    'publish_clock': ('', 'true: simulated time on /clock, which wind and RViz then follow'),
    'params_file': (
        '',
        'parameters of simulator and wind, a YAML file; the other arguments override it',
    ),
    'wind_params_file': (
        '',
        'parameters of the wind generator, a YAML file; it overrides params_file',
    ),
    'wind_params': ('', 'the former name of wind_params_file'),
    'namespace': ('', 'namespace of all nodes, so that many games share one network'),
    'log_level': (
        '',
        'debug, info, warn, error or fatal, or of one logger, as in golf_sim:=debug',
    ),
    'wind': ('true', 'true or false: whether to start the wind generator'),
    'rviz': ('false', 'true or false: whether to start RViz'),
}
UNLESS_GIVEN = '; if left out, what the params file says, else the default of the simulator'


def generate_launch_description():
    """All nodes of one game."""
    parameters = {**TEXTS, **LISTS, **NUMBERS}
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value='', description=meaning + UNLESS_GIVEN)
                for name, meaning in parameters.items()
            ),
            *(
                DeclareLaunchArgument(name, default_value=default, description=meaning)
                for name, (default, meaning) in OTHERS.items()
            ),
            OpaqueFunction(function=nodes),
        ]
    )


def nodes(context):
    """Nodes that are asked for; raises before any is started where one can't be."""
    names = (*TEXTS, *LISTS, *NUMBERS, *OTHERS)
    given = {name: context.launch_configurations[name].strip() for name in names}
    common = {
        'namespace': given['namespace'],
        'ros_arguments': ['--log-level', given['log_level']] if given['log_level'] else None,
    }
    started = [simulator(given, common)]
    if is_true(context, given, 'wind'):
        started.append(wind(context, given, common))
    if is_true(context, given, 'rviz'):
        started.append(rviz(context, given, common))
    return started


def simulator(given, common):
    """Describe the node `golf_sim`; when it ends, all do."""
    parameters = {}
    for name in (*TEXTS, *LISTS, *NUMBERS, 'publish_clock'):
        if given[name]:
            # a number is read as YAML has it
            kind = str if name in TEXTS else List[str] if name in LISTS else None
            value = (
                listed(name, given[name]) if name in LISTS else TextSubstitution(text=given[name])
            )
            parameters[name] = ParameterValue(value, value_type=kind)
    return Node(
        package='golf_sim_ros',
        executable='sim_node',
        name='golf_sim',
        output='screen',
        parameters=[*params_files(given, 'params_file'), parameters],
        on_exit=Shutdown(reason='the simulator has ended'),
        **common,
    )


def wind(context, given, common):
    """Describe the node `wind_generator`."""
    files = params_files(given, 'params_file', 'wind_params', 'wind_params_file')
    return Node(
        package='golf_sim_ros',
        executable='wind_node',
        name='wind_generator',
        output='screen',
        parameters=[*files, follow_clock(context, given)],
        **common,
    )


def rviz(context, given, common):
    """Describe RViz with its view of the game; RuntimeError where it is not installed."""
    try:
        ExecutableInPackage(package='rviz2', executable='rviz2').perform(context)
    except (LookupError, SubstitutionFailure):  # no package, no program in it
        raise RuntimeError(
            f'rviz:={given["rviz"]} needs the package rviz2: nothing is started'
        ) from None
    view = view_on(FindPackageShare('golf_sim_ros').perform(context), given['course'])
    return Node(
        package='rviz2',
        executable='rviz2',
        arguments=['-d', str(view)],
        parameters=[follow_clock(context, given)],
        **common,
    )


def view_on(share, name):
    """Path of RViz's view, from behind the tee of the course of that name along its hole."""
    view = Path(share, 'rviz', 'golf.rviz')
    try:
        made = rviz_view(view.read_text(encoding='utf-8'), load_course(name or DEFAULT_COURSE))
    except CourseError:  # the simulator will say what is wrong with it
        return view
    file = tempfile.NamedTemporaryFile('w', prefix='golf_', suffix='.rviz', delete=False)
    with file:
        file.write(made)
    atexit.register(Path(file.name).unlink, missing_ok=True)
    return Path(file.name)


def follow_clock(context, given):
    """Parameters of a node that follows simulated time where it is published."""
    return {'use_sim_time': True} if is_true(context, given, 'publish_clock') else {}


def is_true(context, given, name):
    """Whether an argument is true, as launch has it.

    RuntimeError where it is neither that nor false.
    """
    expression = [TextSubstitution(text=given[name])]
    try:
        return given[name] != '' and evaluate_condition_expression(context, expression)
    except InvalidConditionExpressionError:
        raise RuntimeError(
            f'{name}:={given[name]} must be true or false: nothing is started'
        ) from None


def listed(name, text):
    """Names in a list as YAML has it, or with commas or spaces between.

    RuntimeError where it is none.
    """
    if not text.startswith('['):
        return text.replace(',', ' ').split()
    try:
        names = yaml.load(text, Loader=yaml.BaseLoader)  # all are text
    except yaml.YAMLError:
        names = None
    if not names or not all(isinstance(each, str) for each in names):
        raise RuntimeError(f'{name}:={text} must be names, as in a or [a, b]: nothing is started')
    return names


def params_files(given, *names):
    """Paths of the params files that are given; RuntimeError where there is none."""
    paths = {name: Path(given[name]).expanduser() for name in names if given[name]}
    for name, path in paths.items():
        if not path.is_file():
            raise RuntimeError(f'{name}:={path} is no file: nothing is started')
    return [str(path) for path in paths.values()]
