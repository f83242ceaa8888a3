# SPDX-License-Identifier: Apache-2.0
"""Rectangle: a thin sheet, hit from both sides unless it is one-sided."""
from typing import NamedTuple

from ..properties.material import Material


class Patch(NamedTuple):
    """Rectangle around `center` with unit `normal`.

    `length` [m] lies along `heading` (radians from x towards y, projected into the rectangle's
    plane), `width` [m] across it. `cut` holds polygons, tuples of (x, y), where the sheet ends.
    """

    center: tuple
    normal: tuple = (0.0, 0.0, 1.0)
    heading: float = 0.0
    length: float = 1.0
    width: float = 1.0
    material: Material = Material()
    one_sided: bool = False
    cut: tuple = ()
