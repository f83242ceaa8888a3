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

"""The launch file, where ROS's own launch is installed; test/nodes/test_launched.py starts it."""

import ast
import os
from pathlib import Path

from golf_sim_ros.physics import ACCURACY
import pytest

ROOT = Path(__file__).resolve().parents[1]
pytest.importorskip('launch_ros.actions', reason="ROS's launch is not installed")
WANTED = {
    'params_file',
    'balls',
    'effects',
    'rate',
    'publish_rate',
    'real_time_factor',
    'accuracy',
    'engine',
    'publish_clock',
    'wind_params_file',
    'wind_params',
    'log_level',
    'namespace',
    'course',
    'wind',
    'rviz',
}


def description():
    """Load what the launch file describes."""
    from launch.launch_description_sources import get_launch_description_from_python_launch_file

    return get_launch_description_from_python_launch_file(str(ROOT / 'launch' / 'golf.launch.py'))


def arguments():
    """Arguments of the launch file by name."""
    return {argument.name: argument for argument in description().get_launch_arguments()}


def test_every_argument_is_described_and_may_be_left_out():
    assert set(arguments()) == WANTED
    for argument in arguments().values():
        assert argument.description
        assert argument.default_value is not None


def test_the_accuracies_on_offer_are_those_of_the_physics():
    for accuracy in ACCURACY:
        assert accuracy in arguments()['accuracy'].description


def test_every_node_is_installed_where_launch_looks():
    tree = ast.parse((ROOT / 'launch' / 'golf.launch.py').read_text(encoding='utf-8'))
    nodes = [
        {
            word.arg: word.value.value
            for word in call.keywords
            if isinstance(word.value, ast.Constant)
        }
        for call in ast.walk(tree)
        if isinstance(call, ast.Call) and ast.unparse(call.func) == 'Node'
    ]
    ours = [node['executable'] for node in nodes if node['package'] == 'golf_sim_ros']
    assert sorted(ours) == ['sim_node', 'wind_node']
    for executable in ours:
        assert os.access(ROOT / 'scripts' / executable, os.X_OK)
