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

"""Random shots on every shipped course by both engines, and how far apart they end.

Each shot has a wind of its own; every fourth is played with a second ball that is struck at the
same time.
"""

import argparse
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
import sys

from golf_sim_ros.course import load_course, shipped_courses
from golf_sim_ros.physics import Collision, Result, World
import numpy as np

CLOSE = 1e-9  # relative, or absolute below 1 m
KINDS = 'drive', 'iron', 'chip', 'putt', 'anything'
LONGEST = 1000.0  # s; every shot is over long before


def main(args=None):
    """Compare; the exit code is 0 where every shot agrees or parts at a ball or an edge."""
    options = parser().parse_args(args)
    jobs = [
        (course, seed)
        for course in sorted(shipped_courses())
        for seed in range(options.shots // len(shipped_courses()))
    ]
    counts, bad = Counter(), []
    with ProcessPoolExecutor(options.jobs) as pool:
        for job, (verdict, apart) in zip(jobs, pool.map(compared, jobs, chunksize=10)):
            counts[job[0], verdict] += 1
            if verdict == 'apart':
                bad.append((*job, apart))
    for (course, verdict), count in sorted(counts.items()):
        print(f'{course:24}{verdict:40}{count:6}')
    for course, seed, apart in bad:
        print(f'{course} {seed}: {apart:.3g} apart')
    return 1 if bad else 0


def parser():
    """Reader of the command line."""
    reader = argparse.ArgumentParser(description=__doc__)
    reader.add_argument('--shots', type=int, default=2000, help='in all (default: 2000)')
    reader.add_argument('--jobs', type=int, default=2, help='processes (default: 2)')
    return reader


def compared(job):
    """Play one shot by both engines: what came of it, how far apart [m] its balls came to rest."""
    course, seed = job
    plain, machine = (
        played(load_course(course), seed, engine) for engine in ('python', 'compiled')
    )
    apart = max(
        (abs(np.subtract(one, other)) / np.maximum(1.0, np.abs(one))).max()
        for one, other in zip(plain[0], machine[0])
    )
    if plain == machine:
        return 'same to the bit', 0.0
    if apart <= CLOSE:
        return f'same to {CLOSE:g}', apart
    kinds = {event.kind for event in plain[1] if isinstance(event, Collision)}
    touchy = sorted(kinds & {'ball', 'cup', 'flagstick', 'obstacle'})
    return (f'parts after {" and ".join(touchy)}' if touchy else 'apart'), apart


def played(course, seed, engine):
    """Where the balls of a shot rest, and what happened."""
    rng = np.random.default_rng(seed)
    kind, wind = KINDS[seed % len(KINDS)], rng.normal(0.0, 4.0, 2) * (seed % 3 > 0)
    balls = ('a', 'b') if seed % 4 == 0 else ('a',)
    world = World(course, balls, wind=(*wind, 0.0), engine=engine)
    for name in balls:
        world.strike(name, *strike(kind, rng))
    events = world.advance(LONGEST)
    return [world[name].position for name in balls], [
        e for e in events if isinstance(e, (Collision, Result))
    ]


def strike(kind, rng):
    """Velocity and spin of a random shot of a kind."""
    speed, low, high, spin = {
        'drive': (70.0, 0.1, 0.3, 300.0),
        'iron': (50.0, 0.2, 0.5, 700.0),
        'chip': (12.0, 0.2, 1.2, 600.0),
        'putt': (6.0, 0.0, 0.0, 0.0),
        'anything': (90.0, -0.2, 1.5, 1200.0),
    }[kind]
    speed, angle, side = (
        speed * rng.uniform(0.1, 1.0),
        rng.uniform(low, high),
        rng.uniform(-0.4, 0.4),
    )
    velocity = speed * np.array(
        (np.cos(angle) * np.cos(side), np.cos(angle) * np.sin(side), np.sin(angle))
    )
    return tuple(velocity), tuple(spin * rng.uniform(-1.0, 1.0, 3))


if __name__ == '__main__':
    sys.exit(main())
