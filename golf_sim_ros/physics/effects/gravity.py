# SPDX-License-Identifier: Apache-2.0
"""Gravity: the same everywhere, downward."""
from typing import NamedTuple

from ..properties.material import STANDARD_GRAVITY
from . import protocol


class Gravity(NamedTuple):
    """Uniform gravity `g` [m/s^2] along -z."""

    g: float = STANDARD_GRAVITY


@protocol.gravity.register(Gravity)
def _gravity(effect, position):
    return 0.0, 0.0, -effect.g


def record(scene):
    """Record for `scene`."""
    return Gravity()


def idle(scene):
    """Reason why `scene` does without the effect: none, always ''."""
    return ''


def dormant(scene):
    """Record of no gravity: a play without it compiles nothing."""
    return Gravity(0.0)
