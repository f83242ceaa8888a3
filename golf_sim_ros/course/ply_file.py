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

from struct import calcsize, unpack_from
from struct import error as StructError

import numpy as np

from .polygon_faces import triangles_of
from .schema import CourseError, shown

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

    Of each property its name, type, and that of a list's length.
    """

    def __init__(self, name, count):
        self.name, self.count, self.properties = name, count, []


def ply(raw):
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


def header(raw):
    """Order of bytes ('' in text), `Element`s, and where their rows begin."""
    end = raw.find(b'end_header')
    if not raw.startswith(b'ply') or end < 0:
        raise CourseError('is no PLY file')
    elements, order = [], None
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
    return order, elements, body + (2 if raw[body : body + 2] == b'\r\n' else 1)


def text_rows(words):
    """Reader of an element's rows from `words`: a dict of columns, those of lists are lists of arrays."""
    place = 0

    def read(element):
        nonlocal place
        if all(length is None for _, _, length in element.properties):
            width = len(element.properties)
            table = np.array(words[place : place + element.count * width], float).reshape(
                element.count, width
            )
            place += element.count * width
            return {name: table[:, i] for i, (name, _, _) in enumerate(element.properties)}
        columns = {name: [] for name, _, _ in element.properties}
        for _ in range(element.count):
            for name, _, length in element.properties:
                size = 1
                if length:
                    size, place = int(words[place]), place + 1
                found = [float(word) for word in words[place : place + size]]
                if len(found) != size:
                    raise ValueError
                place += size
                columns[name].append(found if length else found[0])
        return columns

    return read


def binary_rows(raw, place, order):
    """Reader of an element's rows from bytes, from `place` on: a dict of columns, as `text_rows`."""

    def read(element):
        nonlocal place
        columns, place = (
            table if all(length is None for _, _, length in element.properties) else ragged
        )(element, raw, place, order)
        return columns

    return read


def table(element, raw, place, order):
    """Columns of an element without lists, and where it ends."""
    kind = np.dtype([(name, order + sort) for name, sort, _ in element.properties])
    if kind.itemsize == 0:
        return {}, place
    found = np.frombuffer(raw, kind, element.count, place)
    return {name: found[name] for name in kind.names}, place + element.count * kind.itemsize


def ragged(element, raw, place, order):
    """`table` of an element with lists."""
    columns = {name: [] for name, _, _ in element.properties}
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


def faces_in(rows):
    """Polygons of faces, or of strips of triangles, where there are any."""
    if 'tristrips' in rows:
        return [triangle for strip in lists_in(rows['tristrips']) for triangle in stripped(strip)]
    return lists_in(rows['face']) if 'face' in rows else []


def lists_in(columns):
    """Lists of whole numbers of vertices."""
    name = next((name for name in CORNERS if name in columns), CORNERS[0])
    return [[int(corner) for corner in polygon] for polygon in columns[name]]


def stripped(strip):
    """Triangles of a strip: each two corners with the next one; -1 begins another one."""
    begin = 0
    for i, corner in enumerate(strip):
        if corner < 0:
            begin = i + 1
        elif i >= begin + 2:
            yield (
                strip[i - 2 : i + 1]
                if (i - begin) % 2 == 0
                else [strip[i - 1], strip[i - 2], corner]
            )
