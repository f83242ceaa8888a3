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

"""The panel of the page, by NiceGUI's own means: no browser, no sim."""

import asyncio

from golf_sim_ros.course import load_course
import pytest

pytest.importorskip('nicegui')

from golf_sim_ros.view import caddie, page  # noqa: E402, I100
from golf_sim_ros.view.course_data import CourseData  # noqa: E402
from golf_sim_ros.view.game import Line  # noqa: E402
from golf_sim_ros.view.session import Session  # noqa: E402
from nicegui import ui  # noqa: E402
from nicegui.testing.general_fixtures import nicegui_reset_globals  # noqa: E402, F401
from nicegui.testing.user_simulation import user_simulation  # noqa: E402

LINKS = load_course('links')
RESULT = {
    'shot': 1,
    'ball': 'ball',
    'status': 'at_rest',
    'carry': 250.0,
    'total': 280.0,
    'to_hole': 66.0,
    'lie': 'fairway',
    'penalty': 0,
    'stroke': 1,
    'velocity': [70.0, 0.0, 14.0],
    'spin': [0.0, -280.0, 0.0],
}


class Worker:
    """Answers at once, and keeps what it was asked."""

    def __init__(self):
        self.asked = []

    async def ask(self, question, lie, **given):
        self.asked.append((question, given))
        return None


class Play:
    """A session in which a ball waits on the tee of links, and a page of it."""

    def __init__(self, goes_on=None):
        self.session, self.worker, self.strikes = Session(is_game=True), Worker(), []
        self.session.on_begin(LINKS, CourseData(b'', 'abc', 'Links'), ['ball'])
        self.session.on_reach(True, False, True)
        self.session.on_pose(0, 0.0, (0.0, 0.0, 0.02), False)
        self.goes_on, self.page = goes_on, None

    def build(self):
        self.page = page.PlayPage(
            self.session,
            self.worker,
            lambda *strike: self.strikes.append(strike),
            self.goes_on,
            'si',
        )


def looked_at(play, look):
    """Run `look(user)` at a page of `play`."""

    async def run():
        async with user_simulation(root=play.build) as user:
            await user.open('/')
            await look(user)

    asyncio.run(run())


@pytest.fixture(autouse=True)
def fresh(nicegui_reset_globals):  # noqa: F811
    """Make NiceGUI as new, whatever ran before."""


def test_one_click_is_one_strike_and_the_button_waits_for_the_result():
    play = Play()

    async def look(user):
        user.find('Strike').click()
        user.find('Strike').click()
        assert len(play.strikes) == 1 and not play.page.button.enabled
        play.session.on_strike('ball', 1.0, 1)
        user.find('Strike').click()
        assert len(play.strikes) == 1
        play.session.on_pose(0, 9.0, (280.0, 3.0, 0.02), False)
        play.session.on_result(RESULT)
        assert play.page.button.enabled
        user.find('Strike').click()
        assert len(play.strikes) == 2

    looked_at(play, look)


def test_the_strike_is_what_the_panel_says():
    play = Play()

    async def look(user):
        play.page.club.value = '7i'
        play.page.power.value, play.page.aim.value, play.page.curve.value = 80, -2.0, 50
        user.find('Strike').click()
        wanted = caddie.Stroke('7i', 0.8, -2.0, 0.5)
        assert play.strikes == [caddie.launch(LINKS.hole, (0.0, 0.0), wanted)]

    looked_at(play, look)


def test_a_sim_that_is_gone_for_good_leaves_a_button_that_works_with_the_next_one():
    play = Play()

    async def look(user):
        user.find('Strike').click()
        play.session.on_strike('ball', 1.0, 1)
        play.session.on_reach(False, False, False)
        assert not play.page.button.enabled
        play.session.on_begin(LINKS, CourseData(b'', 'abc', 'Links'), ['ball'])
        play.session.on_reach(True, False, True)
        play.session.on_pose(0, 0.0, (0.0, 0.0, 0.02), False)
        assert play.page.button.enabled

    looked_at(play, look)


def test_on_the_green_it_is_the_putter_and_a_speed():
    play = Play()

    async def look(user):
        play.session.on_pose(0, 9.0, (340.0, 9.0, 0.02), False)
        play.session.notify()
        assert play.page.club.value == 'putter'
        await user.should_see('m/s')
        assert not play.page.curve.enabled

    looked_at(play, look)


def test_hints_can_be_switched_off():
    play = Play()

    async def look(user):
        await asyncio.sleep(2 * page.PATIENCE)
        assert play.worker.asked
        play.page.hints.value = False
        await asyncio.sleep(2 * page.PATIENCE)
        play.worker.asked.clear()
        play.page.power.value = 50
        await asyncio.sleep(2 * page.PATIENCE)
        assert not play.worker.asked

    looked_at(play, look)


def test_while_the_worker_is_busy_only_the_latest_question_waits():
    play = Play()

    async def look(user):
        await asyncio.sleep(2 * page.PATIENCE)
        free = asyncio.Event()
        answer_at_once = play.worker.ask

        async def answer_later(question, lie, **given):
            play.worker.asked.append((question, given))
            await free.wait()

        play.worker.asked.clear()
        play.worker.ask = answer_later
        for aim in (1.0, 2.0, 3.0, 4.0):
            play.page.aim.value = aim
            await asyncio.sleep(2 * page.PATIENCE)
        play.worker.ask = answer_at_once
        free.set()
        await asyncio.sleep(2 * page.PATIENCE)
        assert [given['stroke']['aim'] for _, given in play.worker.asked] == [1.0, 4.0]

    looked_at(play, look)


def test_the_card_opens_at_the_end_and_goes_on():
    went_on = []

    async def go_on():
        went_on.append(True)

    play = Play(go_on)

    async def look(user):
        play.session.on_strike('ball', 1.0, 1)
        play.session.on_result({**RESULT, 'status': 'holed', 'to_hole': 0.0})
        await user.should_see('Links, par 4: 1, hole in one')
        assert not play.page.button.enabled
        user.find('Play on').click()
        await asyncio.sleep(0.1)
        assert went_on
        play.session.on_reset()  # another browser has gone on
        await play.page.on_go_on()
        assert len(went_on) == 1

    looked_at(play, look)


def test_a_reset_begins_the_hole_anew():
    play = Play()

    async def look(user):
        play.session.on_strike('ball', 1.0, 1)
        play.session.on_result({**RESULT, 'status': 'holed', 'to_hole': 0.0})
        assert play.session.is_over
        play.session.on_reset()
        assert not play.page.button.enabled
        play.session.on_pose(0, 9.0, (0.0, 0.0, 0.02), False)
        assert play.page.button.enabled
        assert [hole.strokes for hole in play.session.round.holes] == [0]

    looked_at(play, look)


def test_a_reset_that_is_told_after_a_newer_result_changes_nothing():
    session = Play().session
    session.on_strike('ball', 1.0, 1)
    session.on_result({**RESULT, 'shot': 2})
    session.on_reset()
    assert session.places and session.round.hole.strokes == 1


def test_a_sim_of_ones_own_that_has_ended_is_told_for_good():
    session = Play().session
    session.on_ending('sim_node has ended by itself, with code -9')
    session.on_reach(False, False, True)
    assert session.feed.status['text'].startswith('sim_node has ended by itself, with code -9')


@pytest.mark.parametrize(
    'units, meters, told',
    [
        ('golf', 0.0, '0.0 ft'),
        ('golf', 2.07, '6.8 ft'),
        ('golf', 10.3, '34 ft'),
        ('golf', 67.9, '74 yd'),
        ('si', 2.07, '2.1 m'),
        ('si', 67.9, '68 m'),
    ],
)
def test_distances_are_told_as_players_do(units, meters, told):
    assert page.distance(meters, units) == told


def test_a_putt_has_no_carry_on_the_card_and_a_holed_ball_no_way_to_go():
    putt = {**RESULT, 'status': 'holed', 'carry': 2.06, 'total': 2.06, 'apex': 0.0, 'to_hole': 0.0}
    chip = {**RESULT, 'carry': 8.0, 'total': 12.0, 'apex': 1.4, 'to_hole': 0.9}
    rows = page.card_rows([Line(1, 'pw', chip, 0), Line(2, 'putter', putt, 0)], 'golf')
    assert [row['carry'] for row in rows] == ['26 ft', '']
    assert [row['to_hole'] for row in rows] == ['3.0 ft', '']
    assert rows[1]['end'] == 'in the hole'


def test_u_changes_the_units_of_the_panel():
    play = Play()

    async def look(user):
        assert 'carries 251 m' in play.page.club.options['driver']
        play.page.toggle_units()
        assert 'carries 275 yd' in play.page.club.options['driver']
        play.page.club.value = 'putter'
        await user.should_see('mph')

    looked_at(play, look)


def test_a_page_that_only_watches_has_nothing_to_press():
    async def look(user):
        await user.should_not_see(ui.button)
        await user.should_not_see(ui.slider)
        await user.should_see(page.GolfScene)

    async def run():
        async with user_simulation(root=lambda: page.watch_page('golf')) as user:
            await user.open('/')
            await look(user)

    asyncio.run(run())


def test_the_library_that_draws_exports_what_the_picture_imports():
    from golf_sim_ros.view.one_file import three

    exported = three().read_text(encoding='utf-8').rpartition('export{')[2]
    assert ' THREE' in exported or 'as THREE' in exported
    assert 'OrbitControls' in exported
