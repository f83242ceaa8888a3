# SPDX-License-Identifier: Apache-2.0
"""Measure what accuracy and each effect cost in time, here: CSV, pictures, Markdown. Needs no ROS."""
import argparse
from pathlib import Path
import sys

from ..optional_packages import how_to_get
from ..physics.engine.engines import prefer_compiled
from .pipes import in_pipes

LIBRARIES = 'scipy', 'matplotlib', 'tqdm'
NEEDED = f'accuracy_study needs {", ".join(LIBRARIES)}: {how_to_get("study", *LIBRARIES)}'


@in_pipes
def main(args=None):
    """Run the study and write its page; return the exit code."""
    prefer_compiled()
    parser = argparse.ArgumentParser(prog='accuracy_study', description=__doc__)
    parser.add_argument('--quick', action='store_true',
                        help='four scenes and no effects, a minute or two; the full study takes about ten')
    parser.add_argument('-o', '--output', type=Path, default=Path('docs'), metavar='FOLDER',
                        help='where accuracy.md, its tables and its pictures go (%(default)s)')
    given = parser.parse_args(args)
    try:
        from tqdm import tqdm

        from ..study import page
        from ..study.jobs import jobs
    except ImportError as error:
        print(f'{NEEDED} ({error})', file=sys.stderr)
        return 1
    given.output.mkdir(parents=True, exist_ok=True)
    todo, found = jobs(given.quick), {}
    for part, job in tqdm(todo, desc='accuracy study', unit='row'):
        found.setdefault(part, []).append(job())
    page.write(found, given.output, 'accuracy_study --quick' if given.quick else 'accuracy_study')
    print(f'{given.output}/accuracy.md: {sum(map(len, found.values()))} rows')
    return 0


if __name__ == '__main__':
    sys.exit(main())
