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

"""A recorded play as one HTML file, which opens without network and without a server."""

import base64
import gzip
from html import escape
from importlib.util import find_spec
import json
from pathlib import Path

JS = Path(__file__).with_name('js')
NEEDED = ModuleNotFoundError('No module named nicegui')

# Modules become blobs, which know no relative places: an import map gives all of them names.
PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>@TITLE@</title>
<style>html,body,#golf{margin:0;height:100%;position:relative;overflow:hidden}</style>
<div id="golf"></div>
<script>
const files = @FILES@;
const unpacked = async (text) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
};
(async () => {
  const imports = {};
  for (const [name, text] of Object.entries(files.modules)) {
    const blob = new Blob([await unpacked(text)], { type: "text/javascript" });
    imports[name] = URL.createObjectURL(blob);
  }
  const map = document.createElement("script");
  map.type = "importmap";
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  const { GolfPage } = await import("golf-view/index.js");
  const page = (window.golf = new GolfPage(document.getElementById("golf"), { units: "@UNITS@" }));
  page.showCourse(await unpacked(files.course));
  page.replay(await unpacked(files.play));
})().catch((error) => {
  const reason = `This browser cannot show the play: ${error.message}`;
  document.getElementById("golf").textContent = reason;
});
</script>
"""


def one_file(course: bytes, play: bytes, title: str, units: str) -> str:
    """HTML of a page that shows a play on a course.

    Parameters
    ----------
    course, play : bytes
        As `course_data.pack` and `play_data.play_data` make them.
    title : str
    units : str
        'golf' or 'si'.

    Raises
    ------
    ModuleNotFoundError
        NiceGUI, which brings the library that draws, is not installed.
    """
    modules = {'nicegui-scene': packed(three().read_bytes())}
    for path in sorted(JS.glob('*.js')):
        source = path.read_text(encoding='utf-8').replace('from "./', 'from "golf-view/')
        modules[f'golf-view/{path.name}'] = packed(source.encode())
    files = {'modules': modules, 'course': packed(course), 'play': packed(play)}
    parts = {'@TITLE@': escape(title), '@FILES@': json.dumps(files), '@UNITS@': units}
    page = PAGE
    for place, text in parts.items():
        page = page.replace(place, text)
    return page


def three() -> Path:
    """File of the library that draws, which NiceGUI brings."""
    found = find_spec('nicegui')
    if found is None or found.origin is None:
        raise NEEDED
    return Path(found.origin).parent / 'elements' / 'scene' / 'dist' / 'index.js'


def packed(data: bytes) -> str:
    """Text of compressed bytes."""
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode()
