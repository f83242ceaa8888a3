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

"""`simulate_many` on every kind of executor of docs/tools.md: the same bits, and no hang."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
import importlib.util
from multiprocessing import get_context
import os
from pathlib import Path
import shutil
import signal
import subprocess
import sys

from driving_range import HARD, level
from golf_sim_ros.physics import simulate_many
import numpy as np
import pytest

COURSE = level(HARD)._replace(effects=('gravity',))
VELOCITIES = np.linspace((2.0, -1.0, 3.0), (9.0, 1.0, 5.0), 12)
SPINS = np.tile((0.0, -30.0, 2.0), (12, 1))
HERE = Path(__file__).parent
BY_MPI = """
from mpi4py.futures import MPIPoolExecutor
import numpy as np
from golf_sim_ros.physics import simulate_many
from test_executors import COURSE, SPINS, VELOCITIES

if __name__ == "__main__":
    with MPIPoolExecutor() as ranks:
        np.save({!r}, simulate_many(COURSE, VELOCITIES, SPINS, executor=ranks, chunks=3))
"""


def alone():
    """Play the shots one after the other."""
    return simulate_many(COURSE, VELOCITIES, SPINS)


def die(parts):
    """In place of the shots: the process is killed."""
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.fixture
def processes():
    """Two processes."""
    with ProcessPoolExecutor(2, get_context('spawn')) as made:
        yield made


@pytest.fixture
def cluster(tmp_path):
    """Start a scheduler with two workers in processes of their own: executor and client."""
    distributed = pytest.importorskip('distributed', reason='dask.distributed is not installed')
    with (
        distributed.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            dashboard_address=None,
            local_directory=str(tmp_path),
        ) as made,
        distributed.Client(made) as client,
    ):
        client.run(sys.path.extend, [str(HERE), str(HERE.parent)])
        yield client


def test_threads_play_the_same_shots():
    with ThreadPoolExecutor(2) as threads:
        found = simulate_many(COURSE, VELOCITIES, SPINS, executor=threads, chunks=5)
    assert found.tobytes() == alone().tobytes()


BY_FRESH_THREADS = """
from concurrent.futures import ThreadPoolExecutor
from golf_sim_ros.physics import simulate_many
from test_executors import COURSE, SPINS, VELOCITIES, alone

with ThreadPoolExecutor(4) as threads:
    found = simulate_many(
        COURSE, VELOCITIES, SPINS, executor=threads, chunks=4, engine='compiled'
    )
assert found.tobytes() == alone().tobytes()
"""


def test_threads_may_be_the_first_that_play():
    pytest.importorskip('numba', reason='numba is not installed')
    path = os.pathsep.join([str(HERE.parents[1]), str(HERE), str(HERE.parent)])
    done = subprocess.run(
        [sys.executable, '-c', BY_FRESH_THREADS],
        env={**os.environ, 'PYTHONPATH': path},
        capture_output=True,
        text=True,
        timeout=500,
    )
    assert done.returncode == 0, done.stderr


def test_processes_play_the_same_shots(processes):
    found = simulate_many(COURSE, VELOCITIES, SPINS, executor=processes, chunks=3)
    assert found.tobytes() == alone().tobytes()


def test_workers_of_dask_play_the_same_shots(cluster):
    found = simulate_many(COURSE, VELOCITIES, SPINS, executor=cluster.get_executor(), chunks=3)
    assert found.tobytes() == alone().tobytes()


def test_ranks_of_mpi_play_the_same_shots(tmp_path):
    folders = os.pathsep.join([str(Path(sys.executable).parent), os.environ['PATH']])
    mpiexec = shutil.which('mpiexec', path=folders)
    if mpiexec is None or importlib.util.find_spec('mpi4py') is None:
        pytest.skip('mpiexec or mpi4py is not installed')
    script, told = tmp_path / 'shots.py', tmp_path / 'told.npy'
    script.write_text(BY_MPI.format(str(told)))
    path = os.pathsep.join([str(HERE.parents[1]), str(HERE), str(HERE.parent)])
    done = subprocess.run(
        [mpiexec, '-n', '3', sys.executable, '-m', 'mpi4py.futures', str(script)],
        env={**os.environ, 'PYTHONPATH': path},
        capture_output=True,
        text=True,
        timeout=500,
    )
    assert done.returncode == 0, done.stderr
    assert np.load(told).tobytes() == alone().tobytes()


@pytest.mark.parametrize('workers', [None, 2])
def test_no_shots_are_no_shots(workers):
    nothing = np.zeros((0, 3))
    executor = ThreadPoolExecutor(workers) if workers else None
    found = simulate_many(COURSE, nothing, nothing, executor=executor)
    assert len(found) == 0 and found.dtype == alone().dtype


def test_a_process_that_is_killed_is_an_error_that_says_so(processes):
    lethal = Lethal(processes)
    with pytest.raises(
        RuntimeError, match='^a worker of Lethal ended before its shots were played: '
    ):
        simulate_many(COURSE, VELOCITIES, SPINS, executor=lethal)


def test_workers_of_dask_that_are_killed_again_and_again_are_an_error_that_says_so(cluster):
    with pytest.raises(Exception, match='workers died'):  # dask's own, after some attempts
        simulate_many(COURSE, VELOCITIES, SPINS, executor=Lethal(cluster.get_executor()), chunks=2)


class Lethal:
    """An executor whose workers are killed by what they play."""

    def __init__(self, executor):
        self.executor = executor

    def map(self, function, parts):  # noqa: A003
        return self.executor.map(die, parts)
