# SPDX-License-Identifier: Apache-2.0
"""Shots from strike to rest: one with its path, or many with their figures."""
from typing import NamedTuple

import numpy as np

from . import model
from .advance import play_all
from .ground import surface
from .report import Result, objection, summary
from .vector import ZERO
from .world import World


class Play(NamedTuple):
    """A shot with its path: `times` (n,) [s], the others (n, 3) in SI units; the last row is the end."""

    result: Result
    collisions: tuple
    times: np.ndarray
    positions: np.ndarray
    velocities: np.ndarray
    spins: np.ndarray


def simulate(course, shot, wind=ZERO, effects='auto', accuracy='standard', rate=100.0):
    """Play one shot from the tee to its end.

    Parameters
    ----------
    course : Course
    shot : Shot
    wind : (float, float, float)
        At 10 m over the ground [m/s].
    effects : 'auto' or sequence of str
    accuracy : str or Preset
    rate : float
        Rows of the path a second. The shot itself does not depend on it.

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
    world = World(course, effects=effects, accuracy=accuracy, wind=wind)
    name = world.names[0]
    world.strike(name, shot.velocity, shot.spin)
    rows, events = [(0.0, *world[name][:3])], []
    while not any(isinstance(event, Result) for event in events):
        events += world.advance(1.0 / rate)
        rows.append((world.time, *world[name][:3]))
    end = next(event for event in events if isinstance(event, Result))
    rows[-1] = (end.time, end.position, ZERO, world[name].spin)
    times, positions, velocities, spins = map(np.array, zip(*rows))
    collisions = tuple(event for event in events if event is not end)
    return Play(end, collisions, times, positions, velocities, spins)


def simulate_many(course, velocities, spins, wind=ZERO, effects='auto', accuracy='standard',
                  executor=None, chunks=16):
    """Play many shots, each from the tee.

    Parameters
    ----------
    velocities, spins : array_like, (n, 3)
        [m/s], [rad/s]
    executor : concurrent.futures.Executor, optional
        Plays `chunks` parts of the shots at once: processes, threads, or other machines.

    Returns
    -------
    ndarray, (n,)
        Structured, with the fields of `Result` but shot, ball, time and reason.

    Raises
    ------
    ValueError
        A shape is not (n, 3), or a shot can't be played: the message says which and why.
    """
    velocities = np.ascontiguousarray(velocities, float)
    spins = np.ascontiguousarray(spins, float)
    if velocities.ndim != 2 or velocities.shape[1] != 3 or spins.shape != velocities.shape:
        raise ValueError(f'velocities {velocities.shape} and spins {spins.shape} must both be (n, 3)')
    for i, strike in enumerate(zip(velocities, spins)):
        if objection(*strike):
            raise ValueError(f'shot {i}: {objection(*strike)}')
    if executor is None:
        return _played(course, velocities, spins, wind, effects, accuracy)
    parts = [(course, *part, wind, effects, accuracy) for part in
             zip(np.array_split(velocities, chunks), np.array_split(spins, chunks)) if len(part[0])]
    return np.concatenate(list(executor.map(_played, *zip(*parts))))


def _played(course, velocities, spins, wind, effects, accuracy):
    world = World(course, effects=effects, accuracy=accuracy, wind=wind)
    ends = play_all(world._model, world._balls, velocities, spins, world._log)
    return summary(ends, course.hole, world._materials)


def ground_height(course, x, y):
    """Height [m] and material's name of the highest ground at `x`, `y`, or None where there is none."""
    shapes = model.ground(course)
    z, part = surface.top(shapes, x, y)
    if part < 0:
        return None
    return z, model.material_names(course)[surface.material_of(shapes, part)]
