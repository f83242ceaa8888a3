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

"""docs/validation.md: budgets by club, and that the page tells what the laws do."""

from pathlib import Path
import re
import sys

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / 'docs' / 'validation.md').read_text(encoding='utf-8')


@pytest.fixture(scope='module', autouse=True)
def in_plain_python():
    """Play in plain Python: few shots, by laws that would be compiled for them alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv('GOLF_SIM_ROS_ENGINE', 'python')
        yield


@pytest.fixture(scope='module')
def validate():
    """Import the module that makes the page."""
    pytest.importorskip('scipy')
    pytest.importorskip('matplotlib')
    sys.path.append(str(ROOT / 'tools'))
    import validate

    return validate


@pytest.fixture(scope='module')
def found(validate):
    """Play the tours' tables by the default law."""
    return {name: validate.errors_of(name, ['fitted'])[0] for name in validate.PGA}


def test_every_club_keeps_to_its_budget(validate, found):
    for club, errors in validate.club_errors(found).items():
        assert (np.abs(errors) <= validate.BUDGETS[club]).all(), (club, errors)


def test_the_clubs_are_those_of_the_tables(validate):
    for name in validate.PGA:
        clubs = validate.errors_of(name, [])[1]
        assert [club.split()[0] for club in clubs] == [c.split()[0] for c in validate.BUDGETS]


def numbers(text):
    """All numbers of a text."""
    return [float(number) for number in re.findall(r'[-+]?\d+\.?\d*', text)]


def after(start, end):
    """Part of the page from `start` to before the next `end`."""
    return start + PAGE.partition(start)[2].partition(end)[0]


def test_the_page_is_of_these_laws(validate, found):
    clubs = validate.clubs_table(found)
    assert numbers(after('| club |', '\n\n')) == pytest.approx(numbers(clubs), abs=0.11)
    points = validate.points_table()
    assert numbers(after('| source |', '\n\n')) == pytest.approx(numbers(points), abs=0.02)
