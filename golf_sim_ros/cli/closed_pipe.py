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

"""Programs in pipes whose output is not read on, as in ``resimulate BAG | head -1``: they end."""

from collections.abc import Callable, Sequence
from functools import wraps
import os
import sys

Main = Callable[..., int]  # of a program: takes its arguments, gives its exit code

UNREAD = 141  # exit code of a program that ends so: 128 and the number of SIGPIPE, as in a shell


def in_pipes(main: Main) -> Main:
    """Make `main`, which returns an exit code, end quietly once its output is not read."""

    @wraps(main)
    def run(args: Sequence[str] | None = None) -> int:
        try:
            try:
                return main(args)
            finally:
                # Of --help, too, which ends with an exception; what is left would come too late.
                for stream in (sys.stdout, sys.stderr):
                    if stream is not None:
                        stream.flush()
        except BrokenPipeError:
            print_nowhere()
            return UNREAD

    return run


def say(text: str) -> None:
    """Print a line at once, if standard output is read."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        print_nowhere()


def print_nowhere() -> None:
    """Drop what is still to be printed.

    Python would complain, at its end, that it could not be.
    """
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except BrokenPipeError:
            os.dup2(nowhere, stream.fileno())
        except AttributeError:  # there is no such stream
            pass
    os.close(nowhere)
