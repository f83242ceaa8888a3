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

"""The same strikes on a plane, on patches and on height maps; and what the presets cost there.

A time is a slope: that of many shots less that of few, so that a call's own cost stands apart.
"""

from statistics import median

from golf_sim_ros.course import load_course
from golf_sim_ros.physics import ACCURACY, simulate_many
from golf_sim_ros.study.grounds import spread, STRIKES
from golf_sim_ros.study.scenes import as_heights, hills, level
from shots import ground
from timing import clocked, Row

COURSES = 'golf_without_friends', 'links', 'putting_green'
FEW, MANY = 200, 2200  # shots
ROUNDS = 5
WANTED = {  # times the plane's, at `standard`
    ('drive', 'golf_without_friends'): 2.0,
    ('drive', 'links'): 5.0,
    ('chip', 'links'): 8.0,
    ('putt', 'links'): 20.0,
    ('putt', 'putting_green'): 40.0,
}
SKETCH = {'plane': 0.8, 'links': 0.6, 'putting_green': 0.6}  # of the time of `standard`
BLOWING = {'wind': (5.0, 3.0, 0.0)}
ONE_CALL = 100  # calls


def rows(quick):
    """`Row` of each strike on each ground and of each preset there."""
    courses = {'plane': level(ground('fairway')), **{name: load_course(name) for name in COURSES}}
    for strike in STRIKES:
        volleys = {name: volley(course, strike) for name, course in courses.items()}
        times = slopes(list(volleys.values()))
        for (name, _), time in zip(volleys.items(), times):
            yield Row(
                f'{strike} on {name}, over the plane',
                time / times[0],
                most=WANTED.get((strike, name), 1e9),
                times=(time, times[0]),
            )
    greens = {'a plane green': level(ground('green')), 'putting_green': courses['putting_green']}
    least = {'a plane green': 1e5, 'putting_green': 1.2e4}
    for (name, course), time in zip(
        greens.items(), slopes([volley(course, 'putt') for course in greens.values()])
    ):
        yield Row(f'putts a second on {name}, one thread', 1.0 / time, '', least=least[name])
    for name in ('plane', 'links', 'putting_green'):
        for strike in STRIKES if not quick else ('chip',):
            yield from presets(f'{strike} on {name}', courses[name], strike, SKETCH[name])
    yield from presets('drive on plane in wind', courses['plane'], 'drive', 0.6, **BLOWING)
    yield from presets('drive on links in wind', courses['links'], 'drive', 0.6, **BLOWING)
    mesh = hills(100_000)
    times = slopes([volley(mesh, 'chip'), volley(as_heights(mesh), 'chip')])
    yield Row(
        'chip on 100,000 triangles, over the same as heights',
        times[0] / times[1],
        most=2.0,
        times=tuple(times),
    )
    one = volley(courses['links'], 'drive')
    one(1)
    calls = [clocked(lambda: one(1)) for _ in range(ONE_CALL)]
    yield Row('a call of one drive on links', 1e3 * median(calls), 'ms', most=1.0)


def presets(name, course, strike, most, **how):
    """`Row` of each preset's time over that of `standard`."""
    times = dict(zip(ACCURACY, slopes([volley(course, strike, a, **how) for a in ACCURACY])))
    for accuracy in ACCURACY:
        if accuracy != 'standard':
            yield Row(
                f'{name}: {accuracy} over standard',
                times[accuracy] / times['standard'],
                most=most if accuracy == 'sketch' else 1e9,
                times=(times[accuracy], times['standard']),
            )


def volley(course, strike, accuracy='standard', **how):
    """Return a function that plays so many strikes, each a little different."""
    velocities, spins = spread(strike, MANY)

    def play(count):
        simulate_many(course, velocities[:count], spins[:count], accuracy=accuracy, **how)

    return play


def slopes(volleys):
    """Processor time [s] of a shot of each of the `volleys`, timed in turns."""
    for play in volleys:
        play(MANY)
    rounds = [
        [clocked(lambda: play(MANY)) - clocked(lambda: play(FEW)) for play in volleys]
        for _ in range(ROUNDS)
    ]
    return [median(times) / (MANY - FEW) for times in zip(*rounds)]
