# SPDX-License-Identifier: Apache-2.0
"""Random shots at what nothing may pass: how many are off, of how many.

A shot is off where its ball is found deeper than 2e-6 m in the ground or another ball, or on the other side
of a sheet without having gone round its edge. The ball is looked at fifty times on the way. Speeds are 0 to
120 m/s, spins to 2000 rad/s, the way at most 2 m; every fourth shot grazes, every fourth aims by a hair.
"""
import numpy as np

from driving_range import GRAVITY, HARD
from golf_sim_ros.physics import Ball, Course, Cylinder, Heightmap, Material, Mesh, Patch, Plane, World
from scene import gaps_to_triangles

RADIUS = Ball().radius
LOOKS = 50
DEEP = 2e-6  # m
FAST = 120.0  # m/s
STICK = 0.01  # m: radius of the cylinder
HALF = 4.0  # m: half of the side of sheets, which end farther away than a shot goes
WOOD = Material('wood', HARD.restitution, 0.0, 0.45, 0.4, 0.05, 0.002)


def shots(random, count):
    """Unit directions downwards, speeds and spins; every fourth direction is nearly level."""
    ways = random.normal(size=(count, 3))
    ways[::4, 2] *= 10.0 ** random.uniform(-9, -1, len(ways[::4]))
    ways[:, 2] = -np.abs(ways[:, 2])
    axes = random.normal(size=(count, 3))
    return (ways / np.linalg.norm(ways, axis=1)[:, np.newaxis], random.uniform(0.1, FAST, count),
            random.uniform(0, 2000, (count, 1)) * axes / np.linalg.norm(axes, axis=1)[:, np.newaxis])


def sheet():
    """A crumpled mesh of one layer, 12 x 12 squares in triangles."""
    side = np.linspace(-HALF, HALF, 13)
    x, y = (a.ravel() for a in np.meshgrid(side, side))
    first = np.arange(169).reshape(13, 13)[:-1, :-1].ravel()
    faces = np.r_[np.c_[first, first + 1, first + 13], np.c_[first + 1, first + 14, first + 13]]
    z = np.random.default_rng(1).normal(0.0, 0.05, 169)
    return Mesh(np.c_[x, y, z], faces, HARD)


def at_a_sheet(shape, deep, count, accuracy, seed, top=lambda x: 0.0):
    """Shots from above at a `shape`; `deep` says how far the ball is out of it, signed, if over it.

    ``top`` is a height over which it is clear, at x.
    """
    random = np.random.default_rng(seed)
    world = World(Course((Plane((0, 0, -9), material=HARD), shape), effects=GRAVITY), accuracy=accuracy)
    off = 0
    for way, speed, spin in zip(*shots(random, count)):
        aim, far = random.uniform(-1.0, 1.0, 2), random.uniform(0.1, 2.0)
        start = np.array((*aim, RADIUS)) - far * way
        start[2] = max(start[2], top(start[0]) + RADIUS)
        world.place('ball', start, speed * way, spin)
        for _ in range(LOOKS):
            world.advance(3.0 * far / max(speed, 5.0) / LOOKS)
            place = np.array(world['ball'].position)
            if np.abs(place[:2]).max() < HALF - 0.1 and deep(place) < -DEEP:
                off += 1
                break
    return off


def over_mesh(mesh):
    """Signed clearance of a ball over a mesh that is a function of x and y."""
    corners = np.asarray(mesh.vertices)[mesh.faces]
    a, b, c = corners.transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)

    def clear(place):
        near = np.flatnonzero(np.abs(corners.mean(1)[:, :2] - place[:2]).max(1) < 1.0)
        gap = gaps_to_triangles(corners[near], place).min() - RADIUS if len(near) else np.inf
        for k in near:  # the triangle under the ball tells the side
            to = place - corners[k]
            sides = np.roll(corners[k], -1, 0) - corners[k]
            if (sides[:, 0] * to[:, 1] - sides[:, 1] * to[:, 0] >= 0).all():
                return -1.0 if to[0] @ normals[k] < 0.0 else gap
        return gap
    return clear


def at_the_mesh(count, accuracy, seed=1):
    """At a crumpled sheet of triangles."""
    mesh = sheet()
    return at_a_sheet(mesh, over_mesh(mesh), count, accuracy, seed, lambda x: 0.2)


def at_the_patch(count, accuracy, seed=2):
    """At a level patch."""
    patch = Patch((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.0, 2 * HALF, 2 * HALF, HARD)
    return at_a_sheet(patch, lambda place: place[2] - RADIUS, count, accuracy, seed)


def at_the_step(count, accuracy, seed=3):
    """At a height map with a rise of 1 m over one cell: flat on both sides of it, where depth is told."""
    heights = np.zeros((17, 17))
    heights[:, 9:] = 1.0

    def clear(place):
        # The spline swings beside the rise; four cells away by less than 1/50 of it.
        if abs(place[0] - 0.25) < 2.5:
            return np.inf if place[2] > -0.2 else -1.0
        return place[2] - (1.0 if place[0] > 0 else 0.0) + 0.02
    return at_a_sheet(Heightmap(heights, (-4.0, -4.0), 0.5, HARD), clear, count, accuracy, seed,
                      lambda x: 0.15 if x < -2.0 else 1.2)


def at_the_stick(count, accuracy, seed=4):
    """At an upright cylinder of 10 mm: nothing overlaps it, nothing goes straight on."""
    random = np.random.default_rng(seed)
    stick = Cylinder((2.0, 0.0, 0.0), STICK, 50.0, WOOD)
    world = World(Course((Plane(material=HARD),), obstacles=(stick,), effects=GRAVITY), accuracy=accuracy)
    reach, off = STICK + RADIUS, 0
    aside = random.uniform(-1, 1, count) * reach
    aside[::4] = reach * (1 - 10.0 ** random.uniform(-12, -2, len(aside[::4])))
    _, speeds, spins = shots(random, count)
    for y, speed, spin, far in zip(aside, speeds, spins, random.uniform(0.1, 2.0, count)):
        world.place('ball', (2.0 - far, y, 30.0), (speed, 0.0, 0.0), spin)
        time = min(2.0 * far / speed, 2.0)
        for _ in range(LOOKS):
            world.advance(time / LOOKS)
            x, y_now, z = world['ball'].position
            if np.hypot(x - 2.0, y_now) < reach - DEEP:
                off += 1
                break
        else:
            off += world['ball'].velocity[:2] == (speed, 0.0) and x > 2.0
    return off


def at_a_ball(count, accuracy, seed=5):
    """At a ball that lies still: nothing overlaps it, nothing goes straight on."""
    random = np.random.default_rng(seed)
    world = World(Course((Plane(material=HARD),), tee=(0.0, 500.0), effects=('gravity', 'ball_ball')),
                  ('still', 'fast'), accuracy=accuracy)
    off = 0
    ways, speeds, spins = shots(random, count)
    asides = random.uniform(0, 1, count)
    asides[::4] = 1 - 10.0 ** random.uniform(-9, -2, len(asides[::4]))
    for way, speed, spin, aside in zip(ways, speeds, spins, asides):
        across = np.cross(way, random.normal(size=3))
        far = random.uniform(0.1, 2.0)
        start = np.array((0.0, 0.0, 30.0)) - far * way + 2 * RADIUS * aside * across / np.linalg.norm(across)
        world.place('fast', (0.0, 400.0, RADIUS))
        world.place('still', (0.0, 0.0, 30.0), velocity=(0.0, 0.0, 0.0))
        world.place('fast', start, speed * way, spin)
        time = min(2.0 * far / speed, 1.0)  # both fall alike
        for _ in range(LOOKS):
            world.advance(time / LOOKS)
            apart = np.subtract(world['fast'].position, world['still'].position)
            if np.linalg.norm(apart) < 2 * RADIUS - DEEP:
                off += 1
                break
        else:
            turned = np.linalg.norm(np.array(world['still'].velocity)[:2]) > 0.0
            off += not turned and apart @ way > 0.1 * far and aside < 1 - 1e-6
    return off


TARGETS = {'a single-sheet mesh': at_the_mesh, 'a patch': at_the_patch,
           'a height map that rises 1 m over one cell': at_the_step,
           'a cylinder of 10 mm radius': at_the_stick, 'another ball': at_a_ball}
