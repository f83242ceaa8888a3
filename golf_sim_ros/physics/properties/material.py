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

"""Material of a surface: restitution, friction, rolling resistance, softness."""

from typing import Iterable, NamedTuple

import numpy as np

from ..jit import kernel
from ..kernel_types import MaterialRecord

STANDARD_GRAVITY = 9.80665  # m/s^2, CGPM 1901
FOOT = 0.3048  # m, exact
STIMPMETER_SPEED = 1.83  # m/s: a ball leaves the 36 in bar at 6.00 ft/s (USGA)


class Restitution(NamedTuple):
    """Coefficient of restitution over the approach speed: ``e0 + e1 v + e2 v^2``.

    It is held at its least value. ``v`` is the normal approach speed [m/s]; ``e1`` in s/m, ``e2``
    in s^2/m^2. Past the vertex of the parabola, and wherever it would fall below ``floor``, the
    law stays constant, so it never rises with speed.
    """

    e0: float = 0.0
    e1: float = 0.0
    e2: float = 0.0
    floor: float = 0.0


# Penner, "The run of a golf ball", Can. J. Phys. 80 (2002) 931-940: a fit to Haake's bounces on
# turf up to 20 m/s, constant above.
PENNER = Restitution(0.510, -0.0375, 0.000903, 0.120)


class Material(NamedTuple):
    """Material of a surface. Whatever is left out is 0.

    Parameters
    ----------
    name : str
    restitution : Restitution
    tangential_restitution : float
        -1 (frictionless) .. 0 (grips) .. 1 (superball).
    static_friction, dynamic_friction : float
        Coulomb's coefficients.
    rolling_resistance : float
        Deceleration of a ball rolling slowly on the level, over g.
    resistance_growth : float
        Growth of that with the speed v, by the factor 1 + `resistance_growth` v^2 [s^2/m^2]: what
        grows acts on the ball's centre, of a ball that slides, too.
    pivot_friction : float
        Torque against spin about the normal, over the normal force [m].
    softness : float
        Scales the tilt of the contact normal of soft turf; 0 is hard.
    ploughing : float
        Over 0 the ground is loose, as sand: an impact brakes the ball's centre by this times the
        normal impulse, without the limit of grip, and rubs on its spin all around.
    color : tuple of 3 floats
        Red, green, blue, 0..1.
    drag : float
        Over 0 a ball passes through, as through leaves, and is braked by drag v^2 at speed v
        [1/m].
    roughness : float
        Roughness length that the wind feels [m]; 0: that of the course's wind profile.
    canopy_drag : float
        Of leaves: leaf-area density times drag coefficient, by which they brake the wind [1/m].
    """

    name: str = 'ideal'
    restitution: Restitution = Restitution()
    tangential_restitution: float = 0.0
    static_friction: float = 0.0
    dynamic_friction: float = 0.0
    rolling_resistance: float = 0.0
    pivot_friction: float = 0.0
    softness: float = 0.0
    color: tuple[float, float, float] = (0.5, 0.5, 0.5)
    drag: float = 0.0
    resistance_growth: float = 0.0
    ploughing: float = 0.0
    roughness: float = 0.0
    canopy_drag: float = 0.0


def rolling_resistance_of_stimp(stimp: float) -> float:
    """Return the rolling resistance of a green on which a stimpmeter's ball rolls `stimp` feet."""
    return STIMPMETER_SPEED * STIMPMETER_SPEED / (2 * FOOT * stimp) / STANDARD_GRAVITY


# What a course file may say of each number of a material: at least, and at most where that has a
# limit. Kernels read all of them.
RANGES: dict[str, tuple[float, ...]] = {
    'tangential_restitution': (-1.0, 1.0),
    'static_friction': (0.0,),
    'dynamic_friction': (0.0,),
    'rolling_resistance': (0.0,),
    'pivot_friction': (0.0,),
    'softness': (0.0, 100.0),
    'resistance_growth': (0.0, 100.0),
    'ploughing': (0.0, 100.0),
    'drag': (0.0, 1000.0),
    'roughness': (1e-6, 10.0),
    'canopy_drag': (0.0, 100.0),
}
MATERIAL = np.dtype([(name, 'f8') for name in (*Restitution._fields, *RANGES)], align=True)


def table(materials: Iterable[Material]) -> np.ndarray:
    """`materials` as a structured array for kernels.

    Static friction is never less than dynamic friction: a contact that slips at once when it grips
    could neither roll nor slide.
    """
    held = [
        m._replace(static_friction=max(m.static_friction, m.dynamic_friction)) for m in materials
    ]
    rows = [(*m.restitution, *(getattr(m, name) for name in RANGES)) for m in held]
    return np.array(rows, MATERIAL)


@kernel
def restitution(material: MaterialRecord, speed: float) -> float:
    """Coefficient of restitution for a normal approach `speed` [m/s]."""
    e1 = material['e1']
    e2 = material['e2']
    v = speed
    if e1 < 0.0 and e2 > 0.0:
        v = min(v, -0.5 * e1 / e2)
    e = material['e0'] + e1 * v + e2 * v * v
    return min(max(e, material['floor']), 1.0)
