# SPDX-License-Identifier: Apache-2.0
"""Presets: how exact a simulation is, from a sketch to a reference."""
from math import inf
from typing import NamedTuple

from ..integrators.dormand_prince import DormandPrince
from .kernel_model import Limits


class Preset(NamedTuple):
    """An integrator with its tolerance, limits of the contact laws, and the error they promise.

    ``touch`` and ``rest`` [m]: how far first touch and rest on level ground lie, at most, from
    where exact arithmetic would put them, for shots of up to 90 m/s in still air.
    """

    method: NamedTuple
    limits: Limits
    touch: float = inf
    rest: float = inf


ACCURACY = {
    'sketch': Preset(DormandPrince(5e-3), Limits(settle=0.1, path=1e-6), touch=0.5, rest=1.0),
    'standard': Preset(DormandPrince(2.3e-4), Limits(settle=0.1, path=1e-6), touch=1e-3, rest=1e-2),
    'reference': Preset(DormandPrince(1e-10), Limits(settle=1e-3, path=1e-10), touch=1e-6, rest=1e-4),
}


def preset(accuracy):
    """`Preset` of that name; a `Preset` is given back.

    Raises
    ------
    ValueError
        Naming the unknown preset and the known ones.
    """
    if isinstance(accuracy, Preset):
        return accuracy
    if accuracy not in ACCURACY:
        raise ValueError(f'accuracy {accuracy!r} is unknown; known: {", ".join(ACCURACY)}')
    return ACCURACY[accuracy]
