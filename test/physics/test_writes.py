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

"""What a kernel's docstring says that it writes is what it writes, itself or by what it calls.

Read from the sources. What counts are fields of `BALL` and `CONTACT`, arrays of the workspace, and
the log. A name in a docstring may be a field, an array, or one of `GROUPS`; all that is written
must be named, and of each name something must be written.
"""

import ast
import re

from golf_sim_ros.physics.collision.workspace import (
    CONTACT,
    ImpactScratch,
    SolverScratch,
    Tree,
    Workspace,
)
from golf_sim_ros.physics.state.ball import BALL
import pytest
from sources import field_of, functions, targets, trees

# What a name in a docstring stands for, beside the name of a field: of a ball, if none is named.
CURVE = ('span', 'origin', 'position_coefficients', 'spin_coefficients')
LANDING = ('landed', 'landing', 'landed_at', 'landing_velocity')
WARM_START = ('stored_count', 'stored_partners', 'stored_impulses')
MICRO_BOUNCES = ('micro_bounce_end', 'micro_bounce_load', 'micro_bounce_air')
INTEGRATOR = ('step', 'stages', 'last_stage_time', 'evaluations')
# fmt: off
STEPPING = (
    'time_stepping', 'still_steps', 'held_by', 'rolling_loss', 'contact_reach',
    'watches_neighbours', 'sleeps_on_ball', 'rapid_impacts', *WARM_START,
)
SHOT = (
    'shot_active', 'moved_by_ball', 'struck', 'struck_at', 'launch', 'launch_spin', 'apex',
    *LANDING, 'bounces', 'ended', 'over_time', 'failed', 'counted_until', 'segments_spent',
    'zero_length_segments',
)
# fmt: on
GROUPS = {
    'motion': ('position', 'velocity', 'spin'),
    'contact': ('support', 'material', 'normal'),
    'curve': CURVE,
    'segment': ('begin', 'end', 'ending', 'target', *CURVE),
    'integrator': INTEGRATOR,
    'micro_bounces': MICRO_BOUNCES,
    'stepping': STEPPING,
    'warm_start': WARM_START,
    'landing': LANDING,
    'shot': SHOT,
    'ball': BALL.names,
    'balls': BALL.names,
}
SCRATCH = {'impact': ImpactScratch, 'solver': SolverScratch, 'tree': Tree}
ARRAYS = (
    *(name for name in Workspace._fields if name not in SCRATCH),
    *(name for record in SCRATCH.values() for name in record._fields),
)
OTHER_GROUPS = {
    'contacts': (*(f'contact.{name}' for name in CONTACT.names), 'work.contacts', 'work.counts'),
    'involved': ('work.involved', 'work.involved_index', 'work.counts'),
    'tree': tuple(f'work.{name}' for name in Tree._fields),
    'work': (*(f'work.{name}' for name in ARRAYS), *(f'contact.{name}' for name in CONTACT.names)),
    'log': ('log',),
}
RECORDS = {'row': 'contact', 'node': 'work.nodes', 'event': 'log', 'end': None, 'log': 'log'}
ROLES = {'kernel', 'shared', 'entry', 'generic'}
PLAYS_A_COPY = {'play_all'}  # its balls are its own


class Kernel:
    """What a function of the sources writes itself, what it calls, and what it says."""

    def __init__(self, place, function):
        self.place, self.name = f'{place}:{function.lineno}', function.name
        self.parameters = [argument.arg for argument in function.args.args]
        self.text = ast.get_docstring(function) or ''
        self.aliases = aliases(function)
        self.calls = [node for node in ast.walk(function) if isinstance(node, ast.Call)]
        self.written = set()
        for node in ast.walk(function):
            for target in targets(node):
                if isinstance(target, ast.Subscript):
                    self.written.add(self.effect(target))
        for call in self.calls:
            if ast.unparse(call.func) == 'store':
                self.written.add(self.effect(call.args[0]))
        self.written.discard(None)

    def effect(self, node):
        """Name what writing to the expression `node` writes, like ``ball.spin``.

        None if nothing that counts.
        """
        while True:
            record, field = field_of(node)
            if field is not None:
                return self.field(node.value, record, field)
            if isinstance(node, ast.Attribute):
                root = ast.unparse(node.value).partition('.')[0]
                if root in ('work', *SCRATCH):
                    return f'work.{node.attr}'
                return 'log' if root == 'log' else None
            if isinstance(node, ast.Subscript):
                node = node.value
            elif isinstance(node, ast.Name) and node.id in self.aliases:
                node = self.aliases[node.id]
            elif isinstance(node, ast.Name) and node.id in self.parameters:
                return f'parameter {node.id}'
            else:
                return None

    def field(self, node, record, field):
        """Name what writing a field of the record `node` writes."""
        while isinstance(node, ast.Name) and node.id in self.aliases:
            node = self.aliases[node.id]
        text = ast.unparse(node)
        if text.startswith('work.contacts'):
            return f'contact.{field}'
        if text.startswith('tree.nodes'):
            return 'work.nodes'
        kind = RECORDS.get(record, 'ball')
        return f'{kind}.{field}' if kind in ('ball', 'contact') else kind


def aliases(function):
    """Local names of a function that stand for a place in something else, with its expression."""
    found = {}
    for node in ast.walk(function):
        if (
            isinstance(node, ast.Assign)
            and len(node.targets) == 1
            and isinstance(node.targets[0], ast.Name)
            and isinstance(node.value, (ast.Subscript, ast.Attribute))
        ):
            found[node.targets[0].id] = node.value
    return found


def decorators(function):
    """Texts of a function's decorators."""
    return [ast.unparse(decorator) for decorator in function.decorator_list]


def kernels():
    """All kernels by name, as lists: of a generic first what it says, then bodies for records."""
    found = {}
    for place, tree in trees():
        for function in functions(tree):
            for text in decorators(function):
                if text in ROLES:
                    found.setdefault(function.name, []).insert(0, Kernel(place, function))
                elif '.register(' in text:
                    name = text.partition('.register(')[0].rpartition('.')[2]
                    found.setdefault(name, []).append(Kernel(place, function))
    return found


KERNELS = kernels()


def effects():
    """All that each kernel writes, by its name, with all that it calls."""
    found = {
        name: set().union(*(kernel.written for kernel in bodies))
        for name, bodies in KERNELS.items()
    }
    changed = True
    while changed:
        changed = False
        for name, bodies in KERNELS.items():
            more = {
                effect
                for kernel in bodies
                for call in kernel.calls
                for effect in of_call(kernel, call, found)
            } - found[name]
            if more:
                found[name] |= more
                changed = True
    return found


def of_call(kernel, call, found):
    """Find what a call within a kernel writes."""
    name = ast.unparse(call.func).rpartition('.')[2]
    if name == 'store' or name not in KERNELS:
        return
    for effect in found[name]:
        what, _, parameter = effect.partition(' ')
        if what != 'parameter':
            yield effect
            continue
        order = KERNELS[name][0].parameters
        if parameter in order and order.index(parameter) < len(call.args):
            passed = kernel.effect(call.args[order.index(parameter)])
            if passed:
                yield passed


EFFECTS = effects()


def said(text):
    """Names in the sentences of a docstring that start with "Writes"."""
    for sentence in re.findall(r'\b(?:Also w|W)rites\s+([^.;]*)', text):
        without_units = re.sub(r'\[[^]]*\]', '', ' '.join(sentence.split()))
        yield from (name.strip() for name in re.split(r', and |, | and ', without_units))


def meant(name):
    """Effects that a name in a docstring may stand for; None if it is no name."""
    found = {f'ball.{field}' for field in GROUPS.get(name, ())} | set(OTHER_GROUPS.get(name, ()))
    found |= {f'ball.{name}'} if name in BALL.names else set()
    found |= {f'contact.{name}'} if name in CONTACT.names else set()
    found |= {f'work.{name}'} if name in ARRAYS else set()
    return found


CHECKED = sorted(
    name for name, bodies in KERNELS.items() if bodies[0].text and name not in ('store',)
)


def test_an_array_of_the_workspace_belongs_to_one_solver():
    assert len(ARRAYS) == len(set(ARRAYS))
    assert all(record is Workspace.__annotations__[name] for name, record in SCRATCH.items())


@pytest.mark.parametrize('name', CHECKED)
def test_a_docstring_names_what_is_written(name):
    kernel = KERNELS[name][0]
    written = {effect for effect in EFFECTS[name] if not effect.startswith('parameter ')}
    if name in PLAYS_A_COPY:
        written = {effect for effect in written if not effect.startswith('ball.')}
    if re.search(r'\b[Ll]og(s|ged)?\b', kernel.text):
        written.discard('log')
    names = [*said(kernel.text)]
    own = {name for name in names if name in kernel.parameters}
    unknown = [name for name in names if not meant(name) and name not in own]
    assert not unknown, f'{kernel.place} unknown: {unknown}'
    idle = [name for name in names if name not in own and not meant(name) & (written | {'log'})]
    assert not idle, f'{kernel.place} does not write {idle}'
    missing = sorted(written - set().union(*(meant(name) for name in names), ()))
    assert not missing, f'{kernel.place} writes {missing}'
