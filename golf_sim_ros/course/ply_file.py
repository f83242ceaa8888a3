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

"""Vertices and faces of PLY files (Turk, The PLY polygon file format, 1994), text or binary."""

from collections.abc import Callable, Iterator
from struct import calcsize, unpack_from
from struct import error as StructError
from typing import Any

import numpy as np

from .polygon_faces import triangles_of
from .schema import CourseError, shown

Columns = dict[str, Any]  # by property: an array, or a list of lists

TYPES = {
    'char': 'i1',
    'uchar': 'u1',
    'short': 'i2',
    'ushort': 'u2',
    'int': 'i4',
    'uint': 'u4',
    'float': 'f4',
    'double': 'f8',
    'int8': 'i1',
    'uint8': 'u1',
    'int16': 'i2',
    'uint16': 'u2',
    'int32': 'i4',
    'uint32': 'u4',
    'float32': 'f4',
    'float64': 'f8',
    'int64': 'i8',
    'uint64': 'u8',
}
LETTERS = {
    'i1': 'b',
    'u1': 'B',
    'i2': 'h',
    'u2': 'H',
    'i4': 'i',
    'u4': 'I',
    'f4': 'f',
    'f8': 'd',
    'i8': 'q',
    'u8': 'Q',
}
ORDERS = {'ascii': '', 'binary_little_endian': '<', 'binary_big_endian': '>'}
CORNERS = ('vertex_indices', 'vertex_index')


class Element:
    """A kind of row, and how many there are.

    `properties`: of each its name, its type, and the type of a length where it is a list.
    """

    def __init__(self, name: str, count: int) -> None:
        self.name = name
        self.count = count
        self.properties: list[tuple[str, str, str | None]] = []


def ply(raw: bytes) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Vertices, faces and notes of a PLY file."""
    try:
        order, elements, body = header(raw)
        read = text_rows(raw[body:].split()) if order == '' else binary_rows(raw, body, order)
        rows = {element.name: read(element) for element in elements}
        vertices = np.stack([np.asarray(rows['vertex'][axis], float) for axis in 'xyz'], 1)
        polygons = faces_in(rows)
    except KeyError as error:
        raise CourseError(
            f'is no PLY file that can be read: {error.args[0]!r} is missing or unknown'
        ) from None
    except (ValueError, IndexError, OverflowError, StructError) as error:
        if isinstance(error, CourseError):
            raise
        raise CourseError(
            'is no PLY file that can be read: it ends too soon, or a number is none'
        ) from None
    for i, polygon in enumerate(polygons):
        if len(polygon) < 3 or not 0 <= min(polygon) <= max(polygon) < len(vertices):
            raise CourseError(
                f'face {i}: {shown(list(map(int, polygon)))} must be 3 or more numbers of the '
                f'{len(vertices)} vertices there are'
            )
    faces, crossed = triangles_of(polygons, vertices)
    return vertices, faces, [f'face {i} crosses itself and was left out' for i in crossed[:3]]


def header(raw: bytes) -> tuple[str, list[Element], int]:
    """Order of bytes ('' in text), `Element`s, and where their rows begin."""
    end = raw.find(b'end_header')
    if not raw.startswith(b'ply') or end < 0:
        raise CourseError('is no PLY file')
    elements: list[Element] = []
    order = None
    for line in raw[:end].decode('ascii', 'replace').splitlines():
        words = line.split()
        if words[:1] == ['format']:
            order = ORDERS[words[1]]
        elif words[:1] == ['element']:
            elements.append(Element(words[1], int(words[2])))
            if not 0 <= elements[-1].count <= len(raw):
                raise CourseError(
                    f'is no PLY file: it tells of {words[2]} {words[1]}, and has {len(raw)} bytes'
                )
        elif words[:2] == ['property', 'list']:
            elements[-1].properties.append((words[4], TYPES[words[3]], TYPES[words[2]]))
        elif words[:1] == ['property']:
            elements[-1].properties.append((words[2], TYPES[words[1]], None))
    if order is None:
        raise CourseError('is no PLY file: it tells of no format')
    body = end + len(b'end_header')
    return order, elements, body + (2 if raw.startswith(b'\r\n', body) else 1)


def text_rows(words: list[bytes]) -> Callable[[Element], Columns]:
    """Make the reader of an element's rows from `words`.

    It gives a dict of columns; those of lists are lists of lists.
    """
    place = 0

    def read(element: Element) -> Columns:
        nonlocal place
        if all(length is None for _, _, length in element.properties):
            width = len(element.properties)
            begin, place = place, place + element.count * width
            table = np.array(words[begin:place], float).reshape(element.count, width)
            return {name: table[:, i] for i, (name, _, _) in enumerate(element.properties)}
        columns: Columns = {name: [] for name, _, _ in element.properties}
        for _ in range(element.count):
            for name, _, length in element.properties:
                size = 1
                if length:
                    size, place = int(words[place]), place + 1
                begin, place = place, place + size
                found = [float(word) for word in words[begin:place]]
                if len(found) != size:
                    raise ValueError
                columns[name].append(found if length else found[0])
        return columns

    return read


def binary_rows(raw: bytes, place: int, order: str) -> Callable[[Element], Columns]:
    """Make the reader of an element's rows from bytes, from `place` on, as `text_rows` does."""

    def read(element: Element) -> Columns:
        nonlocal place
        plain = all(length is None for _, _, length in element.properties)
        columns, place = (table if plain else ragged)(element, raw, place, order)
        return columns

    return read


def table(element: Element, raw: bytes, place: int, order: str) -> tuple[Columns, int]:
    """Columns of an element without lists, and where it ends."""
    kind = np.dtype([(name, order + sort) for name, sort, _ in element.properties])
    if kind.itemsize == 0:
        return {}, place
    found = np.frombuffer(raw, kind, element.count, place)
    columns = {name: found[name] for name, _, _ in element.properties}
    return columns, place + element.count * kind.itemsize


def ragged(element: Element, raw: bytes, place: int, order: str) -> tuple[Columns, int]:
    """Columns of an element with lists, and where it ends."""
    columns: Columns = {name: [] for name, _, _ in element.properties}
    for _ in range(element.count):
        for name, sort, length in element.properties:
            size = 1
            if length:
                size = int(unpack_from(order + LETTERS[length], raw, place)[0])
                place += calcsize(order + LETTERS[length])
            if not 0 <= size <= len(raw):
                raise ValueError
            form = f'{order}{size}{LETTERS[sort]}'
            found = unpack_from(form, raw, place)
            place += calcsize(form)
            columns[name].append(found if length else found[0])
    return columns, place


def faces_in(rows: dict[str, Columns]) -> list[list[int]]:
    """Polygons of faces, or of strips of triangles, where there are any."""
    if 'tristrips' in rows:
        return [triangle for strip in lists_in(rows['tristrips']) for triangle in stripped(strip)]
    return lists_in(rows['face']) if 'face' in rows else []


def lists_in(columns: Columns) -> list[list[int]]:
    """Numbers of vertices, whole ones, of each polygon."""
    name = next((name for name in CORNERS if name in columns), CORNERS[0])
    return [[int(corner) for corner in polygon] for polygon in columns[name]]


def stripped(strip: list[int]) -> Iterator[list[int]]:
    """Triangles of a strip: each two corners with the next one; -1 begins another one."""
    begin = 0
    for i, corner in enumerate(strip):
        if corner < 0:
            begin = i + 1
        elif i >= begin + 2:
            before, last = strip[i - 2], strip[i - 1]
            yield [before, last, corner] if (i - begin) % 2 == 0 else [last, before, corner]
