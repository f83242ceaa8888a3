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

"""Whether a sim can be reached, by its heartbeat, and which texts are a sim's.

A dead sim has matched subscriptions for a while. Anybody can publish on its topics.
"""

import json
import time
from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

BEAT_QOS = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)  # asks for the least
SILENT = 2.0  # s without a beat, of which there are two a second: the sim cannot be reached
FRESH = 1.2  # s: no older may a beat be when a strike is sent
SOON = 3.0  # s: a sim that is reached and not paused has taken a strike long before

# What clients need of a text of a sim, and of which type it is.
BEAT = {'session': int, 'shots': int, 'paused': bool}
RESULT = {'shot': int, 'ball': str, 'status': str, 'velocity': list, 'spin': list}


def ours(text: str, kinds: dict[str, type]) -> dict[str, Any] | None:
    """Read the JSON object of a sim that has values of these types; None where it is none."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return None
    if not isinstance(found, dict):
        return None
    return found if all(isinstance(found.get(key), kinds[key]) for key in kinds) else None


class Reach:
    """Listens to the heartbeat of the sim in a node's namespace.

    Parameters
    ----------
    node : rclpy.node.Node
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.last: dict[str, Any] | None = None
        self.heard_at: float | None = None
        self.reached_since = 0.0  # when the silence before ended
        self._beats = node.create_subscription(String, 'heartbeat', self._hear, BEAT_QOS)

    def _hear(self, message: String) -> None:
        now = time.monotonic()
        beat = ours(message.data, BEAT)
        if beat is None:
            return
        if self.silence(now) > SILENT or beat['session'] != self.beat['session']:
            self.reached_since = now
        self.last = beat
        self.heard_at = now

    @property
    def beat(self) -> dict[str, Any]:
        """The last heartbeat, of a sim that had one."""
        assert self.last is not None, 'no heartbeat was heard'
        return self.last

    def silence(self, now: float | None = None) -> float:
        """Tell how long there was no heartbeat [s]."""
        now = time.monotonic() if now is None else now
        return float('inf') if self.heard_at is None else now - self.heard_at

    def is_offered(self) -> bool:
        """Whether there is, or was until just now, a sim that publishes a heartbeat."""
        return self.heard_at is not None or self._node.count_publishers(self._beats.topic_name) > 0

    def is_fresh(self) -> bool:
        """Whether the last heartbeat is recent enough to strike."""
        return self.silence() < FRESH

    def is_lost(self) -> bool:
        """Whether the sim cannot be reached."""
        return self.silence() > SILENT

    def has_had_time(self, since: float) -> bool:
        """Whether the sim had time enough to take a strike that was sent at `since`.

        That is, whether it could be reached, and was not paused, for so long.
        """
        now = time.monotonic()
        if self.beat['paused']:
            self.reached_since = now
        return not self.is_lost() and now - max(since, self.reached_since) > SOON
