# SPDX-License-Identifier: Apache-2.0
"""The contacts of one instant: balls that share an impact, what they touch, and what that touches."""
from ..collision import ball_interactions
from ..collision.ball_gap import position_at, velocity_at
from ..collision.broad_phase import next_node
from ..collision.workspace import CONTACTS, MultiBallWorkspace, INVOLVED
from ..contact.contact_state import contact_material
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.vector import UP, ZERO, dot, length, store, sub, unit, load
from ..properties.material import restitution
from ..state.ball import FLIGHT, HOLED, STEP_END, moves
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.segment import spin as spin_at
from ..trajectory.shot_record import update_apex

SIMULTANEOUS_GAP = 1e-9  # m: what is that near is touched at the same instant
SAME_NORMAL = 1e-9  # 1 - cosine of the angle below which two normals are one
MOST_MEMBERS = 64


@kernel
def synchronize(ball, now):
    """Bring a ball to `now`, where its segment ends before its time. Writes motion, end, ending."""
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
def collect_contacts(land, balls, work, now, known):
    """Find all that the involved balls touch, and what that touches. Writes involved, contacts.

    Of the first `known` of them, the contacts with the ground are there already.
    """
    k = 0
    while k < work.count[INVOLVED]:
        i = work.involved[k]
        if k >= known:
            collect_ground_contacts(land, balls[i], i, work, 0 if k == 0 else work.count[CONTACTS])
        if not balls[i]['time_stepping']:  # time steps pass on what they are given
            ball_interactions.collect_ball_contacts(work, land, balls, i, now)
        k += 1


@kernel
def add_to_set(work, i):
    """Let ball `i`, which is where it is now, be involved."""
    work.involved_index[i] = work.count[INVOLVED]
    work.involved[work.count[INVOLVED]] = i
    work.count[INVOLVED] += 1


@kernel
def clear_set(work):
    """Let no ball be involved. Writes count, involved_index."""
    for k in range(work.count[INVOLVED]):
        work.involved_index[work.involved[k]] = -1
    work.count[INVOLVED] = 0
    work.count[CONTACTS] = 0


@kernel
def add_contact(work, a, b, part, normal):
    """Row of a new contact of ball `a` with ball `b`, or with a part of the ground; -1 when full."""
    n = work.count[CONTACTS]
    if n == len(work.contacts):
        return -1
    work.count[CONTACTS] += 1
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
def _gather_balls(work, land, balls, i, now):
    k = work.involved_index[i]
    radius = land.ball.radius
    here = load(balls[i]['position'])
    low, high = surfaces.around(here, radius + SIMULTANEOUS_GAP)
    at = next_node(work, 0, low, high)
    while at >= 0:
        j = work.nodes[at]['ball']
        at = next_node(work, at + 1, low, high)
        if j == i or balls[j]['phase'] == HOLED or 0 <= work.involved_index[j] < k:
            continue
        apart = sub(here, position_at(balls[j], now))
        if length(apart) - 2.0 * radius > SIMULTANEOUS_GAP:
            continue
        if work.involved_index[j] < 0:
            if work.count[INVOLVED] == MOST_MEMBERS:
                continue
            add_to_set(work, j)
            synchronize(balls[j], now)
        add_ball_contact(land, balls, i, j, work, now)


@kernel
def add_ball_contact(land, balls, i, j, work, now):
    """Add the contact of balls `i` and `j`."""
    n = add_contact(work, i, j, -1, unit(sub(position_at(balls[i], now), position_at(balls[j], now)), UP))
    if n >= 0:
        row = work.contacts[n]
        row['restitution'] = land.ball.restitution
        row['tangential_restitution'] = 0.0
        row['friction'] = land.ball.friction
        row['mass'] = 0.5 * land.ball.mass


@kernel
def collect_ground_contacts(land, ball, i, work, begin):
    """Contacts of ball `i` with the ground: what supports it first. Its own start at `begin`."""
    ground = land.ground
    place = load(ball['position'])
    if ball['support'] >= 0 and ball['phase'] != FLIGHT and is_new_normal(work, begin, load(ball['normal'])):
        normal = load(ball['normal'])
        add_ground_contact(land, ball, i, ball['support'], normal,
                           contact_material(land, ball, ball['support'], normal), work)
    low, high = surfaces.around(place, land.ball.radius + SIMULTANEOUS_GAP)
    part = surfaces.next_part(ground, 0, low, high)
    while part >= 0:
        distance, normal = surfaces.nearest(ground, part, place)
        if distance - land.ball.radius <= SIMULTANEOUS_GAP and is_new_normal(work, begin, normal) and (
                surfaces.touchable(ground, part, place)):
            add_ground_contact(land, ball, i, part, normal, contact_material(land, ball, part, normal), work)
        part = surfaces.next_part(ground, part + 1, low, high)


@kernel
def is_new_normal(work, begin, normal):
    """Whether `normal` is none of the contacts from `begin` on."""
    for n in range(begin, work.count[CONTACTS]):
        if dot(load(work.contacts[n]['normal']), normal) > 1.0 - SAME_NORMAL:
            return False
    return True


@kernel
def add_ground_contact(land, ball, i, part, normal, material, work):
    """Add the contact of ball `i` with `part`, which is of that `material`."""
    n = add_contact(work, i, -1, part, normal)
    if n < 0:
        return
    row = work.contacts[n]
    row['restitution'] = restitution(material, max(-dot(load(ball['velocity']), normal), 0.0))
    row['tangential_restitution'] = material['tangential_restitution']
    row['friction'] = material['dynamic_friction']
    row['mass'] = land.ball.mass


@kernel
def separation_rate(balls, row):
    """Rate at which the gap of a contact grows."""
    normal = load(row['normal'])
    rate = dot(load(balls[row['a']]['velocity']), normal)
    if row['b'] >= 0:
        rate -= dot(load(balls[row['b']]['velocity']), normal)
    return rate


@kernel
def count_approaching(balls, work):
    """Number of contacts that approach: not those of what a ball rolls on, but for rounding."""
    found = 0
    for n in range(work.count[CONTACTS]):
        found += separation_rate(balls, work.contacts[n]) < -LEAST_SPEED
    return found
