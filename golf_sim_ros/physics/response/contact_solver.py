# SPDX-License-Identifier: Apache-2.0
"""Contact solver of time stepping: impulses that keep every gap open for one more step, with friction.

Moreau's time stepping. Balls move in straight lines from one instant to the next, so a gap to what is
convex shrinks by no more than its rate says: where no contact closes faster than gap over step, nothing
overlaps at the next instant. Projected Gauss-Seidel finds the impulses, beginning with those of the step
before. Velocities here are those half-way through a step (leapfrog), and impulses are per mass.
"""
from ..collision.ball_gap import position_at, velocity_at
from ..collision.broad_phase import next_node
from ..collision.ground_contact import RESTING_GAP
from ..collision.workspace import CONTACTS, INVOLVED, MOST_NEIGHBOURS
from ..contact.contact_state import contact_material, set_support
from ..effects import gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.vector import (UP, ZERO, add, add_scaled, cross, dot, length, store, scale, sub, tangential,
                                unit, load)
from ..state.ball import HOLED, NO_PART, MOST_STORED, moves
from .contact_set import is_new_normal, add_contact

TIME_STEP = 1.0 / 512.0  # s; a power of two, so that instants are the same for all
MOST_SWEEPS = 40
CONVERGED = 2e-5  # m/s: a sweep that changes less is the last
MOST_CORRECTIONS = 10
OVERLAP = 1e-7  # m: more is pushed apart
WALL = 1e-3  # least part of gravity that must press for a ball to come to rest on a surface


@kernel
def contact_reach(work):
    """How far [m] from an involved ball something may be that it can touch before the next instant."""
    fastest = 0.0
    for k in range(work.count[INVOLVED]):
        fastest = max(fastest, length(load(work.solved_motion[work.involved[k], 0:3])))
    return RESTING_GAP + 2.0 * TIME_STEP * fastest


@kernel
def add_ground_contacts(land, ball, i, work, reach):
    """Contacts of ball `i` with the ground within `reach`. Writes contacts."""
    begin = work.count[CONTACTS]
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
def init_contact(row, gap, friction):
    """Fill in a contact that does not press yet."""
    row['separation'] = gap
    row['friction'] = friction
    row['rolling_resistance'] = 0.0
    row['normal_impulse'] = 0.0
    store(row['tangent_impulse'], ZERO)


@kernel
def neighbours_within(balls, work, i, reach, radius, now):
    """Balls within `reach` of ball `i`, by number; whether others are on their way.

    Writes near, in rising order: what is solved first must not depend on the tree. Returns how many.
    """
    here = load(balls[i]['position'])
    low, high = surfaces.around(here, radius + reach)
    found = 0
    watch = False
    at = next_node(work, 0, low, high)
    while at >= 0:
        j = work.nodes[at]['ball']
        at = next_node(work, at + 1, low, high)
        if j == i or balls[j]['phase'] == HOLED:
            continue
        if work.involved_index[j] < 0 and moves(balls[j]['phase']):
            watch = True
        if found < MOST_NEIGHBOURS and length(sub(here, position_at(balls[j], now))) - 2.0 * radius <= reach:
            k = found
            while k > 0 and work.neighbours[k - 1] > j:
                work.neighbours[k] = work.neighbours[k - 1]
                k -= 1
            work.neighbours[k] = j
            found += 1
    return found, watch


@kernel
def add_resting_contact(land, balls, work, i, j, now):
    """Add the contact of ball `i` with ball `j`, which is involved or asleep."""
    apart = sub(load(balls[i]['position']), position_at(balls[j], now))
    row = add_contact(work, i, j if work.involved_index[j] >= 0 else -1, -2 - j, unit(apart, UP))
    if row >= 0:
        init_contact(work.contacts[row], length(apart) - 2.0 * land.ball.radius, land.ball.friction)


@kernel
def gap_rate(balls, i, j, now):
    """Rate at which the gap between balls `i` and `j` grows."""
    normal = unit(sub(load(balls[i]['position']), position_at(balls[j], now)), UP)
    return dot(sub(load(balls[i]['velocity']), velocity_at(balls[j], now)), normal)


@shared
def correct_positions(balls, work):
    """Push apart what overlaps, a little in every contact until nothing does. Writes positions and gaps."""
    for k in range(work.count[INVOLVED]):
        store(work.position_change[work.involved[k]], ZERO)
    for sweep in range(MOST_CORRECTIONS):
        if sweep_positions(work, sweep % 2 == 1) <= OVERLAP:
            break
    for k in range(work.count[INVOLVED]):
        place = balls[work.involved[k]]['position']
        store(place, add(load(place), load(work.position_change[work.involved[k]])))


@kernel
def sweep_positions(work, backward):
    """One sweep over all overlaps. Writes position_change; returns the greatest overlap [m]."""
    most = 0.0
    count = work.count[CONTACTS]
    for k in range(count):
        row = work.contacts[count - 1 - k if backward else k]
        normal = load(row['normal'])
        overlap = -row['separation'] - dot(load(work.position_change[row['a']]), normal)
        if row['b'] >= 0:
            overlap += dot(load(work.position_change[row['b']]), normal)
        if overlap > 0.0:
            most = max(most, overlap)
            share = 0.5 if row['b'] >= 0 else 1.0
            store(work.position_change[row['a']], add_scaled(
                load(work.position_change[row['a']]), share * overlap, normal))
            if row['b'] >= 0:
                store(work.position_change[row['b']], add_scaled(
                    load(work.position_change[row['b']]), -share * overlap, normal))
    return most


@kernel
def contact_partner(row):
    """Number of what a contact is with: a ball below 0, else a part of the ground."""
    return -2 - row['b'] if row['b'] >= 0 else row['part']


@shared
def warm_start(land, balls, work):
    """Begin with the impulses of the step before. Writes contacts and motion."""
    for n in range(work.count[CONTACTS]):
        row = work.contacts[n]
        ball = balls[row['a']]
        for k in range(ball['stored_count']):
            if ball['stored_partners'][k] == contact_partner(row):
                row['normal_impulse'] = ball['stored_impulses'][k, 0]
                rub = load(ball['stored_impulses'][k, 1:4])
                store(row['tangent_impulse'], tangential(rub, load(row['normal'])))
                apply_normal_impulse(work, row, scale(row['normal_impulse'], load(row['normal'])))
                apply_tangent_impulse(work, row, load(row['tangent_impulse']), land.ball)
                break


@shared
def store_impulses(balls, work):
    """Remember the impulses for the next step. Writes stored_count, stored_partners, stored_impulses."""
    for k in range(work.count[INVOLVED]):
        balls[work.involved[k]]['stored_count'] = 0
    for n in range(work.count[CONTACTS]):
        row = work.contacts[n]
        ball = balls[row['a']]
        k = ball['stored_count']
        if row['normal_impulse'] > 0.0 and k < MOST_STORED:
            ball['stored_partners'][k] = contact_partner(row)
            ball['stored_impulses'][k, 0] = row['normal_impulse']
            store(ball['stored_impulses'][k, 1:4], load(row['tangent_impulse']))
            ball['stored_count'] = k + 1


@kernel
def apply_normal_impulse(work, row, change):
    """Change the velocities of both sides of a contact. Writes solved_motion."""
    a = work.solved_motion[row['a'], 0:3]
    store(a, add(load(a), change))
    if row['b'] >= 0:
        b = work.solved_motion[row['b'], 0:3]
        store(b, sub(load(b), change))


@kernel
def apply_tangent_impulse(work, row, rub, record):
    """Let the friction impulse `change` act on both sides. Writes solved_motion."""
    apply_normal_impulse(work, row, rub)
    twist = scale(-1.0 / (record.inertia * record.radius), cross(load(row['normal']), rub))
    a = work.solved_motion[row['a'], 3:6]
    store(a, add(load(a), twist))
    if row['b'] >= 0:
        b = work.solved_motion[row['b'], 3:6]
        store(b, add(load(b), twist))


@kernel
def relative_motion(work, row):
    """Velocity of one side of a contact against the other, and the sum of their spins."""
    velocity = load(work.solved_motion[row['a'], 0:3])
    spin = load(work.solved_motion[row['a'], 3:6])
    if row['b'] >= 0:
        velocity = sub(velocity, load(work.solved_motion[row['b'], 0:3]))
        spin = add(spin, load(work.solved_motion[row['b'], 3:6]))
    return velocity, spin


@shared
def sweep_impulses(land, work, backward):
    """One sweep over all contacts. Writes motion and impulses; returns the greatest change [m/s]."""
    most = 0.0
    count = work.count[CONTACTS]
    grip = land.ball.inertia / (1.0 + land.ball.inertia)
    for k in range(count):
        row = work.contacts[count - 1 - k if backward else k]
        normal = load(row['normal'])
        share = 0.5 if row['b'] >= 0 else 1.0
        velocity, spin = relative_motion(work, row)
        rate = dot(velocity, normal)
        needed = max(row['normal_impulse'] - share * (rate + max(row['separation'], 0.0) / TIME_STEP), 0.0)
        change = needed - row['normal_impulse']
        if change != 0.0:
            row['normal_impulse'] = needed
            apply_normal_impulse(work, row, scale(change, normal))
            most = max(most, abs(change))
        before = load(row['tangent_impulse'])
        if needed > 0.0 or dot(before, before) > 0.0:
            sliding = sub(add_scaled(velocity, -rate, normal), scale(land.ball.radius, cross(spin, normal)))
            rub = add_scaled(before, -share * grip, sliding)
            size = length(rub)
            if size > row['friction'] * needed:
                rub = scale(row['friction'] * needed / size, rub)
            apply_tangent_impulse(work, row, sub(rub, before), land.ball)
            store(row['tangent_impulse'], rub)
    return most


@shared
def solve_contacts(land, balls, work):
    """Solve all contacts. Writes impulses and solved_motion."""
    warm_start(land, balls, work)
    for sweep in range(MOST_SWEEPS):
        if sweep_impulses(land, work, sweep % 2 == 1) <= CONVERGED:
            break
    store_impulses(balls, work)


@kernel
def write_back(ball, work, i):
    """Give ball `i` its solved motion, and nothing to stand on yet. Writes motion, held_by and contact."""
    store(ball['velocity'], load(work.solved_motion[i, 0:3]))
    store(ball['spin'], load(work.solved_motion[i, 3:6]))
    ball['rolling_loss'] = 0.0
    ball['held_by'] = 0
    store(ball['normal'], ZERO)
    ball['support'] = NO_PART


@kernel
def is_pressed_by_gravity(land, ball, normal):
    """Whether gravity presses the ball against what has `normal`, rather than lets it lean on it."""
    weight = gravity_at(land.effects, load(ball['position']))
    return -dot(weight, normal) > WALL * length(weight)


@kernel
def count_support(land, balls, row):
    """Let a contact that presses hold its balls. Writes held_by, rolling_loss, and what they stand on."""
    if row['normal_impulse'] <= 0.0 and row['separation'] > RESTING_GAP:
        return
    ball = balls[row['a']]
    normal = load(row['normal'])
    if row['part'] < 0:
        ball['held_by'] += 2
        if row['b'] >= 0:
            balls[row['b']]['held_by'] += 2
        return
    ball['held_by'] += 1
    ball['rolling_loss'] += row['rolling_resistance'] * row['normal_impulse']
    if is_pressed_by_gravity(land, ball, normal) and normal[2] > ball['normal'][2]:
        set_support(land, ball, surfaces.support_of(land.ground, row['part']), normal)


@kernel
def limit_speed(ball, speed):
    """Leave the ball a `speed` [m/s], and as much of its spin. Writes motion."""
    before = length(load(ball['velocity']))
    if before > 0.0:
        store(ball['velocity'], scale(speed / before, load(ball['velocity'])))
        store(ball['spin'], scale(speed / before, load(ball['spin'])))
