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

"""compile_physics compiles what is not compiled, or says in one line why it cannot."""

from golf_sim_ros.cli.compile_physics import main
from golf_sim_ros.physics.engine.engines import missing
from golf_sim_ros.physics.jit import build, cache
import pytest

NARROW = """\
format: 1
name: Narrow
ground:
- shape: patch
  center: [0, 0, 0]
  normal: [0, 0, 1]
  heading: 0
  length: 0.1
  width: 0.1
  material: green
tee: [0, 0]
"""


@pytest.mark.skipif(bool(missing()), reason=missing() or 'numba is here')
def test_it_says_where_what_is_compiled_is_kept(capsys):
    assert main(['--only', 'one ball']) == 0
    assert capsys.readouterr().out == f'kept in {cache.folder().path}\n'
    assert main(['--only', 'one ball', '--course', 'playground']) == 0  # the same program


def test_without_numba_it_says_how_to_get_it(capsys, monkeypatch):
    monkeypatch.setattr(build, 'missing', lambda: 'numba is not installed: pip install numba')
    assert main([]) == 1
    told = capsys.readouterr()
    assert (
        told.err.splitlines()[-1] == 'compile_physics: numba is not installed: pip install numba'
    )


def test_a_tee_for_one_ball_is_one_line(capsys, tmp_path):
    path = tmp_path / 'narrow.yaml'
    path.write_text(NARROW)
    assert main(['--course', str(path)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith('compile_physics: ') and 'do not fit beside each other' in line


def test_an_unknown_course_is_one_line(capsys):
    assert main(['--course', 'linx']) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith('compile_physics: ') and 'linx' in line
