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

"""Triangles of STL files, binary or text."""

import re

import numpy as np

from .input_file import decoded
from .schema import CourseError, shown

STL_HEAD = 84  # bytes before the triangles: 80 of anything, then their number
STL_TRIANGLE = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])
WORDS = re.compile(rb'\b(facet|vertex)\b', re.IGNORECASE)


def stl(raw: bytes) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Vertices, three a triangle, faces and notes of an STL file."""
    count = int.from_bytes(raw[80:STL_HEAD], 'little')
    size = STL_HEAD + count * STL_TRIANGLE.itemsize
    notes: list[str] = []
    # In a text these four bytes are letters: half a billion triangles, or more.
    if STL_HEAD <= len(raw) and size <= len(raw):
        corners = np.frombuffer(raw, STL_TRIANGLE, count, STL_HEAD)['corners']
        if count and len(raw) > size:
            notes.append(f'{len(raw) - size} bytes behind the last triangle were left out')
    elif is_text(raw):
        corners = stl_text(decoded(raw))
    else:
        raise CourseError(
            f'is no STL file: {len(raw)} bytes do not hold the {count} triangles it tells of'
        )
    vertices = corners.reshape(-1, 3).astype(float)
    return vertices, np.arange(len(vertices)).reshape(-1, 3), notes


def is_text(raw: bytes) -> bool:
    """Whether it says ``solid``, in whatever letters, or has facets without saying so."""
    text = decoded(raw[:1000]).lstrip().lower()
    return (
        text.startswith('solid')
        or b'\0' not in raw
        and len(set(map(bytes.lower, WORDS.findall(raw)))) == 2
    )


def stl_text(text: str) -> np.ndarray:
    """Corners (m, 3, 3) of an STL file in text."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split()
        if words and words[0].lower() == 'vertex':
            try:
                x, y, z = words[1:4]
                found.append((float(x), float(y), float(z)))
            except ValueError:
                raise CourseError(
                    'is no STL file: a vertex is not three numbers: line '
                    f'{number} {shown(line.strip())}'
                ) from None
    if len(found) % 3:
        raise CourseError(f'is no STL file: {len(found)} vertices make no triangles')
    return np.array(found, float).reshape(-1, 3, 3)
