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

"""No shot passes through anything; `make hard` fires a hundred thousand at each target."""

from golf_sim_ros.physics import ACCURACY
from nothing_passes import TARGETS
import pytest

COUNT = 60


@pytest.mark.parametrize('target', TARGETS)
@pytest.mark.parametrize('accuracy', ['sketch', 'standard'])
def test_no_shot_passes_through(target, accuracy):
    passed, depth = TARGETS[target]((COUNT, accuracy, 250))
    # A ball on the ground is as deep as its preset lets a path be off: see docs/stability.md.
    assert passed == 0 and depth < max(2e-6, ACCURACY[accuracy].limits.path)
