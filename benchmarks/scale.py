# SPDX-License-Identifier: Apache-2.0
"""What more of everything costs: triangles under a ball, balls that move, balls that fall into a heap."""
from math import cos, log, sin
from statistics import median

import numpy as np

from golf_sim_ros.physics import Ball, Course, Material, Mesh, Patch, Plane, Restitution, World
from timing import Row, clocked

HEADINGS = 12
HALF = 100.0  # m: half of a terrain's side
GRASS = Material('grass', Restitution(0.5), 0.0, 0.5, 0.4, 0.1, 0.003)
FLOOR = Material('floor', Restitution(0.5), 0.0, 0.4, 0.3, 0.02, 0.001)
FAR = (0.0, 500.0)  # where balls wait


def terrain(count):
    """World of a wavy mesh of about `count` triangles."""
    rows = round((count / 2) ** 0.5) + 1
    side = np.linspace(-HALF, HALF, rows)
    x, y = (a.ravel() for a in np.meshgrid(side, side, indexing='ij'))
    first = np.arange(rows * rows).reshape(rows, rows)[:-1, :-1].ravel()
    faces = np.r_[np.c_[first, first + rows, first + 1], np.c_[first + 1, first + rows, first + rows + 1]]
    mesh = Mesh(np.c_[x, y, 0.5 * np.sin(0.1 * x) * np.sin(0.07 * y)], faces, GRASS)
    return World(Course((mesh,), effects=('gravity',)))


def hops(world):
    """Let a ball fly, bounce and roll for 3 s, in all directions."""
    for heading in range(HEADINGS):
        world.place('ball', (0, 0, 3), (20 * cos(heading), 20 * sin(heading), 8))
        world.advance(3.0)


def scattered(count):
    """World of balls that are about to roll, ten metres apart."""
    world = World(Course((Plane(material=GRASS),), tee=FAR, effects=('gravity', 'ball_ball')), count)
    side = round(count ** 0.5 + 0.5)
    for i, name in enumerate(world.names):
        world.place(name, (10.0 * (i % side), -10.0 * (i // side)))
    random = np.random.default_rng(count)
    for name in world.names:
        world.strike(name, (*random.uniform(-4, 4, 2), random.uniform(0, 3)))
    return world


def poured(count):
    """World of balls that are about to fall into a box."""
    side, height = 0.6, 4.0
    walls = [Patch((0.5 * side * x, 0.5 * side * y, 0.5 * height), (-x, -y, 0), 0.0,
                   side + 0.1, height, FLOOR) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    course = Course((Plane(material=FLOOR), *walls), tee=FAR, ball=Ball(restitution=0.5, friction=0.2),
                    effects=('gravity', 'ball_ball'))
    world, random = World(course, count), np.random.default_rng(count)
    for k, name in enumerate(world.names):
        place = 0.06 * np.array((k % 9 - 4, k // 9 % 9 - 4, k // 81)) + (0.0, 0.0, 0.1)
        world.place(name, place + (*random.uniform(-5e-3, 5e-3, 2), 0.0), velocity=(0.0, 0.0, 0.0))
    return world


def rows(quick):
    """`Row` of each."""
    worlds = [terrain(count) for count in (1000, 10_000, 100_000)]
    times = [median(clocked(lambda: hops(world)) for _ in range(8)) / HEADINGS for world in worlds]
    yield Row('3 s of a ball on 100,000 triangles over those on 1,000', times[2] / times[0], most=2.0,
              times=tuple(times))
    counts = 10, 100, 1000
    times = []
    for count in counts:
        scattered(count).advance(1.0)  # compiles
        times.append(median(clocked(lambda: scattered_.advance(1.0)) for scattered_ in
                            [scattered(count) for _ in range(3)]))
    yield Row('balls that move: exponent of the cost from 10 to 1,000', log(times[2] / times[0]) / log(100),
              'power', most=1.15, times=tuple(times))
    if quick:
        return
    world = poured(1000)
    time = clocked(lambda: [world.advance(1 / 250) for _ in range(2500)])
    yield Row('10 s of 1,000 balls poured into a box at 250 Hz', 10.0 / time, least=1.0, times=(time,))
