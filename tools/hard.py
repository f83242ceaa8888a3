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

"""Plays every hard case with every preset at 50, 250 and 1000 Hz; writes docs/stability.md.

The cases are those of test/physics/hard_cases, which say what is expected; `make test` plays each
once. With them come those of hard_scenes.py, and random shots at what nothing may pass: so many at
each target at each rate with each preset as `--shots` says (100,000), on all processors. Each part
can be played alone, and the page then shows it beside what the others gave last.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from itertools import product, repeat
from math import inf
from pathlib import Path
import sys

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / 'test'), str(ROOT / 'test' / 'physics')]
from golf_sim_ros.course import load_course  # noqa: E402
from golf_sim_ros.physics import ACCURACY, Phase  # noqa: E402
from golf_sim_ros.physics.engine.engines import prefer_compiled  # noqa: E402
from hard_scenes import SCENES  # noqa: E402
from nothing_passes import TARGETS  # noqa: E402
from test_hard_cases import CASES, play, start  # noqa: E402
import yaml  # noqa: E402

BUILD = ROOT / 'build' / 'hard'
RATES = (50, 250, 1000)  # Hz
SHOTS = 100_000  # at each target, at each rate, with each preset
HEAD = """\
# Hard cases

Made by `make hard`: every case of `test/physics/hard_cases/`, with every preset, at ticks of 50,
250 and 1000 Hz. In all of them the ball must stay finite, out of the ground to 2e-6 m (`sketch`:
1e-5 m, by which it lets a path be off), gain no energy in still air beyond 1e-9 of it and 2e-5
J/kg a tick, and come to its end. A cell is how far from the expected place and velocity it ended,
at the worst of the three rates, in metres and m/s: to be held against `within`, which is asked of
`standard`. A rougher preset may be off by what it promises. *fails* says what did not hold; "as it
may": nothing exact is expected. The tables of
`test/physics/hard_scenes.py` show the figure itself at the worst of the rates, beside the range
that is expected of it.
"""


def deviation(ball, ends):
    """How far a ball is from what is expected of it; 0 where nothing is."""
    pairs = [(ends.get('position', ()), ball.position), (ends.get('velocity', ()), ball.velocity)]
    return max(
        (
            abs(found - wanted)
            for expected, told in pairs
            for wanted, found in zip(expected, told)
            if wanted is not None
        ),
        default=0.0,
    )


def outcome(course, case, accuracy):
    """Worst deviation over the rates, what failed, and how far apart [m] the rates end."""
    worst, failure, told = 0.0, '', []
    for rate in RATES:
        world = start(course, {**case, 'accuracy': accuracy})
        try:
            play(world, {**case, 'tick': 1.0 / rate})
        except AssertionError as error:
            failure = f'{rate} Hz: {str(error).splitlines()[0][:60]}'
            worst = inf
            continue
        ball, ends = world['ball'], case['ends']
        if ball.phase != Phase[ends.get('phase', ball.phase.name)]:
            failure = f'{rate} Hz: {ball.phase.name} instead of {ends["phase"]}'
        worst = max(worst, deviation(ball, ends))
        told.append(ball.position)
    spread = max((max(abs(a - b) for a, b in zip(place, told[0])) for place in told), default=inf)
    return worst, failure, spread


def cell(worst, failure, ends):
    """Write what the table says of an outcome."""
    if failure:
        return f'*fails*, {failure}'
    return f'{worst:.1e}' if 'within' in ends else 'as it may'


def shoot(target, accuracy, rate, count):
    """How many of `count` shots pass a target, and how deep any ball gets into it [m]."""
    off, depth = TARGETS[target]((count, accuracy, rate))
    print(
        f'{target}, {accuracy}, {rate} Hz: {off} of {count:,} passed, {depth:.1e} m deep',
        flush=True,
    )
    return off, depth


def passed(count):
    """Table of how many of `count` shots passed each target, and how deep any ball got into it."""
    lines = [
        '',
        '## Nothing is passed',
        '',
        f'Of {count:,} random shots at each target (0 to 120 m/s, spin to 2000 rad/s, from within',
        '2 m, every fourth grazing), at each of the three rates, so many passed through.',
        'In brackets: how deep any ball was found in it, at any tick [m]. Expected: 0, and no',
        'deeper than 2e-6 m and five times what a preset lets a path be off.',
        '',
        '| target | ' + ' | '.join(ACCURACY) + ' |',
        '|---|' + '---|' * len(ACCURACY),
    ]
    settings = list(product(TARGETS, ACCURACY, RATES))
    with ProcessPoolExecutor() as pool:
        found = dict(zip(settings, pool.map(shoot, *zip(*settings), repeat(count))))
    for target in TARGETS:
        cells = []
        for accuracy in ACCURACY:
            off, depths = zip(*(found[target, accuracy, rate] for rate in RATES))
            allowed = 2e-6 + 5 * ACCURACY[accuracy].limits.path
            fails = sum(off) or max(depths) > allowed
            cells.append(f'{sum(off)} ({max(depths):.1e})' + (' *fails*' if fails else ''))
        lines.append(f'| {target} | ' + ' | '.join(cells) + ' |')
    return lines


def played(scene, accuracy):
    """Write what the table says of a scene's figures at the rates: the worst one."""
    found = [scene.figure(accuracy, rate) for rate in RATES]
    worst = max(found, key=lambda figure: max(scene.least - figure, figure - scene.most))
    return f'{worst:.4g}' + ('' if scene.holds(worst, accuracy) else ' *fails*')


def scenes(count):
    """Tables of the cases that a line of YAML does not hold."""
    lines = []
    for title, some in SCENES.items():
        lines += [
            '',
            f'## {title}',
            '',
            '| case | expected | ' + ' | '.join(ACCURACY) + ' |',
            '|---|---|' + '---|' * len(ACCURACY),
        ]
        for scene in some:
            cells = [played(scene, accuracy) for accuracy in ACCURACY]
            lines.append(
                f'| {scene.name} | {scene.least:g} to {scene.most:g}'
                + (f' (`sketch`: {scene.rough:g})' if scene.rough else '')
                + f' | {" | ".join(cells)} |'
            )
            print(lines[-1], flush=True)
    return lines


def cases(count):
    """Tables of the cases of `test/physics/hard_cases/`, after a summary of them."""
    lines, failures, spreads = [], dict.fromkeys(ACCURACY, 0), []
    for file in sorted({file for file, _ in CASES}):
        path = BUILD / file.name
        path.write_text(
            yaml.safe_dump({'format': 1, **yaml.safe_load(file.read_text())['course']})
        )
        course = load_course(path)
        lines += [
            '',
            f'## {file.stem}',
            '',
            '| case | within | ' + ' | '.join(ACCURACY) + ' |',
            '|---|---|' + '---|' * len(ACCURACY),
        ]
        for _, case in (pair for pair in CASES if pair[0] == file):
            cells = []
            for accuracy in ACCURACY if 'accuracy' not in case else (case['accuracy'],):
                worst, failure, spread = outcome(course, case, accuracy)
                failures[accuracy] += bool(failure)
                spreads.append((spread, case['name'], accuracy))
                cells.append(cell(worst, failure, case['ends']))
            within = case['ends'].get('within', '')
            lines.append(f'| {case["name"]} | {within} | ' + ' | '.join(cells) + ' |')
        print(f'{file.stem}: failures so far {failures}', flush=True)
    spread, name, accuracy = max(item for item in spreads if item[0] < inf)
    return [
        '',
        '## Cases in lines of YAML',
        '',
        f'{len(CASES)} cases. Failures: '
        + ', '.join(f'{accuracy} {count}' for accuracy, count in failures.items())
        + '.',
        f'Greatest difference of an end between the rates: {spread:.1e} m ({name}, {accuracy}).',
        *lines,
    ]


PARTS = {'scenes': scenes, 'shots': passed, 'cases': cases}


def main():
    """Play the parts that are asked for, and write the page from what all of them gave last."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('parts', nargs='*', help=f'some of {", ".join(PARTS)}; all, if left out')
    parser.add_argument('--shots', type=int, default=SHOTS)
    given = parser.parse_args()
    prefer_compiled()
    BUILD.mkdir(parents=True, exist_ok=True)
    for part in given.parts or PARTS:
        (BUILD / f'{part}.md').write_text('\n'.join(PARTS[part](given.shots)) + '\n')
        done = [BUILD / f'{part}.md' for part in PARTS if (BUILD / f'{part}.md').exists()]
        (ROOT / 'docs' / 'stability.md').write_text(
            HEAD + ''.join(path.read_text() for path in done)
        )


if __name__ == '__main__':
    main()
