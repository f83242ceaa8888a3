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

"""Hard cases that a line of YAML does not hold: rows and racks of balls, piles, hole, curves.

Each is played at a preset and a tick and gives one figure, which must lie from `least` to `most`.
"""

from math import cos, hypot, pi, radians, sin, sqrt
from typing import Callable, NamedTuple

from driving_range import as_on_relief, GRAVITY
from golf_sim_ros.physics import (
    Ball,
    Course,
    Cylinder,
    Heightmap,
    Material,
    Mesh,
    Patch,
    PENNER,
    Phase,
    Plane,
    Restitution,
    rolling_resistance_of_stimp,
    World,
)
from golf_sim_ros.physics.geometry.cup import RADIUS as HOLE
import numpy as np
from oracles import G, RADIUS
from scene import bowl, energy

BALLS = ('gravity', 'ball_ball')
IDEAL = Material('ideal', Restitution(1.0))
CLOTH = Material('cloth', Restitution(0.5), 0.0, 0.2, 0.2, 0.01)
FLOOR = Material('floor', Restitution(0.5), 0.0, 0.4, 0.3, 0.02, 0.001)
SMOOTH = Material('smooth', Restitution(0.5), 0.0, 2.0, 2.0)
GRIP = Material('grip', Restitution(0.5), 0.0, 0.9, 0.9, 0.1, 0.003)
GREEN = Material('green', PENNER, 0.0, 0.45, 0.40, rolling_resistance_of_stimp(10), 0.002, 1.0)
CREEPING = 1e-6  # m/s: less is rest
DEEP = 1e-6  # m: more is an overlap
SOON = 1e-4  # m before the rim of the hole


class Scene(NamedTuple):
    """What is played, and the range in which its figure must lie.

    `figure` takes a preset and a rate [Hz]. ``rough``: the most with `sketch`, where that may be
    off by more.
    """

    name: str
    least: float
    most: float
    figure: Callable
    rough: float = 0.0

    def holds(self, figure, accuracy):
        """Whether a figure with that preset lies in the range."""
        most = max(self.most, self.rough) if accuracy == 'sketch' else self.most
        return self.least <= figure <= most


def run(world, seconds, rate, look=None):
    """Let a world run for so long, tick by tick.

    ``look`` is called at each, with what happened.
    """
    for _ in range(round(seconds * rate)):
        events = world.advance(1.0 / rate)
        if look:
            look(events)


def rolling(velocity, normal=(0.0, 0.0, 1.0)):
    """Spin of a ball that rolls at `velocity`."""
    return np.cross(normal, velocity) / RADIUS


def motion(world):
    """Positions and velocities of all balls, two (n, 3) arrays."""
    return (
        np.array([world[name].position for name in world.names]),
        np.array([world[name].velocity for name in world.names]),
    )


def overlap(world):
    """How deep [m] the two balls that overlap most do."""
    places = motion(world)[0]
    apart = np.linalg.norm(places[:, None] - places[None], axis=2) + 10 * RADIUS * np.eye(
        len(places)
    )
    return 2 * RADIUS - apart.min()


# Balls that touch


def table(material, balls, accuracy, restitution=1.0, friction=0.0):
    """World of `balls` far away from the origin on a level plane."""
    course = Course(
        (Plane(material=material),),
        tee=(0.0, 500.0),
        ball=Ball(restitution=restitution, friction=friction),
        effects=BALLS,
    )
    return World(course, balls, accuracy=accuracy)


def cradle(count, restitution, seed, accuracy, rate):
    """Greatest error [m/s] of the speeds after a ball at 2 m/s hits a row of the others."""
    world = table(IDEAL, count, accuracy, restitution)
    names = [world.names[i] for i in np.random.default_rng(seed).permutation(count)]
    for k, name in enumerate(names[1:]):
        world.place(name, (2 * RADIUS * k, 0.0, RADIUS))
    world.place(names[0], (-0.3, 0.0, RADIUS), velocity=(2.0, 0.0, 0.0))
    run(world, 0.5, rate)
    found = [world[name].velocity[0] for name in names]
    if restitution == 1.0:
        return max(np.abs(found[:-1]).max(), abs(found[-1] - 2.0))
    return abs(found[-1] - 2.0 * (0.5 + 0.5 * restitution) ** (count - 1))


TRIANGLE = [
    (row * sqrt(3) * RADIUS, (2 * k - row) * RADIUS) for row in range(5) for k in range(row + 1)
]
MIRRORED = [0] + [1 + row * (row + 1) // 2 + row - k for row in range(5) for k in range(row + 1)]


def broken(seed, accuracy, rate, look=None):
    """World of a rack of 15, broken head-on, and its balls' places and velocities in its order."""
    world = table(CLOTH, 16, accuracy, 0.9, 0.2)
    order = np.random.default_rng(seed).permutation(16)
    names = [world.names[i] for i in order]
    for name, place in zip(names[1:], TRIANGLE):
        world.place(name, (*place, RADIUS))
    world.place(names[0], (-0.3, 0.0, RADIUS), (5.0, 0.0, 0.0), rolling((5.0, 0.0, 0.0)))
    run(world, 0.2, rate, look and (lambda events: look(world, events)))
    return np.hstack(motion(world))[order]


def asymmetry(accuracy, rate):
    """How far [m, m/s] a broken rack is from its mirror image."""
    found = broken(7, accuracy, rate)
    return np.abs(found[MIRRORED] * (1, -1, 1, 1, -1, 1) - found).max()


def disorder(accuracy, rate):
    """How far [m, m/s] the ends of a rack broken in two orders in memory are apart."""
    return np.abs(broken(7, accuracy, rate) - broken(8, accuracy, rate)).max()


def unbalanced(accuracy, rate):
    """Greatest change [m/s] of the momentum of balls that nothing but balls touch, in a break."""
    world = table(IDEAL, 16, accuracy, 0.9)
    for name, place in zip(world.names[1:], TRIANGLE):
        world.place(name, (*place, RADIUS))
    world.place(world.names[0], (-0.3, 0.01, RADIUS), velocity=(5.0, 0.0, 0.0))
    off = []
    run(
        world,
        0.4,
        rate,
        lambda events: off.append(np.abs(motion(world)[1].sum(0) - (5.0, 0.0, 0.0)).max()),
    )
    return max(off)


def gained(accuracy, rate):
    """Greatest gain of energy [J/kg] in a tick of a break."""
    energies = []
    broken(
        7,
        accuracy,
        rate,
        lambda world, events: energies.append(
            sum(energy(world.course, world[name]) for name in world.names)
        ),
    )
    return max(np.diff(energies).max(), 0.0)


def squeezed(accuracy, rate):
    """Greatest overlap [m] in a break."""
    found = []
    broken(7, accuracy, rate, lambda world, events: found.append(overlap(world)))
    return max(found)


def thrown(friction, cut, accuracy, rate):
    """Error [m/s] after an oblique impact with friction, against its closed form."""
    world = table(IDEAL, ('cue', 'object'), accuracy, 0.8, friction)
    place = 2 * RADIUS * np.array([-sqrt(1 - cut * cut), -cut, 0.0])
    world.place('object', (0.0, 0.0, RADIUS))
    world.place(
        'cue', (place[0] - 0.1, place[1], RADIUS), velocity=(3.0, 0.0, 0.0), spin=(0.0, 0.0, 20.0)
    )
    run(world, 0.1, rate)
    normal, velocity = place / (2 * RADIUS), np.array([3.0, 0.0, 0.0])
    pushed = -(1 + 0.8) / 2 * (velocity @ normal)  # impulses over mass
    sliding = velocity - (velocity @ normal) * normal - RADIUS * np.cross((0.0, 0.0, 20.0), normal)
    size = np.linalg.norm(sliding)
    impulse = pushed * normal - min(friction * pushed, size / 7) * sliding / size
    turn = -RADIUS * np.cross(normal, impulse) / (0.4 * RADIUS * RADIUS)
    cue, other = world['cue'], world['object']
    turned = cue.spin - turn - (0.0, 0.0, 20.0), other.spin - turn
    return max(
        np.abs(cue.velocity - velocity - impulse).max(),
        np.abs(other.velocity + impulse).max(),
        RADIUS * np.abs(turned).max(),
    )


def follow(accuracy, rate):
    """Error [m/s] of 2/7 and 5/7 of its speed, of a rolling ball that hits one head-on.

    The balls are equal.
    """
    world = table(
        Material('grip', Restitution(0.0), 0.0, 0.3, 0.3, 0.0), ('cue', 'object'), accuracy
    )
    world.place('object', (0.0, 0.0, RADIUS))
    world.place('cue', (-0.2, 0.0, RADIUS), (1.4, 0.0, 0.0), rolling((1.4, 0.0, 0.0)))
    run(world, 3.0, rate)
    return max(abs(world['cue'].velocity[0] - 0.4), abs(world['object'].velocity[0] - 1.0))


# Piles


def box(side, height=2.0, material=FLOOR):
    """Floor and four walls around the origin."""
    walls = [
        Patch(
            (0.5 * side * x, 0.5 * side * y, 0.5 * height),
            (-x, -y, 0),
            0.0,
            side + 0.1,
            height,
            material,
        )
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    return (Plane(material=material), *walls)


def poured(ground, count, accuracy):
    """World of balls let go in a heap over `ground`."""
    course = Course(
        ground, tee=(0.0, 500.0), ball=Ball(restitution=0.5, friction=0.2), effects=BALLS
    )
    world, random = World(course, count, accuracy=accuracy), np.random.default_rng(count)
    for k, name in enumerate(world.names):
        place = 0.06 * np.array((k % 3 - 1, k // 3 % 3 - 1, k // 9)) + (0.0, 0.0, 0.2)
        world.place(name, place + (*random.uniform(-5e-3, 5e-3, 2), 0.0), velocity=(0.0, 0.0, 0.0))
    return world


def rests_after(ground, count, accuracy, rate):
    """Seconds after which poured balls are all at rest, up to 20.

    They must stay so for 20 more.
    """
    world, moved = poured(ground, count, accuracy), [0.0]
    run(world, 20.0, rate, lambda events: world.moving and moved.append(world.time))
    places = motion(world)[0]
    run(world, 20.0, rate)
    return max(moved) if np.array_equal(places, motion(world)[0]) else np.inf


def heaped(ground, count, accuracy, rate):
    """Overlap [m] of poured balls, after 20 s."""
    world = poured(ground, count, accuracy)
    run(world, 20.0, rate)
    return overlap(world)


def crammed(draws, accuracy, rate):
    """Deepest [m] that balls of random towers, fallen into a box, get into others, floor or walls.

    Some of them hit others that lean on each other already.
    """
    deepest, random = 0.0, np.random.default_rng(5)
    for _ in range(draws):
        count, across = int(random.integers(15, 60)), int(random.integers(2, 5))
        ball = Ball(
            restitution=random.choice((0.0, 0.3, 0.5, 0.8)),
            friction=random.choice((0.0, 0.3, 1.0)),
        )
        course = Course(box(0.5), tee=(0.0, 500.0), ball=ball, effects=BALLS)
        world, apart = World(course, count, accuracy=accuracy), random.uniform(0.047, 0.07)
        for k, name in enumerate(world.names):
            place = apart * np.array(
                (k % across - across // 2, k // across % across - across // 2, 0.0)
            )
            jitter = (
                *random.uniform(-2e-3, 2e-3, 2),
                0.1 + (apart + 0.01) * (k // (across * across)),
            )
            world.place(name, place + jitter, velocity=(0.0, 0.0, 0.0))

        def look(events):
            nonlocal deepest
            places = motion(world)[0]
            out = max(RADIUS - places[:, 2].min(), np.abs(places[:, :2]).max() - 0.25 + RADIUS)
            deepest = max(deepest, out, overlap(world))

        run(world, 2.0, rate, look)
    return deepest


IN_A_BOWL = (Plane((0.0, 0.0, -1.0), material=FLOOR), Mesh(*bowl(radius=0.3, depth=0.15), FLOOR))


# Rest, and none


def alone(ground, accuracy, **more):
    """World of one ball under gravity; its tee is far off."""
    return World(Course(ground, effects=GRAVITY, **more), accuracy=accuracy)


def speed(world):
    """Speed of a ball [m/s], that of its surface counted."""
    ball = world['ball']
    return max(np.linalg.norm(ball.velocity), RADIUS * np.linalg.norm(ball.spin))


def groove(angle, accuracy, rate):
    """Speed [m/s] five seconds after a ball was let go over a groove of faces at `angle`.

    `angle` is in degrees.
    """
    a = radians(angle)
    sides = [
        Patch((side * cos(a), 0.0, sin(a)), (-side * sin(a), 0.0, cos(a)), 0.0, 2.0, 20.0, GRIP)
        for side in (1.0, -1.0)
    ]
    world = alone((Plane((0.0, 0.0, -1.0), material=GRIP), *sides), accuracy, tee=(0.0, 100.0))
    world.place('ball', (0.2 * cos(a), 0.0, 1.0), velocity=(0.0, 0.3, 0.0))
    run(world, 15.0, rate)
    return speed(world) if world['ball'].position[2] > 0.0 else np.inf


def corner(accuracy, rate):
    """Speed [m/s] five seconds after a ball was thrown into a corner of three planes."""
    planes = (
        Plane(material=GRIP),
        Plane((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), GRIP),
        Plane((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), GRIP),
    )
    world = alone(planes, accuracy, tee=(5.0, 5.0))
    world.place('ball', (0.5, 0.7, 0.4), velocity=(-5.0, -7.0, -3.0))
    run(world, 15.0, rate)
    return speed(world)


def swing(accuracy, rate):
    """Period of a ball that rolls to and fro in a bowl of 2 m, over that of the closed form."""
    curve, spacing = 2.0, 0.1
    x = np.arange(-1.0, 1.05, spacing)
    heights = curve - np.sqrt(curve * curve - x[np.newaxis] ** 2 - x[:, np.newaxis] ** 2)
    world = alone((Heightmap(heights, (-1.0, -1.0), spacing, SMOOTH),), accuracy)
    world.place('ball', (0.02, 0.0, heights[10, 10] + 0.0225), (0.0, 0.0, 0.0))
    rows = []
    run(world, 12.0, rate, lambda events: rows.append((world.time, world['ball'].position[0])))
    down = [
        t0 + (t1 - t0) * x0 / (x0 - x1)
        for (t0, x0), (t1, x1) in zip(rows, rows[1:])
        if x0 > 0 >= x1
    ]
    return (down[-1] - down[0]) / (len(down) - 1) / (2 * pi * sqrt(7 * (curve - RADIUS) / (5 * G)))


def pyramid():
    """Course of a pyramid of four faces, half a metre high."""
    return (
        Plane((0.0, 0.0, -1.0), material=FLOOR),
        Mesh(
            np.array([(0, 0, 0.5), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)], float),
            np.array([(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1)]),
            FLOOR,
        ),
    )


def vertex(accuracy, rate):
    """How far [m] towards its own side a ball has gone, dropped 1 mm beside a vertex."""
    world = alone(pyramid(), accuracy, tee=(0.5, 0.5))
    way = np.array((0.6, -0.8))
    world.place('ball', (*(1e-3 * way), 0.8), velocity=(0.0, 0.0, 0.0))
    run(world, 0.6, rate)
    place = np.array(world['ball'].position[:2])
    return place @ way


def ridge(accuracy, rate):
    """How far [m] a ball balanced on a ridge has gone aside after 5 s."""
    roof = Mesh(
        np.array([(-2, 0, 1), (2, 0, 1), (-2, -1, 0), (2, -1, 0), (-2, 1, 0), (2, 1, 0)], float),
        np.array([(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4)]),
        FLOOR,
    )
    world = alone((Plane((0.0, 0.0, -1.0), material=FLOOR), roof), accuracy, tee=(0.0, 5.0))
    world.place('ball', (0.0, 0.0, 1.0 + RADIUS), velocity=(0.0, 0.0, 0.0))
    run(world, 5.0, rate)
    return abs(world['ball'].position[1])


def wedged(accuracy, rate):
    """Speed [m/s] five seconds after a ball was driven between a trunk and the ground."""
    trunk = Cylinder((1.0, 0.0, 0.0), 0.3, 8.0, GRIP)
    world = alone((Plane(material=GRIP),), accuracy, obstacles=(trunk,))
    world.place('ball', (0.6, 0.05, 0.1), (6.0, 0.0, -4.0), (0.0, 300.0, 0.0))
    run(world, 15.0, rate)
    return speed(world)


def pivot(accuracy, rate):
    """Error [s] of the time after which a ball that turns on the spot stops."""
    world, turning = alone((Plane(material=GRIP),), accuracy), [0.0]
    world.place('ball', (0.0, 0.0, RADIUS), velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 30.0))
    stops = 30.0 * 0.4 * RADIUS**2 / (GRIP.pivot_friction * G)
    run(world, 2.0, rate, lambda events: turning.append(world['ball'].spin[2]))
    gone = np.array(turning[1:]) == 0.0
    left = 30.0 * (1.0 - np.arange(1, len(gone) + 1) / rate / stops)
    return np.abs(np.array(turning[1:]) - np.maximum(left, 0.0)).max() * stops / 30.0


def holds_wrongly(accuracy, rate):
    """On how many of 36 slopes a ball rests that must not, or does not although it must."""
    wrong = 0
    for resistance in (0.0, 0.05, 0.2):
        for static in (0.1, 0.4):
            material = Material('slope', Restitution(0.5), 0.0, static, 0.8 * static, resistance)
            for tangent in (
                0.999 * static,
                1.001 * static,
                1.39 * resistance,
                1.401 * resistance,
                0.02,
                0.5,
            ):
                normal = np.array((tangent, 0.0, 1.0)) / hypot(tangent, 1.0)
                world = alone((Plane(normal=tuple(normal), material=material),), accuracy)
                world.place('ball', RADIUS * normal, velocity=(0.0, 0.0, 0.0))
                run(world, 0.5, rate)
                must = 5 / 7 * tangent <= resistance and tangent <= static
                wrong += (world['ball'].phase == Phase.REST) != must
    return wrong


# Curved and faceted ground


def crest(share, accuracy, rate):
    """1 if a ball flies that passes a crest at `share` of a speed, else 0.

    It is the speed at which gravity lets the ball go.
    """
    curve, spacing = 2.0, 0.05
    x = np.arange(-1.0, 1.0 + 0.5 * spacing, spacing)
    heights = np.tile(np.sqrt(curve * curve - x * x), (len(x), 1))
    world = alone((Heightmap(heights, (-1.0, -1.0), spacing, SMOOTH),), accuracy)
    speed_ = share * sqrt(G * (curve + RADIUS))
    world.place(
        'ball', (0.0, 0.0, curve + RADIUS), (speed_, 0.0, 0.0), rolling((speed_, 0.0, 0.0))
    )
    flew = []
    run(world, 0.02, rate, lambda events: flew.append(world['ball'].phase == Phase.FLIGHT))
    return float(flew[-1])


SIDE = 6.0  # m from the middle of a floor to its sides


def floor(seed=1, inner=100, up=(0.0, 0.0, 1.0)):
    """Irregular triangles that make a square across `up`.

    They are twice as many as `inner` points, and two more.
    """
    random = np.random.default_rng(seed)
    places, faces = (
        [(-SIDE, -SIDE), (SIDE, -SIDE), (SIDE, SIDE), (-SIDE, SIDE)],
        [(0, 1, 2), (0, 2, 3)],
    )
    for x, y in random.uniform(-0.9 * SIDE, 0.9 * SIDE, (inner, 2)):
        for i, face in enumerate(faces):
            corners = [places[k] for k in face]
            turns = [
                (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
                for p, q in zip(corners, corners[1:] + corners[:1])
            ]
            if min(turns) >= 0:
                break
        a, b, c = faces.pop(i)
        faces += [(a, b, len(places)), (b, c, len(places)), (c, a, len(places))]
        places.append((x, y))
    across = np.cross(up, (1.0, 0.0, 0.0)) / np.linalg.norm(np.cross(up, (1.0, 0.0, 0.0)))
    return Mesh(np.array(places) @ (np.cross(across, up), across), np.array(faces), GRIP)


HEADINGS = np.arange(0.1, 6.3, 0.9)


def bumps(accuracy, rate):
    """Greatest vertical speed [m/s] of balls that roll over a flat floor of 202 triangles."""
    found = []
    for heading in HEADINGS:
        world, velocity = (
            alone((floor(),), accuracy),
            3.0 * np.array((cos(heading), sin(heading), 0.0)),
        )
        world.place('ball', (0.1, -0.2, RADIUS), velocity, rolling(velocity))
        run(world, 4.0, rate, lambda events: found.append(abs(world['ball'].velocity[2])))
    return max(found)


def strays(accuracy, rate):
    """How far [m] balls on that floor end from where they end on a plane.

    And how far [rad] their heading is off.
    """
    found = []
    for heading in HEADINGS:
        ends = []
        for ground in (floor(), Plane(material=GRIP)):
            world, velocity = (
                alone((ground,), accuracy),
                3.0 * np.array((cos(heading), sin(heading), 0.0)),
            )
            world.place('ball', (0.1, -0.2, RADIUS), velocity, rolling(velocity))
            run(world, 2.0, rate)
            ends.append(world['ball'])
        apart = np.cross(ends[0].velocity, ends[1].velocity)[2] / np.dot(
            ends[1].velocity, ends[1].velocity
        )
        found += [abs(apart), *np.abs(np.subtract(ends[0].position, ends[1].position))]
    return max(found)


def tilted(kind, accuracy, rate):
    """How far [m] a ball on a tilted plane of heights or triangles is from one on the plane."""
    normal = np.array((-0.03, 0.02, 1.0)) / np.linalg.norm((-0.03, 0.02, 1.0))
    axis = np.linspace(-20.0, 20.0, 11)
    ground = (
        Heightmap(0.03 * axis[np.newaxis] - 0.02 * axis[:, np.newaxis], (-20.0, -20.0), 4.0, GRIP)
        if kind == 'heights'
        else floor(2, up=normal)
    )
    tracks = []
    plane = Plane(normal=tuple(normal), material=GRIP)
    for shape, exactly in ((ground, accuracy), (plane, as_on_relief(accuracy))):
        world, track = alone((shape,), exactly), []
        world.place('ball', (0.0, 0.0, 0.3), (1.0, 0.5, 2.0), (3.0, -60.0, 20.0))
        run(world, 4.0, rate, lambda events: track.append(world['ball'].position))
        tracks.append(np.array(track))
    return np.abs(tracks[0] - tracks[1]).max()


# The hole


def green(accuracy, slope=0.0, flagstick=False, **ball):
    """World of a green with a hole at the origin; it rises by `slope` along x."""
    normal = np.array((-slope, 0.0, 1.0)) / hypot(slope, 1.0)
    course = Course(
        (Plane((0.0, 0.0, -1.0), material=GREEN), Plane(normal=tuple(normal), material=GREEN)),
        tee=(-1.0, 0.0),
        hole=(0.0, 0.0),
        flagstick=flagstick,
        effects=('gravity', 'turf'),
    )
    return World(course._replace(ball=course.ball._replace(**ball)), accuracy=accuracy)


def putt(world, speed_, aside, rate):
    """Whether a ball is holed that rolls over the rim, `aside` of the middle, till 0.3 m off."""
    normal = np.array(world.course.ground[1].normal)
    ahead = np.array((normal[2], 0.0, -normal[0]))
    place = np.array((-sqrt(HOLE**2 - aside**2) - SOON, aside, 0.0))
    place[2] = -(normal @ place) / normal[2]
    world.place('ball', place + RADIUS * normal, speed_ * ahead, rolling(speed_ * ahead, normal))
    while world.moving and hypot(*world['ball'].position[:2]) < 0.3:
        world.advance(1.0 / rate)
    return world['ball'].phase == Phase.HOLED


def escapes_at(aside, accuracy, rate):
    """Lowest speed [m/s], to 5 mm/s, at which a putt is not holed."""
    world, low, high = green(accuracy), 0.9, 2.4
    while high - low > 5e-3:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if putt(world, middle, aside, rate) else (low, middle)
    return high


def holed(speed_, accuracy, rate):
    """How many of 19 putts at `speed_` all across the hole are holed."""
    world = green(accuracy)
    return sum(putt(world, speed_, aside, rate) for aside in np.linspace(-0.9, 0.9, 19) * HOLE)


def lips_out(accuracy, rate):
    """By how many degrees a putt turns that lips out."""
    world = green(accuracy)
    putt(world, 1.5, 0.5 * HOLE, rate)
    x, y, _ = world['ball'].velocity
    return abs(np.degrees(np.arctan2(y, x)))


def on_the_bottom(slope, accuracy, rate):
    """How many of 10 slow putts do not come to rest on the bottom of the hole."""
    wrong = 0
    for flagstick in (False, True):
        world = green(accuracy, slope, flagstick)
        for speed_ in (0.3, 0.5, 0.7, 0.9, 1.0):
            is_holed = putt(world, speed_, 0.012, rate)
            wrong += not is_holed or speed(world) > CREEPING or world['ball'].position[2] > -0.05
    return wrong


def wedged_in_the_hole(accuracy, rate):
    """Speed [m/s] five seconds after a ball too fat for it fell between flagstick and wall."""
    world = green(accuracy, flagstick=True, radius=0.0235)
    world.place('ball', (0.033, 0.0, 0.1), velocity=(0.0, 0.0, 0.0))
    run(world, 10.0, rate)
    return speed(world) if abs(world['ball'].position[2]) < 0.03 else np.inf


def of(function, *arguments):
    """Bind a figure of a preset and a rate to its other arguments."""
    return lambda accuracy, rate: function(*arguments, accuracy, rate)


EXACT = 1e-9
SCENES = {
    'Balls that touch': (
        Scene(
            "Newton's cradle of 5, e = 1: error of the speeds [m/s]",
            0,
            EXACT,
            of(cradle, 5, 1.0, 1),
        ),
        Scene("Newton's cradle of 20, e = 1", 0, EXACT, of(cradle, 20, 1.0, 2)),
        Scene(
            "Newton's cradle of 5, e = 0.9: that of the last one", 0, EXACT, of(cradle, 5, 0.9, 3)
        ),
        Scene('rack of 15 broken head-on: off its mirror image [m, m/s]', 0, EXACT, asymmetry),
        Scene('the same in another order in memory: apart by', 0, EXACT, disorder),
        Scene('break without friction: change of momentum [m/s]', 0, EXACT, unbalanced),
        Scene('break: greatest gain of energy in a tick [J/kg]', 0, 1e-7, gained),
        Scene('break: greatest overlap [m]', 0, DEEP, squeezed),
        Scene(
            'oblique impact, slipping: error of velocity and spin [m/s]',
            0,
            EXACT,
            of(thrown, 0.05, 0.8),
        ),
        Scene('oblique impact, gripping', 0, EXACT, of(thrown, 1.0, 0.3)),
        Scene('rolling into an equal ball: off 2/7 and 5/7 of its speed [m/s]', 0, EXACT, follow),
    ),
    'Piles': (
        Scene(
            '20 balls poured into a bowl mesh rest, and stay so, after [s]',
            0,
            20,
            of(rests_after, IN_A_BOWL, 20),
        ),
        Scene('their overlap [m]', -1, 1e-4, of(heaped, IN_A_BOWL, 20)),
        Scene(
            '60 balls poured into a box rest, and stay so, after [s]',
            0,
            20,
            of(rests_after, box(0.2), 60),
        ),
        Scene('their overlap [m]', -1, 1e-4, of(heaped, box(0.2), 60)),
        Scene(
            '12 random towers fall into a box: deepest in anything on the way [m]',
            0,
            2.5e-4,
            of(crammed, 12),
        ),
    ),
    'Rest': (
        Scene('V groove of 45 degrees: speed [m/s]', 0, CREEPING, of(groove, 45)),
        Scene('groove of 80 degrees', 0, CREEPING, of(groove, 80)),
        Scene('corner of three planes', 0, CREEPING, corner),
        Scene('between trunk and ground', 0, CREEPING, wedged),
        Scene('a fat ball between flagstick and wall', 0, CREEPING, wedged_in_the_hole),
        Scene('swinging in a bowl: period over sqrt(7 (R - r) / (5 g)) 2 pi', 0.995, 1.005, swing),
        Scene('balanced on a ridge: gone aside [m]', 0, DEEP, ridge),
        Scene('dropped 1 mm beside a vertex: gone to that side [m]', 1e-3, 9, vertex),
        Scene('turning on the spot: error of the time left [s]', 0, EXACT, pivot),
        Scene(
            'slopes of 36 on which it rests and must not, or the other way round',
            0,
            0,
            holds_wrongly,
        ),
    ),
    'Curved and faceted ground': (
        Scene('over a crest at 0.98 sqrt(g R): flies', 0, 0, of(crest, 0.98)),
        Scene('over a crest at 1.02 sqrt(g R): flies', 1, 1, of(crest, 1.02)),
        Scene('flat floor of 202 triangles: vertical speed [m/s]', 0, EXACT, bumps),
        Scene('the same: off the roll on a plane [m, rad]', 0, EXACT, strays),
        Scene('tilted plane of heights: off the plane [m]', 0, 1e-6, of(tilted, 'heights'), 1e-4),
        Scene(
            'tilted plane of triangles: off the plane [m]', 0, 1e-6, of(tilted, 'triangles'), 1e-4
        ),
    ),
    'The hole': (
        Scene(
            '10 mm off centre: lowest speed that escapes [m/s]', 1.40, 1.70, of(escapes_at, 0.01)
        ),
        Scene('half a radius off centre', 1.0, 1.4, of(escapes_at, 0.5 * HOLE)),
        Scene('dead centre', 1.31, 2.3, of(escapes_at, 0.0)),
        Scene('of 19 putts at 3 m/s: holed', 0, 0, of(holed, 3.0)),
        Scene('lip-out at 1.5 m/s: turned by [deg]', 10, 180, lips_out),
        Scene('of 10 slow putts: not at rest on the bottom', 0, 0, of(on_the_bottom, 0.0)),
        Scene('the same on a slope of 5 %', 0, 0, of(on_the_bottom, 0.05)),
    ),
}
