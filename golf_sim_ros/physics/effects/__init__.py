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
effect is switched on; None where the course can't have it. A file with ``INSTEAD_OF``, names of
effects, is another model of the same: a scene gets it only by name; one with ``SAME_AS`` is
another, too, that the scene chooses. What of an effect may change while balls move is its
``LIVE``, a `Live` of :mod:`.protocol`; `record` and `idle` read it by ``scene.live_value``. Other
packages add their effects with :func:`register_effect`, and such parameters to `LIVE`.
"""

from difflib import get_close_matches
import importlib
import inspect
import pkgutil
from types import MappingProxyType
from typing import Callable, Iterable, Mapping, NamedTuple, Optional, Sequence, Union

from . import protocol
from ..geometry.surfaces import Ground, in_cup
from ..jit import kernel, literal_unroll
from ..kernel_types import CourseRecord, EffectRecord, Effects, Vector
from ..mechanics.vector import add, length, sub, ZERO

EffectNames = Union[str, Iterable[str]]  # what is asked for: 'auto', or names


class Scene(NamedTuple):
    """Scene that effects are chosen for.

    A course, the number of balls, and live parameters by their effects' names.
    """

    course: CourseRecord
    balls: int = 1
    live: Mapping[str, tuple[float, ...]] = MappingProxyType({})

    def live_value(self, effect: str) -> tuple[float, ...]:
        """Live parameter of that `effect`, its default where it was not set."""
        return self.live.get(effect, LIVE[effect].default)


class Effect(NamedTuple):
    """Known effect: how to build its record and its dormant one, and when a scene needs none.

    ``instead_of``: names of the effects to which it is an alternative; such a one is never
    automatic. ``same_as``: those in whose place it acts in the scenes that it is automatic in.
    """

    record: Callable[[Scene], EffectRecord]
    idle: Callable[[Scene], str]
    doc: str
    dormant: Optional[Callable[[Scene], Optional[EffectRecord]]] = None
    instead_of: tuple[str, ...] = ()
    same_as: tuple[str, ...] = ()


class Chosen(NamedTuple):
    """Effects that a scene gets, records by name; reasons of those left out.

    ``needless``: reasons of those that were asked for by name and that the scene can't have.
    """

    on: dict[str, EffectRecord]
    off: dict[str, str]
    needless: dict[str, str]

    @property
    def records(self) -> Effects:
        """Records of the effects that the scene gets."""
        return tuple(self.on.values())

    def with_dormant(self, scene: Scene) -> Effects:
        """Return `records`, with the dormant one, in its place, of each effect that is off.

        Effects that are off and have none are left out. The types are then the same for every
        scene, but for laws asked for by name.
        """
        found = (
            (name, self.on.get(name) or effect.dormant and effect.dormant(scene))
            for name, effect in EFFECTS.items()
            if name in self.on or not effect.instead_of
        )
        return tuple(record for _, record in found if record)


EFFECTS: dict[str, Effect] = {}
LIVE: dict[str, protocol.Live] = {}  # live parameters, by their effects' names


def register_effect(
    name: str,
    record: Callable[[Scene], EffectRecord],
    idle: Callable[[Scene], str],
    doc: str,
    dormant: Optional[Callable[[Scene], EffectRecord]] = None,
    instead_of: Sequence[str] = (),
) -> None:
    """Register an effect as `name`; see the module's docstring for the other parameters."""
    if name in EFFECTS:
        raise ValueError(f'effect {name!r} is already registered')
    EFFECTS[name] = Effect(record, idle, doc, dormant, tuple(instead_of))


def choose(names: EffectNames, scene: Scene) -> Chosen:
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
    check_in(() if auto else names, scene)
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


def check(names: Iterable[str]) -> None:
    """Check that `names` are effects that can act together; ValueError where they are not."""
    laws_of: dict[str, str] = {}
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


def check_in(names: Iterable[str], scene: Scene) -> None:
    """Check that `names` are not two laws for the same in this `scene`; ValueError if they are."""
    for name in names:
        twice = set(EFFECTS[name].same_as) & set(names)
        if twice and not EFFECTS[name].idle(in_wind(scene)):
            raise ValueError(
                f'effects {min(twice)!r} and {name!r} are two laws for the same here; name one'
            )


def in_wind(scene: Scene) -> Scene:
    """`scene` when some wind blows."""
    return scene._replace(live={**scene.live, 'wind': (1.0, 0.0, 0.0)})


def needless(names: Iterable[str], scene: Scene) -> dict[str, str]:
    """Reasons, by name, of those of `names` that `scene` can't have, whatever changes in it.

    An effect with a live parameter may be called for at any time, and wind may come.
    """
    windy = in_wind(scene)
    reasons = {name: EFFECTS[name].idle(windy) for name in names if name not in LIVE}
    return {name: reason for name, reason in reasons.items() if reason}


@kernel
def wind_at(effects: Effects, ground: Ground, position: Vector) -> Vector:
    """Velocity of the air at `position`."""
    wind = ZERO
    for effect in literal_unroll(effects):
        wind = add(wind, protocol.air_velocity(effect, ground, position))
    return wind


@kernel
def gravity_at(effects: Effects, position: Vector) -> Vector:
    """Gravitational acceleration [m/s^2] of every ball at `position`."""
    total = ZERO
    for effect in literal_unroll(effects):
        total = add(total, protocol.gravity(effect, position))
    return total


@kernel
def airflow(
    effects: Effects, ground: Ground, position: Vector, velocity: Vector, spin: Vector
) -> protocol.Flow:
    """`Flow` of the air around a ball in flight."""
    through_air = sub(velocity, wind_at(effects, ground, position))
    return protocol.Flow(through_air, length(through_air), spin, position, velocity)


@kernel
def flight_rates(
    effects: Effects, ground: Ground, position: Vector, velocity: Vector, spin: Vector
) -> tuple[Vector, Vector]:
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
def moving_air(
    effects: Effects, ground: Ground, position: Vector, velocity: Vector, spin: Vector
) -> Vector:
    """Acceleration of a ball in contact by moving air, less that by still air.

    What still air does to a ball on the ground is in its rolling resistance, as a stimpmeter
    measures it. In the hole the air is still.
    """
    wind = wind_at(effects, ground, position)
    if wind == ZERO or len(ground.hole) > 0 and in_cup(ground.hole, position):
        return ZERO
    through = sub(velocity, wind)
    blown = protocol.Flow(through, length(through), spin, position, velocity)
    still = protocol.Flow(velocity, length(velocity), spin, position, velocity)
    force = ZERO
    for effect in literal_unroll(effects):
        more = sub(protocol.acceleration(effect, blown), protocol.acceleration(effect, still))
        force = add(force, more)
    return force


@kernel
def sinking(effects: Effects, position: Vector, velocity: Vector) -> Vector:
    """Acceleration of a ball under water."""
    weight = gravity_at(effects, position)
    force = weight
    for effect in literal_unroll(effects):
        force = add(force, protocol.under_water(effect, weight, velocity))
    return force


@kernel
def longest_allowed_step(
    effects: Effects,
    ground: Ground,
    state: tuple[Vector, Vector, Vector],
    force: Vector,
    wanted: float,
) -> float:
    """Longest step [s], `wanted` at most, that can't overlook any effect.

    For a ball in flight whose `state` is position, velocity and spin, and its acceleration `force`
    [m/s^2].
    """
    flow = airflow(effects, ground, *state)
    for effect in literal_unroll(effects):
        wanted = protocol.longest_step(effect, ground, flow, force, wanted)
    return wanted


@kernel
def at_time(effects: Effects, time: float) -> None:
    """Tell the effects which `time` [s] they are asked about next. Writes into their records."""
    for effect in literal_unroll(effects):
        protocol.at_time(effect, time)


@kernel
def set_drift(effects: Effects, drift: Vector) -> None:
    """Set how far the wind has carried the air; see `protocol.set_drift`.

    Writes into the effects' records.
    """
    for effect in literal_unroll(effects):
        protocol.set_drift(effect, drift)


@kernel
def effective_normal(
    effects: Effects, normal: Vector, velocity: Vector, softness: float
) -> Vector:
    """Effective contact normal of a ball that hits ground at `velocity`.

    The ground has a `normal` and a `softness`.
    """
    for effect in literal_unroll(effects):
        normal = protocol.contact_normal(effect, normal, velocity, softness)
    return normal


@kernel
def velocity_after(effects: Effects, hit: protocol.Hit, velocity: Vector) -> Vector:
    """Velocity of a ball after a `hit` that without the effects would leave at `velocity`."""
    for effect in literal_unroll(effects):
        velocity = protocol.departure(effect, hit, velocity)
    return velocity


def _discover() -> None:
    for module in pkgutil.iter_modules(__path__):
        found = importlib.import_module(f'{__name__}.{module.name}')
        if hasattr(found, 'record'):
            register_effect(
                module.name,
                found.record,
                found.idle,
                (inspect.getdoc(found) or '').partition('\n')[0],
                getattr(found, 'dormant', None),
                getattr(found, 'INSTEAD_OF', ()),
            )
            known = EFFECTS[module.name]
            EFFECTS[module.name] = known._replace(same_as=getattr(found, 'SAME_AS', ()))
            if hasattr(found, 'LIVE'):
                LIVE[module.name] = found.LIVE


_discover()
