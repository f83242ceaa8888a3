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

"""Compilation in a child process, which keeps the compiler's memory, and its crashes, to itself.

As a program, ``python -m golf_sim_ros.physics.jit.build`` reads a pickled `Job` and runs it, so
that what it needs is compiled and in the cache afterwards. It writes its progress to stdout, a
share a line.
"""

from contextlib import contextmanager
import hashlib
from importlib import import_module, metadata
import importlib.util
import os
from pathlib import Path
import pickle
import platform
import signal
import subprocess
import sys
import tempfile
from threading import Event, Thread
from typing import Any, Callable, cast, IO, Iterable, Iterator, Mapping, NamedTuple, Optional

from . import cache, GENERICS, Unavailable

COMPILING, LOADING, READY, BUILD_FAILED = 'compiling', 'loading', 'ready', 'failed'
ORDINARY_LINKING = {'GOLF_SIM_ROS_ORDINARY_LINKING': '1'}
PROGRAM = 'golf_sim_ros.physics.jit.build'
LOW = 10  # niceness of a child that is not urgent: a tenth of the time of others, but never none
INSTALL = (
    'pip install numba, in a virtual environment made with '
    "'python3 -m venv --system-site-packages'"
)


def missing() -> str:
    """Reason why there can be no compiled engine here, one line, or ''.

    Numba is not imported for it.
    """
    if importlib.util.find_spec('numba') is None:
        return f'numba is not installed: {INSTALL}'
    if os.environ.get('NUMBA_DISABLE_JIT', '0') not in ('', '0'):
        return 'NUMBA_DISABLE_JIT is set'
    return ''


class Part(NamedTuple):
    """Program called `key`, all of which ``function(*args)`` runs."""

    key: str
    function: Callable[..., Any]
    args: tuple[Any, ...]


class Job(NamedTuple):
    """Job of a child of some `niceness`.

    It imports `modules`, which may register effects, and runs `parts`.
    """

    niceness: int
    modules: tuple[str, ...]
    parts: tuple[Part, ...]


class Build:
    """Compiled code on its way: a child compiles what `parts` need, then this process loads it.

    It starts at once, in a thread; the child has a low priority, unless it is `urgent`. `state` is
    'compiling', 'loading', 'ready' or 'failed', `progress` the share of the compilation that is
    done, `reason` one line that says why it failed.
    """

    def __init__(self, urgent: bool, *parts: Part) -> None:
        self.state, self.progress, self.reason = COMPILING, 0.0, ''
        self.ended = Event()
        self.child: Optional[subprocess.Popen[bytes]] = None
        self.job = Job(0 if urgent else LOW, foreign_modules(), parts)
        Thread(target=self._run, name='build of the physics', daemon=True).start()

    def wait(self, seconds: Optional[float] = None) -> bool:
        """Wait for the end of the build, `seconds` at most; whether it has ended."""
        return self.ended.wait(seconds)

    def _run(self) -> None:
        try:
            self._compile_and_load()
            self.state = READY
        except Unavailable as error:
            self.state, self.reason = BUILD_FAILED, str(error)
        except Exception as error:  # whatever a compiler may raise: plain Python goes on
            self.state = BUILD_FAILED
            self.reason = f'{type(error).__name__}: {" ".join(str(error).split())[:200]}'
        finally:
            self.ended.set()

    def _compile_and_load(self) -> None:
        if missing():
            raise Unavailable(missing())
        if not all(is_kept(part.key) for part in self.job.parts):
            if not cache.folder().writable:
                raise Unavailable(cache.folder().reason)
            trouble = self._compile({})
            # The internals of numba that are used may be what fails: once more without them.
            if trouble and self._compile(ORDINARY_LINKING):
                raise Unavailable(trouble)
        self.state = LOADING
        run_child(self.job.parts)

    def _compile(self, environment: Mapping[str, str]) -> str:
        """Compile in a child; the reason why it could not, or ''."""
        if '__main__' in self.job.modules:
            raise Unavailable(
                'effects of the main program cannot be handed to a child process; '
                'put them into a module'
            )
        try:
            job = pickle.dumps(self.job)
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            raise Unavailable(f'the scene cannot be handed to a child process: {error}') from None
        with tempfile.TemporaryFile() as errors:
            self.child = child = subprocess.Popen(
                [sys.executable, '-m', PROGRAM],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                env={
                    **os.environ,
                    **environment,
                    'PYTHONPATH': os.pathsep.join(filter(None, sys.path)),
                },
            )
            with child:
                _hand_over(cast(IO[bytes], child.stdin), job)
                for line in cast(IO[bytes], child.stdout):
                    self.progress = float(line)
            errors.seek(0)
            return trouble(child.returncode, errors.read().decode(errors='replace'))


def _hand_over(stdin: IO[bytes], job: bytes) -> None:
    """Give a child its job; the pipe stays open, for the child ends with it."""
    try:
        stdin.write(job)
        stdin.flush()
    except BrokenPipeError:
        pass  # the child has ended, and its exit code says why


def foreign_modules() -> tuple[str, ...]:
    """Names of the modules of other packages that add to the physics.

    Those of effects that users have registered.
    """
    names = {function.__module__ for generic in GENERICS for function in generic.cases.values()}
    return tuple(
        sorted(name for name in names if name.partition('.')[0] != __name__.partition('.')[0])
    )


def is_kept(key: str) -> bool:
    """Whether the program called `key` has been compiled on this machine, and is in the cache."""
    return not missing() and cache.folder().path is not None and mark(key).exists()


def mark(key: str) -> Path:
    """Path of the file that says that the program called `key` is in the cache."""
    made_with = [metadata.version(package) for package in ('numba', 'llvmlite', 'numpy')]
    text = ' '.join([key, platform.python_version(), *made_with, processor()])
    return cache.trusted_path() / f'{hashlib.sha256(text.encode()).hexdigest()[:16]}.compiled'


def processor() -> str:
    """Target processor of the machine code.

    NUMBA_CPU_NAME, or else all that Linux reports of this one.
    """
    named = os.environ.get('NUMBA_CPU_NAME', '') + os.environ.get('NUMBA_CPU_FEATURES', '')
    try:
        with open('/proc/cpuinfo', encoding='utf-8') as file:
            about = {
                line for line in file if line.startswith(('model', 'flags', 'Features', 'CPU'))
            }
    except OSError:
        about = {platform.processor()}
    return f'{platform.machine()} {named or sorted(about)}'


def trouble(code: int, errors: str) -> str:
    """Reason of a child's failure in one line, from its exit code and the last of its output.

    '' if none.
    """
    if code == 0:
        return ''
    lines = [line.strip() for line in errors.splitlines() if line.strip()]
    ended = f'exit code {code}' if code > 0 else f'killed by {signal.Signals(-code).name}'
    named = [line for line in lines if 'rror' in line]  # after which there may be frames
    last = (named or lines or ['it did not say why'])[-1][:200]
    return f'{numba_version()} could not compile the physics ({ended}): {last}'


def numba_version() -> str:
    """Numba's name and version."""
    return f'numba {metadata.version("numba")}'


def main() -> int:
    """Run the job that comes in, as long as who sent it lives."""
    # Not sys.stdin: the lock of its buffer, in which the thread would wait, is in the way at the
    # end.
    job = pickle.load(open(0, 'rb', closefd=False))
    os.nice(job.niceness)
    Thread(target=end_with_parent, daemon=True).start()
    for module in job.modules:
        import_module(module)
    from .progress import telling_progress

    with telling_progress(sys.stdout, len(job.parts)), is_alone_in_process():
        for part in job.parts:
            if not is_kept(part.key):  # by another child, for which this one has waited
                run_child([part])
                mark(part.key).touch()
    return 0


@contextmanager
def is_alone_in_process() -> Iterator[None]:
    """Lock across processes: no other child compiles meanwhile.

    For that may be what this one needs, too.
    """
    import fcntl

    with open(cache.trusted_path() / 'lock', 'w') as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def run_child(parts: Iterable[Part]) -> None:
    """Run `parts`, which compiles or loads what they need."""
    for part in parts:
        part.function(*part.args)


def end_with_parent() -> None:
    """End this process as soon as its stdin is closed: its parent has ended."""
    while os.read(0, 1):
        pass
    os._exit(1)


if __name__ == '__main__':
    sys.exit(main())
