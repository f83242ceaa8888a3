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

"""One module writes the phase of a ball, and one the events of impacts: read from the sources."""

import ast

from sources import field_of, functions, targets, trees

NOT_A_BALL = {('trajectory/shot_record.py', 'end')}  # an ENDED record gets a copy of the phase
LOGS_THE_END_OF_A_SHOT = ('trajectory/shot_record.py', 'end_shot')


def test_transitions_alone_write_the_phase_of_a_ball():
    wrong = []
    for place, tree in trees():
        for node in ast.walk(tree):
            for target in targets(node):
                record, field = field_of(target)
                if field == 'phase' and (place, record) not in NOT_A_BALL:
                    wrong.append(f'{place}:{node.lineno}')
    assert {place.partition(':')[0] for place in wrong} == {'state/transitions.py'}, wrong


def test_each_phase_has_its_transition():
    tree = dict(trees())['state/transitions.py']
    written = [
        node.value.id
        for node in ast.walk(tree)
        for target in targets(node)
        if field_of(target)[1] == 'phase'
    ]
    assert sorted(written) == sorted(
        ['REST', 'FLIGHT', 'SLIDE', 'ROLL', 'HOLED', 'WATER', 'OUT', 'FAILED']
    )


def test_the_collision_log_alone_writes_events_of_impacts():
    callers = {
        (place, function.name)
        for place, tree in trees()
        for function in functions(tree)
        for node in ast.walk(function)
        if isinstance(node, ast.Call) and ast.unparse(node.func).endswith('next_event')
    }
    assert callers == {('response/collision_log.py', 'log_impact'), LOGS_THE_END_OF_A_SHOT}
