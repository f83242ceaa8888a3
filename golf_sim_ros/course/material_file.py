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

"""Materials: the shipped ones, one YAML file each, and those that a course adds or changes."""

from collections.abc import Mapping
from typing import Any

from .package_files import share
from .schema import (
    below,
    Checker,
    CourseError,
    fields,
    mapping,
    number,
    record,
    tagged,
    text,
    unknown,
    vector,
)
from .yaml_file import read_yaml
from ..physics.geometry.cup import CUP_MATERIAL
from ..physics.geometry.solid import FLAGSTICK_MATERIAL
from ..physics.properties.material import (
    Material,
    PENNER,
    RANGES,
    Restitution,
    rolling_resistance_of_stimp,
)

Entry = dict[str, Any]  # fields of a `Material`, and perhaps 'like'

LAWS: dict[str, Checker] = {
    'penner': lambda value, key: fields({})(value, key) or PENNER,
    'quadratic': record(
        Restitution,
        {'e0': number(0, 1), 'e1': number(-10, 10), 'e2': number(-10, 10), 'floor': number(0, 1)},
        needed=('e0',),
    ),
}


def restitution(value: Any, key: str) -> Restitution:
    """Check a number, or a law of the approach speed; return `Restitution`."""
    if isinstance(value, dict):
        return tagged('law', LAWS)(value, key)
    return Restitution(number(0, 1)(value, key))


FIELDS: dict[str, Checker] = {
    'restitution': restitution,
    **{name: number(*ends) for name, ends in RANGES.items()},
    'stimp': number(0.1, 100),
    'color': vector(3, 0, 1),
}


def entry(value: Any, key: str, checkers: Mapping[str, Checker] = FIELDS) -> Entry:
    """Check one material; return a dict of the fields of `Material`, and perhaps 'like'."""
    content = fields(checkers)(value, key)
    if 'stimp' in content:
        if 'rolling_resistance' in content:
            raise CourseError(
                f'{key or "material"} has both stimp and rolling_resistance; one is allowed'
            )
        content['rolling_resistance'] = rolling_resistance_of_stimp(content.pop('stimp'))
    return content


def shipped() -> tuple[dict[str, Entry], dict[str, bytes]]:
    """Entries of the shipped materials by name, and the bytes of their files.

    Cup and flagstick too, which have no files.
    """
    entries = {
        made.name: {name: value for name, value in made._asdict().items() if name != 'name'}
        for made in (CUP_MATERIAL, FLAGSTICK_MATERIAL)
    }
    sources: dict[str, bytes] = {}
    for path in sorted(share('config', 'materials').glob('*.yaml')):
        sources[path.stem], content = read_yaml(path)
        try:
            entries[path.stem] = entry(content, '')
        except CourseError as error:
            raise CourseError(f'{path}: {error}') from None
    return entries, sources


def materials(value: Any, base: dict[str, Entry]) -> dict[str, Material]:
    """`Material` records by name: those of `base` and a course's own.

    Parameters
    ----------
    value : dict
        The section ``materials`` of a course file.
    base : dict of str to dict
        The shipped entries.
    """
    own = {
        text(name, 'materials: name'): entry(
            content, f'materials.{name}', {**FIELDS, 'like': text}
        )
        for name, content in mapping(value, 'materials').items()
    }
    filled: dict[str, Entry] = {}
    for name in own:
        for step in reversed(_way_to_known(name, own, base, filled)):
            content = dict(own[step])
            like = content.pop('like', step)
            if like == step:
                above = base.get(step, {})
            else:
                above = filled[like] if like in filled else base[like]
            filled[step] = {**above, **content}
    return {name: Material(name=name, **entry) for name, entry in {**base, **filled}.items()}


def _way_to_known(
    name: str, own: dict[str, Entry], base: dict[str, Entry], filled: dict[str, Entry]
) -> list[str]:
    """Names of materials from `name` on, each like the next, up to what is `filled` or shipped.

    A material is like the shipped one of its name where it does not say otherwise.
    """
    way: dict[str, None] = {name: None}  # in order, and found at once
    while True:
        like = own[name].get('like')
        key = below(f'materials.{name}', 'like')
        if like is None or like == name and name in base:
            return list(way)
        if like not in own and like not in base:
            raise unknown(key, like, {*own, *base} - {name})
        if like in way:
            raise CourseError(
                f'{key} {like!r} leads back to itself: {" -> ".join((*way, like))}; '
                'a material may not be like itself'
            )
        if like in filled or like not in own:
            return list(way)
        name = like
        way[name] = None
