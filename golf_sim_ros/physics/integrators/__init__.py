# SPDX-License-Identifier: Apache-2.0
"""Integrators: one file each, discovered on import.

A Runge-Kutta method is a record with a Butcher tableau; `step` is shared. A method of another kind registers
its own body for `runge_kutta.step_by`.
"""
import importlib
import pkgutil
from typing import Callable, NamedTuple

from ..jit import shared
from . import runge_kutta


class Method(NamedTuple):
    """Known integrator: its record type, and the name of its field for accuracy, a tolerance or step."""

    record: Callable
    dial: str


METHODS = {}

for _module in pkgutil.iter_modules(__path__):
    _found = importlib.import_module(f'{__name__}.{_module.name}')
    if hasattr(_found, 'METHOD'):
        METHODS[_module.name] = Method(_found.METHOD, _found.METHOD._fields[0])


@shared
def step(model, ball):
    """Plan the ball's next segment: one step of the model's method. Writes curve, ending, integrator."""
    runge_kutta.step_by(model.method, model, ball)
