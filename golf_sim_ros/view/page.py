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

"""The page: the picture, and where one may play the panel to strike from and the score card."""

import asyncio
from collections.abc import Callable
from math import hypot
from typing import Any

from nicegui import background_tasks, events, ui
from nicegui.element import Element
from nicegui.elements import scene

from . import caddie
from .caddie import Stroke
from .game import Line
from .session import Lie, Session
from .worker import Worker
from ..shot_input.clubs import CLUBS, PUTTER
from ..shot_input.units import UNITS

THREE = scene.Scene  # its import registers the library that draws, which our component imports
PATIENCE = 0.15  # s without a change after which a prediction is asked for
MOST_PUTT = 9.0  # m/s
SHORT, SHORTER = 25.0, 3.0  # m below which distances are told in feet, and to a tenth
LEAST_APEX = 0.1  # m that a ball rises at least if it flew: a putt that drops in has a carry, too
STYLE = """
.nicegui-content{padding:0}
.strike{position:absolute;right:16px;bottom:16px;width:252px;z-index:3;gap:0;
  padding:10px 14px 12px;color:#fff;background:linear-gradient(#0d2015e0,#0a180fe0);
  border:1px solid #ffffff24;border-radius:9px;box-shadow:0 3px 14px #00000038;font-size:13px}
.strike .q-slider{height:22px}
.strike .told{display:flex;justify-content:space-between;width:100%;margin-top:3px}
.strike .told b{font-weight:640;font-variant-numeric:tabular-nums}
.strike .foot{display:flex;gap:8px;width:100%;margin-top:8px;align-items:stretch}
.strike .q-toggle{font-size:26px}
.strike .aside{opacity:.85;font-size:12px;min-height:18px;width:100%}
.strike .aside.old{opacity:.35}
.card-table{width:100%}
"""


# Keys go to what has the focus. What the mouse has pressed lets go of it: arrows aim again.
FREE_KEYS = """
addEventListener("pointerup", () => setTimeout(() => {
  const at = document.activeElement;
  if (at?.closest(".strike") && at.tagName !== "INPUT") at.blur();
}));
"""

# Quasar places a list within 0.35 s, but fills it in the next frame: too late where that is slow.
PLACE_LIST = """() => {
  const place = () => getElement(%d).$refs.qRef.updateMenuPosition();
  requestAnimationFrame(() => requestAnimationFrame(place));
}"""


class GolfScene(Element, component='golf_scene.js', esm={'golf-view': 'js'}):  # type: ignore
    """The picture: of a live play (`feed`), or of a recorded one on a course."""

    def __init__(self, **given: str) -> None:
        super().__init__()
        for name, value in given.items():
            self._props[name] = value
        self.style('position:absolute;inset:0')


def dress(title: str) -> None:
    """Give the page its looks."""
    ui.page_title(title)
    ui.add_css(STYLE)
    ui.query('body').style('margin:0;overflow:hidden;background:#bcd3e2')


def watch_page(units: str) -> None:
    """Build a page that shows a live play."""
    dress('golf_sim_ros')
    GolfScene(feed='/feed', units=units)


def replay_page(course_url: str, play_url: str, title: str, units: str) -> None:
    """Build a page that shows a recorded play."""
    dress(title)
    GolfScene(course=course_url, play=play_url, units=units)


class PlayPage:
    """A page that shows a live play and strikes its ball.

    Parameters
    ----------
    session : Session
    worker : Worker
    strike : callable
        Strikes with a velocity and a spin.
    go_on : callable or None
        Begins the next hole, or the same one anew, once this one is holed.
    units : str
        'golf' or 'si'.
    """

    def __init__(
        self,
        session: Session,
        worker: Worker,
        strike: Callable[..., Any],
        go_on: Callable[..., Any] | None,
        units: str,
    ) -> None:
        self.session, self.worker, self.hit, self.go_on = session, worker, strike, go_on
        self.units, self.asked, self.told_end = units, 0, False
        self.predicting = asyncio.Lock()
        self.shown: Lie | None = None  # what the hints are of
        self.could: bool | None = None
        dress('golf_sim_ros: play')
        self.scene = GolfScene(feed='/feed', units=units)
        self.panel()
        self.card_dialog()
        ui.add_body_html(f'<script>{FREE_KEYS}</script>')
        ui.keyboard(on_key=self.on_key)
        self.client = ui.context.client
        self.client.on_delete(session.listen(self.update))
        self.scene.on('ready', self.on_ready)
        self.update()

    def on_ready(self) -> None:
        """Show what belongs to the ball's place, in a picture that is new."""
        self.shown = None
        self.update()

    def panel(self) -> None:
        """Build the panel: club, power, aim, curve, and the button."""
        names = {name: club_label(name, self.units) for name in CLUBS}
        with ui.column().classes('strike'):
            self.club = ui.select(names, value='driver', on_change=self.on_club)
            self.club.on('popup-hide', js_handler='() => document.activeElement?.blur()')
            self.club.on('popup-show', js_handler=PLACE_LIST % self.club.id)
            self.club.props('dark dense options-dense borderless').style('width:100%')
            self.power = self.slider('Power', 8, 110, 100, 1, self.power_text)
            self.aim = self.slider('Aim', -40, 40, 0, 0.2, self.aim_text)
            self.curve = self.slider('Curve', -100, 100, 0, 5, self.curve_text)
            self.aside = ui.label().classes('aside')
            with ui.element('div').classes('foot'):
                self.button = ui.button('Strike', on_click=self.strike, color='green-8')
                self.button.props('no-caps unelevated').style('flex:1')
                self.hints = ui.switch(value=True, on_change=self.on_change)
                self.hints.props('dark dense color=green-6').tooltip('Where it would go')
                card = ui.button(icon='list', on_click=self.show_card, color='blue-grey-9')
                card.props('dense unelevated').tooltip('Score card')

    def slider(
        self,
        name: str,
        low: float,
        high: float,
        value: float,
        step: float,
        text: Callable[[float], str],
    ) -> ui.slider:
        """Build a slider with its name and, as people read it, its value."""
        with ui.element('div').classes('told'):
            ui.label(name)
            told = ui.html(text(value), sanitize=False)
        made = ui.slider(min=low, max=high, value=value, step=step)
        made.props(f'dark color=green-5 aria-label="{name}"').style('width:100%')
        made.told, made.text = told, text
        made.on_value_change(lambda event: self.on_slider(made, event.value))
        return made

    def on_slider(self, slider: ui.slider, value: float) -> None:
        """Tell a slider's value, and where the shot would go."""
        slider.told.set_content(slider.text(value))
        self.on_change()

    def power_text(self, value: float) -> str:
        """Power in percent; of a putt the ball's speed."""
        if self.club.value == PUTTER:
            speed = UNITS[self.units].speed
            return f'<b>{value / 100 * MOST_PUTT / speed.size:.2f} {speed.name}</b>'
        return f'<b>{value:.0f} %</b>'

    def aim_text(self, value: float) -> str:
        """Angle from the hole."""
        if abs(value) < 0.05:
            return '<b>at the hole</b>'
        return f'<b>{abs(value):.1f}° {"right" if value > 0 else "left"}</b>'

    def curve_text(self, value: float) -> str:
        """How the ball is to curve."""
        if not value:
            return '<b>straight</b>'
        name = ('fade', 'slice') if value > 0 else ('draw', 'hook')
        return f'<b>{name[abs(value) > 50]} {abs(value):.0f}</b>'

    @property
    def way(self) -> float:
        """Distance to the hole [m]; 0 where there is none, or no ball yet."""
        lie = self.session.lie
        if lie is None or lie.course.hole is None:
            return 0.0
        return hypot(lie.course.hole[0] - lie.place[0], lie.course.hole[1] - lie.place[1])

    @property
    def stroke(self) -> Stroke:
        """The stroke as the panel has it."""
        part = (self.power.value or 0.0) / 100.0
        putts = self.club.value == PUTTER
        return Stroke(
            self.club.value,
            part * MOST_PUTT if putts else part,
            float(self.aim.value or 0.0),
            0.0 if putts else (self.curve.value or 0.0) / 100.0,
        )

    def on_club(self) -> None:
        """Set the sliders to what the club calls for."""
        putts = self.club.value == PUTTER
        self.power.props(f'step={0.25 if putts else 1}')
        self.aim.props(f'step={0.1 if putts else 0.2}')
        self.curve.set_enabled(not putts)
        if putts and self.way:
            self.power.value = round(100 * caddie.putt_speed(self.way + 0.3) / MOST_PUTT, 1)
        elif not putts:
            self.power.value = round(100 * caddie.usual_power(self.club.value, self.way))
        self.power.told.set_content(self.power_text(self.power.value))
        self.on_change()

    def on_change(self) -> None:
        """Ask where the shot would go, unless it changes again soon."""
        self.asked += 1
        self.aside.classes('old')
        background_tasks.create(self.predict(self.asked), name='predict')

    async def predict(self, number: int) -> None:
        """Show where the shot would go."""
        await asyncio.sleep(PATIENCE)
        async with self.predicting:  # what is no longer asked is not asked of the worker
            await self.answer(number)

    async def answer(self, number: int) -> None:
        """Show where the shot would go, if that is what was asked last."""
        session = self.session
        if number != self.asked or self.client.is_deleted:
            return
        if not (self.hints.value and session.can_strike()):
            self.aside.set_text('')
            self.scene.run_method('hideHints' if not self.hints.value else 'hideLine')
            return
        lie = session.lie
        if lie is None:
            return
        answer = await self.worker.ask('predict', lie, stroke=self.stroke._asdict())
        if number != self.asked or self.client.is_deleted:
            return
        if answer and session.can_strike():
            self.scene.run_method('predict', answer)
            self.aside.set_text(told(answer, self.units))
            self.aside.classes(remove='old')

    async def read_green(self, lie: Lie) -> None:
        """Show the slopes of the green, then the line that holes."""
        for question in ('slopes', 'line'):
            answer = await self.worker.ask(question, lie)
            if lie != self.shown or self.client.is_deleted:
                return
            if answer and self.hints.value:
                self.scene.run_method('readGreen', question, answer)

    def strike(self) -> None:
        """Strike the ball."""
        session = self.session
        lie = session.lie
        if lie is None or not session.can_strike():
            return
        stroke = self.stroke
        velocity, spin = caddie.launch(lie.course.hole, lie.place, stroke)
        self.asked += 1
        session.sent(stroke.club, velocity, spin)
        self.hit(velocity, spin)

    def on_key(self, event: events.KeyEventArguments) -> None:
        """Strike with space, aim with the arrows, change the units with u."""
        if not event.action.keydown:
            return
        if event.key == ' ' and not event.action.repeat:
            self.strike()
        elif event.key == 'u' and not event.action.repeat:
            self.toggle_units()
        elif event.key.arrow_left or event.key.arrow_right:
            self.aim.value = round(self.aim.value + (0.4 if event.key.arrow_right else -0.4), 2)
        elif event.key.arrow_up or event.key.arrow_down:
            self.power.value = min(
                110, max(8, self.power.value + (1 if event.key.arrow_up else -1))
            )

    def toggle_units(self) -> None:
        """Tell all in the other units, as the picture does by itself."""
        self.units = 'si' if self.units == 'golf' else 'golf'
        self.club.set_options({name: club_label(name, self.units) for name in CLUBS})
        self.power.told.set_content(self.power_text(self.power.value))
        self.on_change()
        if self.dialog.value:
            self.show_card()

    def update(self) -> None:
        """Follow the session: the button, the hints at a new place, the card at the end."""
        session = self.session
        can = session.can_strike()
        if can != self.could:
            self.could = can
            self.button.set_enabled(can)
            if not can:
                self.aside.set_text('')
        lie = session.lie
        if can and lie is not None and not is_same(lie, self.shown):
            self.shown = lie
            self.prepare(lie)
        if session.is_over and not self.told_end:
            self.told_end = True
            self.show_card()
        elif not session.is_over:
            self.told_end = False

    def prepare(self, lie: Lie) -> None:
        """Suggest a club for the ball's new place, and show what there is to see there."""
        with self.client:
            if caddie.is_putt(lie.course, lie.place):
                self.club.value = PUTTER
                background_tasks.create(self.read_green(lie), name='green')
            elif lie.course.hole:
                self.club.value = caddie.likely_clubs(self.way)[0]
            self.aim.value = self.curve.value = 0
            self.on_club()

    def card_dialog(self) -> None:
        """Build the score card, closed."""
        with ui.dialog() as self.dialog, ui.card().style('width:620px;max-width:92vw'):
            self.card = ui.column().classes('card-table')

    def show_card(self) -> None:
        """Open the score card."""
        with self.client:
            self.card.clear()
            with self.card:
                fill_card(self.session, self.units, self.go_on and self.on_go_on)
            self.dialog.open()

    async def on_go_on(self) -> None:
        """Begin the next hole."""
        self.dialog.close()
        if self.go_on and self.session.is_over:  # another browser may have gone on
            await self.go_on()


def is_same(lie: Lie, other: Lie | None) -> bool:
    """Whether a ball lies where it lay; the wind may have turned."""
    return other is not None and (lie.course.digest, lie.place) == (
        other.course.digest,
        other.place,
    )


def club_label(name: str, units: str) -> str:
    """Club with how far its average shot carries."""
    carry, length = CLUBS[name].carry, UNITS[units].length
    return f'{name}, carries {carry / length.size:.0f} {length.name}' if carry else name


def distance(meters: float, units: str) -> str:
    """Tell a distance as players do: near the hole in feet, or to a decimetre."""
    if units == 'golf':
        if meters < SHORT:
            return f'{meters / 0.3048:.{int(meters < SHORTER)}f} ft'
        return f'{meters / 0.9144:.0f} yd'
    return f'{meters:.{int(meters < SHORT)}f} m'


def told(answer: dict[str, Any], units: str) -> str:
    """Put a prediction into words."""
    total = distance(answer['total'], units)
    status, lie = answer['status'], answer['lie'].replace('_', ' ')
    end = lie if status == 'at_rest' else ending(status)
    if status != 'at_rest' or answer['to_hole'] is None:
        return f'{total}, {end}'
    return f'{total}, {end}, {distance(answer["to_hole"], units)} to the hole'


ENDS = {'water': 'in the water', 'out_of_bounds': 'out of bounds', 'holed': 'in the hole'}
COLUMNS = [
    {'name': name, 'label': label, 'field': name, 'align': align}
    for name, label, align in (
        ('stroke', '', 'left'),
        ('club', 'Club', 'left'),
        ('carry', 'Carry', 'right'),
        ('total', 'Total', 'right'),
        ('end', 'End', 'left'),
        ('to_hole', 'To the hole', 'right'),
        ('penalty', 'Penalty', 'right'),
    )
]


def card_rows(lines: list[Line], units: str) -> list[dict[str, Any]]:
    """Rows of a hole's card."""

    def row(line: Line) -> dict[str, Any]:
        result = line.result
        flew, holed = result.get('apex', 0.0) > LEAST_APEX, result['status'] == 'holed'
        lie = (result['lie'] or '').replace('_', ' ')
        to_hole = None if holed else result['to_hole']
        return {
            'stroke': line.stroke,
            'club': line.club,
            'carry': distance(result['carry'], units) if flew else '',
            'total': distance(result['total'], units),
            'end': lie if result['status'] == 'at_rest' else ending(result['status']),
            'to_hole': '' if to_hole is None else distance(to_hole, units),
            'penalty': f'+{line.penalty}' if line.penalty else '',
        }

    return [row(line) for line in lines]


def ending(status: str) -> str:
    """Tell how a shot ended that did not come to rest."""
    return ENDS.get(status, status.replace('_', ' '))


def fill_card(session: Session, units: str, go_on: Callable[..., Any] | None) -> None:
    """Put all holes into the score card."""
    for hole in session.round.holes:
        score = f'{hole.strokes}, {hole.verdict()}' if hole.holed else f'{hole.strokes} so far'
        ui.label(f'{hole.name}, par {hole.par}: {score}').style('font-size:17px;font-weight:600')
        ui.table(columns=COLUMNS, rows=card_rows(hole.lines, units), row_key='stroke').props(
            'dense flat hide-bottom'
        ).style('width:100%')
    holes = [hole for hole in session.round.holes if hole.holed]
    if len(holes) > 1:
        total, par = sum(hole.strokes for hole in holes), sum(hole.par for hole in holes)
        ui.label(f'All: {total}, par {par}').style('font-size:17px;font-weight:600')
    if session.is_over and go_on:
        ui.button('Play on', on_click=go_on, color='green-8').props('no-caps unelevated')
