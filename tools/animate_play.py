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

"""Film a shot of a recorded play with the page's own pictures, as an animated WebP.

    .venv/bin/python tools/animate_play.py play/bag -o docs/drive.webp

Needs Playwright and a Chromium (Debian and Ubuntu: apt install chromium).
"""

import argparse
from io import BytesIO
from pathlib import Path
import shutil
import sys
import tempfile

from golf_sim_ros.cli.view_play import chosen
from golf_sim_ros.view.course_data import pack
from golf_sim_ros.view.one_file import one_file
from PIL import Image
from playwright.sync_api import sync_playwright

FLAGS = [
    '--no-sandbox',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
    '--ignore-gpu-blocklist',
    '--disable-background-networking',
]
READY = 'window.golf && golf.recorded && golf.view.frames > 0'
PATIENCE = 120_000  # ms
START = """(n) => {
  const { view, recorded, hud } = golf;
  view.renderer.setAnimationLoop(null);
  recorded.toShot(n); recorded.playing = false;
  document.querySelector('.golf .line').style.display = 'none';
  hud.box.classList.remove('recorded');
  view.cameras.jump = true; view.drawnAt = 99; view.changed = true; view.step(100);
  return [recorded.play.shots[n].start - 0.8, recorded.play.shots[n].end + 1.6];
}"""
STEP = """([time, clock]) => {
  golf.recorded.seek(time); golf.recorded.drawn = time - 1e-3;
  golf.view.changed = true; golf.view.step(clock);
}"""


def main():
    """Film the shot; return the exit code."""
    options = parser().parse_args()
    browser = shutil.which('chromium') or shutil.which('chromium-browser')
    if browser is None:
        print('animate_play: there is no chromium: apt install chromium', file=sys.stderr)
        return 1
    course, play = chosen(options)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'play.html'
        path.write_text(one_file(pack(course), play, course.name, options.units))
        pictures = filmed(path, browser, options)
    first, *others = pictures
    first.save(
        options.output,
        save_all=True,
        append_images=others,
        duration=round(1000 / options.rate),
        loop=0,
        quality=options.quality,
        method=6,
    )
    print(
        f'{options.output}: {len(pictures)} pictures, {options.output.stat().st_size / 1e6:.2f} MB'
    )
    return 0


def parser():
    """Parser of the command line."""
    reader = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    reader.add_argument('bag')
    reader.add_argument('-o', '--output', type=Path, default=Path('drive.webp'))
    reader.add_argument('--shot', type=int, default=1, help='its place in the bag (%(default)s)')
    reader.add_argument('--rate', type=float, default=12.0, help='pictures a second (%(default)s)')
    reader.add_argument('--size', type=int, nargs=2, default=(640, 360), metavar=('W', 'H'))
    reader.add_argument('--quality', type=int, default=62)
    reader.add_argument('--units', choices=('golf', 'si'), default='golf')
    reader.add_argument('--namespace')
    reader.add_argument('--course')
    return reader


def filmed(path, browser, options):
    """Pictures of the shot, one after the other."""
    width, height = options.size
    with sync_playwright() as player:
        chromium = player.chromium.launch(executable_path=browser, args=FLAGS)
        page = chromium.new_page(viewport={'width': 960, 'height': round(960 * height / width)})
        page.goto(path.as_uri())
        page.wait_for_function(READY, timeout=PATIENCE)
        start, end = page.evaluate(START, options.shot - 1)
        pictures = []
        for number in range(int((end - start) * options.rate)):
            page.evaluate(STEP, [start + number / options.rate, 100 + (number + 1) / options.rate])
            shot = Image.open(BytesIO(page.screenshot(timeout=PATIENCE))).convert('RGB')
            pictures.append(shot.resize((width, height), Image.LANCZOS))
        chromium.close()
    return pictures


if __name__ == '__main__':
    sys.exit(main())
