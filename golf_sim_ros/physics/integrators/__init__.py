# SPDX-License-Identifier: Apache-2.0
"""Integrators: one file each, found by themselves.

A Runge-Kutta method is a record with a table; `step` is shared. A method of another kind registers
its own body for `step`.
"""
import importlib
import pkgutil
from typing import Callable, NamedTuple

from ..jit import shared
from . import runge_kutta


class Method(NamedTuple):
    """A known integrator: its record type, and the name of the field that says how exact it is."""

    record: Callable
    dial: str


METHODS = {}

for _module in pkgutil.iter_modules(__path__):
    _found = importlib.import_module(f'{__name__}.{_module.name}')
    if hasattr(_found, 'METHOD'):
        METHODS[_module.name] = Method(_found.METHOD, _found.METHOD._fields[0])


@shared
def step(model, ball):
    """Lay the ball's next segment: one step of the model's method. Writes curve, span, step, ending."""
    runge_kutta.step_by(model.method, model, ball)
