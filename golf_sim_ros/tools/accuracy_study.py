# SPDX-License-Identifier: Apache-2.0
"""What accuracy costs in time, measured on this machine: CSV, figure, Markdown. Needs no ROS."""
import argparse
from pathlib import Path
import sys

NEEDED = 'accuracy_study needs scipy, matplotlib and tqdm: pip install "golf_sim_ros[study]"'


def main(args=None):
    """Run the study; return the exit code."""
    parser = argparse.ArgumentParser(prog='accuracy_study', description=__doc__)
    parser.add_argument('--quick', action='store_true', required=True,
                        help='four scenes, a minute or two; the only study as yet')
    parser.add_argument('-o', '--output', type=Path, default=Path('docs'), metavar='FOLDER',
                        help='where accuracy.md, accuracy.csv and accuracy.png go (%(default)s)')
    given = parser.parse_args(args)
    try:
        import matplotlib  # noqa: F401
        from tqdm import tqdm

        from ..study import page
        from ..study.measure import first, measured, played
        from ..study.methods import TRUTH, methods
        from ..study.scenes import scenes
    except ImportError as error:
        print(f'{NEEDED} ({error})', file=sys.stderr)
        return 1
    given.output.mkdir(parents=True, exist_ok=True)
    jobs = [(scene, method) for scene in scenes() for method in methods(scene)]
    truths = {scene.name: first(lambda: played(scene, TRUTH)) for scene in scenes()}
    rows = [measured(scene, truths[scene.name][0], method)
            for scene, method in tqdm(jobs, desc='accuracy study', unit='method')]
    compiled = {name: seconds for name, (_, seconds) in truths.items()}  # of Dormand-Prince, which came first
    rows = [row._replace(compiled=compiled.pop(row.scene)) if row.method == 'dormand_prince'
            and row.scene in compiled else row for row in rows]
    page.write_csv(rows, given.output / 'accuracy.csv')
    page.draw(rows, given.output / 'accuracy.png')
    page.write_page(rows, given.output / 'accuracy.md', 'accuracy.png', 'accuracy.csv',
                    'accuracy_study --quick')
    print(f'{given.output}/accuracy.md: {len(rows)} rows')
    return 0


if __name__ == '__main__':
    sys.exit(main())
