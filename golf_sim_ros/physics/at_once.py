# SPDX-License-Identifier: Apache-2.0
"""Impacts with several surfaces at one instant, whatever order they are stored in.

Generalized reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous
Impact", ACM Trans. Graph. 31 (2012) 106): all approaching contacts are projected out together with
non-negative impulses, each impulse counts 1 + e times, and that is repeated until none approaches.
"""
from typing import NamedTuple

from ._compile import kernel, shared
from .contact import material_of
from .ground import surface
from .impulse import slip
from .material import restitution
from .vector import ZERO, add, along, cross, dot, length, put, scale, vector

TOGETHER = 1e-9  # m: surfaces that near are touched at the same instant
SAME = 1e-9  # 1 - cosine of the angle below which two normals are one
ROUNDS = 50
SWEEPS = 200


class Touched(NamedTuple):
    """Up to three surfaces that a ball touches: how many, their parts, their normals."""

    count: int
    parts: tuple
    normals: tuple


@shared
def touched(ground, ball, radius, normal):
    """`Touched` of the ball's target, which has `normal`, and what else it approaches."""
    place = vector(ball['position'])
    found = Touched(1, (ball['target'], -1, -1), (normal, ZERO, ZERO))
    low, high = surface.around(place, radius + TOGETHER)
    part = surface.next_part(ground, 0, low, high)
    while part >= 0 and found.count < 3:
        distance, other = surface.nearest(ground, part, place)
        if (distance - radius <= TOGETHER and dot(vector(ball['velocity']), other) < 0.0
                and is_new(found, other) and surface.touchable(ground, part, place)):
            a, b, _ = found.parts
            n, m, _ = found.normals
            if found.count == 1:
                found = Touched(2, (a, part, -1), (n, other, ZERO))
            else:
                found = Touched(3, (a, b, part), (n, m, other))
        part = surface.next_part(ground, part + 1, low, high)
    return found


@kernel
def is_new(found, normal):
    """Whether `normal` is none of those found."""
    for i in range(found.count):
        if dot(found.normals[i], normal) > 1.0 - SAME:
            return False
    return True


@shared
def reflect(land, ball, contacts):
    """Let the ball bounce off all `contacts` at once. Writes velocity and spin."""
    for _ in range(ROUNDS):
        v = vector(ball['velocity'])
        pushes = projection(v, contacts)
        if length(pushes) <= 1e-12 * length(v):
            break
        after = v
        for i in range(contacts.count):
            material = material_of(land, ball, contacts.parts[i], contacts.normals[i])
            e = restitution(material, max(-dot(v, contacts.normals[i]), 0.0))
            after = along(after, (1.0 + e) * pushes[i], contacts.normals[i])
        put(ball['velocity'], after)
        grip(land, ball, contacts, pushes)


@kernel
def projection(v, contacts):
    """Speeds, one a contact, that are least in sum of squares and stop all approach of `v`."""
    pushes = (0.0, 0.0, 0.0)
    for _ in range(SWEEPS):
        changed = 0.0
        for i in range(contacts.count):
            push = max(pushes[i] - dot(v, contacts.normals[i]), 0.0)
            change = push - pushes[i]
            v = along(v, change, contacts.normals[i])
            changed = max(changed, abs(change))
            pushes = (push if i == 0 else pushes[0], push if i == 1 else pushes[1],
                      push if i == 2 else pushes[2])
        if changed <= 1e-14 * (length(v) + length(pushes)):
            break
    return pushes


@kernel
def grip(land, ball, contacts, pushes):
    """Apply friction of all contacts, each for its share, after normal impulses of `pushes` [m/s]."""
    v = vector(ball['velocity'])
    w = vector(ball['spin'])
    k = land.ball.inertia
    r = land.ball.radius
    kick = ZERO
    turn = ZERO
    for i in range(contacts.count):
        normal = contacts.normals[i]
        material = material_of(land, ball, contacts.parts[i], contacts.normals[i])
        sliding = slip(v, w, normal, r)
        needed = (1.0 + material['tangential_restitution']) * k / (1.0 + k) * length(sliding)
        most = material['dynamic_friction'] * pushes[i]
        if needed == 0.0 or pushes[i] == 0.0:
            continue
        push = scale(-min(needed, most) / length(sliding) / contacts.count, sliding)
        kick = add(kick, push)
        turn = add(turn, scale(-1.0 / (k * r), cross(normal, push)))
    put(ball['velocity'], add(v, kick))
    put(ball['spin'], add(w, turn))
