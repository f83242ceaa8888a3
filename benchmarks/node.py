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

"""`sim_node` in a process of its own, balls in flight all the time: share of a core, and pace.

Somebody listens to the balls' poses, for what nobody listens to is not made; but does not read
them, or reading would take as much of the machine as simulating.
"""

import json
import os
from pathlib import Path
import signal
import subprocess
import sys
import tempfile
from time import monotonic

from timing import Row

SECONDS, QUICK_SECONDS = 60.0, 10.0
PATIENCE = 300.0  # s: a first start compiles
COURSE = """format: 1
name: Beach
tee: [0, 0]
ground:
  - {shape: plane, point: [0, 0, 0], normal: [0, 0, 1], material: sand}
"""  # a ball ends where it lands, so that one that is struck again at once is always in flight
# m/s: some of many balls go higher than others, so that they land apart
AHEAD, UP, HIGHER = 10.0, 40.0, 30.0


def rows(quick):
    """`Row` of each figure; none where there is no ROS."""
    try:
        import rclpy  # noqa: F401
    except ImportError:
        print('sim_node: not timed, there is no ROS', flush=True)
        return
    seconds = QUICK_SECONDS if quick else SECONDS
    yield from figures(
        'sim_node at 1000 Hz, told at 50 Hz, one ball in flight', seconds, 1, rate=1000.0
    )
    yield from figures('sim_node at its default rates, one ball in flight', seconds, 1, most=12.0)
    yield from figures(
        'sim_node at its default rates, 100 balls in flight', seconds, 100, most=40.0
    )
    yield from figures(
        'sim_node in plain Python, default rates, one ball in flight',
        seconds,
        1,
        most=25.0,
        engine='python',
    )


def figures(name, seconds, balls, most=float('inf'), **parameters):
    """Rows: share of a core, simulated seconds a second, ticks made up."""
    with tempfile.TemporaryDirectory() as folder:
        course = Path(folder, 'beach.yaml')
        course.write_text(COURSE)
        names = ['ball'] if balls == 1 else [f'ball_{i}' for i in range(balls)]
        given = {
            'course': course,
            'balls': str(names).replace("'", ''),
            'engine': 'compiled',
            **parameters,
        }
        words = [word for key, value in given.items() for word in ('-p', f'{key}:={value}')]
        environment = {**os.environ, 'ROS_DOMAIN_ID': str(100 + os.getpid() % 100)}
        os.environ['ROS_DOMAIN_ID'] = environment['ROS_DOMAIN_ID']
        sim = subprocess.Popen(
            [sys.executable, '-m', 'golf_sim_ros.nodes.sim_node', '--ros-args', *words],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            share, factor, made_up = watched(sim, names, seconds)
        finally:
            sim.send_signal(signal.SIGINT)
            sim.wait()
    yield Row(f'{name}: of a core', share, '%', most=most)
    yield Row(f'{name}: simulated seconds a second', factor, '', least=0.99)
    yield Row(f'{name}: ticks made up', made_up, '')


def watched(sim, balls, seconds):
    """Measure a process `sim` while its balls fly: share of a core [%], pace, ticks made up.

    The pace is the mean real-time factor.
    """
    from diagnostic_msgs.msg import DiagnosticArray
    from geometry_msgs.msg import PoseStamped, Twist
    from golf_sim_ros.nodes.lifecycle import EventsExecutor
    import rclpy
    from rclpy.qos import QoSProfile
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node('golfer')
    executor = EventsExecutor()
    executor.add_node(node)
    clubs = {ball: node.create_publisher(Twist, f'{ball}/shot', 10) for ball in balls}
    told, seen = [], []

    def strike(ball):
        shot = Twist()
        shot.linear.x, shot.linear.z = AHEAD, UP + HIGHER * balls.index(ball) / len(balls)
        clubs[ball].publish(shot)

    def note(message):
        told.append({pair.key: pair.value for status in message.status for pair in status.values})

    for ball in balls:
        node.create_subscription(PoseStamped, f'{ball}/pose', seen.append, 10, raw=True)
    node.create_subscription(DiagnosticArray, '/diagnostics', note, 10)
    node.create_subscription(
        String, 'shot/result', lambda m: strike(json.loads(m.data)['ball']), QoSProfile(depth=100)
    )

    def spin(until, done=lambda: False):
        while monotonic() < until and not done():
            executor.spin_once(timeout_sec=0.1)

    try:
        spin(
            monotonic() + PATIENCE,
            lambda: told and all(club.get_subscription_count() for club in clubs.values()),
        )
        for ball in balls:
            strike(ball)
        spin(monotonic() + 2.0)
        told.clear()
        began, used = monotonic(), busy(sim.pid)
        spin(began + seconds)
        share = 100.0 * (busy(sim.pid) - used) / (monotonic() - began)
    finally:
        node.destroy_node()
        rclpy.shutdown()
    factors = [float(each['real-time factor']) for each in told]
    made_up = int(told[-1]['ticks made up']) - int(told[0]['ticks made up'])
    return share, sum(factors) / len(factors), made_up


def busy(pid):
    """Time [s] that a process has used."""
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')
