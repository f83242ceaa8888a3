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

"""Whole shots through `simulate_many`, against scipy's flight alone."""

from concurrent.futures import ThreadPoolExecutor
from math import hypot
from time import perf_counter

from golf_sim_ros.course import load_course
from golf_sim_ros.course.material_file import materials, shipped
from golf_sim_ros.physics import ACCURACY, METHODS, Preset, simulate_many
from golf_sim_ros.physics.scene.kernel_model import Limits
from golf_sim_ros.study.against_scipy import trapped
from golf_sim_ros.study.measure import played
from golf_sim_ros.study.methods import TRUTH
from golf_sim_ros.study.scenes import club_shot, EFFECTS, level, Scene
from golf_sim_ros.study.scipy_flight import fly
import numpy as np
from timing import clocked, faster, lone, Row

SHOTS = 10000
FLIGHTS = 20
LEVELS = tuple(10.0**-i for i in range(10))  # m
RTOLS = tuple(10.0 ** (-0.5 * i) for i in range(2, 27))
TOLERANCES = tuple(10.0 ** (-0.5 * i) for i in range(27))
EVERYTHING = {'effects': (*EFFECTS, 'wind'), 'wind': (5.0, 3.0, 0.0)}


def rows(quick):
    """`Row` of each figure."""
    drive = Scene('drive', level(ground('fairway')), club_shot('driver'))
    yield faster(
        'drive to rest on a level fairway, over scipy RK45 1e-6 flying only',
        volley(drive),
        flights(drive, 'RK45', 1e-6),
        (SHOTS, FLIGHTS),
        least=100.0,
    )
    hole = drive._replace(course=load_course('golf_without_friends'))
    yield faster(
        'the same on golf_without_friends',
        volley(hole),
        flights(drive, 'RK45', 1e-6),
        (SHOTS, FLIGHTS),
    )
    yield Row(
        'drives a second on a level fairway, one thread',
        1.0 / lone(volley(drive), SHOTS),
        'a second',
        least=30000.0,
    )
    with ThreadPoolExecutor(2) as two:
        yield faster(
            'two threads, over one',
            volley(drive, 4 * SHOTS, executor=two, chunks=8),
            volley(drive, 4 * SHOTS),
            clock=perf_counter,
            least=1.5,
        )
    flight = trapped(drive)  # it ends where it lands
    yield faster(
        'flight with gravity alone, over one with drag, lift, spin decay, wind',
        volley(flight, effects=('gravity',)),
        volley(flight, **EVERYTHING),
        least=3.0,
    )
    yield from error_levels(flight, LEVELS[::3] if quick else LEVELS)


def ground(name):
    """Return a shipped `Material`."""
    return materials({}, shipped()[0])[name]


def volley(scene, count=SHOTS, accuracy='standard', **how):
    """Return a function that plays `count` equal shots of a scene."""
    velocities, spins = (
        np.tile(scene.shot.velocity, (count, 1)),
        np.tile(scene.shot.spin, (count, 1)),
    )
    how = {'effects': scene.effects, 'wind': scene.wind, **how}
    return lambda: simulate_many(scene.course, velocities, spins, accuracy=accuracy, **how)


def flights(scene, method, rtol):
    """Return a function that lets scipy fly FLIGHTS times.

    One flight alone would find the caches full of our shots.
    """
    return lambda: [fly(scene, method, rtol) for _ in range(FLIGHTS)]


def error_levels(scene, levels):
    """Rows: our fastest setting that is exact to a level at first touch, over scipy's fastest."""
    truth = played(scene, TRUTH).touch
    ours, theirs = [], []
    for preset in settings():
        off = hypot(*np.subtract(played(scene, preset).touch, truth))
        ours.append((off, clocked(volley(scene, SHOTS, preset)), preset))
    for method in ('RK45', 'DOP853'):
        for rtol in RTOLS:
            off = hypot(*np.subtract(fly(scene, method, rtol)[:2], truth))
            theirs.append((off, clocked(flights(scene, method, rtol)), method, rtol))
    for limit in levels:
        _, _, preset = min((row for row in ours if row[0] <= limit), key=lambda row: row[1])
        _, _, method, rtol = min(
            (row for row in theirs if row[0] <= limit), key=lambda row: row[1]
        )
        yield faster(
            f'flight of a drive, first touch exact to {limit:.0e} m, over scipy',
            volley(scene, SHOTS, preset),
            flights(scene, method, rtol),
            (SHOTS, FLIGHTS),
            least=80.0,
            note=f'tolerance {preset.method.tolerance:.0e}; {method} {rtol:.0e}',
        )


def settings():
    """Presets to try: Dormand-Prince over its tolerances, with limits from coarse to fine.

    The finest limits are those of `reference`.
    """
    for tolerance in TOLERANCES:
        for limits in (
            Limits(settle=1.0, path=1e-3),
            *(preset.limits for preset in ACCURACY.values()),
        ):
            yield Preset(METHODS['dormand_prince'].record(tolerance), limits)
