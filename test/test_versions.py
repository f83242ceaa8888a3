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

"""The version is the same everywhere, and the changelog has it."""

from pathlib import Path
import re

import golf_sim_ros

ROOT = Path(__file__).resolve().parents[1]


def test_setup_and_manifest_have_the_version_of_the_package():
    manifest = (ROOT / 'package.xml').read_text(encoding='utf-8')
    setup = (ROOT / 'setup.py').read_text(encoding='utf-8')
    assert re.search(r'<version>(.*)</version>', manifest)[1] == golf_sim_ros.__version__
    assert re.search(r"\bversion='(.*)'", setup)[1] == golf_sim_ros.__version__


def test_the_newest_section_of_the_changelog_that_has_a_version_has_this_one_and_a_date():
    changelog = (ROOT / 'CHANGELOG.rst').read_text(encoding='utf-8')
    sections = re.findall(r'^(.+)\n-{3,}$', changelog, re.MULTILINE)
    released = [section for section in sections if section != 'Forthcoming']
    assert re.fullmatch(re.escape(golf_sim_ros.__version__) + r' \(\d{4}-\d\d-\d\d\)', released[0])
