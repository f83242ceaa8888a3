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

"""Warnings about inputs that were rejected."""

from collections import Counter

from rclpy.impl.rcutils_logger import RcutilsLogger

KINDS = ('shot', 'wind', 'place')


class RejectedInputs:
    """Counts rejected inputs of each of `KINDS` and warns of them, at most once a second each.

    Parameters
    ----------
    log : rclpy.impl.rcutils_logger.RcutilsLogger
    """

    def __init__(self, log: RcutilsLogger) -> None:
        self.logs = {kind: log.get_child(kind) for kind in KINDS}
        self.counts: Counter[str] = Counter()

    def warn(self, kind: str, reason: str) -> None:
        """Count one more rejected input of `kind`, and warn of it with its `reason`."""
        self.counts[kind] += 1
        self.logs[kind].warning(
            f'{kind} refused ({self.counts[kind]} so far): {reason}', throttle_duration_sec=1.0
        )
