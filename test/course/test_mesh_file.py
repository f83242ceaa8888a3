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

"""Mesh files: what is read of each format, what is repaired and noted, and what is refused."""

import sys

from golf_sim_ros.course import load_course
from golf_sim_ros.course.mesh_file import outward, read_mesh
from golf_sim_ros.course.schema import CourseError
from golf_sim_ros.course.stl_file import STL_TRIANGLE
from golf_sim_ros.physics import ground_height
import numpy as np
import pytest

SQUARE = np.array([[(0, 0, 1), (4, 0, 1), (4, 4, 1)], [(0, 0, 1), (4, 4, 1), (0, 4, 1)]], float)
CORNERS = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
TETRAHEDRON = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
OBJ = 'v 0 0 1\nv 4 0 1\nv 4 4 1\nv 0 4 1\n'


def binary_stl(corners):
    """Bytes of an STL file of triangles (m, 3, 3)."""
    rows = np.zeros(len(corners), STL_TRIANGLE)
    rows['corners'] = corners
    return b'\0' * 80 + len(corners).to_bytes(4, 'little') + rows.tobytes()


def text_stl(corners):
    """Return the same in text."""
    facets = [
        ' facet normal 0 0 0\n  outer loop\n'
        + ''.join(f'   vertex {x} {y} {z}\n' for x, y, z in three)
        + '  endloop\n endfacet\n'
        for three in corners
    ]
    return ('solid square\n' + ''.join(facets) + 'endsolid square\n').encode()


@pytest.fixture
def read(tmp_path):
    """Write a file and read it."""

    def read(name, raw):
        path = tmp_path / name
        path.write_bytes(raw if isinstance(raw, bytes) else raw.encode())
        return read_mesh(path)

    return read


@pytest.mark.parametrize(
    'name, raw',
    [
        ('a.stl', binary_stl(SQUARE)),
        ('a.STL', text_stl(SQUARE)),
        ('a.obj', OBJ + 'f 1 2 3\nf 1 3 4\n'),
        ('quad.obj', OBJ + 'f 1 2 3 4\n'),
        ('slashes.obj', '# a comment\nvt 0 0\n' + OBJ + 's off\nf 1/1/1 2//3 3/1\nf -4 -2 -1\n'),
    ],
)
def test_a_square_is_read(read, name, raw):
    vertices, faces, notes = read(name, raw)
    np.testing.assert_array_equal(vertices[faces], SQUARE)
    assert len(vertices) == 4
    told = [f'{name}: 2 vertices equal to others were merged']
    assert notes == (told if name.lower().endswith('stl') else [])


@pytest.mark.parametrize('suffix', ['ply', 'glb', 'obj', 'stl'])
def test_what_trimesh_writes_is_read(suffix, tmp_path):
    trimesh = pytest.importorskip('trimesh')
    trimesh.Trimesh(CORNERS, TETRAHEDRON, process=False).export(tmp_path / f'a.{suffix}')
    vertices, faces, _ = read_mesh(tmp_path / f'a.{suffix}', up='z')
    found = np.sort(vertices[faces].sum(1), 0)
    np.testing.assert_allclose(found, np.sort(CORNERS[TETRAHEDRON].sum(1), 0), atol=1e-6)


def test_without_trimesh_the_way_to_it_is_told(read, monkeypatch):
    monkeypatch.setitem(sys.modules, 'trimesh', None)
    with pytest.raises(
        CourseError, match=r"a\.glb: needs trimesh: pip install 'golf_sim_ros\[mesh\]'"
    ):
        read('a.glb', 'glTF')


def test_faces_without_area_and_repeated_ones_are_dropped_and_told(read):
    line = [(0, 0, 0), (1, 1, 1), (2, 2, 2)]
    point = [(1, 0, 0)] * 3
    again = SQUARE[0][[2, 1, 0]]
    vertices, faces, notes = read('a.stl', binary_stl([*SQUARE, line, point, again]))
    np.testing.assert_array_equal(vertices[faces], SQUARE)
    assert [note.partition(': ')[2] for note in notes] == [
        '7 vertices equal to others were merged',
        '2 faces without area were dropped',
        '1 faces that come twice were dropped',
    ]


@pytest.mark.parametrize(
    'name, raw, said',
    [
        ('a.stl', b'', 'is empty'),
        ('a.stl', b'format: 1\nname: no mesh at all\n', 'is no STL file'),
        ('a.stl', b'solid but binary, or so it says' + b'\0' * 200, 'has no faces'),
        (
            'a.stl',
            binary_stl(SQUARE)[:-7],
            'is no STL file: 177 bytes do not hold the 2 triangles',
        ),
        ('a.stl', b'solid a\nvertex 1 2 three\n', 'is no STL file: a vertex is not three numbers'),
        ('a.stl', b'solid a\nvertex 1 2 3\n', 'is no STL file: 1 vertices make no triangles'),
        ('a.stl', binary_stl(SQUARE[:0]), 'has no faces'),
        ('a.stl', binary_stl(SQUARE * np.nan), 'a vertex is not finite'),
        ('a.stl', binary_stl(SQUARE * 1e7), 'more than 1e+06 m away'),
        ('a.stl', binary_stl(SQUARE * (1, 0, 0)), 'has no face with an area'),
        ('a.obj', OBJ, 'has no faces'),
        ('a.obj', OBJ + 'f 1 2 5\n', 'a face names a vertex that is none of the 4 there are'),
        ('a.obj', OBJ + 'f 0 1 2\n', 'a face names a vertex that is none of the 4 there are'),
        ('a.obj', OBJ + 'v nan 0 0\nf 1 2 3\n', 'a vertex is not finite'),
        ('a.obj', OBJ + 'f 1 2\n', 'is no OBJ file'),
        ('a.obj', OBJ + 'f 1 2 x\n', 'is no OBJ file'),
        ('a.obj', 'v 1 2\nf 1 1 1\n', 'is no OBJ file'),
        ('a.step', b'1', 'is no mesh; known: .glb, .gltf, .obj, .ply, .stl'),
    ],
)
def test_a_broken_file_is_refused_in_one_line(read, name, raw, said):
    with pytest.raises(CourseError) as caught:
        read(name, raw)
    assert f'{name}: ' in str(caught.value) and said in str(caught.value)
    assert str(caught.value).isprintable()


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(CourseError, match='cannot be read: No such file'):
        read_mesh(tmp_path / 'none.stl')


def test_a_closed_mesh_that_is_inside_out_is_turned():
    faces, notes = outward(CORNERS + 5, TETRAHEDRON[:, ::-1], 'a.stl')
    np.testing.assert_array_equal(faces, TETRAHEDRON)
    assert notes == ['a.stl: was inside out, so its faces were turned']
    assert outward(CORNERS + 5, TETRAHEDRON, 'a.stl')[1] == []
    assert outward(CORNERS, TETRAHEDRON[:3, ::-1], 'a.stl')[1] == []


@pytest.fixture
def course_file(tmp_path):
    """Write a course with a mesh over a plane; gives the course's path and the mesh's."""

    def write(corners, more=''):
        mesh = tmp_path / 'floor.stl'
        mesh.write_bytes(binary_stl(corners))
        path = tmp_path / 'links.yaml'
        path.write_text(
            'format: 1\nground:\n  - {shape: plane, material: rough}\n'
            f'  - {{shape: mesh, file: floor.stl, material: sand{more}}}\n'
        )
        return path

    return write


def test_a_course_has_a_mesh_from_beside_its_file_and_tells_what_was_put_right(
    course_file, monkeypatch
):
    monkeypatch.chdir('/')
    course = load_course(course_file(SQUARE))
    assert ground_height(course, 1, 2) == (1.0, 'sand')
    assert ground_height(course, -1, 2) == (0.0, 'rough')
    assert course.notes == ('floor.stl: 2 vertices equal to others were merged',)


def test_another_mesh_is_another_course(course_file):
    one = load_course(course_file(SQUARE)).digest
    assert load_course(course_file(SQUARE)).digest == one
    assert load_course(course_file(SQUARE + (0, 0, 1e-6))).digest != one


def test_a_one_sided_mesh_has_its_front_outside(course_file):
    course = load_course(course_file(CORNERS[TETRAHEDRON[:, ::-1]], ', one_sided: true'))
    assert course.ground[1].one_sided
    assert course.notes[-1] == 'floor.stl: was inside out, so its faces were turned'


def test_a_broken_mesh_is_named_with_its_place_in_the_course(course_file):
    with pytest.raises(
        CourseError, match=r'links\.yaml: ground\[1\]\.file .*floor\.stl: has no faces$'
    ):
        load_course(course_file(SQUARE[:0]))
