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

"""The journal of a play: every input, so that the play can be run again to the bit.

An entry is one JSON object on one line. Its first keys are its number, from 0, its kind, and its
tick: how many ticks had passed when the input was applied. Its last key is a CRC-32 of all that
stands before it, so that a changed byte is noticed.
"""

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
import json
import platform
from typing import Any
from zlib import crc32

from .journal_format import Entry, FORMAT
from .json_format import text, Written
from .. import __version__
from ..physics import BallState, Result, World
from ..physics.jit.cache import source_key

SEAL = ', "crc32": '


class JournalError(ValueError):
    """An entry that cannot be used; one line says why."""


class Journal:
    """Writes entries of the journal.

    Parameters
    ----------
    tell : callable
        Called with the text of each entry.
    """

    def __init__(self, tell: Callable[[str], None]) -> None:
        self.tell = tell
        self.entries = 0

    def note(self, kind: str, tick: int, **values: Any) -> None:
        """Write one more entry."""
        self.tell(sealed({'entry': self.entries, 'kind': kind, 'tick': tick, **values}))
        self.entries += 1

    def config(
        self, world: World, parameters: dict[str, Any], start: int, session: int = 0
    ) -> None:
        """Write the configuration of the play.

        `start`: ROS time [ns] at which simulated time began; `session`: another number for each
        start of the node, whatever that time is.
        """
        course = {
            'name': world.course.name,
            'path': world.course.path,
            'digest': world.course.digest,
        }
        self.note(
            'config',
            0,
            format=FORMAT,
            version=__version__,
            course=course,
            parameters=parameters,
            start=start,
            session=session,
            made_with=made_with(),
        )

    def strike(
        self, tick: int, shot: int, name: str, strike: tuple[tuple, tuple], state: dict[str, Any]
    ) -> None:
        """Write strike number `shot`.

        `strike` is (velocity, spin), `state` that of the world just before.
        """
        velocity, spin = strike
        self.note('strike', tick, shot=shot, ball=name, velocity=velocity, spin=spin, **state)

    def rest(self, tick: int, shot: int, result: Result, ball: BallState) -> None:
        """Write the end of a shot; `ball` is the `BallState` at `tick`."""
        self.note(
            'rest', tick, shot=shot, ball=result.ball, status=result.status, state=standing(ball)
        )


def beginning(config: dict[str, Any]) -> tuple[int, int]:
    """Start and session of a configuration: what tells one start of a sim from another.

    Older journals have no session.
    """
    return config['start'], config.get('session', 0)


def standing(ball: BallState) -> dict[str, Any]:
    """Fields of a `BallState`, for JSON."""
    return {**ball._asdict(), 'phase': ball.phase.name}


def made_with() -> dict[str, str | None]:
    """Versions, physics and processor: where they are the same, so is a play to the bit."""
    return {
        'physics': source_key(),
        'python': platform.python_version(),
        'numpy': _version('numpy'),
        'numba': _version('numba'),
        'processor': _processor(),
    }


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _processor() -> str:
    """Name of the processor, or at least its family.

    Compilers and mathematical libraries adapt to it.
    """
    try:
        with open('/proc/cpuinfo', encoding='utf-8') as file:
            names = [
                line.partition(':')[2].strip() for line in file if line.startswith('model name')
            ]
    except OSError:
        names = []
    return ' '.join([platform.machine(), *names[:1]])


def sealed(entry: Entry) -> str:
    """Text of an entry, with its checksum."""
    parts = (
        f'"{key}": {value if isinstance(value, Written) else text(value)}'
        for key, value in entry.items()
    )
    body = '{' + ', '.join(parts)
    return f'{body}{SEAL}{crc32(body.encode())}}}'


def opened(line: str) -> Entry:
    """Read the entry in a text.

    Raises
    ------
    JournalError
        It is no entry, or not as it was written.
    """
    body, seal, check = line.rpartition(SEAL)
    if not seal:
        raise JournalError(f'{line[:40]!r} is no entry of a journal')
    if check != f'{crc32(body.encode())}}}':
        raise JournalError(f'{title(body)} was changed: its checksum does not fit')
    return json.loads(body + '}')


def title(body: str) -> str:
    """Name of an entry that may be damaged: its first two values, if they can be read."""
    parts = body[:60].split(', ')[:2]
    return 'entry ' + ' '.join(part.partition(': ')[2].strip('"') for part in parts)
