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

"""Make the shipped courses' files: ``python tools/make_courses.py [FOLDER]``.

By default the folder is config/courses.

The same bytes come out every time. `golf_without_friends.yaml` is written by hand; its bunkers are
made here.
"""

from pathlib import Path
import sys

from courses import friends_bunkers, links, playground, putting_green, tall_pines

SHIPPED = Path(__file__).resolve().parent.parent / 'config' / 'courses'


def main(folder=SHIPPED):
    """Write all files into `folder`."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for module in (friends_bunkers, links, playground, putting_green, tall_pines):
        for name, content in module.files().items():
            (Path(folder) / name).write_bytes(content)


if __name__ == '__main__':
    main(*sys.argv[1:])
