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

"""Build the documentation: docs/*.md and the docstrings, as HTML: ``build_docs.py FOLDER``.

As rosdoc2 does, it copies docs/ to FOLDER/source, adds a page for each module there, and builds;
every warning is an error.
"""

import argparse
import os
from pathlib import Path
import shutil
import subprocess
import sys

ROOT = Path(__file__).resolve().parents[1]


def main():
    """Exit code of what fails first, or 0."""
    parser = argparse.ArgumentParser(description=__doc__.partition('\n')[0])
    parser.add_argument('folder', type=Path, nargs='?', default=ROOT / 'build' / 'docs')
    folder = parser.parse_args().folder.resolve()
    source, html = folder / 'source', folder / 'html'
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / 'docs', source)
    environment = {
        **os.environ,
        'PYTHONPATH': str(ROOT),
        'SPHINX_APIDOC_OPTIONS': 'members,show-inheritance',
    }
    for command in (
        ['sphinx.ext.apidoc', '-q', '-e', '-M', '-o', source, ROOT / 'golf_sim_ros'],
        ['sphinx', '-q', '-W', '--keep-going', source, html],
    ):
        done = subprocess.run([sys.executable, '-m', *map(str, command)], env=environment)
        if done.returncode:
            return done.returncode
    print(f'{html}/index.html')
    return 0


if __name__ == '__main__':
    sys.exit(main())
