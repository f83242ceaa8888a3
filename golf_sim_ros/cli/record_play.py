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

"""Record a play to a rosbag2 bag, where `ros2 bag record` is not installed."""

import argparse
from collections.abc import Iterable
from datetime import datetime
from functools import partial
import sys
import time

import rclpy
from rclpy.exceptions import NameValidationException
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.signals import SignalHandlerOptions
from rclpy.subscription import Subscription
from rclpy.utilities import remove_ros_args

from .closed_pipe import in_pipes, say
from .play_topics import of_ball, OF_SIM, Topic
from ..nodes.command_line import explained
from ..nodes.environment import complete_environment, unsafe
from ..nodes.lifecycle import Ending, EventsExecutor
from ..recording.bag_writer import BagWriter, CannotRecord
from ..recording.journal import JournalError, opened

STORAGES = ('mcap', 'sqlite3')
LINGER = 0.3  # s after the signal, for messages still on their way
ONLY_WHEN_HEARD = ('/clock',)  # an empty topic of this name would disturb who plays the bag back


class Recorder(Node):
    """Writes all messages on a sim's topics into a bag, as they arrive.

    Parameters
    ----------
    bag : BagWriter
    namespace : str or None
        Of the sim.
    balls : sequence of str
        Their topics are followed at once; those of other balls as soon as the sim's journal names
        them.
    """

    def __init__(
        self, bag: BagWriter, namespace: str | None = None, balls: Iterable[str] = ()
    ) -> None:
        super().__init__(
            'record_play', namespace=namespace, start_parameter_services=False, enable_rosout=False
        )
        self.bag = bag
        self.topics: dict[str, tuple[Topic, Subscription]] = {}
        self.balls: list[str] = []
        self.named = list(balls)
        for topic in OF_SIM:
            self.follow(topic)

    def follow(self, topic: Topic) -> None:
        """Record a topic from now on."""
        write = partial(self.on_message, topic)
        subscription = self.create_subscription(
            topic.kind, topic.name, write, topic.requested(), raw=True
        )
        self.topics[subscription.topic_name] = topic, subscription

    def follow_named(self) -> None:
        """Record the balls that the journal named since the last call, and print their names."""
        new = [ball for ball in self.named if ball not in self.balls]
        for topic in [topic for ball in new for topic in of_ball(ball)]:
            self.follow(topic)
        self.balls += new
        if new:
            namespace = self.get_namespace()
            say(f'recording {", ".join(new)} of {namespace} to {self.bag.path}; Ctrl-C ends it')

    def on_message(self, topic: Topic, data: bytes) -> None:
        """Write one message; the journal also says which balls there are."""
        now = time.time_ns()
        name = self.resolve_topic_name(topic.name)
        self.begin(name, topic)
        self.bag.write(name, now, data)
        if topic.name == 'journal':
            self.named += balls_in(deserialize_message(data, topic.kind).data)

    def begin(self, name: str, topic: Topic) -> None:
        """Begin a topic in the bag with the QoS that is offered on it now, or usually."""
        if name not in self.bag.connections:
            offers = [info.qos_profile for info in self.get_publishers_info_by_topic(name)]
            profiles = {
                (offer.reliability.name, offer.durability.name, topic.offered.depth)
                for offer in offers or [topic.offered]
            }
            self.bag.add(name, topic.type_name, sorted(profiles))

    def complete(self) -> None:
        """Begin those topics that nobody has written to, and close the bag."""
        for name, (topic, _) in self.topics.items():
            if name not in ONLY_WHEN_HEARD:
                self.begin(name, topic)
        self.bag.close()


def balls_in(text: str) -> list[str]:
    """Names of the balls, if `text` is the configuration of a journal."""
    try:
        return opened(text).get('parameters', {}).get('balls', [])
    except JournalError:
        return []


def record(recorder: Recorder, ending: Ending) -> None:
    """Write what arrives until a signal sets `ending`, and a little longer."""
    executor = EventsExecutor()
    executor.add_node(recorder)
    until = None
    while rclpy.ok() and (until is None or time.monotonic() < until):
        recorder.follow_named()
        executor.spin_once(timeout_sec=0.05)
        if ending.told and until is None:
            until = time.monotonic() + LINGER
    executor.remove_node(recorder)


def parser() -> argparse.ArgumentParser:
    """Parser of the command line."""
    reader = argparse.ArgumentParser(prog='record_play', description=__doc__)
    reader.add_argument(
        '-o',
        '--output',
        default=f'{datetime.now():play_%Y_%m_%d_%H_%M_%S}',
        help='folder to make; default: play_ with date and time',
    )
    reader.add_argument(
        '--balls',
        nargs='+',
        default=[],
        metavar='NAME',
        help='balls to follow from the start; others follow once the sim names them',
    )
    reader.add_argument('--namespace', help='namespace of the sim')
    reader.add_argument('--storage', choices=STORAGES, default='mcap')
    return reader


@in_pipes
def main(args: list[str] | None = None) -> int:
    """Record until a signal ends it; return the exit code."""
    args = sys.argv if args is None else args
    complete_environment()
    try:
        options = parser().parse_args(remove_ros_args(args)[1:])
    except RuntimeError as error:  # the base of all that rcl raises
        return failed(f'arguments for ROS: {explained(error)}', 2)
    ending = Ending()
    ending.be_patient()
    try:
        rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
        return recorded(options, ending)
    except (CannotRecord, NameValidationException, OSError, RuntimeError) as error:
        return failed(unsafe() or error, 1)
    finally:
        rclpy.try_shutdown()


def failed(reason: object, code: int) -> int:
    """Say in one line why nothing is recorded; return the exit code."""
    print(f'record_play: {" ".join(str(reason).split())}', file=sys.stderr)
    return code


def recorded(options: argparse.Namespace, ending: Ending) -> int:
    """Record one bag; return the exit code. Of one that fails before any message nothing stays."""
    bag = BagWriter(options.output, options.storage)
    try:
        recorder = Recorder(bag, options.namespace, options.balls)
        say(f'waiting for a sim in {recorder.get_namespace()}')
        try:
            record(recorder, ending)
        finally:
            recorder.complete()
            recorder.destroy_node()
    except BaseException:
        if not bag.count:
            bag.discard()
        raise
    say(f'{bag.count} messages in {bag.path}')
    return 0


if __name__ == '__main__':
    sys.exit(main())
