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

"""Engines of a world: plain Python, which starts at once, or compiled code.

Both run the same functions. Plain Python plays a few balls in a fifth of a core; for many balls,
or many shots, compiled code takes a hundredth of that, and has to be compiled first, once a
machine.
"""

from __future__ import annotations

from functools import lru_cache
import logging
import os
from time import thread_time
from typing import Any, Callable, NamedTuple, Optional

import numpy as np

from .event_loop import advance
from .orientation import turn_orientations
from .planner import put_down
from .. import jit
from ..jit import Answer, Function
from ..jit.build import Build, is_kept, missing, Part, READY

ENGINES = 'auto', 'python', 'compiled'
# environment variable: what 'auto' means in `World`, `simulate`, ...
ENGINE_VARIABLE = 'GOLF_SIM_ROS_ENGINE'
# s of plain Python after which compiling pays: it takes half a minute, once a machine
WORTH_COMPILING = 10.0
LOG = logging.getLogger('golf_sim_ros')


class Engine(NamedTuple):
    """Entries of the physics, and whether effects that are off are kept as dormant records.

    `pack` makes of a record what `advance` takes in its place, at less cost a call.
    """

    name: str
    advance: Callable[..., int]
    turn: Callable[..., None]
    put_down: Callable[..., tuple[bool, float, bool]]
    pack: Callable[[Any], Any]
    keeps_dormant: bool


def as_it_is(record: Any) -> Any:
    """`record` itself."""
    return record


PYTHON = Engine(
    'python', np.errstate(all='ignore')(advance), turn_orientations, put_down, as_it_is, False
)


@lru_cache(maxsize=None)
def compiled_engine() -> Engine:
    """Compiled `Engine`; raises `jit.Unavailable` where there is none."""
    return Engine(
        'compiled',
        jit.compiled(advance),
        jit.compiled(turn_orientations),
        jit.compiled(put_down),
        jit.packed,
        True,
    )


def best(function: Function) -> Function:
    """Compiled function of an entry where numba is installed, else the function itself."""
    return function if missing() else jit.compiled(function)


def checked_engine(name: str) -> str:
    """`name`, if an engine has it.

    For 'auto' the value of the variable GOLF_SIM_ROS_ENGINE, if set.

    Raises
    ------
    ValueError
        Naming the unknown engine and the known ones.
    """
    if name == 'auto':
        name = os.environ.get(ENGINE_VARIABLE) or name
    if name not in ENGINES:
        raise ValueError(f'engine {name!r} is unknown; known: {", ".join(ENGINES)}')
    return name


def prefer_compiled() -> None:
    """Make 'auto' the compiled engine in this process and its children, where there is one."""
    if not missing():
        os.environ.setdefault(ENGINE_VARIABLE, 'compiled')


class Program:
    """Combination of record types in this process: its build, and what Python has cost instead.

    `spent`: processor time [s] in plain Python, of worlds whose engine is 'auto'.
    """

    known: dict[str, Program] = {}  # by key

    def __init__(self, key: str) -> None:
        self.key, self.spent, self.told = key, 0.0, False
        self.build: Optional[Build] = None

    @classmethod
    def of(cls, key: str) -> Program:
        """Program with that `key`."""
        return cls.known.setdefault(key, cls(key))

    @property
    def is_kept(self) -> bool:
        """Whether it has been compiled and kept on this machine."""
        return is_kept(self.key)

    @property
    def is_ready(self) -> bool:
        """Whether its code is compiled and loaded."""
        return self.build is not None and self.build.state == READY

    def built(self, urgent: bool, function: Callable[..., Any], args: tuple[Any, ...]) -> Build:
        """`jit.build.Build` of all that ``function(*args)`` runs.

        It is started now, unless it has been before.
        """
        if self.build is None:
            self.build = Build(urgent, Part(self.key, function, args))
        return self.build

    def timed(self, function: Callable[..., Answer], *args: Any) -> Answer:
        """Return ``function(*args)``, whose processor time is added to `spent`."""
        began = thread_time()
        result = function(*args)
        self.spent += thread_time() - began
        return result

    def is_worth_compiling(self) -> bool:
        """Whether plain Python has taken so long that compiling pays.

        Warns once if that is impossible.
        """
        if self.spent < WORTH_COMPILING or self.told:
            return False
        if missing():
            self.told = True
            LOG.warning(
                'plain Python has taken %.0f s; the compiled engine would take a hundredth, '
                'but %s',
                self.spent,
                missing(),
            )
        return not self.told
