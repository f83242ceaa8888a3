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

"""Records the bags of test/data/bags anew: one of each kind of play, with the sim and over DDS.

Only who changes a law on purpose has a reason to: `test_recorded_bags.py` plays them again, to the
bit. `record_bags.py KIND ...` records these kinds, without one all of them.
"""

from functools import partial
import json
import os
from pathlib import Path
import random
import shutil
import subprocess
import sys
from tempfile import TemporaryDirectory
import time

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / 'tools')]
from geometry_msgs.msg import PointStamped, Twist, TwistStamped, Vector3Stamped  # noqa: E402
from golf_sim_ros.recording.bag_file import raw_messages  # noqa: E402
from golf_sim_ros.recording.bag_writer import BagWriter  # noqa: E402
import rclpy  # noqa: E402
from running import BIN, EVENTS, stopped  # noqa: E402
from std_msgs.msg import String  # noqa: E402

BAGS = ROOT / 'test' / 'data' / 'bags'
LEFT_OUT = ('markers', 'diagnostics', 'heartbeat')  # what resimulate does not look at
PATIENCE = 120.0  # s for what is waited for
DRIVE, IRON, CHIP, PUTT = (73.3, 0.0, 14.1), (50.0, -1.0, 17.0), (9.0, 0.5, 6.0), (2.0, 0.1, 0.0)
DRAW, BACKSPIN = (20.0, -280.0, 35.0), (0.0, -700.0, 0.0)


class Player:
    """Who plays on a sim: strikes, places, blows, and waits for the ends of shots."""

    def __init__(self, balls):
        self.node = rclpy.create_node('player')
        self.shots = {
            ball: self.node.create_publisher(Twist, f'{ball}/shot', 10) for ball in balls
        }
        self.places = {
            ball: self.node.create_publisher(PointStamped, f'{ball}/place', 10) for ball in balls
        }
        self.winds = self.node.create_publisher(Vector3Stamped, 'wind', 10)
        self.results, self.entries = [], []
        for topic, kept in (('shot/result', self.results), ('journal', self.entries)):
            self.node.create_subscription(String, topic, partial(keep_told, kept), EVENTS)
        self.still = dict.fromkeys(balls, False)
        for ball in balls:
            self.node.create_subscription(
                TwistStamped, f'{ball}/twist', partial(self.look_at, ball), 10
            )
        self.struck = 0
        publishers = [*self.shots.values(), *self.places.values(), self.winds]
        self.wait(lambda: self.entries and all(one.get_subscription_count() for one in publishers))
        since = time.monotonic()
        # until the sim knows of the publishers, too
        self.wait(lambda: time.monotonic() > since + 2.0)

    def wait(self, condition, meanwhile=lambda: None):
        """Listen until `condition()`."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            meanwhile()
            rclpy.spin_once(self.node, timeout_sec=0.02)
            if time.monotonic() > deadline:
                raise TimeoutError('the sim does not answer')

    def look_at(self, ball, message):
        """Note whether a ball lies still."""
        self.still[ball] = message.twist == Twist()

    def strike(self, ball, velocity, spin=(0.0, 0.0, 0.0)):
        """Strike once the ball lies still, and wait until that is in the journal."""
        self.wait(lambda: self.still[ball])
        message = Twist()
        message.linear.x, message.linear.y, message.linear.z = velocity
        message.angular.x, message.angular.y, message.angular.z = spin
        self.struck += 1
        while self.played() < self.struck:
            tried = self.answers()
            self.shots[ball].publish(message)
            self.wait(lambda: self.answers() > tried)

    def played(self):
        """Count the strikes in the journal."""
        return sum(entry['kind'] == 'strike' for entry in self.entries)

    def answers(self):
        """How many strikes were taken or, as the ball moved after all, rejected."""
        return self.played() + sum(result['status'] == 'rejected' for result in self.results)

    def place(self, ball, x, y):
        """Place, and wait until that is in the journal."""
        before = len(self.entries)
        message = PointStamped()
        message.point.x, message.point.y = x, y
        self.places[ball].publish(message)
        self.wait(
            lambda: any(
                entry['kind'] == 'place' and entry['ball'] == ball
                for entry in self.entries[before:]
            )
        )
        self.still[ball] = False

    def blow(self, x, y):
        """Send a wind."""
        message = Vector3Stamped()
        message.vector.x, message.vector.y = x, y
        self.winds.publish(message)

    def rest(self, meanwhile=lambda: None):
        """Wait until every shot has ended."""
        self.wait(
            lambda: sum(one['status'] != 'rejected' for one in self.results) >= self.struck,
            meanwhile,
        )


def keep_told(kept, message):
    """Add the object in a message of JSON."""
    kept.append(json.loads(message.data))


def one_ball(player):
    """Play a drive with a draw, an iron with backspin, a putt."""
    for velocity, spin in ((DRIVE, DRAW), (IRON, BACKSPIN), (PUTT, (0.0, 0.0, 0.0))):
        player.strike('ball', velocity, spin)
        player.rest()


def several_balls(player):
    """Balls that hit each other on the green, and are struck while others move, one away."""
    for ball, x in (('red', 36.0), ('green', 37.0), ('blue', 37.05)):
        player.place(ball, x, 0.01)
    player.strike('red', (4.0, 0.0, 0.0))
    player.rest()
    for ball, velocity in (('red', CHIP), ('green', CHIP), ('blue', IRON)):
        player.strike(ball, velocity, BACKSPIN)
    player.rest()


def gusts(player):
    """Two shots in a wind that changes ten times a second, of a field, and in its turbulence."""
    chance, due = random.Random(1), [0.0]

    def blow():
        if time.monotonic() >= due[0]:
            due[0] = time.monotonic() + 0.1
            player.blow(chance.gauss(6.0, 1.5), chance.gauss(-2.0, 1.5))

    for velocity, spin in ((DRIVE, DRAW), (IRON, BACKSPIN)):
        player.strike('ball', velocity, spin)
        player.rest(blow)


def water_and_out_of_bounds(player):
    """Into the pond, skipping over it, out of bounds, through the leaves."""
    for velocity, spin in (
        ((11.0, -7.0, 8.0), (0.0, 0.0, 0.0)),
        ((22.0, -14.0, 3.0), (0.0, -300.0, 0.0)),
        (IRON, (0.0, 0.0, 0.0)),
        ((16.0, 11.0, 9.0), (0.0, -100.0, 0.0)),
    ):
        player.strike('ball', velocity, spin)
        player.rest()


def pile(player):
    """Five balls come to rest on each other at the bottom of a pit."""
    for ball, x, y in (
        ('a', 0.7, 0.0),
        ('b', -0.7, 0.02),
        ('c', 0.01, 0.7),
        ('d', -0.02, -0.7),
        ('e', 0.7, 0.3),
    ):
        player.place(ball, x, y)
    for ball, x, y in (
        ('a', -0.9, 0.0),
        ('b', 0.9, 0.0),
        ('c', 0.0, -0.9),
        ('d', 0.0, 0.9),
        ('e', -0.9, -0.3),
    ):
        player.strike(ball, (x, y, 0.0))
    player.rest()


KINDS = {  # play, course, balls, more parameters
    one_ball: ('golf_without_friends', ['ball'], {}),
    several_balls: ('playground', ['red', 'green', 'blue'], {}),
    gusts: (
        'links',
        ['ball'],
        {'real_time_factor': 1.0, 'turbulence': 0.145, 'turbulence_seed': 7},
    ),
    water_and_out_of_bounds: ('playground', ['ball'], {}),
    pile: ('test/data/bags/pit.yaml', ['a', 'b', 'c', 'd', 'e'], {}),
}


def record(kind):
    """Record one kind of play, and keep what `resimulate` looks at."""
    course, balls, more = KINDS[kind]
    values = {
        'course': course,
        'balls': f'[{",".join(balls)}]',
        'real_time_factor': 5.0,
        'publish_rate': 10.0,
        'engine': 'python',
        **more,
    }
    words = [word for name, value in values.items() for word in ('-p', f'{name}:={value}')]
    with TemporaryDirectory() as folder:
        whole = Path(folder) / 'whole'
        recorder = subprocess.Popen([BIN / 'record_play', '-o', whole, '--balls', *balls])
        sim = subprocess.Popen([BIN / 'sim_node', '--ros-args', *words], cwd=ROOT)
        try:
            player = Player(balls)
            kind(player)
            print(kind.__name__, [result['status'] for result in player.results])
            player.node.destroy_node()
        finally:
            codes = stopped(sim), stopped(recorder)
        if codes != (0, 0):
            raise RuntimeError(f'sim and recorder ended with {codes}')
        keep(whole, BAGS / kind.__name__)


def keep(whole, path):
    """Write the messages of a bag that matter into another one."""
    shutil.rmtree(path, ignore_errors=True)
    bag = BagWriter(path, 'mcap')
    for received, topic, kind, data in sorted(raw_messages(whole), key=lambda one: one[0]):
        if not topic.endswith(LEFT_OUT):
            bag.add(topic, kind, [('RELIABLE', 'VOLATILE', 10)])
            bag.write(topic, received, data)
    bag.close()


def main():
    """Record the kinds that were asked for."""
    os.environ.update(
        ROS_DOMAIN_ID=str(1 + os.getpid() % 100), ROS_AUTOMATIC_DISCOVERY_RANGE='LOCALHOST'
    )
    BAGS.mkdir(parents=True, exist_ok=True)
    rclpy.init()
    try:
        for kind in KINDS:
            if kind.__name__ in sys.argv[1:] or len(sys.argv) == 1:
                record(kind)
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
