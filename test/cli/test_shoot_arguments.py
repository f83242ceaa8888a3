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

"""What is typed after `shoot`.

Needs rclpy, which takes ROS's arguments off the line; no sim, no DDS.
"""

from math import cos, pi, radians

from golf_sim_ros.shot_input.clubs import CLUBS
from golf_sim_ros.shot_input.launch_monitor import Launch
import pytest

shoot = pytest.importorskip('golf_sim_ros.cli.shoot')

MPH, RPM = 0.44704, 2.0 * pi / 60.0


def launch_of(line):
    """Return the launch that a line gives."""
    return shoot.parsed(line.split())[1]


@pytest.mark.parametrize(
    'line, expected',
    [
        (
            '--speed 100 --launch 10 --azimuth 2 --backspin 3000 --sidespin 500',
            Launch(100 * MPH, radians(10), radians(2), 3000 * RPM, 500 * RPM),
        ),
        (
            '--units si --speed 50 --launch 10 --azimuth -2 --backspin 300 --sidespin -50',
            Launch(50.0, radians(10), radians(-2), 300.0, -50.0),
        ),
        (
            '--speed 100 --spin 3000 --axis 30',
            Launch(100 * MPH, 0.0, 0.0, 3000 * RPM * cos(pi / 6), 1500 * RPM),
        ),
        ('7i', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM)),
        ('7i --axis -90', Launch(120 * MPH, radians(16.3), 0.0, 0.0, -7097 * RPM)),
        ('7i --sidespin 300', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM, 300 * RPM)),
        ('7i --power 0.5', Launch(60 * MPH, radians(16.3), 0.0, 3548.5 * RPM)),
        ('7i --power 0.5 --speed 80', Launch(80 * MPH, radians(16.3), 0.0, 3548.5 * RPM)),
        ('7i --launch 30 --spin 5000', Launch(120 * MPH, radians(30), 0.0, 5000 * RPM)),
        ('7i --units si', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM)),
        ('putter --speed 4', Launch(4 * MPH)),
        ('putter --units si --speed 2', Launch(2.0)),
    ],
)
def test_a_line_gives_its_launch(line, expected):
    assert launch_of(line) == pytest.approx(expected, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize(
    'line, reason',
    [
        ('', 'give a club, or the ball speed with --speed'),
        ('putter', 'give the ball speed with --speed'),
        ('putter --speed 4 --power 1', '--power needs a club'),
        ('--speed 100 --power 0.5', '--power needs a club'),
        ('driver --spin 3000 --sidespin 10', 'not both'),
        ('niblick', "unknown club 'niblick'"),
        ('driver --speed fast', "'fast' is not a number"),
        ('driver --speed nan', 'not a finite number'),
        ('driver --azimuth inf', 'not a finite number'),
        ('driver --speed -5', '-5 is negative'),
        ('driver --ball Red', "'Red' is no name of a ball"),
        ('driver --aim pin', 'invalid choice'),
        ('driver --units feet', 'invalid choice'),
        ('driver 7i', 'unrecognized arguments'),
    ],
)
def test_a_wrong_line_is_refused_with_the_reason_and_exit_code_two(line, reason, capsys):
    with pytest.raises(SystemExit) as ended:
        launch_of(line)
    assert ended.value.code == 2
    assert reason in capsys.readouterr().err


def test_the_line_to_paste_holds_every_digit_as_yaml_reads_it():
    yaml = pytest.importorskip('yaml')
    velocity, spin = (1.0 / 3.0, -1e-05, 14.11704888131157), (1.5e-300, 2e20, 0.0)
    line = shoot.publish_line('/shot', velocity, spin)
    start, message, end = line.split("'")
    assert (start, end) == ('ros2 topic pub --once /shot geometry_msgs/msg/Twist ', '')
    read = yaml.safe_load(message)
    assert tuple(read['linear'].values()) == velocity
    assert tuple(read['angular'].values()) == spin
    assert [*read['linear'], *read['angular']] == [*'xyzxyz']


def test_the_help_tells_of_every_option_and_club():
    text = shoot.parser().format_help()
    for word in [
        *CLUBS,
        '--aim',
        '--print',
        '--units',
        '--axis',
        '--power',
        '--timeout',
        'exit code',
    ]:
        assert word in text
