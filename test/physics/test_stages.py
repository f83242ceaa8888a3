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

"""Where the engine's time goes: counted by stage, and only where somebody asks."""

from driving_range import level, TURF
from golf_sim_ros.physics import cycles_now, World
from other_process import run


def spent(balls, velocity, seconds):
    """Play the first `seconds` of a strike among `balls`: counts by stage, and all that passed."""
    world = World(level(TURF), balls)
    world.measure()
    began = cycles_now()
    world.strike('ball_0', velocity)
    world.advance(seconds)
    return world.spent, cycles_now() - began


def cases():
    """`spent` of a ball that flies, of one that rolls, of one of two that flies."""
    return (
        spent(1, (30.0, 0.0, 20.0), 1.0),
        spent(1, (2.0, 0.0, 0.0), 0.1),
        spent(2, (30.0, 0.0, 20.0), 1.0),
    )


def test_time_is_booked_on_the_stage_it_is_spent_in():
    (flying, _), (rolling, _), (together, _) = run(cases)
    assert flying['flight'] > flying['contact'] and rolling['contact'] > rolling['flight']
    assert together['broad phase'] > 0


def test_no_more_is_booked_than_passes():
    for stages, passed in run(cases):
        assert 0 < sum(stages.values()) <= passed


def test_nothing_is_booked_unless_somebody_asks():
    world = World(level(TURF))
    assert world.spent == {}
