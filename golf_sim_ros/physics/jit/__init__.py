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

"""Kernels: plain Python functions that numba compiles where a play needs it.

``@kernel`` and ``@shared`` mark a function that other kernels call, ``@entry`` one that Python
calls, too. ``@generic`` makes a function that dispatches on the type of its first argument; in
compiled code that happens at compile time. All of them stay plain Python functions: calling one
runs Python. `compiled` gives the machine code of an entry. So both engines live in one process,
and nothing here imports numba before `compiled` is called:

=============  =========================================================================
`backend`      compiles, with `linking`, `reference`, `kept` and `progress`
`internals`    what these take of numba that it does not promise to keep
`cache`        where compiled code is kept, and whether it can be trusted
`build`        compiles in a child process, which keeps the compiler's memory to itself
=============  =========================================================================
"""

from __future__ import annotations

import inspect
import time
from typing import Any, Callable, cast, ParamSpec, Protocol, TypeVar

KERNEL, SHARED, ENTRY = 'kernel', 'shared', 'entry'
Function = TypeVar('Function', bound=Callable[..., Any])
Parameters = ParamSpec('Parameters')
Answer = TypeVar('Answer', covariant=True)
Record = TypeVar('Record')


class GenericKernel(Protocol[Parameters, Answer]):
    """Function that `generic` makes: `cases` holds its bodies by record type."""

    cases: dict[type, Callable[..., Any]]
    default: Callable[..., Any]
    register: Callable[[type], Callable[[Function], Function]]
    __name__: str

    def __call__(self, *args: Parameters.args, **kwargs: Parameters.kwargs) -> Answer:
        """Run the body for the type of the first argument."""


ROLES: dict[Callable[..., Any], str] = {}  # by function: what it is compiled as
GENERICS: list[GenericKernel[..., Any]] = []


def kernel(function: Function) -> Function:
    """Mark `function` as a kernel for other kernels, inlined where it is called.

    It is compiled for every combination of argument types. Inlined, a shot takes a quarter of the
    time.
    """
    ROLES[function] = KERNEL
    return function


def shared(function: Function) -> Function:
    """Mark `function` as a kernel that is not inlined: large, or seldom run."""
    ROLES[function] = SHARED
    return function


def entry(function: Function) -> Function:
    """Mark `function` as a kernel that Python can call, too.

    It is compiled by `compiled`, else runs as it is.
    """
    ROLES[function] = ENTRY
    return function


def generic(default: Callable[Parameters, Answer]) -> GenericKernel[Parameters, Answer]:
    """Make `default` a function with another body for every registered record type.

    ``@name.register(Record)`` adds a body. Like functools.singledispatch, but kernels can call it
    and the choice is made when they compile.
    """
    cases: dict[type, Callable[..., Any]] = {}

    def call(*args: Any) -> Any:
        return cases.get(type(args[0]), default)(*args)

    def register(record: type) -> Callable[[Function], Function]:
        if record in cases:
            raise TypeError(f'{record.__name__} already has a {default.__name__}')
        return lambda function: add_case(record, function)

    def add_case(record: type, function: Function) -> Function:
        if parameters(default) != parameters(function):
            raise TypeError(
                f'{default.__name__} of {record.__name__} must have the parameters '
                f'{parameters(default)}'
            )
        cases[record] = function
        return function

    made = cast('GenericKernel[Parameters, Answer]', call)
    made.register, made.cases, made.default = register, cases, default
    call.__doc__, call.__name__, call.__module__ = (
        default.__doc__,
        default.__name__,
        default.__module__,
    )
    GENERICS.append(made)
    return made


def parameters(function: Callable[..., Any]) -> str:
    """Names of a function's parameters, as text.

    numba requires the same ones of all bodies of a generic.
    """
    return ', '.join(inspect.signature(function).parameters)


def literal_unroll(records: Record) -> Record:
    """Unroll a loop over the tuple `records` by their types, in compiled code.

    The tuple itself in Python.
    """
    return records


def borrowed(record: Record) -> Record:
    """Pass `record` by reference, uncounted: an entry's argument, which the caller keeps alive.

    numba hands a record from kernel to kernel by value, a model with its dozens of arrays as
    hundreds of numbers, and counts references to each array. By reference it is one pointer; its
    fields are read where they are needed. So is every record in it.
    """
    return record


def cycles() -> int:
    """Read the processor's cycle counter, of a constant rate.

    In plain Python nanoseconds, where unknown 0.
    """
    return time.perf_counter_ns()


def compiled(function: Function) -> Function:
    """Callable with the machine code of an entry.

    Imports numba, and compiles what is not in the cache.

    Raises
    ------
    Unavailable
        There is no numba, it is switched off, or it can't be imported; the message is one line.
    """
    from . import backend

    return backend.dispatcher(function)


def packed(record: Record) -> Any:
    """Handle of a `record` for compiled entries that borrow it: they read it where it lies.

    A record itself is taken apart at each call, a tenth of a microsecond an array. The handle
    keeps its arrays alive; what is no array is as it was when it was packed.
    """
    from . import backend

    return backend.packed(record)


class Unavailable(RuntimeError):
    """The compiled engine is not available; the message says why."""
