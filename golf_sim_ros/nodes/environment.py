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

"""The environment variables without which rclpy does not start, or finds no packages."""

from collections.abc import Mapping, MutableMapping
import os
from pathlib import Path
import sys
import tempfile


def complete_environment(environment: MutableMapping[str, str] = os.environ) -> None:
    """Add the variables that are missing in `environment`; what the user or ROS has set stays.

    rclpy raises where it can write no log: without HOME (a bare container, a service), or with a
    HOME that belongs to somebody else. The wheels of ROS 2 come without a setup.bash that sets
    AMENT_PREFIX_PATH.

    Parameters
    ----------
    environment : mutable mapping, optional
        Changed in place; this process's own if not given.
    """
    if not {'ROS_LOG_DIR', 'ROS_HOME'} & environment.keys() and not _can_log_at_home(environment):
        environment['ROS_LOG_DIR'] = str(
            Path(tempfile.gettempdir()) / f'golf_sim_ros_log_{os.getuid()}'
        )
    if (
        not environment.get('AMENT_PREFIX_PATH')
        and (Path(sys.prefix) / 'share' / 'ament_index').is_dir()
    ):
        environment['AMENT_PREFIX_PATH'] = sys.prefix


def unsafe(environment: Mapping[str, str] = os.environ) -> str:
    """Say what is missing of the security that `environment` asks for, or ''.

    rclpy itself says no more than that it cannot be initialized.
    """
    asked = [environment.get(f'ROS_SECURITY_{name}') for name in ('ENABLE', 'STRATEGY')]
    if asked != ['true', 'Enforce']:
        return ''
    keystore = environment.get('ROS_SECURITY_KEYSTORE', '')
    if keystore and Path(keystore, 'enclaves').is_dir():
        return ''
    return (
        f'ROS_SECURITY_ENABLE is true, but ROS_SECURITY_KEYSTORE {keystore!r} is no keystore: '
        'make one with ros2 security create_keystore, or unset ROS_SECURITY_ENABLE'
    )


def _can_log_at_home(environment: Mapping[str, str]) -> bool:
    """Whether rclpy can write its log where it does by default; makes the folder if need be."""
    if not environment.get('HOME'):
        return False
    folder = Path(environment['HOME'], '.ros', 'log')
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
