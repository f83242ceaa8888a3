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

"""Its being here makes what lies in this folder, oracles.py, importable for all tests."""

import gc

from golf_sim_ros.physics.engine.engines import prefer_compiled
import pytest

prefer_compiled()  # tests play thousands of shots; the nodes that they start do not look at this


@pytest.fixture(scope='module', autouse=True)
def what_stays_is_looked_at_once():
    """After each file, spare garbage collections what is left: of a compiler, millions of objects.

    NiceGUI's tests collect garbage twice a test, which took a second each time.
    """
    yield
    gc.collect()
    gc.freeze()
