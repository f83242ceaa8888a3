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

"""Malformed and extreme messages, services, parameters over DDS at a sim; then a good shot."""

from collections import deque
from contextlib import contextmanager, suppress
import json
from math import inf, nan
import os
from pathlib import Path
from signal import SIGABRT
import socket
import sys
import tempfile
import time

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / 'test' / 'nodes')]
from geometry_msgs.msg import PointStamped, Twist, Vector3Stamped  # noqa: E402
import numpy as np  # noqa: E402
from processes import Golfer, parameters, Process, READY, wait_until  # noqa: E402
import pytest  # noqa: E402
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue  # noqa: E402
from rcl_interfaces.srv import SetParameters  # noqa: E402
from std_msgs.msg import String  # noqa: E402
from std_srvs.srv import SetBool, Trigger  # noqa: E402

BATCH = 8  # messages between two barriers: fewer than the sim keeps
HANGS = 60.0  # s without an answer
MEMORY = 50.0  # MB that the sim may grow by in the second half
STRANGE = (nan, inf, -inf, 1e308, -1e308, 5e-324, 1e200, 150.1, 2500.1, 0.0, -0.0)
GOOD, GOOD_SPIN = (9.0, 0.7, 6.0), (3.0, -120.0, 11.0)
EXACT = (
    'carry',
    'carry_side',
    'total',
    'side',
    'apex',
    'flight_time',
    'duration',
    'position',
    'status',
    'bounces',
    'landing_speed',
    'landing_angle',
    'lie',
)


@contextmanager
def domain():
    """Claim a ROS domain of our own, on this machine only."""
    with socket.socket() as claim, tempfile.TemporaryDirectory() as log:
        number = next(n for n in range(1, 102) if is_free(claim, n))
        os.environ.update(
            ROS_DOMAIN_ID=str(number), ROS_LOG_DIR=log, ROS_AUTOMATIC_DISCOVERY_RANGE='LOCALHOST'
        )
        os.environ['PYTHONPATH'] = os.pathsep.join([str(ROOT), os.environ.get('PYTHONPATH', '')])
        os.environ.setdefault('AMENT_PREFIX_PATH', sys.prefix)
        yield


def is_free(claim, number):
    """Whether nobody on this machine has that domain; then it is ours."""
    try:
        claim.bind(('127.0.0.1', 18000 + number))
    except OSError:
        return False
    return True


class Attacker(Golfer):
    """A client that sends what a random number generator says."""

    def __init__(self, namespace, seed):
        super().__init__(namespace)
        self.rng = np.random.default_rng(seed)
        self.journal = deque(maxlen=100)
        self.node.create_subscription(
            String, 'journal', lambda entry: self.journal.append(entry), 100
        )
        self.beats = self.listen(String, 'heartbeat', 1)
        self.all_results = self.listen(String, 'shot/result', 100000)
        self.ways = {
            topic: self.publisher(kind, topic, 100)
            for topic, kind in (
                ('shot', Twist),
                ('ball/shot', Twist),
                ('ball/place', PointStamped),
                ('wind', Vector3Stamped),
            )
        }
        make = self.node.create_client
        self.pause, self.resets = make(SetBool, 'golf_sim/pause'), make(Trigger, 'golf_sim/reset')
        self.settings = make(SetParameters, 'golf_sim/set_parameters')
        for service in (self.pause, self.resets, self.settings):
            assert service.wait_for_service(60.0)

    def ask(self, service, request):
        """Wait for the answer of a service, within HANGS."""
        future = service.call_async(request)
        wait_until(future.done, f'{service.srv_name} answered', HANGS)
        return future.result()

    def barrier(self):
        """Wait until the sim has seen what was sent."""
        self.ask(self.pause, SetBool.Request(data=False))

    def numbers(self, size, choices, share=0.5):
        """So many numbers, some of them of the `choices`."""
        return [
            float(
                self.rng.choice(choices) if self.rng.random() < share else self.rng.normal() * 20
            )
            for _ in range(size)
        ]

    def malformed(self):
        """Send something that the sim must refuse, or take as nothing."""
        what = self.rng.integers(5)
        if what == 0:
            self.send('shot', [nan, *self.numbers(5, STRANGE)])
        elif what == 1:
            self.send('ball/place', self.numbers(2, STRANGE, 0.9) + [nan], self.frame())
        elif what == 2:
            self.send('wind', [inf, *self.numbers(2, STRANGE)], self.frame())
        elif what == 3:
            way = list(self.ways.values())[self.rng.integers(4)]
            with suppress(RuntimeError):  # some are too long for the middleware to send
                way.publish(b'\x00\x01\x00\x00' + self.rng.bytes(int(self.rng.integers(0, 60))))
        else:
            self.set_badly()

    def frame(self):
        """Name of a frame, mostly a wrong one."""
        return str(self.rng.choice(['course', '', 'map', 'x' * 5000, '\u2603\n']))

    def extreme(self):
        """Send something at the edge of what is allowed."""
        what = self.rng.integers(8)
        if what < 4:
            way = self.rng.normal(size=3)
            way *= self.rng.choice([1e-12, 1e-3, 1.0, 149.9]) / np.linalg.norm(way)
            spin = self.rng.normal(size=3)
            spin *= self.rng.choice([0.0, 1e-9, 2499.0]) / np.linalg.norm(spin)
            self.send(str(self.rng.choice(['shot', 'ball/shot'])), [*way.tolist(), *spin.tolist()])
        elif what == 4:
            self.send(
                'ball/place',
                (self.rng.normal(size=3) * self.rng.choice([1.0, 100.0, 1e6])).tolist(),
            )
        elif what == 5:
            wind = self.rng.normal(size=3)
            self.send('wind', (99.9 * wind / np.linalg.norm(wind)).tolist())
        elif what == 6:
            self.set_parameter(
                'accuracy', str(self.rng.choice(['sketch', 'standard', 'reference']))
            )
        else:
            self.ask(self.resets, Trigger.Request())

    def send(self, topic, numbers, frame=''):
        """Publish numbers on a topic."""
        message = {'ball/place': PointStamped, 'wind': Vector3Stamped}.get(topic, Twist)()
        parts = (
            [message.point]
            if topic == 'ball/place'
            else [message.vector]
            if topic == 'wind'
            else [message.linear, message.angular]
        )
        for k, part in enumerate(parts):
            first, last = 3 * k, 3 * k + 3
            part.x, part.y, part.z = numbers[first:last]
        if hasattr(message, 'header'):
            message.header.frame_id = frame
        self.ways[topic].publish(message)

    def set_parameter(self, name, value):
        """Set a parameter."""
        kind = {str: 'string', float: 'double', int: 'integer', bool: 'bool'}[type(value)]
        told = ParameterValue(
            type=getattr(ParameterType, f'PARAMETER_{kind.upper()}'), **{f'{kind}_value': value}
        )
        self.ask(
            self.settings, SetParameters.Request(parameters=[Parameter(name=name, value=told)])
        )

    def set_badly(self):
        """Set a parameter to what it can't be."""
        names = ['accuracy', 'rate', 'course', 'nothing', 'balls', 'real_time_factor', '']
        name = str(self.rng.choice(names))
        bad = (
            [-1.0, nan, inf, 1e9, 0.05]
            if name == 'real_time_factor'
            else ['x' * 3000, nan, -5, True, '']
        )
        self.set_parameter(name, bad[self.rng.integers(len(bad))])

    def good_shot(self):
        """Values of the good shot that are exact, from the tee and in still air."""
        self.barrier()
        self.set_parameter('accuracy', 'standard')
        self.send('wind', [0.0, 0.0, 0.0])
        self.barrier()
        self.ask(self.resets, Trigger.Request())
        before = len(self.results_of(GOOD, GOOD_SPIN))
        self.strike(GOOD, GOOD_SPIN)
        wait_until(
            lambda: len(self.results_of(GOOD, GOOD_SPIN)) > before, 'the good shot ended', HANGS
        )
        told = self.results_of(GOOD, GOOD_SPIN)[-1]
        return {name: told[name] for name in EXACT}


def memory(process):
    """Memory [MB] of a process."""
    status = Path(f'/proc/{process.pid}/status').read_text()
    return int(status.split('VmRSS:')[1].split()[0]) / 1024


def messages(count, seed):
    """Send so many malformed and as many extreme messages.

    Returns what went wrong, a list of lines.
    """
    with domain():
        sim = Process(
            'sim_node',
            *parameters('/fuzzed', real_time_factor=0.0),
            environment={'PYTHONFAULTHANDLER': '1'},
        )
        try:
            sim.wait_for(READY)
            attacker = Attacker('/fuzzed', seed)
            try:
                return attacked(sim, attacker, count, seed)
            finally:
                attacker.close()
        finally:
            sim.stop()


def attacked(sim, attacker, count, seed):
    """`messages`, at a sim that listens."""
    troubles, began = [], time.monotonic()
    expected = attacker.good_shot()
    for number in range(2 * count):
        try:
            (attacker.extreme if number % 2 else attacker.malformed)()
            if number % BATCH == 0:
                attacker.barrier()
        except pytest.fail.Exception as error:
            sim.popen.send_signal(SIGABRT)  # it says where it is
            sim.wait()
            last = [
                message.data for message in attacker.journal if '"kind": "strike"' in message.data
            ][-1:]
            return [
                f'after {number} messages of seed {seed}: {error}: {sim.output[-3000:]}',
                *last,
            ]
        if sim.popen.poll() is not None:
            return [
                f'the sim ended with {sim.popen.poll()} after {number} messages of seed {seed}: '
                + sim.output[-3000:]
            ]
        if number == count:
            start = memory(sim)
    if attacker.good_shot() != expected:
        troubles.append('the good shot is another one')
    grown = memory(sim) - start
    seen = len(attacker.beats)
    wait_until(lambda: len(attacker.beats) > seen + 1, 'the heart beat', HANGS)
    shots = json.loads(attacker.beats[-1].data)['shots']
    numbers = sorted(json.loads(message.data)['shot'] for message in attacker.all_results)
    if numbers != list(range(1, shots + 1)):
        troubles.append(
            f'{shots} strikes, {len(numbers)} results, {len(set(numbers))} different ones'
        )
    if 'Traceback' in sim.output:
        begin = sim.output.index('Traceback')
        troubles.append('a traceback: ' + sim.output[begin:][:900])
    if grown > MEMORY:
        troubles.append(f'the sim grew by {grown:.0f} MB')
    took = time.monotonic() - began
    print(
        f'{count} malformed and {count} extreme messages of seed {seed} in {took:.0f} s: '
        f'{shots} strikes, {len(numbers)} results; '
        f'the sim grew by {grown:.1f} MB in the second half',
        flush=True,
    )
    return troubles
