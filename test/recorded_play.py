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

"""A play of a world, with the messages that a sim would publish, and bags of it; no ROS."""

from copy import deepcopy

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import Phase, Rejected, Result, World
from golf_sim_ros.recording.journal import Journal
from golf_sim_ros.recording.json_format import collision_text, rejection_text, result_text
import pytest

# Tests that import this module are skipped where there is no rosbags.
rosbag2, typesys = map(pytest.importorskip, ('rosbags.rosbag2', 'rosbags.typesys'))

TYPES = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
START = 1_700_000_000_123_456_789  # ns
RATE, STEP = 250.0, 5  # ticks a second, ticks a pose
CHIP, PITCH, PUTT = (9.0, 0.5, 6.0), (20.0, -1.0, 12.0), (2.0, 0.1, 0.0)
SPIN = (3.0, -120.0, 11.0)
# What comes in: tick, what, with what. Red flies in gusts; blue is struck meanwhile.
PLAY = (
    (3, 'wind', ((3.0, 1.0, 0.0),)),
    (10, 'strike', ('red', PITCH, SPIN)),
    (60, 'wind', ((5.1, -1.3, 0.0),)),
    (90, 'strike', ('blue', CHIP, SPIN)),
    (100, 'strike', ('red', PUTT, SPIN)),
    (110, 'wind', ((0.1, 2.2, 0.0),)),
    (130, 'accuracy', ('sketch',)),
    (3000, 'place', ('blue', (30.0, 1.0))),
    (3003, 'strike', ('blue', PUTT, (0.0, 0.0, 0.0))),
    (4000, 'strike', ('red', CHIP, SPIN)),
    (4100, 'reset', ()),
    (4200, 'strike', ('red', CHIP, SPIN)),
)
LAST = 6000
PARAMETERS = {
    'course': 'golf_without_friends',
    'rate': RATE,
    'accuracy': 'standard',
    'effects': ['auto'],
    'balls': ['red', 'blue'],
}
STRIKES = 5  # of these that are played; the third is at a ball in motion


class Sim:
    """Plays, and keeps all messages: topic, type, time received [ns], message."""

    def __init__(self, namespace='', start=START, session=0):
        self.namespace, self.start, self.told = namespace, start, []
        self.world = World(load_course('golf_without_friends'), ('red', 'blue'))
        self.tick = self.shots = 0
        self.playing = {}
        self.journal = Journal(lambda text: self.tell_text('journal', text))
        self.journal.config(self.world, PARAMETERS, start, session)

    def play(self, inputs=PLAY, last=LAST):
        """Play it all."""
        while self.tick < last:
            for _, what, values in [one for one in inputs if one[0] == self.tick]:
                getattr(self, what)(*values)
            self.tell_poses()
            self.tick += 1
            self.tell_events(self.world.advance(1.0 / RATE))
        return self.told

    def strike(self, ball, velocity, spin):
        self.tell(
            f'{ball}/shot', 'geometry_msgs/msg/Twist', linear=xyz(velocity), angular=xyz(spin)
        )
        self.shots += 1
        before = self.world.state()
        try:
            self.world.strike(ball, velocity, spin)
        except Rejected as error:
            self.tell_text(
                'shot/result', rejection_text(self.shots, ball, velocity, spin, str(error))
            )
            return
        self.playing[ball] = self.shots
        self.journal.strike(self.tick, self.shots, ball, (velocity, spin), before)

    def wind(self, wind):
        self.world.set_wind(wind)
        self.tell(
            'wind', 'geometry_msgs/msg/Vector3Stamped', header=self.header(), vector=xyz(wind)
        )
        if self.world.moving:
            self.journal.note('wind', self.tick, wind=wind)

    def accuracy(self, accuracy):
        self.world.accuracy = accuracy
        self.journal.note('accuracy', self.tick, accuracy=accuracy)

    def place(self, ball, place):
        self.world.place(ball, place)
        self.journal.note('place', self.tick, ball=ball, position=place)

    def reset(self):
        aborted = self.world.reset()
        self.journal.note('reset', self.tick)
        self.tell_events(aborted)

    def tell_events(self, events):
        for event in events:
            if isinstance(event, Result):
                shot = self.playing.pop(event.ball)
                self.journal.rest(self.tick, shot, event, self.world[event.ball])
                self.tell_text('shot/result', result_text(event, shot))
            else:
                self.tell_text('collisions', collision_text(event))

    def tell_poses(self):
        for name in self.world.names if self.tick % STEP == 0 else ():
            ball = self.world[name]
            if ball.phase != Phase.REST or self.tick % int(RATE) == 0:
                self.tell(
                    f'{name}/pose',
                    'geometry_msgs/msg/PoseStamped',
                    header=self.header(),
                    pose=made(
                        'geometry_msgs/msg/Pose',
                        position=xyz(ball.position, 'Point'),
                        orientation=made(
                            'geometry_msgs/msg/Quaternion', x=0.0, y=0.0, z=0.0, w=1.0
                        ),
                    ),
                )
                self.tell(
                    f'{name}/twist',
                    'geometry_msgs/msg/TwistStamped',
                    header=self.header(),
                    twist=made(
                        'geometry_msgs/msg/Twist',
                        linear=xyz(ball.velocity),
                        angular=xyz(ball.spin),
                    ),
                )

    def header(self):
        now = self.start + round(self.world.time * 1e9)
        stamp = made('builtin_interfaces/msg/Time', sec=now // 10**9, nanosec=now % 10**9)
        return made('std_msgs/msg/Header', stamp=stamp, frame_id='course')

    def tell_text(self, topic, text):
        self.tell(topic, 'std_msgs/msg/String', data=text)

    def tell(self, topic, kind, **fields):
        received = self.start + round(self.world.time * 1e9) + 1000 * len(self.told)
        self.told.append((f'{self.namespace}/{topic}', kind, received, made(kind, **fields)))


def made(kind, **fields):
    """Make a message."""
    return TYPES.types[kind](**fields)


def xyz(vector, kind='Vector3'):
    """Make a Vector3 or Point."""
    return made(
        f'geometry_msgs/msg/{kind}', **{name: float(part) for name, part in zip('xyz', vector)}
    )


def bag(path, told, storage='mcap'):
    """Path of a bag in which all of `told` is."""
    plugin = rosbag2.StoragePlugin[storage.upper()]
    with rosbag2.Writer(path, version=9, storage_plugin=plugin) as writer:
        topics = {
            topic: writer.add_connection(topic, kind, typestore=TYPES)
            for topic, kind in dict(one[:2] for one in told).items()
        }
        for topic, kind, received, message in told:
            writer.write(topics[topic], received, TYPES.serialize_cdr(message, kind))
    return path


def without(told, *names):
    """`told` without these topics."""
    return [one for one in told if not one[0].endswith(names)]


def changed(told, change, *topics):
    """Change one message of `told`: the first of these topics for which `change` is true of it."""
    told = list(told)
    for i, (topic, kind, received, message) in enumerate(told):
        if topic.endswith(topics):
            copy = deepcopy(message)
            if change(copy):
                told[i] = topic, kind, received, copy
                return told
    raise AssertionError('nothing was changed')


def replaced(old, new):
    """Make a change that replaces `old` by `new` in a text, where it is."""

    def change(message):
        found = old in message.data
        message.data = message.data.replace(old, new, 1)
        return found

    return change
