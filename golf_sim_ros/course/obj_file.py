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

"""Vertices and faces of OBJ files, in all the dialects that programs write."""

from collections.abc import Iterator

import numpy as np

from .input_file import decoded
from .polygon_faces import triangles_of
from .schema import CourseError, shown


def obj(raw: bytes) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Vertices, faces and notes of an OBJ file; lines that are neither are not looked at.

    Lines may be indented, have tabs, comments behind them, and end in any way; vertices may have
    colours.
    """
    places: list[tuple[float, float, float]] = []
    polygons: list[list[int]] = []
    lines: list[int] = []
    for number, line in whole_lines(decoded(raw)):
        words = line.split()
        if not words or words[0] not in ('v', 'f'):
            continue
        try:
            if words[0] == 'v':
                places.append(vertex(words))
            else:
                polygons.append(face(words, len(places)))
                lines.append(number)
        except ValueError:
            raise CourseError(
                f'is no OBJ file that can be read: line {number} {shown(line.strip())}: a vertex '
                'is three numbers or more, a face three whole ones or more'
            ) from None
    vertices = np.array(places, float).reshape(-1, 3)
    check(polygons, lines, len(vertices))
    faces, crossed = triangles_of(polygons, vertices)
    notes = [f'the face in line {lines[i]} crosses itself and was left out' for i in crossed[:3]]
    return vertices, faces, notes


def whole_lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield the number of each line, and the line without its comment.

    Where a backslash ends a line, with those that follow.
    """
    begun, first = '', 0
    for number, line in enumerate(text.splitlines(), 1):
        first, line = first or number, line.partition('#')[0].rstrip()
        if line.endswith('\\'):
            begun += line[:-1] + ' '
            continue
        yield first, begun + line
        begun, first = '', 0
    if begun:
        yield first, begun


def vertex(words: list[str]) -> tuple[float, float, float]:
    """Read x, y, z; what comes after them, a weight or a colour, does not count."""
    x, y, z = words[1:4]
    return float(x), float(y), float(z)


def face(words: list[str], so_far: int) -> list[int]:
    """Numbers of vertices from 0 on.

    A corner is ``vertex/texture/normal``, and negative ones count back.
    """
    corners = [int(word.partition('/')[0]) for word in words[1:]]
    if len(corners) < 3:
        raise ValueError('two corners')
    return [
        corner - 1 if corner > 0 else so_far + corner if corner < 0 else -1 for corner in corners
    ]


def check(polygons: list[list[int]], lines: list[int], vertices: int) -> None:
    """Refuse a face with a vertex that there is not."""
    for polygon, line in zip(polygons, lines):
        if not 0 <= min(polygon) <= max(polygon) < vertices:
            raise CourseError(
                f'line {line}: a face names a vertex that is none of the {vertices} there are'
            )
