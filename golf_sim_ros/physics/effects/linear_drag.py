# SPDX-License-Identifier: Apache-2.0
"""Air resistance proportional to speed, as in the report "Golf Without Friends" (KTH 2019)."""
from typing import NamedTuple

from ..mechanics.vector import scale
from . import protocol

INSTEAD_OF = ('drag',)


class LinearDrag(NamedTuple):
    """Drag force -c v, `rate` = c/m [1/s].

    The default is an estimate: it gives the deceleration of a golf ball's quadratic drag of
    coefficient 0.25 at 40 m/s.
    """

    rate: float = 0.18


@protocol.acceleration.register(LinearDrag)
def _acceleration(effect, flow):
    return scale(-effect.rate, flow.velocity)


def record(scene):
    """Record for `scene`."""
    return LinearDrag()


def idle(scene):
    """Reason why `scene` does without the effect, no air, or ''."""
    return '' if scene.course.air.pressure > 0 else 'no air'
