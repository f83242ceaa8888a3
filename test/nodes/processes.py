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

"""What tests over DDS share: processes to start, a client to talk to them, and patience."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

from geometry_msgs.msg import PointStamped, PoseStamped, Twist
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from std_srvs.srv import Trigger

DEADLINE = 300.0  # s: a first start compiles, on a machine that may have other things to do
RESEND = 20.0  # s without an answer of a service
READY = 'ready; to strike'  # in the log of a sim that listens
LASTING = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def wait_until(condition, what='it happened', seconds=DEADLINE):
    """Wait until `condition()` is true and return it; fails with `what` if it never is."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        found = condition()
        if found:
            return found
        threading.Event().wait(0.01)
    pytest.fail(f'{seconds} s passed before {what}')


class Process:
    """A node or tool in a process of its own, and all it has written so far (`output`)."""

    def __init__(self, module, *arguments, environment=None):
        folder = '' if '.' in module else 'nodes.'
        command = [sys.executable, '-u', '-m', f'golf_sim_ros.{folder}{module}', *arguments]
        self.popen = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, **(environment or {})},
            start_new_session=True,
        )
        self.pid = self.popen.pid
        self.lines = []
        self.reader = threading.Thread(
            target=lambda: self.lines.extend(self.popen.stdout), daemon=True
        )
        self.reader.start()

    @property
    def output(self):
        return ''.join(self.lines)

    def wait_for(self, text, seconds=DEADLINE):
        """Wait for the first line of output that contains `text`."""
        wait_until(
            lambda: text in self.output or self.popen.poll() is not None,
            f'{text!r} in the output:\n{self.output}',
            seconds,
        )
        found = [line for line in self.lines if text in line]
        assert found, f'ended with code {self.popen.poll()} without {text!r}:\n{self.output}'
        return found[0]

    def wait(self, seconds=DEADLINE):
        """Exit code once it ends by itself."""
        code = self.popen.wait(seconds)
        self.reader.join(seconds)
        return code

    def stop(self, number=signal.SIGINT):
        """Exit code after signal `number`; a process that does not obey within 20 s is killed."""
        if self.popen.poll() is None:
            self.popen.send_signal(number)
        try:
            return self.wait(20.0)
        except subprocess.TimeoutExpired:
            os.killpg(self.pid, signal.SIGKILL)
            self.popen.wait()
            pytest.fail(f'signal {number} did not end process {self.pid}:\n{self.output}')


def parameters(namespace='', **values):
    """Arguments of a node in `namespace` with these parameters."""
    remap = ['-r', f'__ns:={namespace}'] if namespace else []
    given = [word for name, value in values.items() for word in ('-p', f'{name}:={value}')]
    return ['--ros-args', *remap, *given]


class Client:
    """A plain rclpy node that listens in a thread of its own."""

    def __init__(self, namespace=''):
        self.context = Context()
        rclpy.init(context=self.context, domain_id=int(os.environ['ROS_DOMAIN_ID']))
        self.node = rclpy.create_node(
            f'client_{id(self)}', namespace=namespace, context=self.context
        )
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self.executor.spin, daemon=True)
        self.thread.start()

    def listen(self, kind, topic, qos=10):
        """Return a list of all messages on `topic` from now on, in order of arrival."""
        heard = []
        self.node.create_subscription(kind, topic, heard.append, qos)
        return heard

    def publisher(self, kind, topic, qos=10, wait=True):
        """Publish on `topic`, after somebody subscribed to it (unless `wait` is false)."""
        publisher = self.node.create_publisher(kind, topic, qos)
        if wait:
            wait_until(publisher.get_subscription_count, f'somebody subscribed to {topic}')
        return publisher

    def call(self, kind, service, request):
        """Return the response of `service` to `request`, sent again while no answer comes.

        A service may be found before it has found who asks: then its answer is lost.
        """
        client = self.node.create_client(kind, service)
        assert client.wait_for_service(DEADLINE), f'nobody offers {service}'
        futures = []

        def answered():
            if time.monotonic() > due[0]:
                futures.append(client.call_async(request))
                due[0] = time.monotonic() + RESEND
            return [future for future in futures if future.done()]

        due = [0.0]
        first, *_ = wait_until(answered, f'{service} answered')
        self.node.destroy_client(client)
        return first.result()

    def close(self):
        self.executor.shutdown()
        self.thread.join()
        self.node.destroy_node()
        self.context.try_shutdown()


class Golfer(Client):
    """A client with one ball: strikes it, and gets all that is published from now on.

    Subscriptions are announced in order: a sim whose pose arrives has found those before it.
    """

    def __init__(self, namespace='', ball='ball'):
        super().__init__(namespace)
        self.ball = ball
        self.shots = self.publisher(Twist, f'{ball}/shot')
        self.collisions = self.listen(String, 'collisions', 100)
        self.contacts = self.listen(PointStamped, f'{ball}/contact', 100)
        self.results = self.listen(String, 'shot/result', 100)
        self.poses = self.listen(PoseStamped, f'{ball}/pose', 100)
        wait_until(lambda: self.poses, 'the ball told where it is')

    def strike(self, velocity, spin=(0.0, 0.0, 0.0)):
        """Send a strike."""
        message = Twist()
        message.linear.x, message.linear.y, message.linear.z = velocity
        message.angular.x, message.angular.y, message.angular.z = spin
        self.shots.publish(message)

    def results_of(self, velocity, spin=(0.0, 0.0, 0.0)):
        """All results of strikes with this velocity and spin (None: was not finite)."""
        told = [json.loads(message.data) for message in self.results]
        return [
            result
            for result in told
            if result['velocity'] == list(velocity) and result['spin'] == list(spin)
        ]

    def play(self, velocity, spin=(0.0, 0.0, 0.0)):
        """Wait for the result of a strike that is like no other before."""
        self.strike(velocity, spin)
        return wait_until(
            lambda: self.results_of(velocity, spin), f'the result of {velocity} came'
        )[0]

    def impacts(self):
        """All collisions, read."""
        return [json.loads(message.data) for message in self.collisions]

    def heartbeat(self):
        """Wait until a new subscription got the pose.

        All that the sim published before has arrived then.
        """
        seen, heard = len(self.poses), []
        # It stays until the node goes: rclpy's executor may stumble over one that is destroyed as
        # it waits.
        self.node.create_subscription(PoseStamped, f'{self.ball}/pose', heard.append, 100)
        wait_until(lambda: heard and len(self.poses) > seen, 'the sim told where the ball is')

    def reset(self):
        """All balls back to the start; `poses` ends with one from there."""
        assert self.call(Trigger, 'golf_sim/reset', Trigger.Request()).success
        seen = len(self.poses)
        wait_until(lambda: len(self.poses) > seen, 'the sim told where the ball is')


def seconds(stamp):
    """Return a stamp as a number [s]."""
    return stamp.sec + 1e-9 * stamp.nanosec


def place(pose):
    """Position of a PoseStamped."""
    return pose.pose.position.x, pose.pose.position.y, pose.pose.position.z
