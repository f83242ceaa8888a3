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

"""Balls that hit each other; without it they pass through each other."""

from typing import NamedTuple

from . import Scene


class BallBall(NamedTuple):
    """Collisions of ball with ball: the engine looks for them only where this is on."""


def record(scene: Scene) -> BallBall:
    """Record for `scene`."""
    return BallBall()


def idle(scene: Scene) -> str:
    """Reason why `scene` does without the effect, a single ball, or ''."""
    return '' if scene.balls > 1 else 'one ball'
