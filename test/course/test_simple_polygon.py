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

"""Polygons that cross or touch themselves are found, no others: as comparing all sides does."""

from math import cos, pi, sin

from golf_sim_ros.course.simple_polygon import crossing, meet
from hypothesis import example, given, settings
from hypothesis import strategies as st
import pytest

SMALL = st.integers(-4, 4)
COORDINATE = st.floats(-10, 10).map(lambda value: round(value, 6))
POINTS = st.lists(st.tuples(SMALL, SMALL), min_size=3, max_size=12)


def compared(corners):
    """Whether some two sides meet, by comparing all."""
    return any(meet(i, j, corners) for i in range(len(corners)) for j in range(i))


def star(n, spike=None):
    """Make a polygon of `n` corners, with that of number `spike` pulled through the other side."""
    corners = [
        ((10 + k % 2) * cos(2 * pi * k / n), (10 + k % 2) * sin(2 * pi * k / n)) for k in range(n)
    ]
    if spike is not None:
        x, y = corners[spike]
        corners[spike] = (-1.5 * x, -1.5 * y)
    return tuple(corners)


def comb(n):
    """Make a comb with teeth along x: every side is beside every other."""
    teeth = tuple((100.0 * (k % 4 in (1, 2)), float(k // 2)) for k in range(2 * n))
    return (*teeth, (-1.0, float(n)), (-1.0, 0.0))


@settings(deadline=None, max_examples=1500)
@given(POINTS)
@example([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)])
@example([(0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)])
@example([(0, 0), (0, 4), (0, 2), (3, 3)])
def test_the_sweep_finds_what_comparing_all_sides_finds(corners):
    corners = tuple(
        (float(x), float(y))
        for (x, y), after in zip(corners, corners[1:] + corners[:1])
        if (x, y) != after
    )
    if len(corners) >= 3:
        found = crossing(corners)
        assert (found is not None) == compared(corners)
        if found and corners[found[0]] != corners[found[1]]:
            assert meet(*found, corners)


@settings(deadline=None, max_examples=300)
@given(st.lists(st.tuples(COORDINATE, COORDINATE), min_size=3, max_size=30, unique=True))
def test_it_does_so_with_corners_anywhere(corners):
    assert (crossing(tuple(corners)) is not None) == compared(tuple(corners))


@pytest.mark.parametrize('n', [50, 51, 300])
def test_a_star_is_simple_until_a_corner_is_pulled_through_it(n):
    assert crossing(star(n)) is None and crossing(star(n)[::-1]) is None
    for spike in range(0, n, 7):
        assert crossing(star(n, spike)) is not None


def test_a_comb_is_simple():
    assert crossing(comb(40)) is None and crossing(tuple((y, x) for x, y in comb(40))) is None


def calls(corners, monkeypatch):
    """How often the turn of three points is asked for."""
    from golf_sim_ros.course import simple_polygon

    count, turn = [0], simple_polygon.turn

    def counted(a, b, c):
        count[0] += 1
        return turn(a, b, c)

    with monkeypatch.context() as patch:
        patch.setattr(simple_polygon, 'turn', counted)
        assert crossing(corners) is None
    return count[0]


@pytest.mark.parametrize('shape', [star, comb])
def test_the_work_grows_no_faster_than_n_log_n(shape, monkeypatch):
    few, many = calls(shape(500), monkeypatch), calls(shape(4000), monkeypatch)
    assert many < 8 * 1.7 * few
