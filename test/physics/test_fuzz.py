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

"""A short run of tools/fuzz.py: random scenes of allowed numbers, five shots in each.

They are played in plain Python.
"""

from pathlib import Path
import sys
from tempfile import TemporaryDirectory

from golf_sim_ros.physics.trajectory import shot_record as shot_
from other_process import run
import pytest

TOOLS = Path(__file__).parents[2] / 'tools'
SEEDS = (1004, 1009, 1010, 1015, 1016, 1018, 1020, 1024, 1027, 1037, 1038)
FEW = 2000  # segments of path: plain Python takes its time


def outcomes():
    """Outcome of each seed's scene."""
    sys.path.append(str(TOOLS))
    import fuzz_scenes

    shot_.MOST_WORK, fuzz_scenes.MOST_TIME = FEW, float('inf')
    told = []
    for seed in SEEDS:
        with TemporaryDirectory() as folder:
            told.append(fuzz_scenes.played(seed, folder))
    return told


@pytest.fixture(scope='module')
def told():
    return run(outcomes)


def test_random_scenes_are_refused_by_name_or_played_to_their_end(told):
    assert [trouble for *_, trouble in told] == [''] * len(SEEDS)
    for refused, statuses, *_ in told:
        assert (
            len(statuses) >= 5 or 'scene.yaml: ' in refused or refused.startswith('World: balls ')
        )


def test_most_of_them_are_played(told):
    assert sum(not refused for refused, *_ in told) > len(SEEDS) / 2
