# SPDX-License-Identifier: Apache-2.0
"""Triangles from files: STL and OBJ read here, PLY and GLB by trimesh where it is installed."""
from io import StringIO
from pathlib import Path

import numpy as np

from .checked import FAR, CourseError
from .needed import how_to_get
from .physics.ground.mesh import NARROW, widths

STL_HEAD = 84  # bytes before the triangles: 80 of anything, then their number
STL_TRIANGLE = np.dtype([('normal', '<f4', 3), ('corners', '<f4', (3, 3)), ('attribute', '<u2')])
HINT = f'needs trimesh: {how_to_get("mesh", "trimesh")}'


def read_mesh(path):
    """Triangles of a mesh file: .stl, .obj, and with trimesh .ply, .glb.

    Returns
    -------
    vertices : ndarray (n, 3)
        As they are in the file, which should be metres, z up.
    faces : ndarray (m, 3) of int
        Numbers of vertices.
    notes : list of str
        What was put right: a line each.

    Raises
    ------
    CourseError
        One line: the file, and why it cannot be used.
    """
    path = Path(path)
    try:
        if path.suffix.lower() not in READERS:
            raise CourseError(f'is no mesh; known: {", ".join(sorted(READERS))}')
        raw = path.read_bytes()
        if not raw:
            raise CourseError('is empty')
        vertices, faces = READERS[path.suffix.lower()](raw, path)
        return cleaned(vertices, faces, path.name)
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None
    except OSError as error:
        raise CourseError(f'{path}: cannot be read: {error.strerror or error}') from None


def stl(raw, path):
    """Vertices, three a triangle, and faces of an STL file, binary or text."""
    count = int.from_bytes(raw[80:STL_HEAD], 'little')
    if len(raw) >= STL_HEAD and len(raw) == STL_HEAD + count * STL_TRIANGLE.itemsize:
        corners = np.frombuffer(raw, STL_TRIANGLE, count, STL_HEAD)['corners']
    elif raw.lstrip().startswith(b'solid'):
        corners = stl_text(raw)
    else:
        raise CourseError(f'is no STL file: {len(raw)} bytes do not hold the {count} triangles it tells of')
    vertices = corners.reshape(-1, 3).astype(float)
    return vertices, np.arange(len(vertices)).reshape(-1, 3)


def stl_text(raw):
    """Corners (m, 3, 3) of an STL file in text."""
    words = [line.split()[1:4] for line in raw.splitlines() if line.lstrip().startswith(b'vertex')]
    try:
        corners = np.array(words, float).reshape(-1, 3)
    except ValueError:
        raise CourseError('is no STL file: a vertex is not three numbers') from None
    if len(corners) % 3:
        raise CourseError(f'is no STL file: {len(corners)} vertices make no triangles')
    return corners.reshape(-1, 3, 3)


def obj(raw, path):
    """Vertices and faces of an OBJ file; a face of more corners is a fan of triangles."""
    text = raw.decode('utf-8', 'replace').replace('\\\n', ' ')
    lines = text.splitlines()
    corners = '\n'.join(line[2:] for line in lines if line.startswith('v '))
    rows = [line[2:] for line in lines if line.startswith('f ')]
    try:
        vertices = np.loadtxt(StringIO(corners), ndmin=2) if corners else np.zeros((0, 3))
        if vertices.shape[1] < 3:
            raise ValueError
        return vertices[:, :3], obj_faces(rows, len(vertices))
    except ValueError:
        raise CourseError('is no OBJ file: a vertex is not three numbers, or a face not whole ones') from None


def obj_faces(rows, vertices):
    """Triangles, counted from 0, of the lines of faces; a corner is ``vertex/texture/normal``."""
    if any('/' in row for row in rows):
        rows = [' '.join(word.partition('/')[0] for word in row.split()) for row in rows]
    faces = []
    sizes = np.array([len(row.split()) for row in rows], int)
    for size in np.unique(sizes):
        if size < 3:
            raise ValueError('a face of two corners')
        same = StringIO('\n'.join(row for row, n in zip(rows, sizes) if n == size))
        polygons = np.loadtxt(same, int, ndmin=2)
        polygons = np.where(polygons < 0, vertices + polygons, polygons - 1)  # negative ones count back
        faces += [polygons[:, (0, k, k + 1)] for k in range(1, size - 1)]
    return np.concatenate(faces) if faces else np.zeros((0, 3), int)


def by_trimesh(raw, path):
    """Vertices and faces of what trimesh can read, all parts of a scene in one."""
    try:
        import trimesh
    except ImportError:
        raise CourseError(HINT) from None
    try:
        found = trimesh.load(path, process=False, force='mesh')
        return np.asarray(found.vertices, float), np.asarray(found.faces, np.int64)
    except Exception as error:  # whatever a reader of foreign files may say
        raise CourseError(f'cannot be read by trimesh: {" ".join(str(error).split())}') from None


READERS = {'.stl': stl, '.obj': obj, '.ply': by_trimesh, '.glb': by_trimesh}


def cleaned(vertices, faces, name):
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
        notes.append(f'{name}: {len(vertices) - len(first)} vertices equal to others were merged')
        vertices, faces = vertices[first], number[faces]
    flat = widths(vertices[faces]) <= NARROW
    if flat.any():
        notes.append(f'{name}: {flat.sum()} faces without area were dropped')
        faces = faces[~flat]
    kept, _ = merged(np.sort(faces, 1))
    if len(kept) < len(faces):
        notes.append(f'{name}: {len(faces) - len(kept)} faces that come twice were dropped')
        faces = faces[np.sort(kept)]
    if len(faces) == 0:
        raise CourseError('has no face with an area')
    return vertices, faces, notes


def merged(rows):
    """Number of the first of each set of equal `rows` (n, 3), and for each row the number of its set."""
    order = np.lexsort(rows.T)
    new = np.ones(len(rows), bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(1)
    number = np.empty(len(rows), np.int64)
    number[order] = np.cumsum(new) - 1
    return order[new], number


def outward(vertices, faces, name):
    """`faces` with their fronts outside, and notes: of a closed mesh that is inside out, they are turned."""
    if not is_closed(faces):
        return faces, []
    a, b, c = (vertices - vertices.mean(0))[faces].transpose(1, 0, 2)
    if np.einsum('ij,ij', a, np.cross(b, c)) >= 0.0:  # six times the volume
        return faces, []
    return faces[:, ::-1], [f'{name}: was inside out, so its faces were turned']


def is_closed(faces):
    """Whether every side of a face is that of one other face, which runs along it the other way."""
    sides = faces[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2)
    there = sides[np.lexsort(sides.T)]
    back = sides[:, ::-1][np.lexsort(sides[:, ::-1].T)]
    return bool((there == back).all() and (there[1:] != there[:-1]).any(1).all())
