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

"""Part of the course that a picture shows."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .shots import DrawnShot
from ..physics import Course

MARGIN = 0.04  # of the longer side, around all that is drawn
LEAST = 1.0  # m: a ball that hardly moved is not drawn larger than this
TALL = (0.16, 0.42)  # height over width of the view from above
FAR = 1.5  # of a play's length: where the hole is farther off, it isn't shown
NEAR = 16.0  # ends nearer to the hole than the width over this are drawn once more, larger


class Window(NamedTuple):
    """A rectangle of the course, in plan [m]."""

    left: float
    right: float
    low: float
    high: float

    @property
    def width(self) -> float:
        """Along x."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Along y."""
        return self.high - self.low


def window(shots: Sequence[DrawnShot], course: Course | None) -> Window:
    """`Window` that shows all `shots`, and the hole where it isn't far away."""
    places = np.vstack([shot.positions[:, :2] for shot in shots])
    low, high = places.min(0), places.max(0)
    length = max(*(high - low), LEAST)
    if course and course.hole and beyond(low, high, course.hole) <= FAR * length:
        low, high = np.minimum(low, course.hole), np.maximum(high, course.hole)
        length = max(*(high - low), LEAST)
    width, height = high - low + 2 * MARGIN * length
    height = max(height, TALL[0] * max(width, LEAST))
    width = max(width, height / TALL[1])
    x, y = 0.5 * (low + high)
    return Window(x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height)


def beyond(low: np.ndarray, high: np.ndarray, place: Sequence[float]) -> float:
    """Find how far `place` lies outside the rectangle from `low` to `high`."""
    return float(np.linalg.norm(np.clip(place, low, high) - place))


def near_hole(shots: Sequence[DrawnShot], course: Course | None, whole: Window) -> Window | None:
    """Square `Window` around the hole and the ends that lie too near to it in the `whole` one.

    None where there are none.
    """
    if not course or not course.hole:
        return None
    left = [shot.result.to_hole for shot in shots]
    near = [way for way in left if way is not None and way * NEAR < whole.width]
    if not near:
        return None
    (x, y), half = course.hole, 1.25 * max(*near, LEAST)
    return Window(x - half, x + half, y - half, y + half)
