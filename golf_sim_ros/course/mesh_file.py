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

"""Triangles from files: STL, OBJ and PLY read here, glTF by trimesh where it is installed."""

from collections.abc import Callable
from io import BytesIO
from os import PathLike
from pathlib import Path

import numpy as np

from .gltf_file import checked_gltf, Neighbours
from .input_file import content
from .obj_file import obj
from .ply_file import ply
from .schema import CourseError, FAR
from .stl_file import stl
from ..optional_packages import how_to_get
from ..physics.geometry.mesh import NARROW, widths

Triangles = tuple[np.ndarray, np.ndarray, list[str]]  # vertices, faces, notes: see `read_mesh`

HINT = f'needs trimesh: {how_to_get("mesh", "trimesh")}'
TALL = 3.0  # times as high as it is wide: a wall, or ground that lies on its side


def read_mesh(path: str | PathLike[str], up: str | None = None, scale: float = 1.0) -> Triangles:
    """Read the triangles of a mesh file: .stl, .obj, .ply, and with trimesh .glb and .gltf.

    Parameters
    ----------
    path : path
    up : 'y', 'z' or None
        Which axis of the file points up; None: the format's own, y in glTF, else z.
    scale : float
        Metres a unit of the file.

    Returns
    -------
    vertices : ndarray (n, 3)
        Metres, z up.
    faces : ndarray (m, 3) of int
        Numbers of vertices.
    notes : list of str
        What was repaired, or looks wrong: a line each.

    Raises
    ------
    CourseError
        One line: the file, and why it cannot be used.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    try:
        if suffix not in READERS:
            raise CourseError(f'is no mesh; known: {", ".join(sorted(READERS))}')
        raw = content(path)
        with np.errstate(all='ignore'):  # whatever is not finite is refused
            vertices, faces, told = READERS[suffix](raw, path)
            vertices, told = upright(vertices, told, suffix, up)
            vertices, faces, put_right = cleaned(vertices * scale, faces)
            notes = [*told, *put_right, *lying(vertices, faces, suffix, up)]
            return vertices, faces, [f'{path.name}: {note}' for note in notes]
    except MemoryError:
        raise CourseError(f'{path}: is too large for the memory there is') from None
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None


def upright(
    vertices: np.ndarray, notes: list[str], suffix: str, up: str | None
) -> tuple[np.ndarray, list[str]]:
    """`vertices` with z up, and notes."""
    if up is None and suffix in Y_UP:
        notes = [
            *notes,
            'y is up in glTF, so (x, y, z) was read as (x, -z, y); `up: z` would leave it',
        ]
    if own_up(suffix, up) == 'z':
        return vertices, notes
    x, y, z = vertices.T
    return np.stack((x, 0.0 - z, y), 1), notes


def own_up(suffix: str, up: str | None) -> str:
    """Which axis of the file points up."""
    return up or ('y' if suffix in Y_UP else 'z')


def lying(vertices: np.ndarray, faces: np.ndarray, suffix: str, up: str | None) -> list[str]:
    """Note that a mesh is much taller than it is wide: perhaps another axis is up."""
    x, y, z = np.ptp(vertices[faces].reshape(-1, 3), 0)
    if z <= TALL * min(x, y):
        return []
    other = 'z' if own_up(suffix, up) == 'y' else 'y'
    return [
        f'is {z:.4g} m high, {x:.4g} m long and {y:.4g} m wide: if it lies on its side, '
        f'say `up: {other}`'
    ]


def by_trimesh(raw: bytes, path: Path) -> Triangles:
    """Vertices and faces of what trimesh can read, all parts of a scene in one."""
    try:
        import trimesh
    except ImportError:
        raise CourseError(HINT) from None
    checked_gltf(raw, path)
    try:
        found = trimesh.load(
            BytesIO(raw),
            path.suffix[1:].lower(),
            resolver=Neighbours(path.parent),
            process=False,
            force='mesh',
            skip_materials=True,
        )
        return np.asarray(found.vertices, float), np.asarray(found.faces, np.int64), []
    except CourseError:
        raise
    except Exception as error:  # whatever a reader of foreign files may say
        reason = ' '.join(str(error).split()) or type(error).__name__
        raise CourseError(f'cannot be read by trimesh: {reason}') from None


Y_UP = ('.glb', '.gltf')
READERS: dict[str, Callable[[bytes, Path], Triangles]] = {
    '.stl': lambda raw, path: stl(raw),
    '.obj': lambda raw, path: obj(raw),
    '.ply': lambda raw, path: ply(raw),
    '.glb': by_trimesh,
    '.gltf': by_trimesh,
}


def cleaned(vertices: np.ndarray, faces: np.ndarray) -> Triangles:
    """`vertices` and `faces` without what makes no ground, and notes about it; see `read_mesh`."""
    if len(faces) == 0:
        raise CourseError('has no faces')
    if not 0 <= faces.min() <= faces.max() < len(vertices):
        raise CourseError(f'a face names a vertex that is none of the {len(vertices)} there are')
    if not (np.isfinite(vertices).all() and (np.abs(vertices[faces]) <= FAR).all()):
        raise CourseError(f'a vertex is not finite, or more than {FAR:g} m away')
    notes = []
    first, number = merged(vertices)
    if len(first) < len(vertices):
        notes.append(f'{len(vertices) - len(first)} vertices equal to others were merged')
        vertices, faces = vertices[first], number[faces]
    flat = widths(vertices[faces]) <= NARROW
    if flat.any():
        notes.append(f'{flat.sum()} faces without area were dropped')
        faces = faces[~flat]
    kept, _ = merged(np.sort(faces, 1))
    if len(kept) < len(faces):
        notes.append(f'{len(faces) - len(kept)} faces that come twice were dropped')
        faces = faces[np.sort(kept)]
    if len(faces) == 0:
        raise CourseError('has no face with an area')
    return vertices, faces, notes


def merged(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find sets of equal `rows` (n, 3).

    Returns the number of the first row of each set, and for each row the number of its set.
    """
    order = np.lexsort(rows.T)
    new = np.ones(len(rows), bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(1)
    number = np.empty(len(rows), np.int64)
    number[order] = np.cumsum(new) - 1
    return order[new], number


def outward(vertices: np.ndarray, faces: np.ndarray, name: str) -> tuple[np.ndarray, list[str]]:
    """`faces` with their fronts outside, and notes.

    Those of a closed mesh that is inside out are turned.
    """
    if not is_closed(faces):
        return faces, []
    a, b, c = (vertices - vertices.mean(0))[faces].transpose(1, 0, 2)
    if np.einsum('ij,ij', a, np.cross(b, c)) >= 0.0:  # six times the volume
        return faces, []
    return faces[:, ::-1], [f'{name}: was inside out, so its faces were turned']


def is_closed(faces: np.ndarray) -> bool:
    """Whether every side of a face is one of just one other face.

    That one runs along it the other way.
    """
    sides = faces[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2)
    there = sides[np.lexsort(sides.T)]
    back = sides[:, ::-1][np.lexsort(sides[:, ::-1].T)]
    return bool((there == back).all() and (there[1:] != there[:-1]).any(1).all())
