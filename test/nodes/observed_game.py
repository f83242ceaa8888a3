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

"""A `Game` without DDS, on a clock that only tests turn, and all that it publishes."""

import json
from types import SimpleNamespace
from unittest.mock import MagicMock

from golf_sim_ros.nodes.game import Game
from golf_sim_ros.nodes.parameters import Parameters
from golf_sim_ros.nodes.takeover import Takeover
from golf_sim_ros.physics import World
from golf_sim_ros.recording.journal import opened
from golf_sim_ros.recording.json_format import rejection_text, result_text
from golf_sim_ros.recording.replay import difference, rerun, shots, tick_of

LOOK = 0.002  # s that pass from one look at the clock to the next


class TurnedClock:
    """In place of `time.monotonic`: every look at it takes a little."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += LOOK
        return self.now


class Heard:
    """A `Listener` that keeps what matters here."""

    def __init__(self):
        self.entries, self.results, self.collisions, self.diagnosed = [], [], [], []

    def journal_entry(self, text):
        self.entries.append({**opened(text), 'received': 0})

    def collision(self, collision):
        self.collisions.append(collision)

    def result(self, result, shot):
        self.results.append(json.loads(result_text(result, shot)))

    def rejection(self, shot, ball, velocity, spin, reason):
        self.results.append(json.loads(rejection_text(shot, ball, velocity, spin, reason)))

    def path_begins(self, ball):
        pass

    def balls(self, balls, orientations, moving):
        assert moving <= set(balls) <= set(orientations)

    def scene(self, wind):
        pass

    def course(self):
        pass

    def diagnostics(self, slow, values):
        self.diagnosed.append((slow, values))


class ObservedGame:
    """A game on `course`.

    `results` and `entries` are all that it published of shots and of inputs.
    """

    def __init__(self, monkeypatch, course, balls=('ball',), factor=1.0, rate=250.0):
        self.clock = TurnedClock()
        monkeypatch.setattr('golf_sim_ros.nodes.real_time.monotonic', self.clock)
        self.given = Parameters(course='', balls=balls, real_time_factor=factor, rate=rate)
        self.world, self.heard = World(course, balls), Heard()
        self.entries, self.results, self.collisions = (
            self.heard.entries,
            self.heard.results,
            self.heard.collisions,
        )
        self.log, self.rejected_inputs = MagicMock(), MagicMock()
        takeover = Takeover(self.world, 'python', self.log)
        self.game = Game(
            self.world, self.heard, self.rejected_inputs, self.log, self.given, takeover
        )
        self.game.journal.config(self.world, self.given._asdict(), 0)

    def send(self, ball, velocity, spin=(0.0, 0.0, 0.0)):
        """Let a strike arrive."""
        self.game.inputs.append(lambda: self.game.strike(ball, velocity, spin))

    def step(self, count=1):
        """Let the timer call so often, 50 times a second."""
        for _ in range(count):
            self.clock.now += 0.02
            self.game.step()

    def play_on(self, patience=200000):
        """Step until no ball moves and nothing waits."""
        for _ in range(patience):
            self.step()
            if not self.world.moving and not self.game.inputs:
                return
        raise AssertionError('the balls go on and on')

    def differences(self):
        """Run each recorded shot again: what differs, None where nothing does."""
        recording = SimpleNamespace(
            journal=self.entries,
            config=self.entries[0],
            strikes=[],
            tracks={},
            results=self.results,
            collisions=[],
        )
        world, tick = World(self.world.course, self.given.balls), tick_of(recording)
        return [difference(recording, shot, rerun(world, shot, tick)) for shot in shots(recording)]
