# SPDX-License-Identifier: Apache-2.0
"""Endless plane, solid below, that may be cut open."""
from typing import NamedTuple

from ..properties.material import Material


class Plane(NamedTuple):
    """Plane through `point` with unit `normal`, solid on the other side.

    `cut` holds polygons, tuples of (x, y), where the surface ends: a pit with walls along the
    normal opens there.
    """

    point: tuple = (0.0, 0.0, 0.0)
    normal: tuple = (0.0, 0.0, 1.0)
    material: Material = Material()
    cut: tuple = ()
