# SPDX-License-Identifier: Apache-2.0
"""Soft turf as Penner (2002) published it: the contact normal's tilt grows without bound."""
from typing import NamedTuple

from ..mechanics.vector import length, tangential
from . import protocol
from .turf import ANGLE, SPEED, TILT, idle, steepness, tilted  # noqa: F401  (idle where turf is)

INSTEAD_OF = ('turf',)


class Penner2002(NamedTuple):
    """Tilt `rate` [s/m]: radians of tilt per m/s and radian from the normal.

    Penner, Can. J. Phys. 80 (2002) 931-940, from impacts of 18.6 m/s at 44.4 degrees from the vertical.
    Far from there, above some 30 m/s or where a ball skims, it turns the ground over; `turf` is bounded.
    """

    rate: float = TILT / (SPEED * ANGLE)


@protocol.contact_normal.register(Penner2002)
def _contact_normal(effect, normal, velocity, softness):
    across = tangential(velocity, normal)
    if softness == 0.0 or length(across) == 0.0:
        return normal
    return tilted(normal, across, softness * effect.rate * steepness(velocity, normal))


def record(scene):
    """Record for `scene`."""
    return Penner2002()
