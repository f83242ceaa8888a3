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

"""Random shots at what nothing may pass: how many do, of how many, and how deep any ball gets.

A shot has passed where, at any tick, its ball's centre is on the other side of a sheet without
having gone round its edge, or where it has gone straight on through what stood in its way. Speeds
are 0 to 120 m/s, spins to 2000 rad/s, the way at most 2 m; every fourth shot grazes. Many balls
that do not feel each other fly in one world: a tick of all takes little longer than one's.
"""

from driving_range import GRAVITY, HARD
from golf_sim_ros.physics import (
    Ball,
    Course,
    Cylinder,
    Heightmap,
    Material,
    Mesh,
    Patch,
    Plane,
    World,
)
import numpy as np
from scene import gaps_to_triangles

RADIUS = Ball().radius
AT_ONCE = 100  # shots in one world
THROUGH = 0.5 * RADIUS  # m: what is deeper than this has passed
FAST = 120.0  # m/s
SLOW = 5.0  # m/s: slower than this, a shot is not watched until it has gone three times its way
STICK = 0.01  # m: radius of the cylinder
HALF = 4.0  # m: half of the side of sheets, which end farther away than a shot goes
EDGE = HALF - 0.1  # m: what has been beyond may have gone round
SITE = 20.0  # m from one pair of balls to the next
WOOD = Material('wood', HARD.restitution, 0.0, 0.45, 0.4, 0.05, 0.002)


def units(random, count):
    """Draw unit vectors, evenly over the sphere."""
    arrows = random.normal(size=(count, 3))
    return arrows / np.linalg.norm(arrows, axis=1)[:, np.newaxis]


def shots(random, count):
    """Draw unit directions downwards, every fourth nearly level, and speeds, spins, ways to go."""
    ways = random.normal(size=(count, 3))
    ways[::4, 2] *= 10.0 ** random.uniform(-9, -1, len(ways[::4]))
    ways[:, 2] = -np.abs(ways[:, 2])
    return (
        ways / np.linalg.norm(ways, axis=1)[:, np.newaxis],
        random.uniform(0.1, FAST, count),
        random.uniform(0, 2000, (count, 1)) * units(random, count),
        random.uniform(0.1, 2.0, count),
    )


def flights(course, begins, times, rate, accuracy, others=0):
    """Fly shots, those of like `times` together; yield where they are at every tick.

    What is yielded is their numbers and their positions (ticks, shots, balls, 3).

    ``begins``: what each ball's `World.place` gets, a list of (position, velocity, spin) for each
    shot; of several balls a shot, the first is placed first.
    """
    balls = 1 + others
    world = World(course, AT_ONCE * balls, accuracy=accuracy)
    # Looking balls up by name takes most of the time.
    names, rows = np.reshape(world.names, (AT_ONCE, balls)), world._balls
    nowhere = world.state()
    order = np.argsort(times)
    for first in range(0, len(times), AT_ONCE):
        last = first + AT_ONCE
        numbers = order[first:last]
        world.restore(nowhere)
        for ball in range(balls):
            for number, own in zip(numbers, names):
                world.place(own[ball], *begins[number][ball])
        places = []
        for _ in range(int(np.ceil(times[numbers[-1]] * rate))):
            world.advance(1.0 / rate)
            places.append(rows['position'].copy())
        shape = -1, AT_ONCE, balls, 3
        yield (
            numbers,
            np.reshape(places, shape)[:, : len(numbers)],
            np.reshape(rows['velocity'], shape[1:])[: len(numbers)],
        )


def time_of(ways, speeds):
    """Seconds for which shots are watched: until they would be three times their way off."""
    return 3.0 * ways / np.maximum(speeds, SLOW)


def at_a_sheet(shape, height, clear, setting, seed):
    """Shots from above at a `shape` that is a function of x and y.

    Returns how many pass, and the depth [m].

    ``height`` of points (n, 2); ``clear``: signed distance of balls at (n, 3) from it.
    """
    count, accuracy, rate = setting
    random = np.random.default_rng(seed)
    begins, ways, speeds = [], [], []
    while len(begins) < count:  # those that begin in the ground are drawn anew
        way, speed, spin, far = shots(random, count)
        aims = random.uniform(-1.0, 1.0, (count, 2))
        starts = np.c_[aims, height(aims) + RADIUS] - far[:, np.newaxis] * way
        free = clear(starts) > 1e-5
        begins += [
            [one] for one in zip(starts[free], (speed[:, np.newaxis] * way)[free], spin[free])
        ]
        ways += far[free].tolist()
        speeds += speed[free].tolist()
    times = time_of(np.array(ways[:count]), np.array(speeds[:count]))
    course = Course((Plane((0, 0, -9), material=HARD), shape), effects=GRAVITY)
    passed, deepest = 0, 0.0
    for _, places, _ in flights(course, begins, times, rate, accuracy):
        places = places[:, :, 0]
        inside = np.logical_and.accumulate(np.abs(places[..., :2]).max(-1) < EDGE)
        depths = np.zeros(inside.shape)
        depths[inside] = -clear(places[inside])
        passed += (depths > THROUGH).any(0).sum()
        deepest = max(deepest, depths.max())
    return int(passed), deepest


SQUARES = 12  # on a side of the sheet


def sheet():
    """Make a crumpled mesh of one layer."""
    side = np.linspace(-HALF, HALF, SQUARES + 1)
    x, y = (a.ravel() for a in np.meshgrid(side, side))
    first = np.arange(len(x)).reshape(SQUARES + 1, -1)[:-1, :-1].ravel()
    beyond = first + SQUARES + 1
    faces = np.stack((np.c_[first, first + 1, beyond], np.c_[first + 1, beyond + 1, beyond]), 1)
    z = np.random.default_rng(1).normal(0.0, 0.05, len(x))
    return Mesh(np.c_[x, y, z], faces.reshape(-1, 3), HARD)


def at_the_mesh(setting, seed=1):
    """At a crumpled sheet of triangles."""
    mesh = sheet()
    corners = mesh.vertices[mesh.faces].reshape(SQUARES, SQUARES, 2, 3, 3)
    blocks = np.stack(
        [np.roll(corners, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)], 2
    )
    blocks = blocks.reshape(SQUARES, SQUARES, 18, 3, 3)
    tops = blocks[..., 2].max((2, 3)) + RADIUS

    def square(places):
        """Row and column of the square under each place.

        Of those at the sides, the next one inside.
        """
        i, j = (
            np.floor((places[:, :2] + HALF) * SQUARES / (2 * HALF))
            .astype(int)
            .clip(1, SQUARES - 2)
            .T
        )
        return j, i

    def around(places):
        """Corners (n, 18, 3, 3) of the triangles of the square under each place and around it."""
        return blocks[square(places)]

    def over(triangles, places):
        """Height of the triangle in plan at each place."""
        to, sides = (
            places[:, np.newaxis, np.newaxis] - triangles,
            np.roll(triangles, -1, 2) - triangles,
        )
        inside = (sides[..., 0] * to[..., 1] - sides[..., 1] * to[..., 0]).min(2)
        own = triangles[np.arange(len(places)), inside.argmax(1)]
        normal = np.cross(own[:, 1] - own[:, 0], own[:, 2] - own[:, 0])
        return own[:, 0, 2] - ((places - own[:, 0])[:, :2] * normal[:, :2]).sum(1) / normal[:, 2]

    def clear(places):
        found = places[:, 2] - tops[square(places)]
        near = np.flatnonzero(found < 0)
        for some in np.array_split(near, 1 + len(near) // 4000):
            triangles = around(places[some])
            points = np.repeat(places[some], triangles.shape[1], 0)[:, np.newaxis]
            gaps = (
                gaps_to_triangles(triangles.reshape(-1, 3, 3), points)
                .reshape(len(some), -1)
                .min(1)
            )
            above = places[some, 2] > over(triangles, places[some])
            found[some] = np.where(above, gaps - RADIUS, -RADIUS)
        return found

    def height(points):
        points = np.c_[points, np.zeros(len(points))]
        return over(around(points), points)

    return at_a_sheet(mesh, height, clear, setting, seed)


def at_the_patch(setting, seed=2):
    """At a level patch."""
    patch = Patch((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.0, 2 * HALF, 2 * HALF, HARD)
    return at_a_sheet(
        patch,
        lambda points: np.zeros(len(points)),
        lambda places: places[:, 2] - RADIUS,
        setting,
        seed,
    )


def spline(heights, spacing):
    """Height at x of the natural cubic spline through `heights`, equally spaced from -HALF on."""
    n = len(heights)
    matrix, right = np.eye(n), np.zeros(n)
    for i in range(1, n - 1):
        matrix[i, [i - 1, i, i + 1]] = 1.0, 4.0, 1.0
        right[i] = 6.0 * (heights[i - 1] - 2.0 * heights[i] + heights[i + 1]) / spacing**2
    bends = np.linalg.solve(matrix, right)

    def height(x):
        i = np.floor((x + HALF) / spacing).astype(int).clip(0, n - 2)
        t = (x + HALF) / spacing - i
        return (
            (1 - t) * heights[i]
            + t * heights[i + 1]
            + spacing**2 / 6 * (((1 - t) ** 3 - (1 - t)) * bends[i] + (t**3 - t) * bends[i + 1])
        )

    return height


def at_the_step(setting, seed=3):
    """At a height map with a rise of 1 m over one cell."""
    cells, spacing = 16, 0.5
    column = np.where(np.arange(cells + 1) > cells // 2, 1.0, 0.0)
    rise = spline(column, spacing)
    # every 5 mm; the highest within 30 mm says what is clear
    fine = rise(np.linspace(-HALF, HALF, 1601))
    tops = np.max([np.roll(fine, k) for k in range(-6, 7)], 0) + 1.2 * RADIUS
    # along x, to where the curve is looked at
    steps = np.linspace(-1.2 * RADIUS, 1.2 * RADIUS, 101)

    def clear(places):
        found = places[:, 2] - tops[np.rint((places[:, 0] + HALF) * 200).astype(int).clip(0, 1600)]
        near = np.flatnonzero(found < 0)
        for some in np.array_split(near, 1 + len(near) // 2000):
            x, z = places[some, 0], places[some, 2]
            squares = steps**2 + (rise(x[:, np.newaxis] + steps) - z[:, np.newaxis]) ** 2
            best = squares.argmin(1)
            inner = np.flatnonzero((best > 0) & (best < len(steps) - 1))  # else it is far off
            before, least, after = (squares[inner, best[inner] + k] for k in (-1, 0, 1))
            squares = squares.min(1)
            squares[inner] = least - (after - before) ** 2 / (8 * (before - 2 * least + after))
            found[some] = np.where(
                z > rise(x), np.sqrt(np.maximum(squares, 0.0)) - RADIUS, -RADIUS
            )
        return found

    map_ = Heightmap(np.tile(column, (cells + 1, 1)), (-HALF, -HALF), spacing, HARD)
    return at_a_sheet(map_, lambda points: rise(points[:, 0]), clear, setting, seed)


def at_the_stick(setting, seed=4):
    """At an upright cylinder of 10 mm: nothing overlaps it, nothing goes straight on."""
    count, accuracy, rate = setting
    random = np.random.default_rng(seed)
    course = Course(
        (Plane(material=HARD),),
        obstacles=(Cylinder((2.0, 0.0, 0.0), STICK, 50.0, WOOD),),
        effects=GRAVITY,
    )
    reach = STICK + RADIUS
    aside = random.uniform(-1, 1, count) * reach
    aside[::4] = reach * (1 - 10.0 ** random.uniform(-12, -2, len(aside[::4])))
    _, speeds, spins, ways = shots(random, count)
    begins = [
        [((2.0 - way, y, 30.0), (speed, 0.0, 0.0), spin)]
        for way, y, speed, spin in zip(ways, aside, speeds, spins)
    ]
    passed, deepest = 0, 0.0
    for numbers, places, velocities in flights(
        course, begins, time_of(ways, speeds), rate, accuracy
    ):
        away = np.hypot(places[..., 0, 0] - 2.0, places[..., 0, 1]).min(0)
        # the barest touch turns it by 1e-6
        straight = np.abs(velocities[:, 0, 1]) < 1e-8 * speeds[numbers]
        passed += ((away < reach - THROUGH) | straight & (places[-1, :, 0, 0] > 2.0)).sum()
        deepest = max(deepest, reach - away.min())
    return int(passed), deepest


def at_a_ball(setting, seed=5):
    """At a ball that falls alike: nothing overlaps it, nothing goes straight on."""
    count, accuracy, rate = setting
    random = np.random.default_rng(seed)
    course = Course((Plane(material=HARD),), tee=(0.0, -500.0), effects=('gravity', 'ball_ball'))
    ways, speeds, spins, fars = shots(random, count)
    asides = random.uniform(0, 1, count)
    asides[::4] = 1 - 10.0 ** random.uniform(-9, -2, len(asides[::4]))
    across = np.cross(ways, units(random, count))
    across *= (2 * RADIUS * asides / np.linalg.norm(across, axis=1))[:, np.newaxis]
    times = np.minimum(time_of(fars, speeds), 1.0)
    sites = np.zeros((count, 3))
    sites[np.argsort(times), 0] = SITE * (np.arange(count) % AT_ONCE)
    sites[:, 2] = 30.0
    begins = [
        [(site, (0.0, 0.0, 0.0)), (site + way, velocity, spin)]
        for site, way, velocity, spin in zip(
            sites, across - fars[:, np.newaxis] * ways, speeds[:, np.newaxis] * ways, spins
        )
    ]
    passed, deepest = 0, 0.0
    for numbers, places, velocities in flights(course, begins, times, rate, accuracy, others=1):
        apart = places[:, :, 1] - places[:, :, 0]
        depths = 2 * RADIUS - np.linalg.norm(apart, axis=-1)
        moved = velocities[:, 0, :2].any(1)
        beyond = (apart[-1] * ways[numbers]).sum(-1) > 0.0
        straight = ~moved & beyond & (asides[numbers] < 1 - 1e-6)
        passed += ((depths > THROUGH).any(0) | straight).sum()
        deepest = max(deepest, depths.max())
    return int(passed), deepest


TARGETS = {
    'a single-sheet mesh': at_the_mesh,
    'a patch': at_the_patch,
    'a height map that rises 1 m over one cell': at_the_step,
    'a cylinder of 10 mm radius': at_the_stick,
    'another ball': at_a_ball,
}
