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

"""What people type: every line of the table in docs/interface.md, and params files."""

import os
from pathlib import Path
import re
import shlex
import threading

from golf_sim_ros import __version__
from golf_sim_ros.nodes.command_line import only_for_all_nodes
from golf_sim_ros.nodes.parameters import Parameters
from golf_sim_ros.nodes.wind_node import DEFAULTS
from processes import READY
import pytest
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParametersAtomically
from rclpy.parameter import get_parameter_value, Parameter, parameter_value_to_python

ROOT = Path(__file__).parents[2]
# Starts at once, with numba or without.
PLAIN = {
    'NUMBA_DISABLE_JIT': '1',
    'PYTHONWARNINGS': 'ignore:numba is not installed:RuntimeWarning',
}
BEGUN = {'sim_node': READY, 'wind_node': 'the same gusts come again'}
NODE = {'sim_node': 'golf_sim', 'wind_node': 'wind_generator'}


def table():
    """Rows of the table: what is typed, and what happens."""
    text = (ROOT / 'docs' / 'interface.md').read_text(encoding='utf-8')
    section = text.partition('### What people type')[2].partition('\n### ')[0]
    return [
        (typed.replace('PARAMS', '--ros-args -p'), answer)
        for typed, answer in re.findall(r'^\| `(.+?)` \| (.+) \|$', section, re.MULTILINE)
    ]


ROWS = dict(table())
COURSE_LINKS = ROWS['sim_node course:=links']


def rows(pattern):
    """Return what is typed in the rows whose answer matches `pattern`."""
    found = [typed for typed, answer in ROWS.items() if re.match(pattern, answer)]
    return pytest.mark.parametrize('typed', found)


def quoted(answer):
    """Return what the program writes, according to an answer."""
    return re.search(r'`(.*)`', COURSE_LINKS if answer.endswith('the same') else answer).group(1)


@pytest.fixture
def began(start):
    """Give a function that starts a node: its process once it runs; it ends with the test."""
    processes = []

    def begin(program, *arguments):
        processes.append(start(program, *arguments, environment=PLAIN))
        processes[-1].wait_for(BEGUN[program])
        return processes[-1]

    yield begin
    assert [process.stop() for process in processes] == [0] * len(processes)


def value_of(client, node, name):
    """Value of a parameter of the node `node`, as Python has it."""
    answer = client.call(
        GetParameters, f'{node}/get_parameters', GetParameters.Request(names=[name])
    )
    return parameter_value_to_python(answer.values[0])


def assert_is(value, answer):
    """Check that `value` is what the answer says, of the same type."""
    assert repr(value) == re.search(r' is (.*)$', answer).group(1)


def test_the_table_has_nothing_that_no_test_here_reads():
    kinds = r'`\w+` is |refused: |a warning: |exit code \d: |a remapping'
    assert len(ROWS) == len(table()) > 30
    assert not [answer for answer in ROWS.values() if not re.match(kinds, answer)]


def typed_live(typed):
    return typed.startswith('ros2 param set')


@pytest.mark.parametrize(
    'typed',
    [
        typed
        for typed, answer in ROWS.items()
        if re.match(r'`\w+` is ', answer) and not typed_live(typed)
    ],
)
def test_a_parameter_takes_what_is_typed(began, client, typed):
    program, *arguments = shlex.split(typed)
    process = began(program, *arguments)
    name = re.match('`(.*?)`', ROWS[typed]).group(1)
    assert_is(value_of(client, NODE[program], name), ROWS[typed])
    assert 'WARN' not in process.output


@rows('exit code')
def test_what_cannot_be_used_is_one_line_and_the_exit_code_says_whose_fault_it_is(start, typed):
    program, *arguments = shlex.split(typed)
    process = start(program, *arguments, environment=PLAIN)
    assert process.wait() == int(re.match(r'exit code (\d)', ROWS[typed]).group(1))
    assert quoted(ROWS[typed]) in process.lines[0]
    assert '--help' in arguments or len(process.lines) == 1, process.output


@rows('a warning|a remapping')
def test_what_may_be_meant_is_one_warning_and_the_node_runs(began, typed):
    program, *arguments = shlex.split(typed)
    process = began(program, *arguments)
    (line,) = [line for line in process.lines if 'WARN' in line]
    assert quoted(ROWS[typed]) in line


@pytest.fixture(scope='module')
def live(start):
    """Both nodes, for what is set while they run."""
    for program in NODE:
        start(program, '--ros-args', '-r', '__ns:=/live', environment=PLAIN).wait_for(
            BEGUN[program]
        )


@pytest.mark.parametrize('typed', [typed for typed in ROWS if typed_live(typed)])
def test_ros2_param_set_takes_what_is_typed_or_says_why_not(live, make_client, typed):
    client, answer = make_client('/live'), ROWS[typed]
    node, name, text = shlex.split(typed)[3:]
    result = set_parameter(client, node, name, get_parameter_value(string_value=text))
    if answer.startswith('refused'):
        assert not result.successful and quoted(answer) in result.reason
    else:
        assert result.successful, result.reason
        assert_is(value_of(client, node, name), answer)


def set_parameter(client, node, name, value):
    """Set one parameter as `ros2 param set` does: the result."""
    parameter = Parameter(name).to_parameter_msg()
    parameter.value = value
    request = SetParametersAtomically.Request(parameters=[parameter])
    return client.call(
        SetParametersAtomically, f'{node}/set_parameters_atomically', request
    ).result


@pytest.mark.parametrize(
    'node, defaults', [('golf_sim', Parameters()._asdict()), ('wind_generator', DEFAULTS)]
)
def test_types_and_ranges_are_described_as_ever(live, make_client, node, defaults):
    kinds = {
        float: ParameterType.PARAMETER_DOUBLE,
        int: ParameterType.PARAMETER_INTEGER,
        bool: ParameterType.PARAMETER_BOOL,
        str: ParameterType.PARAMETER_STRING,
        tuple: ParameterType.PARAMETER_STRING_ARRAY,
    }
    request = DescribeParameters.Request(names=list(defaults))
    told = (
        make_client('/live')
        .call(DescribeParameters, f'{node}/describe_parameters', request)
        .descriptors
    )
    for descriptor, default in zip(told, defaults.values(), strict=True):
        assert descriptor.type == kinds[type(default)] and not descriptor.dynamic_typing
        assert len(descriptor.floating_point_range) == isinstance(default, float)
        assert descriptor.description


def test_help_names_every_parameter_with_its_default(start):
    for program, defaults in (('sim_node', Parameters()._asdict()), ('wind_node', DEFAULTS)):
        process = start(program, '--help', environment=PLAIN)
        assert process.wait() == 0
        words = [line.split() for line in process.lines]
        for name, default in defaults.items():
            shown = f'[{", ".join(default)}]' if isinstance(default, tuple) else str(default)
            assert [name, shown.lower()] in [line[:2] for line in words]


def test_version_is_that_of_the_package(start):
    process = start('sim_node', '--version', environment=PLAIN)
    assert process.wait() == 0 and process.output == f'golf_sim_ros {__version__}\n'


BAD_FILES = {
    'no YAML': ('a: [', "Couldn't parse params file"),
    'no parameters': ('a: 1', 'Cannot have a value before ros__parameters'),
    'not of this world': ('\x00\x01', "Couldn't parse params file"),
}


@pytest.mark.parametrize('program', NODE)
@pytest.mark.parametrize('case', BAD_FILES)
def test_a_malformed_params_file_is_one_line(start, tmp_path, program, case):
    content, reason = BAD_FILES[case]
    file = tmp_path / 'params.yaml'
    file.write_text(content)
    process = start(program, '--ros-args', '--params-file', str(file), environment=PLAIN)
    assert process.wait() == 1
    (line,) = process.lines
    assert str(file) in line and reason in line


def test_a_folder_as_params_file_is_one_line(start, tmp_path):
    process = start('wind_node', '--ros-args', '--params-file', str(tmp_path), environment=PLAIN)
    assert process.wait() == 1
    (line,) = process.lines
    assert f'{tmp_path}: is a folder' in line


SHARED = """
/**:
  ros__parameters: {of_all: 1, speed: 7, both_say: 1}
/**/wind_generator:
  ros__parameters: {sped: 3, interval: 5, deep: {er: 1}}
/**/golf_sim:
  ros__parameters: {ratte: 3, rate: 100, both_say: 1}
"""


def test_a_params_file_for_many_nodes_warns_only_of_what_it_says_to_the_node_itself(
    began, client, tmp_path
):
    file = tmp_path / 'params.yaml'
    file.write_text(SHARED)
    wrong = {}
    for program in NODE:
        process = began(program, '--ros-args', '--params-file', str(file))
        wrong[program] = [
            re.search(r"parameter '(.*?)'", line).group(1)
            for line in process.lines
            if 'WARN' in line
        ]
    assert {program: sorted(names) for program, names in wrong.items()} == {
        'sim_node': ['both_say', 'ratte'],
        'wind_node': ['deep.er', 'sped'],
    }
    assert value_of(client, 'golf_sim', 'rate') == 100.0
    assert value_of(client, 'wind_generator', 'interval') == 5.0
    assert value_of(client, 'wind_generator', 'speed') == 7.0


def test_what_is_typed_for_one_node_is_not_only_for_all(tmp_path):
    file = tmp_path / 'params.yaml'
    file.write_text('ns:\n  /*: {ros__parameters: {a: 1, b: 2, c: 3}}\n')
    words = [
        '--ros-args',
        '--params-file',
        str(file),
        '-p',
        'a:=1',
        '-p',
        'me:b:=2',
        '--',
        '-p',
        'c:=3',
    ]
    assert only_for_all_nodes(words, 'me') == {'c'}


def test_a_mistyped_name_in_somebodys_launch_file_is_a_warning(began, tmp_path):
    # as launch_ros names and writes what a Node's `parameters` say
    file = tmp_path / 'launch_params_x7a'
    file.write_text('/**:\n  ros__parameters: {sped: 3}\n')
    process = began('wind_node', '--ros-args', '--params-file', str(file))
    (line,) = [line for line in process.lines if 'WARN' in line]
    assert "parameter 'sped' is unknown and does nothing; nearest known: speed" in line


def test_a_params_file_may_be_a_pipe(began, client, tmp_path):
    pipe = tmp_path / 'pipe'
    os.mkfifo(pipe)
    writer = threading.Thread(
        target=pipe.write_text,
        args=('wind_generator: {ros__parameters: {speed: 9}}\n',),
        daemon=True,
    )
    writer.start()
    began('wind_node', '--ros-args', '--params-file', str(pipe))
    assert value_of(client, 'wind_generator', 'speed') == 9.0
