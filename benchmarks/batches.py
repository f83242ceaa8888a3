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

"""Batches on all processors by threads, processes and dask; memory of a million results."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
import multiprocessing
import os
import subprocess
import sys
from time import perf_counter

from golf_sim_ros.study.scenes import club_shot, level, Scene
from shots import ground, volley
from timing import faster, Row

WORKERS = len(os.sched_getaffinity(0))
SHOTS = 100_000  # some seconds on one thread
ROUNDS = 3
MILLION = 1_000_000
MEGABYTE = 2.0**20
MEASURED = """
from pathlib import Path
import re
import sys

from golf_sim_ros.physics import simulate_many
from golf_sim_ros.physics.engine.engines import prefer_compiled
import numpy as np
import shots


def memory(name):
    found = re.search(name + r':\\s*(\\d+) kB', Path('/proc/self/status').read_text())
    return 1024.0 * int(found[1])


def play(count):
    strikes = np.tile(velocity, (count, 1)), np.tile(spin, (count, 1))
    return simulate_many(course, *strikes, progress=lambda parts, total: parts)


prefer_compiled()
course = shots.level(shots.ground('fairway'))
velocity, spin = shots.club_shot('driver')
play(10_000)
before = memory('VmRSS')
Path('/proc/self/clear_refs').write_text('5')  # the peak begins anew
results = play(int(sys.argv[1]))
print(memory('VmHWM') - before, results.nbytes)
"""


def rows(quick):
    """`Row` of each kind of executor, and of memory."""
    drive = Scene('drive', level(ground('fairway')), club_shot('driver'))
    count = SHOTS // 10 if quick else SHOTS
    alone = volley(drive, count)
    for name, pool in pools():
        with pool as executor:
            yield faster(
                f'{WORKERS} {name}, over one thread: of {WORKERS} times',
                volley(drive, count, executor=executor, chunks=4 * WORKERS),
                alone,
                rounds=ROUNDS,
                clock=perf_counter,
                least=0.75 * WORKERS,
            )
    yield memory(MILLION // 10 if quick else MILLION)


def pools():
    """Yield names and context managers of executors with as many workers as processors."""
    fresh = multiprocessing.get_context('forkserver')
    yield 'threads', ThreadPoolExecutor(WORKERS)
    yield 'processes', ProcessPoolExecutor(WORKERS, mp_context=fresh)
    try:
        import distributed
    except ImportError:
        print('dask: not timed, dask[distributed] is not installed', flush=True)
        return
    yield 'workers of dask', dask_workers(distributed)


@contextmanager
def dask_workers(distributed):
    """Start a cluster of processes on this machine; its executor."""
    with (
        distributed.LocalCluster(
            WORKERS, threads_per_worker=1, dashboard_address=None, silence_logs=50
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client.get_executor(pure=False)


def memory(count):
    """`Row`: by how much [MB] a process grows at most that plays so many drives."""
    told = subprocess.run(
        [sys.executable, '-c', MEASURED, str(count)],
        cwd=os.path.dirname(os.path.abspath(__file__)),
        check=True,
        text=True,
        capture_output=True,
    ).stdout
    grown, results = map(float, told.split())
    return Row(
        f'memory for {count:,} drives, their results included',
        grown / MEGABYTE,
        'MB',
        note=f'the results alone: {results / MEGABYTE:.0f} MB',
    )
