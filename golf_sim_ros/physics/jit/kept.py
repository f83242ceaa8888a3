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

"""Disk cache of the machine code of entries, where numba's own does not do.

numba numbers the files of a function without a lock: two processes that save code for different
types at the same time may end with the one's code under the other's name, and loading that
crashes. And it ignores a read-only folder, as in an image built as root and run by others.
"""

from contextlib import contextmanager
from typing import Any, Iterator

from . import cache
from .internals import caching

LOCATOR: Any = (
    getattr(caching, 'UserProvidedCacheLocator', None) or caching._UserProvidedCacheLocator
)


class _Alone(caching.FunctionCache):
    """Cache that saves code while no other process does."""

    def save_overload(self, sig: Any, data: Any) -> None:
        """Save the code of one signature."""
        with one_at_a_time():
            super().save_overload(sig, data)


class _InPlace(LOCATOR):
    """Locator of the folder as it is."""

    def ensure_cache_path(self) -> None:
        """Leave the folder alone: numba would try to write there."""


class _Found(caching.CompileResultCacheImpl):
    _locator_classes = [_InPlace]


class _ReadOnly(caching.FunctionCache):
    """Cache that loads code and saves none."""

    _impl_class = _Found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Save nothing."""


@contextmanager
def one_at_a_time() -> Iterator[None]:
    """Lock across processes: no other one saves code in the same folder meanwhile."""
    try:
        import fcntl
    except ImportError:  # not on this system
        yield
        return
    with open(cache.trusted_path() / 'keeping', 'w') as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def keep_compiled(dispatcher: Any, folder: cache.Cache) -> Any:
    """Give the `dispatcher` of an entry a disk cache in a `cache.Cache`, read-only if that is."""
    if folder.path:
        dispatcher._cache = (_Alone if folder.writable else _ReadOnly)(dispatcher.py_func)
    return dispatcher
