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

"""Measure what accuracy and each effect cost in time, here: CSV, pictures, Markdown.

Needs no ROS.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path
import sys

from .closed_pipe import in_pipes
from ..optional_packages import how_to_get
from ..physics.engine.engines import prefer_compiled

LIBRARIES = ('scipy', 'matplotlib', 'tqdm')
NEEDED = f'accuracy_study needs {", ".join(LIBRARIES)}: {how_to_get("study", *LIBRARIES)}'


@in_pipes
def main(args: Sequence[str] | None = None) -> int:
    """Run the study and write its page; return the exit code."""
    prefer_compiled()
    parser = argparse.ArgumentParser(prog='accuracy_study', description=__doc__)
    parser.add_argument(
        '--quick',
        action='store_true',
        help='four scenes, methods and promises, a minute or two; the full study takes twenty',
    )
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=Path('docs'),
        metavar='FOLDER',
        help='where accuracy.md, its tables and its pictures go (%(default)s)',
    )
    given = parser.parse_args(args)
    try:
        from tqdm import tqdm

        from ..study import page
        from ..study.jobs import jobs
    except ImportError as error:
        print(f'{NEEDED} ({error})', file=sys.stderr)
        return 1
    given.output.mkdir(parents=True, exist_ok=True)
    todo = jobs(given.quick)
    found: dict[str, list] = {}
    for part, job in tqdm(todo, desc='accuracy study', unit='row'):
        found.setdefault(part, []).append(job())
    page.write(found, given.output, 'accuracy_study --quick' if given.quick else 'accuracy_study')
    print(f'{given.output}/accuracy.md: {sum(map(len, found.values()))} rows')
    return 0


if __name__ == '__main__':
    sys.exit(main())
