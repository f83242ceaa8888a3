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

"""Errors of simulated flights against what a launch monitor told, by law and by group."""

from collections.abc import Iterable, Sequence
from math import inf
from typing import NamedTuple

import numpy as np

from ..physics import Air, Course, Material, Plane, Restitution, simulate_many
from ..shot_input.launch_monitor import Launch, Vector, velocity_and_spin
from ..shot_input.monitor_file import MonitorShots
from ..shot_input.units import DEGREE, Unit, Units

# Sets of effects that make a law of flight, by the name it is asked for.
LAWS = {
    'fitted': ('drag', 'magnus'),
    'ferguson_2022': ('ferguson_drag', 'ferguson_lift'),
    'smits_smith_1994': ('smits_smith_1994',),
    'naruo_2004': ('naruo_2004',),
    'bearman_harvey_1976': ('bearman_harvey_1976',),
    'linear': ('linear_drag', 'magnus'),
}
# Ground that ends a shot where it lands: nothing but the flight is compared.
SOFT = Material('landing area', Restitution(0.0), 0.0, 1.0, 1.0, 1.0, 0.0)
SPIN_RATIOS = (0.0, 0.06, 0.09, 0.13, 0.2, 0.3, 0.5, inf)  # borders of the bins
SPEEDS = 20.0  # mph, or m/s: width of the bins
SECOND = Unit('s', 1.0)
STANDARD = Air()

Figures = tuple[tuple[str, Unit], ...]  # name and unit of each


class Group(NamedTuple):
    """Some of the shots: what they have in common, and which they are."""

    label: str
    shots: np.ndarray


class Comparison(NamedTuple):
    """Errors of a set of shots.

    Parameters
    ----------
    errors : dict
        By law: simulated less told, (4, n): carry, apex [m], landing angle [rad], time [s]; nan
        where nothing was told.
    groups : dict
        Lists of `Group` by heading.
    ratios : numpy.ndarray, shape (n,)
        Spin ratios at launch.
    """

    errors: dict[str, np.ndarray]
    groups: dict[str, list[Group]]
    ratios: np.ndarray


def compare(
    shots: MonitorShots,
    laws: Sequence[str],
    units: Units,
    air: Air = STANDARD,
    wind: Vector = (0.0, 0.0, 0.0),
) -> Comparison:
    """Fly the shots of a launch monitor by each of the laws and compare.

    Parameters
    ----------
    shots : MonitorShots
    laws : sequence of str
        Names in `LAWS`.
    units : Units
        Those in which bins of speed are round.
    air : Air
    wind : tuple of 3 float
        Where the air goes, 10 m above the ground [m/s].

    Returns
    -------
    Comparison
    """
    course = Course((Plane(material=SOFT),), air=air)
    errors = {law: flown(shots.launches, course, LAWS[law], wind) - shots.told for law in laws}
    radius = course.ball.radius
    ratios = np.array(
        [radius * np.hypot(shot.backspin, shot.sidespin) / shot.speed for shot in shots.launches]
    )
    speeds = np.array([shot.speed for shot in shots.launches]) / units.speed.size
    groups = {
        'club': by_club(shots.clubs),
        f'ball speed [{units.speed.name}]': by_bin(
            speeds, np.arange(0.0, speeds.max() + 2 * SPEEDS, SPEEDS)
        ),
        'spin ratio': by_bin(ratios, SPIN_RATIOS),
    }
    groups = {name: found for name, found in groups.items() if found}
    return Comparison(errors, groups, ratios)


def flown(
    launches: Iterable[Launch], course: Course, effects: Sequence[str], wind: Vector
) -> np.ndarray:
    """Carry, apex [m], landing angle [rad] and time [s] of flights, (4, n); nan: one fails."""
    velocities, spins = map(np.array, zip(*map(velocity_and_spin, launches)))
    blowing = ('wind',) if any(wind) else ()
    effects = ('gravity', *effects, 'spin_decay', *blowing)
    ends = simulate_many(course, velocities, spins, wind=wind, effects=effects)
    found = np.array(
        [ends[name] for name in ('carry', 'apex', 'landing_angle', 'flight_time')], float
    )
    found[:, ~(ends['flight_time'] > 0.0)] = np.nan
    return found


def by_club(clubs: Sequence[str]) -> list[Group]:
    """`Group` of each club, in the order in which they come; none where none is named."""
    if not any(clubs):
        return []
    names = np.array(clubs)
    return [Group(name or 'no club named', names == name) for name in dict.fromkeys(clubs)]


def by_bin(values: np.ndarray, borders: Sequence[float] | np.ndarray) -> list[Group]:
    """`Group` of each bin that holds any of the values."""
    bins = [
        Group(
            f'{low:g} to {high:g}' if high < inf else f'over {low:g}',
            (low <= values) & (values < high),
        )
        for low, high in zip(borders, borders[1:])
    ]
    return [group for group in bins if group.shots.any()]


def bias_and_spread(errors: np.ndarray) -> tuple[float, float, int]:
    """Mean and standard deviation of those errors that are known, and how many those are."""
    known = errors[np.isfinite(errors)]
    if not len(known):
        return np.nan, np.nan, 0
    return float(known.mean()), float(known.std()), len(known)


def figures(units: Units) -> Figures:
    """Name and unit of each of the figures compared."""
    return (
        ('carry', units.length),
        ('apex', units.length),
        ('landing angle', DEGREE),
        ('flight time', SECOND),
    )
