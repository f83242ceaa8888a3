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

"""Parts of numba that it does not promise to keep: all that this package uses, and no module else.

Where they change with a version of numba, what uses them is to be looked at: `linking` draws on
the compiler and code libraries, `reference` on type templates and data models, `kept` on the disk
cache, `backend` on the registry, `progress` on events. They are the same from 0.56 to 0.68, each
tried; those of `linking` are known for the versions of `KNOWN` only.
"""

import os

import numba
from numba._dispatcher import compute_fingerprint
from numba.core import caching, cgutils, event, types
from numba.core.compiler import Compiler
from numba.core.datamodel import models
from numba.core.imputils import lower_getattr_generic
from numba.core.registry import cpu_target, CPUDispatcher
from numba.core.typing.templates import AttributeTemplate, infer_getattr, infer_global

__all__ = [
    'AttributeTemplate',
    'caching',
    'cgutils',
    'Compiler',
    'compute_fingerprint',
    'cpu_target',
    'CPUDispatcher',
    'event',
    'infer_getattr',
    'infer_global',
    'is_known',
    'lower_getattr_generic',
    'models',
    'types',
]

KNOWN = (0, 59), (0, 69)  # versions from the first to before the second, each tried
VERSION = tuple(int(part) for part in numba.__version__.split('.')[:2])
ORDINARY = 'GOLF_SIM_ROS_ORDINARY_LINKING'  # set: numba's own way of linking, whatever the version


def is_known() -> bool:
    """Whether the internals of linking are known for this numba."""
    return KNOWN[0] <= VERSION < KNOWN[1] and not os.environ.get(ORDINARY)


if is_known():
    from numba import _dynfunc
    from numba.core.codegen import JITCodeLibrary

    __all__ += ['_dynfunc', 'JITCodeLibrary']
