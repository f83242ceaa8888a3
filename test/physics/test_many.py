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

"""Many shots at once: in threads and processes the same bits, with a bar that sees every part."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

from driving_range import level, TURF
from golf_sim_ros.physics import batch, simulate_many
import numpy as np
import pytest

SHOTS = 100
VELOCITIES = np.linspace((20.0, -3.0, 10.0), (70.0, 3.0, 14.0), SHOTS)
SPINS = np.tile((0.0, -280.0, 20.0), (SHOTS, 1))
GUSTS = np.array([[0.0, 4.0, -3.0, 0.0], [0.7, -5.0, 2.0, 0.0]])


def alone():
    """Play the shots one after the other."""
    return simulate_many(level(TURF), VELOCITIES, SPINS, GUSTS)


@pytest.mark.parametrize('chunks', [1, 7, 200])
def test_threads_give_the_same_bits_in_the_same_order(chunks):
    with ThreadPoolExecutor(4) as threads:
        found = simulate_many(
            level(TURF), VELOCITIES, SPINS, GUSTS, executor=threads, chunks=chunks
        )
    assert found.tobytes() == alone().tobytes()


def test_processes_give_the_same_bits():
    with ProcessPoolExecutor(1, get_context('spawn')) as processes:
        found = simulate_many(level(TURF), VELOCITIES, SPINS, GUSTS, executor=processes, chunks=2)
    assert found.tobytes() == alone().tobytes()


@pytest.mark.parametrize('threads', [None, 2])
def test_progress_sees_every_part(threads, monkeypatch):
    monkeypatch.setattr(batch, 'PART', 10)
    told = []

    def progress(parts, total):
        for part in parts:
            yield part
            told.append(total)

    executor = ThreadPoolExecutor(threads) if threads else None
    found = simulate_many(
        level(TURF), VELOCITIES, SPINS, GUSTS, executor=executor, chunks=5, progress=progress
    )
    assert told == ([5] * 5 if threads else [10] * 10)
    assert found.tobytes() == alone().tobytes()
    if executor:
        executor.shutdown()


@pytest.mark.parametrize('wind', [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)])
def test_kernels_see_no_effect_that_is_off(monkeypatch, wind):
    seen = []
    play_all = batch.play_all
    monkeypatch.setattr(
        batch, 'play_all', lambda model, *rest: seen.append(model) or play_all(model, *rest)
    )
    simulate_many(level(TURF), VELOCITIES[:1], SPINS[:1], wind, engine='python')
    types = {type(effect).__name__ for model in seen for effect in model.effects}
    assert 'Drag' in types and 'Water' not in types and ('Wind' in types) == any(wind)
