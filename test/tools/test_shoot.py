# SPDX-License-Identifier: Apache-2.0
"""What is typed becomes the right velocity and spin, without ROS where that is possible."""
from math import atan2, cos, degrees, hypot, pi, radians, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis.strategies import floats

from golf_sim_ros.tools.clubs import club, CLUBS, TOUR_AVERAGES
from golf_sim_ros.tools.launch_monitor import Launch, parted, velocity_and_spin
from golf_sim_ros.tools.result_table import result_table
from golf_sim_ros.tools.units import UNITS

MPH, YARD, RPM = 1609.344 / 3600.0, 0.9144, 2.0 * pi / 60.0
ANGLES = floats(-pi, pi)
SPINS = floats(-1000.0, 1000.0)


def magnus_direction(velocity, spin):
    """The Magnus force points along spin x velocity."""
    return np.cross(spin, velocity)


@pytest.mark.parametrize('name, sizes', [
    ('golf', (MPH, pi / 180.0, RPM, YARD)), ('si', (1.0, pi / 180.0, 1.0, 1.0))])
def test_units_are_as_they_are_defined(name, sizes):
    assert [unit.size for unit in UNITS[name]] == pytest.approx(sizes, rel=1e-15)


def test_a_level_shot_at_the_target_flies_along_x():
    assert velocity_and_spin(Launch(50.0)) == ((50.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_positive_azimuth_starts_to_the_right_of_the_target():
    (x, y, _), _ = velocity_and_spin(Launch(50.0, azimuth=radians(3.0)))
    assert y < 0.0
    assert atan2(-y, x) == pytest.approx(radians(3.0), abs=1e-14)


def test_backspin_on_a_shot_along_x_is_negative_y_and_lifts():
    velocity, spin = velocity_and_spin(Launch(50.0, backspin=300.0))
    assert spin == (0.0, -300.0, 0.0)
    assert magnus_direction(velocity, spin) == pytest.approx([0.0, 0.0, 15000.0])


def test_positive_sidespin_curves_to_the_right():
    velocity, spin = velocity_and_spin(Launch(50.0, sidespin=100.0))
    assert spin == (0.0, 0.0, -100.0)
    assert magnus_direction(velocity, spin) == pytest.approx([0.0, -5000.0, 0.0])


def test_a_spin_axis_tilted_to_the_right_curves_to_the_right_and_still_lifts():
    backspin, sidespin = parted(300.0, radians(20.0))
    velocity, spin = velocity_and_spin(Launch(50.0, backspin=backspin, sidespin=sidespin))
    _, y, z = magnus_direction(velocity, spin)
    assert y < 0.0 < z
    assert degrees(atan2(-y, z)) == pytest.approx(20.0)
    assert np.linalg.norm(spin) == pytest.approx(300.0)


@given(ANGLES, floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_the_spin_has_the_size_of_its_parts_and_is_perpendicular_to_the_velocity(
        heading, launch, azimuth, backspin, sidespin):
    velocity, spin = velocity_and_spin(Launch(70.0, launch, azimuth, backspin, sidespin), heading)
    assert np.linalg.norm(velocity) == pytest.approx(70.0)
    assert np.linalg.norm(spin) == pytest.approx(hypot(backspin, sidespin), abs=1e-9)
    assert np.dot(velocity, spin) == pytest.approx(0.0, abs=1e-9)


@given(ANGLES, floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_turning_the_target_turns_the_shot(heading, launch, azimuth, backspin, sidespin):
    shot = Launch(70.0, launch, azimuth, backspin, sidespin)
    turn = np.array([[cos(heading), -sin(heading), 0.0], [sin(heading), cos(heading), 0.0], [0.0, 0.0, 1.0]])
    for straight, turned in zip(velocity_and_spin(shot), velocity_and_spin(shot, heading)):
        assert turn @ straight == pytest.approx(turned, abs=1e-9)


@given(floats(-1.5, 1.5), ANGLES, SPINS, SPINS)
def test_a_shot_with_azimuth_and_sidespin_reversed_is_the_mirror_image(launch, azimuth, backspin, sidespin):
    velocity, spin = velocity_and_spin(Launch(70.0, launch, azimuth, backspin, sidespin))
    mirrored = velocity_and_spin(Launch(70.0, launch, -azimuth, backspin, -sidespin))
    # Spin is a pseudovector: its part across the mirror stays, the others turn round.
    assert mirrored[0] == pytest.approx((velocity[0], -velocity[1], velocity[2]), abs=1e-9)
    assert mirrored[1] == pytest.approx((-spin[0], spin[1], -spin[2]), abs=1e-9)


def test_the_driver_is_the_average_of_the_tour():
    launch = CLUBS['driver'].launch
    assert launch.speed == pytest.approx(74.66, abs=0.005)
    assert degrees(launch.launch) == pytest.approx(10.9)
    assert launch.backspin / RPM == pytest.approx(2686.0)
    assert (launch.azimuth, launch.sidespin) == (0.0, 0.0)
    assert CLUBS['driver'].carry == pytest.approx(251.46)


def test_from_the_longest_club_to_the_shortest_speed_and_carry_fall_and_spin_rises():
    _, speeds, _, spins, carries = (list(column) for column in zip(*TOUR_AVERAGES))
    assert speeds == sorted(speeds, reverse=True)
    assert spins == sorted(spins)
    assert carries == sorted(carries, reverse=True)


@pytest.mark.parametrize('text, name', [
    ('driver', 'driver'), ('Driver', 'driver'), ('7i', '7i'), ('7-iron', '7i'), ('7 Iron', '7i'),
    ('3w', '3w'), ('3-wood', '3w'),
    ('PW', 'pw'), ('pitching wedge', 'pw'), ('putt', 'putter'), ('hybrid', 'hybrid')])
def test_clubs_are_found_as_people_write_them(text, name):
    assert club(text) is CLUBS[name]


@pytest.mark.parametrize('text', ['', '1i', 'i', '77i', 'niblick'])
def test_an_unknown_club_is_refused_with_those_there_are(text):
    with pytest.raises(ValueError, match=f"unknown club '{text}'; known: driver, 3w, .*, putter"):
        club(text)


RESULT = {
    'shot': 3, 'ball': 'ball', 'status': 'at_rest', 'carry': 251.46, 'carry_side': -9.144, 'total': 274.32,
    'side': 0.9144, 'apex': 29.2608, 'flight_time': 6.51, 'duration': 13.2, 'to_hole': 68.58,
    'lie': 'fairway', 'landing_speed': 26.8224, 'landing_angle': 0.6632, 'bounces': 6, 'time': 90.1,
    'position': [274.0, 0.9, 0.02], 'velocity': [73.3, 0.0, 14.1], 'spin': [0.0, -281.3, 0.0], 'reason': ''}


def test_a_result_is_an_aligned_table_in_the_units_of_golf():
    assert result_table(RESULT, UNITS['golf']).splitlines() == [
        'ball           ball',
        'ended          at rest, fairway',
        'carry            275.00 yd',
        'carry side        10.00 yd right',
        'apex              32.00 yd',
        'flight time        6.51 s',
        'landing speed     60.00 mph',
        'landing angle     38.00 deg',
        'bounces            6',
        'total            300.00 yd',
        'side               1.00 yd left',
        'duration          13.20 s',
        'to the hole       75.00 yd',
    ]


def test_a_result_in_si_keeps_metres():
    table = result_table(RESULT, UNITS['si'])
    assert 'carry            251.46 m\n' in table
    assert 'landing speed     26.82 m/s\n' in table


def test_a_putt_has_no_lines_about_a_flight_and_a_hole_that_is_not_there_none_either():
    putt = {**RESULT, 'status': 'holed', 'carry': 0.0, 'carry_side': 0.0, 'apex': 0.0, 'flight_time': 0.0,
            'landing_speed': 0.0, 'landing_angle': 0.0, 'bounces': 0, 'to_hole': None, 'side': 0.0}
    labels = [line[:15].strip() for line in result_table(putt, UNITS['si']).splitlines()]
    assert labels == ['ball', 'ended', 'total', 'side', 'duration']
    assert 'in the hole' in result_table(putt, UNITS['si'])


class TestTyped:
    """Command lines; they need rclpy, which takes ROS's arguments off them."""

    @pytest.fixture(autouse=True)
    def shoot(self):
        self.shoot = pytest.importorskip('golf_sim_ros.tools.shoot')

    def launch(self, line):
        return self.shoot.parsed(line.split())[1]

    @pytest.mark.parametrize('line, expected', [
        ('--speed 100 --launch 10 --azimuth 2 --backspin 3000 --sidespin 500',
         Launch(100 * MPH, radians(10), radians(2), 3000 * RPM, 500 * RPM)),
        ('--units si --speed 50 --launch 10 --azimuth -2 --backspin 300 --sidespin -50',
         Launch(50.0, radians(10), radians(-2), 300.0, -50.0)),
        ('--speed 100 --spin 3000 --axis 30',
         Launch(100 * MPH, 0.0, 0.0, 3000 * RPM * cos(pi / 6), 1500 * RPM)),
        ('7i', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM)),
        ('7i --axis -90', Launch(120 * MPH, radians(16.3), 0.0, 0.0, -7097 * RPM)),
        ('7i --sidespin 300', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM, 300 * RPM)),
        ('7i --power 0.5', Launch(60 * MPH, radians(16.3), 0.0, 3548.5 * RPM)),
        ('7i --power 0.5 --speed 80', Launch(80 * MPH, radians(16.3), 0.0, 3548.5 * RPM)),
        ('7i --launch 30 --spin 5000', Launch(120 * MPH, radians(30), 0.0, 5000 * RPM)),
        ('7i --units si', Launch(120 * MPH, radians(16.3), 0.0, 7097 * RPM)),
        ('putter --speed 4', Launch(4 * MPH)),
        ('putter --units si --speed 2', Launch(2.0)),
    ])
    def test_a_line_gives_its_launch(self, line, expected):
        assert self.launch(line) == pytest.approx(expected, rel=1e-12, abs=1e-9)

    @pytest.mark.parametrize('line, reason', [
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
    ])
    def test_a_wrong_line_is_refused_with_the_reason_and_exit_code_two(self, line, reason, capsys):
        with pytest.raises(SystemExit) as ended:
            self.launch(line)
        assert ended.value.code == 2
        assert reason in capsys.readouterr().err

    def test_the_line_to_paste_holds_every_digit_as_yaml_reads_it(self):
        yaml = pytest.importorskip('yaml')
        velocity, spin = (1.0 / 3.0, -1e-05, 14.11704888131157), (1.5e-300, 2e+20, 0.0)
        line = self.shoot.publish_line('/shot', velocity, spin)
        start, message, end = line.split("'")
        assert (start, end) == ('ros2 topic pub --once /shot geometry_msgs/msg/Twist ', '')
        read = yaml.safe_load(message)
        assert tuple(read['linear'].values()) == velocity
        assert tuple(read['angular'].values()) == spin
        assert [*read['linear'], *read['angular']] == [*'xyzxyz']

    def test_the_help_tells_of_every_option_and_club(self):
        text = self.shoot.parser().format_help()
        for word in [*CLUBS, '--aim', '--print', '--units', '--axis', '--power', '--timeout', 'exit code']:
            assert word in text
