# SPDX-License-Identifier: Apache-2.0
"""Balls that hit each other; without it they pass through each other."""
from typing import NamedTuple


class BallBall(NamedTuple):
    """Collisions of ball with ball: the engine looks for them where this is on, and not otherwise."""


def record(scene):
    """Record for `scene`."""
    return BallBall()


def idle(scene):
    """Reason why `scene` does without the effect, a single ball, or ''."""
    return '' if scene.balls > 1 else 'one ball'
