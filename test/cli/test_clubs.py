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

"""The clubs and their names."""

from math import degrees, pi

from golf_sim_ros.shot_input.clubs import club, CLUBS, TOUR_AVERAGES
import pytest


def test_the_driver_is_the_average_of_the_tour():
    launch = CLUBS['driver'].launch
    assert launch.speed == pytest.approx(74.66, abs=0.005)
    assert degrees(launch.launch) == pytest.approx(10.9)
    assert launch.backspin * 60.0 / (2.0 * pi) == pytest.approx(2686.0)
    assert (launch.azimuth, launch.sidespin) == (0.0, 0.0)
    assert CLUBS['driver'].carry == pytest.approx(251.46)


def test_from_the_longest_club_to_the_shortest_speed_and_carry_fall_and_spin_rises():
    _, speeds, _, spins, carries = (list(column) for column in zip(*TOUR_AVERAGES))
    assert speeds == sorted(speeds, reverse=True)
    assert spins == sorted(spins)
    assert carries == sorted(carries, reverse=True)


@pytest.mark.parametrize(
    'text, name',
    [
        ('driver', 'driver'),
        ('Driver', 'driver'),
        ('7i', '7i'),
        ('7-iron', '7i'),
        ('7 Iron', '7i'),
        ('3w', '3w'),
        ('3-wood', '3w'),
        ('PW', 'pw'),
        ('pitching wedge', 'pw'),
        ('putt', 'putter'),
        ('hybrid', 'hybrid'),
    ],
)
def test_clubs_are_found_as_people_write_them(text, name):
    assert club(text) is CLUBS[name]


@pytest.mark.parametrize('text', ['', '1i', 'i', '77i', 'niblick'])
def test_an_unknown_club_is_refused_with_those_there_are(text):
    with pytest.raises(ValueError, match=f"unknown club '{text}'; known: driver, 3w, .*, putter"):
        club(text)
