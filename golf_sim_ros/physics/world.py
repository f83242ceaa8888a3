# SPDX-License-Identifier: Apache-2.0
"""World: a course with balls on it, in time."""
from functools import partial
import re
from math import atan2, cos, hypot, inf, isfinite, pi, sin
from typing import NamedTuple

import numpy as np

from .collision.ground_contact import RESTING_GAP
from .collision.workspace import TREE_AGE, INVOLVED, new_workspace
from .effects import Scene, choose
from .engine.engines import PYTHON, Program, checked_engine, compiled_engine
from .engine.event_loop import LOG_FULL, STAGES
from .geometry import surfaces
from .geometry.solid import FLAGSTICK_RADIUS, without
from .jit.build import Part
from .mechanics.vector import ZERO
from .result import Collision, COLLISION_KINDS, failure, objection, result, three
from .scene import kernel_model as model_
from .scene.presets import preset
from .state.ball import (BALL, FAILED, FLIGHT, HOLED, LAUNCH, NO_PART, OUT, Phase, REST, ROLL, SLIDE,
                         STEP_END, WATER, moves)
from .state.events import BALL_HIT, WENT_OUT, LOST, SHOT_ENDS, WATER_HIT, new_log
from .state.serialize import plain, plain_rows, restored
from .trajectory.shot_record import NOT_FINITE, fail, begin_shot

APART = 0.5  # m between balls on the tee
CLEAR = 2.2  # radii from centre to centre, of a ball that is dropped beside another
FARTHEST = 1e6  # m: the same limit as in course files
FALL = 1e4  # m: how far down ground is searched
RESERVED = {'shot', 'wind', 'course', 'play', 'collisions', 'journal'}
PHASES = tuple(Phase)
MOST_WIND = 100.0  # m/s
PLACE_ANEW = ': place it anew, or reset'
GONE_FOR = {HOLED: 'holed' + PLACE_ANEW, OUT: 'out of bounds' + PLACE_ANEW,
            WATER: 'in the water' + PLACE_ANEW}


class Rejected(ValueError):
    """Strike that is rejected; the message says why."""


class NoPlace(ValueError):
    """Place where a ball can't be put; the message says why."""


class BallState(NamedTuple):
    """State of a ball at the world's time: SI units, course frame; `lie` is the material under it."""

    position: tuple
    velocity: tuple
    spin: tuple
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
    wind : (float, float, float)
        Velocity of the air 10 m above the ground [m/s].
    engine : str
        'python', 'compiled', or 'auto': plain Python, until it has taken so long that compiling is worth it.

    Raises
    ------
    ValueError
        An unknown effect, accuracy or engine, a bad name, no place for the balls at the tee.
    jit.Unavailable
        There is no compiled engine here.
    """

    def __init__(self, course, balls=('ball',), effects='auto', accuracy='standard', wind=ZERO,
                 engine='auto'):
        self.course = course
        self.names = checked_names(balls)
        self._numbers = {name: number for number, name in enumerate(self.names)}
        self.time = 0.0
        self._asked = course.effects if effects in ('auto', ('auto',), ['auto']) else effects
        self._preset, self._wind, self._accuracy = preset(accuracy), checked_wind(wind), accuracy
        self._materials = model_.material_names(course)
        self._log, self._events, self._now = new_log(64 + 16 * len(self.names)), [], 0.0
        self.failures, self.last_failure = 0, ''  # of balls that could not go on: how many, and why
        self.shots = 0  # strikes that were taken; each is the number of its `Result`
        self._pegs = {}  # where each ball was teed, by number
        self._lost = []  # numbers of lost balls, which are dropped at the end of a call of the engine
        self._balls = np.zeros(len(self.names), BALL)
        engine = checked_engine(engine)
        self._engine = compiled_engine() if engine == 'compiled' else PYTHON
        self._program = None  # of the compiled engine, if that may take over
        self._rebuild()
        self._workspace = new_workspace(len(self.names), 'ball_ball' in self.effects_on)
        if engine == 'auto':
            self._program = Program.of(self.program)
        self._tee_up()

    def _rebuild(self):
        """Choose the effects again and rebuild the model for kernels."""
        self._choose()
        self._model = model_.build_model(self.course, self._records, self._preset)

    def _choose(self):
        """Choose the effects, and the records of them for the engine."""
        self._scene = Scene(self.course, len(self.names), self._wind)
        self._chosen = choose(self._asked, self._scene)
        keeps_dormant = self._engine.keeps_dormant
        self._records = self._chosen.with_dormant(self._scene) if keeps_dormant else self._chosen.records

    def _tee_up(self):
        """Tee up all balls side by side, on pegs that hold them until they are struck or hit."""
        self._balls['phase'], self._balls['end'] = HOLED, inf  # nowhere, until they are there
        self._balls['strokes'] = 0
        apart = max(APART, CLEAR * self.course.ball.radius)
        for i, name in enumerate(self.names):
            aside = apart * (i - 0.5 * (len(self.names) - 1))
            try:
                self._put(i, (self.course.tee[0], self.course.tee[1] + aside))
            except NoPlace as error:
                raise NoPlace(unfit(self.course.tee, self.names, i, error)) from None
            self._pegs[i] = three(self._balls[i]['position'])

    @property
    def effects_on(self):
        """Names of the effects that are simulated at present."""
        return tuple(self._chosen.on)

    @property
    def effects_off(self):
        """Reasons, by name, of the effects that are not simulated at present."""
        return self._chosen.off

    @property
    def effects_needless(self):
        """Reasons, by name, of the effects that were asked for and that this scene can't have."""
        return self._chosen.needless

    @property
    def accuracy(self):
        """Name of the accuracy preset; may be set while balls move."""
        return self._accuracy

    @accuracy.setter
    def accuracy(self, accuracy):
        self._preset, self._accuracy = preset(accuracy), accuracy
        self._model = model_.build_model(self.course, self._records, self._preset)
        self._begin_new_segments()

    def measure(self):
        """Start to measure where the engine's time goes; see `spent`."""
        self._workspace = self._workspace._replace(spent=np.zeros(len(STAGES), np.int64))

    @property
    def spent(self):
        """Processor's cycles that the engine has spent since `measure`, by stage; see `cycles_now`."""
        return dict(zip(STAGES, self._workspace.spent.tolist()))

    @property
    def moving(self):
        """Whether any ball moves."""
        return bool(self.in_motion)

    @property
    def in_motion(self):
        """Names of the balls that move; of the phases, flight is the first that does and rolling the last."""
        phases = self._balls['phase'].tolist()
        return [name for name, phase in zip(self.names, phases) if FLIGHT <= phase <= ROLL]

    @property
    def engine(self):
        """Engine that runs the physics: 'python' or 'compiled'; may be set, also while balls move.

        Setting 'compiled' loads what is needed, or compiles it in this process: up to a minute; see `build`.
        """
        return self._engine.name

    @engine.setter
    def engine(self, name):
        self._program = None
        if name != self.engine:
            self._engine = {'python': PYTHON}.get(name) or compiled_engine()
            self._rebuild()

    @property
    def program(self):
        """Key of the machine code that the compiled engine needs: the types of the records."""
        return self._types(self._chosen.with_dormant(self._scene))

    @property
    def types(self):
        """Names of the types of the present records, which decide what machine code they need."""
        return self._types(self._records)

    def _types(self, records):
        types = map(type, (*records, self._preset.method, *self._model.land.ground.kinds, self._workspace))
        return ' '.join(f'{kind.__module__}.{kind.__qualname__}' for kind in types)

    def build(self, urgent=False):
        """`jit.build.Build` of the compiled engine, started now unless it has been before."""
        return Program.of(self.program).built(urgent, *self.part[1:])

    @property
    def part(self):
        """Program of this world's compiled engine, for a `jit.build.Build`."""
        return Part(self.program, exercise, (self.course, self.names, self._asked, self._preset))

    def _take_over(self):
        """Switch to the compiled engine if it is ready; start its build if that pays."""
        if self._program.is_ready:
            self.engine = 'compiled'
        elif self._program.build is None and self._program.is_worth_compiling():
            self.build()

    def __getitem__(self, name):
        """`BallState` of the ball called `name`."""
        ball = self._ball(name)
        return BallState(three(ball['position']), three(ball['velocity']), three(ball['spin']),
                         PHASES[ball['phase']], self._lie(ball))

    def turn(self, orientations, time):
        """Turn `orientations`, (n, 4), the balls' quaternions x, y, z, w, as balls turn in `time` [s]."""
        self._engine.turn(orientations, self._balls, time)

    def _ball(self, name):
        return self._balls[self._number(name)]

    def _number(self, name):
        if name not in self._numbers:
            raise ValueError(f'ball {name!r} is unknown; known: {", ".join(self.names)}')
        return self._numbers[name]

    def _lie(self, ball):
        if ball['phase'] == FLIGHT or ball['support'] < 0:
            return ''
        return self._materials[ball['material']]

    def place(self, name, position, velocity=None, spin=None):
        """Put a ball down: at (x, y) on the ground there, or exactly at (x, y, z).

        At (x, y) it comes down beside the flagstick where that stands in its way into the hole, and on no
        obstacle: where there is one, it is refused.

        With a `velocity` [m/s] or `spin` [rad/s] it sets off, without being struck.

        Raises
        ------
        ValueError
            Not finite or over 1e6 m away, no ground at (x, y), inside anything solid or another ball, in
            water.
        """
        number = self._number(name)
        ball = self._balls[number]
        position = tuple(map(float, position))
        velocity = ZERO if velocity is None else tuple(map(float, velocity))
        spin = ZERO if spin is None else tuple(map(float, spin))
        if not all(map(isfinite, (*position, *velocity, *spin))):
            raise NoPlace(f'position {position}, velocity {velocity} or spin {spin} is not finite')
        if max(map(abs, position)) > FARTHEST:
            raise NoPlace(f'position {position} is farther away than {FARTHEST:g} m')
        self._put(number, position)
        self._set_off(ball, velocity, spin)

    def _put(self, number, position):
        """Put a ball down, at rest; `NoPlace` where it is not free."""
        ball = self._balls[number]
        trial = ball.copy()
        self._put_down(trial, position)
        if not self._is_free(number, three(trial['position'])):
            raise NoPlace(f'position {position} is taken by another ball')
        self._settle_clock()
        self._let_lean_no_more(number)
        self._workspace.count[TREE_AGE] = len(self.names)
        if ball['phase'] == HOLED:  # the next hole begins
            trial['strokes'] = 0
        self._balls[number] = trial
        ball['phase'], ball['end'] = REST, inf
        for name in ('shot_active', 'moved_by_ball', 'water', 'sleeps_on_ball', 'time_stepping',
                     'micro_bounce_end'):
            ball[name] = 0
        ball['struck'], ball['struck_at'] = self._now, ball['position']

    def _let_lean_no_more(self, number):
        """Wake the balls that sleep on a ball which is taken away."""
        balls = self._balls
        apart = np.linalg.norm(balls['position'] - balls['position'][number], axis=1)
        leaning = (balls['phase'] == REST) & (balls['sleeps_on_ball'] != 0) & (
            apart <= 2.0 * (self._model.land.ball.radius + RESTING_GAP))
        leaning[number] = False
        balls['end'][leaning], balls['ending'][leaning] = self._now, LAUNCH
        balls['moved_by_ball'][leaning], balls['struck_at'][leaning] = 1, balls['position'][leaning]

    def _put_down(self, ball, position):
        """Put a `ball` record at x, y, z, or on the ground at x, y; `NoPlace` where it can't be."""
        bare = self._model._replace(land=self._model.land._replace(ground=without(self._model.land.ground)))
        put_down = self._engine.put_down
        x, y, *exact = position
        if not exact:
            x, y = self._beside_flagstick(x, y)
        place = position if exact else lowered(put_down, bare, ball, (x, y))
        _, inside, wet = put_down(self._model, ball, place, 0.0)
        if inside > surfaces.SAME_HEIGHT:
            _, in_ground, _ = put_down(bare, ball, place, 0.0)
            what = 'the ground' if in_ground > surfaces.SAME_HEIGHT else 'an obstacle or the flagstick'
            raise NoPlace(f'position {position} lies {inside:.3g} m deep in {what}')
        if wet:
            raise NoPlace(f'position {position} lies in water')

    def _beside_flagstick(self, x, y):
        """x, y in the hole, moved to where a ball drops in beside the flagstick; any other as they are."""
        ground, radius, course = self._model.land.ground, self._model.land.ball.radius, self.course
        away = hypot(x - course.hole[0], y - course.hole[1]) if course.hole else inf
        room = FLAGSTICK_RADIUS + radius + surfaces.SAME_HEIGHT
        if not course.flagstick or away >= room or room + radius > ground.hole[2]:
            return x, y
        towards = atan2(y - course.hole[1], x - course.hole[0])
        return course.hole[0] + room * cos(towards), course.hole[1] + room * sin(towards)

    def _set_off(self, ball, velocity, spin):
        ball['velocity'], ball['spin'] = velocity, spin
        ball['end'], ball['ending'] = self._now, LAUNCH
        self._let_happen(self._now)

    def strike(self, name, velocity, spin=ZERO):
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

    def _settle_clock(self):
        """Reset the engine's clock to zero when nothing moves: the same strikes give the same bits."""
        if not self.moving:
            if self._program:
                self._take_over()
            self._now = 0.0
            # The tree is rebuilt, or its shape would depend on the play before.
            self._workspace.count[TREE_AGE] = len(self.names)

    def set_wind(self, wind):
        """Set the wind [m/s] at 10 m over the ground from now on.

        Raises
        ------
        ValueError
            Not finite, or over 100 m/s.
        """
        wind = checked_wind(wind)
        if wind == self._wind:
            return
        self._wind = wind
        self._choose()
        self._model = self._model._replace(effects=model_.in_flight(self._records))
        self._begin_new_segments()

    def _begin_new_segments(self):
        """End the segments of balls in flight now, since their surroundings have changed."""
        flying = self._balls['phase'] == FLIGHT
        self._balls['end'][flying] = self._now
        self._balls['ending'][flying] = STEP_END
        self._balls['last_stage_time'][flying] = -1.0

    def advance(self, dt):
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

    def happened(self):
        """Take the events of a strike, a placement or a reset; else the next `advance` returns them first.

        A ball that is struck too weakly to move ends its shot within the strike.

        Returns
        -------
        list of Collision and Result
        """
        events, self._events = self._events, []
        return events

    def _let_happen(self, until):
        """Run the engine up to `until` on its own clock, and keep the events that it logs."""
        if self._balls['end'].min() == inf:  # nothing will ever end: all balls rest
            return
        start = self.time - self._now
        while True:
            status = self._run(until)
            self._events += self._told(start)
            if status == LOG_FULL:
                continue
            if not self._lost:
                break
            for number in self._lost:
                self._drop(number, until)
            self._lost.clear()

    def _run(self, until):
        """Run the engine; where plain Python raises an arithmetic error, the involved balls fail.

        Compiled code goes on with what is not a number, and finds it at the segment's end.
        """
        run = self._engine.advance
        if self._program:
            run = partial(self._program.timed, run)
        try:
            with np.errstate(all='ignore'):
                return run(self._model, self._balls, until, self._workspace, self._log)
        except (ArithmeticError, ValueError):
            at_hand = self._workspace.involved[:self._workspace.count[INVOLVED]].tolist()
            if not at_hand:
                raise
        self._fail(at_hand, min(until, self._workspace.segment_ends[at_hand[0]]))
        return LOG_FULL

    def _fail(self, numbers, now):
        """Fail the balls of these `numbers` that move, the first one at least."""
        for number in numbers:
            ball = self._balls[number]
            if number == numbers[0] or moves(ball['phase']):
                fail(ball, number, now, NOT_FINITE, self._log)
                ball['end'] = inf
            self._workspace.involved_index[number] = -1
        self._workspace.count[:TREE_AGE] = 0, 0
        self._workspace.count[TREE_AGE] = len(self.names)

    def _told(self, start):
        """Reports of the logged events; `start` is the world's time at the zero of the engine's clock."""
        events = []
        for time, number, kind, other, sort, *vectors in plain_rows(self._log.events[:self._log.count[0]]):
            ball, name = self._balls[number], self.names[number]
            if kind == SHOT_ENDS:
                events.append(result(ball, name, start + time, self.course.hole, self._materials))
            elif kind != LOST:
                what = self._hit(kind, other, sort)
                events.append(Collision(start + time, name, *what, *vectors))
            if kind == LOST or kind == SHOT_ENDS and ball['phase'] in (WATER, OUT, FAILED):
                self._lost.append(number)
            if kind in (LOST, SHOT_ENDS) and ball['phase'] == FAILED:
                ball['strokes'] -= kind == SHOT_ENDS  # the next one has the same number
                self.failures, self.last_failure = self.failures + 1, f'{name}: {failure(ball)}'
        self._log.count[:] = 0
        return events

    def _hit(self, kind, other, sort):
        """Kind of a logged collision, and name of the material or ball that was hit."""
        if kind == BALL_HIT:
            return 'ball', self.names[other]
        if kind == WATER_HIT:
            return 'water', 'water'
        lie = self._materials[other] if other >= 0 else ''
        return ('out_of_bounds' if kind == WENT_OUT else COLLISION_KINDS[sort]), lie

    def _drop(self, number, now):
        """Drop a lost ball where it was struck, or beside a ball that lies there by `now`.

        Moving balls begin new segments, or they would miss the ball in their way; time steps end soon anyway.
        """
        ball = self._balls[number]
        self._workspace.count[TREE_AGE] = len(self.names)  # where it was is not where it will be
        is_held = ball['phase'] == FAILED or three(ball['struck_at']) == self._pegs[number]
        ball['phase'], ball['end'] = REST, inf
        for field in ('shot_active', 'moved_by_ball', 'water', 'sleeps_on_ball', 'time_stepping'):
            ball[field] = 0
        for x, y, z, lower in spots(three(ball['struck_at']), self._model.land.ball.radius):
            if self._is_free(number, (x, y, z)):
                start = x, y, z + lower
                touches, inside, wet = self._engine.put_down(self._model, ball, start, 2.0 * lower)
                if lower == 0.0 or touches and inside <= surfaces.SAME_HEIGHT and not wet:
                    break
        else:
            self._engine.put_down(self._model, ball, three(ball['struck_at']), 0.0)
        if not is_held:
            ball['end'], ball['ending'] = now, LAUNCH
        moving = np.isin(self._balls['phase'], (FLIGHT, SLIDE, ROLL)) & (self._balls['time_stepping'] == 0)
        self._balls['end'][moving], self._balls['ending'][moving] = now, STEP_END

    def _is_free(self, number, place):
        """Whether a ball at `place` overlaps no ball but that of `number`."""
        if 'ball_ball' not in self.effects_on:
            return True
        others = np.delete(self._balls, number)
        others = others[others['phase'] != HOLED]
        apart = np.linalg.norm(others['position'] - place, axis=1)
        return not (apart < 2.0 * self._model.land.ball.radius - surfaces.SAME_HEIGHT).any()

    def state(self, written=plain):
        """State of the world, all that decides how the play goes on, as plain data; see `restore`.

        `written` serialises a `BALL` record.
        """
        balls = {name: written(ball) for name, ball in zip(self.names, self._balls)}
        return {'time': self.time, 'clock': self._now, 'engine': self.engine, 'accuracy': self.accuracy,
                'wind': list(self._wind), 'balls': balls}

    def restore(self, state):
        """Restore the `state` of a world on the same course, with the same effects, and go on from there.

        To the bit, if the engine is the same; it stays as it is.

        Raises
        ------
        KeyError, TypeError, ValueError
            It is no state of such a world.
        """
        if state['accuracy'] != self.accuracy:
            self.accuracy = state['accuracy']
        self.set_wind(state['wind'])
        self._balls[:] = [restored(state['balls'][name]) for name in self.names]
        self.time, self._now, self._events = float(state['time']), float(state['clock']), []
        self._workspace.count[TREE_AGE] = len(self.names)  # the tree is rebuilt

    def reset(self):
        """Put all balls back to the start.

        Returns
        -------
        list of Result
            Shots under way, with status 'aborted'.
        """
        moving = np.isin(self._balls['phase'], (FLIGHT, SLIDE, ROLL))
        self._balls['end'][moving], self._balls['ending'][moving] = self._now, STEP_END
        self._let_happen(self._now)
        aborted = []
        for ball, name in zip(self._balls, self.names):
            if ball['shot_active']:
                ball['ended'] = self._now
                aborted.append(result(ball, name, self.time, self.course.hole, self._materials))
        self._balls['phase'] = REST
        self._balls['shot_active'] = 0
        self._balls['support'] = NO_PART
        self._tee_up()
        return aborted


def lowered(put_down, model, ball, place):
    """Position of a `ball` record that is lowered onto the ground of `model` at x, y. Writes the ball."""
    x, y = place
    ground, radius = model.land.ground, model.land.ball.radius
    for room in (3 * radius, 30 * radius, 300 * radius):  # over a steep plane a ball touches higher up
        top = max(surfaces.look_down(ground, x, y)[0], ground.highest) + room
        touches, inside, _ = put_down(model, ball, (x, y, top), min(top - ground.lowest + room, FALL))
        if touches and inside <= surfaces.SAME_HEIGHT:
            return three(ball['position'])
    raise NoPlace(f'no ground at x {x:g}, y {y:g}')


def unfit(tee, names, number, reason):
    """Reason why the ball of that number can't be teed up, alone or beside others."""
    if len(names) == 1:
        return f'tee {list(tee)} must be where a ball can lie: {reason}'
    return (f'balls {", ".join(names)} do not fit beside each other at the tee {list(tee)}: '
            f'{names[number]}: {reason}')


def check_tee(course):
    """Check that a ball can lie on the course's tee, whatever its effects; `NoPlace` where it can't."""
    World(course._replace(effects='auto'), engine='python')


def spots(place, radius):
    """Candidate spots for a dropped ball: its `place`, then rings around it.

    Yields x, y, z, and how far above and below that ground may lie.
    """
    x, y, z = place
    yield x, y, z, 0.0
    for ring in range(1, 20):
        for step in range(6 * ring):
            angle = step * pi / (3 * ring)
            away = CLEAR * radius * ring
            yield x - away * cos(angle), y + away * sin(angle), z, 2.0 * radius


def checked_names(balls):
    """Names of `balls`, a number or a sequence of names; ValueError where one is not allowed."""
    names = tuple(f'ball_{i}' for i in range(balls)) if isinstance(balls, int) else tuple(balls)
    for name in names:
        if not re.fullmatch('[a-z][a-z0-9_]*', name) or name in RESERVED:
            raise ValueError(f'ball name {name!r} is not allowed: lower-case letters, digits and _, '
                             f'not {", ".join(sorted(RESERVED))}')
    if not names or len(set(names)) < len(names):
        raise ValueError(f'ball names {names} must be at least one and all different')
    return names


def checked_wind(wind):
    """Tuple of three floats of `wind`; ValueError where it is not finite or too strong."""
    wind = tuple(map(float, wind))
    if len(wind) != 3 or not all(map(isfinite, wind)):
        raise ValueError(f'wind {wind} is not three finite numbers')
    if sum(x * x for x in wind) > MOST_WIND * MOST_WIND:
        raise ValueError(f'wind {wind} is over {MOST_WIND:g} m/s')
    return wind


def exercise(course, names, effects, accuracy):
    """Run all that a play of the compiled engine may need, which compiles it or loads it from the cache."""
    world = World(course, names, effects, accuracy, engine='compiled')
    world.strike(names[0], (1.0, 0.0, 1.0))
    world.advance(0.0)
    world.turn(np.zeros((len(names), 4)), 0.0)
