# SPDX-License-Identifier: Apache-2.0
"""Kernels: plain Python functions that numba compiles where a play calls for it.

``@kernel`` and ``@shared`` mark a function that other kernels call, ``@entry`` one that Python calls, too.
``@generic`` makes a function that picks its body by the type of its first argument; compiled, the choice is
made once, when the kernel is. All of them stay plain Python functions: who calls one runs Python. What
`compiled` gives for an entry is machine code. So both engines live in one process, and nothing here imports
numba until `compiled` is asked for:

=============  =========================================================================
`backend`      compiles; with `linking` and `reference` the only modules that know numba
`cache`        where compiled code is kept, and whether it can be trusted
`build`        compiles in a child process, which keeps the compiler's memory to itself
=============  =========================================================================
"""
import inspect
import time

KERNEL, SHARED, ENTRY = 'kernel', 'shared', 'entry'
ROLES = {}  # what each function is compiled as
GENERICS = []


def kernel(function):
    """`function`, to be compiled for every combination of argument types it meets, for other kernels.

    It is copied to where it is called: a shot takes a quarter of the time that calls would.
    """
    ROLES[function] = KERNEL
    return function


def shared(function):
    """`function` as a kernel that is there once and called: large, or seldom run."""
    ROLES[function] = SHARED
    return function


def entry(function):
    """`function` as a kernel that Python can call, too: compiled by `compiled`, else as it is."""
    ROLES[function] = ENTRY
    return function


def generic(default):
    """`default` as a function that has another body for every registered record type.

    ``@name.register(Record)`` adds a body. Like functools.singledispatch, but kernels can call it
    and the choice is made when they compile.
    """
    cases = {}

    def call(*args):
        return cases.get(type(args[0]), default)(*args)

    def register(record):
        if record in cases:
            raise TypeError(f'{record.__name__} already has a {default.__name__}')
        return lambda function: add_case(record, function)

    def add_case(record, function):
        if parameters(default) != parameters(function):
            raise TypeError(f'{default.__name__} of {record.__name__} must have the parameters '
                            f'{parameters(default)}')
        return cases.setdefault(record, function)

    call.register, call.cases, call.default = register, cases, default
    call.__doc__, call.__name__, call.__module__ = default.__doc__, default.__name__, default.__module__
    GENERICS.append(call)
    return call


def parameters(function):
    """Names of a function's parameters, as text: numba matches bodies of a generic by them."""
    return ', '.join(inspect.signature(function).parameters)


def literal_unroll(records):
    """`records`: plain Python loops over any tuple; compiled, the loop is unrolled by the records' types."""
    return records


def borrowed(record):
    """`record` by reference, its arrays not counted: for an entry's arguments, which the caller keeps alive.

    numba hands a record from kernel to kernel by value, a model with its dozens of arrays as hundreds
    of numbers, and counts references to each array. By reference it is one pointer; its fields are
    read where they are needed. So is every record in it.
    """
    return record


def cycles():
    """Count of the processor's cycles, of a steady rate; in plain Python nanoseconds, where unknown 0."""
    return time.perf_counter_ns()


def compiled(function):
    """What calls the machine code of an entry; loads numba, and compiles what is not in the cache.

    Raises
    ------
    Unavailable
        There is no numba, it is switched off, or it can't be imported; the message is one line.
    """
    from . import backend
    return backend.dispatcher(function)


class Unavailable(RuntimeError):
    """There is no compiled engine here; the message says why."""
