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

"""Bags of test/data/bags, one of each kind of play: each shot runs again as it was recorded.

They were recorded by tools/record_bags.py with plain Python. Where the versions and the processor
are those of the recording the bits are the same, elsewhere all agrees to 1e-9.
"""

from pathlib import Path

from golf_sim_ros.course import load_course
from golf_sim_ros.recording.bag import read_bag
from golf_sim_ros.recording.journal import made_with
from golf_sim_ros.recording.replay import difference, rerun, shots, tick_of, world_of
import pytest

pytest.importorskip('rosbags')

BAGS = Path(__file__).parents[1] / 'data' / 'bags'
KINDS = {  # statuses of the shots, kinds of collision, kinds of input
    'one_ball': ({'at_rest'}, {'bounce'}, {'strike', 'rest'}),
    'several_balls': (
        {'at_rest', 'out_of_bounds'},
        {'ball', 'bounce'},
        {'strike', 'place', 'rest', 'drop'},
    ),
    'gusts': (
        {'at_rest', 'out_of_bounds'},
        {'bounce', 'out_of_bounds'},
        {'strike', 'wind', 'rest', 'drop'},
    ),
    'water_and_out_of_bounds': (
        {'at_rest', 'water', 'out_of_bounds'},
        {'bounce', 'water', 'out_of_bounds'},
        {'strike', 'rest', 'drop'},
    ),
    'pile': ({'at_rest'}, {'ball', 'bounce'}, {'strike', 'place', 'rest'}),
}
VERSIONS = ('python', 'numpy', 'processor')  # that the bits of plain Python depend on


@pytest.fixture(scope='module', params=KINDS)
def kind(request):
    return request.param


@pytest.fixture(scope='module')
def recording(kind):
    (found,) = read_bag(BAGS / kind)
    return found


def test_it_holds_what_it_is_of(kind, recording):
    statuses, collisions, inputs = KINDS[kind]
    assert {result['status'] for result in recording.results} - {'rejected'} == statuses
    assert {collision['kind'] for collision in recording.collisions} >= collisions
    assert {entry['kind'] for entry in recording.journal} == inputs | {'config'}
    assert all(len(track.times) > 10 for track in recording.tracks.values())


def test_each_shot_runs_again_as_it_was_recorded(kind, recording):
    course = BAGS / 'pit.yaml' if kind == 'pile' else None
    world, tick = world_of(recording, course), tick_of(recording)
    then, now = recording.config['made_with'], made_with()
    exact = all(then[name] == now[name] for name in VERSIONS)
    found = shots(recording)
    assert found and not any(shot.gap for shot in found)
    for shot in found:
        assert shot.rest and shot.strike['engine'] == 'python'
        assert difference(recording, shot, rerun(world, shot, tick), exact=exact) is None


def test_the_gusts_are_those_of_a_field_with_turbulence():
    (recording,) = read_bag(BAGS / 'gusts')
    assert load_course('links').wind_field is not None
    assert recording.config['parameters']['turbulence'] > 0.0
    assert sum(entry['kind'] == 'wind' for entry in recording.journal) > 20
    drifts = [entry['turbulence'] for entry in recording.journal if entry['kind'] == 'strike']
    assert len(drifts) == 2 and drifts[0][2:4] != drifts[1][2:4]


def test_five_balls_lean_on_each_other():
    (recording,) = read_bag(BAGS / 'pile')
    last = [entry for entry in recording.journal if entry['kind'] == 'rest']
    assert sum(entry['state']['position'][2] > 0.0 for entry in last) == 0
    assert len({entry['ball'] for entry in last}) == 5


def test_an_impact_that_rounding_has_moved_is_the_same_impact():
    (recording,) = read_bag(BAGS / 'one_ball')
    world, tick = world_of(recording), tick_of(recording)
    shot = shots(recording)[0]
    again = rerun(world, shot, tick)
    for by, same in ((1e-13, True), (1e-3, False)):
        moved = [{**told, 'time': told['time'] + by} for told in recording.collisions]
        other = recording._replace(collisions=moved)
        assert (difference(other, shot, again, exact=False) is None) == same
        assert difference(other, shot, again, exact=True) is not None


def test_of_impacts_at_one_instant_the_one_most_like_the_recorded_is_the_same():
    (recording,) = read_bag(BAGS / 'one_ball')
    world, tick = world_of(recording), tick_of(recording)
    shot = shots(recording)[0]
    again = rerun(world, shot, tick)
    number, first = again.impacts[0]
    other = first._replace(normal=(1.0, 0.0, 0.0), with_='wall')
    for by in (0.0, 1e-13):
        moved = [{**told, 'time': told['time'] + by} for told in recording.collisions]
        both = again._replace(impacts=[(number, other), *again.impacts])
        assert difference(recording._replace(collisions=moved), shot, both, exact=False) is None
        alone = again._replace(impacts=[(number, other), *again.impacts[1:]])
        found = difference(recording._replace(collisions=moved), shot, alone, exact=False)
        assert found.field == 'with of a collision'
