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

"""Courses and shots that tests of the physics share.

A new combination of effects takes half a minute to compile, so nearly all tests use one of two:
EVERYTHING, which does nothing more on hard ground than on soft, and GRAVITY. Worlds share one
program for all effects of these, and `simulate_many` has one for each combination: so hundreds of
shots are played `one_by_one`, and a few with other effects in plain Python.
"""

from math import cos, radians, sin

from golf_sim_ros.physics import (
    ACCURACY,
    Course,
    Material,
    Patch,
    PENNER,
    Plane,
    Restitution,
    Result,
    World,
)
from golf_sim_ros.physics.response.ground_impact import ON_RELIEF
import numpy as np

EVERYTHING = ('gravity', 'drag', 'magnus', 'spin_decay', 'turf')
GRAVITY = ('gravity',)

TURF = Material('fairway', PENNER, 0.0, 0.45, 0.40, 0.13, 0.004, 1.0)
HARD = Material('hard', Restitution(0.5), 0.0, 0.5, 0.4, 0.1, 0.003)


def level(material, **more):
    """Course of one level plane through the origin."""
    return Course((Plane(material=material),), **more)


def as_on_relief(accuracy):
    """Preset that sums bounces on planes from the same speed on as `accuracy` does on relief."""
    preset = ACCURACY[accuracy]
    settle = ON_RELIEF * preset.limits.settle
    return preset._replace(limits=preset.limits._replace(settle=settle))


def slope(angle, material):
    """Course of one plane that falls towards +x at `angle`."""
    return Course((Plane(normal=(sin(angle), 0.0, cos(angle)), material=material),))


def hilly(move=(0.0, 0.0, 0.0), turn=0.0):
    """Make a fairway that falls and a green beyond, in rough.

    All is turned about the tee by `turn`, then moved.
    """

    def turned(x, y, z):
        return cos(turn) * x - sin(turn) * y, sin(turn) * x + cos(turn) * y, z

    def placed(*place):
        return tuple(float(a + b) for a, b in zip(turned(*place), move))

    normal = np.array((0.05, 0.03, 1.0)) / np.linalg.norm((0.05, 0.03, 1.0))
    return Course(
        (
            Plane(placed(0, 0, -1), material=TURF),
            Patch(placed(30, 0, 0), turned(*normal), turn, 80, 60, HARD),
            Patch(placed(120, 10, -0.5), turned(0, 0, 1), turn + 0.4, 90, 60, TURF),
        ),
        tee=placed(0, 0, 0)[:2],
    )


def down(angle):
    """Find the unit vector down that slope."""
    return np.array((cos(angle), 0.0, -sin(angle)))


def launched(speed, angle, azimuth=0.0):
    """Velocity of a ball launched at `angle` above the level, `azimuth` from x towards y [rad]."""
    level_speed = speed * np.cos(angle)
    return np.stack(
        (level_speed * np.cos(azimuth), level_speed * np.sin(azimuth), speed * np.sin(angle)), -1
    )


DRIVE = launched(74.7, radians(10.9)), (0.0, -2686 * 2 * np.pi / 60, 0.0)


def random_shots(n, seed):
    """Velocities and spins of `n` shots: 5 to 90 m/s, 2 to 60 degrees high, any spin.

    Spins are up to 1000 rad/s, about any axis.
    """
    rng = np.random.default_rng(seed)
    velocities = launched(
        rng.uniform(5, 90, n),
        np.radians(rng.uniform(2, 60, n)),
        np.radians(rng.uniform(-20, 20, n)),
    )
    axes = rng.normal(size=(n, 3))
    spins = axes / np.linalg.norm(axes, axis=1)[:, None] * rng.uniform(0, 1000, n)[:, None]
    return velocities, spins


def one_by_one(course, velocities, spins, **how):
    """Play shots in one world: their results, a dict of arrays by the fields of `Result`."""
    world, ends = World(course, **how), []
    for velocity, spin in zip(velocities, spins):
        world.reset()
        world.strike('ball', velocity, spin)
        ends += [event for event in world.advance(301.0) if isinstance(event, Result)]
    assert len(ends) == len(velocities)
    return {name: np.array(told) for name, told in zip(Result._fields, zip(*ends))}


def first_touches(shots, velocities):
    """Horizontal way (n, 2) from strike to first contact of `shots` struck at `velocities`."""
    heading = np.arctan2(velocities[:, 1], velocities[:, 0])
    ahead, left = np.sqrt(shots['carry'] ** 2 - shots['carry_side'] ** 2), shots['carry_side']
    return np.stack(
        (
            ahead * np.cos(heading) - left * np.sin(heading),
            ahead * np.sin(heading) + left * np.cos(heading),
        ),
        -1,
    )
