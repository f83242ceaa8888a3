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

"""What ruff, pydocstyle and mypy say, where they are installed; flake8 is in `test_style`."""

from importlib.util import find_spec
from pathlib import Path
import subprocess
import sys

import pytest

ROOT = Path(__file__).resolve().parents[1]
COMMANDS = (
    ('ruff', 'check'),
    ('ruff', 'format', '--check'),
    ('pydocstyle', 'golf_sim_ros'),
    ('mypy',),
)


@pytest.mark.parametrize('command', COMMANDS, ids=' '.join)
def test_a_linter_finds_nothing(command, tmp_path, monkeypatch):
    if find_spec(command[0]) is None:
        pytest.skip(f'{command[0]} is not installed here: make lint installs it, and runs it')
    monkeypatch.setenv('MYPY_CACHE_DIR', str(tmp_path))
    monkeypatch.setenv('RUFF_NO_CACHE', 'true')
    check = subprocess.run(
        [sys.executable, '-m', *command], cwd=ROOT, capture_output=True, text=True
    )
    assert check.returncode == 0, check.stdout + check.stderr
