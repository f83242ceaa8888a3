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

"""Rectangle: a thin sheet, hit from both sides unless it is one-sided."""

from typing import NamedTuple

from .polygon import Outline
from ..kernel_types import Vector
from ..properties.material import Material


class Patch(NamedTuple):
    """Rectangle around `center` with unit `normal`.

    `length` [m] lies along `heading` (radians from x towards y, projected into the rectangle's
    plane), `width` [m] across it. `cut` holds polygons, tuples of (x, y), where the sheet ends.
    """

    center: Vector
    normal: Vector = (0.0, 0.0, 1.0)
    heading: float = 0.0
    length: float = 1.0
    width: float = 1.0
    material: Material = Material()
    one_sided: bool = False
    cut: tuple[Outline, ...] = ()
