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

"""Random scenes of numbers that a course file may say, at its edges too; five shots in each."""

import json
from math import isfinite, pi
from pathlib import Path
import shutil
from time import process_time
from typing import NamedTuple

from golf_sim_ros.course import CourseError, load_course, shipped_courses
from golf_sim_ros.physics import ACCURACY, Phase, Rejected, Result, World
from golf_sim_ros.recording.journal import sealed
from golf_sim_ros.recording.json_format import collision_text, result_text, state_text
import numpy as np
import yaml

SHOTS = 5
MOST_TIME = 5.0  # s of processor time that any call may take
LONGEST = 60.0  # s of simulated time, after which a shot is ended by a reset
RATES = (10.0, 50.0, 250.0, 1000.0)
FEW_TICKS = 40  # of each shot; from then on it is advanced by whole seconds
STANDING = (Phase.REST, Phase.HOLED, Phase.WATER, Phase.OUT)


class Outcome(NamedTuple):
    """What came of a scene: why it was refused, or how its shots ended; its slowest call [s]."""

    refused: str
    statuses: tuple
    slowest: float
    trouble: str


class Trouble(Exception):
    """Something that must not happen; the message says what."""


def log_uniform(rng, low, high):
    """Draw a number between `low` and `high`, as often of one size as of another."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def number(rng, low, high, *usual):
    """Draw a number from `low` to `high`: often an edge, often one of the `usual`, else any."""
    choice = rng.integers(4)
    if choice == 0:
        return float(rng.choice([low, high]))
    if choice == 1 and usual:
        return float(rng.choice(usual))
    if low >= 0.0 and choice == 2:
        return log_uniform(rng, max(low, 1e-6 * high), high)
    return float(rng.uniform(low, high))


def material(rng):
    """Entry of a material."""
    law = {
        'law': 'quadratic',
        'e0': number(rng, 0, 1, 0.5, 1.0),
        'e1': number(rng, -10, 10, 0.0),
        'e2': number(rng, -10, 10, 0.0),
        'floor': number(rng, 0, 1, 0.1),
    }
    fields = {
        'restitution': [{'law': 'penner'}, number(rng, 0, 1, 0.5), law][rng.integers(3)],
        'tangential_restitution': number(rng, -1, 1, 0.0),
        'static_friction': number(rng, 0, 1e6, 0.4, 1.0),
        'dynamic_friction': number(rng, 0, 1e6, 0.3, 0.0),
        'rolling_resistance': number(rng, 0, 1e6, 0.1, 0.0),
        'pivot_friction': number(rng, 0, 1e6, 0.002, 0.0),
        'softness': number(rng, 0, 100, 1.0, 0.0),
    }
    kept = [name for name in fields if rng.random() < 0.6]
    # A stream of their own: a seed's scene stays what it was, but for these.
    own = np.random.default_rng(rng.bit_generator.seed_seq.spawn(1)[0])
    newer = {
        'resistance_growth': number(own, 0, 100, 0.07, 0.0),
        'ploughing': number(own, 0, 100, 0.7, 0.0),
    }
    kept_newer = [name for name in newer if own.random() < 0.3]
    return {name: {**fields, **newer}[name] for name in (*kept, *kept_newer)}


def ball(rng):
    """Entry of a ball."""
    fields = {
        'mass': log_uniform(rng, 1e-6, 1000),
        'radius': log_uniform(rng, 1e-3, 1.0),
        'inertia': number(rng, 0.01, 1, 0.4),
        'restitution': number(rng, 0, 1, 0.85),
        'friction': number(rng, 0, 1e6, 0.2),
    }
    return {name: value for name, value in fields.items() if rng.random() < 0.4}


def air(rng):
    """Entry of the air."""
    if rng.random() < 0.3:
        return {'altitude': number(rng, -1000, 11000, 0.0)}
    return {
        'temperature': number(rng, 150, 400, 293.0),
        'pressure': number(rng, 1.0, 1e7, 101325.0),
        'relative_humidity': 0.0,
    }


def polygon(rng, size):
    """Corners of a star around some place."""
    x, y = rng.uniform(-size, size, 2)
    angles = np.sort(rng.uniform(0, 2 * pi, rng.integers(3, 8)))
    away = rng.uniform(0.3, 1.0, len(angles)) * size
    return [
        [round(float(x + r * np.cos(a)), 2), round(float(y + r * np.sin(a)), 2)]
        for a, r in zip(angles, away)
    ]


def ground(rng, folder):
    """Entries of random ground."""
    names = ['green', 'fairway', 'rough', 'sand']
    tilt = rng.normal(size=2) * rng.choice([0.0, 0.05, 0.5, 5.0])
    shapes = [
        {'shape': 'plane', 'material': str(rng.choice(names)), 'normal': [*tilt.tolist(), 1.0]}
    ]
    for _ in range(rng.integers(0, 4)):
        normal = rng.normal(size=3).tolist()
        center = rng.uniform(-10, 10, 3).round(2).tolist()
        shapes.append(
            {
                'shape': 'patch',
                'center': center,
                'normal': normal,
                'length': number(rng, 1e-3, 100, 5.0),
                'width': number(rng, 1e-3, 100, 5.0),
                'heading': float(rng.uniform(-7, 7)),
                'material': str(rng.choice(names)),
                'one_sided': bool(rng.integers(2)),
            }
        )
    if rng.random() < 0.5:
        jump = log_uniform(rng, 1e-3, 1e4)
        heights = jump * rng.choice([rng.normal(size=(12, 9)), rng.integers(0, 2, (12, 9)) * 1.0])
        np.save(folder / 'random.npy', heights)
        shapes.append(
            {
                'shape': 'heightmap',
                'heights': 'random.npy',
                'material': str(rng.choice(names)),
                'origin': rng.uniform(-10, 0, 2).tolist(),
                'spacing': number(rng, 1e-3, 50, 0.5, 2.0),
            }
        )
    return shapes


def scene(rng, folder):
    """Content of a course file in `folder`: a shipped one with other numbers, or other ground."""
    shipped = shipped_courses()
    path = shipped[str(rng.choice(sorted(shipped)))]
    for file in path.parent.glob('*.[ns][pt][yl]'):
        shutil.copy(file, folder)
    content = yaml.safe_load(path.read_text())
    if rng.random() < 0.5:
        content = {
            'format': 1,
            'ground': ground(rng, folder),
            'tee': rng.uniform(-5, 5, 2).tolist(),
        }
        if rng.random() < 0.3:
            content['hole'] = rng.uniform(-9, 9, 2).tolist()
        if rng.random() < 0.3:
            content['water'] = [{'polygon': polygon(rng, 8.0), 'level': number(rng, -10, 10, 0.0)}]
        if rng.random() < 0.3:
            content['bounds'] = polygon(rng, 20.0)
    if rng.random() < 0.5:
        content.setdefault('obstacles', []).extend(
            obstacle(rng) for _ in range(rng.integers(1, 4))
        )
    used = {shape['material'] for shape in content['ground']} | {'green', 'fairway', 'rough'}
    content['materials'] = {name: material(rng) for name in sorted(used) if rng.random() < 0.6}
    for name, entry in (('ball', ball), ('air', air)):
        if rng.random() < 0.4:
            content[name] = entry(rng)
    return content


def obstacle(rng):
    """Entry of an obstacle."""
    place = rng.uniform(-10, 10, 3).round(2).tolist()
    radius = number(rng, 1e-3, 50, 0.3)
    if rng.random() < 0.5:
        return {'shape': 'sphere', 'center': place, 'radius': radius, 'material': 'wood'}
    return {
        'shape': 'cylinder',
        'base': place,
        'radius': radius,
        'height': number(rng, 1e-3, 100, 3.0),
        'material': 'wood',
    }


def direction(rng):
    """Draw a unit vector."""
    way = rng.normal(size=3)
    return way / np.linalg.norm(way)


def strike(rng):
    """Velocity and spin that may be struck, from the weakest to the hardest."""
    speed = rng.choice([log_uniform(rng, 1e-12, 1.0), rng.uniform(0, 149.9), 149.9])
    way = direction(rng)
    if rng.random() < 0.5:
        way[2] = abs(way[2])
    spin = rng.choice([0.0, rng.uniform(0, 2499.0), 2499.0])
    return tuple((speed * way).tolist()), tuple((spin * direction(rng)).tolist())


class Watch:
    """Times calls by the processor's clock."""

    def __init__(self):
        self.slowest, self.what = 0.0, ''

    def __call__(self, what, *arguments):
        began = process_time()
        try:
            return what(*arguments)
        finally:
            took = process_time() - began
            if took > self.slowest:
                self.slowest, self.what = took, what.__name__


def played(seed, folder):
    """`Outcome` of the scene of that seed; its files are written to `folder`."""
    rng, watch, folder = np.random.default_rng(seed), Watch(), Path(folder)
    path = folder / 'scene.yaml'
    path.write_text(yaml.safe_dump(scene(rng, folder)))
    names = ('ball', 'other', 'third')[: rng.choice([1, 1, 2, 3])]
    accuracy = str(rng.choice(list(ACCURACY)))
    try:
        exercise(load_course(path), names, accuracy)  # what comes now is timed
        course = watch(load_course, path)
        world = World(course, names, accuracy=accuracy)
    except CourseError as error:
        return Outcome(str(error), (), 0.0, '')
    except ValueError as error:
        return Outcome(
            f'World: {error}', (), 0.0, '' if len(names) > 1 else f'World refuses: {error}'
        )
    try:
        statuses = [status for _ in range(SHOTS) for status in shot(world, rng, watch)]
    except Trouble as error:
        return Outcome('', (), watch.slowest, str(error))
    slow = f'slow: {watch.what}' if watch.slowest > MOST_TIME else ''
    return Outcome('', tuple(statuses), watch.slowest, slow)


def exercise(course, names, accuracy):
    """Let a ball set off, so that nothing is left to be compiled or loaded."""
    world = World(course, names, accuracy=accuracy)
    world.strike(names[0], (1.0, 0.0, 1.0))
    world.advance(0.0)


def shot(world, rng, watch):
    """Statuses of the shots of a strike at each ball, after a place or a wind now and then."""
    rate, struck, events = rng.choice(RATES), 0, []
    if rng.random() < 0.3:
        watch(world.set_wind, direction(rng) * rng.choice([1.0, 10.0, 99.9]))
    for name in world.names:
        if rng.random() < 0.3 and world[name].phase in STANDING:
            try:
                watch(world.place, name, rng.uniform(-12, 12, 2))
            except ValueError:
                pass
        sealed({'entry': 0, **state_text(world)})
        try:
            watch(world.strike, name, *strike(rng))
            struck += 1
        except Rejected:
            pass
        events += world.happened()
    if rng.random() < 0.2:
        watch(world.set_wind, direction(rng) * 20.0)
    events += run(world, rate, watch)
    check(world, events, struck)
    return [event.status for event in events if isinstance(event, Result)]


def run(world, rate, watch):
    """Play until nothing moves, or until a reset after LONGEST: what happens."""
    events, tick, end = [], 1.0 / rate, world.time + LONGEST
    while world.moving and world.time < end:
        events += watch(world.advance, tick)
        state_text(world)
        early = world.time < end - LONGEST + FEW_TICKS / rate
        tick = 1.0 / rate if early else 1.0
    if world.moving:
        aborted = watch(world.reset)
        events += [*world.happened(), *aborted]
    return events + world.happened()


def check(world, events, struck):
    """Raise `Trouble` where something is wrong with the events, or with the balls."""
    results = [event for event in events if isinstance(event, Result)]
    if len({result.shot for result in results}) != struck or len(results) != struck:
        raise Trouble(f'{struck} strikes, results {[result.shot for result in results]}')
    for event in events:
        text = result_text(event, 1) if isinstance(event, Result) else collision_text(event)
        if isinstance(event, Result) and 'null' in json.dumps({**json.loads(text), 'to_hole': 0}):
            raise Trouble(f'a number of a result is not finite: {text}')
    for name in world.names:
        ball = world[name]
        if not all(map(isfinite, (*ball.position, *ball.velocity, *ball.spin))):
            raise Trouble(f'{name} is not finite: {ball}')
        if ball.phase not in STANDING:
            raise Trouble(f'{name} still moves: {ball}')
