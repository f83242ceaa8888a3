# SPDX-License-Identifier: Apache-2.0
"""Impacts at one instant that share a ball, whatever order balls and surfaces are stored in.

Generalized reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous
Impact", ACM Trans. Graph. 31 (2012) 106): all approaching contacts are projected out together with
non-negative impulses, each impulse counts 1 + e times, and that is repeated until none approaches. The
projection is Nesterov's accelerated gradient method on the impulses: every contact is treated alike, so
that neither the order in memory nor left and right count.
"""
from math import sqrt

from . import others
from .jit import kernel, shared
from .crowd import CONTACTS, MEMBERS, Crowd, next_node
from .contact import material_of
from .ground import surface
from .impulse import Bond, friction, slip, take
from .material import restitution
from .motion import STILL
from .pair import UP, place_at, velocity_at
from .path import spin as spin_at
from .shot import keep_highest
from .state import FLIGHT, HOLED, STEP, moves
from .vector import ZERO, add, along, dot, length, put, scale, sub, unit, vector

TOGETHER = 1e-9  # m: what is that near is touched at the same instant
SAME = 1e-9  # 1 - cosine of the angle below which two normals are one
ROUNDS = 200
SWEEPS = 3000
MOST_MEMBERS = 64


@kernel
def bring(ball, now):
    """Bring a ball to `now`, where its piece ends before its time. Writes motion, end, ending."""
    if not moves(ball['phase']):
        return
    ball['end'] = now
    ball['ending'] = STEP
    keep_highest(ball)
    time = now - ball['begin']
    place = place_at(ball, now)
    velocity = velocity_at(ball, now)
    turning = spin_at(ball, time)
    put(ball['position'], place)
    put(ball['velocity'], velocity)
    put(ball['spin'], turning)


@shared
def gather(land, balls, crowd, now, known):
    """Find all that the members touch, and what that touches. Writes members, contacts.

    Of the first `known` members, the contacts with the ground are there already.
    """
    k = 0
    while k < crowd.count[MEMBERS]:
        i = crowd.members[k]
        if k >= known:
            gather_ground(land, balls[i], i, crowd, 0 if k == 0 else crowd.count[CONTACTS])
        if not balls[i]['piled']:  # a pile passes on what it is given
            others.gather_balls(crowd, land, balls, i, now)
        k += 1


@kernel
def enlist(crowd, i):
    """Make ball `i`, which is where it is now, a member."""
    crowd.places[i] = crowd.count[MEMBERS]
    crowd.members[crowd.count[MEMBERS]] = i
    crowd.count[MEMBERS] += 1


@kernel
def disperse(crowd):
    """Let there be no members. Writes count, places."""
    for k in range(crowd.count[MEMBERS]):
        crowd.places[crowd.members[k]] = -1
    crowd.count[MEMBERS] = 0
    crowd.count[CONTACTS] = 0


@kernel
def new_contact(crowd, a, b, part, normal):
    """Row of a new contact of ball `a` with ball `b`, or with a part of the ground; -1 when full."""
    n = crowd.count[CONTACTS]
    if n == len(crowd.contacts):
        return -1
    crowd.count[CONTACTS] += 1
    row = crowd.contacts[n]
    row['a'] = a
    row['b'] = b
    row['part'] = part
    row['push'] = 0.0
    row['approach'] = 0.0
    put(row['normal'], normal)
    put(row['impulse'], ZERO)
    return n


@others.gather_balls.register(Crowd)
def _gather_balls(crowd, land, balls, i, now):
    k = crowd.places[i]
    radius = land.ball.radius
    here = vector(balls[i]['position'])
    low, high = surface.around(here, radius + TOGETHER)
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        at = next_node(crowd, at + 1, low, high)
        if j == i or balls[j]['phase'] == HOLED or 0 <= crowd.places[j] < k:
            continue
        apart = sub(here, place_at(balls[j], now))
        if length(apart) - 2.0 * radius > TOGETHER:
            continue
        if crowd.places[j] < 0:
            if crowd.count[MEMBERS] == MOST_MEMBERS:
                continue
            enlist(crowd, j)
            bring(balls[j], now)
        ball_contact(land, balls, i, j, crowd, now)


@kernel
def ball_contact(land, balls, i, j, crowd, now):
    """Add the contact of balls `i` and `j`."""
    n = new_contact(crowd, i, j, -1, unit(sub(place_at(balls[i], now), place_at(balls[j], now)), UP))
    if n >= 0:
        row = crowd.contacts[n]
        row['restitution'] = land.ball.restitution
        row['tangential'] = 0.0
        row['friction'] = land.ball.friction
        row['mass'] = 0.5 * land.ball.mass


@kernel
def gather_ground(land, ball, i, crowd, begin):
    """Contacts of ball `i` with the ground: what supports it first. Its own start at `begin`."""
    ground = land.ground
    place = vector(ball['position'])
    if ball['support'] >= 0 and ball['phase'] != FLIGHT and is_new(crowd, begin, vector(ball['normal'])):
        normal = vector(ball['normal'])
        ground_contact(land, ball, i, ball['support'], normal,
                       material_of(land, ball, ball['support'], normal), crowd)
    low, high = surface.around(place, land.ball.radius + TOGETHER)
    part = surface.next_part(ground, 0, low, high)
    while part >= 0:
        distance, normal = surface.nearest(ground, part, place)
        if distance - land.ball.radius <= TOGETHER and is_new(crowd, begin, normal) and (
                surface.touchable(ground, part, place)):
            ground_contact(land, ball, i, part, normal, material_of(land, ball, part, normal), crowd)
        part = surface.next_part(ground, part + 1, low, high)


@kernel
def is_new(crowd, begin, normal):
    """Whether `normal` is none of the contacts from `begin` on."""
    for n in range(begin, crowd.count[CONTACTS]):
        if dot(vector(crowd.contacts[n]['normal']), normal) > 1.0 - SAME:
            return False
    return True


@kernel
def ground_contact(land, ball, i, part, normal, material, crowd):
    """Add the contact of ball `i` with `part`, which is of that `material`."""
    n = new_contact(crowd, i, -1, part, normal)
    if n < 0:
        return
    row = crowd.contacts[n]
    row['restitution'] = restitution(material, max(-dot(vector(ball['velocity']), normal), 0.0))
    row['tangential'] = material['tangential_restitution']
    row['friction'] = material['dynamic_friction']
    row['mass'] = land.ball.mass


@kernel
def rate_of(balls, row):
    """Rate at which the gap of a contact grows."""
    normal = vector(row['normal'])
    rate = dot(vector(balls[row['a']]['velocity']), normal)
    if row['b'] >= 0:
        rate -= dot(vector(balls[row['b']]['velocity']), normal)
    return rate


@shared
def reflect(land, balls, crowd):
    """Let all contacts bounce at once. Writes velocities, spins, and the contacts' impulses."""
    contacts = crowd.contacts
    count = crowd.count[CONTACTS]
    fastest = 0.0
    for k in range(crowd.count[MEMBERS]):
        fastest = max(fastest, length(vector(balls[crowd.members[k]]['velocity'])))
    for round_ in range(ROUNDS):
        approaching = False
        for n in range(count):
            row = contacts[n]
            row['rate'] = rate_of(balls, row)
            row['approach'] = max(row['approach'], -row['rate'])
            # At last nothing bounces any more, and all that touches counts: then none approaches.
            row['active'] = row['rate'] < -1e-12 * fastest or round_ == ROUNDS - 1
            approaching |= row['rate'] < -1e-12 * fastest
        if not approaching:
            break
        project(crowd)
        push_apart(land, balls, crowd, round_ == ROUNDS - 1)


@kernel
def project(crowd):
    """Least impulses (over mass) that stop all approach at the active contacts. Writes push."""
    contacts = crowd.contacts
    count = crowd.count[CONTACTS]
    active = share_out(crowd)
    if active == 1:
        for n in range(count):
            row = contacts[n]
            row['push'] = -row['rate'] / (2.0 if row['b'] >= 0 else 1.0) if row['active'] else 0.0
        return
    most = 0.0
    for n in range(count):
        row = contacts[n]
        row['push'] = 0.0
        row['before'] = 0.0
        row['ahead'] = 0.0
        if row['active']:
            # A bound on the row sums of the matrix that turns pushes into rates.
            most = max(most, (2.0 if row['b'] >= 0 else 1.0) * row['shared'])
    momentum = 1.0
    for _ in range(SWEEPS):
        flow_from(crowd)
        changed = 0.0
        largest = 0.0
        turned = 0.0
        for n in range(count):
            row = contacts[n]
            if not row['active']:
                continue
            slope = row['rate'] + flow_along(crowd, row)
            push = max(row['ahead'] - slope / most, 0.0)
            turned += (row['ahead'] - push) * (push - row['push'])
            row['before'] = row['push']
            row['push'] = push
            changed = max(changed, abs(push - row['before']))
            largest = max(largest, push)
        if changed <= 1e-15 * largest:
            break
        following = 0.5 * (1.0 + sqrt(1.0 + 4.0 * momentum * momentum))
        weight = (momentum - 1.0) / following
        momentum = following
        if turned > 0.0:  # it overshoots: start anew from here
            weight = 0.0
            momentum = 1.0
        for n in range(count):
            row = contacts[n]
            row['ahead'] = row['push'] + weight * (row['push'] - row['before'])


@kernel
def share_out(crowd):
    """Count active contacts, and those of each ball. Writes flow; returns the number of all."""
    for k in range(crowd.count[MEMBERS]):
        crowd.flow[crowd.members[k], 0] = 0.0
    active = 0
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        if row['active']:
            active += 1
            crowd.flow[row['a'], 0] += 1.0
            if row['b'] >= 0:
                crowd.flow[row['b'], 0] += 1.0
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        row['shared'] = crowd.flow[row['a'], 0]
        if row['b'] >= 0:
            row['shared'] = max(row['shared'], crowd.flow[row['b'], 0])
    return active


@kernel
def flow_from(crowd):
    """Change of velocities by the contacts' `ahead`. Writes flow."""
    for k in range(crowd.count[MEMBERS]):
        put(crowd.flow[crowd.members[k]], ZERO)
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        if row['active'] and row['ahead'] != 0.0:
            a = crowd.flow[row['a']]
            put(a, along(vector(a), row['ahead'], vector(row['normal'])))
            if row['b'] >= 0:
                b = crowd.flow[row['b']]
                put(b, along(vector(b), -row['ahead'], vector(row['normal'])))


@kernel
def flow_along(crowd, row):
    """Change of the rate of a contact by `flow`."""
    normal = vector(row['normal'])
    change = dot(vector(crowd.flow[row['a']]), normal)
    if row['b'] >= 0:
        change -= dot(vector(crowd.flow[row['b']]), normal)
    return change


@kernel
def push_apart(land, balls, crowd, last):
    """Apply the pushes with restitution, unless it is the `last` round, then friction. Writes motion."""
    contacts = crowd.contacts
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            e = 0.0 if last else row['restitution']
            row['push'] *= (1.0 + e) * land.ball.mass
            give(land, balls, row, scale(row['push'], vector(row['normal'])))
    # All friction is worked out before any acts, and a ball's contacts share it: none comes first.
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            bond = Bond(0.0, row['tangential'], row['friction'], row['mass'], land.ball.inertia)
            rub = friction(bond, row['push'], sliding_of(land, balls, row))
            put(row['rub'], scale(1.0 / row['shared'], rub))
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            give(land, balls, row, vector(row['rub']))


@kernel
def give(land, balls, row, push):
    """Apply the impulse `push` [N s] of a contact to both sides. Writes motion and the contact's impulse."""
    normal = vector(row['normal'])
    put(row['impulse'], add(vector(row['impulse']), push))
    take(balls[row['a']], push, normal, land.ball)
    if row['b'] >= 0:
        take(balls[row['b']], scale(-1.0, push), scale(-1.0, normal), land.ball)


@kernel
def sliding_of(land, balls, row):
    """Velocity of `a`'s surface along that of what it touches."""
    a = balls[row['a']]
    velocity = vector(a['velocity'])
    spin = vector(a['spin'])
    if row['b'] >= 0:
        b = balls[row['b']]
        velocity = sub(velocity, vector(b['velocity']))
        spin = add(spin, vector(b['spin']))
    return slip(velocity, spin, vector(row['normal']), land.ball.radius)


@kernel
def approaching(balls, crowd):
    """Number of contacts that approach: not those of what a ball rolls on, but for rounding."""
    found = 0
    for n in range(crowd.count[CONTACTS]):
        found += rate_of(balls, crowd.contacts[n]) < -STILL
    return found
