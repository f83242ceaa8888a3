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

"""Wind fields that are not finished: directions done so far, in a file beside the field's."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from .solving import Solved


class Unfinished:
    """Directions that have been solved for, of a field that will be at `path`.

    Parameters
    ----------
    path : str or path
        Of the field; what is unfinished is beside it, its name ending in ``.part``.
    key : str
        Says what is solved for: what was kept for something else is left alone until it is
        overwritten.
    """

    def __init__(self, path: str | os.PathLike, key: str) -> None:
        self.path = Path(f'{os.fspath(path)}.part')
        self.key, self.solved = key, {}
        try:
            with open(self.path, 'rb') as file, np.load(file, allow_pickle=False) as content:
                if str(content['key']) == key:
                    self.solved = {
                        float(angle): Solved(content[f'ratios{n}'], content[f'residuals{n}'])
                        for n, angle in enumerate(content['angles'])
                    }
        except Exception:  # whatever is wrong with it: it only saves time
            self.solved = {}

    def add(self, angle: float, solved: Solved) -> None:
        """Keep what was `Solved` for an angle."""
        self.solved[angle] = solved
        content: dict[str, Any] = {'key': self.key, 'angles': list(self.solved)}
        for number, row in enumerate(self.solved.values()):
            content[f'ratios{number}'] = row.ratios
            content[f'residuals{number}'] = row.residuals
        new = self.path.with_name(f'{self.path.name}.new')
        with open(new, 'wb') as file:
            np.savez(file, **content)
        os.replace(new, self.path)

    def forget(self) -> None:
        """Remove the file, of a field that is finished."""
        self.path.unlink(missing_ok=True)
