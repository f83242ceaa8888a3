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

"""Drag and lift after Bearman and Harvey (1976): their table, interpolated by a C1 curve."""

from typing import NamedTuple

import numpy as np

from . import protocol, Scene
from .drag import dynamic_push
from .protocol import Flow
from .published import drag_and_lift, spin_axis_terms, spin_ratio
from ..jit import kernel
from ..kernel_types import Vector
from ..mechanics.vector import ZERO

# Aeronautical Quarterly 27 (1976) 112-122, as digitised by others, +-0.008: Re of 1.26e5 to
# 2.38e5.
# fmt: off
RATIO = (0.02, 0.05, 0.075, 0.10, 0.125, 0.15, 0.175, 0.20, 0.225, 0.25, 0.275, 0.342, 0.46,
         0.641, 1.0)
DRAG = (0.265, 0.264, 0.265, 0.267, 0.276, 0.283, 0.291, 0.299, 0.306, 0.3125, 0.319, 0.366, 0.391,
        0.455, 0.544)
LIFT = (0.081, 0.111, 0.129, 0.144, 0.159, 0.177, 0.194, 0.211, 0.230, 0.2465, 0.262, 0.302, 0.352,
        0.404, 0.452)
# fmt: on

INSTEAD_OF = ('drag', 'magnus')


class BearmanHarvey1976(NamedTuple):
    """Rows of spin ratio, CD, CL and their slopes in ``table``; `push` is rho A / (2 m) [1/m].

    Held below the first row and beyond the last.
    """

    push: float
    radius: float
    table: np.ndarray


@kernel
def interpolated(table: np.ndarray, s: float) -> tuple[float, float]:
    """Drag and lift coefficient at `s`: Hermite's cubic between two rows."""
    last = len(table) - 1
    s = min(max(s, table[0, 0]), table[last, 0])
    i = 0
    while i < last - 1 and s > table[i + 1, 0]:
        i += 1
    h = table[i + 1, 0] - table[i, 0]
    t = (s - table[i, 0]) / h
    a = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t)
    b = t * t * (3.0 - 2.0 * t)
    c = h * t * (1.0 - t) * (1.0 - t)
    d = -h * t * t * (1.0 - t)
    return (
        a * table[i, 1] + b * table[i + 1, 1] + c * table[i, 3] + d * table[i + 1, 3],
        a * table[i, 2] + b * table[i + 1, 2] + c * table[i, 4] + d * table[i + 1, 4],
    )


@protocol.acceleration.register(BearmanHarvey1976)
def _acceleration(effect: BearmanHarvey1976, flow: Flow) -> Vector:
    if flow.speed == 0.0:
        return ZERO
    ratio = spin_ratio(effect.radius, flow)
    drag, lift = interpolated(effect.table, ratio)
    return drag_and_lift(effect.push, flow, ratio, drag, lift)


protocol.longest_step.register(BearmanHarvey1976)(spin_axis_terms)


def record(scene: Scene) -> BearmanHarvey1976:
    """Record for `scene`."""
    rows = np.array((RATIO, DRAG, LIFT))
    slopes = np.gradient(rows[1:], rows[0], axis=1)
    slopes[:, (0, -1)] = 0.0  # it is held beyond
    table = np.ascontiguousarray(np.vstack((rows, slopes)).T)
    return BearmanHarvey1976(dynamic_push(scene.course), scene.course.ball.radius, table)


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
