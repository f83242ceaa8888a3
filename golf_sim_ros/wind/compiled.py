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

"""Compilation of the solver's kernels with numba, which importing this module needs.

Compiled code is kept in the folder of the physics. numba watches only the file of the function
that it keeps, so a kernel calls kernels of its own module only.
"""

from collections.abc import Callable

from ..optional_packages import how_to_get
from ..physics.jit import Unavailable

try:
    from ..physics.jit.backend import CACHE
    from ..physics.jit.kept import keep_compiled
    import numba
except Unavailable as error:
    raise Unavailable(
        f'solving for a wind field needs numba: {how_to_get("fast", "numba")}; {error}'
    ) from None

# No signed zeros, sums in any order: the same machine gives the same bits all the same.
OPTIONS = {
    'error_model': 'numpy',
    'nogil': True,
    'fastmath': {'nsz', 'reassoc', 'contract', 'arcp'},
}


def kernel(function: Callable) -> Callable:
    """Compile `function` when it is first called, or load what was compiled before."""
    return keep_compiled(numba.njit(**OPTIONS)(function), CACHE)


def inner(function: Callable) -> Callable:
    """Compile `function` for kernels of the same module to call."""
    return numba.njit(**OPTIONS)(function)
