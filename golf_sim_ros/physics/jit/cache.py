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

"""Cache folder of compiled code, and whether its content can be trusted.

Compiled code is stored as pickles: loading runs it. So it is read only where nobody but this user
and root can have put it.
"""

from functools import lru_cache
import hashlib
import os
from pathlib import Path
import stat
import tempfile
from typing import NamedTuple, NoReturn, Optional

NAME = 'golf_sim_ros'
CACHE_VARIABLE = 'GOLF_SIM_ROS_CACHE'
# Elsewhere than on POSIX these bits mean nothing.
OTHERS_WRITE = (stat.S_IWGRP | stat.S_IWOTH) * (os.name == 'posix')
OTHERS_ENTER = stat.S_IXGRP | stat.S_IXOTH
LINKS = 40  # links of a path that are followed: as many as Linux does
FALLBACK = '/tmp' if os.name == 'posix' else tempfile.gettempdir()
LEAST_SPACE = 1 << 16  # bytes that a folder has to take in to count as writable


class Cache(NamedTuple):
    """Folder where compiled code is read and written.

    Parameters
    ----------
    path : Path or None
        The folder, absolute; None where no folder can be trusted.
    writable : bool
        Whether new code may be saved there, too.
    reason : str
        One line: why it is not the place that it would be by default, or not writable. Else empty.
    """

    path: Optional[Path]
    writable: bool
    reason: str


class _Refused(Exception):
    """A folder that is refused; one line says why."""


@lru_cache(maxsize=None)
def source_key() -> str:
    """Hash of all sources of the physics, as they were at the first call."""
    top = Path(__file__).parent.parent
    digest = hashlib.sha256()
    for source in sorted(top.rglob('*.py')):
        digest.update(f'{source.relative_to(top).as_posix()}\0'.encode())
        digest.update(source.read_bytes())
    return digest.hexdigest()[:16]


def folder() -> Cache:
    """`Cache` for this user and these sources, created where there is none.

    The variable GOLF_SIM_ROS_CACHE names the folder, or else NUMBA_CACHE_DIR does, which holds no
    folder for each version of the sources. Otherwise it is the first that can be used of the
    user's cache (XDG_CACHE_HOME, or ``~/.cache``) and a temporary folder of the user's own.
    """
    if os.environ.get(CACHE_VARIABLE):
        return _named(CACHE_VARIABLE, source_key())
    if os.environ.get('NUMBA_CACHE_DIR'):
        return _named('NUMBA_CACHE_DIR', '')
    reasons = []
    for find in (_user_cache, _temporary):
        try:
            found = _opened(find() / source_key())
        except _Refused as refused:
            reasons.append(str(refused))
        else:
            return found._replace(reason='; '.join(filter(None, [*reasons, found.reason])))
    return Cache(None, False, f'no folder for compiled code: {"; ".join(reasons)}')


def trusted_path() -> Path:
    """Path of `folder`; RuntimeError, with the reason, where there is none."""
    found = folder()
    if found.path is None:
        raise RuntimeError(found.reason)
    return found.path


def _named(variable: str, inside: str) -> Cache:
    """`Cache` in the folder that a variable of the environment names, or none."""
    try:
        named = os.path.expanduser(os.environ[variable])
        if named.startswith('~'):
            raise _Refused(f'{named}: no such home')
        return _opened(Path(named) / inside)
    except _Refused as refused:
        return Cache(None, False, f'{variable}: {refused}')


def _user_cache() -> Path:
    """Folder in the user's cache; a home that does not exist is not created."""
    cache = os.environ.get('XDG_CACHE_HOME', '')
    if os.path.isabs(cache):
        return Path(cache) / NAME
    home = os.path.expanduser('~') if os.environ.get('HOME', '~') else '~'
    if not os.path.isabs(home):
        raise _Refused('there is no home')
    if not os.path.isdir(home):
        raise _Refused(f'the home {home} does not exist')
    return Path(home) / '.cache' / NAME


def _temporary() -> Path:
    """Folder of this user's own among the temporary ones."""
    place = os.environ.get('TMPDIR', '')
    return Path(place if os.path.isdir(place) else FALLBACK) / f'{NAME}_{_user()}'


def _opened(path: Path) -> Cache:
    """`Cache` at `path`, which is created, for this user alone, where there is none."""
    try:
        path = Path.cwd() / path
        _check_way(path)
        for missing in [*reversed(path.parents), path]:
            _make(missing)
        _check_way(path)
        _check_inside(path)
        reason = _unwritable(path)
        if reason and not any(path.iterdir()):
            raise _Refused(reason)
    except OSError as error:
        raise _Refused(f'{error.filename or path}: {error.strerror or error}') from None
    return Cache(path, not reason, reason)


def _make(path: Path) -> None:
    """Create a folder that nobody else can enter, unless something is there."""
    if not os.path.lexists(path):
        try:
            os.mkdir(path, 0o700)
        except FileExistsError:  # another process was faster
            pass


def _check_way(path: Path) -> None:
    """Raise `_Refused` if others can change what is found at `path`.

    What does not exist they can't. Every folder and link on the way has to belong to this user or
    root. Others may write to none of them, except to a temporary folder, where they can't remove
    what is not theirs (the sticky bit).
    """
    here, ahead, links, shared = Path(), list(path.parts), 0, False
    while ahead:
        here = here / ahead.pop(0)
        try:
            status = here.lstat()
        except FileNotFoundError:
            return
        if not (_is_ours(status) or ahead and not shared and _is_outside(status)):
            raise _Refused(f'{here} belongs to another user ({status.st_uid})')
        if stat.S_ISLNK(status.st_mode):
            links += 1
            if links > LINKS:
                raise _Refused(f'{path}: too many links')
            ahead = [*Path(os.readlink(here)).parts, *ahead]
            here = here.parent
            continue
        if not stat.S_ISDIR(status.st_mode):
            raise _Refused(f'{here} is no folder')
        shared = bool(status.st_mode & OTHERS_WRITE)
        if shared and not (ahead and status.st_mode & stat.S_ISVTX):
            raise _Refused(f'{here} can be written by others')


def _check_inside(top: Path) -> None:
    """Raise `_Refused` if something in the folder `top` could have been written by others.

    Where others can't even enter it, they can't write its content, whatever the modes are.
    """
    closed = not top.stat().st_mode & OTHERS_ENTER
    for place, folders, files in os.walk(top, onerror=_raise):
        for name in (*folders, *files):
            path = os.path.join(place, name)
            try:
                status = os.lstat(path)
            except FileNotFoundError:  # another process's, just renamed
                continue
            if not _is_ours(status):
                raise _Refused(f'{path} belongs to another user ({status.st_uid})')
            if stat.S_ISLNK(status.st_mode):
                raise _Refused(f'{path} is a link')
            if status.st_mode & OTHERS_WRITE and not closed:
                raise _Refused(f'{path} can be written by others')


def _raise(error: OSError) -> NoReturn:
    raise error


def _user() -> int:
    """Effective user id; 0, the owner of everything, where there are no user ids."""
    return os.geteuid() if os.name == 'posix' else 0


def _is_ours(status: os.stat_result) -> bool:
    """Whether something belongs to this user or root."""
    return status.st_uid in (0, _user())


def _is_outside(status: os.stat_result) -> bool:
    """Whether something belongs to a user outside of this user namespace.

    There the root folder of the machine may belong to nobody, which is no less safe.
    """
    try:
        nobody = int(Path('/proc/sys/kernel/overflowuid').read_text())
        ranges = [line.split() for line in Path('/proc/self/uid_map').read_text().splitlines()]
    except OSError:
        return False
    return status.st_uid == nobody and not any(
        int(first) <= nobody < int(first) + int(count) for first, _, count in ranges
    )


def _unwritable(path: Path) -> str:
    """Reason why nothing more can be saved in the folder `path`, or ''."""
    try:
        with tempfile.TemporaryFile(dir=path, buffering=0) as file:
            full = file.write(bytes(LEAST_SPACE)) < LEAST_SPACE
    except OSError as error:
        return f'{path}: {error.strerror or error}'
    return f'{path}: there is no room' if full else ''
