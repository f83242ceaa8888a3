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

"""How a flow is marched in time until it is at rest."""

from typing import NamedTuple


class March(NamedTuple):
    """How a flow is marched to rest.

    ``courant``: cells that the fastest air passes in a step; ``steps`` at most; ``change``: of the
    velocity over the wind, in the time that it takes to pass a cell, below which it is at rest;
    ``allowed``: the same, below which it may end when the steps are over; ``projections``:
    iterations of the pressure solver in a step.
    """

    courant: float = 5.0
    steps: int = 200
    change: float = 1e-4
    allowed: float = 2e-3
    projections: int = 2
