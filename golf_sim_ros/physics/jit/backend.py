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

"""Compilation of kernels with numba, on demand: the only way from `ROLES` to machine code."""

from __future__ import annotations

import os
from typing import Any, Callable

from . import (
    borrowed,
    cycles,
    ENTRY,
    Function,
    GenericKernel,
    GENERICS,
    literal_unroll,
    parameters,
    ROLES,
    SHARED,
    Unavailable,
)
from . import cache as cache_

if os.environ.get('NUMBA_DISABLE_JIT', '0') not in ('', '0'):
    raise Unavailable('NUMBA_DISABLE_JIT is set')
try:
    import numba
    from numba.extending import overload

    from .internals import cpu_target, infer_global, types
except ImportError as error:  # also a numba that does not work with this numpy
    raise Unavailable(' '.join(str(error).split())) from None

from . import linking, reference
from .kept import keep_compiled

# No signed zeros: results differ in the sign of zero only, and an effect that adds zero costs no
# addition.
OPTIONS = {'error_model': 'numpy', 'nogil': True, 'no_cfunc_wrapper': True, 'fastmath': {'nsz'}}
DISPATCHERS: dict[Callable[..., Any], Any] = {}  # by function
REGISTERED: set[GenericKernel[..., Any]] = set()  # generics that are declared to numba
DECLARED = [(0, 0, 0)]  # how many kernels, generics and their cases
CACHE = cache_.folder()

if CACHE.path and not os.environ.get('NUMBA_CACHE_DIR'):
    numba.config.CACHE_DIR = str(CACHE.path)


def dispatcher(function: Function) -> Function:
    """Dispatcher of the entry `function`.

    It compiles it for the types of a call, or loads it from the cache.
    """
    declare()
    return DISPATCHERS[function]


def declare() -> None:
    """Declare all kernels and generics to numba, unless nothing was registered since last time."""
    known = len(ROLES), len(GENERICS), sum(len(generic.cases) for generic in GENERICS)
    if known == DECLARED[-1]:
        return
    for function, role in list(ROLES.items()):
        if function not in DISPATCHERS:
            DISPATCHERS[function] = made = new_dispatcher(function, role)
            unroll(function)
            infer_global(function, types.Dispatcher(made))
    for generic in GENERICS:
        for function in (generic.default, *generic.cases.values()):
            unroll(function)
        if generic not in REGISTERED:
            REGISTERED.add(generic)
            declare_generic(generic)
    DECLARED[:] = [known]


def new_dispatcher(function: Callable[..., Any], role: str) -> Any:
    """Make a dispatcher of `function` in its `role`, with nothing compiled yet."""
    if role == ENTRY:
        return keep_compiled(numba.njit(**OPTIONS)(function), CACHE)
    made = numba.njit(no_cpython_wrapper=True, **linking.options(role == SHARED), **OPTIONS)(
        function
    )
    return linking.inner(made)


def unroll(function: Callable[..., Any]) -> None:
    """Bind numba's own `literal_unroll` in a function's module.

    numba looks for it there, by identity.
    """
    names = function.__globals__
    if names.get('literal_unroll') is literal_unroll:
        names['literal_unroll'] = numba.literal_unroll


def declare_generic(generic: GenericKernel[..., Any]) -> None:
    """Declare a generic to numba as an overload on the type of its first argument."""

    def pick(record: Any, *_: Any) -> Callable[..., Any]:
        kind: Any = getattr(record, 'instance_class', None)
        return generic.cases.get(kind, generic.default)

    names = parameters(generic.default)
    scope: dict[str, Any] = {'pick': pick, '__name__': generic.__module__}
    choose = f'choose_{generic.__name__}'
    exec(f'def {choose}({names}): return pick({names})', scope)
    options = {'no_cpython_wrapper': True, **linking.options(False)}
    # Not strict: that compares annotations, too; `parameters` has compared what counts.
    overload(generic, jit_options=options, strict=False)(scope[choose])


def packed(record: Any) -> reference.Handle:
    """`reference.Handle` of a named tuple, with a compiled `reference.pack`."""
    return reference.Handle(record, dispatcher(reference.pack))


def stand_for(function: Callable[..., Any], intrinsic: Any) -> None:
    """Make compiled kernels use an `intrinsic` where they call a plain `function`."""
    infer_global(function, cpu_target.typing_context.resolve_value_type(intrinsic))


cpu_target.typing_context.refresh()
stand_for(borrowed, reference.borrowed)
stand_for(cycles, reference.cycles)
