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

"""The compiled engine takes over from plain Python by itself where play calls for it, over DDS."""

import signal

from diagnostic_msgs.msg import DiagnosticArray
from golf_sim_ros.cli.resimulate import main
from golf_sim_ros.physics.engine.engines import missing
from processes import parameters, READY, wait_until
import pytest

BALLS = [f'b{number}' for number in range(20)]
SPIN = (0.0, -280.0, 0.0)
needs_numba = pytest.mark.skipif(bool(missing()), reason=missing() or 'numba is here')


def values(messages):
    """Find what the last of the diagnostics said of the engine."""
    told = {value.key: value.value for value in messages[-1].status[0].values}
    return told['engine'], told['engine, why']


def strike_all(golfers, number):
    """Strike every ball, as never before, and wait for all results."""
    strikes = [
        (round(36.0 + 0.01 * number, 2), round(0.1 * i - 1.0, 1), 14.0)
        for i in range(len(golfers))
    ]
    golfers[0].reset()
    for golfer, strike in zip(golfers, strikes):
        golfer.strike(strike, SPIN)
    for golfer, strike in zip(golfers, strikes):
        wait_until(lambda: golfer.results_of(strike, SPIN), f'the result of {strike} came')


@needs_numba
def test_with_twenty_balls_the_compiled_engine_takes_over_between_shots_and_the_bag_is_identical(
    start, make_golfer, tmp_path, capsys
):
    pytest.importorskip('rosbags')
    sim = start('sim_node', *parameters('/crowd', balls=f'[{",".join(BALLS)}]'))
    sim.wait_for(READY)
    golfers = [make_golfer('/crowd', name) for name in BALLS]
    told = golfers[0].listen(DiagnosticArray, '/diagnostics')
    recorder = start('cli.record_play', '--output', str(tmp_path / 'bag'), '--namespace', '/crowd')
    recorder.wait_for('recording')
    played = 0
    while 'takes over' not in sim.output and played < 30:
        strike_all(golfers, played)
        played += 1
    assert 'a child process compiles the physics' in sim.output, sim.output
    line = sim.wait_for('the compiled engine takes over: the play in plain Python took ')
    wait_until(lambda: values(told)[0] == 'compiled', 'the diagnostics said so')
    assert values(told)[1] in line
    strike_all(golfers, played)
    assert recorder.stop() == 0 and sim.stop() == 0
    capsys.readouterr()
    assert main([str(tmp_path / 'bag')]) == 0
    lines = capsys.readouterr().out.splitlines()
    shots = 20 * (played + 1)
    assert lines[-1] == f'{shots} of {shots} identical'


def test_with_one_ball_nothing_is_compiled_and_nothing_of_a_compiler_is_loaded(
    start, make_golfer, tmp_path
):
    cache = tmp_path / 'cache'
    sim = start('sim_node', *parameters('/alone'), environment={'GOLF_SIM_ROS_CACHE': str(cache)})
    sim.wait_for(READY)
    golfer = make_golfer('/alone')
    told = golfer.listen(DiagnosticArray, '/diagnostics')
    golfer.play((40.0, 0.0, 15.0), (0.0, -200.0, 0.0))
    assert 'compil' not in sim.output and not cache.exists()
    with open(f'/proc/{sim.pid}/maps') as maps:
        assert 'llvmlite' not in maps.read()
    wait_until(lambda: told, 'diagnostics came')
    assert values(told)[0] == 'python'


@needs_numba
def test_a_compiler_that_cannot_be_had_is_one_line_and_the_play_goes_on(
    start, make_golfer, tmp_path
):
    (tmp_path / 'file').touch()
    sim = start(
        'sim_node',
        *parameters('/stubborn', rate=10000.0, real_time_factor=2.0),
        environment={'GOLF_SIM_ROS_CACHE': str(tmp_path / 'file')},
    )
    sim.wait_for(READY)
    golfer = make_golfer('/stubborn')
    golfer.play((25.0, 0.0, 15.0))
    line = sim.wait_for(', and goes on so: ')
    assert 'GOLF_SIM_ROS_CACHE' in line and 'WARN' in line
    golfer.play((10.0, 0.0, 5.0))
    assert sim.stop() == 0 and 'Traceback' not in sim.output


def test_the_compiled_engine_that_is_asked_for_and_cannot_be_had_is_a_refusal(start):
    sim = start(
        'sim_node',
        *parameters('/refused', engine='compiled'),
        environment={'NUMBA_DISABLE_JIT': '1'},
    )
    assert sim.wait() == 1
    fatal = [line for line in sim.lines if 'FATAL' in line]
    assert len(fatal) == 1 and "engine 'compiled' cannot be had: " in fatal[0]


@needs_numba
@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_a_sim_that_waits_for_the_compiler_with_exit_code_0(start, tmp_path, number):
    sim = start(
        'sim_node',
        *parameters('/compiling', engine='compiled'),
        environment={'GOLF_SIM_ROS_CACHE': str(tmp_path), 'NUMBA_DISABLE_JIT': '0'},
    )
    sim.wait_for('waiting for the physics to be compiled')
    assert sim.stop(number) == 0
    assert 'Traceback' not in sim.output
