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

"""Balls as JSON; no ROS."""

import json

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import World
from golf_sim_ros.recording.journal import opened, sealed
from golf_sim_ros.recording.json_format import state_text


def test_a_state_is_written_as_it_is_at_every_tick():
    world = World(load_course('golf_without_friends'), 4)
    for number, name in enumerate(world.names[:3]):  # the last one rests
        world.strike(name, (4.0 + number, 0.1, 3.0), (0.0, -100.0, 20.0))
    clock = set()
    while world.moving:
        world.advance(0.1)
        state = json.loads(json.dumps(world.state()))
        clock.add(state['clock'])
        assert opened(sealed({'entry': 0, **state_text(world)})) == {'entry': 0, **state}
    assert len(clock) > 20
