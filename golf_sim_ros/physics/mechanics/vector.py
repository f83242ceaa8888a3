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

"""Vector algebra on tuples of three floats, which numba keeps in registers."""

from math import sqrt

import numpy as np

from ..jit import kernel
from ..kernel_types import Vector

ZERO = (0.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)


@kernel
def load(row: np.ndarray) -> Vector:
    """Load an array of three as a tuple."""
    return row[0], row[1], row[2]


@kernel
def store(row: np.ndarray, a: Vector) -> None:
    """Store the tuple `a` in an array of three, `row`. Writes row."""
    row[0] = a[0]
    row[1] = a[1]
    row[2] = a[2]


@kernel
def add(a: Vector, b: Vector) -> Vector:
    """Sum a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@kernel
def sub(a: Vector, b: Vector) -> Vector:
    """Difference a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def scale(k: float, a: Vector) -> Vector:
    """Product k a of a number and a vector."""
    return k * a[0], k * a[1], k * a[2]


@kernel
def add_scaled(a: Vector, k: float, b: Vector) -> Vector:
    """Sum a + k b."""
    return a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]


@kernel
def dot(a: Vector, b: Vector) -> float:
    """Dot product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a: Vector, b: Vector) -> Vector:
    """Cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@kernel
def length(a: Vector) -> float:
    """Euclidean norm."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@kernel
def unit(a: Vector, otherwise: Vector) -> Vector:
    """Scale `a` to unit length; `otherwise` where it is zero."""
    size = length(a)
    if size == 0.0:
        return otherwise
    return a[0] / size, a[1] / size, a[2] / size


@kernel
def tangential(a: Vector, normal: Vector) -> Vector:
    """Component of `a` orthogonal to the unit vector `normal`."""
    return add_scaled(a, -dot(a, normal), normal)
