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

"""Bytes of the files that a course consists of: regular files only, no pointers of Git LFS."""

import os
from os import PathLike
from pathlib import Path
import stat

from .schema import CourseError

MOST = 2**29  # bytes: what is larger is no course
LFS = b'version https://git-lfs.github.com/spec/'
KINDS = {
    stat.S_IFIFO: 'a FIFO',
    stat.S_IFCHR: 'a device',
    stat.S_IFBLK: 'a device',
    stat.S_IFSOCK: 'a socket',
}


def beside(folder: Path, name: str) -> Path:
    """Path of a file that a course in `folder` calls `name`; ``~`` is a home."""
    try:
        return folder / Path(name).expanduser()
    except RuntimeError as error:  # there is no such user
        raise CourseError(f'cannot be read: {error}') from None


def is_there(path: str | PathLike[str]) -> bool:
    """Whether there is a file at `path`, which may be no path at all."""
    try:
        return os.path.isfile(path)
    except (OSError, ValueError):
        return False


def content(path: str | PathLike[str]) -> bytes:
    """Bytes of the file at `path`.

    Raises
    ------
    CourseError
        One line, without the path: it cannot be read, is no regular file, or only stands for one.
    """
    try:
        _refuse_special(os.stat(path).st_mode)  # not opened: that alone may wait, or wind a tape
        with open(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), 'rb') as file:
            found = os.fstat(file.fileno())
            _refuse_special(found.st_mode)
            if found.st_size > MOST:
                raise CourseError(f'is too large: {found.st_size} bytes, at most {MOST}')
            raw = file.read(MOST + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, CourseError):
            raise
        raise CourseError(f'cannot be read: {getattr(error, "strerror", None) or error}') from None
    if not raw:
        raise CourseError('is empty')
    if raw.startswith(LFS):
        raise CourseError('is a Git LFS pointer, not the file itself: `git lfs pull` fetches that')
    return raw


def _refuse_special(mode: int) -> None:
    """Raise where a file of this `mode` is no regular one."""
    kind = KINDS.get(stat.S_IFMT(mode))
    if kind:
        raise CourseError(f'is {kind}, and must be a regular file')
    if stat.S_ISDIR(mode):
        raise CourseError('cannot be read: Is a directory')


def decoded(raw: bytes) -> str:
    """Text of `raw`: UTF-8, or UTF-16 where a byte-order mark says so; without that mark."""
    if raw[:2] in (b'\xff\xfe', b'\xfe\xff'):
        return raw.decode('utf-16', 'replace')
    return raw.decode('utf-8-sig', 'replace')
