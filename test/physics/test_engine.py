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

"""Two engines for the same physics: plain Python at once, compiled code where play needs it."""

from collections import Counter
from copy import deepcopy
import importlib.util
import json
import os
from pathlib import Path
import subprocess
import sys
import time

from driving_range import DRIVE, HARD, level, random_shots, TURF
from golf_sim_ros.course import load_course, shipped_courses
from golf_sim_ros.physics import (
    Air,
    batch,
    EngineUnavailable,
    PowerProfile,
    Shot,
    simulate,
    simulate_many,
    World,
)
from golf_sim_ros.physics.engine import engines
from golf_sim_ros.physics.jit import build, GENERICS, ROLES
from golf_sim_ros.physics.jit.build import Build, BUILD_FAILED, Part, READY
import numpy as np
from other_process import run
import pytest

needs_numba = pytest.mark.skipif(
    bool(engines.missing()), reason=engines.missing() or 'numba is here'
)
COURSES = sorted(shipped_courses())
OTHER_COURSES = {
    'hard ground': level(HARD),
    'no air': level(TURF, air=Air(pressure=0.0)),
    'a power law': level(TURF, wind_profile=PowerProfile()),
    'gravity by name': level(TURF, effects=('gravity',)),
}
LEVEL_WIND = [  # courses without a wind field
    *(course for course in map(load_course, COURSES) if not course.wind_field),
    *OTHER_COURSES.values(),
]
ROOT = Path(__file__).parents[2]
PATIENCE = 600.0  # s: a child of low priority, beside other tests


@pytest.fixture
def programs(monkeypatch):
    """No program is known in this process yet, and 'auto' means auto."""
    monkeypatch.setattr(engines.Program, 'known', {})
    monkeypatch.delenv(engines.ENGINE_VARIABLE, raising=False)


def drive(world):
    """Where a drive ends."""
    world.strike('ball', *DRIVE)
    world.advance(60.0)
    return world['ball'].position


# Which engine plays


def test_an_unknown_engine_is_refused_with_the_known_ones():
    with pytest.raises(
        ValueError, match="engine 'fast' is unknown; known: auto, python, compiled"
    ):
        World(level(TURF), engine='fast')
    with pytest.raises(ValueError, match="engine 'fast' is unknown"):
        simulate_many(level(TURF), [DRIVE[0]], [DRIVE[1]], engine='fast')


def test_a_world_begins_in_plain_python(programs):
    world = World(level(TURF))
    drive(world)
    assert world.engine == 'python' and engines.Program.of(world.program).build is None


@needs_numba
def test_the_compiled_engine_takes_over_between_shots_where_plain_python_takes_long(
    programs, monkeypatch
):
    monkeypatch.setattr(engines, 'WORTH_COMPILING', 0.0)
    world = World(level(TURF))
    first = drive(world)
    assert world.engine == 'python'  # the build began with the first strike at the earliest
    world.reset()
    drive(world)
    program = engines.Program.of(world.program)
    assert program.build.wait(PATIENCE) and program.build.state == READY, program.build.reason
    world.reset()
    assert drive(world) == pytest.approx(first, abs=1e-9) and world.engine == 'compiled'
    assert simulate(level(TURF), Shot(*DRIVE)).result.position == pytest.approx(first, abs=1e-9)


def test_what_is_missing_is_said_once_where_plain_python_takes_long(programs, monkeypatch, caplog):
    monkeypatch.setattr(engines, 'WORTH_COMPILING', 0.0)
    for module in (engines, build):
        monkeypatch.setattr(module, 'missing', lambda: 'numba is not installed: pip install numba')
    world = World(level(TURF))
    for _ in range(3):
        drive(world)
        world.reset()
    assert world.engine == 'python'
    assert [record.getMessage().count('pip install numba') for record in caplog.records] == [1]


def test_without_numba_the_compiled_engine_is_refused_with_the_reason():
    told = run(refusal, plain=True)
    assert told in (
        'NUMBA_DISABLE_JIT is set',
        *([] if importlib.util.find_spec('numba') else [told]),
    )


def refusal():
    """Why there is no compiled engine where numba is switched off."""
    os.environ['NUMBA_DISABLE_JIT'] = '1'
    try:
        World(level(TURF), engine='compiled')
    except EngineUnavailable as error:
        return str(error)
    return ''


@needs_numba
def test_a_batch_is_compiled_where_it_has_many_shots_and_says_so(programs, monkeypatch, caplog):
    monkeypatch.setattr(batch, 'SHORT_WAIT', 0.0)
    monkeypatch.setattr(build, 'is_kept', lambda key: False)
    monkeypatch.setattr(engines, 'is_kept', lambda key: False)
    velocities, spins = random_shots(batch.MANY_SHOTS, seed=1)
    few = simulate_many(level(TURF), velocities[:3], spins[:3])
    assert not engines.Program.known and not caplog.records
    many = simulate_many(level(TURF), velocities, spins)
    (program,) = engines.Program.known.values()
    assert program.build.state == READY, program.build.reason
    assert f'compiling the physics for {batch.MANY_SHOTS} shots' in caplog.text
    np.testing.assert_allclose(many['position'][:3], few['position'], rtol=0, atol=1e-9)


def test_a_batch_is_played_in_plain_python_where_numba_is_missing_and_says_so(
    programs, monkeypatch, caplog
):
    monkeypatch.setattr(build, 'missing', lambda: 'numba is not installed: pip install numba')
    monkeypatch.setattr(batch, 'MANY_SHOTS', 20)
    simulate_many(level(TURF), *random_shots(20, seed=1))
    assert '20 shots in plain Python' in caplog.text and 'pip install numba' in caplog.text


# The same physics


@needs_numba
@pytest.mark.parametrize('name', COURSES)
def test_both_engines_end_a_shot_at_the_same_place(name):
    course, ends = load_course(name), []
    velocities, spins = random_shots(5, seed=3)
    for kind in ('python', 'compiled'):
        world = World(course, engine=kind)
        for velocity, spin in zip(velocities, spins):
            world.reset()
            world.strike('ball', velocity, spin)
            world.advance(300.0)
            ends.append((*world['ball'].position, world.time))
    np.testing.assert_allclose(ends[:5], ends[5:], rtol=1e-9, atol=1e-9)


def test_one_program_serves_every_course_with_one_ball_and_one_with_several():
    one, several = programs_of(LEVEL_WIND, 1), programs_of(LEVEL_WIND, 2)
    assert len(one) == 1 and len(several) == 2  # without balls that collide it is that of one ball
    assert one < several


def test_one_more_program_serves_every_course_with_a_wind_field():
    with_field = [course for course in map(load_course, COURSES) if course.wind_field]
    assert len(with_field) > 1
    assert len(programs_of(with_field, 1)) == 1
    assert not programs_of(with_field, 1) & programs_of(LEVEL_WIND, 1)


def programs_of(courses, balls):
    return {World(course, balls, engine='python').program for course in courses}


@needs_numba
def test_another_course_compiles_nothing():
    entries = engines.compiled_engine()[1:4]
    drive(World(LEVEL_WIND[0], engine='compiled'))
    compiled = [len(entry.signatures) for entry in entries]
    for course in LEVEL_WIND:
        drive(World(course, engine='compiled'))
    assert [len(entry.signatures) for entry in entries] == compiled


@needs_numba
def test_a_world_goes_on_with_the_other_engine_in_mid_flight():
    ends = []
    for first, then in (('python', 'python'), ('python', 'compiled'), ('compiled', 'python')):
        world = World(load_course('links'), engine=first)
        world.strike('ball', *DRIVE)
        world.advance(3.0)
        world.engine = then
        world.advance(60.0)
        ends.append(world['ball'].position)
    np.testing.assert_allclose(ends[1:], ends[:1] * 2, rtol=1e-9)


@needs_numba
def test_a_copy_of_a_world_shares_no_ball_with_it():
    world = World(load_course(COURSES[0]), engine='compiled')
    world.strike('ball', *DRIVE)
    world.advance(1.0)
    copied = deepcopy(world)
    world.advance(1.0)
    after_one, after_two = copied['ball'].position, world['ball'].position
    del world
    copied.advance(1.0)
    assert after_one != after_two == copied['ball'].position


@needs_numba
def test_a_record_that_is_changed_is_packed_anew():
    ends = []
    for kind in ('python', 'compiled'):
        world = World(load_course(COURSES[0]), engine=kind)
        world.strike('ball', *DRIVE)
        for wind in ((0.0, 5.0, 0.0), (0.0, -3.0, 0.0), (0.0, 0.0, 0.0)):
            world.advance(1.0)
            world.set_wind(wind)
        world.accuracy = 'sketch'
        world.advance(60.0)
        ends.append(world['ball'].position)
    np.testing.assert_allclose(*ends, rtol=1e-9)


# The child that compiles


@needs_numba
def test_a_compiler_that_aborts_is_a_reason_in_one_line(monkeypatch):
    monkeypatch.setattr(build, 'missing', lambda: '')
    monkeypatch.setattr(build, 'is_kept', lambda key: False)
    monkeypatch.setattr(build, 'numba_version', lambda: 'numba 0.65.0')
    aborted = Build(True, Part('nothing', os.abort, ()))
    assert aborted.wait(PATIENCE) and aborted.state == BUILD_FAILED
    assert aborted.reason.startswith(
        'numba 0.65.0 could not compile the physics (killed by SIGABRT): '
    )
    assert '\n' not in aborted.reason


@needs_numba
def test_a_compiler_that_raises_is_a_reason_in_one_line(monkeypatch):
    monkeypatch.setattr(build, 'missing', lambda: '')
    monkeypatch.setattr(build, 'is_kept', lambda key: False)
    monkeypatch.setattr(build, 'numba_version', lambda: 'numba 0.65.0')
    raised = Build(True, Part('nothing', json.loads, ('{',)))
    assert raised.wait(PATIENCE) and raised.state == BUILD_FAILED
    assert '(exit code 1): json.decoder.JSONDecodeError: Expecting property name' in raised.reason


def test_where_nothing_can_be_kept_nothing_is_compiled(monkeypatch, tmp_path):
    (tmp_path / 'file').touch()
    monkeypatch.setenv('GOLF_SIM_ROS_CACHE', str(tmp_path / 'file'))
    monkeypatch.setattr(build, 'missing', lambda: '')
    nowhere = Build(True, Part('nothing', os.abort, ()))
    assert nowhere.wait(PATIENCE) and nowhere.state == BUILD_FAILED
    assert nowhere.reason.startswith('GOLF_SIM_ROS_CACHE: ')


def test_a_child_ends_with_its_parent(tmp_path):
    code = (
        "import time; from golf_sim_ros.physics.jit import build; build.missing = lambda: ''; "
        "build.is_kept = lambda key: False; sleep = build.Part('key', time.sleep, (600.0,))\n"
        'one = build.Build(False, sleep)\n'
        'while not one.child: time.sleep(0.01)\n'
        'print(one.child.pid, flush=True); time.sleep(600.0)'
    )
    with subprocess.Popen(
        [sys.executable, '-c', code], cwd=ROOT, stdout=subprocess.PIPE
    ) as parent:
        child = int(parent.stdout.readline())
        parent.kill()
    deadline = time.monotonic() + PATIENCE
    while Path(f'/proc/{child}/cmdline').exists() and Path(f'/proc/{child}/cmdline').read_bytes():
        assert time.monotonic() < deadline, 'the child lives on'
        time.sleep(0.01)


def test_modules_of_effects_from_elsewhere_are_imported_by_the_child():
    assert run(modules_with_an_effect_of_ours) == ['effect_from_elsewhere']


def modules_with_an_effect_of_ours():
    """Modules that a child imports, once a test module has registered an effect."""
    from typing import NamedTuple

    from golf_sim_ros.physics.effects import protocol

    class Rain(NamedTuple):
        rate: float = 1.0

    def acceleration(effect, flow):
        return 0.0, 0.0, -effect.rate

    acceleration.__module__ = 'effect_from_elsewhere'
    protocol.acceleration.register(Rain)(acceleration)
    return [name for name in build.foreign_modules() if name != __name__]


def test_no_two_kernels_have_the_same_name():
    """Code that two processes compiled meets in a third; the same name is the same code there."""
    names = [(function.__module__, function.__qualname__) for function in ROLES]
    names += [(generic.__module__, f'choose_{generic.__name__}') for generic in GENERICS]
    assert [name for name, count in Counter(names).items() if count > 1] == []


@needs_numba
def test_code_in_a_folder_that_can_only_be_read_is_used_in_place():
    kept = World(level(TURF), engine='python').build(urgent=True)
    assert kept.wait(PATIENCE) and kept.state == READY, kept.reason
    assert run(compiled_where_nothing_can_be_written, plain=False) == 0


def compiled_where_nothing_can_be_written():
    """How many functions of ours a process compiles that may only read what is kept."""
    from golf_sim_ros.physics.jit import cache

    kept = cache.folder()._replace(writable=False)
    cache.folder = lambda: kept
    from numba.core import event

    compiled = []

    class Listener(event.Listener):
        """Notes whose functions are compiled."""

        def on_start(self, told):
            compiled.append(told.data['dispatcher'].py_func.__module__)

        def on_end(self, told):
            pass

    event.register('numba:compile', Listener())
    drive(World(level(TURF), engine='compiled'))
    return sum(module.startswith('golf_sim_ros') for module in compiled)
