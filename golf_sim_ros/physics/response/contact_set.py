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

"""Contact set of one instant: the involved balls, and their contacts with the ground and others.

A contact set is one island: it starts with one ball and grows by whatever its balls touch.
"""

import numpy as np

from ..collision import ball_interactions
from ..collision.ball_gap import position_at, velocity_at
from ..collision.broad_phase import next_node
from ..collision.workspace import CONTACTS, INVOLVED, MultiBallWorkspace
from ..contact.contact_state import contact_material
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import (
    BallRecord,
    ContactRecord,
    MaterialRecord,
    SceneRecord,
    Vector,
    WorkRecord,
)
from ..mechanics.vector import dot, length, load, store, sub, unit, UP, ZERO
from ..properties.material import restitution
from ..state.ball import FLIGHT, HOLED, moves, STEP_END
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.segment import spin as spin_at
from ..trajectory.shot_record import update_apex

SIMULTANEOUS_GAP = 1e-9  # m: a gap that small counts as contact at the same instant
# 1 - cosine of the angle below which two normals are one: seams give no second contact
SAME_NORMAL = 1e-9
MOST_MEMBERS = 64  # involved balls of an impact


@kernel
def synchronize(ball: BallRecord, now: float) -> None:
    """Bring a ball to `now` and end its segment there. Writes motion, end, ending, apex."""
    if not moves(ball['phase']):
        return
    ball['end'] = now
    ball['ending'] = STEP_END
    update_apex(ball)
    time = now - ball['begin']
    place = position_at(ball, now)
    velocity = velocity_at(ball, now)
    turning = spin_at(ball, time)
    store(ball['position'], place)
    store(ball['velocity'], velocity)
    store(ball['spin'], turning)


@shared
def collect_contacts(
    land: SceneRecord, balls: np.ndarray, work: WorkRecord, now: float, known: int
) -> None:
    """Collect the contacts of the involved balls and of all that they touch.

    Those are brought to the present. The first `known` balls have their contacts with the ground
    already. Writes contacts, involved, motion, end, ending, apex.
    """
    k = 0
    while k < work.counts[INVOLVED]:
        i = work.involved[k]
        if k >= known:
            collect_ground_contacts(
                land, balls[i], i, work, 0 if k == 0 else work.counts[CONTACTS]
            )
        if not balls[i]['time_stepping']:  # a pile passes an impulse on in its next time step
            ball_interactions.collect_ball_contacts(work, land, balls, i, now)
        k += 1


@kernel
def add_to_set(work: WorkRecord, i: int) -> None:
    """Add ball `i`, which has been brought to the present, to the involved balls.

    Writes involved.
    """
    work.involved_index[i] = work.counts[INVOLVED]
    work.involved[work.counts[INVOLVED]] = i
    work.counts[INVOLVED] += 1


@kernel
def clear_set(work: WorkRecord) -> None:
    """Empty the contact set. Writes counts, involved_index."""
    for k in range(work.counts[INVOLVED]):
        work.involved_index[work.involved[k]] = -1
    work.counts[INVOLVED] = 0
    work.counts[CONTACTS] = 0


@kernel
def add_contact(work: WorkRecord, a: int, b: int, part: int, normal: Vector) -> int:
    """Add a contact of ball `a` with ball `b`, or with a part of the ground.

    Its row, or -1 when full.

    Writes contacts.
    """
    n = work.counts[CONTACTS]
    if n == len(work.contacts):
        return -1
    work.counts[CONTACTS] += 1
    row = work.contacts[n]
    row['a'] = a
    row['b'] = b
    row['part'] = part
    row['normal_impulse'] = 0.0
    row['approach_speed'] = 0.0
    store(row['normal'], normal)
    store(row['impulse'], ZERO)
    return n


@ball_interactions.collect_ball_contacts.register(MultiBallWorkspace)
def _collect_ball_contacts(
    work: MultiBallWorkspace, land: SceneRecord, balls: np.ndarray, i: int, now: float
) -> None:
    k = work.involved_index[i]
    radius = land.ball.radius
    here = load(balls[i]['position'])
    low, high = surfaces.around(here, radius + SIMULTANEOUS_GAP)
    at = next_node(work.tree, 0, low, high)
    while at >= 0:
        j = work.tree.nodes[at]['ball']
        at = next_node(work.tree, at + 1, low, high)
        # A ball that is involved before this one has added the contact of the two already.
        if j == i or balls[j]['phase'] == HOLED or 0 <= work.involved_index[j] < k:
            continue
        apart = sub(here, position_at(balls[j], now))
        if length(apart) - 2.0 * radius > SIMULTANEOUS_GAP:
            continue
        if work.involved_index[j] < 0:
            if work.counts[INVOLVED] == MOST_MEMBERS:
                continue
            add_to_set(work, j)
            synchronize(balls[j], now)
        add_ball_contact(land, balls, i, j, work, now)


@kernel
def add_ball_contact(
    land: SceneRecord, balls: np.ndarray, i: int, j: int, work: WorkRecord, now: float
) -> None:
    """Add the contact of balls `i` and `j`. Writes contacts."""
    n = add_contact(
        work, i, j, -1, unit(sub(position_at(balls[i], now), position_at(balls[j], now)), UP)
    )
    if n >= 0:
        row = work.contacts[n]
        row['restitution'] = land.ball.restitution
        row['tangential_restitution'] = 0.0
        row['friction'] = land.ball.friction
        row['mass'] = 0.5 * land.ball.mass  # reduced mass of two equal balls


@kernel
def collect_ground_contacts(
    land: SceneRecord, ball: BallRecord, i: int, work: WorkRecord, begin: int
) -> None:
    """Add the contacts of ball `i` with the ground, its support first. Writes contacts.

    The ball's own contacts start at row `begin`.
    """
    # One contact for each normal: coplanar parts, and faces that share the touched edge, count
    # once.
    ground = land.ground
    place = load(ball['position'])
    if (
        ball['support'] >= 0
        and ball['phase'] != FLIGHT
        and is_new_normal(work, begin, load(ball['normal']))
    ):
        normal = load(ball['normal'])
        material = contact_material(land, ball, ball['support'], normal)
        add_ground_contact(land, ball, i, (ball['support'], normal), material, work)
    low, high = surfaces.around(place, land.ball.radius + SIMULTANEOUS_GAP)
    part, last, _ = surfaces.parts_within(ground, low, high, surfaces.ALL_PARTS)
    while part >= 0:
        distance, normal = surfaces.nearest(ground, part, place)
        if (
            distance - land.ball.radius <= SIMULTANEOUS_GAP
            and is_new_normal(work, begin, normal)
            and (surfaces.touchable(ground, part, place))
        ):
            material = contact_material(land, ball, part, normal)
            add_ground_contact(land, ball, i, (part, normal), material, work)
        part = surfaces.part_after(ground, part, last, low, high)


@kernel
def is_new_normal(work: WorkRecord, begin: int, normal: Vector) -> bool:
    """Whether no contact from row `begin` on has this `normal`."""
    for n in range(begin, work.counts[CONTACTS]):
        if dot(load(work.contacts[n]['normal']), normal) > 1.0 - SAME_NORMAL:
            return False
    return True


@kernel
def add_ground_contact(
    land: SceneRecord,
    ball: BallRecord,
    i: int,
    touched: tuple[int, Vector],
    material: MaterialRecord,
    work: WorkRecord,
) -> None:
    """Add the contact of ball `i` with what it touches, a part and its normal, of that `material`.

    Writes contacts.
    """
    part, normal = touched
    n = add_contact(work, i, -1, part, normal)
    if n < 0:
        return
    row = work.contacts[n]
    row['restitution'] = restitution(material, max(-dot(load(ball['velocity']), normal), 0.0))
    row['tangential_restitution'] = material['tangential_restitution']
    row['friction'] = material['dynamic_friction']
    row['mass'] = land.ball.mass


@kernel
def separation_rate(balls: np.ndarray, row: ContactRecord) -> float:
    """Relative velocity [m/s] of a contact along its normal: positive where it separates."""
    normal = load(row['normal'])
    rate = dot(load(balls[row['a']]['velocity']), normal)
    if row['b'] >= 0:
        rate -= dot(load(balls[row['b']]['velocity']), normal)
    return rate


@kernel
def count_approaching(balls: np.ndarray, work: WorkRecord) -> int:
    """Count the approaching contacts.

    The support of a rolling ball approaches only by rounding.
    """
    found = 0
    for n in range(work.counts[CONTACTS]):
        found += separation_rate(balls, work.contacts[n]) < -LEAST_SPEED
    return found
