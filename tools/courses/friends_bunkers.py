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

"""The bunkers of golf_without_friends.yaml: bowls of sand in three cuts of its plane."""

from .bowl import bowl
from .writing import stl

BUNKERS = {  # outline of the cut, height of the lip, depth [m]
    'fairway_bunker': (
        [(244, 30), (247, 28), (254, 28), (257, 31), (254, 35), (247, 35)],
        0.10,
        0.45,
    ),
    'front_bunker': (
        [(311, -15), (314, -19), (320, -19), (323, -15), (321, -12), (314, -12)],
        0.15,
        0.60,
    ),
    'side_bunker': (
        [(336, 24), (339, 22), (348, 22), (351, 25), (348, 29), (339, 29)],
        0.15,
        0.60,
    ),
}


def files():
    """Names and bytes."""
    return {
        f'golf_without_friends_{name}.stl': stl(bowl(outline, 0.0, lip, depth))
        for name, (outline, lip, depth) in BUNKERS.items()
    }
