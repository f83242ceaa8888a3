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

"""Effects: one file each, discovered on import; a scene gets those that it needs.

A file of this folder that defines ``record(scene)`` and ``idle(scene)`` is an effect, named after
the file. ``record`` gives the effect's record for a scene; ``idle`` gives the reason why the scene
can do without it, or '' if it can't. An idle effect does not run and is not compiled in. Where the
file defines ``dormant(scene)`` too, a record of the same type that does nothing, a compiled
`World` keeps that instead: so one program serves every course, and nothing compiles when the
effect is switched on. A file with ``INSTEAD_OF``, names of effects, is another model of the same:
a scene gets it only by name. Other packages add theirs with :func:`register_effect`.
"""

from difflib import get_close_matches
import importlib
import inspect
import pkgutil
from typing import Callable, NamedTuple, Optional

from . import protocol
from ..jit import kernel, literal_unroll
from ..mechanics.vector import add, length, sub, ZERO


class Scene(NamedTuple):
    """Scene that effects are chosen for: a course, the number of balls, and the wind at 10 m [m/s]."""

    course: NamedTuple
    balls: int = 1
    wind: tuple = ZERO


class Effect(NamedTuple):
    """Known effect: how to build its record and its dormant record, and when a scene can do without it.

    ``instead_of``: names of the effects to which it is an alternative; such a one is never
    automatic.
    """

    record: Callable
    idle: Callable
    doc: str
    dormant: Optional[Callable] = None
    instead_of: tuple = ()


class Chosen(NamedTuple):
    """Effects that a scene gets, records by name; reasons of those left out.

    ``needless``: reasons of those that were asked for by name and that the scene can't have.
    """

    on: dict
    off: dict
    needless: dict

    @property
    def records(self):
        """Records of the effects that the scene gets."""
        return tuple(self.on.values())

    def with_dormant(self, scene):
        """`records`, with the dormant record, in its place, of each effect that has one and is off.

        The types are then the same for every scene, but for laws asked for by name.
        """
        found = (
            (name, self.on.get(name) or effect.dormant and effect.dormant(scene))
            for name, effect in EFFECTS.items()
            if name in self.on or not effect.instead_of
        )
        return tuple(record for _, record in found if record)


EFFECTS = {}


def register_effect(name, record, idle, doc, dormant=None, instead_of=()):
    """Register an effect as `name`; see the module's docstring for the other parameters."""
    if name in EFFECTS:
        raise ValueError(f'effect {name!r} is already registered')
    EFFECTS[name] = Effect(record, idle, doc, dormant, tuple(instead_of))


def choose(names, scene):
    """Effects that `scene` gets, and the reasons why it does without the others.

    Parameters
    ----------
    names : 'auto' or sequence of str
        The effects asked for.
    scene : Scene

    Returns
    -------
    Chosen

    Raises
    ------
    ValueError
        Naming the unknown effect and the known ones, or two that are laws for the same.
    """
    names = (names,) if isinstance(names, str) else tuple(names)
    auto = names == ('auto',)
    check(() if auto else names)
    on, off = {}, {}
    for name, effect in EFFECTS.items():
        asked = not effect.instead_of if auto else name in names
        if effect.instead_of and not asked:
            continue
        reason = effect.idle(scene) if auto else '' if asked else 'not asked for'
        if reason:
            off[name] = reason
        else:
            on[name] = effect.record(scene)
    return Chosen(on, off, {} if auto else needless(names, scene))


def check(names):
    """Check that `names` are effects that can act together; ValueError where they are not."""
    laws_of = {}
    for name in names:
        if name == 'auto':
            raise ValueError(
                f'effects {", ".join(names)}: auto stands alone, for all that a scene calls for'
            )
        if name not in EFFECTS:
            close = get_close_matches(name, EFFECTS, 1)
            hint = f'; did you mean {close[0]!r}?' if close else ''
            raise ValueError(
                f'effect {name!r} is unknown; known: auto, {", ".join(sorted(EFFECTS))}{hint}'
            )
        for law in EFFECTS[name].instead_of or (name,):
            if laws_of.setdefault(law, name) != name:
                raise ValueError(
                    f'effects {laws_of[law]!r} and {name!r} are two laws for the same; name one'
                )


def needless(names, scene):
    """Reasons, by name, of those of `names` that `scene` can't have, whatever wind may come."""
    windy = scene._replace(wind=(1.0, 0.0, 0.0))
    reasons = {name: EFFECTS[name].idle(windy) for name in names}
    return {name: reason for name, reason in reasons.items() if reason}


@kernel
def wind_at(effects, ground, position):
    """Velocity of the air at `position`."""
    wind = ZERO
    for effect in literal_unroll(effects):
        wind = add(wind, protocol.air_velocity(effect, ground, position))
    return wind


@kernel
def gravity_at(effects, position):
    """Gravitational acceleration [m/s^2] of every ball at `position`."""
    total = ZERO
    for effect in literal_unroll(effects):
        total = add(total, protocol.gravity(effect, position))
    return total


@kernel
def airflow(effects, ground, position, velocity, spin):
    """`Flow` of the air around a ball in flight."""
    through_air = sub(velocity, wind_at(effects, ground, position))
    return protocol.Flow(through_air, length(through_air), spin, position, velocity)


@kernel
def flight_rates(effects, ground, position, velocity, spin):
    """Acceleration and angular acceleration of a ball in flight."""
    flow = airflow(effects, ground, position, velocity, spin)
    force = ZERO
    torque = ZERO
    for effect in literal_unroll(effects):
        force = add(
            force, add(protocol.gravity(effect, position), protocol.acceleration(effect, flow))
        )
        torque = add(torque, protocol.spin_rate(effect, flow))
    return force, torque


@kernel
def sinking(effects, position, velocity):
    """Acceleration of a ball under water."""
    weight = gravity_at(effects, position)
    force = weight
    for effect in literal_unroll(effects):
        force = add(force, protocol.under_water(effect, weight, velocity))
    return force


@kernel
def longest_allowed_step(effects, ground, state, force, wanted):
    """Longest step [s], `wanted` at most, that can't overlook any effect.

    For a ball in flight whose `state` is position, velocity and spin, and its acceleration `force`
    [m/s^2].
    """
    flow = airflow(effects, ground, *state)
    for effect in literal_unroll(effects):
        wanted = protocol.longest_step(effect, ground, flow, force, wanted)
    return wanted


@kernel
def set_wind(effects, wind):
    """Set the wind [m/s at 10 m]. Writes into the effects' records."""
    for effect in literal_unroll(effects):
        protocol.set_wind(effect, wind)


@kernel
def effective_normal(effects, normal, velocity, softness):
    """Effective contact normal of a ball that hits ground of `normal` and `softness` at `velocity`."""
    for effect in literal_unroll(effects):
        normal = protocol.contact_normal(effect, normal, velocity, softness)
    return normal


@kernel
def velocity_after(effects, hit, velocity):
    """Velocity of a ball after a `hit` that without the effects would leave at `velocity`."""
    for effect in literal_unroll(effects):
        velocity = protocol.departure(effect, hit, velocity)
    return velocity


def _discover():
    for module in pkgutil.iter_modules(__path__):
        found = importlib.import_module(f'{__name__}.{module.name}')
        if hasattr(found, 'record'):
            register_effect(
                module.name,
                found.record,
                found.idle,
                inspect.getdoc(found).splitlines()[0],
                getattr(found, 'dormant', None),
                getattr(found, 'INSTEAD_OF', ()),
            )


_discover()
