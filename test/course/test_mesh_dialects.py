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

"""Mesh files as programs write them: dialects, concave faces and holes, axes and units."""

import json
from math import cos, pi, sin
from pathlib import Path
import struct

from golf_sim_ros.course import load_course
from golf_sim_ros.course.mesh_file import read_mesh
from golf_sim_ros.course.schema import CourseError
from golf_sim_ros.course.stl_file import STL_TRIANGLE
from golf_sim_ros.physics import ground_height, Shot, simulate
from golf_sim_ros.physics.geometry.zone import places_inside
import numpy as np
import pytest

CASES = Path(__file__).parents[1] / 'data' / 'cases'
SQUARE = 'v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n'
L_SHAPE = [(0, 0), (10, 0), (10, 4), (4, 4), (4, 10), (0, 10)]
FRAME = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0), (3, 3), (3, 7), (7, 7), (7, 3), (3, 3)]
# fmt: off
TWO_HOLES = [
    (0, 0), (10, 0), (10, 10), (0, 10),
    (0, 0), (1, 1), (1, 4), (4, 4), (4, 1), (1, 1),
    (0, 0), (5, 1), (5, 4), (9, 4), (9, 1), (5, 1),
]
# fmt: on
STAR = [
    (r * cos(a), r * sin(a)) for k in range(10) for r, a in [((5.0, 2.0)[k % 2], 2 * pi * k / 10)]
]
COMB = [
    (0, 0),
    *((x, y) for k in range(40) for x, y in ((k, 8 - k % 2 * 7.5), (k + 1, 8 - k % 2 * 7.5))),
    (40, 0),
]
BOX = [(4, 4), (4, 0), (0, 0), (0, 4)]
SPIRAL = [(t * cos(t), t * sin(t)) for t in np.linspace(2, 20, 150).tolist()] + [
    ((t - 2) * cos(t), (t - 2) * sin(t)) for t in np.linspace(20, 2.5, 150).tolist()
]


@pytest.fixture
def read(tmp_path):
    """Write a file and read it."""

    def read(name, raw, *more):
        path = tmp_path / name
        path.write_bytes(raw if isinstance(raw, bytes) else raw.encode())
        return read_mesh(path, *more)

    return read


def area(vertices, faces):
    """Area [m^2] of all triangles together."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def shoelace(polygon):
    """Area [m^2] of a polygon, by Gauss's formula."""
    x, y = np.array(polygon, float).T
    return 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def obj_of(polygon, slope=(0.0, 0.0), first=0):
    """OBJ of one face, on a plane of a slope along x and y, its corners from the `first` on."""
    corners = [*polygon[first:], *polygon[:first]]
    lines = [f'v {x!r} {y!r} {slope[0] * x + slope[1] * y!r}' for x, y in corners]
    return '\n'.join([*lines, 'f ' + ' '.join(map(str, range(1, len(corners) + 1)))]) + '\n'


@pytest.mark.parametrize(
    'name, ground, told',
    [
        ('comment_face.obj', 100.0, 0),
        ('concave_L.obj', 64.0, 0),
        ('continued_crlf.obj', 100.0, 0),
        ('tabs.obj', 100.0, 0),
        ('trailing.stl', 100.0, 2),
        ('green_y_up.glb', 1601.6003, 1),
    ],
)
def test_every_case_has_its_area(name, ground, told):
    if name.endswith('glb'):
        pytest.importorskip('trimesh')
    vertices, faces, notes = read_mesh(CASES / name)
    assert area(vertices, faces) == pytest.approx(ground, rel=1e-6) and len(notes) == told


@pytest.mark.parametrize(
    'content',
    [
        SQUARE + 'f 1 2 3 4 # a comment\n',
        SQUARE + 'f 1/1 2/2 3/3 4/4# a comment',
        '# made by C:\\meshes\\\n' + SQUARE + 'f 1 2 3 4\n',
        SQUARE.replace('v ', ' \tv\t') + '  f\t1\t2\t3\t4\t\n',
        SQUARE.replace('\n', '\r\n') + 'f 1 2 3 \\\r\n4\r\n',
        SQUARE.replace('\n', '\r') + 'f 1 2 \\\r3 \\\r4',
        SQUARE + 'f 1 2 \\  \n  3 4\\',
        SQUARE.replace('10 10 0', '10 10 0 0.5 0.5 0.5') + 'f 1 2 3 4\n',
        SQUARE.replace('10 10 0', '10 10 0 1.0') + 'f 1 2 3 4\n',
        '\ufeff' + SQUARE + 'f 1 2 3 4\n',
        ('\ufeff' + SQUARE + 'f 1 2 3 4\n').encode('utf-16-le'),
        b'# gr\xfcn\no caf\xe9\n' + SQUARE.encode() + b'g \xff\nusemtl gr\xfcn\ns 1\nf 1 2 3 4\n',
        SQUARE + 'f -4 -3 -2 -1\nv 99 99 99\nv 98 98 98\n',
        SQUARE + 'vn 0 0 1\nvt 0 0\nl 1 2\np 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n',
        'v 1e1 +0 0\nv 10 1.e1 0\nv .0 10 -0\nv 0 0 0\nf 1 2 3 4\n',
    ],
)
def test_a_square_of_100_m2_is_one_in_every_dialect_of_obj(read, content):
    vertices, faces, notes = read('a.obj', content)
    assert area(vertices, faces) == 100.0 and notes == []


def test_negative_numbers_count_back_from_their_face(read):
    vertices, faces, _ = read(
        'a.obj', SQUARE + 'f -4 -3 -2 -1\nv 20 0 0\nv 30 0 0\nv 30 10 0\nf -3 -2 -1\n'
    )
    assert area(vertices, faces) == 150.0


def binary(corners, head=b'\0' * 80):
    """Binary STL."""
    rows = np.zeros(len(corners), STL_TRIANGLE)
    rows['corners'] = corners
    return head + len(corners).to_bytes(4, 'little') + rows.tobytes()


def text(name='solid a', facet='facet normal 0 0 1', vertex='vertex', end='\n', last='endsolid a'):
    """STL in text: a square of 16 m^2."""
    lines = [name]
    for corners in TWO:
        lines += [
            facet,
            ' outer loop',
            *(f'  {vertex} {x} {y} {z}' for x, y, z in corners),
            ' endloop',
            'endfacet',
        ]
    return end.join([*lines, last]) + end


TWO = [[(0, 0, 1), (4, 0, 1), (4, 4, 1)], [(0, 0, 1), (4, 4, 1), (0, 4, 1)]]


@pytest.mark.parametrize(
    'raw',
    [
        text(),
        text().upper(),
        text(end='\r\n'),
        text(end='\r'),
        text('solid'),
        text('solid é\tü # 1'),
        '\n \t' + text(),
        '\ufeff' + text(),
        '; exported\n' + text(),
        text('facet normal 0 0 1').replace('facet normal 0 0 1\n', '', 1),
        text('SOLID x', 'FACET NORMAL 0 0 1', 'VERTEX'),
        text(facet='facet'),
        text(vertex='vertex\t '),
        text() + text('solid b').replace(' 1\n', ' 2\n'),
        text(last=''),
        b'solid\xff\xfe' + text('').encode(),
        binary(TWO),
        binary(TWO, b'solid made by a program'.ljust(80)),
        binary(TWO, b'SOLID'.ljust(80, b'\0')),
        binary(TWO) + b'\0' * 11,
        binary(TWO) + b'trailing text',
        binary(TWO, b'solid'.ljust(80)) + b'\r\n',
    ],
)
def test_a_square_is_one_in_every_dialect_of_stl(read, raw):
    vertices, faces, _ = read('a.stl', raw)
    flat = vertices[faces][(vertices[faces][..., 2] == 1.0).all(1)]
    assert area(flat.reshape(-1, 3), np.arange(len(flat) * 3).reshape(-1, 3)) == 16.0


PLY_HEAD = (
    'ply\nformat {order} 1.0\ncomment a comment\nobj_info x\nelement vertex 6\nproperty {real} x\n'
    'property {real} y\nproperty {real} z\nproperty uchar red\nelement face 1\n'
    'property list {size} {whole} {name}\nproperty uchar flags\nend_header\n'
)


@pytest.mark.parametrize(
    'numbers, face',
    [
        (('ascii', '', 'float'), ('uchar', 'int', 'vertex_indices')),
        (('ascii', '', 'double'), ('uint8', 'uint', 'vertex_index')),
        (('binary_little_endian', '<', 'float'), ('uchar', 'int', 'vertex_indices')),
        (('binary_big_endian', '>', 'float64'), ('uint', 'ushort', 'vertex_index')),
        (('binary_little_endian', '<', 'float32'), ('int', 'uint32', 'vertex_indices')),
    ],
)
@pytest.mark.parametrize('lines', ['\n', '\r\n'])
def test_a_concave_face_of_64_m2_is_one_in_every_dialect_of_ply(read, numbers, face, lines):
    (order, end, real), (size, whole, name) = numbers, face
    head = PLY_HEAD.format(order=order, real=real, size=size, whole=whole, name=name)
    head = head.replace('\n', lines).encode()
    letters = {
        'float': 'f',
        'float32': 'f',
        'double': 'd',
        'float64': 'd',
        'uchar': 'B',
        'uint8': 'B',
        'int': 'i',
        'uint': 'I',
        'uint32': 'I',
        'ushort': 'H',
    }
    if end:
        body = b''.join(struct.pack(f'{end}3{letters[real]}B', x, y, 0, 255) for x, y in L_SHAPE)
        body += struct.pack(f'{end}{letters[size]}6{letters[whole]}B', 6, *range(6), 0)
    else:
        body = lines.join([*(f'{x} {y} 0 255' for x, y in L_SHAPE), '6 0 1 2 3 4 5 0']).encode()
    vertices, faces, notes = read('a.ply', head + body)
    assert area(vertices, faces) == 64.0 and notes == []


def test_strips_of_ply_are_triangles(read):
    strip = (
        'ply\nformat ascii 1.0\nelement vertex 6\n'
        'property float x\nproperty float y\nproperty float z\n'
        'element tristrips 1\nproperty list int int vertex_indices\nend_header\n'
        '0 0 0\n4 0 0\n0 4 0\n4 4 0\n0 8 0\n4 8 0\n11 0 1 2 3 -1 2 3 4 5 -1 -1\n'
    )
    vertices, faces, _ = read('a.ply', strip)
    assert area(vertices, faces) == 32.0
    corners = vertices[faces]
    assert (np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0).all()


@pytest.mark.parametrize(
    'polygon, ground',
    [
        (L_SHAPE, 64.0),
        (FRAME, 84.0),
        (TWO_HOLES, 100 - 9 - 12.0),
        (STAR, shoelace(STAR)),
        (COMB, shoelace(COMB)),
        (SPIRAL, shoelace(SPIRAL)),
        (BOX, 16.0),
        ([*BOX[:1], (4, 2), *BOX[1:], (2, 4)], 16.0),
    ],
)
@pytest.mark.parametrize('slope', [(0.0, 0.0), (0.3, -0.2)])
def test_a_face_with_corners_anywhere_covers_what_it_encloses_and_no_more(
    read, polygon, ground, slope
):
    x, y = np.random.default_rng(5).uniform(-22, 22, (2, 500))
    enclosed = places_inside(tuple(polygon), x, y)
    for first in range(0, len(polygon), max(1, len(polygon) // 7)):
        for corners in (polygon, polygon[::-1]):
            vertices, faces, _ = read('a.obj', obj_of(corners, slope, first))
            assert area(vertices, faces) == pytest.approx(
                ground * np.hypot(1.0, np.hypot(*slope)), rel=1e-12
            )
            triangles = vertices[faces][:, :, :2]
            assert (
                np.sum([places_inside(tuple(map(tuple, t)), x, y) for t in triangles], 0)
                == enclosed
            ).all()


def test_a_concave_face_is_ground_where_it_is_and_at_its_height(tmp_path):
    (tmp_path / 'floor.obj').write_text(obj_of(FRAME, (0.1, -0.05)))
    (tmp_path / 'links.yaml').write_text(
        'format: 1\ntee: [1, 1]\nground: [{shape: mesh, file: floor.obj, material: green}]\n'
    )
    course = load_course(tmp_path / 'links.yaml')
    for x, y in np.random.default_rng(3).uniform(0.01, 9.99, (300, 2)):
        found = ground_height(course, x, y)
        if 3 < x < 7 and 3 < y < 7:
            assert found is None
        else:
            assert found[0] == pytest.approx(0.1 * x - 0.05 * y, abs=1e-12)


def test_a_face_that_crosses_itself_is_left_out_and_told(read):
    _, faces, notes = read('a.obj', SQUARE + 'f 1 2 3 4\nf 1 3 2 4\n')
    assert len(faces) == 2 and notes == [
        'a.obj: the face in line 6 crosses itself and was left out'
    ]


def test_large_faces_are_covered(read):
    round_about = [
        (
            (50 + 10 * (k % 2)) * cos(2 * pi * k / 3000),
            (50 + 10 * (k % 2)) * sin(2 * pi * k / 3000),
        )
        for k in range(3000)
    ]
    vertices, faces, _ = read('a.obj', obj_of(round_about))
    assert area(vertices, faces) == pytest.approx(shoelace(round_about), rel=1e-9)


@pytest.mark.parametrize(
    'name, raw, said',
    [
        (
            'a.obj',
            SQUARE + 'f 1 2 x\n',
            "a.obj: is no OBJ file that can be read: line 5 'f 1 2 x': ",
        ),
        (
            'a.obj',
            SQUARE + 'f 1 2 \\\n 3 9\n',
            'a.obj: line 5: a face names a vertex that is none of the 4 there are',
        ),
        (
            'a.ply',
            b'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n1 2 3\n',
            "'y' is missing",
        ),
        ('a.ply', b'ply\nformat utf 1.0\nend_header\n', "'utf' is missing or unknown"),
        ('a.ply', b'ply\nend_header\n', 'tells of no format'),
        ('a.ply', b'plo', 'is no PLY file'),
        (
            'a.ply',
            PLY_HEAD.format(
                order='ascii', real='float', size='int', whole='int', name='vertex_index'
            )
            + 6 * '0 0 0 0\n'
            + '6 0 1 2 3 4\n',
            'it ends too soon',
        ),
        (
            'a.ply',
            PLY_HEAD.format(
                order='ascii', real='float', size='int', whole='int', name='vertex_index'
            )
            + 6 * '0 0 0 0\n'
            + '4 0 1 2 7 0\n',
            'face 0: [0, 1, 2, 7] must be 3 or more numbers of the 6 vertices',
        ),
        ('a.glb', b'glTF\2\0\0\0', 'is no glTF file'),
        ('a.gltf', '{"meshes": [{}]}', 'is no glTF file that can be read'),
        (
            'a.gltf',
            '{"extensionsUsed": ["KHR_draco_mesh_compression"]}',
            'is compressed with Draco: export it without',
        ),
        *[
            (
                name,
                b'version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n',
                'is a Git LFS pointer',
            )
            for name in ('a.obj', 'a.stl', 'a.ply', 'a.glb')
        ],
    ],
)
def test_what_cannot_be_read_is_told_in_one_line(read, name, raw, said):
    pytest.importorskip('trimesh')
    with pytest.raises(CourseError) as caught:
        read(name, raw)
    assert said in str(caught.value) and str(caught.value).isprintable()


def write_course(folder, mesh):
    """Write a course of one mesh, with its entries of the course file."""
    path = folder / 'links.yaml'
    path.write_text(
        'format: 1\ntee: [0, 0]\nhole: [10, 0]\nground:\n'
        f'  - {{shape: mesh, material: green, {mesh}}}\n'
    )
    return path


def hills(x, y):
    """Heights of a green."""
    return 0.3 * np.sin(0.2 * x) + 0.02 * y


def obj_of_hills(corner):
    """OBJ of a green of 40 x 30 m; `corner` makes of x, y, z what is written."""
    x, y = np.meshgrid(np.arange(-10, 31.0), np.arange(-15, 16.0))
    rows = np.float32(np.stack((x, y, hills(x, y)), -1)).astype(float)
    lines = ['v {!r} {!r} {!r}'.format(*corner(*map(float, row))) for row in rows.reshape(-1, 3)]
    for i in range(30):
        for k in range(40):
            a = 1 + i * 41 + k
            lines.append(f'f {a} {a + 1} {a + 42} {a + 41}')
    return '\n'.join(lines)


def test_a_green_plays_the_same_from_gltf_and_from_obj_with_y_or_z_up_and_in_centimetres(tmp_path):
    trimesh = pytest.importorskip('trimesh')
    (tmp_path / 'z.obj').write_text(obj_of_hills(lambda x, y, z: (x, y, z)))
    (tmp_path / 'y.obj').write_text(obj_of_hills(lambda x, y, z: (x, z, -y)))
    (tmp_path / 'cm.obj').write_text(obj_of_hills(lambda x, y, z: (100 * x, 100 * y, 100 * z)))
    vertices, faces, _ = read_mesh(tmp_path / 'z.obj')
    scene = trimesh.Scene()
    x, y, z = vertices.T
    # several materials are several meshes
    for part, (low, high) in enumerate(((0, 1000), (1000, 2400))):
        moved = trimesh.Trimesh(np.stack((x - 5, z, -y), 1), faces[low:high], process=False)
        scene.add_geometry(
            moved,
            transform=trimesh.transformations.translation_matrix((5, 0, 0)),
            node_name=str(part),
        )
    (tmp_path / 'y.glb').write_bytes(scene.export(file_type='glb'))
    ways = ('file: z.obj', 'file: y.obj, up: y', 'file: y.glb', 'file: cm.obj, scale: 0.01')
    courses = [load_course(write_course(tmp_path, way)) for way in ways]
    for x, y in np.random.default_rng(2).uniform((-9, -14), (29, 14), (100, 2)):
        z = [ground_height(course, x, y)[0] for course in courses]
        assert np.ptp(z) < 1e-6 and z[0] == pytest.approx(hills(x, y), abs=0.02)
    ends = [
        simulate(course, Shot((3.0, 0.2, 2.0), (0.0, -50.0, 0.0))).result.position
        for course in courses
    ]
    assert np.ptp(ends, 0).max() < 1e-6
    assert 'y is up in glTF' in courses[2].notes[0] and not any(
        courses[k].notes for k in (0, 1, 3)
    )


def test_a_gltf_file_of_several_files_is_read_and_each_counts(tmp_path):
    pytest.importorskip('trimesh')
    corners = np.array([(0, 0, 0), (10, 0, 0), (10, 1, -10)], '<f4')
    (tmp_path / 'a b.bin').write_bytes(corners.tobytes())
    (tmp_path / 'a.gltf').write_text(
        json.dumps(
            {
                'asset': {'version': '2.0'},
                'scene': 0,
                'scenes': [{'nodes': [0]}],
                'nodes': [{'mesh': 0}],
                'meshes': [{'primitives': [{'attributes': {'POSITION': 0}}]}],
                'accessors': [
                    {'bufferView': 0, 'componentType': 5126, 'count': 3, 'type': 'VEC3'}
                ],
                'bufferViews': [{'buffer': 0, 'byteLength': 36}],
                'buffers': [{'byteLength': 36, 'uri': 'a%20b.bin'}],
            }
        )
    )
    path = tmp_path / 'links.yaml'
    path.write_text(
        'format: 1\ntee: [5, 1]\nground: [{shape: mesh, material: green, file: a.gltf}]'
    )
    course = load_course(path)
    assert ground_height(course, 10.0, 5.0)[0] == pytest.approx(0.5)
    (tmp_path / 'a b.bin').write_bytes((corners * 2).tobytes())
    assert load_course(path).digest != course.digest


def test_a_mesh_on_its_side_or_elsewhere_is_told(tmp_path):
    (tmp_path / 'y.obj').write_text(obj_of_hills(lambda x, y, z: (x, z, -y)))
    course = write_course(tmp_path, 'file: y.obj')
    with pytest.raises(
        CourseError,
        match=r'hole \(10, 0\) must have ground all round.*; y.obj reaches x -10 to 30',
    ):
        load_course(course)
    course.write_text(course.read_text().replace('0]', '5]'))
    with pytest.raises(
        CourseError,
        match=r'tee \[0.0, 5.0\] must be above some ground, and .*; y.obj reaches x -10',
    ):
        load_course(course)
    course.write_text(
        course.read_text() + '  - {shape: plane, material: rough, point: [0, 0, -30]}\n'
    )
    notes = load_course(course).notes
    assert 'y.obj: is 30 m high' in notes[0] and 'say `up: y`' in notes[0]
    assert [note.partition(', [')[0] for note in notes[1:]] == [
        'y.obj: has no ground where the tee is',
        'y.obj: has no ground where the hole is',
    ]


@pytest.mark.parametrize(
    'entry, said',
    [
        ('up: x', "ground[0].up 'x' is unknown; known: y, z"),
        ('scale: 0', 'ground[0].scale 0 must be a number from'),
        ('scale: cm', "ground[0].scale 'cm' must be a number"),
    ],
)
def test_a_wrong_axis_or_scale_is_named(tmp_path, entry, said):
    (tmp_path / 'a.obj').write_text(SQUARE + 'f 1 2 3 4\n')
    with pytest.raises(CourseError) as caught:
        load_course(write_course(tmp_path, f'file: a.obj, {entry}'))
    assert said in str(caught.value)
