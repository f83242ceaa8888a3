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

"""Courses from YAML files: read, checked, and made into the records that the physics plays on."""

from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
import os
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .heightmap_file import heightmap_of
from .input_file import beside, is_there
from .input_file import content as bytes_of
from .material_file import materials, shipped
from .mesh_file import outward, read_mesh
from .package_files import share
from .plausibility import files_reach, looker, misplaced
from .schema import (
    Checker,
    CourseError,
    direction,
    fields,
    flag,
    list_of,
    mapping,
    number,
    one_of,
    polygon,
    record,
    refused,
    tagged,
    text,
    unknown,
    vector,
)
from .yaml_file import read_yaml, uncollected
from .. import physics
from ..physics.effects.wind import LogProfile, PowerProfile, UniformProfile
from ..physics.geometry.mesh import Mesh
from ..physics.geometry.patch import Patch
from ..physics.geometry.plane import Plane
from ..physics.geometry.solid import Cylinder, Sphere
from ..physics.geometry.water_surface import Water
from ..physics.geometry.zone import Zone
from ..physics.properties.air import Air, density, standard_atmosphere
from ..physics.properties.material import Material
from ..physics.scene.course_record import Ball, Course
from ..wind import FieldError, WindField

__all__ = ['CourseError', 'load_course', 'load_round', 'shipped_courses']


class MeshFile(NamedTuple):
    """A mesh file as read: triangles, notes on what was repaired, SHA-256 of its bytes."""

    vertices: np.ndarray
    faces: np.ndarray
    notes: tuple[str, ...]
    digest: bytes


Opened = dict[tuple[str, str | None, float], MeshFile]  # by name in the file, up and scale

FORMAT = 1
UP = {'y': 'y', 'z': 'z'}  # axes of a mesh file


def format_number(value: Any, key: str) -> int:
    """Check ``format``, the number of the schema."""
    if type(value) is not int or value != FORMAT:
        raise refused(key, value, f'{FORMAT}')
    return value


ROUND = fields(
    {
        'format': format_number,
        'name': text,
        'round': list_of(text, 'a list of one or more course files', 1, 100),
    },
    ('format', 'round'),
)
PROFILES = {
    'log': record(LogProfile, {'roughness': number(1e-6, 10)}),
    'power': record(PowerProfile, {'exponent': number(0, 2)}),
    'uniform': record(UniformProfile, {}),
}
WEATHER = record(
    Air,
    {
        'temperature': number(150, 400),
        'pressure': number(0, 1e7),
        'relative_humidity': number(0, 1),
    },
)
AT_ALTITUDE = fields(
    {
        'altitude': number(-1000, 11000),
        'temperature': number(150, 400),
        'relative_humidity': number(0, 1),
    }
)
BALL = record(
    Ball,
    {
        'mass': number(1e-6, 1000),
        'radius': number(1e-3, 1),
        'inertia': number(0.01, 1),
        'restitution': number(0, 1),
        'friction': number(0),
    },
)

CUTS = list_of(polygon, 'a list of polygons, each a list of corners [x, y]')
WATER = record(Water, {'polygon': polygon, 'level': number(), 'cut': CUTS}, ('polygon', 'level'))


def load_course(name_or_path: str | PathLike[str]) -> Course:
    """Load a course, ready to be played.

    Parameters
    ----------
    name_or_path : str or path
        Name of a shipped course, or the path of a course file.

    Returns
    -------
    golf_sim_ros.physics.scene.course_record.Course

    Raises
    ------
    CourseError
        One line: file, key, value and what is allowed.
    """
    return loaded(name_or_path, lambda content: content)


def course_without_field(name_or_path: str | os.PathLike) -> Course:
    """`load_course`, without the wind field that the file may name: to make one for it."""
    return loaded(
        name_or_path, lambda content: {k: v for k, v in content.items() if k != 'wind_field'}
    )


def loaded(name_or_path: str | os.PathLike, taken: Callable[[dict], dict]) -> Course:
    """Course of a file, of what ``taken(content)`` gives."""
    path, raw, content = opened_course(name_or_path)
    names = round_of(path, content)
    if names is not None:
        raise CourseError(
            f'{path}: is a round of {len(names)} courses: give one of them: {", ".join(names)}'
        )
    base, sources = shipped()
    opened: Opened = {}
    try:
        with uncollected(), np.errstate(all='ignore'):  # whatever is not finite is refused
            content = taken(content) if isinstance(content, dict) else content
            course = course_of(content, base, path.parent, sources, opened)
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None
    return course._replace(
        name=course.name or path.stem,
        path=str(path),
        digest=digest(raw, sources, opened),
        notes=(*(note for file in opened.values() for note in file.notes), *course.notes),
    )


def load_round(name_or_path: str | PathLike[str]) -> tuple[Course, ...]:
    """Load the courses of a round, in the order of play.

    Parameters
    ----------
    name_or_path : str or path
        Path of a file that names several, ``round: [first.yaml, second.yaml]``, from its own
        folder on or as shipped ones; or what `load_course` takes, which is a round of one.

    Returns
    -------
    tuple of golf_sim_ros.physics.scene.course_record.Course

    Raises
    ------
    CourseError
        One line, as of `load_course`.
    """
    path, _, content = opened_course(name_or_path)
    names = round_of(path, content)
    if names is None:
        return (load_course(name_or_path),)
    try:
        known = shipped_courses()
        return tuple(
            load_course(name if name in known else beside(path.parent, name)) for name in names
        )
    except CourseError as error:
        raise CourseError(f'{path}: round: {error}') from None


def opened_course(name_or_path: str | PathLike[str]) -> tuple[Path, bytes, Any]:
    """Path, bytes and content of a course file."""
    path = course_file(name_or_path)
    with uncollected():
        return path, *read_yaml(path)


def round_of(path: Path, content: Any) -> tuple[str, ...] | None:
    """Names of the courses that a file with the key ``round`` names; None where it is a course."""
    if not isinstance(content, dict) or 'round' not in content:
        return None
    try:
        return ROUND(content, '')['round']
    except CourseError as error:
        raise CourseError(f'{path}: {error}') from None


def shipped_courses() -> dict[str, Path]:
    """Paths of the courses that come with the package, by name."""
    return {path.stem: path for path in sorted(share('config', 'courses').glob('*.yaml'))}


def course_file(name_or_path: str | PathLike[str]) -> Path:
    """Path of a course: of a shipped one by its name, else whatever file is meant."""
    known = shipped_courses()
    if name_or_path in known:
        return known[name_or_path]
    name = os.fspath(name_or_path)
    try:
        path = beside(Path(), name)
    except CourseError as error:
        raise CourseError(f'{name}: {error}') from None
    if path.suffix not in ('.yaml', '.yml') and not is_there(path):
        raise CourseError(
            f'{unknown("course", name, known)}; or give the path of a course file (.yaml)'
        )
    return path


def digest(raw: bytes, sources: dict[str, bytes], opened: Opened) -> str:
    """SHA-256 over the bytes of the course file and of all it calls for.

    In the order of their names.
    """
    total = sha256(sha256(raw).digest())
    for name in sorted(sources):
        total.update(name.encode() + b'\0' + sha256(sources[name]).digest())
    meshes = {name: file.digest for (name, _, _), file in opened.items()}
    for name in sorted(meshes):
        total.update(name.encode() + b'\0' + meshes[name])
    return total.hexdigest()


def course_of(
    content: Any,
    base: dict[str, dict[str, Any]],
    folder: Path,
    sources: dict[str, bytes],
    opened: Opened,
) -> Course:
    """`Course` of a file's `content`; `base` holds the entries of the shipped materials.

    What the file calls for is looked for from `folder` on; bytes of height maps are put into
    `sources`, meshes into `opened`, by the names that the file gives them.
    """
    known = materials(mapping(content, '').get('materials', {}), base)
    notes: list[str] = []
    shape = shape_of(
        known, heightmap_of(known, folder, sources, notes), mesh_of(known, folder, opened)
    )
    read = fields(
        {
            'format': format_number,
            'name': text,
            'tee': vector(2),
            'hole': vector(2),
            'flagstick': flag,
            'bounds': polygon,
            'air': air,
            'wind_profile': tagged('law', PROFILES),
            'effects': effects,
            'ball': BALL,
            'materials': mapping,
            'wind_field': field_of(folder, sources),
            'water': list_of(WATER, 'a list of ponds, as in [{polygon: [[x, y], ...], level: z}]'),
            'zones': list_of(zone_of(known), 'a list of zones'),
            'obstacles': list_of(obstacle_of(known), 'a list of obstacles'),
            'ground': list_of(shape, 'a list of one or more shapes', 1),
        },
        needed=('format', 'ground'),
    )
    found = read(content, '')
    course = Course(
        cup=known['cup'],
        stick=known['flagstick'],
        **{
            name: value
            for name, value in found.items()
            if name in Course._fields and name != 'wind_field'
        },
    )
    files = [entry.get('file', entry.get('heights')) for entry in content['ground']]
    look = looker(course)
    for key in ('tee', 'hole'):
        on_ground(course, key, look, files)
    if course.hole is not None:
        even_around_hole(course, files)
    free_at_tee(course)
    course = with_field(course, found.get('wind_field'))
    return course._replace(notes=(*notes, *misplaced(course, files)))


def on_ground(course: Course, key: str, look: Callable, files: Sequence[str | None]) -> None:
    """Refuse a course with a tee or hole that has no ground under it.

    `files`: those of its shapes.
    """
    place = getattr(course, key)
    if place is not None and look(*place) is None:
        raise refused(
            key, list(place), f'above some ground, and there is none{files_reach(course, files)}'
        )


def free_at_tee(course: Course) -> None:
    """Refuse a course on whose tee no ball can lie."""
    try:
        physics.check_tee(course)
    except physics.NoPlace as error:
        raise CourseError(str(error)) from None


def even_around_hole(course: Course, files: Sequence[str | None]) -> None:
    """Refuse a course whose hole has no ground all round, or ground that is too uneven."""
    try:
        physics.check_hole(course)
    except ValueError as error:
        raise CourseError(f'{error}{files_reach(course, files)}') from None


def mesh_of(known: Mapping[str, Material], folder: Path, opened: Opened) -> Checker:
    """Make the checker of a mesh; see `course_of`."""
    read = fields(
        {
            'file': text,
            'material': one_of(known),
            'one_sided': flag,
            'up': one_of(UP),
            'scale': number(1e-6, 1e6),
        },
        ('file', 'material'),
    )

    def check(value: Any, key: str) -> Mesh:
        entry = read(value, key)
        name, one_sided = entry['file'], entry.get('one_sided', False)
        up, scale = entry.get('up'), entry.get('scale', 1.0)
        use = name, up, scale
        try:
            if use not in opened:
                opened[use] = opened_mesh(beside(folder, name), up, scale)
        except CourseError as error:
            reason = str(error).removeprefix(f'{folder / name}: ')
            raise CourseError(f'{key}.file {name}: {reason}') from None
        file = opened[use]
        faces = file.faces
        if one_sided:
            faces, notes = outward(file.vertices, faces, Path(name).name)
            opened[use] = file._replace(notes=tuple(dict.fromkeys((*file.notes, *notes))))
        return Mesh(file.vertices, faces, entry['material'], one_sided)

    return check


def opened_mesh(path: Path, up: str | None, scale: float) -> MeshFile:
    """`MeshFile` of the file at `path`.

    The digest of a .gltf file covers the mesh too, which others hold.
    """
    vertices, faces, notes = read_mesh(path, up, scale)
    digest = sha256(bytes_of(path))
    if path.suffix.lower() == '.gltf':
        digest.update(vertices.tobytes() + faces.tobytes())
    return MeshFile(vertices, faces, tuple(notes), digest.digest())


def shape_of(known: Mapping[str, Material], heightmap: Checker, mesh: Checker) -> Checker:
    """Make the checker of an entry of ``ground``.

    `known`: materials by name; `heightmap`, `mesh` read files.
    """
    common = {'normal': direction, 'material': one_of(known), 'cut': CUTS}
    size = number(1e-3)
    shapes = {
        'plane': record(Plane, {**common, 'point': vector(3)}, ('material',)),
        'patch': record(
            Patch,
            {
                **common,
                'center': vector(3),
                'heading': number(),
                'length': size,
                'width': size,
                'one_sided': flag,
            },
            ('center', 'length', 'width', 'material'),
        ),
        'heightmap': heightmap,
        'mesh': mesh,
    }

    def check(value: Any, key: str) -> Any:
        shape = tagged('shape', shapes)(value, key)
        if getattr(shape, 'cut', ()) and abs(shape.normal[2]) < 1e-3:
            raise refused(
                f'{key}.cut', value['cut'], 'left out: seen from above, this shape is a line'
            )
        return shape

    return check


def obstacle_of(known: Mapping[str, Material]) -> Checker:
    """Make the checker of an entry of ``obstacles``; `known` holds the materials by name."""
    common = {'material': one_of(known), 'radius': number(1e-3)}
    shapes = {
        'cylinder': record(
            Cylinder,
            {**common, 'base': vector(3), 'height': number(1e-3)},
            ('base', 'radius', 'height', 'material'),
        ),
        'sphere': record(
            Sphere, {**common, 'center': vector(3)}, ('center', 'radius', 'material')
        ),
    }
    return tagged('shape', shapes)


def zone_of(known: Mapping[str, Material]) -> Checker:
    """Make the checker of an entry of ``zones``."""
    return record(
        Zone, {'material': one_of(known), 'polygon': polygon, 'cut': CUTS}, ('material', 'polygon')
    )


def air(value: Any, key: str) -> Air:
    """Check ``air``: weather, or an altitude in the standard atmosphere.

    An altitude's pressure may have a temperature and a humidity of its own.
    """
    if 'altitude' in mapping(value, key):
        own = AT_ALTITUDE(value, key)
        weather = standard_atmosphere(own.pop('altitude'))._replace(**own)
    else:
        weather = WEATHER(value, key)
    if density(weather) < 0:
        raise refused(
            f'{key}.pressure', weather.pressure, 'more than that of the vapour in the air'
        )
    return weather


def effects(value: Any, key: str) -> str | tuple[str, ...]:
    """Check ``effects``: 'auto', or names; return 'auto' or a tuple."""
    if value in ('auto', ['auto']):
        return 'auto'
    names = {name: name for name in physics.EFFECTS}
    return list_of(one_of(names), 'auto, or a list of: ' + ', '.join(sorted(names)))(value, key)


def field_of(folder: Path, sources: dict[str, bytes]) -> Callable[[Any, str], WindField | None]:
    """Make a checker of ``wind_field``, a file's name: its `WindField`, None of an empty list."""

    def check(value: Any, key: str) -> WindField | None:
        if value == []:  # how files said so when there were none yet
            return None
        path = beside(folder, text(value, key))
        try:
            sources[value] = bytes_of(path)
            return WindField.read(sources[value])
        except (CourseError, FieldError) as error:
            raise CourseError(f'{key} {value}: {error}') from None

    return check


def with_field(course: Course, field: WindField | None) -> Course:
    """`course` with a `WindField`, which has to be that of its land."""
    if field is None:
        return course
    try:
        field.fits(course)
    except FieldError as error:
        raise CourseError(f'wind_field {error}') from None
    return course._replace(wind_field=field.atlas)
