# SPDX-License-Identifier: Apache-2.0
"""How the machine code of entries is kept on disk, where numba's own way does not do.

numba numbers the files of a function without a lock: two processes that keep code for different types at
one time may end with the one's code under the other's name, and who loads that crashes. And it passes over a
folder that can only be read, as in an image built as root and run by others. Private parts of numba, the
same in versions 0.56 to 0.68.
"""
from contextlib import contextmanager

from numba.core import caching

from . import cache

LOCATOR = getattr(caching, 'UserProvidedCacheLocator', None) or caching._UserProvidedCacheLocator


class _Alone(caching.FunctionCache):
    """Keeps code while no other process does."""

    def save_overload(self, sig, data):
        """Keep the code of one signature."""
        with one_at_a_time():
            super().save_overload(sig, data)


class _InPlace(LOCATOR):
    """The folder as it is."""

    def ensure_cache_path(self):
        """Let it be: numba would try to write there."""


class _Found(caching.CompileResultCacheImpl):
    _locator_classes = [_InPlace]


class _ReadOnly(caching.FunctionCache):
    """Finds what is there, and keeps nothing."""

    _impl_class = _Found

    def save_overload(self, sig, data):
        """Keep nothing."""


@contextmanager
def one_at_a_time():
    """No other process keeps code in the same folder as long as this lasts."""
    try:
        import fcntl
    except ImportError:  # not on this system
        yield
        return
    with open(cache.folder().path / 'keeping', 'w') as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def keep_compiled(dispatcher, folder):
    """`dispatcher` of an entry, which keeps its code in a `cache.Cache` or at least finds it there."""
    if folder.path:
        dispatcher._cache = (_Alone if folder.writable else _ReadOnly)(dispatcher.py_func)
    return dispatcher
