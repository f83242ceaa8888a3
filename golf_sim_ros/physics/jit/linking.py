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

"""Linking of inner kernels as unoptimised drafts, which are optimised once, in the entry.

By `internals` of numba, which would optimise at every level of calls, with all that is called
below. Where they are not known, kernels are compiled the ordinary way.
"""

from typing import Any

from . import internals
from .internals import Compiler, CPUDispatcher, is_known, types


def options(apart: bool) -> dict[str, Any]:
    """Options with which numba compiles an inner kernel; `apart`: it is called, not inlined."""
    if not is_known():
        return {}  # forceinline would take ten times as long: all is optimised at every level
    # forceinline has to be denied: numba hands a caller's down to what it calls.
    return {'pipeline_class': _DraftingApart if apart else _Drafting, 'forceinline': not apart}


def inner(dispatcher: Any) -> Any:
    """Dispatcher of a kernel that only kernels call, changed to compile as such."""
    if is_known():
        dispatcher.__class__ = _Inner
    return dispatcher


class _Inner(CPUDispatcher):
    """Dispatcher of a kernel that is compiled once for all literals of a type."""

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Call template for these argument types, without literals.

        A constant needs no code of its own.
        """
        return super().get_call_template(
            [types.unliteral(a) for a in args],
            {name: types.unliteral(a) for name, a in kws.items()},
        )


if is_known():

    class _Draft(internals.JITCodeLibrary):
        """Code that is only linked into other code.

        It is optimised and made machine code there, once.
        """

        def finalize(self) -> None:
            self._raise_if_finalized()
            for library in dict.fromkeys(self._linking_libraries):
                if hasattr(self, '_reload_init'):  # from numba 0.63 on
                    self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalized = True

    class _Apart(_Draft):
        """Code that stays apart where it is linked into.

        LLVM would copy it to wherever it is called.
        """

        def add_ir_module(self, ir_module: Any) -> None:
            for function in ir_module.functions:
                if not function.is_declaration:
                    function.attributes.add('noinline')
            super().add_ir_module(ir_module)

    class _Drafting(Compiler):
        """Compiles to a `_Draft`."""

        library = _Draft

        def compile_extra(self, func: Any) -> Any:
            context = self.state.targetctx
            context.get_executable = _nothing_to_execute
            self.state.library = self.library(context.codegen(), func.__qualname__)
            return super().compile_extra(func)

    class _DraftingApart(_Drafting):
        """Compiles to code that stays `_Apart`."""

        library = _Apart

    def _nothing_to_execute(library: Any, fndesc: Any, env: Any) -> Any:
        library._ensure_finalized()
        name = fndesc.qualname.split('.')[-1]
        return internals._dynfunc.make_function(
            fndesc.lookup_module(), name, '', 0, env, (library,)
        )
