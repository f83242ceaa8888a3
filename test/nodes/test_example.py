# SPDX-License-Identifier: Apache-2.0
"""The example of a client does what it says, against a sim in another process."""
import os
import re
import subprocess
import sys
from pathlib import Path

from processes import DEADLINE, READY

EXAMPLE = Path(__file__).parents[2] / 'examples' / 'one_shot.py'


def test_the_example_strikes_and_tells_the_result(start):
    start('sim_node', '--ros-args', '-r', '__ns:=/example', '-p', 'real_time_factor:=20.0').wait_for(READY)
    run = subprocess.run([sys.executable, str(EXAMPLE), '--ros-args', '-r', '__ns:=/example'],
                         capture_output=True, text=True, env=os.environ, timeout=DEADLINE)
    assert run.returncode == 0, run.stderr
    carry, total = map(float, re.fullmatch(
        r'at_rest: (\S+) m carry, (\S+) m in all, \S+ m to the hole\n', run.stdout).groups())
    assert 150.0 < carry < total < 300.0


def test_the_example_is_as_short_as_the_documentation_says():
    lines = EXAMPLE.read_text(encoding='utf-8').splitlines()
    code = [line for line in lines if line.strip() and not line.startswith(('#', '"""'))]
    assert len(code) <= 20
