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

"""plot_play draws what a bag holds."""

from pathlib import Path
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip('matplotlib')
pytest.importorskip('rosbags')
from golf_sim_ros.cli.plot_play import main  # noqa: E402, I100
from golf_sim_ros.drawing import recorded  # noqa: E402
from golf_sim_ros.drawing.wind import blown  # noqa: E402
from golf_sim_ros.recording.bag import read_bag  # noqa: E402
from matplotlib.image import imread  # noqa: E402
from play_bags import PAUSE, PlayedBag, RATE  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
WIND, GUST = (3.0, 2.0, 0.0), (0.0, -6.0, 0.0)
ROS = ('rclpy', 'std_msgs', 'geometry_msgs', 'rosidl_runtime_py', 'rosbag2_py')


def played(path, storage='mcap', left_out=(), namespace=''):
    """Write a bag of a drive with a gust, a refused strike and a pitch.

    Returns the results of what was played.
    """
    bag = PlayedBag(path, storage, left_out, namespace)
    bag.blow(WIND)
    bag.strike((73.3, 2.0, 14.1), (0.0, -281.0, -20.0), gust=GUST)
    bag.refuse()
    bag.strike((12.0, -4.0, 14.0), (0.0, -400.0, 0.0))
    bag.close()
    return bag.results


@pytest.fixture(scope='module', params=['mcap', 'sqlite3'])
def bag(request, tmp_path_factory):
    """Return a bag's path and the results of its shots."""
    path = tmp_path_factory.mktemp('bags') / request.param
    return path, played(path, request.param)


def test_every_shot_that_was_played_is_read_with_its_path(bag):
    path, results = bag
    shots = recorded(read_bag(path)[0])
    assert [shot.result.shot for shot in shots] == [1, 3]
    for shot, result in zip(shots, results):
        assert shot.positions[-1] == pytest.approx(result.position, abs=1e-4)
        assert shot.times[-1] == pytest.approx(result.time, abs=1e-6)
        assert shot.times[-1] - shot.times[0] == pytest.approx(result.duration, abs=1e-6)
        assert shot.velocities[0] == pytest.approx(result.velocity, abs=1e-4)
        assert shot.positions[:, 2].max() - shot.positions[0, 2] == pytest.approx(
            result.apex, abs=0.01
        )
        assert len(shot.collisions) == result.bounces
        assert (np.diff(shot.times) > 0.0).all() and np.diff(shot.times).max() < 0.03


def test_a_shot_begins_where_the_one_before_ended(bag):
    first, second = recorded(read_bag(bag[0])[0])
    assert second.positions[0] == pytest.approx(first.positions[-1], abs=1e-4)
    assert first.times[0] == pytest.approx(PAUSE / RATE)


def test_winds_are_those_that_blew(bag):
    first, second = recorded(read_bag(bag[0])[0])
    assert blown(first).tolist() == [list(WIND), list(GUST)]
    assert blown(second).tolist() == [list(GUST)]


def test_without_a_journal_the_same_is_found_to_some_milliseconds(bag, tmp_path):
    played(tmp_path / 'bag', left_out=('journal',))
    for with_journal, without in zip(
        recorded(read_bag(bag[0])[0]), recorded(read_bag(tmp_path / 'bag')[0])
    ):
        assert without.times[0] == pytest.approx(with_journal.times[0], abs=0.03)
        assert without.positions[-1] == pytest.approx(with_journal.positions[-1])
        assert blown(without).tolist() == blown(with_journal).tolist()
        halfway = with_journal.times[len(with_journal.times) // 2]
        places = [
            [np.interp(halfway, shot.times, shot.positions[:, axis]) for axis in range(3)]
            for shot in (with_journal, without)
        ]
        assert places[0] == pytest.approx(places[1], abs=1.0)


def test_a_picture_is_written(bag, tmp_path, capsys):
    assert main([str(bag[0]), '-o', str(tmp_path / 'play.png'), '--dpi', '50']) == 0
    assert imread(tmp_path / 'play.png').shape[1] == 600
    assert capsys.readouterr().out == f'{tmp_path / "play.png"}: 2 shots\n'


def test_only_the_shots_asked_for_are_drawn(bag, tmp_path, capsys):
    assert (
        main([str(bag[0]), '-o', str(tmp_path / 'play.png'), '--dpi', '50', '--shots', '3']) == 0
    )
    assert capsys.readouterr().out.endswith(': 1 shot\n')


def test_a_bag_without_journal_is_drawn_and_says_what_is_missing(tmp_path, capsys):
    played(tmp_path / 'bag', left_out=('journal',))
    output = ['-o', str(tmp_path / 'play.png'), '--dpi', '50']
    assert main([str(tmp_path / 'bag'), *output]) == 0
    assert '--course' in capsys.readouterr().err
    assert main([str(tmp_path / 'bag'), *output, '--course', 'golf_without_friends']) == 0
    assert capsys.readouterr().err == ''


def test_a_namespace_is_found(tmp_path, capsys):
    played(tmp_path / 'bag', namespace='/range')
    output = ['-o', str(tmp_path / 'play.png'), '--dpi', '50']
    assert main([str(tmp_path / 'bag'), *output, '--namespace', 'range']) == 0
    assert main([str(tmp_path / 'bag'), *output, '--namespace', 'elsewhere']) == 1


@pytest.mark.parametrize(
    'arguments, reason',
    [
        (['nothing/here'], 'no such bag'),
        (['BAG', '--shots', '2'], 'no such shot'),
        (['BAG', '--course', 'moon'], "'moon' is unknown"),
        (['BAG', '-o', 'no/such/folder/play.png'], 'No such file'),
        (['BAG', '-o', 'play.xyz'], 'xyz'),
    ],
)
def test_what_can_not_be_drawn_is_one_line_and_exit_code_1(bag, arguments, reason, capsys):
    words = [str(bag[0]) if word == 'BAG' else word for word in arguments]
    assert main([*words, '--dpi', '50']) == 1
    said = capsys.readouterr().err
    assert said.startswith('plot_play: ') and reason in said and said.count('\n') == 1


@pytest.mark.parametrize(
    'missing, code, said',
    [
        (ROS, 0, ''),
        (('matplotlib',), 1, 'golf_sim_ros[plot]'),
        (('rosbags', 'rosbags.highlevel'), 1, "pip install 'golf_sim_ros[bag]'"),
    ],
    ids=['ros', 'matplotlib', 'rosbags'],
)
def test_it_needs_no_ros_and_says_what_else_is_missing(bag, tmp_path, missing, code, said):
    source = (
        f'import sys; sys.modules.update(dict.fromkeys({missing!r})); '
        f'from golf_sim_ros.cli.plot_play import main; sys.exit(main(sys.argv[1:]))'
    )
    run = subprocess.run(
        [
            sys.executable,
            '-c',
            source,
            str(bag[0]),
            '-o',
            str(tmp_path / 'play.png'),
            '--dpi',
            '50',
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert run.returncode == code, run.stderr
    assert said in run.stderr
