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

"""A short run of tools/fuzz_files.py, and that it finds what is wrong."""

from pathlib import Path
import subprocess
import sys

import pytest

TOOLS = Path(__file__).resolve().parents[2] / 'tools'
COUNTS = {'courses': 150, 'meshes': 300, 'arrays': 300, 'bags': 80}


def fuzz(*arguments):
    """Exit code of a run, and what it says."""
    command = [sys.executable, str(TOOLS / 'fuzz_files.py'), *map(str, arguments)]
    run = subprocess.run(command, capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


@pytest.mark.parametrize('kind', COUNTS)
def test_mutated_files_are_read_or_refused_with_one_line(kind):
    if kind == 'bags':
        pytest.importorskip('rosbags')
    code, said = fuzz('--kinds', kind, '--seed', 21, '--count', COUNTS[kind])
    assert code == 0 and ' 0 faults' in said, said
    assert f'{kind}: 0 read' not in said and ' 0 refused' not in said


@pytest.fixture
def outcome(monkeypatch):
    """Return what is said of a case that does something."""
    monkeypatch.syspath_prepend(str(TOOLS))
    import signal

    import fuzz_reader

    before = signal.signal(signal.SIGPROF, fuzz_reader.stop)
    monkeypatch.setattr(fuzz_reader, 'LONGEST', 0.1)
    yield lambda read: fuzz_reader.outcome(
        lambda rng, place: (read, KeyError), None, None, 'meshes'
    )['fault']
    signal.signal(signal.SIGPROF, before)


def refuse(message):
    """Refuse a file."""
    raise KeyError(message)


def forever():
    """Read on and on."""
    while True:
        pass


def test_faults_are_found(outcome):
    import warnings

    assert outcome(lambda: None) == '' and outcome(lambda: refuse('a line')) == ''
    assert outcome(lambda: 1 / 0).startswith('ZeroDivisionError in ')
    assert outcome(lambda: [].missing).startswith('AttributeError')
    assert outcome(forever) == 'takes more than 0.1 s'
    assert outcome(lambda: refuse('x' * 400)).startswith('no short line')
    assert outcome(lambda: warnings.warn('odd', RuntimeWarning)).startswith('warns: odd')
