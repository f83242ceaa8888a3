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

"""World: a course with balls on it, in time."""

from functools import partial
from math import inf
import re
from typing import Any, Callable, Iterable, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import placement, reporting
from .collision.workspace import INVOLVED, new_workspace
from .effects import choose, EffectNames, Scene, set_drift
from .engine.engines import checked_engine, compiled_engine, Program, PYTHON
from .engine.event_loop import LOG_FULL, STAGES
from .jit.build import Build, Part
from .kernel_types import BallRecord, Effects, Vector
from .live_parameters import checked_live, LIVE, live_values
from .mechanics.vector import ZERO
from .placement import NoPlace
from .reporting import Happening
from .result import objection, Result, three
from .scene import kernel_model as model_
from .scene.course_record import Course
from .scene.presets import Preset, preset
from .state.ball import (
    BALL,
    FLIGHT,
    HOLED,
    LAUNCH,
    moves,
    NO_PART,
    OUT,
    Phase,
    REST,
    ROLL,
    SLIDE,
    STEP_END,
    WATER,
)
from .state.events import new_log
from .state.serialize import plain, restored
from .trajectory.shot_record import begin_shot, fail, NOT_FINITE

RESERVED = {'shot', 'course', 'play', 'collisions', 'journal'}
PHASES = tuple(Phase)
PLACE_ANEW = ': place it anew, or reset'
GONE_FOR = {
    HOLED: 'holed' + PLACE_ANEW,
    OUT: 'out of bounds' + PLACE_ANEW,
    WATER: 'in the water' + PLACE_ANEW,
}


class Rejected(ValueError):
    """Strike that is rejected; the message says why."""


class BallState(NamedTuple):
    """State of a ball at the world's time: SI units, course frame.

    `lie` is the material under it.
    """

    position: Vector
    velocity: Vector
    spin: Vector
    phase: Phase
    lie: str


class World:
    """Balls on a course.

    Parameters
    ----------
    course : Course
    balls : sequence of str, or int
        Names, or how many (``ball_0``, ...).
    effects : 'auto' or sequence of str
        What to simulate; auto: what the scene calls for.
    accuracy : str or Preset
        'sketch', 'standard' or 'reference'.
    engine : str
        'python', 'compiled', or 'auto': plain Python, until it has taken so long that compiling is
        worth it.
    **live
        Live parameters by their effects' names, as ``wind=(3.0, 0.0, 0.0)``, velocity of the air
        10 m above the ground [m/s].

    Raises
    ------
    ValueError
        An unknown effect, accuracy or engine, a bad name, no place for the balls at the tee.
    jit.Unavailable
        There is no compiled engine here.
    """

    def __init__(
        self,
        course: Course,
        balls: Union[int, Sequence[str]] = ('ball',),
        effects: EffectNames = 'auto',
        accuracy: Union[str, Preset] = 'standard',
        *,
        engine: str = 'auto',
        **live: Iterable[float],
    ) -> None:
        self.course = course
        self.names = checked_names(balls)
        self._numbers = {name: number for number, name in enumerate(self.names)}
        self.time = 0.0
        self._asked = course.effects if effects in ('auto', ('auto',), ['auto']) else effects
        self._preset, self._accuracy = preset(accuracy), accuracy
        self._live = live_values(live)
        self._labels = reporting.Labels(self.names, model_.material_names(course), course.hole)
        self._log, self._now = new_log(64 + 16 * len(self.names)), 0.0
        self._events: list[Happening] = []
        # Of balls that could not go on: how many, and why.
        self.failures, self.last_failure = 0, ''
        self.shots = 0  # strikes that were taken; each is the number of its `Result`
        self._pegs: dict[int, Vector] = {}  # where each ball was teed, by number
        # Numbers of lost balls, which are dropped at the end of a call of the engine.
        self._lost: list[int] = []
        self._balls = np.zeros(len(self.names), BALL)
        engine = checked_engine(engine)
        self._engine = compiled_engine() if engine == 'compiled' else PYTHON
        # Of the compiled engine, if that may take over.
        self._program: Optional[Program] = None
        self._choose()
        self._workspace = new_workspace(len(self.names), 'ball_ball' in self.effects_on)
        self._use(model_.build_model(self.course, self._records, self._preset))
        if engine == 'auto':
            self._program = Program.of(self.program)
        self._tee_up()

    def _use(self, model: model_.Model) -> None:
        """Give the engine another `model`."""
        self._model = model
        self._packed = tuple(map(self._engine.pack, (model, self._workspace, self._log)))

    def _choose(self) -> None:
        """Choose the effects, and the records of them for the engine."""
        self._scene = Scene(self.course, len(self.names), self._live)
        self._chosen = choose(self._asked, self._scene)
        keeps_dormant = self._engine.keeps_dormant
        self._records = (
            self._chosen.with_dormant(self._scene) if keeps_dormant else self._chosen.records
        )

    @property
    def effects_on(self) -> tuple[str, ...]:
        """Names of the effects that are simulated at present."""
        return tuple(self._chosen.on)

    @property
    def effects_off(self) -> dict[str, str]:
        """Reasons, by name, of the effects that are not simulated at present."""
        return self._chosen.off

    @property
    def effects_needless(self) -> dict[str, str]:
        """Reasons, by name, of the effects that were asked for and that this scene can't have."""
        return self._chosen.needless

    def __getitem__(self, name: str) -> BallState:
        """`BallState` of the ball called `name`."""
        ball = self._ball(name)
        return BallState(
            three(ball['position']),
            three(ball['velocity']),
            three(ball['spin']),
            PHASES[ball['phase']],
            self._lie(ball),
        )

    def _ball(self, name: str) -> BallRecord:
        return self._balls[self._number(name)]

    def _number(self, name: str) -> int:
        if name not in self._numbers:
            raise ValueError(f'ball {name!r} is unknown; known: {", ".join(self.names)}')
        return self._numbers[name]

    def _lie(self, ball: BallRecord) -> str:
        if ball['phase'] == FLIGHT or ball['support'] < 0:
            return ''
        return self._labels.materials[ball['material']]

    @property
    def moving(self) -> bool:
        """Whether any ball moves."""
        return bool(self.in_motion)

    @property
    def in_motion(self) -> list[str]:
        """Names of the balls that move.

        Of the phases, flight is the first that does and rolling the last.
        """
        phases = self._balls['phase'].tolist()
        return [name for name, phase in zip(self.names, phases) if FLIGHT <= phase <= ROLL]

    @property
    def _is_moving(self) -> np.ndarray:
        """Mask of the balls that move."""
        return np.isin(self._balls['phase'], (FLIGHT, SLIDE, ROLL))

    def turn(self, orientations: np.ndarray, time: float) -> None:
        """Turn `orientations` as the balls turn in `time` [s].

        They are (n, 4), the balls' quaternions x, y, z, w.
        """
        self._engine.turn(orientations, self._balls, time)

    def _tee_up(self) -> None:
        """Tee up all balls side by side, on pegs that hold them until they are struck or hit."""
        self._balls['phase'], self._balls['end'] = HOLED, inf  # nowhere, until they are there
        self._balls['strokes'] = 0
        for number, place in enumerate(placement.tee_places(self.course, len(self.names))):
            try:
                self._put(number, place)
            except NoPlace as error:
                raise NoPlace(
                    placement.unfit(self.course.tee, self.names, number, error)
                ) from None
            self._pegs[number] = three(self._balls[number]['position'])

    def place(
        self,
        name: str,
        position: Iterable[float],
        velocity: Optional[Iterable[float]] = None,
        spin: Optional[Iterable[float]] = None,
    ) -> None:
        """Put a ball down: at (x, y) on the ground there, or exactly at (x, y, z).

        At (x, y) it comes down beside the flagstick where that stands in its way into the hole,
        and on no obstacle: where there is one, it is refused.

        With a `velocity` [m/s] or `spin` [rad/s] it sets off, without being struck.

        Raises
        ------
        ValueError
            Not finite or over 1e6 m away, no ground at (x, y), inside anything solid or another
            ball, in water.
        """
        number = self._number(name)
        position, velocity, spin = placement.checked_start(position, velocity, spin)
        self._put(number, position)
        ball = self._balls[number]
        ball['velocity'], ball['spin'] = velocity, spin
        ball['end'], ball['ending'] = self._now, LAUNCH
        self._let_happen(self._now)

    def _put(self, number: int, position: Sequence[float]) -> None:
        """Put a ball down, at rest; `NoPlace` where it is not free."""
        ball = placement.placed(self._site, self._balls, number, position)
        self._settle_clock()
        self._forget_tree()
        placement.lay(self._site, self._balls, number, ball, self._now)

    @property
    def _site(self) -> placement.Site:
        return placement.Site(
            self.course, self._model, self._engine.put_down, 'ball_ball' in self._chosen.on
        )

    def reset(self) -> list[Result]:
        """Put all balls back to the start.

        Returns
        -------
        list of Result
            Shots under way, with status 'aborted'.
        """
        self._end_segments(self._is_moving, self._now)
        self._let_happen(self._now)
        aborted = reporting.aborted(self._balls, self._labels, self._now, self.time)
        self._balls['phase'] = REST
        self._balls['shot_active'] = 0
        self._balls['support'] = NO_PART
        self._tee_up()
        return aborted

    def _drop(self, number: int, now: float) -> None:
        """Drop a lost ball.

        Moving balls begin new segments, or they would miss the ball in their way; time steps end
        soon anyway.
        """
        self._forget_tree()  # where it was is not where it will be
        placement.drop(self._site, self._balls, number, self._pegs[number], now)
        self._end_segments(self._is_moving & (self._balls['time_stepping'] == 0), now)

    def strike(self, name: str, velocity: Iterable[float], spin: Iterable[float] = ZERO) -> None:
        """Strike a resting ball: launch `velocity` [m/s] and `spin` [rad/s].

        Raises
        ------
        Rejected
            Not finite, all zero, over 150 m/s or 2500 rad/s, or the ball moves or is holed.
        """
        ball = self._ball(name)
        velocity, spin = tuple(map(float, velocity)), tuple(map(float, spin))
        reason = objection(velocity, spin)
        if not reason and ball['phase'] != REST:
            reason = f'ball {name} is {GONE_FOR.get(int(ball["phase"]), "in motion")}'
        if reason:
            raise Rejected(reason)
        self._settle_clock()
        self.shots += 1
        ball['shot'], ball['velocity'], ball['spin'] = self.shots, velocity, spin
        ball['strokes'] += 1
        begin_shot(ball, self._now)
        self._let_happen(self._now)

    def _settle_clock(self) -> None:
        """Reset the engine's clock to zero when nothing moves.

        So the same strikes give the same bits.
        """
        if not self.moving:
            if self._program:
                self._take_over(self._program)
            self._carry(0.0)
            self._now = 0.0
            self._forget_tree()  # or its shape would depend on the play before

    def _carry(self, now: float) -> None:
        """Let the wind carry what it does up to now, which is `now` on the clock from here."""
        for effect, of in LIVE.items():
            if of.carried:
                self._live[effect] = value = of.carried(self._live, self._now, now)
                x, y, time = value[-3:]
                set_drift(self._model.effects, (x, y, time))

    def _forget_tree(self) -> None:
        """Let the engine build the tree of the balls' boxes anew."""
        self._workspace.tree.age[0] = len(self.names)

    def advance(self, dt: float) -> list[Happening]:
        """Advance the world by `dt` seconds.

        Returns
        -------
        list of Collision and Result
            What happened, in order of time.
        """
        self._let_happen(self._now + dt)
        self.time += dt
        self._now += dt
        return self.happened()

    def happened(self) -> list[Happening]:
        """Take the events of a strike, a placement or a reset.

        Else the next `advance` returns them first. A ball that is struck too weakly to move ends
        its shot within the strike.

        Returns
        -------
        list of Collision and Result
        """
        events, self._events = self._events, []
        return events

    def _let_happen(self, until: float) -> None:
        """Run the engine up to `until` on its own clock, and keep the events that it logs."""
        if self._balls['end'].min() == inf:  # nothing will ever end: all balls rest
            return
        start = self.time - self._now
        while True:
            status = self._run(until)
            self._take_report(start)
            if status == LOG_FULL:
                continue
            if not self._lost:
                break
            for number in self._lost:
                self._drop(number, until)
            self._lost.clear()

    def _run(self, until: float) -> int:
        """Run the engine; where plain Python raises an arithmetic error, the involved balls fail.

        Compiled code goes on with what is not a number, and finds it at the segment's end.
        """
        run = self._engine.advance
        if self._program:
            run = partial(self._program.timed, run)
        model, work, log = self._packed
        try:
            return run(model, self._balls, until, work, log)
        except (ArithmeticError, ValueError):
            at_hand = self._workspace.involved[: self._workspace.counts[INVOLVED]].tolist()
            if not at_hand:
                raise
        self._fail(at_hand, min(until, self._workspace.segment_ends[at_hand[0]]))
        return LOG_FULL

    def _fail(self, numbers: Sequence[int], now: float) -> None:
        """Fail the balls of these `numbers` that move, the first one at least."""
        for number in numbers:
            ball = self._balls[number]
            if number == numbers[0] or moves(ball['phase']):
                fail(ball, number, now, NOT_FINITE, self._log)
                ball['end'] = inf
            self._workspace.involved_index[number] = -1
        self._workspace.counts[:] = 0
        self._forget_tree()

    def _take_report(self, start: float) -> None:
        """Take what the engine has logged.

        `start` is the world's time at the zero of the engine's clock.
        """
        if not self._log.count[0]:
            return
        events, lost, failures = reporting.report(self._log, self._balls, self._labels, start)
        self._events += events
        self._lost += lost
        self.failures += len(failures)
        self.last_failure = failures[-1] if failures else self.last_failure

    def _end_segments(self, which: np.ndarray, now: float) -> None:
        """End the segments of those balls, a mask, `now`."""
        self._balls['end'][which], self._balls['ending'][which] = now, STEP_END

    def set_wind(self, wind: Iterable[float]) -> None:
        """Set the wind [m/s] at 10 m over the ground from now on.

        Raises
        ------
        ValueError
            Not finite, or over 100 m/s.
        """
        self.set_live('wind', wind)

    @property
    def live(self) -> dict[str, tuple[float, ...]]:
        """Live parameters at present, by the effect's name."""
        return dict(self._live)

    def set_live(self, effect: str, value: Any) -> None:
        """Set the live parameter of an effect, by its name, from now on.

        Raises
        ------
        ValueError
            It has none, or this is no value for it.
        """
        value = checked_live(effect, value)
        if value == self._live[effect]:
            return
        self._carry(self._now)
        self._live[effect] = value
        self._choose()
        self._use(model_.with_effects(self._model, self._records))
        self._begin_new_segments(self._is_moving)
        self._wake()

    @property
    def accuracy(self) -> Union[str, Preset]:
        """Name of the accuracy preset; may be set while balls move."""
        return self._accuracy

    @accuracy.setter
    def accuracy(self, accuracy: Union[str, Preset]) -> None:
        self._preset, self._accuracy = preset(accuracy), accuracy
        self._use(model_.build_model(self.course, self._records, self._preset))
        self._begin_new_segments(self._balls['phase'] == FLIGHT)

    def _begin_new_segments(self, which: np.ndarray) -> None:
        """End the segments of those balls, a mask, now: their surroundings have changed."""
        self._end_segments(which, self._now)
        self._balls['last_stage_time'][which] = -1.0

    def _wake(self) -> None:
        """Let balls that rest on the ground set off if they can.

        But for those on their pegs, and those that failed: they are held where they are.
        """
        resting = (self._balls['phase'] == REST) & (self._balls['support'] >= 0)
        resting &= (self._balls['sleeps_on_ball'] == 0) & (self._balls['failed'] == 0)
        for number in np.flatnonzero(resting):
            if three(self._balls[number]['position']) != self._pegs.get(int(number)):
                placement.set_off(self._balls[number], self._now)

    @property
    def engine(self) -> str:
        """Engine that runs the physics: 'python' or 'compiled'; may be set, also while balls move.

        Setting 'compiled' loads what is needed, or compiles it in this process: up to a minute;
        see `build`.
        """
        return self._engine.name

    @engine.setter
    def engine(self, name: str) -> None:
        self._program = None
        if name != self.engine:
            self._engine = {'python': PYTHON}.get(name) or compiled_engine()
            self._choose()
            self._use(model_.build_model(self.course, self._records, self._preset))

    @property
    def program(self) -> str:
        """Key of the machine code that the compiled engine needs: the types of the records."""
        return self._types(self._chosen.with_dormant(self._scene))

    @property
    def types(self) -> str:
        """Names of the types of the present records, which decide what machine code they need."""
        return self._types(self._records)

    def _types(self, records: Effects) -> str:
        types = map(
            type, (*records, self._preset.method, *self._model.land.ground.kinds, self._workspace)
        )
        return ' '.join(f'{kind.__module__}.{kind.__qualname__}' for kind in types)

    @property
    def part(self) -> Part:
        """Program of this world's compiled engine, for a `jit.build.Build`."""
        return Part(self.program, exercise, (self.course, self.names, self._asked, self._preset))

    def build(self, urgent: bool = False) -> Build:
        """`jit.build.Build` of the compiled engine, started now unless it has been before."""
        return Program.of(self.program).built(urgent, *self.part[1:])

    def _take_over(self, program: Program) -> None:
        """Switch to the compiled engine if `program` is ready; start its build if that pays."""
        if program.is_ready:
            self.engine = 'compiled'
        elif program.build is None and program.is_worth_compiling():
            self.build()

    def measure(self) -> None:
        """Start to measure where the engine's time goes; see `spent`."""
        self._workspace = self._workspace._replace(spent=np.zeros(len(STAGES), np.int64))
        self._use(self._model)

    @property
    def spent(self) -> dict[str, int]:
        """Processor's cycles that the engine has spent since `measure`, by stage.

        See `cycles_now`.
        """
        return dict(zip(STAGES, self._workspace.spent.tolist()))

    def state(self, written: Callable[[BallRecord], Any] = plain) -> dict[str, Any]:
        """State of the world, all that decides how the play goes on, as plain data; see `restore`.

        `written` serialises a `BALL` record.
        """
        balls = {name: written(ball) for name, ball in zip(self.names, self._balls)}
        return {
            'time': self.time,
            'clock': self._now,
            'engine': self.engine,
            'accuracy': self.accuracy,
            **{effect: list(value) for effect, value in self._live.items()},
            'balls': balls,
        }

    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore the `state` of a world on the same course, with the same effects.

        It goes on from there, to the bit, if the engine is the same; it stays as it is.

        Raises
        ------
        KeyError, TypeError, ValueError
            It is no state of such a world.
        """
        if state['accuracy'] != self.accuracy:
            self.accuracy = state['accuracy']
        # What a recording does not know yet was at its default.
        live = {effect: state.get(effect, of.default) for effect, of in LIVE.items()}
        self._live = live_values(live)
        self._choose()
        self._use(model_.with_effects(self._model, self._records))
        self._balls[:] = [restored(state['balls'][name]) for name in self.names]
        self.time, self._now, self._events = float(state['time']), float(state['clock']), []
        self._forget_tree()


def check_tee(course: Course) -> None:
    """Check that a ball can lie on the course's tee, whatever its effects.

    `NoPlace` where it can't.
    """
    World(course._replace(effects='auto'), engine='python')


def checked_names(balls: Union[int, Sequence[str]]) -> tuple[str, ...]:
    """Names of `balls`, a number or a sequence of names; ValueError where one is not allowed."""
    names = tuple(f'ball_{i}' for i in range(balls)) if isinstance(balls, int) else tuple(balls)
    reserved = RESERVED | LIVE.keys()
    for name in names:
        if not re.fullmatch('[a-z][a-z0-9_]*', name) or name in reserved:
            raise ValueError(
                f'ball name {name!r} is not allowed: lower-case letters, digits and _, '
                f'not {", ".join(sorted(reserved))}'
            )
    if not names or len(set(names)) < len(names):
        raise ValueError(f'ball names {names} must be at least one and all different')
    return names


def exercise(
    course: Course, names: Sequence[str], effects: EffectNames, accuracy: Union[str, Preset]
) -> None:
    """Run all that a play of the compiled engine may need.

    That compiles it, or loads it from the cache.
    """
    world = World(course, names, effects, accuracy, engine='compiled')
    world.strike(names[0], (1.0, 0.0, 1.0))
    world.advance(0.0)
    world.turn(np.zeros((len(names), 4)), 0.0)
