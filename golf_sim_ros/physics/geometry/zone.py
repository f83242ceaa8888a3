# SPDX-License-Identifier: Apache-2.0
"""Zones: polygons in plan that paint the ground with another material."""
from typing import NamedTuple

from ..properties.material import Material


class Zone(NamedTuple):
    """Zone with corners (x, y) of its `polygon`; `cut` holds polygons within that it does not repaint."""

    material: Material
    polygon: tuple
    cut: tuple = ()


def zones_of(zones):
    """`Zone` records of `zones`, which may also be pairs of material and polygon."""
    return tuple(Zone(*zone) for zone in zones)
