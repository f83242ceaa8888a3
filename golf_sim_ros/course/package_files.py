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

"""Paths of the files that come with the package: courses, materials, parameters."""

from collections.abc import Iterator
import os
from pathlib import Path
import sys

PACKAGE = 'golf_sim_ros'


def share(*parts: str) -> Path:
    """Find a file or folder that comes with the package.

    As in ``share('config', 'courses')``. Works the same in a source checkout (``PYTHONPATH``,
    ``pip install -e``, ``colcon build --symlink-install``) and after ``pip install`` or ``colcon
    build``.

    Parameters
    ----------
    *parts : str
        Path below the share folder; with none, the folder itself.

    Returns
    -------
    pathlib.Path
        The path; whether anything is there is the caller's question.

    Raises
    ------
    FileNotFoundError
        When the files of the package are nowhere, which means it was copied and not installed.
    """
    for root in _candidates():
        if (root / 'package.xml').is_file() and (root / 'config').is_dir():
            return root.joinpath(*parts)
    places = ', '.join(str(root) for root in _candidates())
    raise FileNotFoundError(f'the files that come with {PACKAGE} are in none of: {places}')


def _candidates() -> Iterator[Path]:
    """Folders that may hold package.xml and config/, the ones nearest to this very file first."""
    here = Path(__file__).resolve()
    yield here.parents[2]  # source checkout
    sourced = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    for prefix in (*map(str, _prefixes_above(here)), sys.prefix, *sourced):
        if prefix:
            yield Path(prefix) / 'share' / PACKAGE


def _prefixes_above(file: Path) -> list[Path]:
    """PREFIX of PREFIX/lib/pythonX.Y/site-packages/golf_sim_ros/..., whichever Python that is."""
    return [folder.parent for folder in file.parents if folder.name in ('lib', 'lib64')]
