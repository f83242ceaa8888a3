# SPDX-License-Identifier: Apache-2.0
"""Methods of the accuracy study: ours over their dials, the presets, scipy's, and the report's."""
from functools import partial
from typing import Callable, NamedTuple

import numpy as np

from ..physics import ACCURACY, METHODS, Preset
from ..physics.report_2019 import play_report_2019
from .measure import Truth, played
from .scipy_flight import fly

SETTINGS = {
    'euler': (1 / 50, 1 / 100, 1 / 250, 1 / 500, 1 / 1000, 1 / 2000, 1 / 5000),
    'rk4': (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005),
    'dormand_prince': (1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10),
}
SCIPY = {'RK45': (1e-3, 1e-4, 1e-6, 1e-8, 1e-10), 'DOP853': (1e-3, 1e-6, 1e-8, 1e-10, 1e-12)}
TRUTH = Preset(METHODS['dormand_prince'].record(1e-13), ACCURACY['reference'].limits._replace(settle=1e-5))
NOT_PLAYED = (np.nan, np.nan, np.nan)


class Method(NamedTuple):
    """``play(scene, count)`` plays equal shots and gives the `Truth` of the first."""

    name: str
    setting: str
    play: Callable


def methods(scene):
    """Methods to try on a scene."""
    found = [Method(name, f'{METHODS[name].dial} {setting:.3g}', partial(by_preset, made(name, setting)))
             for name, settings in SETTINGS.items() for setting in settings]
    found += [Method('preset', name, partial(by_preset, preset)) for name, preset in ACCURACY.items()]
    found.append(Method('report_2019', '50 Hz', by_report))
    if scene.flies:
        found += [Method(f'scipy {name}', f'rtol {rtol:.0e}', partial(by_scipy, name, rtol))
                  for name, settings in SCIPY.items() for rtol in settings]
    return tuple(found)


def made(name, setting):
    """`Preset` of an integrator; everything else is as exact as in the preset `reference`."""
    return Preset(METHODS[name].record(setting), ACCURACY['reference'].limits)


def by_preset(preset, scene, count):
    """Play with the engine of this package."""
    return played(scene, preset, count)


def by_report(scene, count):
    """Play as the report of 2019 did."""
    shot = scene.shot
    touch, rest = play_report_2019(scene.course, np.tile(shot.velocity, (count, 1)),
                                   np.tile(shot.spin, (count, 1)), scene.wind)
    return Truth(tuple(touch[0, :2]), tuple(rest[0]))


def by_scipy(name, rtol, scene, count):
    """Fly with scipy up to the first touch."""
    for _ in range(count):
        end = fly(scene, name, rtol)
    return Truth(tuple(end[:2]), NOT_PLAYED)
