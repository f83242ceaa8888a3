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

"""The physics uses the field's own terms: the private ones that it had are not used again."""

import ast
from pathlib import Path
import re

import pytest

ROOT = Path(__file__).resolve().parents[1]
PHYSICS = ROOT / 'golf_sim_ros' / 'physics'
# fmt: off
# Private terms, by the folder or module of the physics in which they had their meaning ('.': all
# of it). Elsewhere some are plain words: what lies `ahead`, the `shared` kernels.
PRIVATE = {
    '.': {
        'piece', 'lay_next', 'flat_piece', 'bent_piece', 'safe_advance', 'first_touch', 'sees_one',
        'leave', 'submerged', 'is_passed', 'Crowd', 'crowd', 'Solo', 'members', 'first_due',
        'plant', 'renew', 'unite', 'rub', 'recall', 'part_overlaps', 'pile', 'pile_up',
        'PILE_STEP', 'leans', 'leaning', 'calm', 'lean', 'rouse', 'gather', 'enlist', 'disperse',
        'bring', 'reflect', 'meet_ball', 'scatter', 'tell', 'meet', 'settle_speed',
        'lasting_bounciness', 'tail', 'hold', 'stalled', 'stuck', 'emerge', 'drown', 'is_over',
        'dip', 'dips', 'stand_on', 'meet_air', 'felt_normal', 'pull_at', 'blow', 'take_wind',
        'knocked', 'rated', 'twist', 'Land', 'be_exact', 'pass_at', 'bump', 'pair',
        'caught', 'splash', 'together', 'watch', 'Braked', 'hierarchy',
    },
    'collision': {'push', 'ahead', 'approach', 'press', 'keep', 'follow', 'others', 'put'},
    'contact': {'push', 'put', 'approach', 'follow', 'settle'},
    'mechanics': {'push', 'put', 'approach', 'braked'},
    'response': {'push', 'put', 'approach', 'keep', 'follow'},
    'response/ball_impact.py': {'collide'},
    'response/contact_set.py': {'ahead', 'press', 'collide'},
    'response/contact_solver.py': {'ahead', 'press', 'turn'},
    'response/simultaneous_impact.py': {'ahead', 'press', 'turn'},
    'state': {'playing', 'push', 'ahead', 'approach', 'press', 'others'},
}
PREFIXES = ('tail_', 'tell_')
# fmt: on


def identifiers(path: Path) -> set[str]:
    """Names of a module: its own, and of variables, functions, classes, arguments and fields."""
    found = {path.stem}
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.Name):
            found.add(node.id)
        elif isinstance(node, ast.Attribute):
            found.add(node.attr)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.add(node.name)
        elif isinstance(node, (ast.arg, ast.keyword)) and node.arg:
            found.add(node.arg)
        elif isinstance(node, ast.ImportFrom):
            found |= {*(node.module or '').split('.')}
        elif isinstance(node, ast.alias):
            found |= {*node.name.split('.'), node.asname or ''}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found.add(node.value)  # of a record's field, if it is one word
    return {name.strip('_') for name in found}


@pytest.mark.parametrize('folder', PRIVATE)
def test_no_private_term_is_a_name_of_the_physics(folder):
    place = PHYSICS / folder
    modules = [place] if place.is_file() else sorted(place.rglob('*.py'))
    assert modules
    found = [
        (str(module.relative_to(PHYSICS)), name)
        for module in modules
        for name in sorted(identifiers(module))
        if name in PRIVATE[folder] or name.startswith(PREFIXES)
    ]
    assert not found


TERMS = (
    'AABB tree, BVH',
    'broad phase',
    'closed form of sliding and rolling',
    'conservative advancement',
    'contact set',
    'Coulomb friction',
    'drag coefficient',
    'error tolerance',
    'event loop',
    'logarithmic wind profile',
    'Magnus force',
    'narrow phase',
    'penetration correction',
    'projected Gauss-Seidel',
    'restitution threshold',
    'rolling resistance',
    'simultaneous impacts',
    'sleeping',
    'spin decay',
    'time of impact',
    'warm start',
)


@pytest.mark.parametrize('term', TERMS)
def test_a_term_of_the_field_is_in_the_glossary_and_in_the_modules_that_it_names(term):
    lines = (ROOT / 'docs' / 'glossary.md').read_text(encoding='utf-8').splitlines()
    told = [line for line in lines if line.lower().startswith(f'| {term.lower()} |')]
    assert len(told) == 1
    modules = re.findall(r'`([a-z_/0-9]+\.py)`', told[0])
    assert modules
    for module in modules:
        source = (PHYSICS / module).read_text(encoding='utf-8').lower()
        words = ' '.join(source.replace('_', ' ').split())
        assert any(name in words for name in term.lower().split(', '))
