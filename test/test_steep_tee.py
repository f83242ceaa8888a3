# SPDX-License-Identifier: Apache-2.0
"""A tee that is too steep for a ball to lie on is told when the course is read."""
from golf_sim_ros.course import load_course
from golf_sim_ros.misplaced import steepest
from golf_sim_ros.physics import Phase, World
import pytest


@pytest.fixture
def hillside(tmp_path):
    """Write a course on one slope, and load it."""
    def write(slope, material):
        path = tmp_path / 'hillside.yaml'
        path.write_text('format: 1\nground:\n'
                        f'  - {{shape: plane, normal: [-{slope}, 0, 1], material: {material}}}\n')
        return load_course(path)
    return write


@pytest.mark.parametrize('material', ['green', 'firm_green', 'tee', 'fairway', 'first_cut', 'rough', 'sand'])
def test_a_tee_is_told_to_be_too_steep_just_where_a_ball_rolls_off(hillside, material):
    most = steepest(hillside(0.0, material).ground[0].material, 0.4)
    for part, lies in ((0.98, True), (1.02, False)):
        course = hillside(part * most, material)
        assert (World(course)['ball'].phase == Phase.REST) == lies
        assert (course.notes == ()) == lies


def test_the_case_of_30_percent_is_told_with_what_holds(hillside):
    note, = hillside(0.3, 'green').notes
    assert note.startswith('tee [0.0, 0.0]: a ball rolls off, on a slope of 30 % of green, '
                           'which holds one up to 7.84 %')
