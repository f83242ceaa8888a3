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

"""Contact solver of time stepping: projected Gauss-Seidel with friction and warm starting.

Moreau's time stepping. Balls move in straight lines from one instant to the next, so a gap to a
convex part shrinks by no more than its rate says: where no contact closes faster than gap over
step, nothing overlaps at the next instant. So contacts are speculative: they count before they
touch. Projected Gauss-Seidel finds the impulses, starting from those of the step before.
Velocities here are those half-way through a step (leapfrog), and impulses are per mass.
"""

import numpy as np

from .contact_set import add_contact, is_new_normal
from ..collision.ball_gap import position_at, velocity_at
from ..collision.broad_phase import next_node
from ..collision.ground_contact import RESTING_GAP
from ..collision.workspace import CONTACTS, INVOLVED, MOST_NEIGHBOURS
from ..contact.contact_state import contact_material, set_support
from ..effects import gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import (
    BallProperties,
    BallRecord,
    ContactRecord,
    SceneRecord,
    Vector,
    WorkRecord,
)
from ..mechanics.vector import (
    add,
    add_scaled,
    cross,
    dot,
    length,
    load,
    scale,
    store,
    sub,
    tangential,
    unit,
    UP,
    ZERO,
)
from ..state.ball import HOLED, MOST_STORED, moves, NO_PART

TIME_STEP = 1.0 / 512.0  # s; a power of two, so that instants are the same for all
MOST_SWEEPS = 40
CONVERGED = 2e-5  # m/s: a sweep whose greatest impulse changes less is the last
MOST_CORRECTIONS = 10  # sweeps over penetrations
OVERLAP = 1e-7  # m: deeper penetration is corrected
# Least share of gravity along the normal with which a surface is a support, and no wall.
WALL = 1e-3


@kernel
def contact_reach(work: WorkRecord) -> float:
    """Contact margin [m]: what is farther away can't be touched before the next time step."""
    fastest = 0.0
    for k in range(work.counts[INVOLVED]):
        fastest = max(fastest, length(load(work.solver.solved_motion[work.involved[k], 0:3])))
    return RESTING_GAP + 2.0 * TIME_STEP * fastest  # twice: two balls may approach each other


@kernel
def add_ground_contacts(
    land: SceneRecord, ball: BallRecord, i: int, work: WorkRecord, reach: float
) -> None:
    """Add the contacts of ball `i` with the ground within `reach`. Writes contacts."""
    begin = work.counts[CONTACTS]
    place = load(ball['position'])
    low, high = surfaces.around(place, land.ball.radius + reach)
    part = surfaces.next_part(land.ground, 0, low, high)
    while part >= 0:
        distance, normal = surfaces.nearest(land.ground, part, place)
        gap = distance - land.ball.radius
        is_near = gap <= reach and is_new_normal(work, begin, normal)
        if is_near and surfaces.touchable(land.ground, part, place):
            row = add_contact(work, i, -1, part, normal)
            if row >= 0:
                material = contact_material(land, ball, part, normal)
                init_contact(work.contacts[row], gap, material['dynamic_friction'])
                work.contacts[row]['rolling_resistance'] = material['rolling_resistance']
        part = surfaces.next_part(land.ground, part + 1, low, high)


@kernel
def init_contact(row: ContactRecord, gap: float, friction: float) -> None:
    """Initialise a contact without impulse.

    Writes separation, friction, rolling_resistance, normal_impulse, tangent_impulse.
    """
    row['separation'] = gap
    row['friction'] = friction
    row['rolling_resistance'] = 0.0
    row['normal_impulse'] = 0.0
    store(row['tangent_impulse'], ZERO)


@kernel
def neighbours_within(
    balls: np.ndarray, work: WorkRecord, i: int, reach: float, radius: float, now: float
) -> tuple[int, bool]:
    """Count the balls within `reach` of ball `i`; whether others are on their way there.

    Writes neighbours. They are in rising order: Gauss-Seidel depends on the order of contacts,
    which must not depend on the shape of the tree.
    """
    here = load(balls[i]['position'])
    low, high = surfaces.around(here, radius + reach)
    neighbours = work.solver.neighbours
    found = 0
    close_by = False
    at = next_node(work.tree, 0, low, high)
    while at >= 0:
        j = work.tree.nodes[at]['ball']
        at = next_node(work.tree, at + 1, low, high)
        if j == i or balls[j]['phase'] == HOLED:
            continue
        if work.involved_index[j] < 0 and moves(balls[j]['phase']):
            close_by = True
        if (
            found < MOST_NEIGHBOURS
            and length(sub(here, position_at(balls[j], now))) - 2.0 * radius <= reach
        ):
            k = found  # insertion sort
            while k > 0 and neighbours[k - 1] > j:
                neighbours[k] = neighbours[k - 1]
                k -= 1
            neighbours[k] = j
            found += 1
    return found, close_by


@kernel
def add_resting_contact(
    land: SceneRecord, balls: np.ndarray, work: WorkRecord, i: int, j: int, now: float
) -> None:
    """Add the contact of ball `i` with ball `j`, which is involved or asleep. Writes contacts.

    A sleeper is of infinite mass: in the contact it has no `b`, and its number stands in `part` as
    -2 - j.
    """
    apart = sub(load(balls[i]['position']), position_at(balls[j], now))
    row = add_contact(work, i, j if work.involved_index[j] >= 0 else -1, -2 - j, unit(apart, UP))
    if row >= 0:
        init_contact(
            work.contacts[row], length(apart) - 2.0 * land.ball.radius, land.ball.friction
        )


@kernel
def gap_rate(balls: np.ndarray, i: int, j: int, now: float) -> float:
    """Rate [m/s] of the gap between balls `i` and `j`: positive where they separate."""
    normal = unit(sub(load(balls[i]['position']), position_at(balls[j], now)), UP)
    return dot(sub(load(balls[i]['velocity']), velocity_at(balls[j], now)), normal)


@shared
def correct_positions(balls: np.ndarray, work: WorkRecord) -> None:
    """Penetration correction: move balls apart, without changing velocities.

    Position correction by split impulses adds no energy, as Baumgarte's would. Writes position,
    position_change.
    """
    for k in range(work.counts[INVOLVED]):
        store(work.solver.position_change[work.involved[k]], ZERO)
    for sweep in range(MOST_CORRECTIONS):
        if sweep_positions(work, sweep % 2 == 1) <= OVERLAP:
            break
    for k in range(work.counts[INVOLVED]):
        place = balls[work.involved[k]]['position']
        store(place, add(load(place), load(work.solver.position_change[work.involved[k]])))


@kernel
def sweep_positions(work: WorkRecord, backward: bool) -> float:
    """Sweep once over all penetrations; the greatest one [m] before. Writes position_change."""
    most = 0.0
    changes = work.solver.position_change
    count = work.counts[CONTACTS]
    for k in range(count):
        row = work.contacts[count - 1 - k if backward else k]
        normal = load(row['normal'])
        a = changes[row['a']]
        overlap = -row['separation'] - dot(load(a), normal)
        if row['b'] >= 0:
            overlap += dot(load(changes[row['b']]), normal)
        if overlap > 0.0:
            most = max(most, overlap)
            share = 0.5 if row['b'] >= 0 else 1.0
            store(a, add_scaled(load(a), share * overlap, normal))
            if row['b'] >= 0:
                b = changes[row['b']]
                store(b, add_scaled(load(b), -share * overlap, normal))
    return most


@kernel
def contact_partner(row: ContactRecord) -> int:
    """Give the number of what a ball touches: -2 - j for ball j, else a part of the ground."""
    return -2 - row['b'] if row['b'] >= 0 else row['part']


@shared
def warm_start(land: SceneRecord, balls: np.ndarray, work: WorkRecord) -> None:
    """Start from the impulses of the step before.

    Writes normal_impulse, tangent_impulse, solved_motion.
    """
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        ball = balls[row['a']]
        for k in range(ball['stored_count']):
            if ball['stored_partners'][k] == contact_partner(row):
                row['normal_impulse'] = ball['stored_impulses'][k, 0]
                tangent_impulse = load(ball['stored_impulses'][k, 1:4])
                # The normal has turned since: what is left of the old impulse along the new
                # tangent plane.
                store(row['tangent_impulse'], tangential(tangent_impulse, load(row['normal'])))
                apply_normal_impulse(work, row, scale(row['normal_impulse'], load(row['normal'])))
                apply_tangent_impulse(work, row, load(row['tangent_impulse']), land.ball)
                break


@shared
def store_impulses(balls: np.ndarray, work: WorkRecord) -> None:
    """Store the impulses for the next warm start.

    Writes stored_count, stored_partners, stored_impulses.
    """
    for k in range(work.counts[INVOLVED]):
        balls[work.involved[k]]['stored_count'] = 0
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        ball = balls[row['a']]
        k = ball['stored_count']
        if row['normal_impulse'] > 0.0 and k < MOST_STORED:
            ball['stored_partners'][k] = contact_partner(row)
            ball['stored_impulses'][k, 0] = row['normal_impulse']
            store(ball['stored_impulses'][k, 1:4], load(row['tangent_impulse']))
            ball['stored_count'] = k + 1


@kernel
def apply_normal_impulse(work: WorkRecord, row: ContactRecord, change: Vector) -> None:
    """Apply the impulse over mass `change` to both bodies of a contact. Writes solved_motion."""
    a = work.solver.solved_motion[row['a'], 0:3]
    store(a, add(load(a), change))
    if row['b'] >= 0:
        b = work.solver.solved_motion[row['b'], 0:3]
        store(b, sub(load(b), change))


@kernel
def apply_tangent_impulse(
    work: WorkRecord, row: ContactRecord, tangent_impulse: Vector, record: BallProperties
) -> None:
    """Apply the tangential impulse over mass `tangent_impulse` to both bodies of a contact.

    Writes solved_motion.
    """
    apply_normal_impulse(work, row, tangent_impulse)
    spin_change = scale(
        -1.0 / (record.inertia * record.radius), cross(load(row['normal']), tangent_impulse)
    )
    a = work.solver.solved_motion[row['a'], 3:6]
    store(a, add(load(a), spin_change))
    if row['b'] >= 0:
        b = work.solver.solved_motion[row['b'], 3:6]
        store(b, add(load(b), spin_change))


@kernel
def relative_motion(work: WorkRecord, row: ContactRecord) -> tuple[Vector, Vector]:
    """Relative velocity of the two bodies of a contact, and the sum of their spins."""
    velocity = load(work.solver.solved_motion[row['a'], 0:3])
    spin = load(work.solver.solved_motion[row['a'], 3:6])
    if row['b'] >= 0:
        velocity = sub(velocity, load(work.solver.solved_motion[row['b'], 0:3]))
        spin = add(spin, load(work.solver.solved_motion[row['b'], 3:6]))
    return velocity, spin


@shared
def sweep_impulses(land: SceneRecord, work: WorkRecord, backward: bool) -> float:
    """One Gauss-Seidel sweep over all contacts; the greatest change of a normal impulse [m/s].

    Writes solved_motion, normal_impulse, tangent_impulse.
    """
    most = 0.0
    count = work.counts[CONTACTS]
    grip = land.ball.inertia / (1.0 + land.ball.inertia)
    for k in range(count):
        # Sweeps alternate in direction, so that no end of a pile is always solved last.
        row = work.contacts[count - 1 - k if backward else k]
        normal = load(row['normal'])
        share = 0.5 if row['b'] >= 0 else 1.0  # reduced mass over mass
        velocity, spin = relative_motion(work, row)
        rate = dot(velocity, normal)
        # The accumulated impulse is clamped, not its change; the gap may close within the step, no
        # further.
        needed = max(
            row['normal_impulse'] - share * (rate + max(row['separation'], 0.0) / TIME_STEP), 0.0
        )
        change = needed - row['normal_impulse']
        if change != 0.0:
            row['normal_impulse'] = needed
            apply_normal_impulse(work, row, scale(change, normal))
            most = max(most, abs(change))
        before = load(row['tangent_impulse'])
        if needed > 0.0 or dot(before, before) > 0.0:
            sliding = sub(
                add_scaled(velocity, -rate, normal), scale(land.ball.radius, cross(spin, normal))
            )
            tangent_impulse = add_scaled(before, -share * grip, sliding)
            size = length(tangent_impulse)
            # Projection onto Coulomb's cone: a disc, not a pyramid, so that friction has no
            # preferred axes.
            if size > row['friction'] * needed:
                tangent_impulse = scale(row['friction'] * needed / size, tangent_impulse)
            apply_tangent_impulse(work, row, sub(tangent_impulse, before), land.ball)
            store(row['tangent_impulse'], tangent_impulse)
    return most


@shared
def solve_contacts(land: SceneRecord, balls: np.ndarray, work: WorkRecord) -> None:
    """Solve all contacts by Gauss-Seidel sweeps.

    Writes normal_impulse, tangent_impulse, warm_start, solved_motion.
    """
    warm_start(land, balls, work)
    for sweep in range(MOST_SWEEPS):
        if sweep_impulses(land, work, sweep % 2 == 1) <= CONVERGED:
            break
    store_impulses(balls, work)


@kernel
def write_back(ball: BallRecord, work: WorkRecord, i: int) -> None:
    """Bring ball `i` to its solved motion, without support yet: `count_support` fills that in.

    Writes velocity, spin, contact, held_by, rolling_loss.
    """
    store(ball['velocity'], load(work.solver.solved_motion[i, 0:3]))
    store(ball['spin'], load(work.solver.solved_motion[i, 3:6]))
    ball['rolling_loss'] = 0.0
    ball['held_by'] = 0
    store(ball['normal'], ZERO)
    ball['support'] = NO_PART


@kernel
def is_pressed_by_gravity(land: SceneRecord, ball: BallRecord, normal: Vector) -> bool:
    """Whether gravity presses the ball onto a surface of `normal`.

    Then it is a support, not a wall or a ceiling.
    """
    weight = gravity_at(land.effects, load(ball['position']))
    return -dot(weight, normal) > WALL * length(weight)


@kernel
def count_support(land: SceneRecord, balls: np.ndarray, row: ContactRecord) -> None:
    """Count a contact that presses or nearly touches as support of its balls.

    The most level surface is what the ball is on. Writes held_by, rolling_loss, contact.
    """
    if row['normal_impulse'] <= 0.0 and row['separation'] > RESTING_GAP:
        return
    ball = balls[row['a']]
    normal = load(row['normal'])
    if row['part'] < 0:  # a ball counts twice: only a single contact with the ground sums to 1
        ball['held_by'] += 2
        if row['b'] >= 0:
            balls[row['b']]['held_by'] += 2
        return
    ball['held_by'] += 1
    ball['rolling_loss'] += row['rolling_resistance'] * row['normal_impulse']
    if is_pressed_by_gravity(land, ball, normal) and normal[2] > ball['normal'][2]:
        set_support(land, ball, surfaces.support_of(land.ground, row['part']), normal)


@kernel
def limit_speed(ball: BallRecord, speed: float) -> None:
    """Scale the ball's velocity to `speed` [m/s], and its spin by the same factor.

    Writes motion.
    """
    before = length(load(ball['velocity']))
    if before > 0.0:
        store(ball['velocity'], scale(speed / before, load(ball['velocity'])))
        store(ball['spin'], scale(speed / before, load(ball['spin'])))
