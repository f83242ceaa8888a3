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

"""RViz's view of a course: from behind its tee, along its hole."""

from math import atan2, hypot, pi

import yaml

from ..physics import Course, ground_height

PITCH = 0.3  # rad down from the horizontal
BACK = 0.32  # of the hole's length, behind which the view begins
LEAST = 8.0  # m from the point that is looked at


def rviz_view(config: str, course: Course) -> str:
    """Set the current view of a configuration of RViz to a course.

    Parameters
    ----------
    config : str
        Content of a .rviz file, whose current view is an orbit.
    course : Course

    Returns
    -------
    str
    """
    tree = yaml.safe_load(config)
    tree['Visualization Manager']['Views']['Current'].update(orbit(course))
    return yaml.safe_dump(tree, sort_keys=False)


def orbit(course: Course) -> dict:
    """Distance, focal point, pitch and yaw of an orbit that shows the hole from behind the tee."""
    x, y = map(float, course.tee[:2])
    ahead = course.hole or (x + 150.0, y)
    way = hypot(ahead[0] - x, ahead[1] - y)
    heading = atan2(ahead[1] - y, ahead[0] - x)
    focus = (x + BACK * (ahead[0] - x), y + BACK * (ahead[1] - y))
    ground = ground_height(course, *focus)
    return {
        'Distance': round(max(LEAST, 2.0 * BACK * way), 2),
        'Focal Point': {
            'X': round(focus[0], 2),
            'Y': round(focus[1], 2),
            'Z': round(float(ground[0]) if ground else 0.0, 2),
        },
        'Pitch': PITCH,
        'Yaw': round((heading + pi) % (2.0 * pi), 4),  # where the eye is, seen from the focus
    }
