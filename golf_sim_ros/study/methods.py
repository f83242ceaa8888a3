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

"""Methods of the study: integrators over their settings, presets, scipy's, and the report's."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from .measure import Play, Stage, Truth
from .scenes import Game, Scene
from .scipy_flight import fly
from ..physics import ACCURACY, METHODS, Plane, Preset
from ..physics.baselines.report_2019 import play_report_2019

SETTINGS = {
    'euler': (1 / 50, 1 / 100, 1 / 250, 1 / 500, 1 / 1000, 1 / 2000, 1 / 5000),
    'rk4': (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005),
    'dormand_prince': (1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10),
}
SCIPY = {'RK45': (1e-3, 1e-4, 1e-6, 1e-8, 1e-10), 'DOP853': (1e-3, 1e-6, 1e-8, 1e-10, 1e-12)}
TRUTH = Preset(
    METHODS['dormand_prince'].record(1e-13), ACCURACY['reference'].limits._replace(settle=1e-5)
)
# Limits of Dormand-Prince's dial. So they go through those of the presets, as powers of the
# tolerance [m]; bounces from MOST_SETTLE on are always followed one by one, and no path is off by
# more than MOST_PATH.
PATH = 10.0**-3.5, 0.65
SETTLE = 10.0**0.24, 0.324
MOST_SETTLE = 0.5  # m/s
MOST_PATH = 1e-5  # m
NOT_PLAYED = ((np.nan, np.nan, np.nan),)


class Method(NamedTuple):
    """A way to play a scene, at one of its settings.

    ``ready(scene)`` gives a function that plays as many equal shots as asked, and gives the
    `Truth` of one; ``setting`` is its step or tolerance.
    """

    name: str
    setting: str
    ready: Callable[[Any], Play]


def methods(scene: Scene | Game) -> tuple[Method, ...]:
    """Methods to try on a scene."""
    found = [
        Method(
            name, f'{METHODS[name].dial} {setting:.3g}', partial(by_preset, made(name, setting))
        )
        for name, settings in SETTINGS.items()
        for setting in settings
    ]
    found += [
        Method('preset', name, partial(by_preset, preset)) for name, preset in ACCURACY.items()
    ]
    if isinstance(scene, Scene) and all(isinstance(shape, Plane) for shape in scene.course.ground):
        found.append(Method('report_2019', '50 Hz', lambda scene: partial(by_report, scene)))
    if scene.flies:
        found += [
            Method(f'scipy {name}', f'rtol {rtol:.0e}', partial(by_scipy, name, rtol))
            for name, settings in SCIPY.items()
            for rtol in settings
        ]
    return tuple(found)


def made(name: str, setting: float) -> Preset:
    """`Preset` of an integrator; everything else is as exact as in the preset `reference`."""
    return Preset(METHODS[name].record(setting), ACCURACY['reference'].limits)


def dial(tolerance: float) -> Preset:
    """`Preset` of Dormand-Prince with a `tolerance` [m], and of limits that go with it.

    So contacts, too, are the more exact the further it is turned, as from preset to preset.
    """
    (path, of_path), (settle, of_settle) = PATH, SETTLE
    limits = ACCURACY['reference'].limits._replace(
        settle=min(settle * tolerance**of_settle, MOST_SETTLE),
        path=min(path * tolerance**of_path, MOST_PATH),
    )
    return Preset(METHODS['dormand_prince'].record(tolerance), limits)


def by_preset(preset: Preset, scene: Scene | Game) -> Stage:
    """Make the play by the engine of this package."""
    return Stage(scene, preset)


def by_report(scene: Scene, count: int) -> Truth:
    """Play as the report of 2019 did."""
    shot = scene.shot
    touch, rest = play_report_2019(
        scene.course,
        np.tile(shot.velocity, (count, 1)),
        np.tile(shot.spin, (count, 1)),
        scene.wind,
    )
    return Truth((touch[0, 0], touch[0, 1]), ((rest[0, 0], rest[0, 1], rest[0, 2]),))


def by_scipy(name: str, rtol: float, scene: Scene) -> Play:
    """Make the play that flies with scipy up to the first touch."""

    def play(count: int) -> Truth:
        x, y, *_ = [fly(scene, name, rtol) for _ in range(count)][0]
        return Truth((x, y), NOT_PLAYED)

    return play
