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

"""A recorded play as bytes for the page, and as one file."""

import json
import struct

from golf_sim_ros.course import load_course
from golf_sim_ros.drawing import drawn
from golf_sim_ros.physics import Shot, simulate
from golf_sim_ros.view.course_data import pack
from golf_sim_ros.view.play_data import play_data
import numpy as np
import pytest

COURSE = load_course('golf_without_friends')
DRIVE, CHIP = Shot((73.3, 2.0, 14.1), (0.0, -281.0, 0.0)), Shot((9.0, 0.5, 6.0))


@pytest.fixture(scope='module')
def shots():
    """Draw a drive, and later a chip from the tee."""
    first = drawn(
        simulate(COURSE, DRIVE, (3.0, 0.0, 0.0), rate=50.0, engine='python'), (3.0, 0.0, 0.0)
    )
    second = drawn(simulate(COURSE, CHIP, rate=50.0, engine='python'))
    later = second._replace(
        times=second.times + 60.0,
        collisions=tuple(hit._replace(time=hit.time + 60.0) for hit in second.collisions),
        wind=second.wind + [60.0, 0.0, 0.0, 0.0],
    )
    return [first, later]


def unpacked(raw):
    """JSON, and rows of the one ball, as `js/recorded.js` reads them."""
    assert raw[:4] == b'PLAY'
    (length,) = struct.unpack('<I', raw[4:8])
    about = json.loads(raw[8:][:length])
    return about, np.frombuffer(raw, '<f4', offset=8 + length).reshape(-1, 4)


def test_rows_are_the_paths_and_the_impacts_in_order_of_time(shots):
    about, rows = unpacked(play_data(shots))
    assert about['balls'] == [{'name': 'ball', 'count': len(rows)}]
    assert (np.diff(rows[:, 0]) >= 0.0).all()
    for shot in shots:
        wanted = np.column_stack([shot.times, shot.positions]).astype('f4')
        assert set(map(tuple, wanted)) <= set(map(tuple, rows))
        for hit in shot.collisions:
            place = np.array((hit.time, *hit.position), 'f4')
            assert np.abs(rows - place).max(1).min() == 0.0


def test_a_ball_that_was_dropped_lies_there_before_it_is_struck(shots):
    _, rows = unpacked(play_data(shots))
    start = shots[1].times[0]
    before = rows[(rows[:, 0] > start - 1.1) & (rows[:, 0] <= start)]
    assert (before[:, 1:] == shots[1].positions[0].astype('f4')).all()


def test_results_and_wind_are_told(shots):
    about, _ = unpacked(play_data(shots))
    assert [shot['result']['status'] for shot in about['shots']] == ['at_rest', 'at_rest']
    assert about['shots'][0]['result']['carry'] == pytest.approx(shots[0].result.carry, abs=1e-4)
    assert [row[1:] for row in about['wind']] == [[3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]


def test_one_file_names_nothing_outside_of_it(shots):
    pytest.importorskip('nicegui')
    from golf_sim_ros.view.one_file import one_file

    html = one_file(pack(COURSE), play_data(shots), 'A <play>', 'golf')
    assert len(html) < 1_500_000
    assert 'http://' not in html and 'https://' not in html and 'src=' not in html
    assert '<title>A &lt;play&gt;</title>' in html and '@' not in html.partition('files = ')[0]
