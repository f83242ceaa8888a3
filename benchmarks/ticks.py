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

"""Ticks of a world whose balls rest."""

from golf_sim_ros.physics import World
from golf_sim_ros.study.scenes import level
from shots import ground
from timing import lone, Row

TICKS = 2000
APART = 0.2  # m


def rows(quick):
    """`Row` of one ball and of a thousand."""
    for count in (1, 1000):
        names = tuple(f'ball{i}' for i in range(count))
        world = World(level(ground('green')), balls=names)
        for i, name in enumerate(names):
            world.place(name, (APART * (i % 32), APART * (i // 32)))
        world.advance(1.0)
        time = lone(lambda: [world.advance(0.004) for _ in range(TICKS)], TICKS)
        yield Row(f'a tick of {count} at rest', 1e6 * time, 'us', most=20.0)
