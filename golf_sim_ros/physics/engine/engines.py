# SPDX-License-Identifier: Apache-2.0
"""What runs a world: plain Python, which is there at once, or the compiled engine.

Both run the same functions. Plain Python plays a few balls in a fifth of a core; for many balls, or many
shots, compiled code takes a hundredth of that, and has to be compiled first, once a machine.
"""
from functools import lru_cache
import logging
import os
from time import thread_time
from typing import Callable, NamedTuple

from .. import jit
from ..jit.build import Build, Part, READY, is_kept, missing
from .event_loop import advance
from .orientation import turn_orientations
from .planner import put_down

ENGINES = 'auto', 'python', 'compiled'
ENGINE_VARIABLE = 'GOLF_SIM_ROS_ENGINE'  # what 'auto' is in `World`, `simulate`, `simulate_many`
WORTH_COMPILING = 10.0  # s that plain Python has taken: compiling takes about half a minute, once a machine
LOG = logging.getLogger('golf_sim_ros')


class Engine(NamedTuple):
    """The entries of the physics, and whether effects that are off stay there as dormant records."""

    name: str
    advance: Callable
    turn: Callable
    put_down: Callable
    keeps_dormant: bool


PYTHON = Engine('python', advance, turn_orientations, put_down, False)


@lru_cache(maxsize=None)
def compiled_engine():
    """The compiled `Engine`; `jit.Unavailable` where there is none."""
    return Engine('compiled', *map(jit.compiled, PYTHON[1:4]), True)


def best(function):
    """Machine code of an entry where numba is installed, else the function itself."""
    return function if missing() else jit.compiled(function)


def checked_engine(name):
    """`name`, if it is that of an engine; for 'auto' what the variable GOLF_SIM_ROS_ENGINE says, if set.

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


def prefer_compiled():
    """Let 'auto' be the compiled engine in this process and its children, where there is one."""
    if not missing():
        os.environ.setdefault(ENGINE_VARIABLE, 'compiled')


class Program:
    """A combination of record types in this process: its build, and what plain Python has cost instead.

    `spent` [s] of processor time in plain Python, of worlds whose engine is 'auto'.
    """

    known = {}  # by key

    def __init__(self, key):
        self.key, self.spent, self.build, self.told = key, 0.0, None, False

    @classmethod
    def of(cls, key):
        """The program of a `key`."""
        return cls.known.setdefault(key, cls(key))

    @property
    def is_kept(self):
        """Whether it has been compiled and kept on this machine."""
        return is_kept(self.key)

    @property
    def is_ready(self):
        """Whether its code is compiled and loaded."""
        return self.build is not None and self.build.state == READY

    def built(self, urgent, function, args):
        """Its `jit.build.Build`, begun now if nobody has: of all that ``function(*args)`` runs."""
        if self.build is None:
            self.build = Build(urgent, Part(self.key, function, args))
        return self.build

    def timed(self, function, *args):
        """What ``function(*args)`` gives, its processor time counted as spent in plain Python."""
        began = thread_time()
        result = function(*args)
        self.spent += thread_time() - began
        return result

    def is_worth_compiling(self):
        """Whether plain Python has taken so long that compiling is worth it; says once if that can't be."""
        if self.spent < WORTH_COMPILING or self.told:
            return False
        if missing():
            self.told = True
            LOG.warning('plain Python has taken %.0f s; the compiled engine would take a hundredth, but %s',
                        self.spent, missing())
        return not self.told
