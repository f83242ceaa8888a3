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

"""Nodes as processes, and clients in this one, over real DDS on a domain of this session's own."""

from contextlib import ExitStack
import os
from pathlib import Path
import socket
import sys

import pytest

try:
    from processes import Client, Golfer, Process
except ImportError:  # no ROS 2 here: nothing in this folder can run
    collect_ignore_glob = ['test_*.py']

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope='session', autouse=True)
def domain(tmp_path_factory):
    """Set a ROS domain id that no other test session on this machine has, for all processes."""
    claim, number = claimed_domain()
    patch = pytest.MonkeyPatch()
    patch.setenv('ROS_DOMAIN_ID', str(number))
    patch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    patch.setenv('ROS_LOG_DIR', str(tmp_path_factory.mktemp('log')))
    patch.setenv('PYTHONPATH', str(ROOT), prepend=os.pathsep)
    for name in ('ROS_STATIC_PEERS', 'ROS_DISCOVERY_SERVER', 'ROS_LOCALHOST_ONLY'):
        patch.delenv(name, raising=False)
    if 'AMENT_PREFIX_PATH' not in os.environ:
        patch.setenv('AMENT_PREFIX_PATH', sys.prefix)
    yield number
    patch.undo()
    claim.close()


def claimed_domain():
    """Find a domain id that is free: a socket and the id, which is ours while the socket is bound.

    The sessions of a machine share its ports.
    """
    for number in range(1, 102):
        claim = socket.socket()
        try:
            claim.bind(('127.0.0.1', 18000 + number))
            return claim, number
        except OSError:
            claim.close()
    raise RuntimeError('every ROS domain of this machine is taken')


@pytest.fixture(scope='module')
def start(domain):
    """Give a function that starts nodes, each stopped when the module ends.

    ``start('sim_node', '--ros-args', ...)`` gives a running `Process`.
    """
    processes = []

    def start(module, *arguments, environment=None):
        processes.append(Process(module, *arguments, environment=environment))
        return processes[-1]

    yield start
    with ExitStack() as stack:  # each is stopped, also where one does not obey
        for process in processes:
            stack.callback(process.stop)


@pytest.fixture
def client(make_client):
    """Make a `Client` in the root namespace."""
    return make_client()


@pytest.fixture
def make_client(domain):
    """Give a function of a namespace that makes a `Client`, closed after the test."""
    clients = []

    def make(namespace=''):
        clients.append(Client(namespace))
        return clients[-1]

    yield make
    for client in clients:
        client.close()


@pytest.fixture
def make_golfer(domain):
    """Give a function of a namespace and a ball that makes a `Golfer`, closed after the test.

    It returns once the sim there answers.
    """
    golfers = []

    def make(namespace='', ball='ball'):
        golfers.append(Golfer(namespace, ball))
        return golfers[-1]

    yield make
    for golfer in golfers:
        golfer.close()
