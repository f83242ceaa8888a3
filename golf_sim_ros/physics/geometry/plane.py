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

"""Endless plane, solid below, that may be cut open."""

from typing import NamedTuple

from .polygon import Outline
from ..kernel_types import Vector
from ..properties.material import Material


class Plane(NamedTuple):
    """Plane through `point` with unit `normal`, solid on the other side.

    `cut` holds polygons, tuples of (x, y), where the surface ends: a pit with walls along the
    normal opens there.
    """

    point: Vector = (0.0, 0.0, 0.0)
    normal: Vector = (0.0, 0.0, 1.0)
    material: Material = Material()
    cut: tuple[Outline, ...] = ()
