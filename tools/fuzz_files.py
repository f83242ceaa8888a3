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

"""Files that are broken in every way: courses, meshes, arrays and bags, mutated and read.

Each must be read, or refused with one line, within 5 s of processor time and 2 GB. A case is known
by its kind, the seed and its number, and made from these alone::

    python tools/fuzz_files.py --seed 7 --count 1000            # of each kind
    python tools/fuzz_files.py --kinds meshes --seed 7 --first 1234 --count 1 --keep /tmp/case
"""

import argparse
import json
import os
from pathlib import Path
import select
import subprocess
import sys
import tempfile

LONGEST, MOST = 5.0, 2e9  # s of processor time, bytes
PATIENCE = 120.0  # s of the clock without a word from who reads
KINDS = ('courses', 'meshes', 'arrays', 'bags')
HERE = Path(__file__).resolve()


def main(args=None):
    """Read mutated files; the exit code is 0 when none was a fault."""
    options = parser().parse_args(args)
    if options.reader:
        from fuzz_reader import read_all

        return read_all(options)
    faults = 0
    for kind in options.kinds:
        found = run(kind, options)
        faults += len(found['faults'])
        print(
            f'{kind}: {found["read"]} read, {found["refused"]} refused, '
            f'{len(found["faults"])} faults; seed {options.seed}, '
            f'numbers {options.first} to {options.first + options.count - 1}; '
            f'at most {found["time"]:.2f} s and {found["memory"] / 1e6:.0f} MB',
            flush=True,
        )
        for number, fault in found['faults']:
            print(f'  {kind} {number}: {fault}', flush=True)
    return 1 if faults else 0


def parser():
    """Reader of the command line."""
    reader = argparse.ArgumentParser(prog='fuzz_files', description=__doc__.partition('\n')[0])
    reader.add_argument('--kinds', nargs='+', choices=KINDS, default=list(KINDS))
    reader.add_argument('--seed', type=int, default=1)
    reader.add_argument(
        '--first', type=int, default=0, metavar='N', help='number of the first case'
    )
    reader.add_argument(
        '--count', type=int, default=500, metavar='N', help='of each kind (%(default)s)'
    )
    reader.add_argument(
        '--keep', type=Path, metavar='FOLDER', help='leave the files of the last case there'
    )
    reader.add_argument('--reader', action='store_true', help=argparse.SUPPRESS)
    return reader


def run(kind, options):
    """Read the cases of a kind: counts, greatest time and memory, faults with their numbers."""
    found = {'read': 0, 'refused': 0, 'faults': [], 'time': 0.0, 'memory': 0}
    first, last = options.first, options.first + options.count
    while first < last:
        for case in cases(kind, first, last, options):
            found['time'], found['memory'] = (
                max(found[name], case[name]) for name in ('time', 'memory')
            )
            if case['fault']:
                found['faults'].append((case['number'], case['fault']))
            else:
                found['read' if case['read'] else 'refused'] += 1
            first = case['number'] + 1
        if first < last:  # whoever read ended at this one
            found['faults'].append((first, 'the reader died, or took too long'))
            first += 1
    return found


def cases(kind, first, last, options):
    """Start a process that reads cases: what it says of each, until it ends."""
    command = [
        sys.executable,
        str(HERE),
        '--reader',
        '--kinds',
        kind,
        '--seed',
        str(options.seed),
        '--first',
        str(first),
        '--count',
        str(last - first),
    ]
    if options.keep:
        command += ['--keep', str(options.keep)]
    with tempfile.TemporaryFile('w+') as told:
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=told,
            text=True,
            bufsize=1,
            env={**os.environ, 'GOLF_SIM_ROS_ENGINE': 'python'},
        )
        try:
            while select.select([process.stdout], [], [], PATIENCE)[0]:
                line = process.stdout.readline()
                if not line:
                    break
                yield json.loads(line)
        finally:
            process.kill()
            process.wait()
            process.stdout.close()
            told.seek(0)
            sys.stderr.write(told.read()[-2000:])


if __name__ == '__main__':
    sys.exit(main())
