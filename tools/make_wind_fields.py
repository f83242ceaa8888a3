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

"""Make the wind fields of the shipped courses: ``python tools/make_wind_fields.py [NAME ...]``.

Each takes a minute. After `make_courses.py`, where ground, trees or roughness have changed; needs
numba. All names that have a field, if none is given.
"""

from pathlib import Path
import sys

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from golf_sim_ros.cli.wind_field import main as wind_field  # noqa: E402

COURSES = ROOT / 'config' / 'courses'
NAMES = 'links', 'tall_pines'


def main(names=NAMES):
    """Solve for the fields of courses of these `names`; return the exit code."""
    for name in names or NAMES:
        path = COURSES / f'{name}.yaml'
        code = wind_field([str(path), '-o', str(COURSES / f'{name}_wind.npz'), '--compact'])
        if code:
            return code
    return 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
