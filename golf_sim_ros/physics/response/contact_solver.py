# SPDX-License-Identifier: Apache-2.0
"""How the contacts of a pile push: impulses that keep every gap open for one more step, with friction.

Moreau's time stepping. A pile moves in straight lines from one instant to the next, so a gap to what is
convex shrinks by no more than its rate says: where no contact closes faster than gap over step, nothing
overlaps at the next instant. Projected Gauss-Seidel finds the impulses, beginning with those of the step
before. Velocities here are those half-way through a step (leapfrog), and impulses are per mass.
"""
from ..collision.ball_gap import UP, place_at, velocity_at
from ..collision.broad_phase import next_node
from ..collision.ground_contact import PILE_NEAR
from ..collision.workspace import CONTACTS, MEMBERS, NEIGHBOURS
from ..contact.contact_state import material_of, stand_on
from ..effects import pull
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.vector import ZERO, add, along, cross, dot, length, put, scale, sub, tangential, unit, vector
from ..state.ball import HOLED, NO_PART, REMEMBERED, moves
from .contact_set import is_new, new_contact

PILE_STEP = 1.0 / 512.0  # s; a power of two, so that instants are the same for all
SWEEPS = 40
DONE = 2e-5  # m/s: a sweep that changes less is the last
SHIFTS = 10
OVERLAP = 1e-7  # m: more is pushed apart
WALL = 1e-3  # least part of gravity that must press for a ball to come to rest on a surface


@kernel
def far_reach(crowd):
    """How far [m] from a member something may be that it can touch before the next instant."""
    fastest = 0.0
    for k in range(crowd.count[MEMBERS]):
        fastest = max(fastest, length(vector(crowd.before[crowd.members[k], 0:3])))
    return PILE_NEAR + 2.0 * PILE_STEP * fastest


@kernel
def ground_contacts(land, ball, i, crowd, reach):
    """Contacts of member `i` with the ground within `reach`. Writes contacts."""
    begin = crowd.count[CONTACTS]
    place = vector(ball['position'])
    low, high = surfaces.around(place, land.ball.radius + reach)
    part = surfaces.next_part(land.ground, 0, low, high)
    while part >= 0:
        distance, normal = surfaces.nearest(land.ground, part, place)
        gap = distance - land.ball.radius
        if gap <= reach and is_new(crowd, begin, normal) and surfaces.touchable(land.ground, part, place):
            row = new_contact(crowd, i, -1, part, normal)
            if row >= 0:
                material = material_of(land, ball, part, normal)
                set_contact(crowd.contacts[row], gap, material['dynamic_friction'])
                crowd.contacts[row]['shared'] = material['rolling_resistance']
        part = surfaces.next_part(land.ground, part + 1, low, high)


@kernel
def set_contact(row, gap, friction):
    """Fill in a contact that does not press yet."""
    row['ahead'] = gap
    row['friction'] = friction
    row['shared'] = 0.0
    row['push'] = 0.0
    put(row['rub'], ZERO)


@kernel
def neighbours(balls, crowd, i, reach, radius, now):
    """Balls within `reach` of member number `i`, by number; whether others are on their way.

    Writes near, in rising order: what is solved first must not depend on the tree. Returns how many.
    """
    here = vector(balls[i]['position'])
    low, high = surfaces.around(here, radius + reach)
    found = 0
    watch = False
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        at = next_node(crowd, at + 1, low, high)
        if j == i or balls[j]['phase'] == HOLED:
            continue
        if crowd.places[j] < 0 and moves(balls[j]['phase']):
            watch = True
        if found < NEIGHBOURS and length(sub(here, place_at(balls[j], now))) - 2.0 * radius <= reach:
            k = found
            while k > 0 and crowd.near[k - 1] > j:
                crowd.near[k] = crowd.near[k - 1]
                k -= 1
            crowd.near[k] = j
            found += 1
    return found, watch


@kernel
def ball_contact(land, balls, crowd, i, j, now):
    """Add the contact of member `i` with ball `j`, a member or asleep."""
    apart = sub(vector(balls[i]['position']), place_at(balls[j], now))
    row = new_contact(crowd, i, j if crowd.places[j] >= 0 else -1, -2 - j, unit(apart, UP))
    if row >= 0:
        set_contact(crowd.contacts[row], length(apart) - 2.0 * land.ball.radius, land.ball.friction)


@kernel
def closing(balls, i, j, now):
    """Rate at which the gap between balls `i` and `j` grows."""
    normal = unit(sub(vector(balls[i]['position']), place_at(balls[j], now)), UP)
    return dot(sub(vector(balls[i]['velocity']), velocity_at(balls[j], now)), normal)


@shared
def part_overlaps(balls, crowd):
    """Push apart what overlaps, a little in every contact until nothing does. Writes positions and gaps."""
    for k in range(crowd.count[MEMBERS]):
        put(crowd.flow[crowd.members[k]], ZERO)
    for sweep in range(SHIFTS):
        if shift_once(crowd, sweep % 2 == 1) <= OVERLAP:
            break
    for k in range(crowd.count[MEMBERS]):
        place = balls[crowd.members[k]]['position']
        put(place, add(vector(place), vector(crowd.flow[crowd.members[k]])))


@kernel
def shift_once(crowd, backward):
    """One sweep over all overlaps. Writes flow, the way of each member; returns the greatest overlap [m]."""
    most = 0.0
    count = crowd.count[CONTACTS]
    for k in range(count):
        row = crowd.contacts[count - 1 - k if backward else k]
        normal = vector(row['normal'])
        overlap = -row['ahead'] - dot(vector(crowd.flow[row['a']]), normal)
        if row['b'] >= 0:
            overlap += dot(vector(crowd.flow[row['b']]), normal)
        if overlap > 0.0:
            most = max(most, overlap)
            share = 0.5 if row['b'] >= 0 else 1.0
            put(crowd.flow[row['a']], along(vector(crowd.flow[row['a']]), share * overlap, normal))
            if row['b'] >= 0:
                put(crowd.flow[row['b']], along(vector(crowd.flow[row['b']]), -share * overlap, normal))
    return most


@kernel
def partner(row):
    """Number of what a contact is with: a ball below 0, else a part of the ground."""
    return -2 - row['b'] if row['b'] >= 0 else row['part']


@shared
def recall(land, balls, crowd):
    """Begin with the impulses of the step before. Writes contacts and motion."""
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        ball = balls[row['a']]
        for k in range(ball['pressing']):
            if ball['pressed_by'][k] == partner(row):
                row['push'] = ball['pressed'][k, 0]
                rub = (ball['pressed'][k, 1], ball['pressed'][k, 2], ball['pressed'][k, 3])
                put(row['rub'], tangential(rub, vector(row['normal'])))
                push(crowd, row, scale(row['push'], vector(row['normal'])))
                turn(crowd, row, vector(row['rub']), land.ball)
                break


@shared
def keep(balls, crowd):
    """Remember the impulses for the next step. Writes pressing, pressed_by, pressed."""
    for k in range(crowd.count[MEMBERS]):
        balls[crowd.members[k]]['pressing'] = 0
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        ball = balls[row['a']]
        k = ball['pressing']
        if row['push'] > 0.0 and k < REMEMBERED:
            ball['pressed_by'][k] = partner(row)
            ball['pressed'][k, 0] = row['push']
            put(ball['pressed'][k, 1:4], vector(row['rub']))
            ball['pressing'] = k + 1


@kernel
def push(crowd, row, change):
    """Change the velocities of both sides of a contact. Writes before."""
    a = crowd.before[row['a'], 0:3]
    put(a, add(vector(a), change))
    if row['b'] >= 0:
        b = crowd.before[row['b'], 0:3]
        put(b, sub(vector(b), change))


@kernel
def turn(crowd, row, rub, record):
    """Let the friction impulse `rub` act on both sides. Writes before."""
    push(crowd, row, rub)
    twist = scale(-1.0 / (record.inertia * record.radius), cross(vector(row['normal']), rub))
    a = crowd.before[row['a'], 3:6]
    put(a, add(vector(a), twist))
    if row['b'] >= 0:
        b = crowd.before[row['b'], 3:6]
        put(b, add(vector(b), twist))


@kernel
def between(crowd, row):
    """Velocity of one side of a contact against the other, and the sum of their spins."""
    velocity = vector(crowd.before[row['a'], 0:3])
    spin = vector(crowd.before[row['a'], 3:6])
    if row['b'] >= 0:
        velocity = sub(velocity, vector(crowd.before[row['b'], 0:3]))
        spin = add(spin, vector(crowd.before[row['b'], 3:6]))
    return velocity, spin


@shared
def press_once(land, crowd, backward):
    """One sweep over all contacts. Writes motion and impulses; returns the greatest change [m/s]."""
    most = 0.0
    count = crowd.count[CONTACTS]
    grip = land.ball.inertia / (1.0 + land.ball.inertia)
    for k in range(count):
        row = crowd.contacts[count - 1 - k if backward else k]
        normal = vector(row['normal'])
        share = 0.5 if row['b'] >= 0 else 1.0
        velocity, spin = between(crowd, row)
        rate = dot(velocity, normal)
        needed = max(row['push'] - share * (rate + max(row['ahead'], 0.0) / PILE_STEP), 0.0)
        change = needed - row['push']
        if change != 0.0:
            row['push'] = needed
            push(crowd, row, scale(change, normal))
            most = max(most, abs(change))
        before = vector(row['rub'])
        if needed > 0.0 or dot(before, before) > 0.0:
            sliding = sub(along(velocity, -rate, normal), scale(land.ball.radius, cross(spin, normal)))
            rub = along(before, -share * grip, sliding)
            size = length(rub)
            if size > row['friction'] * needed:
                rub = scale(row['friction'] * needed / size, rub)
            turn(crowd, row, sub(rub, before), land.ball)
            put(row['rub'], rub)
    return most


@shared
def press(land, balls, crowd):
    """Solve all contacts of the members. Writes impulses, and the members' motion in before."""
    recall(land, balls, crowd)
    for sweep in range(SWEEPS):
        if press_once(land, crowd, sweep % 2 == 1) <= DONE:
            break
    keep(balls, crowd)


@kernel
def follow(ball, crowd, i):
    """Give member `i` its solved motion, and nothing to stand on yet. Writes motion, held and contact."""
    put(ball['velocity'], vector(crowd.before[i, 0:3]))
    put(ball['spin'], vector(crowd.before[i, 3:6]))
    ball['braking'] = 0.0
    ball['held'] = 0
    put(ball['normal'], ZERO)
    ball['support'] = NO_PART


@kernel
def presses(land, ball, normal):
    """Whether gravity presses the ball against what has `normal`, rather than lets it lean on it."""
    weight = pull(land.effects, vector(ball['position']))
    return -dot(weight, normal) > WALL * length(weight)


@kernel
def hold_up(land, balls, row):
    """Let a contact that presses hold its balls. Writes held, braking, and what they stand on."""
    if row['push'] <= 0.0 and row['ahead'] > PILE_NEAR:
        return
    ball = balls[row['a']]
    normal = vector(row['normal'])
    if row['part'] < 0:
        ball['held'] += 2
        if row['b'] >= 0:
            balls[row['b']]['held'] += 2
        return
    ball['held'] += 1
    ball['braking'] += row['shared'] * row['push']
    if presses(land, ball, normal) and normal[2] > ball['normal'][2]:
        stand_on(land, ball, surfaces.support_of(land.ground, row['part']), normal)


@kernel
def slow_down(ball, speed):
    """Leave the ball a `speed` [m/s], and as much of its spin. Writes motion."""
    before = length(vector(ball['velocity']))
    if before > 0.0:
        put(ball['velocity'], scale(speed / before, vector(ball['velocity'])))
        put(ball['spin'], scale(speed / before, vector(ball['spin'])))
