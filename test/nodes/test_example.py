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

"""The example of a client does what it says, against a sim in another process."""

import os
from pathlib import Path
import re
import subprocess
import sys

from processes import DEADLINE, READY

EXAMPLE = Path(__file__).parents[2] / 'examples' / 'one_shot.py'


def test_the_example_strikes_and_tells_the_result(start):
    start(
        'sim_node', '--ros-args', '-r', '__ns:=/example', '-p', 'real_time_factor:=20.0'
    ).wait_for(READY)
    run = subprocess.run(
        [sys.executable, str(EXAMPLE), '--ros-args', '-r', '__ns:=/example'],
        capture_output=True,
        text=True,
        env=os.environ,
        timeout=DEADLINE,
    )
    assert run.returncode == 0, run.stderr
    carry, total = map(
        float,
        re.fullmatch(
            r'at_rest: (\S+) m carry, (\S+) m in all, \S+ m to the hole\n', run.stdout
        ).groups(),
    )
    assert 150.0 < carry < total < 300.0


def test_the_example_is_as_short_as_the_documentation_says():
    lines = EXAMPLE.read_text(encoding='utf-8').splitlines()
    code = [line for line in lines if line.strip() and not line.startswith(('#', '"""'))]
    assert len(code) <= 20
