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

"""Course files: what they become, and what is said of every kind of mistake in them."""

from math import cos, inf, sin
import os

from golf_sim_ros import physics
from golf_sim_ros.course import CourseError, load_course, shipped_courses
from golf_sim_ros.course.material_file import shipped
from golf_sim_ros.physics.effects.wind import LogProfile, PowerProfile, UniformProfile
from golf_sim_ros.physics.geometry.patch import Patch
from golf_sim_ros.physics.geometry.plane import Plane
from golf_sim_ros.physics.geometry.solid import Cylinder, Sphere
from golf_sim_ros.physics.geometry.water_surface import Water
from golf_sim_ros.physics.properties.air import Air, standard_atmosphere
from golf_sim_ros.physics.properties.material import Material, PENNER, Restitution
from golf_sim_ros.physics.scene.course_record import Ball
from hypothesis import given, HealthCheck, settings
from hypothesis import strategies as st
import numpy as np
import pytest
import yaml

PLAIN = 'format: 1\nground: [{shape: plane, material: rough}]\n'
PATCH = 'center: [0, 0, 0], length: 4, width: 2, material: rough'
GROUNDS = (
    'artificial_turf, fairway, firm_fairway, firm_green, first_cut, green, hardpan, rough, sand, '
    'soft_fairway, soft_green, tee'
)
KNOWN = (
    'artificial_turf, cup, fairway, firm_fairway, firm_green, first_cut, flagstick, green, '
    'hardpan, leaves, rough, sand, soft_fairway, soft_green, stone, tee, wood'
)


@pytest.fixture
def write(tmp_path):
    """Write a course file; gives its path."""

    def write(content):
        path = tmp_path / 'links.yaml'
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


@pytest.fixture
def load(write):
    """Write a course file and load it."""
    return lambda content: load_course(write(content))


@pytest.fixture
def complaint(write):
    """Write a course file with a mistake; gives what is said, without the file's name."""

    def complaint(content):
        path = write(content)
        with pytest.raises(CourseError) as caught:
            load_course(path)
        said = str(caught.value)
        assert said.startswith(f'{path}: ') and said.isprintable() and len(said) <= 300
        return said.removeprefix(f'{path}: ')

    return complaint


# What is right


def test_a_plain_course_has_the_defaults_of_the_contract(load):
    course = load(PLAIN)
    assert course.tee == (0.0, 0.0) and course.hole is None and course.bounds is None
    assert (
        course.air == Air() and course.ball == Ball() and course.wind_profile == LogProfile(0.01)
    )
    assert course.effects == 'auto' and course.flagstick is True
    assert course.name == 'links' and course.path.endswith('links.yaml')
    (plane,) = course.ground
    assert plane == Plane(material=plane.material) and plane.material.name == 'rough'


def test_everything_in_a_course_file_arrives_in_its_record(load):
    course = load("""
format: 1
name: Practice hole
tee: [1, 2]
hole: [15, 3]
flagstick: false
bounds: [[-20, -40], [200, -40], [200, 40], [-20, 40], [-20, -40]]
air: {temperature: 290, relative_humidity: 0.25}
wind_profile: {law: power, exponent: 0.2}
effects: [gravity, drag]
ball: {mass: 0.05, friction: 0.1}
zones: []
ground:
  - {shape: plane, point: [0, 0, 1], normal: [0, 3, 4], material: sand,
     cut: [[[9, 1], [11, 1], [10, 2]]]}
  - {shape: patch, center: [1, 2, 3], heading: 0.5, length: 4, width: 5, material: tee,
     one_sided: true}
""")
    assert (
        course.name == 'Practice hole' and course.tee == (1.0, 2.0) and course.hole == (15.0, 3.0)
    )
    assert course.flagstick is False
    assert course.bounds == ((-20.0, -40.0), (200.0, -40.0), (200.0, 40.0), (-20.0, 40.0))
    assert course.air == Air(290.0, 101325.0, 0.25) and course.wind_profile == PowerProfile(0.2)
    assert course.effects == ('gravity', 'drag') and course.ball == Ball(mass=0.05, friction=0.1)
    plane, patch = course.ground
    assert plane == Plane(
        (0.0, 0.0, 1.0), (0.0, 0.6, 0.8), plane.material, (((9.0, 1.0), (11.0, 1.0), (10.0, 2.0)),)
    )
    assert patch == Patch((1.0, 2.0, 3.0), (0.0, 0.0, 1.0), 0.5, 4.0, 5.0, patch.material, True)
    assert (plane.material.name, patch.material.name) == ('sand', 'tee')
    assert all(type(number) is float for number in (*course.tee, *patch.center, patch.length))


@pytest.mark.parametrize(
    'line, field, value',
    [
        ('air: {altitude: 1600}', 'air', standard_atmosphere(1600)),
        (
            'air: {altitude: 1600, temperature: 303}',
            'air',
            Air(303.0, standard_atmosphere(1600).pressure, 0.0),
        ),
        (
            'air: {altitude: -100, temperature: 310, relative_humidity: 1}',
            'air',
            Air(310.0, standard_atmosphere(-100).pressure, 1.0),
        ),
        ('wind_profile: {law: uniform}', 'wind_profile', UniformProfile()),
        ('wind_profile: {law: log}', 'wind_profile', LogProfile()),
        ('wind_profile: {law: log, roughness: 1e-3}', 'wind_profile', LogProfile(0.001)),
        ('tee: [1e1, -2E+0]', 'tee', (10.0, -2.0)),
        ('effects: [auto]', 'effects', 'auto'),
        ('effects: auto', 'effects', 'auto'),
    ],
)
def test_a_line_of_a_course_file_means_what_the_contract_says(load, line, field, value):
    assert getattr(load(PLAIN + line), field) == value


def test_every_registered_effect_is_accepted_by_name(load):
    assert load(PLAIN + f'effects: [{", ".join(physics.EFFECTS)}]').effects == tuple(
        physics.EFFECTS
    )


def materials_of(load, section):
    """Materials by name of a course whose patches use all that `section` names."""
    names = yaml.safe_load(section)
    course = load(
        yaml.safe_dump(
            {
                'format': 1,
                'materials': names,
                'ground': [{'shape': 'plane', 'material': name} for name in (*names, 'green')],
            }
        )
    )
    return {shape.material.name: shape.material for shape in course.ground}


def test_a_material_is_like_another_but_for_what_it_says_itself(load):
    found = materials_of(
        load, '{fast: {like: slow, stimp: 12}, slow: {like: green, softness: 0.5}}'
    )
    slow, fast, green = found['slow'], found['fast'], found['green']
    assert slow == green._replace(name='slow', softness=0.5)
    assert fast == slow._replace(name='fast', rolling_resistance=fast.rolling_resistance)
    assert fast.rolling_resistance == pytest.approx(5.494 / 12 / 9.80665, rel=1e-4)
    assert green.rolling_resistance == pytest.approx(5.494 / 10 / 9.80665, rel=1e-4)


def test_a_thousand_materials_may_be_like_each_other_in_a_row(load):
    names = [f'm{i}' for i in range(1000)]
    section = ', '.join(f'{name}: {{like: {like}}}' for name, like in zip(names, names[1:]))
    course = load(
        f'format: 1\nmaterials: {{{section}, m999: {{like: green, stimp: 12}}, empty: {{}}, '
        'a: {like: empty}}\nground: [{shape: plane, material: m0}]\n'
    )
    plain = load(
        'format: 1\nmaterials: {m0: {like: green, stimp: 12}}\n'
        'ground: [{shape: plane, material: m0}]'
    )
    assert course.ground == plain.ground


def test_a_shipped_material_can_be_changed_with_or_without_naming_itself(load):
    plain = materials_of(load, '{sand: {}}')['sand']
    for section in '{sand: {softness: 0.3}}', '{sand: {like: sand, softness: 0.3}}':
        assert materials_of(load, section)['sand'] == plain._replace(softness=0.3)
    assert materials_of(load, '{sand: {like: green}}')['sand'] == materials_of(
        load, '{green: {}}'
    )['green']._replace(name='sand')


def test_what_a_new_material_leaves_out_is_0_and_grey(load):
    assert materials_of(load, '{ice: {}}')['ice'] == physics.Material(name='ice')


@pytest.mark.parametrize(
    'written, law',
    [
        ('0.7', Restitution(0.7)),
        ('{law: penner}', PENNER),
        (
            '{law: quadratic, e0: 0.5, e1: -0.03, e2: 1e-3, floor: 0.1}',
            Restitution(0.5, -0.03, 0.001, 0.1),
        ),
        ('{law: quadratic, e0: 1}', Restitution(1.0)),
    ],
)
def test_restitution_is_a_number_or_a_law(load, written, law):
    section = f'materials: {{new: {{restitution: {written}}}}}\n'
    assert load(section + PLAIN.replace('rough', 'new')).ground[0].material.restitution == law


def test_the_digest_follows_the_content_and_not_the_place(tmp_path, write):
    first = load_course(write(PLAIN)).digest
    other = tmp_path / 'other.yaml'
    other.write_text(PLAIN)
    assert load_course(other).digest == first and len(first) == 64
    assert load_course(write(PLAIN + '# a remark\n')).digest != first


def test_a_course_is_found_by_name_by_path_and_by_relative_path(write, monkeypatch):
    path = write(PLAIN)
    monkeypatch.chdir(path.parent)
    assert load_course('links.yaml') == load_course(path)._replace(path='links.yaml')
    (path.parent / 'links').write_text(PLAIN)
    assert load_course(os.path.join('.', 'links')).ground == load_course(path).ground
    assert load_course('golf_without_friends').name == 'Golf without friends'


def test_a_mapping_may_be_merged_and_used_again(load):
    course = load(f"""
format: 1
ground:
  - {{shape: plane, material: rough}}
  - &first {{shape: patch, {PATCH}}}
  - &second {{<<: *first, length: 5}}
  - {{<<: *second, width: 7}}
""")
    assert [(p.length, p.width) for p in course.ground[1:]] == [(4.0, 2.0), (5.0, 2.0), (5.0, 7.0)]


def test_water_is_read(load):
    course = load(PLAIN + 'water: [{polygon: [[3, 0], [5, 0], [5, 2]], level: -0.2}]')
    assert course.water == (Water(((3.0, 0.0), (5.0, 0.0), (5.0, 2.0)), -0.2),)


def test_obstacles_and_zones_are_read(load):
    course = load(
        PLAIN
        + """
zones: [{material: green, polygon: [[3, 0], [5, 0], [5, 2]]}]
obstacles:
  - {shape: cylinder, base: [60, 12, 0], radius: 0.3, height: 8, material: wood}
  - {shape: sphere, center: [60, 12, 9], radius: 2.5, material: leaves}
"""
    )
    trunk, crown = course.obstacles
    assert (
        trunk == Cylinder((60.0, 12.0, 0.0), 0.3, 8.0, trunk.material)
        and trunk.material.name == 'wood'
    )
    assert crown == Sphere((60.0, 12.0, 9.0), 2.5, crown.material) and crown.material.drag > 0
    ((material, outline, cut),) = course.zones
    assert material.name == 'green' and outline == ((3.0, 0.0), (5.0, 0.0), (5.0, 2.0))
    assert cut == ()
    assert physics.ground_height(course, 4.5, 0.5)[1] == 'green'


# What is wrong: what is added to a plain course, and what is said


@pytest.mark.parametrize(
    'line, said',
    [
        ('grond: []', "key 'grond' is unknown; known: air, ball, bounds,"),
        ('grond: []', "; did you mean 'ground'?"),
        ('7: x', 'key 7 is unknown; known: '),
        ('tee: here', "tee 'here' must be 2 numbers, as in [0, 1]"),
        ('tee:', 'tee nothing must be 2 numbers'),
        ('tee: [1, 2, 3]', 'tee [1, 2, 3] must be 2 numbers'),
        ('tee: [1, yes]', 'tee[1] True must be a number from -1e+06 to 1e+06'),
        ('tee: [1, "2"]', "tee[1] '2' must be a number"),
        ('tee: [.nan, 0]', 'tee[0] nan must be a number'),
        ('hole: [.inf, 0]', 'hole[0] inf must be a number'),
        ('hole: [0, 1' + 400 * '0' + ']', 'hole[1] 1000'),
        ('hole: [0, 0x' + 5000 * 'f' + ']', 'must be a number'),
        ('name: [a]', "name ['a'] must be a line of text"),
        ('name: "a\\nb"', "name 'a\\nb' must be a line of text"),
        ('name: ""', "name '' must be a line of text"),
        ('flagstick: 1', 'flagstick 1 must be true or false'),
        (
            'bounds: [[0, 0], [1, 0]]',
            'bounds [[0, 0], [1, 0]] must be a list of 3 or more corners [x, y]',
        ),
        ('bounds: [[0, 0], [1, 0], 3]', 'bounds[2] 3 must be 2 numbers'),
        (
            'bounds: [[0, 0], [1, 1], [1, 0], [0, 1]]',
            'must be a polygon without crossings, but its sides 0 and 2',
        ),
        ('bounds: [[0, 0], [2, 0], [1, 0]]', 'must be a polygon without crossings'),
        (
            'bounds: [[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]]',
            'must be a polygon without crossings',
        ),
        (
            'bounds: [[0, 0], [2, 2], [4, 0], [4, 4], [2, 2], [0, 4]]',
            'must be a polygon without crossings',
        ),
        ('bounds: [[0, 0], [0, 0], [1, 0], [1, 1]]', 'but corner [0.0, 0.0] comes twice in a row'),
        ('air: [1]', 'air [1] must be a mapping'),
        ('air: {pressure: -1}', 'air.pressure -1 must be a number from 0 to 1e+07'),
        (
            'air: {pressure: 10, relative_humidity: 1}',
            'air.pressure 10.0 must be more than that of the vapour',
        ),
        ('air: {relative_humidity: 50}', 'air.relative_humidity 50 must be a number from 0 to 1'),
        ('air: {altitude: 1600, pressure: 1}', "air: key 'pressure' is unknown; known: altitude"),
        (
            'air: {altitude: 1600, temperature: 30}',
            'air.temperature 30 must be a number from 150 to 400',
        ),
        (
            'air: {altitude: 11000, temperature: 400, relative_humidity: 1}',
            'must be more than that of the vapour',
        ),
        ('air: {altitude: 20000}', 'air.altitude 20000 must be a number from -1000 to 11000'),
        (
            'air: {temprature: 280}',
            "air: key 'temprature' is unknown; known: pressure, relative_humidity, temperature",
        ),
        (
            'wind_profile: {roughness: 1}',
            "wind_profile: key 'law' is missing; it is one of: log, power, uniform",
        ),
        (
            'wind_profile: {law: lin}',
            "wind_profile.law 'lin' is unknown; known: log, power, uniform",
        ),
        (
            'wind_profile: {law: [log]}',
            "wind_profile.law ['log'] is unknown; known: log, power, uniform",
        ),
        (
            'wind_profile: {law: log, roughness: 0}',
            'wind_profile.roughness 0 must be a number from 1e-06 to 10',
        ),
        ('wind_profile: {law: uniform, roughness: 1}', "wind_profile: key 'roughness' is unknown"),
        ('effects: [gravity, dragg]', "effects[1] 'dragg' is unknown; known: "),
        ('effects: all', "effects 'all' must be auto, or a list of: "),
        ('effects: [[drag]]', "effects[0] ['drag'] is unknown"),
        ('ball: {mass: 0}', 'ball.mass 0 must be a number from 1e-06 to 1000'),
        ('ball: {restitution: 1.1}', 'ball.restitution 1.1 must be a number from 0 to 1'),
        ('ball: {weight: 1}', "ball: key 'weight' is unknown; known: friction, inertia,"),
        ('wind_field: x.npz', 'wind_field x.npz: cannot be read: No such file or directory'),
        ('wind_field: 3', 'wind_field 3 must be a line of text'),
        (
            'zones: [{material: green}]',
            "zones[0]: key 'polygon' is missing; needed: material, polygon",
        ),
        (
            'zones: [{material: gren, polygon: [[0, 0], [1, 0], [1, 1]]}]',
            "zones[0].material 'gren' is unknown",
        ),
        ('water: [1]', 'water[0] 1 must be a mapping'),
        ('water: {level: 0}', "water {'level': 0} must be a list of ponds"),
        (
            'water: [{polygon: [[0, 0], [1, 0], [1, 1]]}]',
            "water[0]: key 'level' is missing; needed: polygon",
        ),
        (
            'water: [{polygon: [[0, 0], [1, 0]], level: 0}]',
            'water[0].polygon [[0, 0], [1, 0]] must be a list',
        ),
        (
            'water: [{polygon: [[0, 0], [1, 0], [1, 1]], level: .nan}]',
            'water[0].level nan must be a number',
        ),
        ('obstacles: [1]', 'obstacles[0] 1 must be a mapping'),
        (
            'obstacles: [{shape: cone}]',
            "obstacles[0].shape 'cone' is unknown; known: cylinder, sphere",
        ),
        (
            'obstacles: [{shape: sphere, radius: 1, material: wood}]',
            "obstacles[0]: key 'center' is missing",
        ),
        (
            'obstacles: [{shape: sphere, center: [0, 0, 9], radius: 0, material: wood}]',
            'obstacles[0].radius 0 must be a number from 0.001 to 1e+06',
        ),
        (
            'materials: {}\nmaterials: {}',
            "line 4: key 'materials' is already in line 3; a key may appear once",
        ),
        ('ball: {mass: 1, mass: 2}', "line 3: key 'mass' is already in line 3"),
        ('ball: {mass: 1', 'line 4: is not valid YAML: '),
        ('ball: *here', 'line 3: is not valid YAML: '),
        ('name: !!python/object:os.system x', 'line 3: is not valid YAML: '),
        (
            'name: 2026-13-45',
            "line 3: is not valid YAML: '2026-13-45' is no timestamp: month must be in 1..12",
        ),
        ('? [a, {b: c}]\n: 1', 'is not valid YAML: '),
        ('name: ' + 5000 * '[', 'is not valid YAML'),
        ('flagstick: !!bool x', "line 3: is not valid YAML: 'x' is no bool"),
        ('name: !!timestamp x', "line 3: is not valid YAML: 'x' is no timestamp"),
        ('tee: [!!int , 0]', "line 3: is not valid YAML: '' is no int"),
        ('tee: [!!float "", 0]', "line 3: is not valid YAML: '' is no float"),
        ('tee: [!!int 0b, 0]', "line 3: is not valid YAML: '0b' is no int"),
        ('tee: [!!float ' + ':'.join(3000 * '1') + ', 0]', 'is no float'),
        ('tee: [' + ':'.join(3000 * '1') + ', 0]', 'must be a number from -1e+06 to 1e+06'),
        ('tee: [1:30, 0]', "tee[0] '1:30' must be a number"),
        ('tee: [' + 100_000 * '1' + 'e, 0]', 'must be a number'),
        ('name: &a [*a]', 'is too large: its aliases make'),
        ('ball: &a {mass: *a}', 'is too large: its aliases make'),
        (
            'zones: &z [[0, 0], [1, 0]]\n'
            + '\n'.join(
                f'{c}: &{c} [{", ".join(10 * [f"*{b}"])}]' for b, c in zip('zabcdefg', 'abcdefgh')
            ),
            'aliases make',
        ),
        ('"k\\0\\nx": 1', "key 'k\\x00\\nx' is unknown"),
        (300 * 'k' + ': 1', 'known: air, ball, bounds'),
        (
            'effects: [' + ', '.join(300 * ['gravitation']) + ', 7]',
            "effects[0] 'gravitation' is unknown; ",
        ),
    ],
)
def test_a_wrong_line_is_named(complaint, line, said):
    assert said in complaint(PLAIN + line)


@pytest.mark.parametrize(
    'section, said',
    [
        ('[1]', 'materials [1] must be a mapping'),
        ('{3: {}}', 'materials: name 3 must be a line of text'),
        ('{a: }', 'materials.a nothing must be a mapping'),
        ('{a: {like: gren}}', "did you mean 'green'?"),
        ('{a: {like: 3}}', 'materials.a.like 3 must be a line of text'),
        (
            '{a: {like: a}}',
            "materials.a.like 'a' leads back to itself: a -> a; a material may not be like itself",
        ),
        (
            '{a: {like: b}, b: {like: c}, c: {like: a}}',
            "materials.c.like 'a' leads back to itself: a -> b -> c -> a; "
            'a material may not be like itself',
        ),
        ('{a: {like: b}, b: {like: c}, c: {like: b}}', 'leads back to itself: a -> b -> c -> b;'),
        (
            '{' + ', '.join(f'm{i}: {{like: m{(i + 1) % 1000}}}' for i in range(1000)) + '}',
            "materials.m999.like 'm0' leads back to itself: m0 -> m1",
        ),
        (
            '{' + ', '.join(f'm{i}: {{}}' for i in range(1000)) + ', a: {like: m7x}}',
            "did you mean 'm7",
        ),
        (
            '{a: {stimp: 10, rolling_resistance: 0.1}}',
            'materials.a has both stimp and rolling_resistance; one is allowed',
        ),
        ('{a: {stimp: 0}}', 'materials.a.stimp 0 must be a number from 0.1 to 100'),
        ('{a: {restitution: 1.5}}', 'materials.a.restitution 1.5 must be a number from 0 to 1'),
        (
            '{a: {restitution: high}}',
            "materials.a.restitution 'high' must be a number from 0 to 1",
        ),
        (
            '{a: {restitution: {law: pener}}}',
            "materials.a.restitution.law 'pener' is unknown; known: penner, quadratic; "
            "did you mean 'penner'?",
        ),
        ('{a: {restitution: {e0: 1}}}', "materials.a.restitution: key 'law' is missing"),
        (
            '{a: {restitution: {law: penner, e0: 1}}}',
            "materials.a.restitution: key 'e0' is unknown",
        ),
        (
            '{a: {restitution: {law: quadratic}}}',
            "materials.a.restitution: key 'e0' is missing; needed: e0",
        ),
        (
            '{a: {restitution: {law: quadratic, e0: 2}}}',
            'materials.a.restitution.e0 2 must be a number from 0 to 1',
        ),
        (
            '{a: {tangential_restitution: -2}}',
            'materials.a.tangential_restitution -2 must be a number from -1 to 1',
        ),
        (
            '{a: {dynamic_friction: -0.1}}',
            'materials.a.dynamic_friction -0.1 must be a number from 0 to 1e+06',
        ),
        ('{a: {color: [1, 0, 2]}}', 'materials.a.color[2] 2 must be a number from 0 to 1'),
        ('{a: {color: red}}', "materials.a.color 'red' must be 3 numbers"),
        ('{a: {frction: 1}}', "materials.a: key 'frction' is unknown; known: canopy_drag"),
    ],
)
def test_a_wrong_material_is_named(complaint, section, said):
    assert said in complaint(PLAIN + f'materials: {section}')


@pytest.mark.parametrize(
    'shape, said',
    [
        ('3', 'ground[0] 3 must be a mapping'),
        (
            '{material: rough}',
            "ground[0]: key 'shape' is missing; it is one of: heightmap, mesh, patch, plane",
        ),
        (
            '{shape: plan, material: rough}',
            "ground[0].shape 'plan' is unknown; known: heightmap, mesh, patch, plane; "
            "did you mean 'plane'?",
        ),
        (
            '{shape: mesh, material: rough}',
            "ground[0]: key 'file' is missing; needed: file, material",
        ),
        (
            '{shape: mesh, file: a.stl, material: rough}',
            'a.stl: cannot be read: No such file or directory',
        ),
        (
            '{shape: mesh, file: links.yaml, material: rough}',
            'is no mesh; known: .glb, .gltf, .obj, .ply, .stl',
        ),
        ('{shape: plane, material: gras}', f"material 'gras' is unknown; known: {KNOWN}"),
        ('{shape: plane, material: 1}', 'ground[0].material 1 is unknown'),
        ('{shape: plane}', "ground[0]: key 'material' is missing; needed: material"),
        (
            '{shape: plane, material: rough, normal: [0, 0, 0]}',
            'ground[0].normal [0, 0, 0] must be a direction, and (almost) zero has none',
        ),
        (
            '{shape: plane, material: rough, normal: [0, 1]}',
            'ground[0].normal [0, 1] must be 3 numbers',
        ),
        ('{shape: plane, material: rough, normal: up}', "ground[0].normal 'up' must be 3 numbers"),
        (
            '{shape: plane, material: rough, cut: [[0, 0], [1, 0], [1, 1]]}',
            'ground[0].cut[0] [0, 0] must be a list of 3 or more corners',
        ),
        (
            '{shape: plane, material: rough, normal: [1, 0, 0], cut: [[[0, 0], [1, 0], [1, 1]]]}',
            'ground[0].cut [[[0, 0], [1, 0], [1, 1]]] must be left out: '
            'seen from above, this shape is a line',
        ),
        (
            '{shape: patch, material: rough, center: [0, 0, 0], length: 3}',
            "ground[0]: key 'width' is missing; needed: center, length, width, material",
        ),
        (
            f'{{shape: patch, {PATCH}, lenght: 2}}',
            "ground[0]: key 'lenght' is unknown; known: center, cut,",
        ),
        (
            f'{{shape: patch, {PATCH}, one_sided: no one}}',
            "ground[0].one_sided 'no one' must be true or false",
        ),
        (f'{{shape: patch, {PATCH}, heading: west}}', "ground[0].heading 'west' must be a number"),
        (
            '{shape: patch, center: [0, 0, 0], length: -4, width: 2, material: rough}',
            'ground[0].length -4 must be a number from 0.001 to 1e+06',
        ),
    ],
)
def test_a_wrong_shape_is_named(complaint, shape, said):
    assert said in complaint(f'format: 1\nground: [{shape}]\n')


@pytest.mark.parametrize(
    'content, said',
    [
        ('', 'is empty'),
        ('# nothing', 'the file nothing must be a mapping'),
        ('- 1', 'the file [1] must be a mapping'),
        ('ground: []', "key 'format' is missing; needed: format, ground"),
        ('format: 1', "key 'ground' is missing; needed: format, ground"),
        ('format: 1\nground: []', 'ground [] must be a list of one or more shapes'),
        ('format: 2\nground: []', 'format 2 must be 1'),
        ('format: true\nground: []', 'format True must be 1'),
        ('format: "1"\nground: []', "format '1' must be 1"),
        (b'name: \xff\xfe', 'is not valid YAML'),
        ('name: a\n--- \nname: b', 'is not valid YAML'),
    ],
)
def test_a_wrong_file_is_named(complaint, content, said):
    assert said in complaint(content)


@pytest.mark.parametrize(
    'line, said',
    [
        ('tee: [3, 0]', 'tee [3.0, 0.0] must be above some ground, and there is none'),
        ('hole: [0, 1.5]', 'hole [0.0, 1.5] must be above some ground, and there is none'),
        ('hole: [0, 0.99]', 'hole (0, 0.99) must have ground all round'),
    ],
)
def test_tee_and_hole_need_ground(complaint, line, said):
    assert said in complaint(f'format: 1\nground: [{{shape: patch, {PATCH}}}]\n{line}\n')


def test_a_tee_over_a_pit_without_a_floor_has_no_ground(complaint):
    pit = 'cut: [[[-1, -1], [1, -1], [1, 1], [-1, 1]]]'
    said = complaint(f'format: 1\nground: [{{shape: plane, material: rough, {pit}}}]')
    assert said == 'tee [0.0, 0.0] must be above some ground, and there is none'


@pytest.mark.parametrize(
    'name', ['golf_without_freinds', '', '.', 'courses/links', '\0', 'é' * 400]
)
def test_an_unknown_course_is_told_the_known_ones(name):
    with pytest.raises(CourseError, match='is unknown; known: golf_without_friends') as caught:
        load_course(name)
    assert str(caught.value).isprintable()


def test_a_missing_file_and_a_folder_are_named(tmp_path):
    with pytest.raises(
        CourseError, match='nowhere.yaml: cannot be read: No such file or directory'
    ):
        load_course(tmp_path / 'nowhere.yaml')
    (tmp_path / 'folder.yaml').mkdir()
    with pytest.raises(CourseError, match='folder.yaml: cannot be read: Is a directory'):
        load_course(str(tmp_path / 'folder.yaml'))


@pytest.fixture
def special(tmp_path):
    """Return what is no file: by name, what it is, and its path."""
    os.mkfifo(tmp_path / 'fifo')
    for name in ('fifo.yaml', 'fifo.stl', 'fifo.npy'):
        (tmp_path / name).symlink_to(tmp_path / 'fifo')
    for name in ('zero.yaml', 'zero.obj', 'zero.tif'):
        (tmp_path / name).symlink_to('/dev/zero')
    return tmp_path


@pytest.mark.parametrize('name, said', [('fifo.yaml', 'a FIFO'), ('zero.yaml', 'a device')])
def test_a_course_that_is_no_regular_file_is_refused(special, name, said):
    with pytest.raises(CourseError, match=f'{name}: is {said}, and must be a regular file'):
        load_course(special / name)


@pytest.mark.parametrize(
    'entry, said',
    [
        ('shape: mesh, file: fifo.stl', 'file fifo.stl: is a FIFO'),
        ('shape: mesh, file: zero.obj', 'file zero.obj: is a device'),
        (
            'shape: mesh, file: ~nobody_at_all/x.stl',
            '~nobody_at_all/x.stl: cannot be read: Could not determine',
        ),
        ('shape: heightmap, spacing: 1, heights: fifo.npy', 'heights fifo.npy: is a FIFO'),
        ('shape: heightmap, heights: zero.tif', 'heights zero.tif: is a device'),
        (
            'shape: heightmap, heights: ~nobody_at_all/x.tif',
            'x.tif: cannot be read: Could not determine',
        ),
    ],
)
def test_what_a_course_calls_for_must_be_a_regular_file(special, complaint, entry, said):
    assert said in complaint(f'format: 1\nground: [{{material: rough, {entry}}}]\n')


def test_a_home_that_nobody_has_is_told():
    with pytest.raises(CourseError, match='~nobody_at_all/x.yaml: cannot be read'):
        load_course('~nobody_at_all/x.yaml')


def test_a_message_is_cut_in_its_middle_and_ends_with_what_is_allowed(write, tmp_path):
    folder = tmp_path / ('a' * 200) / ('b' * 200)
    folder.mkdir(parents=True)
    path = folder / 'links.yaml'
    path.write_text(PLAIN + 'tee: [x, 0]')
    with pytest.raises(CourseError) as caught:
        load_course(path)
    assert len(str(caught.value)) <= 300 and str(caught.value).startswith(str(tmp_path))
    assert str(caught.value).endswith("tee[0] 'x' must be a number from -1e+06 to 1e+06")


@pytest.mark.filterwarnings('error')
@pytest.mark.parametrize(
    'entry, raw',
    [
        ('shape: mesh, file: a.stl', b'\0' * 80 + b'\1\0\0\0' + b'\xff\x7f\xa1\x7f' * 13),
        (
            'shape: mesh, file: a.obj',
            b'v 1e300 1e300 0\nv -1e300 1e308 0\nv 1e308 0 0\nv 0 1 1\nf 1 2 3 4\n',
        ),
        (
            'shape: mesh, file: a.ply',
            b'ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n',
        ),
        (
            'shape: heightmap, spacing: 1, heights: a.npy',
            b'\x93NUMPY\1\0F\0'
            + b"{'descr': '<f8', 'fortran_order': False, 'shape': (2L, 2L), }".ljust(69)
            + b'\n'
            + b'\xff' * 32,
        ),
    ],
)
def test_numpy_warns_of_nothing_beside_a_refusal(complaint, tmp_path, entry, raw):
    (tmp_path / entry.rpartition(' ')[2]).write_bytes(raw)
    assert complaint(f'format: 1\nground: [{{material: rough, {entry}}}]\n')


WHOLE = yaml.safe_load("""
format: 1
name: whole
tee: [0, 0]
hole: [15, 3]
flagstick: true
bounds: [[-20, -40], [200, -40], [200, 40]]
air: {temperature: 298.15, pressure: 101325, relative_humidity: 0.5}
wind_profile: {law: log, roughness: 0.01}
effects: [drag]
materials:
  new: {like: green, stimp: 12, restitution: {law: quadratic, e0: 0.5}, color: [0, 1, 0]}
ball: {mass: 0.05}
ground:
  - {shape: plane, normal: [0, 0, 1], material: rough, cut: [[[9, 1], [11, 1], [10, 2]]]}
  - {shape: patch, center: [0, 0, 0], length: 3, width: 3, material: new}
""")
JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.dates(),
    st.lists(st.integers(-3, 3), max_size=4),
    st.binary(max_size=3),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
)


def places(content, way=()):
    """Ways to everything in `content`."""
    yield way
    items = (
        content.items()
        if isinstance(content, dict)
        else enumerate(content)
        if isinstance(content, list)
        else ()
    )
    for key, value in items:
        yield from places(value, (*way, key))


def replaced(content, way, junk):
    """`content` with `junk` in the place where `way` leads."""
    if not way:
        return junk
    copy = content.copy()
    copy[way[0]] = replaced(content[way[0]], way[1:], junk)
    return copy


@settings(
    deadline=None, max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(way=st.sampled_from(sorted(places(WHOLE), key=str)), junk=JUNK)
def test_junk_anywhere_is_a_course_or_one_line(write, way, junk):
    path = write(yaml.safe_dump(replaced(WHOLE, way, junk)))
    try:
        load_course(path)
    except CourseError as error:
        assert str(error).startswith(f'{path}: ') and str(error).isprintable()


# What is shipped


def test_the_shipped_materials_are_those_of_a_golf_course():
    entries, sources = shipped()
    assert sorted(sources) == [n for n in KNOWN.split(', ') if n not in ('cup', 'flagstick')]
    found = {name: Material(name=name, **entries[name]) for name in GROUNDS.split(', ')}
    for material in found.values():
        assert material.static_friction >= material.dynamic_friction > 0
        assert material.rolling_resistance > 0 and 0 <= material.restitution.e0 < 1
    brightness = {name: sum(m.color) for name, m in found.items()}
    assert brightness['rough'] < brightness['fairway'] < brightness['green']
    red, green, blue = found['sand'].color
    assert found['sand'].restitution == Restitution() and red > green > blue > 0.5
    slow = [
        found[name].rolling_resistance
        for name in (
            'firm_green',
            'green',
            'soft_green',
            'tee',
            'fairway',
            'first_cut',
            'rough',
            'sand',
        )
    ]
    assert slow == sorted(slow)


@pytest.mark.parametrize('name', shipped_courses())
def test_every_shipped_course_loads_and_has_a_hole_on_a_green(name):
    course = load_course(name)
    assert physics.ground_height(course, *course.hole)[1] == 'green'
    assert physics.ground_height(course, *course.tee)[1] == (
        'green' if name == 'putting_green' else 'tee'
    )


def frame(patch):
    """Return unit vectors of a patch: normal, along, across."""
    n = np.array(patch.normal)
    ahead = np.array([cos(patch.heading), sin(patch.heading), 0])
    along = ahead - ahead @ n * n
    along /= np.linalg.norm(along)
    return n, along, np.cross(n, along)


def within(polygon, x, y):
    """Whether a polygon contains the points (crossing number)."""
    odd = np.zeros(np.shape(x), bool)
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        if ay != by:
            odd ^= ((ay > y) != (by > y)) & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    return odd


def surface(shape, x, y):
    """Heights of one shape over the points; -inf where it has none."""
    if isinstance(shape, physics.Mesh):
        corners, z = shape.vertices[shape.faces], np.full(np.shape(x), -inf)
        low, high = corners.min((0, 1)), corners.max((0, 1))
        near = (low[0] <= x) & (x <= high[0]) & (low[1] <= y) & (y <= high[1])
        z[near] = np.max([of_triangle(triangle, x[near], y[near]) for triangle in corners], axis=0)
        return z
    center = np.array(shape.point if isinstance(shape, Plane) else shape.center)
    n = np.array(shape.normal)
    z = center[2] - (n[0] * (x - center[0]) + n[1] * (y - center[1])) / n[2]
    there = np.ones(np.shape(x), bool)
    if isinstance(shape, Patch):
        _, along, across = frame(shape)
        offset = np.stack([x, y, z], -1) - center
        there = (abs(offset @ along) <= shape.length / 2) & (
            abs(offset @ across) <= shape.width / 2
        )
    for polygon in shape.cut:
        there &= ~within(polygon, x, y)
    return np.where(there, z, -inf)


def of_triangle(corners, x, y):
    """Heights of one triangle over the points; -inf where it is not."""
    a, sides = corners[0], corners[1:] - corners[0]
    share = np.linalg.solve(sides[:, :2].T, np.array([x - a[0], y - a[1]]))
    there = (share.min(0) >= -1e-12) & (share.sum(0) <= 1 + 1e-12)
    return np.where(there, a[2] + share.T @ sides[:, 2], -inf)


def heights(course, x, y):
    """Heights of the highest surface over the points, worked out apart from the physics."""
    return np.max([surface(shape, x, y) for shape in course.ground], axis=0)


def outlines(course):
    """Polygons in plan where a patch or a cut ends."""
    for shape in course.ground:
        yield from getattr(shape, 'cut', ())
        if isinstance(shape, Patch):
            _, along, across = frame(shape)
            yield tuple(
                tuple(
                    (
                        np.array(shape.center)
                        + i * shape.length / 2 * along
                        + j * shape.width / 2 * across
                    )[:2]
                )
                for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))
            )


def steps(course, polygon, apart=1e-7):
    """Places along the sides of `polygon`, and the heights `apart` to their left and right."""
    for a, b in zip(np.array(polygon), np.roll(polygon, -1, axis=0)):
        way = b - a
        places = a + np.linspace(0.0005, 0.9995, 1999)[:, None] * way
        aside = apart * np.array([-way[1], way[0]]) / np.linalg.norm(way)
        yield (places, heights(course, *(places + aside).T), heights(course, *(places - aside).T))


@pytest.fixture(scope='module')
def friends():
    return load_course('golf_without_friends')


def in_sand(course, x, y):
    """Whether the points are in the pit of a bunker."""
    pits = [cut for cut in course.ground[0].cut if len(cut) == 6]
    assert len(pits) == 3
    return np.any([within(pit, x, y) for pit in pits], axis=0)


def test_golf_without_friends_has_no_gap_and_no_step_but_at_its_bunkers_and_its_pond(friends):
    # Between these lines the ground is the highest of some planes, and so has no step either.
    for polygon in outlines(friends):
        for places, left, right in steps(friends, polygon):
            assert np.isfinite(left).all() and np.isfinite(right).all()
            step = abs(left - right)
            # bunkers, pond
            lowest, highest = {6: (0.1, 0.2), 7: (1.2, 1.2)}.get(len(polygon), (0.0, 0.0))
            allowed = (step > lowest - 1e-6) & (step < highest + 1e-6)
            assert allowed.all(), places[~allowed][0]


def test_the_step_test_sees_a_gap_of_a_hundredth_of_a_millimetre(friends):
    number = next(
        i for i, shape in enumerate(friends.ground) if getattr(shape, 'normal', (0,))[0] > 0.03
    )
    ground = list(friends.ground)
    ground[number] = ground[number]._replace(length=ground[number].length - 2e-5)
    course = friends._replace(ground=tuple(ground))
    assert not all(
        np.isfinite(left).all() and np.isfinite(right).all()
        for polygon in outlines(course)
        for _, left, right in steps(course, polygon)
    )


def test_golf_without_friends_has_ground_everywhere_and_nothing_above_the_rough(friends):
    x, y = np.meshgrid(np.arange(-20, 380, 0.37), np.arange(-50, 60, 0.23))
    z = heights(friends, x, y)
    assert -3.0 < z.min() < -2.5 and z.max() < 1e-9


def test_golf_without_friends_slopes_gently_and_has_sand_in_its_bunkers(friends):
    steep = {name: [] for name in KNOWN.split(', ')}
    flat = [shape for shape in friends.ground if not isinstance(shape, physics.Mesh)]
    for shape in flat:
        steep[shape.material.name].append(np.hypot(*shape.normal[:2]) / shape.normal[2])
    assert max(steep['fairway']) < 0.04 and len(steep['fairway']) >= 5
    assert 0.009 < min(steep['green']) and max(steep['green']) < 0.025 and len(steep['green']) >= 4
    assert max(steep['sand']) == max(steep['tee']) == 0 and len(friends.ground) == len(flat) + 3
    x, y = np.meshgrid(np.arange(236, 360, 1.3), np.arange(-24, 40, 0.9))
    sand = in_sand(friends, x, y)
    found = [
        physics.ground_height(friends, *place)[1] == 'sand' for place in zip(x[sand], y[sand])
    ]
    assert sum(found) == len(found) > 100


def test_the_physics_finds_the_same_heights_on_golf_without_friends(friends):
    places = np.random.default_rng(7).uniform((-10, -40), (380, 50), (200, 2))
    expected = heights(friends, *places.T)
    for (x, y), z in zip(places, expected):
        assert physics.ground_height(friends, x, y)[0] == pytest.approx(z, abs=1e-9)


def test_the_physics_finds_ground_on_every_line_where_something_ends(friends):
    for polygon in outlines(friends):
        for a, b in zip(np.array(polygon), np.roll(polygon, -1, axis=0)):
            for part in np.linspace(0, 1, 5):
                place = a + part * (b - a)
                assert physics.ground_height(friends, *place) is not None, place
