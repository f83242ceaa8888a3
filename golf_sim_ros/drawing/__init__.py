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

"""A play as a picture: from the side, from above, over time, and in numbers. No ROS.

Pictures need matplotlib, which is imported when one is asked for. Triangles of the ground, which
RViz and pages use as well, need numpy alone.
"""

from importlib import import_module
from typing import Any

_FROM = {
    'draw': 'play_picture',
    'picture': 'play_picture',
    'recorded': 'recorded_shots',
    'DrawnShot': 'shots',
    'drawn': 'shots',
}

__all__ = ['DrawnShot', 'draw', 'drawn', 'picture', 'recorded']


def __getattr__(name: str) -> Any:
    """Get what this package offers from the module that has it."""
    if name not in _FROM:
        raise AttributeError(f'module {__name__!r} has no attribute {name!r}')
    return getattr(import_module(f'.{_FROM[name]}', __name__), name)
