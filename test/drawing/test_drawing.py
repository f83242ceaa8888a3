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

"""Pictures show what was played."""

import math

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import (
    Course,
    ground_height,
    Material,
    Patch,
    Plane,
    Shot,
    simulate,
    Water,
)
from golf_sim_ros.physics.scene import kernel_model
import numpy as np
import pytest

pytest.importorskip('matplotlib')
from golf_sim_ros import drawing  # noqa: E402, I100
from golf_sim_ros.drawing import window  # noqa: E402
from golf_sim_ros.drawing.shots import detailed  # noqa: E402
from matplotlib.colors import to_rgb  # noqa: E402
from matplotlib.image import imread  # noqa: E402

COURSE = load_course('golf_without_friends')
DRIVE = Shot((73.3, 2.0, 14.1), (0.0, -281.0, -20.0))
PUTT = Shot((2.4, -0.3, 0.0))
GUSTS = np.array([(0.0, 3.0, 2.0, 0.0), (2.0, 0.0, -5.0, 0.0)])
RED, BLUE = (0.9, 0.1, 0.1), (0.1, 0.1, 0.9)


def shot(strike=DRIVE, number=1, course=COURSE, wind=(0.0, 0.0, 0.0)):
    """Simulate a shot, to be drawn."""
    told = drawing.drawn(simulate(course, strike, wind), wind)
    return told._replace(result=told.result._replace(shot=number))


@pytest.fixture(scope='module')
def drive():
    return shot(wind=GUSTS)


@pytest.fixture(scope='module')
def putt():
    return shot(PUTT, 2, COURSE._replace(tee=(334.0, 8.0)))


@pytest.fixture(scope='module')
def eighteen():
    return [
        shot(Shot((66.0 + i, 0.3 * i - 2.0, 14.0), (0.0, -280.0, 0.0)), i) for i in range(1, 19)
    ]


@pytest.fixture(scope='module')
def picture_of_a_drive(drive):
    return drawing.picture([drive], COURSE)


@pytest.fixture(scope='module')
def picture_of_two(drive, putt):
    return drawing.picture([drive, putt], COURSE)


@pytest.fixture(scope='module')
def picture_of_eighteen(eighteen):
    return drawing.picture(eighteen, COURSE)


def axes(figure, label):
    """Find the part of a picture called `label`."""
    return next(part for part in figure.axes if part.get_label() == label)


def path(figure, label, number):
    """Points of the line of shot `number` in a part of a picture."""
    lines = axes(figure, label).lines
    return next(line.get_xydata() for line in lines if line.get_label() == f'shot {number}')


def texts(figure, label):
    """All that is written in a part of a picture."""
    return [text.get_text() for text in axes(figure, label).texts]


def test_paths_begin_at_the_strike_and_end_where_the_ball_rests(drive, putt, picture_of_two):
    for told in (drive, putt):
        x, y, z = told.result.position
        above, side = (path(picture_of_two, part, told.result.shot) for part in ('above', 'side'))
        assert above[-1] == pytest.approx((x, y)) and side[-1] == pytest.approx((x, z))
        assert above[0] == pytest.approx(told.positions[0, :2])


def test_charts_show_speed_height_and_spin_from_the_strike_to_the_end(drive, picture_of_a_drive):
    speed, height, spin = (
        path(picture_of_a_drive, label, 1) for label in ('speed', 'height', 'spin')
    )
    assert speed[0] == pytest.approx((0.0, math.hypot(*DRIVE.velocity)))
    assert speed[-1] == pytest.approx((drive.result.duration, 0.0), abs=1e-9)
    assert height[:, 1].max() == pytest.approx(drive.result.apex, abs=0.01)
    assert spin[0] == pytest.approx((0.0, math.hypot(*DRIVE.spin)))


def test_every_bounce_is_marked_where_it_was(drive, picture_of_a_drive):
    marked = [
        line.get_xydata()
        for line in axes(picture_of_a_drive, 'above').lines
        if line.get_marker() == 'o' and len(line.get_xdata()) == len(drive.collisions)
    ]
    assert len(drive.collisions) > 3
    np.testing.assert_allclose(marked[0], [hit.position[:2] for hit in drive.collisions])


def test_a_path_touches_the_ground_in_a_bounce_and_its_speed_breaks_there(drive):
    hit = drive.collisions[0]
    fine = detailed(drive)
    before, after = np.flatnonzero(fine.times == hit.time)
    assert tuple(fine.positions[before]) == tuple(fine.positions[after]) == hit.position
    assert tuple(fine.velocities[before]) == hit.velocity_before
    assert tuple(fine.velocities[after]) == hit.velocity_after
    assert (np.diff(fine.times) >= 0.0).all()


def test_all_that_was_played_lies_inside_the_views(eighteen, picture_of_eighteen):
    for label, rows in (('above', (0, 1)), ('side', (0, 2))):
        part = axes(picture_of_eighteen, label)
        (left, right), (low, high) = part.get_xlim(), part.get_ylim()
        for told in eighteen:
            x, y = told.positions[:, rows].T
            assert left < x.min() and x.max() < right and low < y.min() and y.max() < high


@pytest.mark.parametrize(
    'strike',
    [DRIVE, PUTT, Shot((1.0, 30.0, 20.0)), Shot((0.0, 0.0, 5.0))],
    ids=['drive', 'putt', 'to the left', 'straight up'],
)
def test_from_above_a_metre_is_as_long_along_as_across(strike):
    figure = drawing.picture([shot(strike)], COURSE)
    part = axes(figure, 'above')
    box = part.get_position()
    wide, high = figure.get_size_inches() * (box.width, box.height)
    assert np.ptp(part.get_xlim()) / wide == pytest.approx(np.ptp(part.get_ylim()) / high)
    assert 1.0 < high < 6.0


def test_the_ground_has_the_colours_of_its_materials():
    red, blue = Material('red', color=RED), Material('blue', color=BLUE, rolling_resistance=0.1)
    course = Course(
        (
            Plane(material=blue, cut=(((4.0, -1.0), (6.0, -1.0), (6.0, 1.0), (4.0, 1.0)),)),
            Patch((5.0, 0.0, -0.5), length=6.0, width=6.0, material=red),
            Patch((1.0, 0.0, 0.0), length=1.0, width=0.5, material=red),
        )
    )
    part = axes(drawing.picture([shot(Shot((4.0, 0.0, 0.0)), 1, course)], course), 'above')
    pixels, (left, right, low, high) = part.images[0].get_array(), part.images[0].get_extent()

    def color(x, y):
        row = int((y - low) / (high - low) * pixels.shape[0])
        return pixels[row, int((x - left) / (right - left) * pixels.shape[1])]

    for x, y, expected in (
        (2.0, 0.4, BLUE),
        (5.0, 0.5, RED),
        (5.0, -0.5, RED),
        (3.5, 0.2, BLUE),
        (1.2, 0.1, RED),
    ):
        np.testing.assert_allclose(color(x, y), expected, err_msg=f'{x}, {y}')


def test_the_ground_under_the_side_view_is_the_courses(drive):
    places = np.linspace(10.0, 300.0, 30)
    heights, numbers = drawing.relief.relief(COURSE, places, 3.0)
    for x, z, number in zip(places, heights, numbers):
        assert (z, kernel_model.material_names(COURSE)[number]) == ground_height(COURSE, x, 3.0)


def test_a_grid_is_the_same_material_by_material_though_it_is_looked_at_here_and_there():
    x, y = np.arange(150.0, 260.0, 0.5), np.arange(-30.0, 30.0, 0.5)
    told = drawing.relief.relief(COURSE, x, y[:, np.newaxis])
    heights, numbers = drawing.relief.grid_relief(COURSE, x, y)
    assert len(set(numbers.flat)) == 3 and (numbers == told[1]).all()
    np.testing.assert_allclose(heights, told[0], rtol=0, atol=0.05)


def test_where_there_is_no_ground_none_is_drawn():
    course = Course((Patch((0.0, 0.0, 0.0), length=2.0, width=2.0, material=Material('mat')),))
    heights, numbers = drawing.relief.relief(course, [0.0, 5.0], [0.0, 0.0])
    assert list(numbers) == [0, -1] and heights[0] == 0.0 and np.isnan(heights[1])


def test_the_table_has_a_row_for_every_shot_and_none_of_a_flight_for_a_putt(
    drive, putt, picture_of_two
):
    written = texts(picture_of_two, 'table')
    assert f'{drive.result.carry:.2f}' in written
    assert f'{drive.result.total:.2f}' in written and f'{putt.result.total:.2f}' in written
    assert written.count('–') == 4
    assert 'ball' not in written and 'to hole' in written


def test_shots_of_two_balls_are_told_apart(drive, putt):
    other = putt._replace(result=putt.result._replace(ball='red'))
    written = texts(drawing.picture([drive, other], COURSE), 'table')
    assert 'ball' in written and 'red' in written


def test_eighteen_shots_have_eighteen_colours_and_numbers_that_do_not_overlap(picture_of_eighteen):
    figure = picture_of_eighteen
    lines = [
        line for line in axes(figure, 'above').lines if str(line.get_label()).startswith('shot ')
    ]
    assert len({to_rgb(line.get_color()) for line in lines}) == 18
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in axes(figure, 'above').texts]
    assert len(boxes) > 3
    assert not any(
        one.shrunk(0.8, 0.8).overlaps(other.shrunk(0.8, 0.8))
        for i, one in enumerate(boxes)
        for other in boxes[:i]
    )


def test_cells_of_the_table_do_not_overlap(picture_of_eighteen):
    picture_of_eighteen.draw_without_rendering()
    written = axes(picture_of_eighteen, 'table').texts
    boxes = [text.get_window_extent() for text in written if text.get_text()]
    assert not any(one.overlaps(other) for i, one in enumerate(boxes) for other in boxes[:i])


def test_the_wind_is_told_in_words_and_as_arrows(picture_of_a_drive):
    assert 'wind 3.6 to 5.0 m/s' in ' '.join(texts(picture_of_a_drive, 'wind'))
    still = drawing.picture([shot(PUTT)], COURSE)
    assert texts(still, 'wind') == ['calm']


def test_only_gusts_that_blew_during_the_shot_are_told(putt):
    late = putt._replace(
        wind=np.array([(0.0, 1.0, 0.0, 0.0), (1.0, 0.0, 2.0, 0.0), (100.0, 50.0, 0.0, 0.0)])
    )
    assert drawing.wind.speeds([late]) == (1.0, 2.0)
    assert drawing.wind.speeds([late._replace(times=late.times + 2.0)]) == (2.0, 2.0)


def test_ends_near_the_hole_are_drawn_once_more(putt, picture_of_two):
    part = axes(picture_of_two, 'hole')
    assert np.ptp(part.get_xlim()) == pytest.approx(np.ptp(part.get_ylim()))
    x, y, _ = putt.result.position
    assert (
        part.get_xlim()[0] < x < part.get_xlim()[1] and part.get_ylim()[0] < y < part.get_ylim()[1]
    )


def test_a_hole_far_away_is_neither_in_view_nor_drawn_once_more():
    chip = shot(Shot((8.0, 0.0, 6.0)))
    seen = window.window([chip], COURSE)
    assert seen.right < 100.0
    assert window.near_hole([chip], COURSE, seen) is None


def test_without_a_course_paths_are_drawn(drive):
    figure = drawing.picture([drive])
    assert path(figure, 'above', 1)[-1] == pytest.approx(drive.result.position[:2])
    assert not axes(figure, 'above').images


def test_a_course_without_hole_and_with_bounds_can_be_drawn(drive):
    course = COURSE._replace(
        hole=None, bounds=((-5.0, -30.0), (350.0, -30.0), (350.0, 30.0), (-5.0, 30.0))
    )
    lost = drive._replace(result=drive.result._replace(to_hole=None))
    assert 'to hole' not in texts(drawing.picture([lost], course), 'table')


def test_no_shots_are_refused():
    with pytest.raises(ValueError, match='no shot'):
        drawing.picture([], COURSE)


@pytest.mark.parametrize('dpi', [50, 100])
def test_a_png_has_the_size_asked_for(tmp_path, drive, dpi):
    drawing.draw(tmp_path / 'play.png', [drive], COURSE, dpi=dpi)
    high, wide, _ = imread(tmp_path / 'play.png').shape
    assert wide == 12 * dpi and 6 * dpi < high < 14 * dpi


def test_water_is_blue_where_it_covers_the_ground_and_no_farther():
    pond = Water(((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)), -0.2)
    course = Course((Plane(),), water=(pond,))
    heights = np.array([[-1.0, -0.1, -1.0]])
    colors = drawing.ground.flooded(
        np.full((1, 3, 3), 0.5), course, heights, np.array([0.5, 1.5, 2.5]), np.array([[1.0]])
    )
    assert colors[0, 0, 2] > colors[0, 0, 0] and (colors[0, 1:] == 0.5).all()
