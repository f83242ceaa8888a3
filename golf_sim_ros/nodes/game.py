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

"""The game in time: inputs are applied between ticks, what happens is published and logged."""

from collections.abc import Callable, Iterable
from time import perf_counter, process_time

import numpy as np
from rclpy.impl.rcutils_logger import RcutilsLogger

from . import log_lines
from .conversions import Vector
from .diagnostics import Diagnostics, SLOW
from .listener import Listener
from .parameters import Parameters
from .real_time import RealTime
from .rejected_inputs import RejectedInputs
from .takeover import Takeover
from ..physics import Collision, Rejected, Result, World
from ..physics.engine.orientation import UPRIGHT
from ..physics.live_parameters import checked_live
from ..recording.journal import Journal
from ..recording.json_format import state_text

CATCH_UP = 0.25  # s of wall time that a step makes up while a ball moves
REST_CATCH_UP = 2.0  # the same at rest, when steps are a second apart and cost little
BUSY = 0.95  # of the time between steps goes to simulating as fast as it can
LONGEST_BUSY = 0.1  # s without a look at what arrived
SCENE_RATE = 10.0  # play markers a second: they are large, and eyes are slow


class Game:
    """A world that follows the wall clock.

    Parameters
    ----------
    world : World
    listener : listener.Listener
        Hears all that happens.
    rejected_inputs : RejectedInputs
        Warns of inputs that are rejected.
    log : rclpy.impl.rcutils_logger.RcutilsLogger
        Gets one line for each shot.
    given : Parameters
        Its rates are those of ticks and of steps.
    takeover : Takeover
        Notes what the play costs, and decides between shots which engine goes on.
    """

    def __init__(
        self,
        world: World,
        listener: Listener,
        rejected_inputs: RejectedInputs,
        log: RcutilsLogger,
        given: Parameters,
        takeover: Takeover,
    ) -> None:
        self.world = world
        self.listener = listener
        self.rejected_inputs = rejected_inputs
        self.log = log
        self.takeover = takeover
        self.real_time = RealTime(
            1.0 / given.rate,
            max(1, round(given.rate / given.publish_rate)),
            given.real_time_factor,
        )
        self.busy = min(BUSY / given.publish_rate, LONGEST_BUSY)
        self.keeps_time = given.publish_clock
        self.journal = Journal(listener.journal_entry)
        self.ticks = 0
        self.diagnostics = Diagnostics()
        world.measure()
        self.steps_a_scene = max(1, round(given.publish_rate / SCENE_RATE))
        self.steps = self.shots = 0  # shots: strikes taken or rejected
        # Of strikes under way, by those of the world, which counts only what it accepts.
        self.numbers: dict[int, int] = {}
        self.inputs: list[Callable[[], None]] = []
        # Live parameters of effects, as last received.
        self.live: dict[str, tuple[float, ...]] = {}
        self.paused = self.stood_still = False  # now, and at any time since the last diagnostics
        self.failures = 0  # of balls that could not be simulated further, as last published
        # When the last advance began.
        self.began = perf_counter()
        self.spent = process_time()
        self.turned = np.tile(UPRIGHT, (len(world.names), 1))
        self.orientations = dict(zip(world.names, self.turned))  # the same numbers, by name
        self.awake: set[str] = set()  # balls whose pose was still changing when last published
        self.course_due = self.all_due = True

    @property
    def asleep(self) -> bool:
        """Whether nothing changes until an input arrives."""
        stands_still = self.real_time.hurries or not self.keeps_time
        return self.paused or stands_still and not self.world.moving

    def step(self) -> None:
        """Advance by the time that has passed on the clock, apply what arrived, publish."""
        self.advance()
        if not self.world.moving:
            self.takeover.between_shots()
        if not self.paused:
            self.apply()
        with self.diagnostics.publishing():
            self.notify()

    def advance(self) -> None:
        """Advance by as many whole ticks as are due; where they are many, publish in between."""
        passed, spent = perf_counter() - self.began, process_time() - self.spent
        self.began, self.spent = self.began + passed, self.spent + spent
        if self.paused:
            self.stood_still = True
            self.real_time.skip()
            return
        moving = self.world.moving
        if self.real_time.hurries and not moving:
            self.real_time.skip()
            return
        if moving:
            self.takeover.note(spent, passed)
        self.do_ticks(moving)

    def do_ticks(self, moving: bool) -> None:
        """Advance by the ticks that are due, publishing in between where they are many."""
        time, done = self.real_time, 0
        for publishes_first in time.ticks(CATCH_UP if moving else REST_CATCH_UP, self.busy):
            if publishes_first and self.world.moving:
                with self.diagnostics.publishing():
                    self.notify_balls()
            self.tick()
            done += 1
            if time.hurries and not self.world.moving:
                return
        if moving and not time.hurries:
            self.diagnostics.count(done, time.usual * time.factor)

    def tick(self) -> None:
        """Advance by one tick and publish its events."""
        began = perf_counter()
        events = self.world.advance(self.real_time.tick)
        self.ticks += 1
        self.diagnostics.note_tick(perf_counter() - began)
        self.world.turn(self.turned, self.real_time.tick)
        if events:
            with self.diagnostics.publishing():
                self.notify_events(events)

    def notify_events(self, events: Iterable[Collision | Result]) -> None:
        """Publish collisions and ends of shots."""
        for event in events:
            if isinstance(event, Result):
                self.finish(event)
            else:
                self.listener.collision(event)

    def apply(self) -> None:
        """Apply the inputs that arrived, in order; the wind first, so that a shot starts in it."""
        for effect, value in self.live.items():
            if value != self.world.live[effect]:
                self.world.set_live(effect, value)
                if self.world.moving:
                    self.journal.note(effect, self.ticks, **{effect: value})
        inputs, self.inputs = self.inputs, []
        for act in inputs:
            act()
            self.notify_events(self.world.happened())

    def set_live(self, effect: str, value: tuple[float, ...]) -> None:
        """Take the newest live parameter of an effect, such as wind; the next step applies it."""
        self.live[effect] = checked_live(effect, value)

    def strike(self, name: str, velocity: Vector, spin: Vector) -> None:
        """Strike a ball; a rejected shot has its result at once."""
        self.shots += 1
        before = state_text(self.world)
        try:
            self.world.strike(name, velocity, spin)
        except Rejected as error:
            self.listener.rejection(self.shots, name, velocity, spin, str(error))
            self.rejected_inputs.warn('shot', f'{name}: {error}')
            return
        self.numbers[self.world.shots] = self.shots
        self.journal.strike(self.ticks, self.shots, name, (velocity, spin), before)
        self.listener.path_begins(name)

    def place(self, name: str, point: Vector) -> None:
        """Put a resting ball on the ground at the x and y of `point`."""
        try:
            if name in self.world.in_motion:
                raise ValueError('it is in motion')
            self.world.place(name, point[:2])
        except ValueError as error:
            self.rejected_inputs.warn('place', f'{name}: {error}')
            return
        self.journal.note('place', self.ticks, ball=name, position=point[:2])
        self.listener.path_begins(name)
        self.all_due = True

    def reset(self) -> None:
        """Put all balls back to the start; shots under way end as aborted."""
        aborted = self.world.reset()
        self.journal.note('reset', self.ticks)
        self.notify_events([*self.world.happened(), *aborted])
        self.turned[:] = UPRIGHT
        for name in self.world.names:
            self.listener.path_begins(name)
        self.all_due = True

    def finish(self, result: Result) -> None:
        """Publish and log the end of a shot."""
        self.awake.add(result.ball)
        shot, ball = self.numbers.pop(result.shot), self.world[result.ball]
        self.journal.rest(self.ticks, shot, result, ball)
        if result.status in ('out_of_bounds', 'water', 'failed'):
            self.journal.note('drop', self.ticks, ball=result.ball, position=ball.position)
        self.listener.result(result, shot)
        if result.status == 'failed':
            self.log.error(
                f'shot {shot} failed, and {result.ball} is back where it was struck: '
                f'{result.reason}'
            )
        else:
            self.log.info(log_lines.line(result))

    def set_accuracy(self, accuracy: str) -> None:
        """Set the accuracy of the simulation from now on."""
        self.world.accuracy = accuracy
        if self.world.moving:
            self.journal.note('accuracy', self.ticks, accuracy=accuracy)

    def set_real_time_factor(self, factor: float) -> None:
        """Set how many times as fast as the clock simulated time passes from now on."""
        self.advance()
        self.real_time.factor = factor

    def notify(self) -> None:
        """Publish time, balls that move or have just stopped, and markers where they are due."""
        scene_due = self.scene_due()
        self.notify_balls(self.all_due)
        if scene_due:
            self.listener.scene(self.world.live['wind'])
        if self.course_due:
            self.listener.course()
        self.all_due = self.course_due = False

    def notify_balls(self, all_of_them: bool = False) -> None:
        """Publish the time, and balls that move or have just stopped."""
        moving = set(self.world.in_motion)
        balls = {
            name: self.world[name]
            for name in (self.world.names if all_of_them else moving | self.awake)
        }
        self.listener.balls(balls, self.orientations, moving)
        self.awake = moving

    def scene_due(self) -> bool:
        """Whether the markers of the play are due.

        `SCENE_RATE` a second, and whenever balls stop.
        """
        self.steps += 1
        moving = set(self.world.in_motion)
        in_turn = self.steps % self.steps_a_scene == 0
        return self.all_due or self.awake != moving or bool(moving) and in_turn

    def diagnose(self) -> None:
        """Publish how well simulated time keeps up with the clock."""
        self.diagnostics.mark(self.world)
        slow = self.diagnostics.factor < SLOW * self.real_time.factor and not self.stood_still
        self.stood_still = self.paused
        failures = self.world.failures
        if failures > self.failures:
            self.log.error(
                f'{failures} balls could not go on so far; the last: {self.world.last_failure}'
            )
        self.failures = failures
        if slow:
            self.log.warning(
                f'slower than the clock: {self.diagnostics.factor:.3g} simulated seconds a second '
                f'instead of {self.real_time.factor:g}; no tick is left out, the play is the same',
                throttle_duration_sec=1.0,
            )
        self.listener.diagnostics(
            slow,
            {**self.diagnostics.values(self.world, self.real_time.lost), **self.takeover.values()},
        )
