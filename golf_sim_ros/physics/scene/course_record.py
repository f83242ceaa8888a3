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

"""Course and ball as plain records: no files, no formats."""

from typing import NamedTuple, Optional, Union

from ..effects.wind import LogProfile, Profile
from ..effects.wind_field import WindAtlas
from ..geometry.cup import CUP_MATERIAL
from ..geometry.polygon import Outline
from ..geometry.solid import FLAGSTICK_MATERIAL
from ..geometry.water_surface import Water
from ..geometry.zone import Zone
from ..kernel_types import ShapeRecord
from ..properties.air import Air
from ..properties.material import Material


class Ball(NamedTuple):
    """Golf ball: R&A and USGA Equipment Rules part 4 give mass and radius.

    ``inertia`` is the moment of inertia over m r^2; ``restitution`` and ``friction`` are those of
    ball against ball.
    """

    mass: float = 0.04593
    radius: float = 0.021335
    inertia: float = 0.4
    restitution: float = 0.85
    friction: float = 0.2


class Course(NamedTuple):
    """Course, ready to be played.

    Parameters
    ----------
    ground : tuple
        Shapes, lowest priority first: at equal height the later one counts.
    tee : (float, float)
        x, y of the first ball [m].
    hole : (float, float) or None
        x, y; the ground must be even all round.
    flagstick : bool
        Whether one stands in the hole.
    cup, stick : Material
        Of the hole's bottom, and of the flagstick; rim and wall are of the ground around.
    bounds : tuple of (float, float), or None
        Corners of the polygon that a ball on the ground may not leave.
    zones : tuple of Zone
        Polygons that repaint the ground from above, later over earlier; pairs (Material, polygon)
        will do.
    obstacles : tuple
        Shapes that stand on the ground and are none: hard, or leaves where the material has a
        drag.
    water : tuple of Water
        Ponds, lakes, burns: level surfaces; each needs ground below it.
    air : Air
    wind_profile : LogProfile, PowerProfile or UniformProfile
    wind_field : WindAtlas or None
        Of the wind over this ground, which then takes the place of the profile.
    effects : 'auto' or tuple of str
    ball : Ball
    name, path, digest : str
        What a person calls it; where it was read; a hash of all that was read.
    notes : tuple of str
        What was put right in it when it was read: a line each.
    """

    ground: tuple[ShapeRecord, ...]
    tee: tuple[float, float] = (0.0, 0.0)
    hole: Optional[tuple[float, float]] = None
    flagstick: bool = True
    cup: Material = CUP_MATERIAL
    stick: Material = FLAGSTICK_MATERIAL
    bounds: Optional[Outline] = None
    zones: tuple[Union[Zone, tuple[Material, Outline]], ...] = ()
    obstacles: tuple[ShapeRecord, ...] = ()
    water: tuple[Water, ...] = ()
    air: Air = Air()
    wind_profile: Profile = LogProfile()
    wind_field: Optional[WindAtlas] = None
    effects: Union[str, tuple[str, ...]] = 'auto'
    ball: Ball = Ball()
    name: str = ''
    path: str = ''
    digest: str = ''
    notes: tuple[str, ...] = ()
