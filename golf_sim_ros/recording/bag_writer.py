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

"""A rosbag2 bag, written as messages arrive, with the QoS that their publishers offer."""

from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from shutil import rmtree
from typing import Any

from ..optional_packages import how_to_get

NEVER = 9223372036, 854775807  # s, ns: what ROS 2 means by a duration without end


class CannotRecord(RuntimeError):
    """There is no bag, and one line says why."""


class BagWriter:
    """A new bag, open until `close`.

    Parameters
    ----------
    path : str or path
        Folder to make.
    storage : str
        'mcap' or 'sqlite3'.

    Raises
    ------
    CannotRecord
        The folder is there, or cannot be made, or the library rosbags is missing.
    """

    def __init__(self, path: str | PathLike[str], storage: str) -> None:
        try:
            from rosbags.rosbag2 import StoragePlugin, Writer
            from rosbags.rosbag2.errors import WriterError
            from rosbags.typesys import get_typestore, Stores
        except ImportError:
            raise CannotRecord(
                f'recording needs rosbags: {how_to_get("bag", "rosbags")}'
            ) from None
        self.path = Path(path)
        self.types = get_typestore(Stores.ROS2_JAZZY)
        try:
            self.writer = Writer(
                self.path, version=9, storage_plugin=StoragePlugin[storage.upper()]
            )
            self.writer.open()
        except (OSError, WriterError) as error:
            raise CannotRecord(f'{path}: {error}') from None
        self.connections: dict[str, Any] = {}
        self.count = 0

    def add(self, topic: str, kind: str, profiles: Iterable[tuple[str, str, int]]) -> None:
        """Begin a topic, once.

        `profiles` are the offered QoS, (reliability, durability, depth) by name.
        """
        if topic not in self.connections:
            self.connections[topic] = self.writer.add_connection(
                topic,
                kind,
                typestore=self.types,
                offered_qos_profiles=[qos(*profile) for profile in profiles],
            )

    def write(self, topic: str, time: int, data: bytes) -> None:
        """Write a serialized message received at `time` [ns] on a topic that was added."""
        self.writer.write(self.connections[topic], time, data)
        self.count += 1

    def close(self) -> None:
        """Complete the bag."""
        self.writer.close()

    def discard(self) -> None:
        """Remove the folder of a bag, closed or not."""
        try:
            if self.writer.storage:
                self.writer.close()
        finally:
            rmtree(self.path)


def qos(reliability: str, durability: str, depth: int) -> Any:
    """Profile of QoS as bags keep it."""
    from rosbags.interfaces import (
        Qos,
        QosDurability,
        QosHistory,
        QosLiveliness,
        QosReliability,
        QosTime,
    )

    never = QosTime(*NEVER)
    return Qos(
        QosHistory.KEEP_LAST,
        depth,
        QosReliability[reliability],
        QosDurability[durability],
        never,
        never,
        QosLiveliness.AUTOMATIC,
        never,
        False,
    )
