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

"""Gusts: wind as a function of time.

Every gust and every step of the turbulence has a random generator of its own, named by seed and
number. So the wind at a time depends on the seed, the settings and that time alone: it may be
asked in any order, before time zero too, and a clock that starts again finds the same gusts again.
"""

from functools import lru_cache
from itertools import accumulate
from math import cos, exp, floor, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

# Eddies of 60 m (50 to 120 m are usual 10 m above open country) carried by 4 m/s pass in 15 s.
TURBULENCE_TIME = 15.0  # s, correlation time of the turbulence

Pair = tuple[float, float]  # x and y

_GUSTS, _TURBULENCE = 0, 1  # which of a seed's two families of generators
_STEPS = 100  # steps of the turbulence in a correlation time
_BLOCK = 40 * _STEPS  # after these steps only exp(-40) of a value is left


class GustSettings(NamedTuple):
    """Settings of the gusts.

    Parameters
    ----------
    speed, speed_spread : float
        A gust's speed is uniform in ``speed`` +- ``speed_spread``, never below 0 [m/s].
    direction, direction_spread : float
        Where the air goes, uniform in ``direction`` +- ``direction_spread``, an angle from x
        towards y [rad].
    interval : float
        Time from one gust to the next [s].
    ramp : float
        Time over which a gust is eased in [s]; what is over ``interval`` is cut off.
    turbulence : float
        Standard deviation of the turbulence, in each of x and y, over the speed of the gust.
    """

    speed: float = 4.0
    speed_spread: float = 3.0
    direction: float = 0.0
    direction_spread: float = pi
    interval: float = 10.0
    ramp: float = 1.0
    turbulence: float = 0.0


class Gusts:
    """Wind as a function of time, with settings that may change meanwhile.

    Parameters
    ----------
    settings : GustSettings
    seed : int
        Not negative. The same seed gives the same gusts.
    """

    def __init__(self, settings: GustSettings, seed: int) -> None:
        self.settings = settings
        self.seed = seed
        self._changed_at = 0.0
        # how far the wind was from the new settings' when they changed
        self._left_over = (0.0, 0.0)

    def wind(self, time: float) -> tuple[float, float, float]:
        """Velocity (x, y, z) [m/s] of the wind at `time` [s]."""
        x, y = turbulent_wind(self.settings, self.seed, time)
        since = time - self._changed_at
        left = 1.0 - _eased(since, self.settings.ramp) if since >= 0.0 else 0.0
        return x + left * self._left_over[0], y + left * self._left_over[1], 0.0

    def change(self, settings: GustSettings, time: float) -> None:
        """Change to new `settings` from `time` on, eased in over their ramp."""
        old_x, old_y, _ = self.wind(time)
        new_x, new_y = turbulent_wind(settings, self.seed, time)
        self.settings = settings
        self._changed_at = time
        self._left_over = (old_x - new_x, old_y - new_y)


def gust(settings: GustSettings, seed: int, number: int) -> Pair:
    """Velocity (x, y) [m/s] of the gust `number`, any integer, once it is eased in."""
    by_speed, by_direction = _draws(seed, number)
    speed = max(0.0, settings.speed + by_speed * settings.speed_spread)
    direction = settings.direction + by_direction * settings.direction_spread
    return speed * cos(direction), speed * sin(direction)


@lru_cache(maxsize=8)
def _draws(seed: int, number: int) -> list[float]:
    return _generator(seed, _GUSTS, number).uniform(-1.0, 1.0, 2).tolist()


def gust_wind(settings: GustSettings, seed: int, time: float) -> Pair:
    """Velocity (x, y) [m/s] of the wind at `time` [s], without turbulence."""
    number = floor(time / settings.interval)
    ramp = min(settings.ramp, settings.interval)
    share = _eased(time - number * settings.interval, ramp)
    old, new = gust(settings, seed, number - 1), gust(settings, seed, number)
    return _between(old, new, share)


def turbulent_wind(settings: GustSettings, seed: int, time: float) -> Pair:
    """Velocity (x, y) [m/s] of the wind at `time` [s], with turbulence."""
    x, y = gust_wind(settings, seed, time)
    if settings.turbulence == 0.0:
        return x, y
    deviation = settings.turbulence * sqrt(x * x + y * y)
    by_x, by_y = turbulence(seed, time / TURBULENCE_TIME)
    return x + deviation * by_x, y + deviation * by_y


def turbulence(seed: int, time: float) -> Pair:
    """Values of two independent Ornstein-Uhlenbeck processes at `time`.

    Both have mean 0, variance 1 and correlation time 1: the covariance of values a time t apart
    is exp(-t). The steps are exact, whatever their length: u exp(-h) + sqrt(1 - exp(-2h)) N(0, 1).
    Between the steps, 1/100 long, lies a straight line.
    """
    place = time * _STEPS
    step = floor(place)
    share = place - step
    return _between(_at_step(seed, step), _at_step(seed, step + 1), share)


def _at_step(seed: int, step: int) -> Pair:
    block, index = divmod(step, _BLOCK)
    return _walk(seed, block)[index]


@lru_cache(maxsize=4)
def _walk(seed: int, block: int) -> list[Pair]:
    """Values of the processes at the steps of a `block`.

    They begin one block earlier, long forgotten.
    """
    h = 1.0 / _STEPS
    kept, kick = exp(-h), sqrt(1.0 - exp(-2.0 * h))
    kicks = kick * np.concatenate([_noise(seed, block - 1), _noise(seed, block)])
    walks = [accumulate(walk.tolist(), lambda u, by: kept * u + by) for walk in kicks.T]
    return list(zip(*walks))[_BLOCK:]


def _noise(seed: int, block: int) -> np.ndarray:
    return _generator(seed, _TURBULENCE, block).standard_normal((_BLOCK, 2))


def _generator(seed: int, family: int, number: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(family, number % 2**64)))


def _between(a: Pair, b: Pair, share: float) -> Pair:
    x, y = ((1.0 - share) * old + share * new for old, new in zip(a, b))
    return x, y


def _eased(since: float, ramp: float) -> float:
    """Share, 0 to 1, of a change that began `since` [s] ago, smooth at both ends of the `ramp`."""
    if since >= ramp:
        return 1.0
    share = since / ramp
    return share * share * (3.0 - 2.0 * share)
