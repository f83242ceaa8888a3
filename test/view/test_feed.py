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

"""What browsers are told: little, in order, and bounded where they do not read."""

import asyncio
import json

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import Shot, simulate
from golf_sim_ros.view.course_data import CourseData
from golf_sim_ros.view.feed import Feed, PAST, POSE, QUEUE, TRAIL
import numpy as np
import pytest

DRIVE = Shot((73.3, 2.0, 14.1), (0.0, -281.0, 0.0))
COURSE = CourseData(b'', 'abc', 'Links')


@pytest.fixture
def feed():
    """Make a feed of one ball."""
    made = Feed()
    made.show_course(COURSE, ['ball'])
    return made


def listening(feed):
    """Connect a client that has drawn the course, and for which nothing waits."""
    client = feed.connect()
    feed.catch_up(client)
    client.waiting.clear()
    return client


def fly(feed, play):
    """Tell a feed the poses and impacts of a play, as a sim publishes them."""
    told = [(t, p, False) for t, p in zip(play.times, play.positions)]
    told += [(hit.time, hit.position, True) for hit in play.collisions]
    for time, place, exact in sorted(told, key=lambda one: one[0]):
        feed.pose(0, float(time), tuple(map(float, place)), exact)


def poses(messages):
    """Rows of time, x, y, z of all poses in messages."""
    raw = b''.join(message for message in messages if isinstance(message, bytes))
    return np.array([(1e-4 * row[3], *row[4:]) for row in POSE.iter_unpack(raw)]).reshape(-1, 4)


@pytest.fixture(scope='module')
def drive():
    """Play a drive at 50 poses a second."""
    return simulate(load_course('links'), DRIVE, rate=50.0, engine='python')


def test_a_drive_is_less_than_12_kb_and_has_every_impact(feed, drive):
    client = listening(feed)
    feed.strike(0, 0.0)
    fly(feed, drive)
    feed.result({'ball': 'ball', 'status': 'at_rest', 'shot': 1})
    size = sum(len(message) + 4 for message in client.waiting)
    assert 2_000 < size < 12_000
    rows = poses(client.waiting)
    for hit in drive.collisions:
        assert np.abs(rows - (hit.time, *hit.position)).max(1).min() < 1e-4
    np.testing.assert_allclose(rows[-1, 1:], drive.positions[-1], atol=1e-4)


def test_between_poses_that_are_sent_the_path_is_nearly_straight(feed, drive):
    client = listening(feed)
    fly(feed, drive)
    rows = poses(client.waiting)
    for axis in range(3):
        between = np.interp(drive.times, rows[:, 0], rows[:, 1 + axis])
        assert np.abs(between - drive.positions[:, axis]).max() < 0.02


def test_a_ball_at_rest_says_nothing(feed):
    client = listening(feed)
    for second in range(100):
        feed.pose(0, float(second), (1.0, 2.0, 3.0))
    assert len(poses(client.waiting)) == 1


def test_gusts_are_told_once_a_second_at_most(feed):
    client = listening(feed)
    for step in range(100):
        feed.blow((0.1 * step, 0.0, 0.0), 0.1 * step)
    assert len(client.waiting) <= 11


def test_a_browser_that_does_not_read_is_dropped(feed):
    client = listening(feed)
    for step in range(10 * QUEUE):
        feed.pose(0, 0.1 * step, (float(step), 0.0, 0.0))
        assert len(client.waiting) <= QUEUE
    assert client.closed and not client.waiting
    assert asyncio.run(client.take()) is None


def test_poses_that_wait_go_in_one_message(feed):
    client = listening(feed)
    for step in range(10):
        feed.pose(0, 0.1 * step, (float(step), 0.0, 0.0))
    feed.say(True, 'paused')
    assert len(asyncio.run(client.take())) == 10 * POSE.size
    assert json.loads(asyncio.run(client.take()))['text'] == 'paused'


def test_who_joins_late_gets_the_course_first_then_the_trail_and_the_result(feed, drive):
    feed.strike(0, 0.0)
    fly(feed, drive)
    feed.result({'ball': 'ball', 'status': 'at_rest', 'shot': 1})
    client = feed.connect()
    first = [json.loads(message)['kind'] for message in client.waiting]
    assert first == ['status', 'course']
    client.waiting.clear()
    feed.pose(0, 99.0, (0.0, 0.0, 0.0))
    assert not client.waiting  # it has no course to show a ball on
    feed.catch_up(client)
    past = [row for message in client.waiting for row in rows_of(message)]
    assert all(row[1] == PAST for row in past) and 50 < len(past) <= TRAIL + 2
    assert json.loads(client.waiting[-1])['kind'] == 'result'


def rows_of(message):
    """Rows of the poses in a message."""
    return POSE.iter_unpack(message) if isinstance(message, bytes) else []


def test_another_course_is_told_to_everybody(feed):
    clients = [listening(feed), listening(feed)]
    feed.show_course(CourseData(b'', 'other', 'Other'), ['ball'])
    for client in clients:
        assert json.loads(client.waiting[-1])['url'] == '/course/other.bin'
        assert not client.ready


def test_time_of_many_days_fits(feed):
    client = listening(feed)
    feed.pose(0, 1e6, (1.0, 2.0, 3.0))
    assert len(poses(client.waiting)) == 1
