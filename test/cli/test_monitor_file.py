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

"""Exports of launch monitors: what is read of them as they come, and what is refused by a line."""

from math import degrees, hypot, isnan, pi

from golf_sim_ros.shot_input.monitor_columns import FIELDS, MONITORS, plain, UNKNOWN
from golf_sim_ros.shot_input.monitor_file import (
    How,
    LARGEST,
    parsed,
    read_monitor_file,
    shots_of,
    TableError,
)
import numpy as np
import pytest

MPH, YARD, RPM = 0.44704, 0.9144, pi / 30


def lines(*rows):
    """Join rows, in which a semicolon parts cells, as lines with commas."""
    return ''.join(row.replace(';', ',') + '\n' for row in rows)


GARMIN = lines(
    'Date;Club Name;Ball Speed;Launch Angle;Launch Direction;Backspin;Sidespin;Spin Rate'
    ';Spin Rate Type;Spin Axis;Apex Height;Carry Distance;Carry Deviation Angle',
    ';;[mph];[deg];[deg];[rpm];[rpm];[rpm];;[deg];[ft];[yd];[deg]',
    '06/01/26;Driver;150.2;12.0;-2.2;2700;200;2707.4;Measured;4.2;90.0;240.1;-1.0',
    '06/01/26;7 Iron;;16.0;0.0;6500;0;6500;Estimated;0.0;80.0;150.0;0.0',
)
TRACKMAN_HEADER = (
    'Club;Ball Speed (mph);Launch Angle (deg);Launch Direction (deg);Spin Rate (rpm)'
    ';Spin Axis (deg);Spin Loft (deg);Max Height - Height (ft);Carry Flat - Length (yd)'
    ';Land. Angle (deg);Carry Flat - Time (s)'
)
TRACKMAN = lines(
    'sep=;',
    'Range session;Player',
    ';',
    TRACKMAN_HEADER,
    '7i;120.0;16.3;1.2 L;"7,097";2.0 R;30;96;172.0;50.1;6.3',
    TRACKMAN_HEADER,
    '7i;121.0;16.0;0.3R;7001;-;30;-;173.5;;',
    'Average;120.5;16.2;;7049;;30;96;172.7;50.1;6.3',
    'Consistency;0.5;0.1;;48;;;;;;',
)
FLIGHTSCOPE = (
    'Shot;Ball (km/h);Club (km/h);Launch V (\u00b0);Launch H (\u00b0);Spin (rpm)'
    ';Spin Axis (\u00b0);Height (m);Carry (m);Descent V (\u00b0)\n'
    '1;193,1;138,2;16,3;-1,2;7097;1,5;29,3;157,3;49,5\n'
    'AVG;193,1;138,2;16,3;-1,2;7097;1,5;29,3;157,3;49,5\n'
)


def test_a_garmin_export_is_read_with_its_row_of_units():
    shots = shots_of(GARMIN)
    assert shots.clubs == ('Driver',) and shots.left_out == {'without ball speed': 1}
    (launch,) = shots.launches
    assert launch.speed == pytest.approx(150.2 * MPH)
    assert degrees(launch.azimuth) == pytest.approx(-2.2)
    assert launch.backspin == pytest.approx(2700 * RPM)
    assert launch.sidespin == pytest.approx(200 * RPM)
    carry, apex, angle, time = shots.told[:, 0]
    assert carry == pytest.approx(240.1 * YARD) and apex == pytest.approx(30 * YARD)
    assert isnan(angle) and isnan(time)
    assert shots.monitor is MONITORS['garmin'] and 'own model' in shots.monitor.carry


def test_a_trackman_export_is_read_with_sides_repeated_headers_and_averages():
    shots = shots_of(TRACKMAN)
    assert shots.clubs == ('7i', '7i') and shots.left_out == {'of averages': 2}
    first, second = shots.launches
    assert degrees(first.azimuth) == pytest.approx(-1.2)
    assert degrees(second.azimuth) == pytest.approx(0.3)
    assert hypot(first.backspin, first.sidespin) == pytest.approx(7097 * RPM)
    assert first.sidespin > 0 and second.sidespin == 0.0
    assert shots.told[:, 0] == pytest.approx([172 * YARD, 32 * YARD, 50.1 * pi / 180, 6.3])
    assert np.isnan(shots.told[1:, 1]).all()
    assert shots.monitor is MONITORS['trackman']


def test_a_flightscope_export_is_read_with_semicolons_and_decimal_commas():
    shots = shots_of(FLIGHTSCOPE)
    (launch,) = shots.launches
    assert launch.speed == pytest.approx(193.1 / 3.6)
    assert shots.clubs == ('',)  # Club (km/h) is a speed
    assert shots.told[:3, 0] == pytest.approx([157.3, 29.3, 49.5 * pi / 180])
    assert shots.monitor is MONITORS['flightscope']


@pytest.mark.parametrize('encoding', ['utf-8', 'utf-8-sig', 'utf-16', 'cp1252'])
@pytest.mark.parametrize('end', ['\n', '\r\n', '\r'])
def test_the_file_may_be_encoded_as_spreadsheets_do(tmp_path, encoding, end):
    path = tmp_path / 'a.csv'
    path.write_bytes(FLIGHTSCOPE.replace('\n', end).encode(encoding))
    assert read_monitor_file(path).told[0, 0] == pytest.approx(157.3)


@pytest.mark.parametrize(
    'header, name, unit',
    [
        ('Ball Speed (mph)', 'ballspeed', 'mph'),
        ('ball_speed_mph', 'ballspeed', 'mph'),
        ('Ball Speed [km/h]', 'ballspeed', 'km/h'),
        ('Ball Speed, m/s', 'ballspeed', 'm/s'),
        ('Ball Speed', 'ballspeed', ''),
        (' Launch V (\N{DEGREE SIGN})', 'launchv', '\N{DEGREE SIGN}'),
        ('Carry Flat - Length [yds]', 'carryflatlength', 'yds'),
        ('', '', ''),
    ],
)
def test_a_header_is_a_name_and_a_unit(header, name, unit):
    assert plain(header) == (name, unit)


def test_no_two_fields_share_a_name():
    names = [name for field in FIELDS.values() for name in field.names]
    assert len(names) == len(set(names)) and all(plain(name) == (name, '') for name in names)


@pytest.mark.parametrize(
    'text, name, comma, number, unit',
    [
        ('2.2 L', 'azimuth', False, -2.2, ''),
        ('L 2.2', 'azimuth', False, -2.2, ''),
        ('3.1R', 'axis', False, 3.1, ''),
        ('3,1 R', 'axis', True, 3.1, ''),
        ('150 mph', 'ball_speed', False, 150.0, 'mph'),
        ('12.5\u00b0', 'launch', False, 12.5, '\u00b0'),
        ('7,097', 'spin', False, 7097.0, ''),
        ('7,097', 'spin', True, 7097.0, ''),
        ('7 097', 'spin', True, 7097.0, ''),
        ('1.234,5', 'carry', True, 1234.5, ''),
        ('1,234.5', 'carry', False, 1234.5, ''),
        ('157,3', 'carry', True, 157.3, ''),
        ('\u22121.5', 'launch', False, -1.5, ''),
        ('+1.5', 'launch', False, 1.5, ''),
        ('.5', 'launch', False, 0.5, ''),
        ('2.5e2', 'carry', False, 250.0, ''),
    ],
)
def test_a_cell_is_a_number_with_side_and_unit(text, name, comma, number, unit):
    assert parsed(text, FIELDS[name], name, comma) == (pytest.approx(number), unit)


@pytest.mark.parametrize('text', ['', ' ', '-', '--', 'N/A', 'nan', 'NaN', 'None', '\u2014'])
def test_an_empty_cell_is_no_number_and_no_error(text):
    assert isnan(parsed(text, FIELDS['carry'], 'carry', False)[0])


@pytest.mark.parametrize(
    'text',
    ['abc', '12 mph', '1.2.3', '1,2,3', '5 L', 'inf', '-inf', '0x10', '1e999', '12 12 yd', '=A1'],
)
def test_what_is_no_length_is_refused(text):
    with pytest.raises(ValueError, match='.*'):
        parsed(text, FIELDS['carry'], 'carry', False)


HEAD = 'Ball Speed (mph),Launch Angle (deg),Spin Rate (rpm),Carry (yd)\n'
ROW = '150,12,2700,240\n'
BROKEN = {
    'is empty': '',
    'is empty ': '\n\n \n',
    'no header with known columns': 'a,b,c\n1,2,3\n',
    'no shot in it can be compared': HEAD,
    '1 without spin': HEAD + '150,12,,240\n',
    '1 without anything to compare': HEAD + '150,12,2700,\n',
    '1 too fast to be simulated': HEAD + '1500,12,2700,240\n',
    '1 that leave no tee upwards': HEAD + '150,-3,2700,240\n',
    "line 2, 'Carry (yd)': 'far' is no number": HEAD + '150,12,2700,far\n',
    'has no column for launch, spin': 'Ball Speed (mph),Carry (yd)\n150,240\n',
    'has no column for carry or apex': 'Ball Speed (mph),Launch Angle,Spin\n150,12,2700\n',
    "'Carry' has no unit; --unit carry=UNIT": HEAD.replace(' (yd)', '') + ROW,
    'is no text': 'a\0b',
}


@pytest.mark.parametrize('said', BROKEN)
def test_a_table_that_cannot_be_used_is_one_line(tmp_path, said):
    path = tmp_path / 'a.csv'
    path.write_text(BROKEN[said])
    with pytest.raises(TableError, match='^[^\\n]*$') as error:
        read_monitor_file(path)
    assert str(error.value).startswith(str(path)) and said.strip() in str(error.value)


def test_files_that_are_none_are_one_line(tmp_path):
    with pytest.raises(TableError, match='No such file'):
        read_monitor_file(tmp_path / 'none.csv')
    with pytest.raises(TableError, match='is no file'):
        read_monitor_file(tmp_path)
    large = tmp_path / 'large.csv'
    with large.open('wb') as file:
        file.truncate(LARGEST + 1)
    with pytest.raises(TableError, match='is larger than 50 MB'):
        read_monitor_file(large)


def test_other_names_and_units_are_told():
    text = 'v0,theta,omega,range\n67.1,12,283,219\n67.1,12,283,220\n'
    columns = {'ball_speed': 'v0', 'launch': 'theta', 'spin': 'omega', 'carry': 'range'}
    units = {'spin': 'rad/s', 'ball_speed': 'm/s'}
    shots = shots_of(text, How(columns, units, {'carry': 'm'}))
    assert shots.launches[0] == pytest.approx((67.1, 12 * pi / 180, 0.0, 283.0, 0.0))
    assert shots.told[0].tolist() == [219.0, 220.0] and shots.monitor is UNKNOWN
    with pytest.raises(TableError, match="has no column 'nil' for carry; it has: v0, theta"):
        shots_of(text, How({**columns, 'carry': 'nil'}, units))


def test_rows_may_be_short_or_long():
    shots = shots_of(HEAD + '150,12,2700\n' + '150,12,2700,240,,,\n' + ROW)
    assert len(shots.launches) == 2 and shots.left_out == {'without anything to compare': 1}


def test_any_bytes_are_read_or_refused_by_one_line(tmp_path):
    rng, path = np.random.default_rng(3), tmp_path / 'a.csv'
    for text in (GARMIN, TRACKMAN, FLIGHTSCOPE):
        raw = np.frombuffer(text.encode(), np.uint8)
        for _ in range(150):
            broken = raw.copy()
            places = rng.integers(0, len(raw), rng.integers(1, 12))
            broken[places] = rng.integers(0, 256, len(places))
            path.write_bytes(broken[: rng.integers(1, len(raw) + 1)].tobytes())
            try:
                shots = read_monitor_file(path)
            except TableError as error:
                assert len(str(error).splitlines()) == 1
            else:
                assert np.isfinite([tuple(launch) for launch in shots.launches]).all()
