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

"""Ticks of a world: of a ball in flight, and of balls that rest."""

from golf_sim_ros.physics import World
from golf_sim_ros.study.scenes import level
from shots import ground
from timing import lone, Row

TICKS = 2000
TICK = 0.004  # s
FLOWN = 1000  # ticks of a drive
DRIVE = (60.0, 0.0, 14.0), (0.0, -280.0, 0.0)  # m/s, rad/s
APART = 0.2  # m


def rows(quick):
    """`Row` of a ball in flight, of one at rest and of a thousand."""
    yield Row('a tick of 1 in flight', 1e6 * in_flight(), 'us', most=15.0)
    for count in (1, 1000):
        names = tuple(f'ball{i}' for i in range(count))
        world = World(level(ground('green')), balls=names)
        for i, name in enumerate(names):
            world.place(name, (APART * (i % 32), APART * (i // 32)))
        world.advance(1.0)
        time = lone(lambda: [world.advance(TICK) for _ in range(TICKS)], TICKS)
        yield Row(f'a tick of {count} at rest', 1e6 * time, 'us', most=20.0)


def in_flight():
    """Processor time [s] of a tick at 250 Hz, over the first seconds of a drive."""
    world = World(level(ground('green')))

    def fly():
        world.reset()
        world.strike('ball', *DRIVE)
        for _ in range(FLOWN):
            world.advance(TICK)

    return lone(fly, FLOWN)
