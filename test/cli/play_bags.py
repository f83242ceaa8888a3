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

"""Bags of plays that were never on ROS: a world is played, and written as a sim publishes it."""

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import Result, World
from golf_sim_ros.recording.journal import Journal
from golf_sim_ros.recording.json_format import collision_text, rejection_text, result_text
import numpy as np

START = 1_700_000_000_000_000_000  # ns of ROS time when the sim began
RATE, TICKS_A_POSE, PAUSE = 250.0, 5, 500  # a second; ticks
PARAMETERS = {
    'course': 'golf_without_friends',
    'rate': RATE,
    'publish_rate': 50.0,
    'accuracy': 'standard',
    'effects': ['auto'],
    'balls': ['ball'],
    'frame_id': 'course',
}
KINDS = {
    'ball/pose': 'geometry_msgs/msg/PoseStamped',
    'ball/twist': 'geometry_msgs/msg/TwistStamped',
    'wind': 'geometry_msgs/msg/Vector3Stamped',
    'collisions': 'std_msgs/msg/String',
    'shot/result': 'std_msgs/msg/String',
    'journal': 'std_msgs/msg/String',
}


class PlayedBag:
    """Plays strikes one after the other and writes what a sim would tell to a bag.

    `left_out` names topics that aren't recorded; `results` holds those of the shots that were
    played.
    """

    def __init__(self, path, storage, left_out=(), namespace=''):
        from rosbags.rosbag2 import StoragePlugin, Writer
        from rosbags.typesys import get_typestore, Stores

        self.types, self.left_out = get_typestore(Stores.ROS2_JAZZY), left_out
        self.course = load_course('golf_without_friends')
        self.world, self.tick, self.shots, self.results = World(self.course), 0, 0, []
        self.writer = Writer(path, version=9, storage_plugin=StoragePlugin[storage.upper()])
        self.writer.open()
        self.topics = {
            name: self.writer.add_connection(f'{namespace}/{name}', kind, typestore=self.types)
            for name, kind in KINDS.items()
            if name not in left_out
        }
        self.journal = Journal(lambda text: self.tell('journal', data=text))
        self.journal.config(self.world, PARAMETERS, START)

    def message(self, kind, **values):
        return self.types.types[kind](**values)

    def now(self):
        return START + round(self.tick / RATE * 1e9)

    def header(self):
        seconds, rest = divmod(self.now(), 10**9)
        stamp = self.message('builtin_interfaces/msg/Time', sec=seconds, nanosec=rest)
        return self.message('std_msgs/msg/Header', stamp=stamp, frame_id='course')

    def vector(self, numbers, kind='Vector3'):
        return self.message(f'geometry_msgs/msg/{kind}', **dict(zip('xyz', map(float, numbers))))

    def tell(self, topic, **values):
        if topic not in self.left_out:
            raw = self.types.serialize_cdr(self.message(KINDS[topic], **values), KINDS[topic])
            self.writer.write(self.topics[topic], self.now() + 300_000, raw)

    def tell_ball(self):
        ball = self.world['ball']
        turn = self.message('geometry_msgs/msg/Quaternion', x=0.0, y=0.0, z=0.0, w=1.0)
        pose = self.message(
            'geometry_msgs/msg/Pose',
            position=self.vector(ball.position, 'Point'),
            orientation=turn,
        )
        twist = self.message(
            'geometry_msgs/msg/Twist',
            linear=self.vector(ball.velocity),
            angular=self.vector(ball.spin),
        )
        self.tell('ball/pose', header=self.header(), pose=pose)
        self.tell('ball/twist', header=self.header(), twist=twist)

    def blow(self, wind):
        self.world.set_wind(wind)
        self.tell('wind', header=self.header(), vector=self.vector(wind))
        if self.world.moving:
            self.journal.note('wind', self.tick, wind=wind)

    def wait(self):
        for _ in range(PAUSE):
            self.world.advance(1 / RATE)
            self.tick += 1
        self.tell_ball()

    def strike(self, velocity, spin=(0.0, 0.0, 0.0), gust=None):
        """Play a shot to its end; a `gust` comes up one second after it."""
        self.wait()
        self.shots += 1
        self.journal.strike(self.tick, self.shots, 'ball', (velocity, spin), self.world.state())
        self.world.strike('ball', velocity, spin)
        struck, done = self.tick, False
        while not done:
            if gust and self.tick == struck + RATE:
                self.blow(gust)
            done = self.go_on()

    def go_on(self):
        """Play one tick and tell what happened; whether the shot is over."""
        events = self.world.advance(1 / RATE)
        self.tick += 1
        for event in events:
            if isinstance(event, Result):
                self.results.append(event._replace(shot=self.shots))
                self.journal.rest(self.tick, self.shots, event, self.world['ball'])
                self.tell('shot/result', data=result_text(event, self.shots))
            else:
                self.tell('collisions', data=collision_text(event))
        over = any(isinstance(event, Result) for event in events)
        if over or self.tick % TICKS_A_POSE == 0:
            self.tell_ball()
        return over

    def refuse(self):
        """Publish a strike that can't be played."""
        self.shots += 1
        self.tell(
            'shot/result',
            data=rejection_text(
                self.shots,
                'ball',
                (999.0, 0.0, 0.0),
                (0.0, 0.0, 0.0),
                'speed 999 m/s is over 150 m/s',
            ),
        )

    def putt(self, speed):
        """Strike the ball along the ground, to the hole."""
        way = np.subtract(self.course.hole, self.world['ball'].position[:2])
        self.strike((*(speed * way / np.linalg.norm(way)), 0.0))

    def close(self):
        self.writer.close()
