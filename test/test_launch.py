# SPDX-License-Identifier: Apache-2.0
"""The launch file, where ROS's own launch is installed."""

import os
from pathlib import Path

import pytest

from golf_sim_ros.physics import ACCURACY

ROOT = Path(__file__).resolve().parents[1]
pytest.importorskip('launch_ros.actions', reason="ROS's launch is not installed")


def description():
    """What the launch file describes."""
    from launch.launch_description_sources import get_launch_description_from_python_launch_file
    return get_launch_description_from_python_launch_file(str(ROOT / 'launch' / 'golf.launch.py'))


def arguments():
    """Arguments of the launch file by name."""
    return {argument.name: argument for argument in description().get_launch_arguments()}


def test_every_argument_is_described_and_may_be_left_out():
    for argument in arguments().values():
        assert argument.description
        assert argument.default_value is not None


def test_the_accuracies_on_offer_are_those_of_the_physics():
    assert arguments()['accuracy'].choices == list(ACCURACY)


def test_every_node_is_installed_where_launch_looks():
    from launch_ros.actions import Node
    nodes = [entity for entity in description().entities if isinstance(entity, Node)]
    ours = [node.node_executable for node in nodes if node.node_package == 'golf_sim_ros']
    assert ours
    for executable in ours:
        assert os.access(ROOT / 'scripts' / executable, os.X_OK)
