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

"""Recorded play, read from a rosbag2 bag (MCAP or sqlite3) with no ROS installed."""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
import json
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from .bag_file import BagError, Raw, raw_messages
from .journal import beginning, JournalError, opened, SEAL
from .journal_format import current, Entry
from ..optional_packages import how_to_get

__all__ = ['BagError', 'read_bag', 'Recording', 'Strike', 'Track']

T = TypeVar('T')
Received = tuple[int, Any]  # when a message was recorded [ns], and the message
Parts = dict[Any, Any]  # lists of Received by ball and topic; 'start': a `beginning`

TEXT = 'std_msgs/msg/String'
POSE = 'geometry_msgs/msg/PoseStamped'
TWIST = 'geometry_msgs/msg/TwistStamped'
STRIKE = 'geometry_msgs/msg/Twist'
WIND = 'geometry_msgs/msg/Vector3Stamped'
OF_SIM = {'journal': TEXT, 'shot/result': TEXT, 'collisions': TEXT, 'shot': STRIKE, 'wind': WIND}
OF_RESULT = {'shot': int, 'ball': str, 'status': str}  # what every result has, and every collision
OF_COLLISION = {'time': (int, float), 'ball': str, 'kind': str, 'with': str}
OF_BALL = {'pose': POSE, 'twist': TWIST, 'shot': STRIKE}


class Track(NamedTuple):
    """What was published of a ball, in the order of the bag; `times` are ROS time [ns].

    ``positions`` (n, 3) [m] and ``orientations`` (n, 4) (x, y, z, w) at ``times`` (n,);
    ``velocities`` (m, 3) [m/s] and ``spins`` (m, 3) [rad/s] at ``twist_times`` (m,).
    """

    times: np.ndarray
    positions: np.ndarray
    orientations: np.ndarray
    twist_times: np.ndarray
    velocities: np.ndarray
    spins: np.ndarray


class Strike(NamedTuple):
    """A strike as it was sent; `received` is when it was recorded [ns]."""

    received: int
    ball: str
    velocity: tuple[float, float, float]
    spin: tuple[float, float, float]


class Recording(NamedTuple):
    """What one sim published, from its start to its end.

    Parameters
    ----------
    namespace : str
        Of the sim; '' is the root.
    start : int
        ROS time [ns] of simulated time 0; without a journal, of the first pose.
    journal : tuple of dict
        Entries, each once, in the order of their numbers, with one more key: ``received`` [ns].
    results, collisions : tuple of dict
        As published, each once; vectors are lists.
    strikes : tuple of Strike
        What was sent to the sim, played or not.
    tracks : dict of str to Track
        By ball.
    wind_times, winds : ndarray, (n,) and (n, 3)
        ROS time [ns], and velocity of the air 10 m over the ground [m/s].
    """

    namespace: str
    start: int | None
    journal: tuple[Entry, ...]
    results: tuple[Entry, ...]
    collisions: tuple[Entry, ...]
    strikes: tuple[Strike, ...]
    tracks: dict[str, Track]
    wind_times: np.ndarray
    winds: np.ndarray

    @property
    def config(self) -> Entry | None:
        """The journal's first entry, or None where it has none."""
        return next((entry for entry in self.journal if entry['kind'] == 'config'), None)

    def seconds(self, times: np.ndarray) -> np.ndarray:
        """Convert ROS times [ns] to simulated time [s]."""
        return 1e-9 * (np.asarray(times) - (self.start or 0))


def read_bag(path: str | PathLike[str]) -> tuple[Recording, ...]:
    """Read the recordings of the sims in a bag.

    Parameters
    ----------
    path : str or path
        Folder of a rosbag2 bag, or one of its files, .mcap or .db3.

    Returns
    -------
    tuple of Recording
        One for each sim and each of its starts, in the order of their first messages.

    Raises
    ------
    BagError
        The bag is damaged, or holds no play.
    """
    try:
        told = raw_messages(Path(path))
    except (BagError, OSError, MemoryError) as error:
        raise BagError(f'{path}: {error}') from None
    # Others may have such topics, too: an entry of ours has its seal, and a result its status.
    ours = sims_with('journal', told, SEAL) | sims_with('shot/result', told, '"status"')
    sims = ours or sims_with('journal', told) | sims_with('shot/result', told)
    if not sims:
        raise BagError(
            f'{path}: no play is in it: neither a topic `journal` nor one `shot/result`'
        )
    plays: dict[str, list[Parts]] = {}
    decode = decoder(path)
    for received, topic, kind, raw in told:
        place = sorted_out(topic, kind, sims)
        if place:
            namespace, ball, name = place
            message = decode(topic, kind, raw)
            starts = plays.setdefault(namespace, [defaultdict(list)])
            parts = begun(starts, name, message, path)
            parts[ball, name].append((received, message))
    return tuple(
        recording(namespace, parts, path)
        for namespace, starts in plays.items()
        for parts in starts
    )


def sims_with(end: str, told: Iterable[Raw], part: str = '') -> set[str]:
    """Namespaces with a topic of texts that ends so, of which one at least has that `part`."""
    return {
        topic.removesuffix(f'/{end}')
        for _, topic, kind, raw in told
        if topic.endswith(f'/{end}') and kind == TEXT and part.encode() in raw
    }


def decoder(path: str | PathLike[str]) -> Callable[[str, str, bytes], Any]:
    """Return the function that makes a message of a topic, a type and bytes."""
    try:
        from rosbags.typesys import get_typestore, Stores
    except ImportError:
        raise BagError(f'reading a bag needs rosbags: {how_to_get("bag", "rosbags")}') from None
    types = get_typestore(Stores.ROS2_JAZZY)

    def decode(topic: str, kind: str, raw: bytes) -> Any:
        try:
            return types.deserialize_cdr(raw, kind)
        except Exception as error:  # damage makes the library raise almost anything
            reason = ' '.join(str(error).split()) or type(error).__name__
            raise BagError(
                f'{path}: is damaged: a message of {topic} cannot be read: {reason}'
            ) from None

    return decode


def sorted_out(topic: str, kind: str, sims: set[str]) -> tuple[str, str, str] | None:
    """Namespace, ball or '', and name of a topic of one of `sims`; None for any other."""
    for end, expected in OF_SIM.items():
        if (
            topic.endswith(f'/{end}')
            and kind == expected
            and topic.removesuffix(f'/{end}') in sims
        ):
            return topic.removesuffix(f'/{end}'), '', end
    namespace, _, rest = topic.rpartition('/')[0].rpartition('/')
    name = topic.rpartition('/')[2]
    if namespace in sims and OF_BALL.get(name) == kind:
        return namespace, rest, name
    return None


def begun(starts: list[Parts], name: str, message: Any, path: str | PathLike[str]) -> Parts:
    """Messages of the present start of a sim; another configuration begins another start."""
    if name != 'journal':
        return starts[-1]
    entry = entry_of(message, path)
    if entry['kind'] == 'config':
        start = beginning(entry)
        if starts[-1].setdefault('start', start) != start:
            starts.append(defaultdict(list, start=start))
    return starts[-1]


def recording(namespace: str, parts: Parts, path: str | PathLike[str]) -> Recording:
    """Put the messages of one start of a sim together."""
    start = parts['start'][0] if 'start' in parts else first_pose(parts)
    journal = tuple(entries(parts['', 'journal'], path))
    winds = parts['', 'wind']
    return Recording(
        namespace,
        start,
        journal,
        tuple(
            once(texts(parts['', 'shot/result'], path, OF_RESULT), lambda result: result['shot'])
        ),
        tuple(once(texts(parts['', 'collisions'], path, OF_COLLISION), repr)),
        tuple(sorted(strikes(parts, journal))),
        {
            ball: track(parts[ball, 'pose'], parts[ball, 'twist'])
            for (ball, name), _ in by_topic(parts)
            if name == 'pose'
        },
        np.array([ros_time(message) or received for received, message in winds], np.int64),
        table([message.vector for _, message in winds]),
    )


def first_pose(parts: Parts) -> int | None:
    """Stamp of the first pose of any ball [ns], or None."""
    poses = [told for (_, name), told in by_topic(parts) if name == 'pose']
    return min((ros_time(message) for told in poses for _, message in told), default=None)


def by_topic(parts: Parts) -> list[tuple[tuple[str, str], list[Received]]]:
    """Ball and name, and messages, of all topics."""
    return [(key, told) for key, told in parts.items() if key != 'start']


def entries(told: list[Received], path: str | PathLike[str]) -> list[Entry]:
    """Entries of a journal, each once, in the order of their numbers."""
    found = [
        {**current(entry_of(message, path)), 'received': received} for received, message in told
    ]
    return sorted(once(found, lambda entry: entry['entry']), key=lambda entry: entry['entry'])


def entry_of(message: Any, path: str | PathLike[str]) -> Entry:
    """Entry that a message of a journal holds."""
    try:
        return opened(message.data)
    except JournalError as error:
        raise BagError(f'{path}: journal: {error}') from None


def texts(told: list[Received], path: str | PathLike[str], needed: dict[str, Any]) -> list[Entry]:
    """Objects of messages with JSON, which have the keys that are `needed`."""
    try:
        found = [json.loads(message.data) for _, message in told]
    except (ValueError, RecursionError) as error:
        raise BagError(f'{path}: is damaged: a result or collision is not JSON: {error}') from None
    for one in found:
        for name, kind in needed.items():
            if not isinstance(one, dict) or not isinstance(one.get(name), kind):
                raise BagError(f'{path}: is damaged: {name!r} is missing in a result or collision')
    return found


def once(found: Iterable[T], key: Callable[[T], Hashable]) -> list[T]:
    """Those of `found` whose key is new: a recorder that joins twice gets messages twice."""
    seen: dict[Hashable, T] = {}
    for one in found:
        seen.setdefault(key(one), one)
    return list(seen.values())


def strikes(parts: Parts, journal: tuple[Entry, ...]) -> Iterator[Strike]:
    """Strikes as sent; those on `shot`, without the name of a ball, are for the first one."""
    balls = next(
        (entry['parameters']['balls'] for entry in journal if entry['kind'] == 'config'), ['']
    )
    for (ball, name), told in by_topic(parts):
        if name == 'shot':
            for received, message in told:
                yield Strike(
                    received, ball or balls[0], triple(message.linear), triple(message.angular)
                )


def track(poses: list[Received], twists: list[Received]) -> Track:
    """`Track` of the messages about a ball."""
    turns = [message.pose.orientation for _, message in poses]
    return Track(
        np.array([ros_time(message) for _, message in poses], np.int64),
        table([message.pose.position for _, message in poses]),
        np.array([(turn.x, turn.y, turn.z, turn.w) for turn in turns]).reshape(-1, 4),
        np.array([ros_time(message) for _, message in twists], np.int64),
        table([message.twist.linear for _, message in twists]),
        table([message.twist.angular for _, message in twists]),
    )


def table(vectors: list[Any]) -> np.ndarray:
    """Rows of x, y, z."""
    return np.array([triple(vector) for vector in vectors], float).reshape(-1, 3)


def triple(vector: Any) -> tuple[float, float, float]:
    """Three floats of a Vector3 or Point."""
    return vector.x, vector.y, vector.z


def ros_time(message: Any) -> int:
    """Stamp of a message [ns]."""
    return message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
