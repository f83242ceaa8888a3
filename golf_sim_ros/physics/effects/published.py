# SPDX-License-Identifier: Apache-2.0
"""Shared part of the published laws of drag and lift: from coefficients to an acceleration."""
from math import sqrt

from ..jit import kernel
from ..mechanics.vector import add, cross, length, scale
from . import protocol
from .drag import CREEPING

# The published laws give lift at no spin, where it has no direction, or let it set in infinitely steeply.
# Below this spin ratio it fades to zero smoothly. (Estimate; a drive flies at 0.08 and more.)
FADE = 0.01


@kernel
def spin_ratio(radius, flow):
    """Spin ratio, spin times radius over speed, of the whole spin, as in the published laws."""
    return radius * length(flow.spin) / flow.speed


@kernel
def drag_and_lift(push, flow, ratio, drag, lift):
    """Acceleration by coefficients `drag` and `lift` at the spin ratio `ratio`; `push` is rho A / (2 m)."""
    across = cross(flow.spin, flow.velocity)
    size = length(across)
    braking = scale(-push * drag * flow.speed, flow.velocity)
    if size == 0.0:
        return braking
    fading = ratio / sqrt(ratio * ratio + FADE * FADE)
    return add(braking, scale(push * lift * fading * flow.speed * flow.speed / size, across))


def spin_axis_terms(effect, ground, flow, force, wanted):
    """Longest step [s] that can't overlook where drag or lift by a published law reverses."""
    blunt = FADE * flow.speed * flow.speed / effect.radius
    wanted = protocol.step_to_alignment(cross(flow.spin, flow.velocity),
                                        cross(flow.spin, force), blunt, wanted)
    return protocol.step_to_alignment(flow.velocity, force, CREEPING, wanted)
