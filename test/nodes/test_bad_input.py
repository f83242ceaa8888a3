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

"""Inputs that a sim must not follow: they are rejected, logged, and forgotten to the bit."""

import json
from math import inf, nan

from geometry_msgs.msg import PointStamped, Vector3Stamped
from processes import Golfer, parameters, place, READY, wait_until
import pytest

GOOD, GOOD_SPIN = (9.0, 0.7, 6.0), (3.0, -120.0, 11.0)
BAD_SHOTS = {
    'velocity not a number': ((nan, 0.0, 1.0), (0.0, 0.0, 0.0), 'finite'),
    'velocity infinite': ((1.0, -inf, 1.0), (0.0, 0.0, 0.0), 'finite'),
    'spin not a number': ((1.0, 0.0, 1.0), (0.0, nan, 0.0), 'finite'),
    'spin infinite': ((1.0, 0.0, 1.0), (0.0, 0.0, inf), 'finite'),
    'all zero': ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 'zero'),
    'too fast': ((150.1, 0.0, 1.0), (0.0, 0.0, 0.0), '150'),
    'so fast that squares overflow': ((1e200, 0.0, 1e200), (0.0, 0.0, 0.0), '150'),
    'too much spin': ((10.0, 0.0, 1.0), (0.0, -2500.1, 0.0), '2500'),
}
BAD_WINDS = {
    'not a number': ('course', (nan, 0.0, 0.0), 'finite'),
    'infinite': ('', (0.0, inf, 0.0), 'finite'),
    'over 100 m/s': ('course', (80.0, 80.0, 0.0), '100'),
    'of another frame': ('map', (5.0, 5.0, 0.0), "'map'"),
}
BAD_PLACES = {
    'not a number': ('course', (nan, 0.0), 'finite'),
    'infinite': ('', (0.0, inf), 'finite'),
    'of another frame': ('map', (5.0, 5.0), "'map'"),
}


@pytest.fixture(scope='module')
def sim(start):
    """Start the sim that gets bad input."""
    process = start('sim_node', *parameters('/bad', real_time_factor=4.0))
    process.wait_for(READY)
    return process


@pytest.fixture
def golfer(sim, make_golfer):
    """Put a golfer at the tee of the sim that gets bad input."""
    golfer = make_golfer('/bad')
    golfer.reset()
    return golfer


@pytest.fixture(scope='module')
def expected(start):
    """Play the good shot in a sim to which nothing bad ever came."""
    start('sim_node', *parameters('/good', real_time_factor=4.0)).wait_for(READY)
    golfer = Golfer('/good')
    try:
        return bits_of(golfer)
    finally:
        golfer.close()


def bits_of(golfer):
    """All that the good shot gives, but for its number and times of the clock."""
    golfer.heartbeat()
    impacts, shots = len(golfer.collisions), len(golfer.results_of(GOOD, GOOD_SPIN))
    golfer.strike(GOOD, GOOD_SPIN)
    results = wait_until(lambda: golfer.results_of(GOOD, GOOD_SPIN)[shots:], 'the result came')
    golfer.heartbeat()
    return (
        [without(result, 'shot') for result in results],
        place(golfer.poses[-1]),
        [without(impact) for impact in golfer.impacts()[impacts:]],
    )


def without(told, *names):
    return {name: value for name, value in told.items() if name not in ('time', *names)}


def rejections(golfer):
    told = [json.loads(message.data) for message in golfer.results]
    return [result for result in told if result['status'] == 'rejected']


@pytest.mark.parametrize('case', BAD_SHOTS)
def test_a_bad_shot_is_rejected_once_and_the_next_good_one_is_the_same_to_the_bit(
    golfer, expected, sim, case
):
    velocity, spin, reason = BAD_SHOTS[case]
    before = len(rejections(golfer))
    rest = place(golfer.poses[-1])
    golfer.strike(velocity, spin)
    wait_until(lambda: len(rejections(golfer)) > before, 'the rejection came')
    golfer.heartbeat()
    (told,) = rejections(golfer)[before:]
    assert list(told) == ['shot', 'ball', 'status', 'velocity', 'spin', 'reason']
    assert reason in told['reason'] and told['ball'] == 'ball'
    assert place(golfer.poses[-1]) == rest
    assert bits_of(golfer) == expected
    sim.wait_for('shot refused')


def test_a_shot_at_a_moving_ball_is_rejected_and_does_not_disturb_it(golfer, expected):
    before, shots = len(rejections(golfer)), len(golfer.results_of(GOOD, GOOD_SPIN))
    impacts = len(golfer.collisions)
    rest = place(golfer.poses[-1])
    golfer.strike(GOOD, GOOD_SPIN)
    wait_until(lambda: place(golfer.poses[-1]) != rest, 'the ball flew')
    golfer.strike((20.0, 0.0, 1.0))
    results = wait_until(lambda: golfer.results_of(GOOD, GOOD_SPIN)[shots:], 'the result came')
    golfer.heartbeat()
    (told,) = rejections(golfer)[before:]
    assert 'motion' in told['reason'] and told['velocity'] == [20.0, 0.0, 1.0]
    assert told['shot'] == results[0]['shot'] + 1
    assert (
        [without(result, 'shot') for result in results],
        place(golfer.poses[-1]),
        [without(impact) for impact in golfer.impacts()[impacts:]],
    ) == expected


@pytest.mark.parametrize('case', BAD_WINDS)
def test_a_bad_wind_is_ignored_with_a_warning(golfer, expected, sim, case):
    frame, wind, reason = BAD_WINDS[case]
    message = Vector3Stamped()
    message.header.frame_id = frame
    message.vector.x, message.vector.y, message.vector.z = wind
    lines = warnings(sim, 'wind refused', reason)
    publish_until(
        golfer,
        Vector3Stamped,
        'wind',
        message,
        lambda: warnings(sim, 'wind refused', reason) > lines,
    )
    assert bits_of(golfer) == expected


@pytest.mark.parametrize('case', BAD_PLACES)
def test_a_bad_place_is_ignored_with_a_warning(golfer, expected, sim, case):
    frame, (x, y), reason = BAD_PLACES[case]
    message = PointStamped()
    message.header.frame_id = frame
    message.point.x, message.point.y = x, y
    lines = warnings(sim, 'place refused', reason)
    publish_until(
        golfer,
        PointStamped,
        'ball/place',
        message,
        lambda: warnings(sim, 'place refused', reason) > lines,
    )
    golfer.heartbeat()
    assert bits_of(golfer) == expected


def test_a_place_for_a_moving_ball_is_ignored_and_does_not_disturb_it(golfer, expected, sim):
    places = golfer.publisher(PointStamped, 'ball/place')
    lines = warnings(sim, 'place refused', 'motion')
    shots, impacts = len(golfer.results_of(GOOD, GOOD_SPIN)), len(golfer.collisions)
    rest = place(golfer.poses[-1])
    golfer.strike(GOOD, GOOD_SPIN)
    wait_until(lambda: place(golfer.poses[-1]) != rest, 'the ball flew')
    places.publish(PointStamped())
    results = wait_until(lambda: golfer.results_of(GOOD, GOOD_SPIN)[shots:], 'the result came')
    golfer.heartbeat()
    assert warnings(sim, 'place refused', 'motion') == lines + 1
    assert (
        [without(result, 'shot') for result in results],
        place(golfer.poses[-1]),
        [without(impact) for impact in golfer.impacts()[impacts:]],
    ) == expected


def test_a_flood_of_bad_shots_gives_every_one_its_result_and_few_warnings_with_a_count(
    golfer, expected, sim
):
    before, lines = len(rejections(golfer)), warnings(sim, 'shot refused', '')
    for number in range(8):
        for _ in range(10):
            golfer.strike((200.0 + number, 0.0, 0.0))
        wait_until(
            lambda: len(rejections(golfer)) >= before + 10 * (number + 1), 'the rejections came'
        )
    golfer.heartbeat()
    assert len(rejections(golfer)) == before + 80
    assert warnings(sim, 'shot refused', '') - lines < 40
    assert bits_of(golfer) == expected


def warnings(sim, kind, reason):
    """How many lines of the log of `sim` warn of `kind` for this `reason`, with a count."""
    return sum(kind in line and 'so far' in line and reason in line for line in sim.lines)


def publish_until(golfer, kind, topic, message, condition):
    """Publish until `condition()`: a second may have to pass after the last warning."""
    publisher = golfer.publisher(kind, topic)

    def happened():
        publisher.publish(message)
        return condition()

    wait_until(happened, f'{topic} was refused', 20.0)
