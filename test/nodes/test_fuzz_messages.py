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

"""A short run of tools/fuzz.py: malformed and extreme messages, services, parameters over DDS."""

from pathlib import Path
import sys

sys.path.append(str(Path(__file__).parents[2] / 'tools'))
from fuzz_messages import attacked, Attacker  # noqa: E402
from processes import parameters, READY  # noqa: E402


def test_malformed_and_extreme_messages_leave_the_next_good_shot_the_same_to_the_bit(start):
    sim = start('sim_node', *parameters('/fuzzed', real_time_factor=0.0))
    sim.wait_for(READY)
    attacker = Attacker('/fuzzed', 20)
    try:
        assert attacked(sim, attacker, 60, 20) == []
    finally:
        attacker.close()
    assert sim.stop() == 0
