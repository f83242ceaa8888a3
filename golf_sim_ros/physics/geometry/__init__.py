# Copyright 2026 golf_sim_ros maintainers
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Ground: a file that has ``SHAPES`` and ``build`` is a kind of ground, discovered on import.

``SHAPES`` are the record types that a course may hold, ``build(shapes, material_number)`` turns
those of a course into one record of arrays, ``plan(shape)`` gives the outlines of a shape in plan,
sequences of (x, y) or ``Circle``, and ``heights(shape)`` its lowest and highest ground. Every
course gets every kind, empty ones too, so that a new course compiles nothing. ``NUMBERED`` says
whose parts are numbered first: recorded play holds their numbers, so it stays for good. A kind
without it comes last.
"""

import importlib
import pkgutil
from typing import Any, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from .polygon import Circle, Outline, OUTSIDE, polygons, regions, sides
from .surfaces import BORDER, BORDER_LINE, Ground
from .water_surface import Water, waters
from .zone import Zone, zones_of
from ..kernel_types import ShapeRecord
from ..properties.material import Material

_MODULES = [
    importlib.import_module(f'{__name__}.{module.name}')
    for module in pkgutil.iter_modules(__path__)
]
KINDS = sorted(
    (module for module in _MODULES if hasattr(module, 'SHAPES')),
    key=lambda kind: getattr(kind, 'NUMBERED', len(_MODULES)),
)


def build(
    shapes: Sequence[ShapeRecord],
    zones: Iterable[Union[Zone, tuple[Any, ...]]],
    bounds: Optional[Outline],
    hole: Optional[Sequence[float]],
    material_number: Mapping[Material, int],
    water: Sequence[Water] = (),
) -> Ground:
    """`Ground` of `shapes`, ground and obstacles.

    Parameters
    ----------
    shapes : sequence of shapes
    zones : sequence of Zone, or of (Material, outline)
    bounds : outline or None
    hole : (x, y, radius, lowest, highest, bottom) or None
        Circle that is cut into ground at those heights, and how far down; see `cup.opening`.
    material_number : dict of Material to int
    water : sequence of Water

    Raises
    ------
    TypeError
        A shape is of no known kind.
    """
    known = tuple(shape for kind in KINDS for shape in kind.SHAPES)
    for shape in shapes:
        if not isinstance(shape, known):
            raise TypeError(
                f'{type(shape).__name__} is not a ground shape; known: '
                + ', '.join(sorted(s.__name__ for s in known))
            )
    by_kind = [(kind, [s for s in shapes if isinstance(s, kind.SHAPES)]) for kind in KINDS]
    kinds = tuple(kind.build(own, material_number) for kind, own in by_kind)
    outlines = [o for kind, own in by_kind for s in own for o in kind.plan(s)]
    painted = zones_of(zones)
    outlines += [outline for zone in painted for outline in (zone.polygon, *zone.cut)]
    heights = [kind.heights(s) for kind, own in by_kind for s in own]
    heights += [(pond.level, pond.level) for pond in water]
    return Ground(
        kinds,
        *_borders(outlines),
        regions([zone.polygon for zone in painted], [zone.cut for zone in painted]),
        np.array([material_number[zone.material] for zone in painted], np.int64),
        polygons([bounds] if bounds else []),
        np.array(hole or (), float),
        waters(water),
        float(min((low for low, _ in heights), default=0.0)),
        float(max((high for _, high in heights), default=0.0)),
    )


def extent(shape: ShapeRecord) -> tuple[np.ndarray, np.ndarray]:
    """Corners (x, y) of the rectangle around the outlines of `shape` in plan."""
    kind = next(kind for kind in KINDS if isinstance(shape, kind.SHAPES))
    places = [
        corner
        for outline in kind.plan(shape)
        for corner in (
            [
                (outline.x - outline.radius, outline.y - outline.radius),
                (outline.x + outline.radius, outline.y + outline.radius),
            ]
            if isinstance(outline, Circle)
            else outline
        )
    ]
    return np.min(places, 0), np.max(places, 0)


def _borders(outlines: Iterable[Union[Outline, Circle]]) -> tuple[np.ndarray, np.ndarray]:
    rows: list[tuple[Any, ...]] = []
    lines: list[tuple[Any, ...]] = []
    for outline in outlines:
        if isinstance(outline, Circle):
            center, r = np.array((outline.x, outline.y)), outline.radius
            lines.append((len(rows), len(rows) + 1, center - r, center + r))
            rows.append((center, (1.0, 0.0), 0.0, r))
            continue
        first = len(rows)
        for corners in sides(outline):
            start, end = np.asarray(corners, float)
            size = np.linalg.norm(end - start)
            if size > 1e-9:  # an upright patch has no width in plan
                rows.append((start, (end - start) / size, size, 0.0))
        low, high = np.min(outline, 0), np.max(outline, 0)
        lines.append((first, len(rows), low - OUTSIDE, high + OUTSIDE))
    return np.array(rows, BORDER), np.array(lines, BORDER_LINE)
