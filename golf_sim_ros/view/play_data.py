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

"""A recorded play as one block of bytes for the page.

Layout, little endian, rows of one ball after those of another, as the JSON counts them::

    'PLAY'  u32 length of JSON  JSON  f32 rows[n][4]: time, x, y, z
"""

import json
import struct

import numpy as np

from ..drawing.shots import DrawnShot
from ..physics import Collision
from ..recording.json_format import result_text

STEADY = 1.2  # s before a strike at which a ball that was dropped or placed lies there


def play_data(shots: list[DrawnShot]) -> bytes:
    """Compact data of shots that were played.

    Parameters
    ----------
    shots : list of DrawnShot
        On one clock, as `drawing.recorded` gives them.

    Returns
    -------
    bytes
    """
    shots = sorted(shots, key=lambda shot: shot.times[0])
    names = list(dict.fromkeys(shot.result.ball for shot in shots))
    rows = [ball_rows([shot for shot in shots if shot.result.ball == name]) for name in names]
    about = {
        'balls': [{'name': name, 'count': len(part)} for name, part in zip(names, rows)],
        'shots': [
            {
                'ball': names.index(shot.result.ball),
                'start': round(float(shot.times[0]), 4),
                'end': round(float(shot.times[-1]), 4),
                'result': json.loads(result_text(shot.result, shot.result.shot)),
            }
            for shot in shots
        ],
        'wind': winds(shots),
    }
    head = json.dumps(about).encode()
    head += b' ' * (-len(head) % 4)
    return b'PLAY' + struct.pack('<I', len(head)) + head + b''.join(map(np.ndarray.tobytes, rows))


def ball_rows(shots: list[DrawnShot]) -> np.ndarray:
    """Rows of time, x, y, z of one ball, (n, 4) float32; impacts are rows of their own."""
    parts: list[np.ndarray] = []
    for shot in shots:
        path = np.column_stack([shot.times, shot.positions])
        hits = [(hit.time, *hit.position) for hit in shot.collisions if is_within(hit, shot)]
        path = np.vstack([path, np.reshape(hits, (-1, 4))])
        path = path[np.argsort(path[:, 0], kind='stable')]
        if parts:
            last = parts[-1][-1]
            waits = max(path[0, 0] - STEADY, last[0])
            parts.append(np.array([(waits, *last[1:]), (waits, *path[0, 1:])]))
        parts.append(path)
    return np.vstack(parts).astype('<f4')


def is_within(hit: Collision, shot: DrawnShot) -> bool:
    """Whether an impact has a time and place within a shot's path."""
    in_time = shot.times[0] <= hit.time <= shot.times[-1]
    return bool(in_time and np.isfinite(hit.position).all())


def winds(shots: list[DrawnShot]) -> list:
    """Rows of a time and the wind from then on, where it changed by what can be seen."""
    rows = sorted(tuple(map(float, row)) for shot in shots for row in shot.wind)
    kept: list[list[float]] = []
    for row in rows:
        if not kept or np.abs(np.subtract(row[1:], kept[-1][1:])).max() >= 0.1:
            kept.append([round(number, 2) for number in row])
    return kept
