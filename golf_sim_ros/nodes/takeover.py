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

"""When the compiled engine takes over from plain Python.

Where the play calls for it, between shots.
"""

from rclpy.impl.rcutils_logger import RcutilsLogger

from ..physics import EngineUnavailable, World
from ..physics.jit.build import Build, BUILD_FAILED, missing, READY

A_THIRD = 1.0 / 3.0  # of a core, for a play: above that a compiler is worth its while
LEAST = 2.0  # s of motion before the share means anything
MOST = 20.0  # s of motion that count: older ones less and less
WAITS_TO_TELL = 5.0  # s between two lines in the log about how far the compiler is


class Takeover:
    """Decides which engine plays, and says why.

    Parameters
    ----------
    world : World
        Whose engine is 'python' or 'compiled'.
    wanted : str
        'auto': plain Python until it takes more than a third of a core while balls move; else as
        it is.
    log : rclpy.impl.rcutils_logger.RcutilsLogger
        Gets a line for each change of engine.
    """

    def __init__(self, world: World, wanted: str, log: RcutilsLogger) -> None:
        self.world = world
        self.log = log
        self.build: Build | None = None
        self.is_open = wanted == 'auto'
        self.spent = self.passed = 0.0  # s of processor and of wall time while balls moved
        self._why = f'asked for: {wanted}'

    @property
    def why(self) -> str:
        """One line on why the engine is what it is."""
        if not self.is_open:
            return self._why
        taken = f'the play in plain Python takes {self.share:.0%} of a core'
        if self.build is None or self.build.state in (READY, BUILD_FAILED):
            return taken
        return f'{taken}; {self.build.state}, {self.build.progress:.0%} done'

    @property
    def share(self) -> float:
        """Share of a core that this process takes while balls move, 0 before that is known."""
        return self.spent / self.passed if self.passed > LEAST else 0.0

    def note(self, spent: float, passed: float) -> None:
        """Note the processor time [s] `spent` by this process in `passed` [s] of moving balls."""
        if not self.is_open:
            return
        if self.passed > MOST:
            self.spent, self.passed = 0.5 * self.spent, 0.5 * self.passed
        self.spent, self.passed = self.spent + spent, self.passed + passed
        if self.build is None and self.share > A_THIRD:
            self.call_for_compiler()

    def call_for_compiler(self) -> None:
        """Have the compiled engine built meanwhile.

        Where there can be none, log what to install.
        """
        if missing():
            self.stay(missing())
            return
        self.build = self.world.build()
        self.log.info(f'{self.why}: a child process compiles the physics, and the play goes on')

    def stay(self, reason: str) -> None:
        """Stay with plain Python for good."""
        self.log.warning(f'{self.why}, and goes on so: {reason}')
        self.is_open, self._why = False, reason

    def between_shots(self) -> None:
        """Take over if the compiled engine is ready; to be called while every ball rests."""
        if not self.is_open or self.build is None or not self.build.wait(0.0):
            return
        if self.build.state == BUILD_FAILED:
            self.stay(self.build.reason)
            return
        self.world.engine, self.is_open = 'compiled', False
        self._why = f'the play in plain Python took {self.share:.0%} of a core'
        self.log.info(f'the compiled engine takes over: {self._why}')

    def values(self) -> dict[str, str]:
        """Values for the diagnostics, texts by name."""
        return {'engine': self.world.engine, 'engine, why': self.why}


def load_compiled(world: World, log: RcutilsLogger) -> None:
    """Let `world` run on the compiled engine, waiting for the compiler if need be.

    Raises
    ------
    ValueError
        There is none here; the message says why.
    """
    build = world.build(urgent=True)
    while not build.wait(WAITS_TO_TELL):
        log.info(
            f'waiting for the physics to be compiled, once a machine: {build.progress:.0%} done'
        )
    if build.state == BUILD_FAILED:
        raise ValueError(f"engine 'compiled' cannot be had: {build.reason}")
    try:
        world.engine = 'compiled'
    except EngineUnavailable as error:
        raise ValueError(f"engine 'compiled' cannot be had: {error}") from None
