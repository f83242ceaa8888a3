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

"""Impulse of a frictional impact: ball against ground, ball against ball, ball against obstacle.

Normal: (1 + e) times the approach (Newton's restitution). Tangential: what stops the slip, times
one plus the tangential restitution, at most dynamic friction times the normal impulse (Coulomb).
Fixed ground has no inverse mass.
"""

from typing import NamedTuple

from .vector import add_scaled, cross, dot, length, load, scale, store
from ..jit import kernel
from ..kernel_types import BallProperties, BallRecord, Vector


class ContactProperties(NamedTuple):
    """Properties of a pair in contact.

    ``restitution``, ``tangential`` restitution, ``friction``; ``mass``: 1 / (1/m1 + 1/m2) [kg];
    ``inertia``: moment of inertia over m r^2.
    """

    restitution: float
    tangential: float
    friction: float
    mass: float
    inertia: float


@kernel
def slip(velocity: Vector, spin: Vector, normal: Vector, radius: float) -> Vector:
    """Slip [m/s]: tangential velocity of the ball's material point at the contact of `normal`."""
    return add_scaled(
        add_scaled(velocity, -dot(velocity, normal), normal), -radius, cross(spin, normal)
    )


@kernel
def friction(bond: ContactProperties, strength: float, sliding: Vector) -> Vector:
    """Coulomb friction: tangential impulse [N s] against the slip `sliding`.

    `strength` [N s] is the normal impulse.
    """
    # A tangential impulse turns the ball, too: the effective mass at the contact point is
    # k / (1 + k) of the mass, with k the moment of inertia over m r^2.
    grip = (1.0 + bond.tangential) * bond.mass * bond.inertia / (1.0 + bond.inertia)
    needed = grip * length(sliding)
    if needed > bond.friction * strength:
        grip *= bond.friction * strength / needed
    return scale(-grip, sliding)


@kernel
def impulse(
    bond: ContactProperties, velocity: Vector, spin: Vector, normal: Vector, radius: float
) -> Vector:
    """Impulse [N s] on a ball that hits a surface of `normal` at the relative velocity `velocity`.

    For two balls `spin` is the sum of both spins: each turns its own surface at the contact.
    """
    strength = max(-(1.0 + bond.restitution) * bond.mass * dot(velocity, normal), 0.0)
    return add_scaled(
        friction(bond, strength, slip(velocity, spin, normal, radius)), strength, normal
    )


@kernel
def after_impulse(
    velocity: Vector, spin: Vector, given: Vector, normal: Vector, record: BallProperties
) -> tuple[Vector, Vector]:
    """Velocity and spin after the impulse `given` [N s] at the contact point of `normal`."""
    turn = scale(-record.radius, cross(normal, given))
    inertia = record.inertia * record.mass * record.radius * record.radius
    return (add_scaled(velocity, 1.0 / record.mass, given), add_scaled(spin, 1.0 / inertia, turn))


@kernel
def apply_impulse(ball: BallRecord, given: Vector, normal: Vector, record: BallProperties) -> None:
    """Apply the impulse `given` [N s] at the contact point of `normal`. Writes velocity, spin."""
    velocity, spin = after_impulse(
        load(ball['velocity']), load(ball['spin']), given, normal, record
    )
    store(ball['velocity'], velocity)
    store(ball['spin'], spin)
