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

"""Integrators: one file each, discovered on import.

A Runge-Kutta method is a record with a Butcher tableau; `step` is shared. A method of another kind
registers its own body for `runge_kutta.step_by`.
"""

import importlib
import pkgutil
from typing import Callable, NamedTuple

from . import runge_kutta
from ..jit import shared
from ..kernel_types import BallRecord, MethodRecord, ModelRecord


class Method(NamedTuple):
    """Known integrator: its record type, and the name of its field for accuracy.

    That is a tolerance or a step.
    """

    record: Callable[..., MethodRecord]
    dial: str


METHODS: dict[str, Method] = {}

for _module in pkgutil.iter_modules(__path__):
    _found = importlib.import_module(f'{__name__}.{_module.name}')
    if hasattr(_found, 'METHOD'):
        METHODS[_module.name] = Method(_found.METHOD, _found.METHOD._fields[0])


@shared
def step(model: ModelRecord, ball: BallRecord) -> None:
    """Plan the ball's next segment: one step of the model's method.

    Writes curve, ending, integrator.
    """
    runge_kutta.step_by(model.method, model, ball)
