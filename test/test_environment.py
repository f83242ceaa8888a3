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

"""What rclpy needs to start is there, however bare the machine."""

from pathlib import Path
import sys

from golf_sim_ros.nodes.environment import complete_environment


def completed(**environment):
    """`environment` after it was completed."""
    complete_environment(environment)
    return environment


def test_what_the_user_has_set_stays(tmp_path):
    given = {
        'HOME': str(tmp_path),
        'ROS_LOG_DIR': '/somewhere',
        'AMENT_PREFIX_PATH': '/opt/ros/jazzy',
    }
    assert completed(**given) == given


def test_a_usable_home_is_used(tmp_path):
    assert 'ROS_LOG_DIR' not in completed(HOME=str(tmp_path))


def test_without_a_home_the_log_goes_to_a_temporary_folder():
    assert Path(completed()['ROS_LOG_DIR']).is_absolute()


def test_with_a_home_that_is_no_folder_the_log_goes_to_a_temporary_folder(tmp_path):
    file = tmp_path / 'file'
    file.touch()
    assert Path(completed(HOME=str(file))['ROS_LOG_DIR']).is_absolute()


def test_the_wheels_of_ros_are_found_in_their_own_prefix(monkeypatch, tmp_path):
    (tmp_path / 'share' / 'ament_index').mkdir(parents=True)
    monkeypatch.setattr(sys, 'prefix', str(tmp_path))
    assert completed(HOME=str(tmp_path))['AMENT_PREFIX_PATH'] == str(tmp_path)


def test_a_prefix_without_ros_is_not_passed_off_as_one(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, 'prefix', str(tmp_path))
    assert 'AMENT_PREFIX_PATH' not in completed(HOME=str(tmp_path))
