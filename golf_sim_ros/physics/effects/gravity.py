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

"""Gravity: the same everywhere, downward."""

from typing import NamedTuple

from . import protocol, Scene
from ..kernel_types import Vector
from ..properties.material import STANDARD_GRAVITY


class Gravity(NamedTuple):
    """Uniform gravity `g` [m/s^2] along -z."""

    g: float = STANDARD_GRAVITY


@protocol.gravity.register(Gravity)
def _gravity(effect: Gravity, position: Vector) -> Vector:
    return 0.0, 0.0, -effect.g


def record(scene: Scene) -> Gravity:
    """Record for `scene`."""
    return Gravity()


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect: none, always ''."""
    return ''


def dormant(scene: Scene) -> Gravity:
    """Record of no gravity: a play without it compiles nothing."""
    return Gravity(0.0)
