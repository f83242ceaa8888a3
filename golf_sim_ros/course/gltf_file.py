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

"""glTF 2.0 (Khronos, ISO/IEC 12113): refuses what trimesh would read wrongly without saying so."""

from collections.abc import Sequence
from io import BytesIO
import json
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from .input_file import beside, content
from .schema import CourseError, shown

MAGIC, JSON = b'glTF', b'JSON'
# What changes where triangles lie. Of the compressed ones trimesh reads some, if it has a decoder.
UNREAD = {
    'KHR_draco_mesh_compression': 'is compressed with Draco: export it without compression',
    'EXT_meshopt_compression': 'is compressed with meshopt: export it without compression',
    'EXT_mesh_gpu_instancing': 'has instances (EXT_mesh_gpu_instancing): export them as meshes',
}
TRIANGLES, STRIP = 4, 5
SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4, 'MAT2': 4, 'MAT3': 9, 'MAT4': 16}


class Neighbours:
    """Resolver for trimesh of the files that a .gltf file names, from its own folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def get(self, name: str) -> bytes:
        """Bytes of a file."""
        try:
            return content(beside(self.folder, unquote(name)))
        except CourseError as error:
            raise CourseError(f'{name}: {error}') from None

    __getitem__ = get


def checked_gltf(raw: bytes, path: Path) -> None:
    """Refuse a file that trimesh would read wrongly without saying so."""
    try:
        tree = json.loads(json_of(raw) if path.suffix.lower() == '.glb' else raw)
        used = {*tree.get('extensionsUsed', ()), *tree.get('extensionsRequired', ())}
        for name in used & UNREAD.keys():
            raise CourseError(UNREAD[name])
        check_accessors(tree)
        for mesh in tree.get('meshes', ()):
            for primitive in mesh['primitives']:
                check_primitive(primitive, tree['accessors'])
        check_nodes(tree.get('nodes', ()))
    except CourseError:
        raise
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, RecursionError) as error:
        raise CourseError(
            f'is no glTF file that can be read: {" ".join(str(error).split())}'
        ) from None


def json_of(raw: bytes) -> bytes:
    """JSON chunk of a .glb file, which says what is in it."""
    file = BytesIO(raw)
    magic, version, _ = file.read(4), int.from_bytes(file.read(4), 'little'), file.read(4)
    size, kind = int.from_bytes(file.read(4), 'little'), file.read(4)
    if magic != MAGIC or kind != JSON:
        raise CourseError('is no glTF file')
    if version != 2:
        raise CourseError(f'is of version {version} of glTF; known: 2')
    return file.read(size)


def check_accessors(tree: dict[str, Any]) -> None:
    """Refuse arrays that are longer than what they are taken from."""
    views = tree.get('bufferViews', ())
    for number, accessor in enumerate(tree.get('accessors', ())):
        size = SIZES[accessor['componentType']] * WIDTHS[accessor['type']]
        count = accessor['count']
        room = views[accessor['bufferView']]['byteLength'] if 'bufferView' in accessor else 1e7
        if not 0 <= count * size <= room:
            raise CourseError(
                f'is no glTF file that can be read: accessor {number} tells of {shown(count)} '
                'rows, and has not as many bytes'
            )


def check_primitive(primitive: dict[str, Any], accessors: list[dict[str, Any]]) -> None:
    """Refuse triangles whose corners are not simply a list of numbers in metres."""
    mode = primitive.get('mode', TRIANGLES)
    if mode < TRIANGLES:  # points and lines are no ground
        return
    if mode not in (TRIANGLES, STRIP):
        raise CourseError(
            f'has triangles in mode {mode}; known: {TRIANGLES}, a list, and {STRIP}, strips'
        )
    corners = accessors[primitive['attributes']['POSITION']]
    numbers = accessors[primitive['indices']] if 'indices' in primitive else corners
    for accessor in (corners, numbers):
        if 'sparse' in accessor or 'bufferView' not in accessor:
            raise CourseError('has a sparse accessor: export it without')
    if corners.get('normalized'):
        raise CourseError(
            'has positions that are normalized integers: export it without quantization'
        )


def check_nodes(nodes: Sequence[dict[str, Any]]) -> None:
    """Refuse a node that is its own child, or that of several."""
    seen = set()
    for node in nodes:
        for child in node.get('children', ()):
            if child in seen:
                raise CourseError(
                    f'is no glTF file that can be read: node {shown(child)} has two parents'
                )
            seen.add(child)
    left = [number for number in range(len(nodes)) if number not in seen]
    reached: set[int] = set()
    while left:
        number = left.pop()
        reached.add(number)
        left += nodes[number].get('children', ())
    if len(reached) < len(nodes):
        raise CourseError('is no glTF file that can be read: a node is below itself')
