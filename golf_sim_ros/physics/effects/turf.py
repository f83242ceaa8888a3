# SPDX-License-Identifier: Apache-2.0
"""Soft turf: the ball pushes up a bank, so the contact normal tilts towards where it came from.

::

        v \\      ^ n'            n   normal of the ground
           \\    /  ^ n           n'  normal that the ball feels
            \\  / t |             t   tilt
        ________\\|_|________
"""
from math import acos, cos, pi, sin, tanh
from typing import NamedTuple

from ..vector import add, dot, length, scale, tangential
from . import laws

# Penner, Can. J. Phys. 80 (2002) 931-940: 15.4 degrees at 18.6 m/s and 44.4 degrees from the
# vertical, proportional to both. As published it grows without bound (95 degrees for a skimmer
# of 60 m/s); here it saturates smoothly below 30 degrees. It was measured on impacts that dig in;
# one that only grazes must not tilt, or a ball that skims along would be thrown up for ever. So the
# tilt fades with the approach speed's square over that of FADE (estimate).
TILT = 15.4 * pi / 180
SPEED = 18.6  # m/s
ANGLE = 44.4 * pi / 180
MOST = 30.0 * pi / 180
FADE = 1.5  # m/s


class Turf(NamedTuple):
    """Tilt `rate` [s/m]: radians of tilt per m/s and radian from the normal; `most` [rad].

    `fade` [m/s]: approach speed at which the tilt is half of that.
    """

    rate: float = TILT / (SPEED * ANGLE)
    most: float = MOST
    fade: float = FADE


@laws.contact_normal.register(Turf)
def _contact_normal(effect, normal, velocity, softness):
    across = tangential(velocity, normal)
    sideways = length(across)
    if softness == 0.0 or sideways == 0.0:
        return normal
    speed = length(velocity)
    approach = max(-dot(velocity, normal), 0.0)
    from_normal = acos(min(approach / speed, 1.0))
    dug_in = approach * approach / (approach * approach + effect.fade * effect.fade)
    tilt = effect.most * tanh(softness * effect.rate * speed * from_normal * dug_in / effect.most)
    return add(scale(cos(tilt), normal), scale(-sin(tilt) / sideways, across))


def record(scene):
    """Record for `scene`."""
    return Turf()


def idle(scene):
    """Why `scene` can do without: where all ground is hard."""
    soft = any(shape.material.softness > 0 for shape in scene.course.ground)
    return '' if soft else 'all ground is hard'
