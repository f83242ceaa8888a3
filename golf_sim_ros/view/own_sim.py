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

"""A sim and its wind of one's own: processes that are started for a hole and ended after it."""

from collections.abc import Sequence
import json
import os
import signal
import subprocess
import sys
from time import monotonic, sleep

PATIENCE = 1.2  # s after which a process that was told to end is killed
LOOK = 0.02  # s from one look at ending processes to the next


def keep_to_ourselves() -> None:
    """Meet no other game: this machine only, unless the user has chosen otherwise."""
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')


class OwnSim:
    """Processes of a sim, and of the wind where there is to be any.

    Parameters
    ----------
    namespace : str
    parameters : sequence of str
        Of the sim, as ``NAME:=VALUE``.
    wind : float
        Mean speed [m/s]; 0 for calm.
    """

    def __init__(self, namespace: str, parameters: Sequence[str] = (), wind: float = 0.0) -> None:
        self.namespace, self.parameters, self.wind = namespace, list(parameters), wind
        self.processes: list[subprocess.Popen] = []
        self.programs: list[str] = []

    def start(self, course: str) -> None:
        """Start the processes of a sim on a course, in place of those that run."""
        self.stop()
        name = json.dumps(course, ensure_ascii=False)  # ROS reads YAML: '#' and ': ' say more
        self.run('sim_node', [f'course:={name}', *self.parameters])
        if self.wind > 0.0:
            about = [f'speed:={self.wind}', f'speed_spread:={0.35 * self.wind}']
            self.run('wind_node', [*about, 'direction_spread:=1.2', 'interval:=12.0', 'ramp:=2.0'])

    def run(self, program: str, parameters: Sequence[str]) -> None:
        """Start one process."""
        given = [part for parameter in parameters for part in ('-p', parameter)]
        self.programs.append(program)
        self.processes.append(
            subprocess.Popen(
                [
                    *(sys.executable, '-m', f'golf_sim_ros.nodes.{program}', '--ros-args'),
                    *('-r', f'__ns:={self.namespace}', '--log-level', 'error', *given),
                ],
                start_new_session=True,  # Ctrl-C is for this process, which then ends its own
            )
        )

    @property
    def ending(self) -> str:
        """Which process ended by itself, and how; '' where all run."""
        for program, process in zip(self.programs, self.processes):
            if process.poll() is not None:
                return f'{program} has ended by itself, with code {process.returncode}'
        return ''

    def interrupt(self) -> None:
        """Tell the processes to end."""
        send_interrupt(self.processes)

    def stop(self) -> None:
        """End the processes."""
        ending, self.processes, self.programs = self.processes, [], []
        send_interrupt(ending)
        until = monotonic() + PATIENCE
        while monotonic() < until and any(p.poll() is None for p in ending):
            sleep(LOOK)
        for process in ending:
            if process.poll() is None:
                process.kill()
            process.wait()


def send_interrupt(processes: Sequence[subprocess.Popen]) -> None:
    """Tell processes that run to end."""
    for process in processes:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)


def own_namespace() -> str:
    """Namespace that no other game on this machine has."""
    return f'/play_hole_{os.getpid()}'
