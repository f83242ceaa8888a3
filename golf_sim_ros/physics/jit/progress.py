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

"""Progress of a compilation, by the functions that numba has compiled."""

from contextlib import contextmanager
from typing import Any, Iterator, TextIO

from .internals import event

# Functions of a first program, and of one more; each takes about as long.
FUNCTIONS, MORE = 520, 90
LEFT_TO_LINK = 0.97  # at the end everything is linked and optimised once more


class Counter(event.Listener):
    """Listener that writes the share done of some `programs` to `file`.

    Whenever it has grown by a percent.
    """

    def __init__(self, file: TextIO, programs: int) -> None:
        self.file, self.count, self.told = file, 0, 0.0
        self.functions = FUNCTIONS + MORE * (programs - 1)

    def on_start(self, event: Any) -> None:
        """Count nothing: a function's compilation begins before that of those it calls."""

    def on_end(self, event: Any) -> None:
        """Count a function that is compiled."""
        self.count += 1
        share = min(self.count / self.functions, LEFT_TO_LINK)
        if share - self.told >= 0.01:
            self.told = share
            print(f'{share:.2f}', file=self.file, flush=True)


@contextmanager
def telling_progress(file: TextIO, programs: int) -> Iterator[None]:
    """Context in which lines with the share done of some `programs` are written to `file`."""
    counter = Counter(file, programs)
    event.register('numba:compile', counter)
    try:
        yield
    finally:
        event.unregister('numba:compile', counter)
