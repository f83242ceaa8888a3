# SPDX-License-Identifier: Apache-2.0
"""Warnings about inputs that were rejected."""
from collections import Counter

KINDS = ('shot', 'wind', 'place')


class RejectedInputs:
    """Counts rejected inputs of each of `KINDS` and warns of them, at most once a second each.

    Parameters
    ----------
    log : rclpy.impl.rcutils_logger.RcutilsLogger
    """

    def __init__(self, log):
        self.logs = {kind: log.get_child(kind) for kind in KINDS}
        self.counts = Counter()

    def warn(self, kind, reason):
        """Count one more rejected input of `kind`, and warn of it with its `reason`."""
        self.counts[kind] += 1
        self.logs[kind].warning(
            f'{kind} refused ({self.counts[kind]} so far): {reason}', throttle_duration_sec=1.0)
