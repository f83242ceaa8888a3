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

"""The command wind_field: it solves, goes on where it stopped, says what is wrong in one line."""

import subprocess
import sys

from golf_sim_ros.cli import wind_field
from golf_sim_ros.course import load_course
from golf_sim_ros.physics.engine.engines import missing
from golf_sim_ros.wind import WindField
import pytest

needs_numba = pytest.mark.skipif(bool(missing()), reason=missing() or 'numba is here')
COURSE = """\
format: 1
name: Meadow
hole: [100, 0]
ground: [{shape: plane, material: fairway}]
obstacles:
  - {shape: sphere, center: [50, 0, 6], radius: 4, material: leaves}
"""


@pytest.fixture
def course(tmp_path):
    """Path of a meadow with a tree."""
    path = tmp_path / 'meadow.yaml'
    path.write_text(COURSE)
    return path


def run(course, *words):
    """Exit code of the command, for a field beside the `course`."""
    path = course.with_name('wind.npz')
    return wind_field.main([str(course), '-o', str(path), '--accuracy', 'sketch', *words])


@needs_numba
def test_it_writes_a_field_that_the_course_then_takes(course, capsys):
    assert run(course, '--directions', '3', '--compact') == 0
    told = capsys.readouterr().out.splitlines()
    assert told[0].startswith('Meadow: ') and ' cells of ' in told[0]
    assert told[3].startswith('direction 3 of 3, 240 degrees: ') and 'changes' in told[3]
    assert told[4].endswith('in the course file: wind_field: wind.npz')
    course.write_text(f'{COURSE}wind_field: wind.npz\n')
    assert len(load_course(course).wind_field.angles) == 3
    assert run(course, '--directions', '2') == 0  # it may be made anew for a course that has one
    assert len(WindField.load(course.with_name('wind.npz')).angles) == 2


@needs_numba
def test_what_was_stopped_goes_on_and_ends_with_the_same_bits(course, capsys, monkeypatch):
    from golf_sim_ros.wind import solving

    assert run(course, '--directions', '4') == 0
    whole = course.with_name('wind.npz').read_bytes()
    course.with_name('wind.npz').unlink()
    solve_direction, solved = solving.solve_direction, []

    def stopped(case, angle, progress=None):
        if len(solved) == 2:
            raise KeyboardInterrupt
        solved.append(angle)
        return solve_direction(case, angle, progress)

    monkeypatch.setattr(solving, 'solve_direction', stopped)
    capsys.readouterr()
    assert run(course, '--directions', '4') == 130
    assert '2 of 4 directions are kept; the same command goes on' in capsys.readouterr().out
    assert not course.with_name('wind.npz').exists()
    monkeypatch.setattr(solving, 'solve_direction', solve_direction)
    assert run(course, '--directions', '4') == 0
    told = capsys.readouterr().out
    assert '2 of 4 directions were done before' in told
    assert course.with_name('wind.npz').read_bytes() == whole
    assert not course.with_name('wind.npz.part').exists()


@needs_numba
def test_what_was_kept_of_another_land_is_not_used(course, capsys, monkeypatch):
    from golf_sim_ros.wind import solving

    solve_direction = solving.solve_direction

    def stopped(case, angle, progress=None):
        if angle > 1.0:
            raise KeyboardInterrupt
        return solve_direction(case, angle, progress)

    monkeypatch.setattr(solving, 'solve_direction', stopped)
    assert run(course, '--directions', '2') == 130
    monkeypatch.setattr(solving, 'solve_direction', solve_direction)
    course.write_text(COURSE.replace('radius: 4', 'radius: 5'))
    capsys.readouterr()
    assert run(course, '--directions', '2') == 0
    assert 'done before' not in capsys.readouterr().out


@needs_numba
def test_several_processes_give_the_same(course):
    assert run(course, '--directions', '2') == 0
    one = WindField.load(course.with_name('wind.npz'))
    assert run(course, '--directions', '2', '--jobs', '2') == 0
    two = WindField.load(course.with_name('wind.npz'))
    assert one.cells.ratios.tobytes() == two.cells.ratios.tobytes()


@needs_numba
def test_it_draws_the_field(course, capsys):
    pytest.importorskip('matplotlib')
    assert run(course, '--directions', '2', '--plot') == 0
    picture = course.with_name('wind.png')
    assert capsys.readouterr().out.splitlines()[-1] == str(picture)
    assert picture.read_bytes().startswith(b'\x89PNG') and picture.stat().st_size > 20000


@pytest.mark.parametrize(
    'words, reason',
    [
        (['linx', '-o', 'x.npz'], "course 'linx' is unknown"),
        (['meadow.yaml', '-o', 'none/x.npz', '--accuracy', 'mass'], 'No such file or directory'),
    ],
)
@needs_numba
def test_what_is_wrong_is_one_line(course, capsys, monkeypatch, words, reason):
    monkeypatch.chdir(course.parent)
    assert wind_field.main([*words, '--directions', '1']) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith('wind_field: ') and reason in line


@needs_numba
def test_a_profile_that_is_no_logarithm_is_one_line(course, capsys):
    course.write_text(f'{COURSE}wind_profile: {{law: uniform}}\n')
    assert run(course) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert 'needs a logarithmic wind_profile, and this is UniformProfile' in line


@pytest.mark.parametrize('count', ['0', '-1', '1.5', 'many', '1000'])
def test_numbers_that_make_no_sense_are_refused(course, count):
    for option in ('--directions', '--jobs'):
        with pytest.raises(SystemExit, match='2'):
            run(course, option, count)


def test_without_numba_it_says_what_to_install(course):
    code = (
        "import sys; sys.modules['numba'] = None\n"
        'from golf_sim_ros.cli import wind_field\n'
        'sys.exit(wind_field.main(sys.argv[1:]))'
    )
    words = [sys.executable, '-c', code, str(course), '-o', str(course.with_name('wind.npz'))]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.startswith('wind_field: solving for a wind field needs numba: pip install')


def test_without_numba_balls_fly_through_a_field():
    code = (
        "import sys; sys.modules['numba'] = None\n"
        'from golf_sim_ros.course import load_course\n'
        'from golf_sim_ros.physics import Shot, simulate\n'
        'shot = Shot((30.0, 0.0, 15.0), (0.0, -300.0, 0.0))\n'
        "links = load_course('links')\n"
        "ends = [simulate(links, shot, wind=(0.0, v, 0.0), engine='python') for v in (0.0, 8.0)]\n"
        'print(ends[1].result.side - ends[0].result.side)'
    )
    done = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) > 1.0
