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

"""The launch file with ROS's own launch: what the nodes that it starts have got."""

import os
from pathlib import Path
import signal
import subprocess
import sys
import threading

from golf_sim_ros.nodes.parameters import Parameters
from golf_sim_ros.nodes.wind_node import DEFAULTS
from processes import Process, wait_until
import pytest
from rcl_interfaces.srv import GetParameters
from rclpy.parameter import parameter_value_to_python

pytest.importorskip('launch_ros.actions', reason="ROS's launch is not installed")
ROOT = Path(__file__).parents[2]
SIM = {
    name: list(value) if isinstance(value, tuple) else value
    for name, value in {**Parameters()._asdict(), 'use_sim_time': False}.items()
}
WIND = {**DEFAULTS, 'use_sim_time': False}
LAUNCH = f"""
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
source = PythonLaunchDescriptionSource({str(ROOT / 'launch' / 'golf.launch.py')!r})
given = [tuple(word.split(':=', 1)) for word in sys.argv[1:]]
service = LaunchService(noninteractive=True)
service.include_launch_description(
    LaunchDescription([IncludeLaunchDescription(source, launch_arguments=given)]))
sys.exit(service.run())
"""


class Launch(Process):
    """`ros2 launch golf_sim_ros golf.launch.py` with arguments, as a process."""

    def __init__(self, *words):
        # for the nodes' Python
        path = f'{Path(sys.executable).parent}{os.pathsep}{os.environ["PATH"]}'
        environment = {**os.environ, 'NUMBA_DISABLE_JIT': '1', 'PATH': path}
        self.popen = subprocess.Popen(
            [sys.executable, '-u', '-c', LAUNCH, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=environment,
            start_new_session=True,
        )
        self.pid, self.lines = self.popen.pid, []
        self.reader = threading.Thread(
            target=lambda: self.lines.extend(self.popen.stdout), daemon=True
        )
        self.reader.start()


@pytest.fixture
def launched(domain, make_client):
    """Give a function that launches: the parameters that each node has got, by its name.

    It is called like ``launched('rate:=100', ...)``.
    """
    pytest.importorskip('ament_index_python')
    running = []

    def launch(*words, namespace='', nodes=('golf_sim', 'wind_generator')):
        process = Launch(*words)
        running.append(process)
        client = make_client(namespace)
        for node in nodes:
            ended = process.popen.poll
            wait_until(lambda: reachable(client, node) or ended() is not None, f'{node} was there')
            assert ended() is None, process.output
        names = {'golf_sim': SIM, 'wind_generator': WIND}
        return {node: values(client, node, names[node]) for node in nodes}, process

    yield launch
    for process in running:
        assert process.stop(signal.SIGINT) == 0, process.output
        started, ended = (
            process.output.count(text) for text in ('process started', 'finished cleanly')
        )
        assert started == ended, process.output


def reachable(client, node):
    """Whether `node` offers its parameters."""
    found = client.node.get_service_names_and_types()
    namespace = client.node.get_namespace().rstrip('/')
    return f'{namespace}/{node}/get_parameters' in [name for name, _ in found]


def values(client, node, names):
    """Parameters `names` of `node`; asked for again while they are being declared."""
    request, answer = GetParameters.Request(names=list(names)), []

    def told():
        answer[:] = client.call(GetParameters, f'{node}/get_parameters', request).values
        return len(answer) == len(names)

    wait_until(told, f'{node} told its parameters')
    return dict(zip(names, map(parameter_value_to_python, answer), strict=True))


def test_without_arguments_every_parameter_is_its_default(launched):
    got, process = launched()
    assert got == {'golf_sim': SIM, 'wind_generator': WIND}
    assert 'WARN' not in process.output


EACH = {
    'course:=links': {'course': 'links'},
    'accuracy:=sketch': {'accuracy': 'sketch'},
    'engine:=python': {'engine': 'python'},
    'balls:=red': {'balls': ['red']},
    'balls:=[red, blue]': {'balls': ['red', 'blue']},
    'balls:=red,blue': {'balls': ['red', 'blue']},
    'effects:=gravity': {'effects': ['gravity']},
    'effects:=[gravity, drag]': {'effects': ['gravity', 'drag']},
    'rate:=100': {'rate': 100.0},
    'publish_rate:=20.5': {'publish_rate': 20.5},
    'real_time_factor:=0': {'real_time_factor': 0.0},
    'publish_clock:=false': {},
}


@pytest.mark.parametrize('word', EACH)
def test_an_argument_alone_changes_its_parameter_and_no_other(launched, word):
    got, _ = launched(word, 'wind:=false', nodes=['golf_sim'])
    assert got['golf_sim'] == {**SIM, **EACH[word]}


def test_with_publish_clock_the_wind_follows_simulated_time(launched):
    got, _ = launched('publish_clock:=true')
    assert got['golf_sim'] == {**SIM, 'publish_clock': True}
    assert got['wind_generator'] == {**WIND, 'use_sim_time': True}


OF_SIM = {
    'course': 'links',
    'rate': 200.0,
    'publish_rate': 25.0,
    'real_time_factor': 2.0,
    'accuracy': 'sketch',
    'effects': ['gravity', 'drag'],
    'balls': ['one', 'two'],
    'frame_id': 'map',
    'parent_frame': 'earth',
    'publish_tf': False,
    'publish_clock': True,
    'engine': 'python',
    'turbulence': 0.2,
    'turbulence_seed': 3,
    'use_sim_time': False,
}
assert OF_SIM.keys() == SIM.keys(), 'a parameter is missing here'
OF_WIND = {
    'speed': 8.0,
    'speed_spread': 1.0,
    'direction': 0.5,
    'direction_spread': 0.25,
    'interval': 5.0,
    'ramp': 2.0,
    'turbulence': 0.1,
    'seed': 7,
    'publish_rate': 5.0,
    'frame_id': 'map',
    'use_sim_time': False,
}


def written(path, **nodes):
    """Path of a params file with these parameters of each node, under `/**/`."""
    lines = [f'/**/{node}:\n  ros__parameters: {given!r}\n' for node, given in nodes.items()]
    path.write_text(''.join(lines))
    return path


@pytest.fixture
def file(tmp_path):
    """Write a params file that changes every parameter of both nodes."""
    return written(tmp_path / 'params.yaml', golf_sim=OF_SIM, wind_generator=OF_WIND)


def test_what_is_left_out_overrides_nothing_of_a_params_file(launched, file):
    got, process = launched(f'params_file:={file}')
    assert got == {'golf_sim': OF_SIM, 'wind_generator': OF_WIND}
    assert 'WARN' not in process.output


def test_arguments_override_the_params_file_and_the_winds_file_that_of_both(
    launched, file, tmp_path
):
    own = written(tmp_path / 'wind.yaml', wind_generator={'speed': 3})
    got, _ = launched(
        f'params_file:={file}',
        f'wind_params_file:={own}',
        'namespace:=game',
        'rate:=100',
        'balls:=three',
        'course:=putting_green',
        namespace='/game',
    )
    assert got['golf_sim'] == {
        **OF_SIM,
        'rate': 100.0,
        'balls': ['three'],
        'course': 'putting_green',
    }
    assert got['wind_generator'] == {**OF_WIND, 'speed': 3.0}


def test_arguments_override_even_a_params_file_that_names_the_node_in_full(launched, tmp_path):
    file = tmp_path / 'params.yaml'
    file.write_text('/game/golf_sim: {ros__parameters: {rate: 200, publish_rate: 25}}')
    got, _ = launched(
        f'params_file:={file}',
        'namespace:=/game',
        'rate:=100',
        'wind:=0',
        namespace='/game',
        nodes=['golf_sim'],
    )
    assert got['golf_sim'] == {**SIM, 'rate': 100.0, 'publish_rate': 25.0}


def test_the_former_name_of_the_winds_file_still_works(launched, tmp_path):
    file = written(tmp_path / 'wind.yaml', wind_generator={'speed': 3})
    got, _ = launched(f'wind_params:={file}')
    assert got == {'golf_sim': SIM, 'wind_generator': {**WIND, 'speed': 3.0}}


def test_log_level_is_that_of_both_nodes(launched):
    _, process = launched('log_level:=warn')
    assert not [
        line for line in process.lines if 'golf_sim]:' in line or 'wind_generator]:' in line
    ]


def nothing(*words):
    """Find the only error of a launch that starts nothing."""
    process = Launch(*words)
    assert process.wait() == 1, process.output
    assert 'process started' not in process.output
    (line,) = [line for line in process.lines if 'ERROR' in line]
    assert process.lines[-1] == line
    return line


def test_rviz_that_is_not_installed_starts_nothing_and_says_so_in_one_line(domain):
    from ament_index_python.packages import get_packages_with_prefixes

    if 'rviz2' in get_packages_with_prefixes():
        pytest.skip('rviz2 is installed')
    assert 'rviz:=true needs the package rviz2' in nothing('rviz:=true')


RVIZ = """#!/bin/sh
trap 'exit 0' INT TERM
for word in "$@"; do [ -f "$word" ] && cat "$word"; done > {heard}.part
echo "$@" >> {heard}.part
mv {heard}.part {heard}
while :; do sleep 0.1; done
"""


@pytest.fixture
def heard_by_rviz(tmp_path, monkeypatch):
    """File with what a program in place of rviz2 has got.

    All files among its arguments, then these.
    """
    heard, program = tmp_path / 'heard', tmp_path / 'lib' / 'rviz2' / 'rviz2'
    index = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages'
    for folder in (index, program.parent):
        folder.mkdir(parents=True)
    (index / 'rviz2').touch()
    program.write_text(RVIZ.format(heard=heard))
    program.chmod(0o755)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path), prepend=os.pathsep)
    return heard


@pytest.mark.parametrize('follows', ['true', 'false'])
def test_rviz_gets_the_view_the_namespace_and_simulated_time(launched, heard_by_rviz, follows):
    launched(
        'rviz:=true',
        f'publish_clock:={follows}',
        'namespace:=game',
        'wind:=false',
        'log_level:=warn',
        namespace='/game',
        nodes=['golf_sim'],
    )
    wait_until(heard_by_rviz.exists, 'RViz was started')
    heard = heard_by_rviz.read_text()
    assert (
        'rviz_default_plugins' in heard and '__ns:=/game' in heard and '--log-level warn' in heard
    )
    assert ('use_sim_time: true' in heard) == (follows == 'true')


@pytest.mark.parametrize(
    'word',
    [
        'params_file:=/none.yaml',
        'wind_params_file:=/none.yaml',
        'wind:=maybe',
        'publish_clock:=maybe',
        'balls:=[a',
        'effects:=[drag, [gravity]]',
        'balls:=[]',
    ],
)
def test_an_argument_that_cannot_be_used_starts_nothing_and_is_one_line(domain, word):
    assert word in nothing(word)


def test_a_value_that_the_sim_refuses_ends_the_whole_launch_with_its_line(domain):
    process = Launch('rate:=fast')
    process.wait()
    (line,) = [line for line in process.lines if 'FATAL' in line]
    assert "rate must be a number, as in 2.5; it is 'fast'" in line
    assert 'wind_node-2]: process has finished cleanly' in process.output
