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

"""Wind that grows with height: logarithmic wind profile, power law, or the same everywhere."""

from math import isfinite, log
from typing import Iterable, NamedTuple, Sequence, Union

import numpy as np

from . import protocol, Scene
from .protocol import Flow
from ..geometry.surfaces import Ground, ground_level
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import load, scale, store, ZERO

REFERENCE_HEIGHT = 10.0  # m, where the wind is given (WMO)
LEAST_WIND = -1  # law of no wind
MOST_WIND = 100.0  # m/s
# A step ends at the latest where height over the ground, plus the profile's roughness, has changed
# by this factor of itself: the steep part of the profile near the ground would be passed before
# any stage saw it.
GROWTH = 2.0
STEEP = 0.01  # m: the roughness of a profile that has none


class LogProfile(NamedTuple):
    """Logarithmic wind profile u = u10 ln(1 + h/z0) / ln(1 + 10 m/z0).

    z0 is the roughness length [m], the field ``roughness``.
    """

    roughness: float = 0.01


class PowerProfile(NamedTuple):
    """Power law u = u10 (h / 10 m)^`exponent`."""

    exponent: float = 0.14


class UniformProfile(NamedTuple):
    """Uniform profile: the same wind at every height."""


Profile = Union[LogProfile, PowerProfile, UniformProfile]


class Wind(NamedTuple):
    """Wind of `velocity`, an array of 3 [m/s], at 10 m.

    `law` 0 uniform, 1 logarithmic, 2 power, -1 none. The law is a number, not a type, so that a
    course with another law compiles nothing.
    """

    velocity: np.ndarray
    law: int
    parameter: float
    weight: float


@kernel
def share(effect: Wind, height: float) -> float:
    """Ratio of the wind at `height` [m] to that at 10 m."""
    if effect.law == 1:
        return effect.weight * log(1.0 + max(height, 0.0) / effect.parameter)
    if effect.law == 2:
        return (max(height, 0.0) * effect.weight) ** effect.parameter
    return 1.0


@kernel
def from_ground(ground: Ground, position: Vector) -> float:
    """Height [m] of `position` over the ground under it."""
    return position[2] - ground_level(ground, position[0], position[1])


@protocol.air_velocity.register(Wind)
def _air_velocity(effect: Wind, ground: Ground, position: Vector) -> Vector:
    if effect.law == LEAST_WIND:
        return ZERO
    above = 0.0 if effect.law == 0 else from_ground(ground, position)
    return scale(share(effect, above), load(effect.velocity))


@protocol.longest_step.register(Wind)
def _longest_step(effect: Wind, ground: Ground, flow: Flow, force: Vector, wanted: float) -> float:
    if effect.law == LEAST_WIND or effect.law == 0 or load(effect.velocity) == ZERO:
        return wanted
    bending = max(from_ground(ground, flow.position), 0.0) + (
        effect.parameter if effect.law == 1 else STEEP
    )
    return min(max(GROWTH * bending / max(abs(flow.over_ground[2]), 1e-9), protocol.BRIEF), wanted)


@protocol.set_live.register(Wind)
def _set_live(effect: Wind, value: np.ndarray) -> None:
    store(effect.velocity, load(value))


def blowing(profile: Profile, velocity: Sequence[float]) -> Wind:
    """`Wind` record of a wind `velocity` [m/s] at 10 m with a `profile`."""
    at_10_m = np.array(velocity, float)
    if isinstance(profile, LogProfile):
        return Wind(
            at_10_m,
            1,
            float(profile.roughness),
            1.0 / log(1.0 + REFERENCE_HEIGHT / profile.roughness),
        )
    if isinstance(profile, PowerProfile):
        return Wind(at_10_m, 2, float(profile.exponent), 1.0 / REFERENCE_HEIGHT)
    return Wind(at_10_m, 0, 1.0, 1.0)


def record(scene: Scene) -> Wind:
    """Record for `scene`."""
    return blowing(scene.course.wind_profile, scene.live_value('wind'))


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, still air or a field of wind, or ''."""
    if scene.course.wind_field is not None:
        return 'the course has a wind field'
    return '' if any(scene.live_value('wind')) else 'no wind'


def dormant(scene: Scene) -> Wind:
    """Record of a wind that does not blow: one that comes up later compiles nothing."""
    return Wind(np.zeros(3), LEAST_WIND, 1.0, 1.0)


def checked_wind(wind: Iterable[float]) -> tuple[float, ...]:
    """Tuple of three floats of `wind`; ValueError where it is not finite or too strong."""
    wind = tuple(map(float, wind))
    if len(wind) != 3 or not all(map(isfinite, wind)):
        raise ValueError(f'wind {wind} is not three finite numbers')
    if sum(x * x for x in wind) > MOST_WIND * MOST_WIND:
        raise ValueError(f'wind {wind} is over {MOST_WIND:g} m/s')
    return wind


# velocity of the air 10 m above the ground [m/s]
LIVE = protocol.Live(checked_wind, ZERO)
