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

"""What takes the physics a while, in a child process: the page's own stays free for its browsers.

Questions and answers are lines of JSON. The child ends when its standard input does, so nothing
is left where its parent was killed.
"""

import asyncio
from collections.abc import Callable
import json
import os
import signal
import sys
from typing import Any

from . import caddie
from .session import Lie
from ..course import load_course
from ..physics import Course

LONGEST_LINE = 2**22  # bytes of an answer


class Worker:
    """The child process, started when it is first asked. One question at a time."""

    def __init__(self) -> None:
        self.process: asyncio.subprocess.Process | None = None
        self.turn = asyncio.Lock()

    async def ask(self, question: str, lie: Lie, **given: Any) -> Any:
        """Answer of a function of this module's `ANSWERS`; None where there is none."""
        asked = {
            'question': question,
            'course': lie.course.path,
            'place': [float(v) for v in lie.place],
            'wind': [round(float(v), 2) for v in lie.wind],
            **given,
        }
        async with self.turn:
            if self.process is None or self.process.returncode is not None:
                self.process = await started()
            to, back = self.process.stdin, self.process.stdout
            assert to is not None and back is not None
            try:
                to.write(f'{json.dumps(asked)}\n'.encode())
                await to.drain()
                answer = await back.readline()
            except (ConnectionError, ValueError):
                return None
        return json.loads(answer) if answer else None

    def close(self) -> None:
        """End the child."""
        if self.process is not None and self.process.returncode is None:
            self.process.kill()

    async def ended(self) -> None:
        """End the child, and wait until it is gone."""
        self.close()
        if self.process is not None:
            await self.process.wait()


async def started() -> asyncio.subprocess.Process:
    """Start a child process that answers."""
    return await asyncio.create_subprocess_exec(
        sys.executable,
        '-m',
        'golf_sim_ros.view.worker',
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        limit=LONGEST_LINE,
        env={**os.environ, 'GOLF_SIM_ROS_ENGINE': 'python'},
    )


def predict(course: Course, place: list, wind: list, stroke: dict) -> dict | None:
    """Where a stroke would go."""
    return caddie.prediction(course, tuple(place), caddie.Stroke(**stroke), tuple(wind))


def slopes(course: Course, place: list, wind: list) -> list:
    """Slopes around a putt."""
    return caddie.slopes(course, tuple(place))


def line(course: Course, place: list, wind: list) -> list:
    """Path of the putt that holes."""
    return caddie.line(course, tuple(place), tuple(wind))


def choose(course: Course, place: list, wind: list) -> dict:
    """Choose the stroke to play."""
    return caddie.choose(course, tuple(place), tuple(wind))._asdict()


ANSWERS: dict[str, Callable[..., Any]] = {
    'predict': predict,
    'slopes': slopes,
    'line': line,
    'choose': choose,
}


def main() -> None:
    """Answer until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the parent, which ends this
    os.nice(5)
    courses: dict[str, Course] = {}
    for line in sys.stdin:
        given = json.loads(line)
        path = given.pop('course')
        if path not in courses:
            courses = {path: load_course(path)}
        try:
            answer = ANSWERS[given.pop('question')](courses[path], **given)
        except (ArithmeticError, ValueError) as error:  # this answer is none, the next one may be
            print(f'view: {" ".join(str(error).split())}', file=sys.stderr, flush=True)
            answer = None
        print(json.dumps(answer), flush=True)


if __name__ == '__main__':
    main()
