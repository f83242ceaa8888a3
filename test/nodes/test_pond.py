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

"""A pond over DDS: the result of a ball in the water, and where it is then."""

import json

from processes import LASTING, LATCHED, parameters, place, READY, wait_until
import pytest
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

POND = '[[10, -5], [40, -5], [40, 5], [10, 5]]'
LINKS = f"""format: 1
ground:
  - {{shape: plane, material: fairway, cut: [{POND}]}}
  - {{shape: patch, center: [25, 0, -2], length: 30, width: 10, material: sand}}
water:
  - {{polygon: {POND}, level: -0.2}}
"""


@pytest.fixture
def sim(start, tmp_path):
    """Start a sim in its own namespace, on a course with a pond in front of the tee."""
    file = tmp_path / 'pond.yaml'
    file.write_text(LINKS)
    process = start('sim_node', *parameters('/wet', course=file))
    process.wait_for(READY)
    return process


def test_a_ball_in_the_pond_ends_as_water_and_is_back_on_its_spot(sim, make_golfer):
    golfer = make_golfer('/wet')
    journal = golfer.listen(String, 'journal', LASTING)
    spot = place(golfer.poses[-1])
    result = golfer.play((10.0, 0.0, 8.0))
    golfer.heartbeat()
    assert len(golfer.results_of((10.0, 0.0, 8.0))) == 1
    assert (
        result['status'] == 'water' and result['lie'] == 'water' and 14.0 < result['carry'] < 18.0
    )
    (wet,) = golfer.impacts()
    assert (wet['kind'], wet['with']) == ('water', 'water') and wet['position'][
        2
    ] == pytest.approx(-0.2)
    assert place(golfer.poses[-1]) == spot
    entries = wait_until(lambda: dropped(journal), 'the journal told of the drop')
    assert [(entry['ball'], tuple(entry['position'])) for entry in entries] == [('ball', spot)]
    assert golfer.play((1.0, 0.0, 0.0))['status'] == 'at_rest'
    shown = golfer.listen(MarkerArray, 'course/markers', LATCHED)
    markers = wait_until(lambda: shown, 'the course was shown')[-1].markers
    (water,) = (marker for marker in markers if marker.ns == 'water')
    seen = water.color.a * water.colors[0].a  # RViz multiplies them
    assert water.type == Marker.TRIANGLE_LIST and 0.0 < seen < 1.0
    assert {point.z for point in water.points} == {-0.2}


def dropped(journal):
    """Entries of the journal about drops."""
    entries = [json.loads(message.data) for message in journal]
    return [entry for entry in entries if entry['kind'] == 'drop']
