# SPDX-License-Identifier: Apache-2.0
"""Courses from YAML files: read, checked, and made into the records that the physics plays on."""
from hashlib import sha256
import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from . import physics
from .checked import (CourseError, direction, fields, flag, list_of, mapping, number, one_of, polygon,
                      record, refused, shown, tagged, text, unknown, vector)
from .height_file import heights_in
from .materials import materials, shipped
from .mesh_file import outward, read_mesh
from .physics.air import Air, density, standard_atmosphere
from .physics.course import Ball, Course
from .physics.effects.wind import LogProfile, PowerProfile, UniformProfile
from .physics.ground.heightmap import Heightmap
from .physics.ground.mesh import Mesh
from .physics.ground.patch import Patch
from .physics.ground.plane import Plane
from .physics.ground.solid import Cylinder, Sphere
from .physics.ground.water import Water
from .share import share
from .yaml_file import read_yaml

__all__ = ['CourseError', 'load_course', 'shipped_courses']

FORMAT = 1

PROFILES = {
    'log': record(LogProfile, {'roughness': number(1e-6, 10)}),
    'power': record(PowerProfile, {'exponent': number(0, 2)}),
    'uniform': record(UniformProfile, {}),
}
WEATHER = record(Air, {'temperature': number(150, 400), 'pressure': number(0, 1e7),
                       'relative_humidity': number(0, 1)})
ALTITUDE = fields({'altitude': number(-1000, 11000)})
BALL = record(Ball, {'mass': number(1e-6, 1000), 'radius': number(1e-3, 1), 'inertia': number(0.01, 1),
                     'restitution': number(0, 1), 'friction': number(0)})

WATER = record(Water, {'polygon': polygon, 'level': number()}, ('polygon', 'level'))


def load_course(name_or_path):
    """A course, ready to be played.

    Parameters
    ----------
    name_or_path : str or path
        Name of a shipped course, or the path of a course file.

    Returns
    -------
    golf_sim_ros.physics.course.Course

    Raises
    ------
    CourseError
        One line: file, key, value and what is allowed.
    """
    path = course_file(name_or_path)
    raw, content = read_yaml(path)
    base, sources = shipped()
    opened = {}
    try:
        course = course_of(content, base, path.parent, sources, opened)
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None
    return course._replace(name=course.name or path.stem, path=str(path),
                           digest=digest(raw, sources, opened),
                           notes=tuple(note for file in opened.values() for note in file.notes))


def shipped_courses():
    """Paths of the courses that come with the package, by name."""
    return {path.stem: path for path in sorted(share('config', 'courses').glob('*.yaml'))}


def course_file(name_or_path):
    """Path of a course: of a shipped one by its name, else whatever file is meant."""
    known = shipped_courses()
    if name_or_path in known:
        return known[name_or_path]
    name = os.fspath(name_or_path)
    path = Path(name).expanduser()
    if path.suffix not in ('.yaml', '.yml') and not path.is_file():
        raise CourseError(f'{unknown("course", name, known)}; or give the path of a course file (.yaml)')
    return path


def digest(raw, sources, opened):
    """SHA-256 over the bytes of the course file and of all it calls for, in the order of their names."""
    total = sha256(sha256(raw).digest())
    for name in sorted(sources):
        total.update(name.encode() + b'\0' + sha256(sources[name]).digest())
    for name in sorted(opened):
        total.update(name.encode() + b'\0' + opened[name].digest)
    return total.hexdigest()


def course_of(content, base, folder, sources, opened):
    """`Course` of a file's `content`; `base` holds the entries of the shipped materials.

    What the file calls for is looked for from `folder` on; bytes of height maps are put into `sources`,
    meshes into `opened`, by the names that the file gives them.
    """
    known = materials(mapping(content, '').get('materials', {}), base)
    shape = shape_of(known, heights_in(folder, sources), mesh_of(known, folder, opened))
    read = fields({
        'format': format_number, 'name': text, 'tee': vector(2), 'hole': vector(2), 'flagstick': flag,
        'bounds': polygon, 'air': air, 'wind_profile': tagged('law', PROFILES), 'effects': effects,
        'ball': BALL, 'materials': mapping, 'wind_field': to_come,
        'water': list_of(WATER, 'a list of ponds, as in [{polygon: [[x, y], ...], level: z}]'),
        'zones': list_of(zone_of(known), 'a list of zones'),
        'obstacles': list_of(obstacle_of(known), 'a list of obstacles'),
        'ground': list_of(shape, 'a list of one or more shapes', 1),
    }, needed=('format', 'ground'))
    found = read(content, '')
    course = Course(cup=known['cup'], stick=known['flagstick'],
                    **{name: value for name, value in found.items() if name in Course._fields})
    for key in ('tee', 'hole'):
        on_ground(course, key)
    if course.hole is not None:
        even_around_hole(course)
    free_at_tee(course)
    return course


def on_ground(course, key):
    """Refuse a course with a tee or hole that has no ground under it."""
    place = getattr(course, key)
    if place is not None and physics.ground_height(course, *place) is None:
        raise refused(key, list(place), 'above some ground, and there is none')


def free_at_tee(course):
    """Refuse a course on whose tee no ball can lie."""
    try:
        physics.check_tee(course)
    except physics.NoPlace as error:
        raise CourseError(str(error)) from None


def even_around_hole(course):
    """Refuse a course whose hole has no ground all round, or ground that is too uneven."""
    try:
        physics.check_hole(course)
    except ValueError as error:
        raise CourseError(str(error)) from None


def format_number(value, key):
    """The number of the schema."""
    if type(value) is not int or value != FORMAT:
        raise refused(key, value, f'{FORMAT}')
    return value


class MeshFile(NamedTuple):
    """A mesh file as read: triangles, what was put right in it, SHA-256 of its bytes."""

    vertices: np.ndarray
    faces: np.ndarray
    notes: tuple
    digest: bytes


def mesh_of(known, folder, opened):
    """Checker of a mesh; see `course_of`."""
    read = fields({'file': text, 'material': one_of(known), 'one_sided': flag}, ('file', 'material'))

    def check(value, key):
        entry = read(value, key)
        name, one_sided = entry['file'], entry.get('one_sided', False)
        path = folder / Path(name).expanduser()
        try:
            if name not in opened:
                vertices, faces, notes = read_mesh(path)
                opened[name] = MeshFile(vertices, faces, tuple(notes), sha256(path.read_bytes()).digest())
        except CourseError as error:
            raise CourseError(f'{key}.file {error}') from None
        file = opened[name]
        faces = file.faces
        if one_sided:
            faces, notes = outward(file.vertices, faces, path.name)
            opened[name] = file._replace(notes=tuple(dict.fromkeys((*file.notes, *notes))))
        return Mesh(file.vertices, faces, entry['material'], one_sided)
    return check


def shape_of(known, heights, mesh):
    """Checker of an entry of ``ground``; `known`: materials by name; `heights`, `mesh` read files."""
    cuts = list_of(polygon, 'a list of polygons, each a list of corners [x, y]')
    common = {'normal': direction, 'material': one_of(known), 'cut': cuts}
    size = number(1e-3)
    shapes = {
        'plane': record(Plane, {**common, 'point': vector(3)}, ('material',)),
        'patch': record(Patch, {**common, 'center': vector(3), 'heading': number(), 'length': size,
                                'width': size, 'one_sided': flag},
                        ('center', 'length', 'width', 'material')),
        'heightmap': record(Heightmap, {'heights': heights, 'origin': vector(2), 'spacing': size,
                                        'material': one_of(known)},
                            ('heights', 'spacing', 'material')),
        'mesh': mesh,
    }

    def check(value, key):
        shape = tagged('shape', shapes)(value, key)
        if getattr(shape, 'cut', ()) and abs(shape.normal[2]) < 1e-3:
            raise refused(f'{key}.cut', value['cut'], 'left out: seen from above, this shape is a line')
        return shape
    return check


def obstacle_of(known):
    """Checker of an entry of ``obstacles``; `known` holds the materials by name."""
    common = {'material': one_of(known), 'radius': number(1e-3)}
    shapes = {
        'cylinder': record(Cylinder, {**common, 'base': vector(3), 'height': number(1e-3)},
                           ('base', 'radius', 'height', 'material')),
        'sphere': record(Sphere, {**common, 'center': vector(3)}, ('center', 'radius', 'material')),
    }
    return tagged('shape', shapes)


def zone_of(known):
    """Checker of an entry of ``zones``; returns its material and its polygon."""
    read = fields({'material': one_of(known), 'polygon': polygon}, ('material', 'polygon'))

    def check(value, key):
        found = read(value, key)
        return found['material'], found['polygon']
    return check


def air(value, key):
    """Weather, or an altitude in the standard atmosphere."""
    if 'altitude' in mapping(value, key):
        return standard_atmosphere(**ALTITUDE(value, key))
    weather = WEATHER(value, key)
    if density(weather) < 0:
        raise refused(f'{key}.pressure', weather.pressure, 'more than that of the vapour in the air')
    return weather


def effects(value, key):
    """'auto', or names of effects; returns 'auto' or a tuple."""
    if value in ('auto', ['auto']):
        return 'auto'
    names = {name: name for name in physics.EFFECTS}
    return list_of(one_of(names), 'auto, or a list of: ' + ', '.join(sorted(names)))(value, key)


def to_come(value, key):
    """What the schema knows and the physics does not yet; nothing of it is fine."""
    if value != []:
        raise CourseError(f'{key} {shown(value)} is not yet supported; leave it out')
    return ()
