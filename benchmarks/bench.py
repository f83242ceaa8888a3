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

"""One table of what is fast and what is not, against baselines timed in the same run.

A run is added to benchmarks/history.jsonl, and the table shows what the last one had, so that what
has become slower is seen. Compare ratios: times are of this machine, and of what else it does.
"""

import argparse
from datetime import datetime, timezone
import json
from pathlib import Path
import platform
import subprocess

import batches
import compiling
import engines
from golf_sim_ros.physics.engine.engines import prefer_compiled
import grounds
import node
import off
import scale
import shots
import ticks

HISTORY = Path(__file__).parent / 'history.jsonl'
PARTS = compiling, shots, grounds, batches, ticks, scale, node, engines, off


def main():
    """Time, print, and keep."""
    prefer_compiled()
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--quick', action='store_true', help='less of it; nothing is kept')
    given = parser.parse_args()
    before = last_values()
    print(f'{"":74} {"now":>8} {"before":>8}  {"":9} wanted', flush=True)
    kept = {}
    for part in PARTS:
        for row in part.rows(given.quick):
            print(line(row, before.get(row.name)), flush=True)
            kept[row.name] = (row.value, *row.times)
    if not given.quick:
        with HISTORY.open('a', encoding='utf-8') as file:
            file.write(json.dumps({**circumstances(), 'rows': kept}) + '\n')


def last_values():
    """Values of the last run that was kept, by the rows' names."""
    if not HISTORY.exists():
        return {}
    return {
        name: row[0]
        for name, row in json.loads(HISTORY.read_text().splitlines()[-1])['rows'].items()
    }


def line(row, before):
    """Give a row as text."""
    was = '' if before is None else f'{before:.3g}'
    wanted = (
        f'at least {row.least:g}'
        if row.least > 0
        else f'at most {row.most:g}'
        if row.most < 1e9
        else ''
    )
    wanted += '' if row.holds else ': not reached'
    return f'{row.name:74} {row.value:8.3g} {was:>8}  {row.unit:9} {wanted:27} {row.note}'.rstrip()


def circumstances():
    """When, of which commit, and where a run was made."""
    commit = subprocess.run(
        ['git', 'describe', '--always', '--dirty'],
        cwd=HISTORY.parent,
        text=True,
        capture_output=True,
    ).stdout.strip()
    return {
        'time': datetime.now(timezone.utc).isoformat(timespec='seconds'),
        'commit': commit,
        'machine': platform.machine(),
        'python': platform.python_version(),
    }


if __name__ == '__main__':
    main()
