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

"""Looks for what stops the simulator: random scenes, and malformed and extreme messages over DDS.

Scenes are played in a process of their own, so that one that hangs is told by its seed. What is
found is kept as a case in test/data/cases. `--scenes N`, `--messages N` and `--seed S` say how
much, from which seed on.
"""

import argparse
from collections import Counter
from multiprocessing import get_context
from pathlib import Path
import resource
import sys
from tempfile import TemporaryDirectory
import time

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / 'tools')]
from fuzz_scenes import exercise, played  # noqa: E402
from golf_sim_ros.course import load_course, shipped_courses  # noqa: E402

SEED = 20  # the first of the seeds of a run; each scene has its own
PATIENCE = 120.0  # s of wall time, after which a scene hangs
COMPILING = 900.0  # s of wall time, after which the compiler hangs
MEMORY = 100.0  # MB that a worker may grow by in the second half of the scenes: before it compiles


def memory():
    """Greatest memory [MB] of this process so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def work(pipe):
    """Play the scenes whose seeds come through `pipe`, and answer with their outcomes.

    First of all both programs are compiled, of one ball and of several: a hang is to be one of a
    scene.
    """
    course = load_course(shipped_courses()['links'])
    for names in ('ball',), ('ball', 'other'):
        exercise(course, names, 'standard')
    pipe.send(memory())
    while True:
        seed = pipe.recv()
        if seed is None:
            return
        with TemporaryDirectory() as folder:
            try:
                outcome = played(seed, folder)
            except Exception as error:  # whatever it is, it is what we look for
                outcome = None, (), 0.0, f'{type(error).__name__}: {error}'
        pipe.send((tuple(outcome), memory()))


class Worker:
    """A process that plays scenes."""

    def __init__(self):
        context = get_context('spawn')
        self.pipe, other = context.Pipe()
        self.process = context.Process(target=work, args=(other,), daemon=True)
        self.process.start()
        other.close()
        if self.pipe.poll(COMPILING):
            self.pipe.recv()

    def play(self, seed):
        """Outcome and memory of a scene.

        A hang or a death is an outcome, too, and ends the worker.
        """
        self.pipe.send(seed)
        try:
            if self.pipe.poll(PATIENCE):
                return self.pipe.recv()
            trouble = f'hangs for {PATIENCE:g} s'
        except EOFError:
            trouble = 'the process died'
        self.end()
        return (None, (), PATIENCE, trouble), 0.0

    def end(self):
        """End the process."""
        self.process.kill()
        self.process.join()


def scenes(count, seed):
    """Play so many scenes; returns what went wrong, a list of lines."""
    worker, told, refused, troubles = Worker(), Counter(), Counter(), []
    slowest, start, most = 0.0, 0.0, 0.0
    began = time.monotonic()
    for number in range(seed, seed + count):
        (why, statuses, took, trouble), used = worker.play(number)
        told.update(statuses)
        refused[bool(why)] += 1
        slowest = max(slowest, took)
        if trouble:
            troubles.append(f'scene {number}: {trouble} ({took:.1f} s)')
            print(troubles[-1], flush=True)
        if not worker.process.is_alive():
            worker = Worker()
        if number - seed == count // 2:
            start = used
        most = max(most, used)
        if (number - seed) % 100 == 99:
            print(
                f'{number - seed + 1} scenes so far: {dict(told)}, slowest {slowest:.2f} s',
                flush=True,
            )
    worker.pipe.send(None)
    worker.process.join(10.0)
    print(
        f'{count} scenes from seed {seed} in {time.monotonic() - began:.0f} s: '
        f'{refused[False]} played, {refused[True]} refused by name; '
        f'shots: {dict(told)}; slowest call {slowest:.2f} s; '
        f'memory {start:.0f} MB after a half, {most:.0f} MB at most',
        flush=True,
    )
    if start and most > start + MEMORY:
        troubles.append(f'memory grew from {start:.0f} to {most:.0f} MB')
    return troubles


def main(args=None):
    """Look for trouble; the exit code is 0 where there is none."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--scenes', type=int, default=100)
    parser.add_argument(
        '--messages', type=int, default=500, help='malformed ones, and as many extreme ones'
    )
    parser.add_argument('--seed', type=int, default=SEED)
    given = parser.parse_args(args)
    troubles = scenes(given.scenes, given.seed) if given.scenes else []
    if given.messages:
        from fuzz_messages import messages

        troubles += messages(given.messages, given.seed)
    print('\n'.join(troubles) or 'nothing was found')
    return 1 if troubles else 0


if __name__ == '__main__':
    sys.exit(main())
