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

"""Batch of shots, each from the tee: the choice of the engine, and their results."""

from typing import Any, Callable, Iterable, NamedTuple, Optional, Union

import numpy as np

from . import jit
from .effects import EffectNames
from .engine.engines import LOG, Program
from .engine.event_loop import play_all, Schedule
from .jit.build import READY
from .response.contact_set import clear_set
from .result import summary
from .scene.course_record import Course
from .scene.kernel_model import Nothing
from .scene.presets import Preset
from .state.ball import ENDED
from .trajectory.shot_record import begin_shot, copy_result, fail, NOT_FINITE
from .world import World

PART = 5000  # shots between two updates of the progress
# Plain Python plays a shot in 0.3 s; loading takes 2 s, compiling a minute.
FEW_SHOTS, MANY_SHOTS = 20, 200
SHORT_WAIT = 5.0  # s: loading is over by then
ANY_SHOT = np.array([[1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]])
BLOWN = 'wind', 'wind_field', 'turbulence'  # effects that a gust changes

# Gives back the parts of a whole, of which there are ``total``, and shows how far they are.
Progress = Callable[..., Iterable[Any]]


class Batch(NamedTuple):
    """Common input of many shots; `engine`: 'python' or 'compiled'; `live` but the wind."""

    course: Course
    gusts: np.ndarray
    effects: EffectNames
    accuracy: Union[str, Preset]
    engine: str
    live: dict[str, Iterable[float]]


def batch_engine(batch: Batch, shots: int) -> str:
    """Engine that pays for so many `shots`; the compiled one has been loaded then."""
    if shots < FEW_SHOTS:
        return 'python'
    program = Program.of(f'batch {world_of(batch).types}')
    if shots < MANY_SHOTS and program.build is None and not program.is_kept:
        return 'python'
    build = program.built(True, played, (batch._replace(engine='compiled'), ANY_SHOT))
    if not build.wait(SHORT_WAIT):
        LOG.warning('compiling the physics for %d shots, up to a minute, once a machine', shots)
        build.wait()
    if build.state != READY:
        LOG.warning(
            '%d shots in plain Python, which takes some 100 times as long: %s', shots, build.reason
        )
        return 'python'
    return 'compiled'


def world_of(batch: Batch) -> World:
    """`World` of a batch. The strongest gust decides whether wind is simulated."""
    strongest = batch.gusts[np.argmax(np.linalg.norm(batch.gusts[:, 1:], axis=1)), 1:]
    wind = {'wind': strongest} if strongest.any() else {}
    return World(
        batch.course,
        ('ball',),
        batch.effects,
        batch.accuracy,
        engine='python',
        **wind,
        **batch.live,
    )


def played(batch: Batch, strikes: np.ndarray, progress: Optional[Progress] = None) -> np.ndarray:
    """Results of the `strikes` of a batch.

    Effects stay off, so no dormant record is compiled in.
    """
    world = world_of(batch)
    play = jit.compiled(play_all) if batch.engine == 'compiled' else play_all
    parts = np.array_split(strikes, max(1, len(strikes) // PART))
    on = world._chosen.on
    blowing = tuple(on[name] for name in BLOWN if name in on) or (Nothing(),)
    scene = (
        world._model,
        world._balls,
        Schedule(blowing, batch.gusts),
        world._workspace,
        world._log,
    )
    found = [
        summary(ends(play, scene, part), batch.course.hole, world._labels.materials)
        for part in (progress(parts, total=len(parts)) if progress and len(parts) > 1 else parts)
    ]
    return np.concatenate(found)


def ends(
    play: Callable[..., np.ndarray], scene: tuple[Any, ...], strikes: np.ndarray
) -> np.ndarray:
    """Play `strikes` to their ends, an `ENDED` array.

    A shot for which plain Python raises an arithmetic error fails.
    """
    model, balls, schedule, work, log = scene
    try:
        with np.errstate(all='ignore'):
            return play(model, balls, strikes, schedule, work, log)
    except (ArithmeticError, ValueError):
        clear_set(work)  # bisection finds the shot
        if len(strikes) > 1:
            return np.concatenate([ends(play, scene, part) for part in np.array_split(strikes, 2)])
    ball, end = balls[0].copy(), np.empty(1, ENDED)
    ball['velocity'], ball['spin'] = strikes[0, :3], strikes[0, 3:6]
    begin_shot(ball, 0.0)
    fail(ball, 0, 0.0, NOT_FINITE, log)
    copy_result(ball, end[0])
    return end


def progress_bar(parts: Iterable[np.ndarray], total: int) -> Iterable[np.ndarray]:
    """Wrap `parts` in a progress bar, on a terminal, from two seconds on, if tqdm is installed."""
    try:
        from tqdm import tqdm
    except ImportError:
        return parts
    return tqdm(parts, total=total, desc='shots', unit='part', delay=2.0, disable=None)
