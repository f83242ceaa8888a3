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

"""What more of everything costs: triangles under a ball, moving balls, balls falling on a heap."""

from math import cos, log, sin
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from engines import poured, STEP
from golf_sim_ros.course.mesh_file import read_mesh
from golf_sim_ros.course.stl_file import STL_HEAD, STL_TRIANGLE
from golf_sim_ros.physics import Course, Material, Plane, Restitution, World
from golf_sim_ros.study.scenes import hills
import numpy as np
from timing import clocked, Row

HEADINGS = 12
ROUNDS = 30  # a round takes some 10 ms
GRASS = Material('grass', Restitution(0.5), 0.0, 0.5, 0.4, 0.1, 0.003)
FAR = (0.0, 500.0)  # where balls wait


def hops(world):
    """Let a ball fly, bounce and roll for 3 s, in all directions."""
    for heading in range(HEADINGS):
        world.place('ball', (0, 0, 3), (20 * cos(heading), 20 * sin(heading), 8))
        world.advance(3.0)


def from_file(course, path):
    """`course`, a mesh, by way of an STL file."""
    (mesh,) = course.ground
    triangles = np.zeros(len(mesh.faces), STL_TRIANGLE)
    triangles['corners'] = mesh.vertices[mesh.faces]
    path.write_bytes(
        bytes(STL_HEAD - 4) + np.uint32(len(triangles)).tobytes() + triangles.tobytes()
    )
    vertices, faces, _ = read_mesh(path)
    return course._replace(ground=(mesh._replace(vertices=vertices, faces=faces),))


def scattered(count):
    """World of balls that are about to roll, ten metres apart."""
    world = World(
        Course((Plane(material=GRASS),), tee=FAR, effects=('gravity', 'ball_ball')), count
    )
    side = round(count**0.5 + 0.5)
    for i, name in enumerate(world.names):
        world.place(name, (10.0 * (i % side), -10.0 * (i // side)))
    random = np.random.default_rng(count)
    for name in world.names:
        world.strike(name, (*random.uniform(-4, 4, 2), random.uniform(0, 3)))
    return world


def rows(quick):
    """`Row` of each."""
    worlds = [World(hills(count), effects=('gravity',)) for count in (1000, 10_000, 100_000)]
    rounds = [[clocked(lambda: hops(world)) for world in worlds] for _ in range(ROUNDS)]
    times = [median(of_one) / HEADINGS for of_one in zip(*rounds)]
    yield Row(
        '3 s of a ball on 100,000 triangles over those on 1,000',
        times[2] / times[0],
        most=2.0,
        times=tuple(times),
    )
    if not quick:
        with TemporaryDirectory() as folder:
            world = World(
                from_file(hills(1_000_000), Path(folder) / 'hills.stl'), effects=('gravity',)
            )
        time = median(clocked(lambda: hops(world)) for _ in range(ROUNDS)) / HEADINGS
        yield Row(
            'the same on an STL file of 1,000,000 over 1,000',
            time / times[0],
            most=2.0,
            times=(time,),
        )
    counts = 10, 100, 1000
    times = []
    for count in counts:
        scattered(count).advance(1.0)  # compiles
        times.append(
            median(
                clocked(lambda: scattered_.advance(1.0))
                for scattered_ in [scattered(count) for _ in range(3)]
            )
        )
    yield Row(
        'balls that move: exponent of the cost from 10 to 1,000',
        log(times[2] / times[0]) / log(100),
        'power',
        most=1.15,
        times=tuple(times),
    )
    if quick:
        return
    world = poured(1000)
    time = clocked(lambda: [world.advance(STEP) for _ in range(2500)])
    yield Row(
        '10 s of 1,000 balls poured into a box at 250 Hz', 10.0 / time, least=1.0, times=(time,)
    )
