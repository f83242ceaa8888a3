# SPDX-License-Identifier: Apache-2.0
"""Impacts at one instant that share a ball, whatever order balls and surfaces are stored in.

Generalized reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous
Impact", ACM Trans. Graph. 31 (2012) 106): all approaching contacts are projected out together with
non-negative impulses, each impulse counts 1 + e times, and that is repeated until none approaches. The
projection is Nesterov's accelerated gradient method on the impulses: every contact is treated alike, so
that neither the order in memory nor left and right count.
"""
from math import sqrt

from ..collision.workspace import CONTACTS, MEMBERS
from ..jit import kernel, shared
from ..mechanics.impulse import Bond, friction, slip, take
from ..mechanics.vector import ZERO, add, along, dot, length, put, scale, sub, vector
from .contact_set import rate_of

ROUNDS = 200
SWEEPS = 3000


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
