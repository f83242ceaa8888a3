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

"""Tools whose output nobody reads any more."""

import os
import subprocess
import sys

from golf_sim_ros.cli.closed_pipe import UNREAD
import pytest
from recorded_play import bag, Sim

TOOLS = (
    'resimulate',
    'plot_play',
    'shoot',
    'record_play',
    'accuracy_study',
    'compare_shots',
    'view_play',
    'play_hole',
)
PLAIN = {**os.environ, 'NUMBA_DISABLE_JIT': '1', 'MPLBACKEND': 'agg'}


def into_a_closed_pipe(*command):
    """Exit code of a command whose output nobody reads, and what it says on stderr."""
    read, write = os.pipe()
    os.close(read)
    run = subprocess.run(
        [sys.executable, '-m', *command],
        stdout=write,
        stderr=subprocess.PIPE,
        text=True,
        env=PLAIN,
    )
    os.close(write)
    return run.returncode, run.stderr


@pytest.mark.parametrize('tool', TOOLS)
def test_help_that_is_not_read_ends_without_a_word(tool):
    if tool in ('shoot', 'record_play'):
        pytest.importorskip('rclpy')
    code, said = into_a_closed_pipe(f'golf_sim_ros.cli.{tool}', '--help')
    # argparse itself may see that nobody reads, and say nothing
    assert code in (0, UNREAD) and said == ''


@pytest.mark.parametrize(
    'tool, more', [('resimulate', ()), ('plot_play', ('-o', 'play.png', '--dpi', '20'))]
)
def test_a_play_that_is_not_read_ends_without_a_word(tmp_path, tool, more):
    if tool == 'plot_play':
        pytest.importorskip('matplotlib')
    told = Sim().play([(3, 'strike', ('red', (2.0, 0.1, 0.0), (0.0, 0.0, 0.0)))], 2000)
    path = bag(tmp_path / 'bag', told)
    more = [str(tmp_path / word) if word.endswith('.png') else word for word in more]
    assert into_a_closed_pipe(f'golf_sim_ros.cli.{tool}', str(path), *more) == (UNREAD, '')


def test_errors_that_are_not_read_end_without_a_word():
    command = f'{sys.executable} -m golf_sim_ros.cli.resimulate /nowhere 2>&1 >/dev/null | true'
    run = subprocess.run(
        ['bash', '-c', command + '; exit ${PIPESTATUS[0]}'],
        capture_output=True,
        text=True,
        env=PLAIN,
    )
    assert run.returncode in (1, UNREAD) and (run.stdout, run.stderr) == ('', '')
