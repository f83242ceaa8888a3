# SPDX-License-Identifier: Apache-2.0
"""Presets: how exact a simulation is, from a sketch to a reference."""
from typing import NamedTuple

from .integrators.dormand_prince import DormandPrince
from .model import Limits


class Preset(NamedTuple):
    """An integrator with its tolerance, and limits of the contact laws."""

    method: NamedTuple
    limits: Limits


ACCURACY = {
    'sketch': Preset(DormandPrince(3e-2), Limits(settle=0.1, path=1e-4)),
    'standard': Preset(DormandPrince(1e-5), Limits(settle=0.01, path=1e-6)),
    'reference': Preset(DormandPrince(1e-10), Limits(settle=0.0001, path=1e-10)),
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
