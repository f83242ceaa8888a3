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

"""Names that users have in scripts, launch files and courses stay, wherever the code moves."""

import ast
from importlib import import_module
from pathlib import Path

from golf_sim_ros.physics import ACCURACY, EFFECTS, METHODS
import pytest

ROOT = Path(__file__).resolve().parents[1]
# fmt: off
COMMANDS = {
    'sim_node', 'wind_node', 'shoot', 'record_play', 'resimulate', 'plot_play', 'accuracy_study',
    'compare_shots', 'view_play', 'play_hole',
    'compile_physics', 'wind_field',
}
SIM_PARAMETERS = {
    'course', 'rate', 'publish_rate', 'real_time_factor', 'accuracy', 'effects', 'balls',
    'frame_id', 'publish_tf', 'parent_frame', 'publish_clock', 'engine',
    'turbulence', 'turbulence_seed',
}
WIND_PARAMETERS = {
    'speed', 'speed_spread', 'direction', 'direction_spread', 'interval', 'ramp', 'turbulence',
    'seed', 'publish_rate', 'frame_id',
}
NAMES_OF_EFFECTS = {
    'ball_ball', 'bearman_harvey_1976', 'drag', 'ferguson_drag', 'ferguson_lift', 'foliage',
    'gravity', 'linear_drag', 'magnus', 'naruo_2004', 'penner_2002', 'smits_smith_1994',
    'spin_decay', 'turbulence', 'turf', 'water', 'wind', 'wind_field',
}
TOPICS = {
    'shot', 'place', 'wind', 'pose', 'twist', 'contact', 'collisions', 'shot/result', 'journal',
    'course/markers', 'play/markers', 'heartbeat', '/diagnostics', '/clock',
}
IMPORTS = {
    'golf_sim_ros.course': ('load_course', 'load_round', 'shipped_courses', 'CourseError'),
    'golf_sim_ros.bag': ('read_bag', 'BagError'),
    'golf_sim_ros.wind': ('Gusts', 'GustSettings', 'WindField', 'FieldError', 'solve'),
    'golf_sim_ros.physics': (
        'Air', 'Ball', 'BallState', 'Collision', 'Course', 'Cylinder', 'EFFECTS', 'ENGINES',
        'EngineUnavailable', 'Heightmap', 'LogProfile', 'Material', 'Mesh', 'NoPlace', 'PENNER',
        'Patch', 'Phase', 'Plane', 'Play', 'PowerProfile', 'Preset', 'Rejected', 'Restitution',
        'Result', 'Shot', 'Sphere', 'UniformProfile', 'Water', 'World', 'Zone', 'check_hole',
        'check_tee', 'cycles_now', 'ground_height', 'register_effect',
        'rolling_resistance_of_stimp', 'simulate', 'simulate_many', 'standard_atmosphere',
    ),
}
# fmt: on


def test_commands_are_called_as_before():
    assert COMMANDS <= {path.name for path in (ROOT / 'scripts').iterdir()}
    assert all(
        f"'{name}': " in (ROOT / 'setup.py').read_text(encoding='utf-8') for name in COMMANDS
    )


def test_effects_integrators_and_presets_are_called_as_before():
    assert NAMES_OF_EFFECTS <= set(EFFECTS)
    assert {'dormand_prince', 'rk4', 'euler'} <= set(METHODS)
    assert {'sketch', 'standard', 'reference'} <= set(ACCURACY)


@pytest.mark.parametrize('module', IMPORTS)
def test_what_is_public_is_imported_as_before(module):
    if module == 'golf_sim_ros.bag':
        pytest.importorskip('rosbags')
    found = import_module(module)
    assert [name for name in IMPORTS[module] if not hasattr(found, name)] == []


def test_pictures_are_imported_as_before():
    pytest.importorskip('matplotlib')
    drawing = import_module('golf_sim_ros.drawing')
    assert all(
        callable(getattr(drawing, name))
        for name in ('draw', 'drawn', 'picture', 'recorded', 'DrawnShot')
    )


def test_nodes_and_their_parameters_are_called_as_before():
    pytest.importorskip('rclpy')
    assert import_module('golf_sim_ros.sim_node').SimNode.__name__ == 'SimNode'
    assert SIM_PARAMETERS <= set(import_module('golf_sim_ros.nodes.parameters').Parameters._fields)
    assert WIND_PARAMETERS <= set(import_module('golf_sim_ros.nodes.wind_node').DEFAULTS)


def test_topics_are_called_as_before():
    texts = [
        node.value
        for path in (ROOT / 'golf_sim_ros' / 'nodes').glob('*.py')
        for node in ast.walk(ast.parse(path.read_text(encoding='utf-8')))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    ]
    assert [
        topic
        for topic in TOPICS
        if not any(f'/{text}'.endswith(f'/{topic.lstrip("/")}') for text in texts)
    ] == []
