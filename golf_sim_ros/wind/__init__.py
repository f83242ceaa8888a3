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

"""Wind: gusts, and fields of wind over a course. No ROS; only solving needs numba."""

from collections.abc import Callable, Sequence

from .errors import FieldError, NotConverged
from .field import WindField
from .gusts import Gusts, GustSettings
from ..physics.scene.course_record import Course

__all__ = ['FieldError', 'GustSettings', 'Gusts', 'NotConverged', 'WindField', 'solve']


def solve(
    course: Course,
    directions: int | Sequence[float] = 16,
    accuracy: str = 'standard',
    progress: Callable[[int, int, float], None] | None = None,
) -> WindField:
    """Solve for the wind over a course; see `solving.solve`.

    Raises
    ------
    golf_sim_ros.physics.EngineUnavailable
        There is no numba here.
    """
    from .solving import solve as solve_now

    return solve_now(course, directions, accuracy, progress)
