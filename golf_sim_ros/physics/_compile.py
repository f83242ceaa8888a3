# SPDX-License-Identifier: Apache-2.0
"""Compilation: the only file that knows numba.

``@kernel`` and ``@shared`` compile a function for other kernels, ``@entry`` one for Python too; all
leave it plain Python where numba is missing. ``@generic`` makes a function that picks its body by
the type of its first argument, inside kernels too, where choosing costs nothing. Compiled code is
kept on disk, in a folder keyed by all sources of the physics: numba itself only watches the file of
the cached function.
"""
import hashlib
import inspect
import os
import platform
import tempfile
import time
import warnings
from pathlib import Path

try:
    import numba
    from llvmlite import ir
    from numba import _dynfunc, literal_unroll
    from numba.core import cgutils, types
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import Compiler
    from numba.core.datamodel import models
    from numba.core.imputils import lower_getattr_generic
    from numba.core.registry import CPUDispatcher
    from numba.core.typing.templates import AttributeTemplate, infer_getattr
    from numba.extending import intrinsic, overload, register_model
except ImportError:
    numba = None
    warnings.warn('numba is not installed: the physics runs in plain Python, some 100 times slower',
                  RuntimeWarning, stacklevel=2)

    def literal_unroll(records):
        """Return `records`: plain Python loops over any tuple."""
        return records


def source_key():
    """Digest of all sources of the physics."""
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.rglob('*.py')):
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def _cache_folder():
    """Folder for compiled code: the user's cache, or a temporary one where that is read-only."""
    home = os.environ.get('XDG_CACHE_HOME') or os.path.join(os.path.expanduser('~'), '.cache')
    for root in (home, tempfile.gettempdir()):
        folder = Path(root) / 'golf_sim_ros' / source_key()
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder, os.W_OK):
            return str(folder)
    return ''


if numba and not os.environ.get('NUMBA_CACHE_DIR'):
    numba.config.CACHE_DIR = _cache_folder()


if numba:
    class _Inner(CPUDispatcher):
        """A kernel without wrapper: a call from Python would be a call of nothing."""

        def __call__(self, *args):
            raise TypeError(f'{self.__name__} can only be called by kernels: make it an @entry')

        def get_call_template(self, args, kws):
            """What to call for arguments of these types: a constant needs no code of its own."""
            return super().get_call_template([types.unliteral(a) for a in args],
                                             {name: types.unliteral(a) for name, a in kws.items()})

    class _Draft(JITCodeLibrary):
        """Code that is only linked into other code: optimised and made machine code there, once.

        numba would do both at every level of calls, with all that is called below.
        """

        def finalize(self):
            self._raise_if_finalized()
            for library in dict.fromkeys(self._linking_libraries):
                self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalized = True

    class _Apart(_Draft):
        """Code that stays apart where it is linked into: LLVM would copy it to wherever it is called."""

        def finalize(self):
            for function in self._final_module.functions:
                if not function.is_declaration:
                    function.add_function_attribute('noinline')
            super().finalize()

    class _Drafting(Compiler):
        """Compiles to a `_Draft`."""

        library = _Draft

        def compile_extra(self, func):
            context = self.state.targetctx
            context.get_executable = _nothing_to_execute
            self.state.library = self.library(context.codegen(), func.__qualname__)
            return super().compile_extra(func)

    class _DraftingApart(_Drafting):
        """Compiles to code that stays `_Apart`."""

        library = _Apart

    def _nothing_to_execute(library, fndesc, env):
        library._ensure_finalized()
        name = fndesc.qualname.split('.')[-1]
        return _dynfunc.make_function(fndesc.lookup_module(), name, '', 0, env, (library,))


# That 0 and -0 are one changes results in no more than that, and spares an addition for each silent effect.
OPTIONS = {'error_model': 'numpy', 'nogil': True, 'no_cfunc_wrapper': True, 'fastmath': {'nsz'}}


def _inner(function, **options):
    compiled = numba.njit(no_cpython_wrapper=True, **options, **OPTIONS)(function)
    if isinstance(compiled, CPUDispatcher):  # not with NUMBA_DISABLE_JIT
        compiled.__class__ = _Inner
    return compiled


def kernel(function):
    """`function` compiled for every combination of argument types it meets, for other kernels.

    It is copied to where it is called: a shot takes a quarter of the time that calls would.
    """
    return _inner(function, pipeline_class=_Drafting, forceinline=True) if numba else function


def shared(function):
    """`function` as a kernel that is there once and called: large, or seldom run.

    With it and `_Draft` the first start on a machine takes 0.7 of the time it took without.
    """
    # forceinline has to be denied: numba hands a caller's down to what it calls.
    return _inner(function, pipeline_class=_DraftingApart, forceinline=False) if numba else function


def plain(function):
    """The Python function that a kernel was made of, as long as it calls no other kernel."""
    return getattr(function, 'py_func', function)


def entry(function):
    """`function` as a kernel that Python can call too."""
    if numba is None:
        return function
    return numba.njit(cache=True, **OPTIONS)(function)


def stamp(key):
    """Path of the mark that says that `key` has been compiled and kept, or None without numba."""
    if numba is None or numba.config.DISABLE_JIT or not numba.config.CACHE_DIR:
        return None
    return Path(numba.config.CACHE_DIR) / f'{hashlib.sha256(key.encode()).hexdigest()[:16]}.compiled'


def borrowed(record):
    """`record` by reference, its arrays not counted: for an entry's arguments, which the caller keeps alive.

    numba hands a record from kernel to kernel by value, a model with its dozens of arrays as hundreds
    of numbers, and counts references to each array. By reference it is one pointer; its fields are
    read where they are needed. So is every record in it.
    """
    return record


if numba:
    class _Reference(types.Type):
        """Pointer to a named tuple that outlives it; its fields are read like the tuple's."""

        def __init__(self, record):
            self.record = record
            super().__init__(f'Reference({record})')

        @property
        def instance_class(self):
            return self.record.instance_class

    @register_model(_Reference)
    class _ReferenceModel(models.PrimitiveModel):
        """A pointer to the tuple's value."""

        def __init__(self, manager, reference):
            value = manager.lookup(reference.record).get_value_type()
            super().__init__(manager, reference, value.as_pointer())

    def _read(field):
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

        def generic_resolve(self, reference, name):
            if name in reference.record.fields:
                return _read(reference.record.types[reference.record.fields.index(name)])
            return None

    @lower_getattr_generic(_Reference)
    def _get_field(context, builder, reference, pointer, name):
        index = reference.record.fields.index(name)
        place = cgutils.gep_inbounds(builder, pointer, 0, index)
        return _load(context, builder, reference.record.types[index], place)

    def _load(context, builder, field, pointer):
        if isinstance(field, types.BaseNamedTuple):
            return pointer
        if isinstance(field, types.BaseTuple):
            items = [_load(context, builder, item, cgutils.gep_inbounds(builder, pointer, 0, i))
                     for i, item in enumerate(field.types)]
            return context.make_tuple(builder, _read(field), items)
        value = builder.load(pointer)
        return _view(context, builder, field, value) if isinstance(field, types.Array) else value

    def _view(context, builder, array, value):
        """The array without its owner, so that nobody counts references to it."""
        view = context.make_array(array)(context, builder, value)
        view.meminfo = view.meminfo.type(None)
        view.parent = view.parent.type(None)
        return view._getvalue()

    @intrinsic
    def _borrowed(typing, record):
        def build(context, builder, signature, args):
            if isinstance(record, types.Array):
                return _view(context, builder, record, args[0])
            return cgutils.alloca_once_value(builder, args[0])
        return (record if isinstance(record, types.Array) else _Reference(record))(record), build

    if not numba.config.DISABLE_JIT:
        # In the entry itself, whose frame then holds the record: an overload would have one of its own.
        borrowed = _borrowed  # noqa: F811


def cycles():
    """Count of the processor's cycles, of a steady rate; without numba nanoseconds, where unknown 0."""
    return time.perf_counter_ns()


if numba:
    @intrinsic
    def _cycles(typing):
        def build(context, builder, signature, args):
            if platform.machine() not in ('x86_64', 'AMD64'):  # elsewhere a program may not ask
                return context.get_constant(types.int64, 0)
            counter = ir.FunctionType(ir.IntType(64), ())
            name = 'llvm.readcyclecounter'
            return builder.call(cgutils.get_or_insert_function(builder.module, counter, name), ())
        return types.int64(), build

    if not numba.config.DISABLE_JIT:
        cycles = _cycles  # noqa: F811


GENERIC = {'forceinline': True, 'no_cpython_wrapper': True, 'pipeline_class': _Drafting} if numba else {}


def generic(default):
    """`default` as a function that has another body for every registered record type.

    ``@name.register(Record)`` adds a body. Like functools.singledispatch, but kernels can call it
    and the choice is made when they compile.
    """
    cases = {}

    def call(*args):
        return cases.get(type(args[0]), default)(*args)

    def pick(record, *_):
        return cases.get(getattr(record, 'instance_class', None), default)

    def register(record):
        if record in cases:
            raise TypeError(f'{record.__name__} already has a {default.__name__}')
        return lambda function: add_case(record, function)

    def add_case(record, function):
        if names != parameters(function):
            raise TypeError(f'{default.__name__} of {record.__name__} must have the parameters {names}')
        return cases.setdefault(record, function)

    def parameters(function):
        return ', '.join(inspect.signature(function).parameters)

    # numba matches an overload by its parameter names, so borrow those of `default`.
    names = parameters(default)

    if numba is not None:
        scope = {'pick': pick, '__name__': default.__module__}
        exec(f'def choose({names}): return pick({names})', scope)
        overload(call, jit_options=GENERIC)(scope['choose'])
    call.register, call.cases = register, cases
    call.__doc__, call.__name__ = default.__doc__, default.__name__
    return call
