# SPDX-License-Identifier: Apache-2.0
"""Ground: a file that has ``SHAPES`` and ``build`` is a kind of ground, found by itself.

``SHAPES`` are the record types that a course may hold, ``build(shapes, material_number)`` turns
those of a course into one record of arrays, ``plan(shape)`` gives the outlines of a shape and
``heights(shape)`` its lowest and highest ground. Every course gets every kind, empty ones too, so
that a new course compiles nothing.
"""
import importlib
import pkgutil

import numpy as np

from .polygon import polygons, sides
from .surface import BORDER, Ground

KINDS = [module for module in
         (importlib.import_module(f'{__name__}.{m.name}') for m in pkgutil.iter_modules(__path__))
         if hasattr(module, 'SHAPES')]


def build(shapes, bounds, material_number):
    """`Ground` of a course's `shapes` and `bounds`.

    Raises
    ------
    TypeError
        A shape is of no known kind.
    """
    known = tuple(shape for kind in KINDS for shape in kind.SHAPES)
    for shape in shapes:
        if not isinstance(shape, known):
            raise TypeError(f'{type(shape).__name__} is not a ground shape; known: '
                            + ', '.join(sorted(s.__name__ for s in known)))
    kinds = tuple(kind.build([s for s in shapes if isinstance(s, kind.SHAPES)], material_number)
                  for kind in KINDS)
    outlines = [o for kind in KINDS for s in shapes if isinstance(s, kind.SHAPES) for o in kind.plan(s)]
    heights = [kind.heights(s) for kind in KINDS for s in shapes if isinstance(s, kind.SHAPES)]
    return Ground(kinds, _borders(outlines, [bounds] if bounds else []),
                  polygons([bounds] if bounds else []),
                  float(min((low for low, _ in heights), default=0.0)),
                  float(max((high for _, high in heights), default=0.0)))


def _borders(outlines, bounds):
    rows = []
    for is_bounds, outline in [(0, o) for o in outlines] + [(1, o) for o in bounds]:
        for start, end in sides(outline):
            start, end = np.asarray(start, float), np.asarray(end, float)
            size = np.linalg.norm(end - start)
            if size > 1e-9:  # an upright patch has no width in plan
                rows.append((start, (end - start) / size, size, is_bounds))
    return np.array(rows, BORDER)
