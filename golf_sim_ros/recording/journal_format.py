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

"""Formats of the journal: entries of older ones, converted to the present one.

Format 1, of versions that wrote none: the fields of a ball in a strike's `balls` had other names.
The numbers are the same.
"""

from typing import Any

Entry = dict[str, Any]  # what its JSON holds

FORMAT = 2

# Fields of a ball, by format 1 and since format 2.
RENAMED = {
    'tail_end': 'micro_bounce_end',
    'tail_press': 'micro_bounce_load',
    'tail_air': 'micro_bounce_air',
    'piled': 'time_stepping',
    'calm': 'still_steps',
    'held': 'held_by',
    'braking': 'rolling_loss',
    'reach': 'contact_reach',
    'watch': 'watches_neighbours',
    'leans': 'sleeps_on_ball',
    'pressing': 'stored_count',
    'pressed_by': 'stored_partners',
    'pressed': 'stored_impulses',
    'path': 'position_coefficients',
    'twist': 'spin_coefficients',
    'rated': 'last_stage_time',
    'playing': 'shot_active',
    'knocked': 'moved_by_ball',
    'highest': 'apex',
    'stalled': 'rapid_impacts',
    'stuck': 'zero_length_segments',
    'counted_from': 'counted_until',
    'pieces': 'segments_spent',
}


def current(entry: Entry) -> Entry:
    """Entry of the present format for `entry`, which is of any format."""
    balls = entry.get('balls')
    if entry['kind'] != 'strike' or not isinstance(balls, dict):
        return entry
    return {**entry, 'balls': {name: renamed(ball) for name, ball in balls.items()}}


def renamed(ball: Any) -> Any:
    """Fields of a ball by their present names."""
    if not isinstance(ball, dict):
        return ball  # whoever restores it says that it is none
    return {RENAMED.get(name, name): value for name, value in ball.items()}
