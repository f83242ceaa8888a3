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

"""Simulation of shots from strike to rest: one with its path, or many with their results."""

from concurrent.futures import BrokenExecutor, CancelledError, Executor
from functools import partial
from typing import Iterable, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from .batch import ANY_SHOT, Batch, batch_engine, played, Progress, progress_bar
from .effects import EffectNames
from .engine.engines import checked_engine
from .geometry import surfaces
from .live_parameters import checked_live
from .mechanics.vector import ZERO
from .reporting import Happening
from .result import Collision, objection, Result, suspects
from .scene import kernel_model
from .scene.course_record import Course
from .scene.presets import Preset
from .state.ball import Shot
from .world import World


class Play(NamedTuple):
    """Shot with its path: `times` (n,) [s], the others (n, 3) in SI units.

    The last row is the end.
    """

    result: Result
    collisions: tuple[Collision, ...]
    times: np.ndarray
    positions: np.ndarray
    velocities: np.ndarray
    spins: np.ndarray


def simulate(
    course: Course,
    shot: Shot,
    wind: ArrayLike = ZERO,
    effects: EffectNames = 'auto',
    accuracy: Union[str, Preset] = 'standard',
    rate: float = 100.0,
    engine: str = 'auto',
    **live: Iterable[float],
) -> Play:
    """Play one shot from the tee to its end.

    Parameters
    ----------
    course : Course
    shot : Shot
    wind : (float, float, float), or array_like (n, 4)
        At 10 m over the ground [m/s]; or rows of a time since the strike [s], the first 0, and the
        wind from then on: gusts.
    effects : 'auto' or sequence of str
    accuracy : str or Preset
    rate : float
        Rows of the path a second. The shot itself does not depend on it.
    engine : str
    **live
        See `World`.

    Returns
    -------
    Play

    Raises
    ------
    Rejected
        The shot can't be played; see `World.strike`.
    ValueError
        See `World`.
    """
    gusts = checked_gusts(wind)
    world = World(course, ('ball',), effects, accuracy, engine=engine, wind=gusts[0, 1:], **live)
    name = world.names[0]
    world.strike(name, shot.velocity, shot.spin)
    rows, tick = [(0.0, *world[name][:3])], 0
    events: list[Happening] = []
    while not any(isinstance(event, Result) for event in events):
        tick += 1
        events += _blown(world, tick / rate, gusts)
        rows.append((world.time, *world[name][:3]))
    end = next(event for event in events if isinstance(event, Result))
    rows[-1] = (end.time, end.position, ZERO, world[name].spin)
    times, positions, velocities, spins = map(np.array, zip(*rows))
    collisions = tuple(event for event in events if isinstance(event, Collision))
    return Play(end, collisions, times, positions, velocities, spins)


def _blown(world: World, until: float, gusts: np.ndarray) -> list[Happening]:
    """Advance a world to the time `until`, through the `gusts` on the way; its events."""
    events: list[Happening] = []
    for time, *wind in gusts[(gusts[:, 0] > world.time) & (gusts[:, 0] <= until)]:
        events += world.advance(time - world.time)
        world.set_wind(wind)
    return events + world.advance(until - world.time)


def checked_gusts(wind: ArrayLike) -> np.ndarray:
    """Table of gusts, rows of time, x, y, z, from `wind`, three numbers or such a table.

    Else ValueError.
    """
    table = np.ascontiguousarray(wind, float)
    if table.shape == (3,):
        table = np.array([[0.0, *table]])
    if table.ndim != 2 or table.shape[1] != 4 or not len(table):
        raise ValueError(
            f'wind has the shape {table.shape}: three numbers, or rows of time, x, y, z'
        )
    if table[0, 0] != 0.0 or not (np.diff(table[:, 0]) > 0.0).all():
        raise ValueError('the times of the wind must begin with 0 and rise')
    for row in table[table[:, 1:].any(axis=1)]:  # still air needs no effect
        checked_live('wind', row[1:])
    return table


def simulate_many(
    course: Course,
    velocities: ArrayLike,
    spins: ArrayLike,
    wind: ArrayLike = ZERO,
    effects: EffectNames = 'auto',
    accuracy: Union[str, Preset] = 'standard',
    executor: Optional[Executor] = None,
    chunks: int = 16,
    progress: Optional[Progress] = None,
    engine: str = 'auto',
    **live: Iterable[float],
) -> np.ndarray:
    """Play many shots, each from the tee.

    Parameters
    ----------
    velocities, spins : array_like, (n, 3)
        [m/s], [rad/s]
    wind : (float, float, float), or array_like (m, 4)
        See `simulate`.
    executor : concurrent.futures.Executor, optional
        Plays `chunks` parts of the shots at once: threads, processes, or other machines. Kernels
        let other threads run, so threads do as well as processes, and share what is compiled. The
        compiled engine is loaded here first, or compiled.
    progress : callable, optional
        ``progress(parts, total=n)`` gives the parts back one by one and shows how far they are, as
        `tqdm.tqdm` does. Else there is such a bar on a terminal, where tqdm is installed and it
        takes long.
    engine : str
        'python', 'compiled', or 'auto': compiled where there are so many shots that it is worth
        it; the log says so before this process waits for a compiler.
    **live
        See `World`.

    Returns
    -------
    ndarray, (n,)
        Structured, with the fields of `Result` but shot, ball, time, reason, stroke and penalty.

    Raises
    ------
    ValueError
        A shape is not (n, 3), or a shot can't be played: the message says which and why.
    RuntimeError
        A worker of the executor ended before its shots were played.
    """
    strikes = checked_strikes(velocities, spins)
    gusts = checked_gusts(wind)
    progress = progress or progress_bar
    batch = Batch(course, gusts, effects, accuracy, checked_engine(engine), live)
    if batch.engine == 'auto':
        batch = batch._replace(engine=batch_engine(batch, len(strikes)))
    if executor is None:
        return played(batch, strikes, progress)
    if batch.engine == 'compiled':
        played(batch, ANY_SHOT)  # numba loads and compiles in one thread at a time only
    parts = [part for part in np.array_split(strikes, chunks) if len(part)] or [strikes]
    try:
        # One argument: some executors want to know how many there are.
        done = executor.map(partial(played, batch), parts)
        return np.concatenate(list(progress(done, total=len(parts))))
    except (BrokenExecutor, CancelledError) as error:
        raise RuntimeError(
            f'a worker of {type(executor).__name__} ended before its shots were played: '
            f'{" ".join(str(error).split())}'
        ) from error


def checked_strikes(velocities: ArrayLike, spins: ArrayLike) -> np.ndarray:
    """Velocities, spins and numbers of shots side by side, (n, 7).

    ValueError where a shot can't be played.
    """
    velocities, spins = np.asarray(velocities, float), np.asarray(spins, float)
    if velocities.ndim != 2 or velocities.shape[1] != 3 or spins.shape != velocities.shape:
        raise ValueError(
            f'velocities {velocities.shape} and spins {spins.shape} must both be (n, 3)'
        )
    for i in np.flatnonzero(suspects(velocities, spins)):
        reason = objection(velocities[i], spins[i])
        if reason:
            raise ValueError(f'shot {i}: {reason}')
    numbers = np.arange(len(velocities), dtype=float)[:, None]
    return np.ascontiguousarray(np.hstack([velocities, spins, numbers]))


def check_hole(course: Course) -> None:
    """Check that the ground around the course's hole can have one; ValueError where it can't."""
    kernel_model.ground(course)


def ground_height(course: Course, x: float, y: float) -> Optional[tuple[float, str]]:
    """Height [m] and name of the material of the highest ground at `x`, `y`.

    None where there is none.
    """
    z, part, number = surfaces.look_down(kernel_model.bare_ground(course), x, y)
    if part < 0:
        return None
    return z, kernel_model.material_names(course)[number]
