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

"""The documentation: all pages are on the way through it, links lead on, Sphinx builds it."""

import os
from pathlib import Path
import re
import subprocess
import sys

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted((ROOT / 'docs').glob('*.md'))
TEXTS = [
    *PAGES,
    *(ROOT / f'{name}.md' for name in ('README', 'CONTRIBUTING', 'QUALITY_DECLARATION')),
]


def links(path):
    """Relative links of a page, beside those in code."""
    prose = re.sub(r'```.*?```|`[^`\n]*`', '', path.read_text(encoding='utf-8'), flags=re.DOTALL)
    return [link for link in re.findall(r'\]\(([^)\s]+)\)', prose) if '://' not in link]


@pytest.mark.parametrize('path', TEXTS, ids=lambda path: path.name)
def test_links_lead_to_files(path):
    assert [
        link
        for link in links(path)
        if link[0] != '#' and not (path.parent / link.partition('#')[0]).exists()
    ] == []


def test_every_page_is_on_the_way_through_the_documentation():
    index = (ROOT / 'docs' / 'index.md').read_text(encoding='utf-8')
    listed = {
        line
        for block in re.findall(r'```{toctree}(.*?)```', index, re.DOTALL)
        for line in block.split('\n')
    }
    assert {page.stem for page in PAGES} - {'index'} <= listed
    assert {page.name for page in PAGES} - {'index.md'} <= set(links(ROOT / 'docs' / 'index.md'))


def test_rosdoc2_is_told_where_the_documentation_is():
    manifest = (ROOT / 'package.xml').read_text(encoding='utf-8')
    told = re.search(r'<rosdoc2>(.*)</rosdoc2>', manifest)[1]
    assert 'sphinx_sourcedir: docs' in (ROOT / told).read_text(encoding='utf-8')


def test_it_builds_without_a_warning(tmp_path):
    for module in ('sphinx', 'myst_parser', 'sphinx_rtd_theme'):
        pytest.importorskip(module, reason='make docs has an environment of its own for it')
    build = subprocess.run(
        [sys.executable, ROOT / 'tools' / 'build_docs.py', tmp_path / 'docs'],
        capture_output=True,
        text=True,
    )
    assert build.returncode == 0, build.stderr
    assert (tmp_path / 'docs' / 'html' / 'golf_sim_ros.physics.html').is_file()


def test_the_example_of_the_readme_prints_what_it_says():
    text = (ROOT / 'README.md').read_text(encoding='utf-8')
    example, printed = re.search(
        r'```python\n(.*?)```\n\nprints `(.*?)`', text, re.DOTALL
    ).groups()
    run = subprocess.run(
        [sys.executable, '-c', example],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, 'GOLF_SIM_ROS_ENGINE': 'python'},
    )
    assert run.stdout.strip() == printed, run.stderr
