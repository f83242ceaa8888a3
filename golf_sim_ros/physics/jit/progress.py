# SPDX-License-Identifier: Apache-2.0
"""Progress of a compilation, by the functions that numba has compiled."""
from contextlib import contextmanager

from numba.core import event

FUNCTIONS, MORE = 520, 90  # functions of a first program, and of one more; each takes about as long
LEFT_TO_LINK = 0.97  # at the end everything is linked and optimised once more


class Counter(event.Listener):
    """Listener that writes the share done of some `programs` to `file` whenever it has grown by a percent."""

    def __init__(self, file, programs):
        self.file, self.count, self.told = file, 0, 0.0
        self.functions = FUNCTIONS + MORE * (programs - 1)

    def on_start(self, event):
        """Count nothing: a function's compilation begins before that of those it calls."""

    def on_end(self, event):
        """Count a function that is compiled."""
        self.count += 1
        share = min(self.count / self.functions, LEFT_TO_LINK)
        if share - self.told >= 0.01:
            self.told = share
            print(f'{share:.2f}', file=self.file, flush=True)


@contextmanager
def telling_progress(file, programs):
    """Context in which lines with the share done of some `programs` are written to `file`."""
    counter = Counter(file, programs)
    event.register('numba:compile', counter)
    try:
        yield
    finally:
        event.unregister('numba:compile', counter)
