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

"""Messages in the files of a rosbag2 bag.

They are not decoded, so that topics of other nodes do no harm.
"""

from contextlib import closing
from io import BytesIO
from pathlib import Path
import sqlite3
from types import SimpleNamespace
from typing import Any
from urllib.parse import quote

import yaml

from ..course.schema import printable
from ..optional_packages import how_to_get

Raw = tuple[int, str, str, bytes]  # time received [ns], topic, type, content

SUFFIXES = ('.mcap', '.db3')
END = b'\x89MCAP0\r\n'
REINDEX = '`ros2 bag reindex {}` makes one'


class BagError(ValueError):
    """A bag that cannot be used; one line says why."""

    def __init__(self, message: object) -> None:
        super().__init__(printable(message))


def raw_messages(path: Path) -> list[Raw]:
    """Read all messages in a bag: a folder, or one of its files.

    Of each its time received [ns], topic, type and bytes. Raises `BagError`, a line without the
    path, where it is no bag or damaged.
    """
    if path.is_file():
        if path.suffix not in SUFFIXES:
            raise BagError(
                f'is no bag: a folder is one, or a file that ends in {" or ".join(SUFFIXES)}'
            )
        return from_file(path)
    if not path.is_dir():
        raise BagError(
            'is neither a folder nor a file' if path.exists() else 'there is no such bag'
        )
    about = metadata(path)
    files = [path / Path(str(name)).name for name in about['relative_file_paths']]
    for file in files:
        if not file.is_file():
            raise BagError(f'is damaged: its file {file.name} is missing')
    if str(about.get('compression_mode') or 'none').lower() != 'none':
        return by_rosbags(path)
    return [message for file in files for message in from_file(file)]


def metadata(path: Path) -> dict[str, Any]:
    """Content of a bag's metadata.yaml."""
    file = path / 'metadata.yaml'
    if not file.is_file():
        parts = sorted(part.name for part in path.iterdir() if part.suffix in SUFFIXES)
        one = f', or name its file {path / parts[0]}' if parts else ''
        raise BagError(
            f'has no metadata.yaml: {REINDEX.format(path)}{one}'
            if parts
            else 'is no bag: it has neither a metadata.yaml nor files with messages'
        )
    try:
        about = yaml.safe_load(file.read_text(encoding='utf-8'))['rosbag2_bagfile_information']
        if isinstance(about['relative_file_paths'], list):
            return about
        reason = 'it does not list the files'
    except (yaml.YAMLError, ValueError, KeyError, TypeError, RecursionError) as error:
        reason = ' '.join(str(error).split())
    raise BagError(f'its metadata.yaml cannot be used ({reason[:100]}): {REINDEX.format(path)}')


def from_file(path: Path) -> list[Raw]:
    """Messages of one file."""
    return (sqlite if path.suffix == '.db3' else mcap)(path)


def sqlite(path: Path) -> list[Raw]:
    """Messages of a .db3 file."""
    query = (
        'SELECT messages.timestamp, topics.name, topics.type, messages.data FROM messages '
        "JOIN topics ON messages.topic_id = topics.id WHERE topics.serialization_format = 'cdr' "
        'ORDER BY messages.timestamp, messages.id'
    )
    try:
        with closing(
            sqlite3.connect(f'file:{quote(str(path))}?mode=ro&immutable=1', uri=True)
        ) as file:
            file.text_factory = lambda text: text.decode('utf-8', 'replace')
            (trouble,) = file.execute('PRAGMA quick_check(1)').fetchone()
            if trouble != 'ok':
                raise BagError(f'{path.name} is damaged: {" ".join(trouble.split())}')
            return [
                (time, topic, kind, bytes(raw)) for time, topic, kind, raw in file.execute(query)
            ]
    except (sqlite3.Error, TypeError, ValueError, OverflowError) as error:
        if isinstance(error, BagError):
            raise
        raise BagError(
            f'{path.name} is damaged, or no bag: {" ".join(str(error).split())}'
        ) from None


class Schemas(dict):
    """Schemas by number, without texts: rosbags knows only some kinds, and none is needed."""

    def __setitem__(self, number: int, schema: Any) -> None:
        """Keep a schema without its text."""
        super().__setitem__(number, schema._replace(encoding='', data=''))


def in_memory(raw: bytes) -> SimpleNamespace:
    """Make a path of a file that is in memory, with all that rosbags asks of one.

    Where a length in the file is damaged, a read ends with it.
    """
    return SimpleNamespace(open=lambda mode: BytesIO(raw))


def mcap(path: Path) -> list[Raw]:
    """Messages of a .mcap file."""
    raw = path.read_bytes()
    if not raw.endswith(END):
        raise BagError(
            f'{path.name} is damaged: its end is missing, as of a recording or copy that was '
            'cut off; `mcap recover` saves what is there'
        )
    return by_rosbags(path, raw)


def by_rosbags(path: Path, raw: bytes | None = None) -> list[Raw]:
    """Messages that rosbags finds in a .mcap file or in a folder with compressed files.

    `raw` are the bytes of the file.
    """
    try:
        from rosbags.rosbag2 import Reader
    except ImportError:
        raise BagError(f'reading a bag needs rosbags: {how_to_get("bag", "rosbags")}') from None
    try:
        reader = Reader(path)
        if raw is not None:
            reader.storage.path = in_memory(raw)
            reader.storage.schemas = Schemas()
        with reader:
            # Those of the storage: rosbags has none where its QoS is not that of the metadata.
            stores = getattr(reader.storage, 'storages', [reader.storage])
            wanted = [
                connection
                for store in stores
                for connection in store.connections
                if connection.ext.serialization_format == 'cdr'
            ]
            return [
                (time, connection.topic, connection.msgtype, content)
                for connection, time, content in (reader.messages(wanted) if wanted else ())
            ]
    except Exception as error:
        # Damage makes the library, and those below it, raise almost anything.
        reason = ' '.join(str(error).split()) or type(error).__name__
        raise BagError(f'{path.name} is damaged, or no bag: {reason}') from None
