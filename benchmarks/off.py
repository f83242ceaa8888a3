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

"""What an effect costs that is off: drives, against a build of the package without its file."""

import ast
from contextlib import contextmanager, ExitStack
import os
from pathlib import Path
import shutil
from statistics import median
import subprocess
import sys
import tempfile

import golf_sim_ros
from golf_sim_ros.physics import EFFECTS
from timing import Row

PACKAGE = Path(golf_sim_ros.__file__).parent
ROUNDS = 60
ALWAYS = ('gravity', 'drag', 'magnus', 'spin_decay', 'turf')  # of a drive in still air


def rows(quick):
    """`Row` of each automatic effect, and of all others together; quick: of one."""
    others = [name for name, effect in EFFECTS.items() if effect.instead_of]
    automatic = [name for name in EFFECTS if name not in others]
    for names in [['wind']] if quick else [*([name] for name in automatic), others]:
        effects = ','.join(e for e in ALWAYS if e not in names) if names[0] in ALWAYS else 'auto'
        yield row(names, effects)


def row(names, effects):
    """`Row`: the share of the time that files of effects cost which are off."""
    with tempfile.TemporaryDirectory() as folder, ExitStack() as open_builds:
        shutil.copytree(
            PACKAGE, Path(folder, 'golf_sim_ros'), ignore=shutil.ignore_patterns('__pycache__')
        )
        for name in names:
            take_out(name, Path(folder, 'golf_sim_ros'))
        whole = open_builds.enter_context(build(PACKAGE.parent, effects, folder))
        less = open_builds.enter_context(build(folder, effects, folder))
        codes = [process.stdout.readline() for process in (whole, less)]
        pairs = [
            pair
            for _ in range(ROUNDS // 2)
            for pair in (paired(whole, less), paired(less, whole)[::-1])
        ]
    cost = 100.0 * (median(mine / theirs for mine, theirs in pairs) - 1.0)
    title = names[0] if len(names) == 1 else f'{len(names)} laws asked for by name'
    same = codes[0] == codes[1]
    return Row(
        f'a drive with {title} off, over a build without the file',
        0.0 if same else cost,
        '% more',
        most=2.0,
        times=tuple(map(median, zip(*pairs))),
        note=f'the same machine code, timed {cost:+.1f} %' if same else 'other machine code',
    )


@contextmanager
def build(folder, effects, cache):
    """Start a process that plays with the package in `folder`."""
    command = [sys.executable, str(Path(__file__).with_name('build.py')), str(folder), effects]
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, 'NUMBA_CACHE_DIR': str(cache)},
    ) as process:
        yield process
        process.stdin.close()


def paired(first, second):
    """Time two builds [s], one after the other.

    Which is first makes a difference of a percent or two.
    """
    return time(first), time(second)


def time(process):
    """Time [s] that a build takes to play once more."""
    process.stdin.write('\n')
    process.stdin.flush()
    return float(process.stdout.readline())


def take_out(name, package):
    """Take an effect out of a `package`.

    That is its file, or what makes it an effect where others import from the file.
    """
    path = package / 'physics' / 'effects' / f'{name}.py'
    sources = [source.read_text() for source in package.rglob('*.py') if source != path]
    if not any(f'{name} import' in source for source in sources):
        path.unlink()
        return
    tree = ast.parse(path.read_text())
    tree.body = [node for node in tree.body if not makes_effect(node)]
    path.write_text(ast.unparse(tree))


def makes_effect(node):
    """Whether a segment of a file makes it an effect: `record`, or the body of a law."""
    return isinstance(node, ast.FunctionDef) and (
        node.name == 'record' or any('.register(' in ast.unparse(d) for d in node.decorator_list)
    )
