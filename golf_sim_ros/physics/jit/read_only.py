# SPDX-License-Identifier: Apache-2.0
"""Compiled code from a folder that can only be read: numba would pass it over and compile anew.

An image built as root and run as another user has such a folder. Private parts of numba, the same in
versions 0.56 to 0.68; where they have gone, nothing is kept.
"""
from numba.core import caching

LOCATOR = getattr(caching, 'UserProvidedCacheLocator', None) or caching._UserProvidedCacheLocator


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


def read_from_folder(dispatcher):
    """Let the `dispatcher` of an entry look for its code in numba's CACHE_DIR, which can't be written."""
    dispatcher._cache = _ReadOnly(dispatcher.py_func)
    return dispatcher
