# SPDX-License-Identifier: Apache-2.0
"""Ticks of a world whose balls rest."""
from golf_sim_ros.physics import World
from golf_sim_ros.study.scenes import level
from shots import ground
from timing import Row, lone

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
