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

"""Hard cases: each YAML file in hard_cases/ holds a course, and plays with expected answers.

A case puts the ball down (`place`, with `velocity` and `spin`), or strikes it as well (`strike`,
`spin`), and says how it `ends` once it stops, or at `until`; `first` is the first collision,
`result` what is told of the shot; null is any number. `level`: the greatest vertical speed on the
way [m/s]. Whatever a case says, its ball stays finite, out of the ground, on the ground when it
rests, and gains no energy in still air.
"""

from pathlib import Path

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import ACCURACY, Collision, Phase, Result, World
import numpy as np
import pytest
from scene import depth, energy, touches
import yaml

CASES = [
    (file, case)
    for file in sorted(Path(__file__).with_name('hard_cases').glob('*.yaml'))
    for case in yaml.safe_load(file.read_text())['cases']
]
TICK = 0.01  # s
PATIENCE = 400.0  # s of simulated time after which a ball should have stopped
LIFT = 2e-5  # J/kg: what putting a ball exactly on its surface, 1e-6 m higher at most, may give it


@pytest.fixture(scope='module')
def course_of(tmp_path_factory):
    """Course of a file of cases, read once."""
    known = {}

    def read(file):
        if file not in known:
            path = tmp_path_factory.mktemp('course') / file.name
            path.write_text(
                yaml.safe_dump({'format': 1, **yaml.safe_load(file.read_text())['course']})
            )
            known[file] = load_course(path)
        return known[file]

    return read


@pytest.mark.parametrize(
    'file, case', CASES, ids=[f'{file.stem}: {case["name"]}' for file, case in CASES]
)
def test_a_hard_case_ends_as_expected(file, case, course_of):
    world = start(course_of(file), case)
    events = play(world, case)
    if 'first' in case:
        first = next(event for event in events if isinstance(event, Collision))
        matches(case['first'], first.position, first.velocity_before)
    if 'result' in case:
        (result,) = (event for event in events if isinstance(event, Result))
        assert result.status == case['result']['status']
        matches(case['result'], result.position, ())
    ends = case['ends']
    ball = world['ball']
    assert ball.phase == Phase[ends.get('phase', ball.phase.name)]
    assert ball.lie == ends.get('lie', ball.lie)
    matches(ends, ball.position, ball.velocity)
    if ball.phase == Phase.REST:
        assert touches(world.course, ball.position), f'rests on nothing at {ball.position}'


@pytest.mark.parametrize(
    'file, case',
    [pair for pair in CASES if 'accuracy' not in pair[1]],
    ids=[f'{file.stem}: {case["name"]}' for file, case in CASES if 'accuracy' not in case],
)
def test_a_hard_case_is_as_stable_with_the_roughest_preset(file, case, course_of):
    play(start(course_of(file), {**case, 'accuracy': 'sketch'}), {**case, 'tick': 0.001})


def allowed_depth(accuracy):
    """Depth [m] that a ball may be in the ground: what the preset lets a path be off, or 2e-6."""
    return max(2e-6, ACCURACY[accuracy].limits.path)


def start(course, case):
    """World of a case, its ball under way."""
    course = course._replace(effects=case.get('effects', ('gravity',)))
    world = World(
        course, accuracy=case.get('accuracy', 'standard'), wind=case.get('wind', (0, 0, 0))
    )
    if 'place' in case:
        calm = 'strike' in case
        world.place(
            'ball', case['place'], *(() if calm else (case.get('velocity'), case.get('spin')))
        )
    if 'strike' in case:
        world.strike('ball', case['strike'], case.get('spin', (0, 0, 0)))
    return world


def play(world, case):
    """Let the case run; return what happened."""
    events, last = [], energy(world.course, world['ball'])
    deepest = allowed_depth(world.accuracy)
    until = case.get('until')
    while world.time < (until or PATIENCE) - 1e-9 and (until or world.moving):
        tick = min(case.get('tick', TICK), (until or PATIENCE) - world.time)
        events += world.advance(tick)
        ball = world['ball']
        assert np.isfinite((*ball.position, *ball.velocity, *ball.spin)).all(), world.time
        if ball.phase != Phase.OUT:
            assert depth(world.course, ball.position) < deepest, (world.time, ball)
        assert abs(ball.velocity[2]) <= case.get('level', np.inf), (world.time, ball)
        now = energy(world.course, ball)
        if 'wind' not in case and ball.phase != Phase.OUT:
            assert now <= last + 1e-9 * abs(last) + LIFT, (world.time, now - last, ball)
        last = now
    assert until or not world.moving, 'does not end'
    return events


def matches(expected, position, velocity):
    """Assert that what is expected of position and velocity is so."""
    for name, found in (('position', position), ('velocity', velocity)):
        for wanted, number in zip(expected.get(name, ()), found):
            if wanted is not None:
                assert number == pytest.approx(wanted, rel=0, abs=expected['within']), (
                    name,
                    found,
                )
