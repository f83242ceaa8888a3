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

"""The node that plays: subscribes to shots and wind, publishes the play."""

from collections.abc import Callable, Sequence
from functools import partial
import sys
from time import perf_counter
from typing import Any, Optional

from geometry_msgs.msg import PointStamped, Twist, Vector3Stamped
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_policy_name_from_kind, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription
from std_srvs.srv import SetBool, Trigger

from .conversions import triple
from .game import Game
from .lifecycle import run
from .log_lines import effect_lines, with_reasons
from .memory import give_back_memory
from .older_rclpy import after_set, SubscriptionEventCallbacks, UnsupportedEventTypeError
from .parameters import checked, declared, Parameters, PROGRAM
from .publishers import Publishers
from .rejected_inputs import RejectedInputs
from .takeover import load_compiled, Takeover
from ..course import load_course
from ..physics import World
from ..physics.effects.turbulence import box_of

COMMANDS = QoSProfile(depth=10)  # reliable: every strike counts
# Asks for the least, so it matches every publisher; only the newest wind counts.
NEWEST = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
LONGEST_SHOWN = 80  # characters of what was sent, in the log
HEARTBEAT = 0.5  # s from one to the next
EXAMPLE = '{linear: {x: 65.0, z: 14.0}, angular: {y: -280.0}}'


class SimNode(Node):
    """The node `golf_sim`: callbacks store what arrives, one timer advances the game.

    Parameters
    ----------
    context : rclpy.context.Context, optional
    namespace : str, optional
    parameter_overrides : list of rclpy.parameter.Parameter, optional

    Raises
    ------
    ValueError
        A parameter or the course cannot be used; the message is one line.
    """

    def __init__(
        self,
        *,
        context: Optional[Context] = None,
        namespace: str | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            'golf_sim',
            context=context,
            namespace=namespace,
            parameter_overrides=parameter_overrides,
        )
        given = declared(self)
        self.world = self.new_world(given)
        self.frame = given.frame_id
        self.rejected_inputs = RejectedInputs(self.get_logger())
        self.topics = Publishers(self, self.world, given, self.on_viewer, self.on_follower)
        takeover = Takeover(self.world, given.engine, self.get_logger())
        self.game = Game(
            self.world, self.topics, self.rejected_inputs, self.get_logger(), given, takeover
        )
        self.game.journal.config(
            self.world, given._asdict(), self.topics.began, self.topics.session
        )
        self.subscribe(given)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.timer = self.create_timer(1.0 / given.publish_rate, self.on_timer, clock=steady)
        self.beat = self.create_timer(1.0, self.on_beat, clock=steady)
        self.heart = self.create_timer(HEARTBEAT, self.on_heartbeat, clock=steady)
        give_back_memory()
        self.introduce()

    def new_world(self, given: Parameters) -> World:
        """Make the `World` as `given`, ready: no shot shall wait for a compiler."""
        began = perf_counter()
        world = World(
            load_course(given.course),
            given.balls,
            given.effects,
            given.accuracy,
            engine='python',
            turbulence=(given.turbulence, given.turbulence_seed),
        )
        if given.turbulence > 0.0:
            box_of(given.turbulence_seed)  # 13 MB are kept; making it takes 0.2 s and 100 MB
        if given.engine == 'compiled':
            load_compiled(world, self.get_logger())
        self.get_logger().info(
            f'physics loaded in {perf_counter() - began:.1f} s, engine {world.engine}'
        )
        return world

    def subscribe(self, given: Parameters) -> None:
        """Create the inputs: subscriptions, services, live parameters."""
        first = self.world.names[0]
        self.strikes = self.hear_strikes('shot', first)
        for name in self.world.names:
            self.hear_strikes(f'{name}/shot', name)
            self.create_subscription(
                PointStamped, f'{name}/place', partial(self.on_place, name), COMMANDS
            )
        self.create_subscription(Vector3Stamped, 'wind', self.on_wind, NEWEST)
        self.create_service(Trigger, '~/reset', self.on_reset)
        self.create_service(SetBool, '~/pause', self.on_pause)
        self.add_on_set_parameters_callback(partial(checked, given.publish_clock))
        after_set(self, self.on_parameters)

    def hear_strikes(self, topic: str, name: str) -> Subscription:
        """Subscribe to strikes of a ball.

        Those that do not arrive are reported, where DDS knows of them.
        """
        on_strike = partial(self.on_shot, name)
        events = {
            'incompatible_qos': partial(self.on_unheard, topic),
            'message_lost': self.on_lost,
        }
        try:
            callbacks = SubscriptionEventCallbacks(**events)
            return self.create_subscription(
                Twist, topic, on_strike, COMMANDS, event_callbacks=callbacks
            )
        except UnsupportedEventTypeError:  # a middleware that cannot report it
            return self.create_subscription(Twist, topic, on_strike, COMMANDS)

    def on_unheard(self, topic: str, event: Any) -> None:
        """Warn of a publisher of strikes whose QoS does not match."""
        if event.total_count_change > 0:
            policy = qos_policy_name_from_kind(event.last_policy_kind)
            self.get_logger().warning(
                f'a publisher of {topic} is not heard: its {policy} does not match; '
                'strikes must be published reliable'
            )

    def on_lost(self, event: Any) -> None:
        """Count strikes that arrived and were dropped before a callback got them."""
        self.game.diagnostics.strikes_lost += event.total_count_change

    def introduce(self) -> None:
        """Log what is played, what is simulated, and how to strike."""
        log, world = self.get_logger(), self.world
        log.info(f'course: {world.course.name} ({world.course.path})')
        for note in world.course.notes:
            log.info(note)
        for line in effect_lines(world):
            log.info(line)
        if world.effects_needless:
            log.warning(
                f'asked for, but nothing here calls for it: {with_reasons(world.effects_needless)}'
            )
        log.info(
            'ready; to strike the ball, paste: ros2 topic pub --once '
            f"{self.strikes.topic_name} geometry_msgs/msg/Twist '{EXAMPLE}'"
        )

    def on_shot(self, name: str, message: Twist) -> None:
        """Store a strike for the next step."""
        self.store(
            partial(self.game.strike, name, triple(message.linear), triple(message.angular))
        )

    def on_place(self, name: str, message: PointStamped) -> None:
        """Store a place for the next step."""
        if self.in_frame('place', message):
            self.store(partial(self.game.place, name, triple(message.point)))

    def on_wind(self, message: Vector3Stamped) -> None:
        """Store the wind; it blows from the next step on."""
        if not self.in_frame('wind', message):
            return
        try:
            self.game.set_live('wind', triple(message.vector))
        except ValueError as error:
            self.rejected_inputs.warn('wind', str(error))
            return
        self.game.diagnostics.note_wind()

    def in_frame(self, kind: str, message: Any) -> bool:
        """Whether `message` is in the frame of the course, or in none; if not, it is rejected."""
        frame = message.header.frame_id
        if frame in ('', self.frame):
            return True
        shown = frame if len(frame) <= LONGEST_SHOWN else f'{frame[:LONGEST_SHOWN]}...'
        self.rejected_inputs.warn(kind, f'frame {shown!r} is not {self.frame!r}')
        return False

    def on_viewer(self) -> None:
        """Publish the course once more, for a new subscription."""
        self.game.course_due = True
        self.wake()

    def on_follower(self) -> None:
        """Publish where the balls are, for a new subscription."""
        self.game.all_due = True
        self.wake()

    def on_reset(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Put all balls back, after the inputs that arrived before."""
        self.game.inputs.append(self.game.reset)
        self.game.apply()
        self.wake()
        response.success, response.message = True, 'every ball is back at the start'
        return response

    def on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        """Pause simulated time, or let it go on."""
        self.game.advance()
        self.game.paused = request.data
        self.wake()
        response.success, response.message = True, 'paused' if request.data else 'playing'
        return response

    def on_parameters(self, parameters: Sequence[Parameter]) -> None:
        """Apply the parameters that may change while the node runs."""
        for parameter in parameters:
            if parameter.name == 'accuracy':
                self.game.set_accuracy(parameter.value)
            elif parameter.name == 'real_time_factor':
                self.game.set_real_time_factor(parameter.value)
                self.wake()

    def store(self, act: Callable[[], None]) -> None:
        """Store `act`, to be called by the next step."""
        self.game.inputs.append(act)
        self.wake()

    def wake(self) -> None:
        """Start the timer.

        One that runs is left alone, or a flood of messages would hold it up.
        """
        if self.timer.is_canceled():
            self.timer.reset()

    def on_timer(self) -> None:
        """Do one step; at rest stop the timer, so that a ball at rest costs next to nothing."""
        self.game.step()
        if self.game.asleep:
            self.timer.cancel()

    def on_heartbeat(self) -> None:
        """Publish the heartbeat; a node that hangs does not."""
        self.topics.heartbeat(self.game.shots, self.game.paused)

    def on_beat(self) -> None:
        """Publish everything, and the diagnostics: once a second, moving or not."""
        self.game.all_due = True
        self.game.step()
        self.game.diagnose()


def main(args: list[str] | None = None) -> int:
    """Run the simulator until a signal ends it; return the exit code."""
    return run(SimNode, PROGRAM, args)


if __name__ == '__main__':
    sys.exit(main())
