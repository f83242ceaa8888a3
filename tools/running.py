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

"""The simulator and the wind as processes of one program, which ends them."""

from contextlib import contextmanager
import json
from pathlib import Path
import signal
import subprocess
import sys
import time

from geometry_msgs.msg import PoseStamped
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

BIN = Path(sys.executable).parent
NODES = ('sim_node', 'wind_node')
FIRST_START = 60.0  # s: a start on a slow machine
PATIENCE = 15.0  # s: after a signal a node has ended, or hangs
EVENTS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Failed(RuntimeError):
    """Something did not work, and the message says what in one line."""


@contextmanager
def nodes():
    """Start the processes of `NODES`: by name.

    They get SIGINT at the end, and must end with exit code 0; so must those that `start` adds.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    processes = {}
    try:
        for name in NODES:
            start(processes, name)
        yield processes
    finally:
        codes = {name: stopped(process) for name, process in processes.items()}
    for name, code in codes.items():
        if code != 0:
            raise Failed(f'{name} ended with exit code {code}')


def start(processes, name, *arguments):
    """Start one more process, which is stopped after those before it."""
    processes[name] = subprocess.Popen([BIN / name, *arguments])


def stopped(process):
    """Exit code of `process` after a signal to end."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    try:
        return process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        return process.wait()


class Spectator:
    """A client that gets what is published of the play over ROS 2.

    Parameters
    ----------
    processes : dict of str to subprocess.Popen
        The nodes; when one of them ends, there is nothing to wait for.
    """

    def __init__(self, processes):
        self.processes = processes
        self.results, self.poses = [], []
        self.node = rclpy.create_node('spectator')
        self.node.create_subscription(PoseStamped, 'ball/pose', self.poses.append, 10)
        self.node.create_subscription(
            String,
            'shot/result',
            lambda message: self.results.append(json.loads(message.data)),
            EVENTS,
        )

    def wait_for_ball(self):
        """Wait until the ball is seen on the tee."""
        self._wait(lambda: self.poses, FIRST_START, 'the ball to be on the tee')

    def wait_for_recorder(self):
        """Wait until somebody besides the sim listens to strikes, and to the journal."""
        counted = self.node.count_subscribers
        self._wait(
            lambda: counted('ball/shot') > 1 and counted('journal') > 0,
            FIRST_START,
            'the recording to begin',
        )

    def result(self, number):
        """Wait for the result of shot `number`, a dict; numbers start at 1."""
        self._wait(lambda: len(self.results) >= number, PATIENCE, f'the result of shot {number}')
        return self.results[number - 1]

    def _wait(self, condition, seconds, what):
        deadline = time.monotonic() + seconds
        while not condition():
            rclpy.spin_once(self.node, timeout_sec=0.1)
            for name, process in self.processes.items():
                if process.poll() is not None:
                    raise Failed(f'{name} ended with exit code {process.returncode}')
            if time.monotonic() > deadline:
                raise Failed(f'waited for {what} for {seconds:g} s')
