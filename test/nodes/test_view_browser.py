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

"""The page in a browser: headless Chromium with a picture that the processor draws."""

import base64
from io import BytesIO
import shutil

from golf_sim_ros.course import load_course
from golf_sim_ros.course.package_files import share
from golf_sim_ros.drawing import drawn
from golf_sim_ros.physics import Shot, simulate
from golf_sim_ros.physics.scene.kernel_model import materials
from golf_sim_ros.view.course_data import grid, pack
from golf_sim_ros.view.play_data import play_data
from golf_sim_ros.view.raster import ground_grid
import numpy as np
from processes import wait_until
import pytest

pytest.importorskip('nicegui')
playwright = pytest.importorskip('playwright.sync_api', reason='Playwright is not installed')
CHROMIUM = shutil.which('chromium') or shutil.which('chromium-browser')
if CHROMIUM is None:
    pytest.skip('Chromium is not installed', allow_module_level=True)

from golf_sim_ros.view.one_file import one_file  # noqa: E402, I100
from page_server import listening, served  # noqa: E402
from PIL import Image  # noqa: E402

FLAGS = [
    '--no-sandbox',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--ignore-gpu-blocklist',
    '--disable-background-networking',
]
PATIENCE = 120_000  # ms: a picture takes seconds where a busy processor draws it
RECORDED = 'window.golf && golf.recorded && golf.view.frames > 0'
COURSES = sorted(path.stem for path in share('config', 'courses').glob('*.yaml'))
# What is meant, sRGB as it is seen from above, and by how much it may vary with light and noise.
MEANT = {
    'fairway': ((122, 160, 62), 45),
    'green': ((140, 178, 84), 45),
    'sand': ((212, 195, 155), 50),
    'rough': ((78, 112, 40), 45),
}
WATER, SKY = ((60, 110, 130), 60), ((150, 190, 225), 60)


@pytest.fixture(scope='module')
def chromium():
    """One browser for all tests here."""
    with playwright.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def open_page(chromium):
    """Open a page and wait until it has drawn: the page, and its errors; closed at the end."""
    pages = []

    def open_page(url, offline=False, ready='window.golf && golf.view.frames > 0'):
        context = chromium.new_context(viewport={'width': 480, 'height': 300}, offline=offline)
        page = context.new_page()
        page.errors, page.bytes = [], 0
        page.on('pageerror', lambda error: page.errors.append(str(error)))
        page.on(
            'console', lambda told: page.errors.append(told.text) if told.type == 'error' else None
        )
        network = context.new_cdp_session(page)
        network.send('Network.enable')

        def count(event):
            page.bytes += event['encodedDataLength']

        network.on('Network.loadingFinished', count)
        pages.append(context)
        page.goto(url, timeout=PATIENCE)
        page.wait_for_function(ready, timeout=PATIENCE)
        return page

    yield open_page
    for context in pages:
        context.close()


def color_at(page, look):
    """Mean colour in the middle of one picture, after the script `look` set the camera at `v`."""
    picture = page.evaluate(
        f"""() => {{
        const v = golf.view;
        v.renderer.setAnimationLoop(null);
        v.camera.up.set(0, 0, 1);
        {look};
        v.scene.traverse((thing) => (thing.castShadow = false));  // what a place has by itself
        v.renderer.shadowMap.needsUpdate = true;
        for (const ball of v.balls) ball.mesh.visible = ball.shadow.visible = false;
        v.renderer.render(v.scene, v.camera);
        return v.renderer.domElement.toDataURL();
        }}"""
    )
    image = Image.open(BytesIO(base64.b64decode(picture.partition(',')[2]))).convert('RGB')
    rows = np.asarray(image)
    high, wide = rows.shape[0] // 2, rows.shape[1] // 2
    low, left = high - 20, wide - 40
    return rows[low:][:40, left:][:, :80].reshape(-1, 3).mean(0)


def from_above(x, y, z):
    """Script that looks down on a place."""
    return f'v.camera.position.set({x - 0.5}, {y}, {z + 7}); v.camera.lookAt({x}, {y}, {z})'


def amid(course, name):
    """Find a place in the midst of a material, or None."""
    x, y = (np.arange(p[0], p[-1], 0.5) for p in grid(course))
    heights, numbers = ground_grid(course, x, y)
    names = [material.name for material in materials(course)]
    if name not in names:
        return None
    wet = np.zeros(numbers.shape, bool)
    for pond in course.water:
        low, high = np.min(pond.polygon, 0) - 2, np.max(pond.polygon, 0) + 2
        wet |= ((x > low[0]) & (x < high[0])) & ((y > low[1]) & (y < high[1]))[:, np.newaxis]
    beside = np.hypot(x - course.hole[0], (y - course.hole[1])[:, np.newaxis]) > 4.0
    own = (numbers == names.index(name)) & ~wet & beside
    windows = np.lib.stride_tricks.sliding_window_view(own, (9, 9)).all((2, 3))
    found = np.argwhere(windows)
    if not len(found):
        return None
    j, i = found[len(found) // 2] + 4
    return float(x[i]), float(y[j]), float(heights[j, i])


@pytest.mark.parametrize('name', COURSES)
def test_a_course_in_one_file_without_network_has_the_colours_that_are_meant(
    open_page, tmp_path, name
):
    course = load_course(name)
    play = drawn(simulate(course, Shot((20.0, 0.0, 8.0)), rate=50.0, engine='python'))
    path = tmp_path / 'play.html'
    path.write_text(one_file(pack(course), play_data([play]), course.name, 'golf'))
    page = open_page(path.as_uri(), offline=True, ready=RECORDED)
    for material, (meant, off) in MEANT.items():
        place = amid(course, material)
        if place:
            seen = color_at(page, from_above(*place))
            assert np.abs(seen - meant).max() < off, (material, seen)
    for pond in course.water:
        seen = color_at(page, from_above(*np.mean(pond.polygon, 0), pond.level))
        assert np.abs(seen - WATER[0]).max() < WATER[1] and seen[2] > seen[0], ('water', seen)
    x, y, z = play.positions[0]
    look = f'v.camera.position.set({x}, {y}, {z + 3}); v.camera.lookAt({x + 9}, {y}, {z + 6})'
    seen = color_at(page, look)
    assert np.abs(seen - SKY[0]).max() < SKY[1] and seen[2] > seen[1] > seen[0], ('sky', seen)
    assert page.errors == []


def test_a_recorded_play_goes_on_by_itself_and_to_any_time(open_page, tmp_path):
    course = load_course('links')
    play = drawn(simulate(course, Shot((20.0, 0.0, 8.0)), rate=50.0, engine='python'))
    path = tmp_path / 'play.html'
    path.write_text(one_file(pack(course), play_data([play]), course.name, 'si'))
    page = open_page(path.as_uri(), offline=True, ready=RECORDED)
    page.wait_for_function('golf.recorded.time > 0.2', timeout=PATIENCE)
    page.evaluate(f'golf.recorded.seek({play.times[-1] + 1}), golf.view.changed = true')
    page.wait_for_function('golf.hud.state.result', timeout=PATIENCE)
    place = page.evaluate('golf.view.balls[0].place.toArray()')
    np.testing.assert_allclose(place, play.result.position, atol=1e-3)
    shown = page.inner_text('.golf .cards')
    assert f'{play.result.carry:.0f} m' in shown


@pytest.fixture(scope='module')
def hole(start):
    """Serve a page to play links from, with a sim of its own, in calm air."""
    return served(start, 'cli.play_hole', 'links', '--wind', '0', '--units', 'si')


def test_one_click_is_one_strike_one_result_and_its_cards(open_page, hole):
    process, url = hole
    page = open_page(url)
    page.evaluate('window.golfLeastGap = 1; window.golfArrivals = []')
    button = page.locator('.strike button', has_text='Strike')
    wait_until(button.is_enabled, 'the ball can be struck')
    assert page.bytes < 900_000
    with listening(url) as other:
        other.wait_for('wind')
        page.evaluate('golfArrivals.length = 0; window.clicked = performance.now() / 1000')
        button.dispatch_event('click')
        button.dispatch_event('click')
        result = other.wait_for('result')
        assert result['shot'] == 1 and len(other.of('strike')) == 1
    page.wait_for_function('golf.hud.state.result', timeout=PATIENCE)
    first = page.evaluate('golfArrivals.find((row) => row[3] > 0.5 || row[5] > 0.1)[0] - clicked')
    print(f'from click to first moving pose: {1000 * first:.0f} ms')
    cards = page.inner_text('.golf .cards')
    for key in ('carry', 'total'):
        assert f'{result[key]:.0f} m' in cards
    assert page.evaluate('golf.hud.state.result.shot') == 1
    wait_until(button.is_enabled, 'the ball can be struck again')
    page.evaluate("golf.onEvent({ kind: 'course', url: golf.url })")  # the hole begins anew
    assert page.evaluate('golf.view.balls.map((ball) => ball.tracer.count)') == [0]
    assert page.inner_text('.golf .cards') == ''
    assert page.errors == []


def test_cameras_units_and_hints_follow_keys_and_switches(open_page, hole):
    page = open_page(hole[1])
    page.wait_for_function('golf.ready', timeout=PATIENCE)
    for key, mode in enumerate(('behind', 'broadcast', 'above', 'pin', 'free'), 1):
        page.keyboard.press(str(key))
        assert page.evaluate('golf.view.cameras.mode') == mode
    early, late = page.evaluate(
        """() => {
        const v = golf.view;
        golf.hud.choose('behind');
        v.cameras.jump = v.changed = true;
        v.step(performance.now() / 1000);
        const early = golf.hud.pin.style.transform;
        golf.hud.placePin(v.balls[0]);
        return [early, golf.hud.pin.style.transform];
        }"""
    )
    assert early == late, 'the label is over the flag of the picture that is drawn'
    assert ' m' in page.inner_text('.golf .head')
    page.keyboard.press('u')
    page.wait_for_function("golf.hud.head.innerText.includes('yd')", timeout=PATIENCE)
    page.wait_for_function('golf.view.hint && golf.view.hint.count > 5', timeout=PATIENCE)
    page.locator('.strike .q-toggle').dispatch_event('click')
    page.wait_for_function('golf.view.hint.count === 0', timeout=PATIENCE)
    assert page.errors == []


def click(page, box):
    """Press the mouse's button amid a box."""
    page.mouse.click(box['x'] + 0.5 * box['width'], box['y'] + 0.5 * box['height'])


def test_after_the_mouse_has_been_used_arrow_keys_aim_and_set_the_power(open_page, hole):
    page = open_page(hole[1])
    page.evaluate('window.golfLeastGap = 1')
    predicted = "golf.ready && document.querySelector('.strike .aside').innerText"
    page.wait_for_function(predicted, timeout=PATIENCE)
    panel = page.locator('.strike')
    click(page, panel.locator('.q-select .q-field__control').bounding_box())
    page.wait_for_function("document.querySelector('.q-menu')?.style.top", timeout=PATIENCE)
    item = page.locator('.q-menu .q-item').nth(3)
    item.evaluate('item => item.scrollIntoView()')
    name, box = item.inner_text(), item.bounding_box()
    assert 0 <= box['y'] < 300 - box['height'], 'the list is where it is seen'
    click(page, box)
    page.wait_for_selector('.q-menu', state='detached', timeout=PATIENCE)
    wait_until(lambda: name in panel.inner_text(), 'the club is chosen')
    page.keyboard.press('ArrowRight')
    wait_until(lambda: '0.4° right' in panel.inner_text(), 'the stroke is aimed')
    click(page, panel.locator('.q-slider').first.bounding_box())
    wait_until(lambda: '59 %' in panel.inner_text(), 'the power is set by the mouse')
    page.evaluate('new Promise((done) => setTimeout(done, 100))')  # sliders tell again at 50 ms
    page.keyboard.press('ArrowUp')
    wait_until(lambda: '60 %' in panel.inner_text(), 'the power is set by a key')
    assert name in panel.inner_text() and '0.4° right' in panel.inner_text()
    assert page.errors == []


def test_a_page_without_its_server_says_so(open_page, start):
    process, url = served(start, 'cli.view_play')
    page = open_page(url, ready='window.golf')
    process.stop()
    page.wait_for_function(
        "document.querySelector('.golf .note').innerText.includes('cannot be reached')",
        timeout=PATIENCE,
    )
