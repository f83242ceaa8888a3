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

"""Turbulence: a frozen box of eddies that the mean wind carries along.

The box is random, without divergence, periodic, with von Karman's spectrum; see `eddies`. It is
scaled to the standard deviation along the wind that a wind field holds at a place, or else to an
intensity times the wind at 10 m; across it is less, and up less still (Panofsky and Dutton,
"Atmospheric Turbulence", 1984). The same air passes the same place however gusts change, for the
box is carried by the integral of the wind over time.
"""

from functools import lru_cache
from math import floor, isfinite, sqrt
from typing import Any, Mapping, NamedTuple, Optional

import numpy as np

from . import protocol, Scene
from .wind import from_ground
from .wind_field import (
    directions_beside,
    Layout,
    layout_of,
    Near,
    nodes_near,
    smooth_vector,
    spline_weights,
    still,
)
from ..geometry.surfaces import Ground
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import load, store, ZERO

SCALE = 60.0  # m: integral scale along the wind
NODES, SPACING = (128, 128, 32), 4.0  # of the box; m
ACROSS, UPWARD = 0.8, 0.55  # of the standard deviation along the wind
CALM_BELOW = 10.0  # m: below, vertical eddies fade to none at the ground
MOST_INTENSITY = 1.0
MOST_SEED = 2**53  # what a float holds exactly
NONE = (0.0, 0.0, 0.0, 0.0, 0.0)
LENGTH = 1.339  # times the integral scale: the length of von Karman's spectrum


class Turbulence(NamedTuple):
    """Eddies of a ``box`` (n, m, l, 3), spline coefficients of unit variance.

    ``sigma``: standard deviation along the ``wind``, an array of 3 [m/s], over it, where there is
    no field, whose ``deviations`` (nx, ny, nz) are in m/s; ``drift``: x and y of the box [m], and
    the time [s] at which it was there; ``clock``: the time [s] that is asked about.
    """

    box: np.ndarray
    sigma: float
    wind: np.ndarray
    drift: np.ndarray
    clock: np.ndarray
    in_field: bool
    deviations: np.ndarray
    angles: np.ndarray
    ratios: np.ndarray
    layout: Layout


def eddies(
    seed: int, nodes: tuple[int, int, int] = NODES, spacing: float = SPACING, scale: float = SCALE
) -> np.ndarray:
    """Random velocity at the nodes of a periodic box: isotropic, without divergence, (n, m, l, 3).

    Its spectrum is von Karman's (Proc. Natl. Acad. Sci. 34 (1948) 530-539), E(k) = (L k)^4 / (1 +
    (L k)^2)^(17/6) but for a factor, of waves that the nodes resolve.
    """
    angles = wave_angles(nodes)
    waves = [angle / spacing for angle in angles]
    square = np.sum([k * k for k in waves], axis=0)
    square[0, 0, 0] = 1.0
    # of a curl of noise: its waves are k times as large
    amplitude = np.sqrt(energy(np.sqrt(square), scale)) / square
    amplitude[0, 0, 0] = 0.0
    for angle in angles:
        amplitude[abs(angle) == np.pi] = 0.0  # the shortest wave has no direction
    random = np.random.default_rng(seed)
    noise = [amplitude * np.fft.rfftn(random.standard_normal(nodes)) for _ in range(3)]
    (a, b, c), (x, y, z) = noise, waves
    curl = y * c - z * b, z * a - x * c, x * b - y * a
    return np.stack([np.fft.irfftn(1j * part, nodes, axes=(0, 1, 2)) for part in curl], axis=-1)


def wave_angles(nodes: tuple[int, ...]) -> list[np.ndarray]:
    """Wave numbers along the axes, times the spacing, as a real Fourier transform has them."""
    turns = [np.fft.fftfreq(count) for count in nodes[:2]] + [np.fft.rfftfreq(nodes[2])]
    return list(np.meshgrid(*(2.0 * np.pi * turn for turn in turns), indexing='ij'))


def energy(size: np.ndarray, scale: float) -> np.ndarray:
    """Von Karman's energy spectrum at wave numbers of that `size` [rad/m], but for a factor."""
    square = (LENGTH * scale * size) ** 2
    return square * square / (1.0 + square) ** (17.0 / 6.0)


@lru_cache(maxsize=2)
def box_of(seed: int) -> np.ndarray:
    """Coefficients of quadratic splines through `eddies`: what is read of each has variance 1."""
    spectrum = np.fft.rfftn(eddies(seed), axes=(0, 1, 2))
    angles = wave_angles(NODES)
    spectrum /= np.prod([0.75 + 0.25 * np.cos(angle) for angle in angles], axis=0)[..., None]
    # the mean square of a spline of degree 2, between its nodes as well
    read = np.prod(
        [(66.0 + 52.0 * np.cos(angle) + 2.0 * np.cos(2.0 * angle)) / 120.0 for angle in angles],
        axis=0,
    )
    read[..., 1:-1] *= 2.0  # of the waves that a real transform leaves out
    variance = (read[..., None] * abs(spectrum) ** 2).sum((0, 1, 2)) / np.prod(NODES) ** 2.0
    return np.fft.irfftn(spectrum, NODES, axes=(0, 1, 2)) / np.sqrt(variance)


@kernel
def wrapped(place: float, count: int) -> Near:
    """Find the node nearest to a `place` in a periodic row, those beside it, and their weights."""
    near = floor(place + 0.5)
    weights = spline_weights(place - near)
    middle = int(near) % count
    before = middle - 1 if middle > 0 else count - 1
    after = middle + 1 if middle + 1 < count else 0
    return (before, middle, after), weights


@kernel
def eddy_at(effect: Turbulence, position: Vector) -> Vector:
    """Velocity in the box, of unit variance, at a `position` and the time of the clock."""
    box = effect.box
    time = effect.clock[0] - effect.drift[2]
    x = (position[0] - effect.drift[0] - effect.wind[0] * time) / SPACING
    y = (position[1] - effect.drift[1] - effect.wind[1] * time) / SPACING
    return smooth_vector(
        box,
        wrapped(x, box.shape[0]),
        wrapped(y, box.shape[1]),
        wrapped(position[2] / SPACING, box.shape[2]),
    )


@kernel
def deviation_at(effect: Turbulence, position: Vector, above: float) -> float:
    """Deviation [m/s] along the wind at a `position` that high `above` the ground."""
    field = effect.deviations
    columns, rows, height = nodes_near(effect.layout, position, above, field.shape)
    (i, p, q), (a, b, c) = columns
    total = a * sheet_at(field, i, rows, height)
    total += b * sheet_at(field, p, rows, height)
    total += c * sheet_at(field, q, rows, height)
    return max(total, 0.0)


@kernel
def sheet_at(field: np.ndarray, i: int, rows: Near, height: Near) -> float:
    """Sum over three rows and three levels of one number a node."""
    (j, r, s), (d, e, f) = rows
    (k, m, n), (g, h, o) = height
    return (
        d * (g * field[i, j, k] + h * field[i, j, m] + o * field[i, j, n])
        + e * (g * field[i, r, k] + h * field[i, r, m] + o * field[i, r, n])
        + f * (g * field[i, s, k] + h * field[i, s, m] + o * field[i, s, n])
    )


@protocol.air_velocity.register(Turbulence)
def _air_velocity(effect: Turbulence, ground: Ground, position: Vector) -> Vector:
    ex = effect.wind[0]
    ey = effect.wind[1]
    speed = sqrt(ex * ex + ey * ey)
    if speed == 0.0 or effect.sigma == 0.0:
        return ZERO
    ex /= speed
    ey /= speed
    above = max(from_ground(ground, position), 0.0)
    sigma = deviation_at(effect, position, above) if effect.in_field else effect.sigma * speed
    x, y, z = eddy_at(effect, position)
    along = sigma * (x * ex + y * ey)
    across = ACROSS * sigma * (y * ex - x * ey)
    low = min(above / CALM_BELOW, 1.0)
    upward = UPWARD * sigma * z * low * low * (3.0 - 2.0 * low)
    return along * ex - across * ey, along * ey + across * ex, upward


@protocol.longest_step.register(Turbulence)
def _longest_step(
    effect: Turbulence, ground: Ground, flow: protocol.Flow, force: Vector, wanted: float
) -> float:
    if effect.sigma == 0.0 or load(effect.wind) == ZERO:
        return wanted
    return min(max(SPACING / max(flow.speed, 1e-9), protocol.BRIEF), wanted)


@protocol.at_time.register(Turbulence)
def _at_time(effect: Turbulence, time: float) -> None:
    effect.clock[0] = time


@protocol.set_drift.register(Turbulence)
def _set_drift(effect: Turbulence, drift: Vector) -> None:
    store(effect.drift, drift)


@protocol.set_live.register(Turbulence)
def _set_live(effect: Turbulence, value: np.ndarray) -> None:
    wind = load(value)
    store(effect.drift, drifted(load(effect.drift), load(effect.wind), effect.clock[0]))
    store(effect.wind, wind)
    if effect.in_field:
        low, high, first, second = directions_beside(effect.angles, wind)
        one = effect.ratios[low]
        other = effect.ratios[high]
        now = effect.deviations
        for i in range(now.shape[0]):
            for j in range(now.shape[1]):
                for k in range(now.shape[2]):
                    now[i, j, k] = first * float(one[i, j, k]) + second * float(other[i, j, k])


@kernel
def drifted(drift: Vector, wind: Vector, time: float) -> Vector:
    """Find where the box is at a `time`, carried by a `wind` since `drift`: x, y and that time."""
    passed = time - drift[2]
    return drift[0] + wind[0] * passed, drift[1] + wind[1] * passed, time


def checked_turbulence(turbulence: Any) -> tuple[float, ...]:
    """Tuple of five floats of `turbulence`: intensity, seed, and drift, x, y and the time of that.

    The intensity is the standard deviation along the wind over the wind at 10 m; where the course
    has a wind field any over 0 means that of the field. The drift [m] is how far the wind had
    carried the air at a time [s] of the paths. What is left out, all but the intensity, is 0.
    ValueError where it makes no sense.
    """
    given = tuple(map(float, np.atleast_1d(turbulence)))
    if not 1 <= len(given) <= 5 or not all(map(isfinite, given)):
        raise ValueError(f'turbulence {given} is not an intensity, a seed, and a drift')
    count = len(given)
    intensity, seed, *drift = (*given, *NONE[count:])
    if not 0.0 <= intensity <= MOST_INTENSITY:
        raise ValueError(f'turbulence {intensity:g} is not from 0 to {MOST_INTENSITY:g}')
    if seed != int(seed) or not 0 <= seed <= MOST_SEED:
        raise ValueError(f'turbulence_seed {seed:g} is not a whole number from 0 to {MOST_SEED}')
    return (intensity, seed, *drift)


def carried(live: Mapping[str, Any], time: float, now: float) -> tuple[float, ...]:
    """Carry the box with the wind of `live` up to a `time`, which is called `now` from then on."""
    intensity, seed, *drift = live['turbulence']
    if intensity == 0.0:
        return live['turbulence']
    x, y, _ = drifted(tuple(drift), live['wind'], time)
    return intensity, seed, x, y, now


LIVE = protocol.Live(checked_turbulence, NONE, carried)


def record(scene: Scene) -> Turbulence:
    """Record for `scene`."""
    intensity, seed, *drift = scene.live_value('turbulence')
    atlas = scene.course.wind_field or still()
    ratios = atlas.ratios[..., 3]
    low, high, first, second = directions_beside(atlas.angles, scene.live_value('wind'))
    return Turbulence(
        box_of(int(seed)),
        float(intensity),
        np.array(scene.live_value('wind'), float),
        np.array(drift, float),
        np.zeros(1),
        scene.course.wind_field is not None,
        first * ratios[low].astype(float) + second * ratios[high].astype(float),
        atlas.angles,
        ratios,
        layout_of(atlas),
    )


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, steady or still air, or ''."""
    if scene.live_value('turbulence')[0] == 0.0:
        return 'no turbulence was asked for'
    return '' if any(scene.live_value('wind')) else 'no wind'


def dormant(scene: Scene) -> Optional[Turbulence]:
    """Record of turbulence in still air, where some was asked for; else None."""
    return (
        record(scene._replace(live={**scene.live, 'wind': ZERO}))
        if scene.live_value('turbulence')[0] > 0.0
        else None
    )
