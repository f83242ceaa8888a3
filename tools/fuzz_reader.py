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

"""Reads the mutated files of fuzz_files.py in a process of its own; says what came of each."""

import json
from pathlib import Path
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings

from fuzz_files import LONGEST, MOST
from fuzz_seeds import readers

LONGEST_LINE = {'bags': 1000}  # letters; else 300


class TooLong(BaseException):
    """A case takes too much processor time; no reader of foreign files may swallow that."""


def read_all(options):
    """Read each case and print a line of JSON about it; return the exit code."""
    (kind,) = options.kinds
    with tempfile.TemporaryDirectory() as folder:
        make = readers(Path(folder))[kind]
        used = int(Path('/proc/self/statm').read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + int(MOST), -1))
        signal.signal(signal.SIGPROF, stop)
        for number in range(options.first, options.first + options.count):
            place = Path(folder) / 'case'
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir()
            rng = random.Random(f'{kind} {options.seed} {number}')
            print(json.dumps({'number': number, **outcome(make, rng, place, kind)}), flush=True)
        if options.keep:
            shutil.copytree(Path(folder) / 'case', options.keep, dirs_exist_ok=True)
    return 0


def stop(*_):
    """End a case."""
    raise TooLong


def outcome(make, rng, place, kind):
    """Make and read one case: whether it was read, what was wrong at the end, time and memory."""
    read, errors = make(rng, place)
    fault, said = '', None
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter('always')
        began = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, LONGEST)
        try:
            read()
        except errors as error:
            said = str(error)
        except TooLong:
            fault = f'takes more than {LONGEST} s'
        except BaseException as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            fault = f'{type(error).__name__} in {last.filename}:{last.lineno}: {str(error)[:200]}'
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
    took = time.process_time() - began
    if said is not None and (not said.isprintable() or len(said) > LONGEST_LINE.get(kind, 300)):
        fault = f'no short line: {said[:400]!r}'
    if said and ('the memory there is' in said or 'MemoryError' in said):
        fault = 'takes more than 2 GB'
    for warning in warned:
        if 'golf_sim_ros' in warning.filename or issubclass(warning.category, RuntimeWarning):
            fault = fault or f'warns: {warning.message} in {warning.filename}:{warning.lineno}'
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return {'read': said is None, 'fault': fault, 'time': took, 'memory': memory, 'said': said}


if __name__ == '__main__':
    sys.exit('fuzz_files.py starts this')
