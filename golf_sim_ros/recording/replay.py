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

"""Recorded shots, run again: whether they are the same to the bit, and where they differ first."""

from collections.abc import Iterator, Sequence
import json
from math import ceil
from os import PathLike
from time import perf_counter
from typing import NamedTuple

import numpy as np

from .bag import BagError, Recording, Strike
from .journal import standing
from .journal_format import Entry
from .json_format import collision_text, DIGITS, plain, result_text
from ..course import CourseError, load_course
from ..physics import BallState, Collision, Course, Result, World
from ..physics.live_parameters import LIVE

Event = Collision | Result

INPUTS = ('strike', 'place', 'reset', 'accuracy')  # and live parameters
STATE = ('time', 'clock', 'accuracy', 'balls')
LONGEST = 1000.0  # s; every shot is over long before
RUNS = 5  # of which the fastest counts
MANY = {'position': 'positions', 'velocity': 'velocities', 'spin': 'spins'}
CLOSE = 1e-9  # relative, or absolute below 1: as far as the two engines agree, chaos apart


class Shot(NamedTuple):
    """A shot in the journal: its strike, what came in until its end, and that end if recorded.

    ``gap`` names the entries in between that are missing.
    """

    strike: Entry
    inputs: tuple[Entry, ...]
    rest: Entry | None
    gap: str


class Rerun(NamedTuple):
    """A shot that was run again.

    ``path``: `BallState` at each tick from that of the strike to that before the end; ``impacts``:
    tick and `Collision` of each; ``end``: the last tick; ``rest``: `BallState` then; ``trouble``:
    why it could not be run to its end, or ''.
    """

    path: list[BallState]
    impacts: list[tuple[int, Collision]]
    end: int
    rest: BallState
    result: Result | None
    trouble: str


class Difference(NamedTuple):
    """A value that is not the same again."""

    tick: int
    field: str
    recorded: object
    again: object


def shots(recording: Recording) -> list[Shot]:
    """Shots of the strikes in the journal, in order."""
    journal = recording.journal
    return [shot_from(journal[i:]) for i, entry in enumerate(journal) if entry['kind'] == 'strike']


def shot_from(entries: Sequence[Entry]) -> Shot:
    """`Shot` of the strike with which `entries` begin."""
    strike, *later = entries
    gap, last = '', strike['entry']
    inputs: list[Entry] = []
    for entry in later:
        if entry['entry'] != last + 1:
            gap = gap or f'{last + 1} to {entry["entry"] - 1}'
        last = entry['entry']
        if entry['kind'] == 'rest' and entry['shot'] == strike['shot']:
            return Shot(strike, tuple(inputs), entry, gap)
        if entry['kind'] in INPUTS or entry['kind'] in LIVE:
            inputs.append(entry)
    return Shot(strike, tuple(inputs), None, gap)


def world_of(recording: Recording, course: str | PathLike[str] | None = None) -> World:
    """Make a `World` like that of the recorded sim.

    Parameters
    ----------
    recording : Recording
    course : str or path, optional
        Where the course is now; it must be the same to the byte.

    Raises
    ------
    BagError
        There is no journal or no such course, the course is another one, or it needs an effect
        that is unknown here.
    """
    config = config_of(recording)
    parameters = config['parameters']
    found = course_of(config, course)
    if found.digest != config['course']['digest']:
        raise BagError(
            f'course {found.path}: is not the one that was played: its digest is '
            f'{found.digest[:12]}, in the journal {config["course"]["digest"][:12]}'
        )
    try:
        return World(
            found,
            parameters['balls'],
            tuple(parameters['effects']),
            parameters['accuracy'],
            engine='python',
        )
    except ValueError as error:
        raise BagError(f'what was played cannot be played here: {error}') from None


def config_of(recording: Recording) -> Entry:
    """Get the configuration of a recorded sim; BagError where none was recorded."""
    if recording.config is None:
        missing = 'the beginning of its journal' if recording.journal else 'journal'
        raise BagError(
            f'{recording.namespace or "/"}: no {missing} was recorded: it cannot be run again'
        )
    return recording.config


def engine_of(recording: Recording, shot: Shot) -> str:
    """Engine that played a shot; versions before 0.2 played all shots of a sim with the same."""
    before = 'compiled' if config_of(recording)['made_with'].get('compiled', True) else 'python'
    return shot.strike.get('engine', before)


def course_of(config: Entry, course: str | PathLike[str] | None) -> Course:
    """Course of a configuration, at `course` or where it was."""
    places = [course] if course else [config['parameters']['course'], config['course']['path']]
    for place in places:
        try:
            return load_course(place)
        except CourseError as error:
            reason = error
    raise BagError(f'{reason}') from None


def rerun(world: World, shot: Shot, tick: float) -> Rerun:
    """Run a shot again, in ticks of `tick` [s], until its ball stops."""
    name, now, todo = shot.strike['ball'], shot.strike['tick'], list(shot.inputs)
    path: list[BallState] = []
    impacts: list[tuple[int, Collision]] = []
    result, trouble = None, ''
    try:
        begin(world, shot.strike)
        while not result:
            path.append(world[name])
            events = due(world, todo, now)
            if not own_result(events, name):
                impacts += [(now, event) for event in impacts_of(events, name)]
                events, now = world.advance(tick), now + 1
            impacts += [(now, event) for event in impacts_of(events, name)]
            result = own_result(events, name)
    except (KeyError, TypeError, ValueError) as error:  # what was recorded does not fit
        trouble = f'{error}'
    return Rerun(path, impacts, now, world[name], result, trouble)


def begin(world: World, strike: Entry) -> None:
    """Go back to where a recorded strike was made, and make it."""
    world.restore(
        {
            **{name: strike[name] for name in STATE},
            **{effect: strike[effect] for effect in LIVE if effect in strike},
        }
    )
    world.strike(strike['ball'], strike['velocity'], strike['spin'])


def due(world: World, todo: list[Entry], now: int) -> list[Event]:
    """Apply the inputs of `todo` until tick `now`, and take them from it.

    Returns the events at the instant of the strike and of those inputs.
    """
    told = world.happened()
    while todo and todo[0]['tick'] <= now:
        aborted = applied(world, todo.pop(0))
        told += [*world.happened(), *aborted]
    return told


def applied(world: World, entry: Entry) -> list[Event]:
    """Apply an input; return the results of the shots that it ends."""
    kind = entry['kind']
    if kind == 'strike':
        world.strike(entry['ball'], entry['velocity'], entry['spin'])
    elif kind == 'place':
        world.place(entry['ball'], entry['position'])
    elif kind in LIVE:
        world.set_live(kind, entry[kind])
    elif kind == 'accuracy':
        world.accuracy = entry['accuracy']
    return [*world.reset()] if kind == 'reset' else []


def impacts_of(events: list[Event], name: str) -> list[Collision]:
    """Collisions of ball `name` among `events`."""
    return [event for event in events if not isinstance(event, Result) and event.ball == name]


def own_result(events: list[Event], name: str) -> Result | None:
    """Find the result of ball `name` among `events`, or None."""
    return next(
        (event for event in events if isinstance(event, Result) and event.ball == name), None
    )


def difference(
    recording: Recording, shot: Shot, again: Rerun, exact: bool = True
) -> Difference | None:
    """Find the first `Difference` between a recorded shot and its `Rerun`.

    None where all is the same: to the bit, if `exact`; else as far as the two engines agree.
    """
    if again.trouble:
        return Difference(again.end, 'input', 'taken', again.trouble)
    tick = tick_of(recording)
    found = [
        *unsent(recording, shot),
        *off_path(recording, shot, again),
        *other_impacts(recording, shot, again, tick),
        *other_end(recording, shot, again),
    ]
    found = [one for one in found if exact or not are_close(one)]
    return min(found, key=lambda one: one.tick, default=None)


def are_close(one: Difference) -> bool:
    """Whether a `Difference` is rounding.

    As between the engines, or in the last digit of a result.
    """
    if isinstance(one.recorded, str) or one.recorded is None or one.again is None:
        return False
    within = 1.01 * 10.0**-DIGITS if one.field.endswith('of the result') else CLOSE
    told, now = np.array(one.recorded, float), np.array(one.again, float)
    return told.shape == now.shape and bool(
        (abs(told - now) <= within * np.maximum(1.0, abs(told))).all()
    )


def tick_of(recording: Recording) -> float:
    """Length of a tick [s]."""
    return 1.0 / config_of(recording)['parameters']['rate']


def unsent(recording: Recording, shot: Shot) -> Iterator[Difference]:
    """Differences between the strike and what was sent.

    Only if that was recorded and fits no other strike.
    """
    strike = shot.strike
    journal = [entry for entry in recording.journal if entry['kind'] == 'strike']
    sent = [one for one in recording.strikes if one.ball == strike['ball']]
    if any(played(strike, one) for one in sent):
        return
    since = max(
        (entry['received'] for entry in journal if entry['entry'] < strike['entry']), default=0
    )
    lost = [
        one
        for one in sent
        if since < one.received <= strike['received']
        and not any(played(entry, one) for entry in journal)
        and not any(rejected(result, one) for result in recording.results)
    ]
    for field in ('velocity', 'spin') if lost else ():
        told, mine = tuple(strike[field]), getattr(lost[-1], field)
        if told != mine:
            yield Difference(strike['tick'], f'{field} sent', mine, told)


def played(entry: Entry, strike: Strike) -> bool:
    """Whether an entry of the journal is that of a strike as it was sent."""
    return (entry['ball'], tuple(entry['velocity']), tuple(entry['spin'])) == strike[1:]


def rejected(result: Entry, strike: Strike) -> bool:
    """Whether a result is the rejection of a strike as it was sent."""
    told = [result[name] for name in ('status', 'ball', 'velocity', 'spin')]
    return told == ['rejected', strike.ball, *plain(strike[2:], DIGITS)]


def off_path(recording: Recording, shot: Shot, again: Rerun) -> Iterator[Difference]:
    """Differences between recorded poses and twists and the path."""
    track = recording.tracks.get(shot.strike['ball'])
    if track is None:
        return
    for times, fields in ((track.times, ('position',)), (track.twist_times, ('velocity', 'spin'))):
        ticks = (
            np.rint(recording.seconds(times) / tick_of(recording)).astype(int)
            - shot.strike['tick']
        )
        for row in np.flatnonzero((ticks > 0) & (ticks < len(again.path))):
            for field in fields:
                told = getattr(track, MANY[field])[row]
                now = getattr(again.path[ticks[row]], field)
                if told.tobytes() != np.array(now).tobytes():
                    yield Difference(
                        shot.strike['tick'] + int(ticks[row]), field, tuple(told.tolist()), now
                    )


def other_impacts(
    recording: Recording, shot: Shot, again: Rerun, tick: float
) -> Iterator[Difference]:
    """Differences between recorded collisions and those of the `Rerun`; some may not be recorded.

    A recorded collision is held against one of its kind at its time or, where there is none, at a
    time that differs by rounding. Of several at once, as with the surfaces of a corner, it is held
    against the one that is most like it.
    """
    strike = shot.strike
    happened = [
        (impact.time, number, json.loads(collision_text(impact)))
        for number, impact in again.impacts
    ]
    end = strike['time'] + (again.end - strike['tick'] + 0.5) * tick
    for told in recording.collisions:
        if told['ball'] == strike['ball'] and strike['time'] <= told['time'] <= end:
            number = strike['tick'] + ceil((told['time'] - strike['time']) / tick)
            of_kind = [one for one in happened if one[2]['kind'] == told['kind']]
            at_once = [(n, now) for time, n, now in of_kind if time == told['time']] or [
                (n, now)
                for time, n, now in of_kind
                if abs(time - told['time']) <= CLOSE * max(1.0, told['time'])
            ]
            yield from min(
                (
                    list(differences(n, 'a collision', told, now))
                    for n, now in at_once or [(number, {})]
                ),
                key=lambda found: (sum(not are_close(one) for one in found), len(found)),
            )


def other_end(recording: Recording, shot: Shot, again: Rerun) -> Iterator[Difference]:
    """Differences between the recorded end, in journal and result, and that of the `Rerun`."""
    ended = again.result
    if ended is None:  # it could not be run to its end
        return
    result = next((one for one in recording.results if one['shot'] == shot.strike['shot']), None)
    if result:
        now = json.loads(result_text(ended, result['shot']))
        yield from differences(again.end, 'the result', result, now)
    if shot.rest:
        rest = shot.rest
        # Older versions wrote an end within the strike at the tick after it.
        at_once = again.end == shot.strike['tick'] == rest['tick'] - 1
        now = {'tick': again.end + at_once, 'status': ended.status, **standing(again.rest)}
        told = {'tick': rest['tick'], 'status': rest['status'], **rest['state']}
        yield from differences(
            min(again.end, rest['tick']), 'the rest', told, json.loads(json.dumps(now))
        )


def differences(tick: int, of: str, told: Entry, now: Entry) -> Iterator[Difference]:
    """Differences between two dicts, in the recorded fields.

    An earlier version may have had fewer.
    """
    for field in told:
        if told[field] != now.get(field):
            yield Difference(tick, f'{field} of {of}', told[field], now.get(field))


def timed(
    world: World, shot: Shot, tick: float, accuracy: str | None = None
) -> tuple[tuple | None, float]:
    """Find where a shot ends, and the time [s] that its physics takes, in as few calls as can be.

    Parameters
    ----------
    world : World
    shot : Shot
    tick : float
        Length of a tick [s].
    accuracy : str, optional
        In place of that of the play.

    Returns
    -------
    position : tuple or None
        None for a shot that a reset ended.
    time : float
        The least of `RUNS`.
    """
    runs = [run_fast(world, shot, tick, accuracy) for _ in range(RUNS)]
    return runs[0][0], min(time for _, time in runs)


def run_fast(
    world: World, shot: Shot, tick: float, accuracy: str | None
) -> tuple[tuple | None, float]:
    """Find where a shot ends, or None after a reset, and the time taken [s]."""
    strike, name, spent = shot.strike, shot.strike['ball'], 0.0
    begin(world, {**strike, 'accuracy': accuracy or strike['accuracy']})
    now, result = strike['tick'], None
    for entry in (*shot.inputs, None):
        ahead = LONGEST if entry is None else (entry['tick'] - now) * tick
        began = perf_counter()
        events = world.advance(ahead)
        spent += perf_counter() - began
        result = own_result(events, name)
        if result or entry is None:
            break
        now = entry['tick']
        if entry['kind'] != 'accuracy' or not accuracy:
            result = own_result(repeated(world, entry), name)
            if result:
                return None, spent
    assert result is not None, f'a shot moves for more than {LONGEST:g} s'
    return result.position, spent


def repeated(world: World, entry: Entry) -> list[Event]:
    """Apply an input, unless its ball still moves, at another accuracy: then leave it out."""
    try:
        return applied(world, entry)
    except ValueError:
        return []
