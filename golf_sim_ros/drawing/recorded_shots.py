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

"""Shots to be drawn, from the recording of a play."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .shots import DrawnShot
from ..physics.result import Collision, Result
from ..recording.bag import BagError, Recording, Track
from ..recording.journal_format import Entry

ROUNDED = 2e-4  # s: durations in results, which tell when strikes were, are rounded to 1e-4
AT = 2e-4  # m: a pose is at a place of a result, which is rounded to 1e-4


def recorded(recording: Recording) -> list[DrawnShot]:
    """Make shots to be drawn of a recording.

    Parameters
    ----------
    recording : golf_sim_ros.recording.bag.Recording

    Returns
    -------
    list of DrawnShot
        Those that were played and whose path was recorded, on the clock of simulated time.

    Raises
    ------
    golf_sim_ros.bag.BagError
        A result or collision is not as a sim publishes it.
    """
    try:
        results = [
            frozen(Result, told) for told in recording.results if told['status'] != 'rejected'
        ]
        collisions = [
            frozen(Collision, {**told, 'with_': told['with']}) for told in recording.collisions
        ]
    except (KeyError, TypeError) as error:
        raise BagError(f'a result or collision lacks {error}') from None
    start = clock(recording, results)
    shots = [
        shot_of(recording, result, collisions, start)
        for result in results
        if result.ball in recording.tracks
    ]
    return [shot for shot in shots if len(shot.times) > 1]


def frozen(kind: Any, told: Mapping[str, Any]) -> Any:
    """Make a `kind` of record of the values in `told`, with tuples for lists."""
    values = {name: told[name] for name in kind._fields}
    return kind(
        **{
            name: tuple(value) if isinstance(value, list) else value
            for name, value in values.items()
        }
    )


def clock(recording: Recording, results: Sequence[Result]) -> int:
    """Find the ROS time [ns] of simulated time 0.

    Without a journal it is not recorded. Then it is reckoned from the first pose after each shot,
    which is published at the end or some milliseconds later.
    """
    known = recording.start or 0
    if recording.config:
        return known
    starts = [
        recording.tracks[result.ball].times[rest] - round(1e9 * result.time)
        for result in results
        if result.ball in recording.tracks
        for rest in rests(recording.tracks[result.ball], result.position)
    ]
    return min(starts, default=known, key=lambda start: abs(start - np.median(starts)))


def rests(track: Track, place: Sequence[float]) -> np.ndarray:
    """Find the number of the first pose at `place`, coming from elsewhere.

    An array of one, or of none if the ball was not seen there.
    """
    there = np.linalg.norm(track.positions - place, axis=1) < AT
    came = np.flatnonzero(there[1:] & ~there[:-1]) + 1
    return came[:1]


def shot_of(
    recording: Recording, result: Result, collisions: Sequence[Collision], start: int
) -> DrawnShot:
    """`DrawnShot` of the recorded shot that ended with `result`.

    Simulated time began at `start` [ns].
    """
    strike = strike_of(recording, result)
    begin = strike['time'] if strike else result.time - result.duration
    rows = path(recording.tracks[result.ball], result, begin, start)
    hits = [
        hit
        for hit in collisions
        if hit.ball == result.ball and begin - ROUNDED <= hit.time <= result.time + ROUNDED
    ]
    return DrawnShot(result, tuple(hits), *rows, wind(recording, strike, begin, start))


def strike_of(recording: Recording, result: Result) -> Entry | None:
    """Entry in the journal for the strike that ended with `result`, or None."""
    return next(
        (
            entry
            for entry in recording.journal
            if entry['kind'] == 'strike' and entry['shot'] == result.shot
        ),
        None,
    )


def path(
    track: Track, result: Result, begin: float, start: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Cut times, positions, velocities and spins from the strike at `begin` to the end."""
    stamps, of_pose, of_twist = np.intersect1d(track.times, track.twist_times, return_indices=True)
    seconds = 1e-9 * (stamps - start)
    rows = np.column_stack(
        [seconds, track.positions[of_pose], track.velocities[of_twist], track.spins[of_twist]]
    )
    during = (seconds > begin + ROUNDED) & (seconds < result.time - 1e-6)
    during &= np.cumsum(during & rows[:, 4:].any(1)) > 0  # not where it still waits to be struck
    before = (
        np.flatnonzero(seconds <= begin + ROUNDED)
        if not during.any()
        else range(np.argmax(during))
    )
    first = (
        [(begin, *rows[before[-1], 1:4], *result.velocity, *result.spin)] if len(before) else []
    )
    moved = rows[during]
    spin = moved[-1, 7:] if len(moved) and result.status != 'at_rest' else (0.0, 0.0, 0.0)
    last = [(result.time, *result.position, 0.0, 0.0, 0.0, *spin)]
    whole = np.vstack([np.reshape(part, (-1, 10)) for part in (first, moved, last)])
    return whole[:, 0], whole[:, 1:4], whole[:, 4:7], whole[:, 7:]


def wind(recording: Recording, strike: Entry | None, begin: float, start: int) -> np.ndarray:
    """Rows of a time and the wind from then on: from the journal, else from the topic `wind`."""
    if strike and recording.config:
        rate = recording.config['parameters']['rate']
        later = [
            (entry['tick'] / rate, *entry['wind'])
            for entry in recording.journal
            if entry['kind'] == 'wind' and entry['tick'] > strike['tick']
        ]
        return np.array([(begin, *strike['wind']), *later])
    rows = np.column_stack([1e-9 * (recording.wind_times - start), recording.winds])
    calm = [(begin, 0.0, 0.0, 0.0)] if not len(rows) or rows[0, 0] > begin else []
    return np.vstack([np.reshape(calm, (-1, 4)), rows])
