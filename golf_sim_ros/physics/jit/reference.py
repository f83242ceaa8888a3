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

"""Intrinsics of kernels without an equivalent in Python: references to records, and cycles."""

import platform
from typing import Any, Callable

from llvmlite import ir
import numba
from numba.extending import intrinsic, NativeValue, register_model, typeof_impl, unbox
import numpy as np

from . import entry
from .internals import (
    AttributeTemplate,
    cgutils,
    compute_fingerprint,
    infer_getattr,
    lower_getattr_generic,
    models,
    types,
)


class _Reference(types.Type):
    """Pointer to a named tuple that outlives it; its fields are read like the tuple's."""

    def __init__(self, record: Any) -> None:
        self.record = record
        super().__init__(f'Reference({record})')

    @property
    def instance_class(self) -> type:
        return self.record.instance_class


@register_model(_Reference)
class _ReferenceModel(models.PrimitiveModel):
    """A pointer to the tuple's value."""

    def __init__(self, manager: Any, reference: Any) -> None:
        value = manager.lookup(reference.record).get_value_type()
        super().__init__(manager, reference, value.as_pointer())


def _read(field: Any) -> Any:
    """Type of a field of type `field`, read through a reference."""
    if isinstance(field, types.BaseNamedTuple):
        return _Reference(field)
    if isinstance(field, types.BaseTuple):
        return types.Tuple([_read(item) for item in field.types])
    return field


@infer_getattr
class _ReferenceFields(AttributeTemplate):
    """Types of the fields."""

    key = _Reference

    def generic_resolve(self, reference: Any, name: str) -> Any:
        if name in reference.record.fields:
            return _read(reference.record.types[reference.record.fields.index(name)])
        return None


@lower_getattr_generic(_Reference)
def _get_field(context: Any, builder: Any, reference: Any, pointer: Any, name: str) -> Any:
    index = reference.record.fields.index(name)
    place = cgutils.gep_inbounds(builder, pointer, 0, index)
    return _load(context, builder, reference.record.types[index], place)


def _load(context: Any, builder: Any, field: Any, pointer: Any) -> Any:
    if isinstance(field, types.BaseNamedTuple):
        return pointer
    if isinstance(field, types.BaseTuple):
        items = [
            _load(context, builder, item, cgutils.gep_inbounds(builder, pointer, 0, i))
            for i, item in enumerate(field.types)
        ]
        return context.make_tuple(builder, _read(field), items)
    value = builder.load(pointer)
    return _view(context, builder, field, value) if isinstance(field, types.Array) else value


def _view(context: Any, builder: Any, array: Any, value: Any) -> Any:
    """View of the array without its owner, so that references to it are not counted."""
    view = context.make_array(array)(context, builder, value)
    view.meminfo = view.meminfo.type(None)
    view.parent = view.parent.type(None)
    return view._getvalue()


@intrinsic
def borrowed(typing: Any, record: Any) -> Any:
    """Take a record by reference, an array without its owner: see `jit.borrowed`."""

    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        if isinstance(record, types.Array):
            return _view(context, builder, record, args[0])
        if isinstance(record, _Reference):
            return args[0]
        return cgutils.alloca_once_value(builder, args[0])

    kept = isinstance(record, (types.Array, _Reference))
    return (record if kept else _Reference(record))(record), build


@intrinsic
def cycles(typing: Any) -> Any:
    """Read the processor's cycle counter: see `jit.cycles`."""

    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        if platform.machine() not in ('x86_64', 'AMD64'):  # elsewhere a program may not ask
            return context.get_constant(types.int64, 0)
        counter = ir.FunctionType(ir.IntType(64), ())
        name = 'llvm.readcyclecounter'
        return builder.call(cgutils.get_or_insert_function(builder.module, counter, name), ())

    return types.int64(), build


@intrinsic
def written(typing: Any, record: Any, memory: Any) -> Any:
    """Write a record into bytes, if they are enough, and return how many it takes."""

    def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        value, array = args
        size = context.get_abi_sizeof(value.type)
        room = context.make_array(memory)(context, builder, array)
        with builder.if_then(builder.icmp_signed('>=', room.nitems, room.nitems.type(size))):
            builder.store(value, builder.bitcast(room.data, value.type.as_pointer()))
        return context.get_constant(types.intp, size)

    return types.intp(record, memory), build


@entry
def pack(record: Any, memory: np.ndarray) -> int:
    """Write a record into bytes, if they are enough, and return how many it takes."""
    return written(record, memory)


class Handle:
    """Record in memory of its own, for entries that borrow it: see `jit.packed`.

    Parameters
    ----------
    record : named tuple
    pack : callable
        Compiled `pack`.
    """

    types: dict[bytes, _Reference] = {}  # by fingerprint, for numba takes milliseconds to find one

    def __init__(self, record: Any, pack: Callable[[Any, np.ndarray], int]) -> None:
        self.record, self.pack = record, pack
        self.memory = np.empty(pack(record, np.empty(0, np.uint8)), np.uint8)
        pack(record, self.memory)
        self.address = self.memory.ctypes.data
        fingerprint = compute_fingerprint(record)
        if fingerprint not in self.types:
            self.types[fingerprint] = _Reference(numba.typeof(record))
        self.type = self.types[fingerprint]

    def __reduce__(self) -> tuple[Any, ...]:
        """Pack the copied record: the memory points to the arrays of this one."""
        return Handle, (self.record, self.pack)


@typeof_impl.register(Handle)
def _typeof(handle: Handle, context: Any) -> _Reference:
    return handle.type


@unbox(_Reference)
def _unbox(reference: _Reference, handle: Any, context: Any) -> Any:
    address = context.pyapi.object_getattr_string(handle, 'address')
    pointer = context.pyapi.long_as_voidptr(address)
    context.pyapi.decref(address)
    kind = context.context.get_value_type(reference)
    return NativeValue(context.builder.bitcast(pointer, kind))
