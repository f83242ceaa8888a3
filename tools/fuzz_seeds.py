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

"""The sound files that fuzz_files.py mutates, and how each kind is read."""

from io import BytesIO
from pathlib import Path
import sys

from fuzz_mutations import bytes_mutated, junk, structure_mutated, words_mutated, YAML_TOKENS
from golf_sim_ros.course import CourseError, load_course, load_round
from golf_sim_ros.course.heightmap_file import heightmap_of
from golf_sim_ros.course.mesh_file import read_mesh
from golf_sim_ros.course.package_files import share
from golf_sim_ros.physics import Material
import numpy as np
import yaml

TEST = Path(__file__).resolve().parents[1] / 'test'
WHOLE = """
format: 1
name: whole
tee: [0, 0]
hole: [15, 3]
flagstick: true
bounds: [[-20, -40], [200, -40], [200, 40]]
air: {temperature: 298.15, pressure: 101325, relative_humidity: 0.5}
wind_profile: {law: log, roughness: 0.01}
effects: [gravity, drag]
materials:
  new: {like: green, stimp: 12, restitution: {law: quadratic, e0: 0.5, floor: 0.1}, color: [0, 1, 0]}
  leaf: {like: leaves, drag: 0.3}
ball: {mass: 0.05, radius: 0.02, inertia: 0.4, restitution: 0.8, friction: 0.2}
ground:
  - {shape: plane, normal: [0, 0, 1], material: rough, cut: [[[9, 1], [11, 1], [10, 2]]]}
  - {shape: patch, center: [0, 0, 0], length: 3, width: 3, material: new, heading: 0.1, one_sided: false}
  - {shape: mesh, file: a.obj, material: sand, up: z, scale: 0.5}
  - {shape: mesh, file: b.stl, material: sand, one_sided: true}
  - {shape: heightmap, heights: a.npy, origin: [40, 0], spacing: 2, material: fairway, fill: true}
  - {shape: heightmap, heights: a.asc, subtract: [500000, 5300000, 1], unit: feet, material: fairway}
zones:
  - {material: green, polygon: [[12, 0], [18, 0], [18, 6], [12, 6]], cut: [[[13, 1], [14, 1], [14, 2]]]}
obstacles:
  - {shape: cylinder, base: [60, 12, 0], radius: 0.3, height: 8, material: wood}
  - {shape: sphere, center: [60, 12, 9], radius: 2.5, material: leaf}
water:
  - {polygon: [[90, 10], [120, 10], [120, 40]], level: -0.2, cut: [[[100, 12], [101, 12], [101, 13]]]}
"""  # noqa: E501
OBJ = b"""# a mesh
v 0 0 0
v 10 0 0.5 1 0 0
v 10 4 0
v 4 4 0
v 4 10 1
v 0 10 0
vt 0 0
vn 0 0 1
f 1/1/1 2/1/1 3//1 4 5 \\
6
f -6 -5 -4
f 4 5 6 1 # more
"""
HEAD = b'ncols 4\nnrows 3\nxllcorner 500000\nyllcorner 5300000\ncellsize 2\nNODATA_value -9999\n'
ASC = HEAD + b'1 2 3 4\n' * 3


def readers(folder):
    """For each kind: a function of a random generator and a folder that makes a case.

    It returns a function that reads the case, and the exceptions with which it may refuse it.
    """
    return {
        'courses': courses(),
        'meshes': meshes(),
        'arrays': arrays(),
        'bags': Later(lambda: bags(folder)),
    }


class Later:
    """A maker of cases that is made when the first is wanted."""

    def __init__(self, make):
        self.make, self.made = make, None

    def __call__(self, rng, place):
        self.made = self.made or self.make()
        return self.made(rng, place)


def courses():
    """Mutated course files, and rounds."""
    texts = [
        WHOLE.encode(),
        WHOLE.encode(),
        b'format: 1\nround: [putting_green, case.yaml, links]\n',
    ]
    texts += [path.read_bytes() for path in sorted(share('config', 'courses').glob('*.yaml'))]
    beside = [
        path for path in share('config', 'courses').iterdir() if path.suffix in ('.npy', '.stl')
    ]
    own = {'a.obj': OBJ, 'b.stl': stl(True), 'a.npy': npy(np.zeros((3, 4))), 'a.asc': ASC}
    trees = [yaml.safe_load(text) for text in texts]

    def make(rng, place):
        for file in beside:
            (place / file.name).symlink_to(file)
        for name, raw in own.items():
            (place / name).write_bytes(raw)
        number = rng.randrange(len(texts))
        raw = texts[number]
        if rng.random() < 0.6:
            raw = yaml.safe_dump(
                structure_mutated(rng, trees[number]), allow_unicode=True
            ).encode()
        if rng.random() < 0.5 or raw == texts[number]:
            raw = bytes_mutated(rng, raw, YAML_TOKENS)
        path = place / 'case.yaml'
        path.write_bytes(raw)
        return lambda: (load_round if b'round' in raw else load_course)(path), CourseError

    return make


def stl(binary):
    """Make a tetrahedron as STL."""
    corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], '<f4')
    faces = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    if binary:
        rows = b''.join(b'\0' * 12 + corners[face].tobytes() + b'\0\0' for face in faces)
        return b'\0' * 80 + len(faces).to_bytes(4, 'little') + rows
    facets = ''.join(
        'facet normal 0 0 1\nouter loop\n'
        + ''.join('vertex {} {} {}\n'.format(*corners[k]) for k in face)
        + 'endloop\nendfacet\n'
        for face in faces
    )
    return f'solid a\n{facets}endsolid a\n'.encode()


def ply(form):
    """Make a concave face and a triangle as PLY."""
    head = (
        f'ply\nformat {form} 1.0\nelement vertex 6\n'
        'property float x\nproperty float y\nproperty float z\n'
        'element face 2\nproperty list uchar int vertex_indices\nend_header\n'
    ).encode()
    corners = np.array([(0, 0, 0), (10, 0, 0), (10, 4, 0), (4, 4, 0), (4, 10, 0), (0, 10, 0)])
    faces = [(0, 1, 2, 3, 4, 5), (0, 1, 2)]
    if form == 'ascii':
        rows = [' '.join(map(str, row)) for row in corners.tolist()]
        return (
            head
            + '\n'.join(
                [*rows, *(' '.join(map(str, (len(face), *face))) for face in faces)]
            ).encode()
        )
    order = '<' if 'little' in form else '>'
    return (
        head
        + corners.astype(order + 'f4').tobytes()
        + b''.join(bytes([len(face)]) + np.array(face, order + 'i4').tobytes() for face in faces)
    )


def glb():
    """Make a part of a scene as GLB."""
    import trimesh

    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box((10, 1, 8)), node_name='a')
    scene.add_geometry(trimesh.creation.icosphere(1), node_name='b', parent_node_name='a')
    return scene.export(file_type='glb')


def meshes():
    """Mutated mesh files."""
    seeds = [
        ('obj', OBJ),
        ('obj', OBJ),
        ('stl', stl(True)),
        ('stl', stl(False)),
        ('ply', ply('ascii')),
        ('ply', ply('binary_little_endian')),
        ('ply', ply('binary_big_endian')),
    ]
    try:
        seeds += [('glb', glb())] * 2
    except ImportError:
        print('meshes: without glTF, which needs trimesh', file=sys.stderr)

    def make(rng, place):
        suffix, raw = rng.choice(seeds)
        raw = (
            words_mutated(rng, raw)
            if suffix == 'obj' and rng.random() < 0.5
            else bytes_mutated(rng, raw)
        )
        path = place / f'case.{suffix}'
        path.write_bytes(raw)
        up, scale = rng.choice((None, 'y', 'z')), rng.choice((1.0, 0.01, 1e6))
        return lambda: read_mesh(path, up, scale), CourseError

    return make


def npy(heights):
    """Make an array as .npy."""
    file = BytesIO()
    np.save(file, heights)
    return file.getvalue()


def tif(**more):
    """Heights as GeoTIFF, in UTM."""
    import rasterio

    heights = np.arange(12, dtype='float32').reshape(3, 4)
    way = rasterio.Affine(2.0, 0.0, 500000.0, 0.0, -2.0, 5300006.0)
    with rasterio.MemoryFile() as memory:
        with memory.open(
            driver='GTiff',
            height=3,
            width=4,
            count=1,
            dtype='float32',
            transform=way,
            crs='EPSG:32633',
            nodata=-9999.0,
            **more,
        ) as file:
            file.write(heights, 1)
        return bytes(memory.getbuffer())


def arrays():
    """Mutated height maps."""
    rng = np.random.default_rng(1)
    seeds = [
        ('npy', npy(rng.random((9, 8)))),
        ('npy', npy(np.where(rng.random((20, 30)) < 0.2, np.nan, 1.0))),
        ('npy', npy(np.full((4, 4), -9999, 'int16'))),
        ('npy', npy(np.asfortranarray(rng.random((5, 6))))),
        ('asc', ASC),
        ('asc', ASC),
    ]
    try:
        seeds += [
            ('tif', tif()),
            ('tif', tif(compress='deflate', predictor=3)),
            ('tif', tif(compress='lzw')),
        ]
    except ImportError:
        print('arrays: without GeoTIFF, which needs rasterio', file=sys.stderr)

    def make(rng, place):
        suffix, raw = rng.choice(seeds)
        path = place / f'case.{suffix}'
        path.write_bytes(
            bytes_mutated(rng, raw)
            if suffix != 'asc' or rng.random() < 0.5
            else words_mutated(rng, raw)
        )
        entry = {'heights': path.name, 'material': 'rough'}
        if suffix == 'npy' or rng.random() < 0.1:
            entry['spacing'] = 2
        for name, value in (
            ('fill', True),
            ('subtract', [500000, 5300000]),
            ('origin', [1, 2]),
            ('unit', 'feet'),
            ('no_data', 3),
            ('height_unit', 'us_feet'),
        ):
            if rng.random() < (0.7 if name == 'subtract' and suffix != 'npy' else 0.3):
                entry[name] = value if rng.random() < 0.95 else junk(rng)
        check = heightmap_of({'rough': Material()}, place, {}, [])
        return lambda: check(entry, 'ground[0]'), CourseError

    return make


def bags(folder):
    """Mutated bags of a short play, in both storages: in the file, or in the metadata."""
    sys.path.insert(0, str(TEST))
    from golf_sim_ros.recording.bag import BagError, read_bag
    from recorded_play import bag, Sim

    told = Sim().play([(3, 'strike', ('red', (2.0, 0.1, 0.0), (0.0, 0.0, 0.0)))], 400)
    seeds = [
        [(file.name, file.read_bytes()) for file in bag(folder / storage, told, storage).iterdir()]
        for storage in ('mcap', 'sqlite3')
    ]

    def make(rng, place):
        files = dict(rng.choice(seeds))
        name = rng.choice(
            [name for name in files if rng.random() < 0.3 or not name.endswith('.yaml')]
            or list(files)
        )
        files[name] = bytes_mutated(
            rng, files[name], YAML_TOKENS if name.endswith('.yaml') else TOKENS_OF_BAGS
        )
        for name, raw in files.items():
            (place / name).write_bytes(raw)
        alone = [name for name in files if not name.endswith('.yaml')]
        path = place / alone[0] if rng.random() < 0.3 else place
        return lambda: read_bag(path), BagError

    return make


TOKENS_OF_BAGS = [
    b'\0' * 8,
    b'\xff' * 8,
    b'ros2msg',
    b'"crc32"',
    b'\x89MCAP0\r\n',
    b'\x05',
    b'\x06',
    b'NaN',
    b'{}',
    b'[]',
]
