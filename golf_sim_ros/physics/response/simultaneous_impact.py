# SPDX-License-Identifier: Apache-2.0
"""Impacts at one instant that share a ball, whatever order balls and surfaces are stored in.

Generalized reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous
Impact", ACM Trans. Graph. 31 (2012) 106): all approaching contacts are projected out together with
non-negative impulses, each impulse counts 1 + e times, and that is repeated until none approaches. The
projection is Nesterov's accelerated gradient method on the impulses: every contact is treated alike, so
that neither the order in memory nor left and right count.
"""
from math import sqrt

from ..collision.workspace import CONTACTS, INVOLVED
from ..jit import kernel, shared
from ..mechanics.impulse import ContactProperties, friction, slip, apply_impulse
from ..mechanics.vector import ZERO, add, add_scaled, dot, length, store, scale, sub, load
from .contact_set import separation_rate

MOST_REFLECTIONS = 200
MOST_GRADIENT_STEPS = 3000


@shared
def solve_reflections(land, balls, crowd):
    """Let all contacts bounce at once. Writes velocities, spins, and the contacts' impulses."""
    contacts = crowd.contacts
    count = crowd.count[CONTACTS]
    fastest = 0.0
    for k in range(crowd.count[INVOLVED]):
        fastest = max(fastest, length(load(balls[crowd.members[k]]['velocity'])))
    for round_ in range(MOST_REFLECTIONS):
        approaching = False
        for n in range(count):
            row = contacts[n]
            row['rate'] = separation_rate(balls, row)
            row['approach'] = max(row['approach'], -row['rate'])
            # At last nothing bounces any more, and all that touches counts: then none approaches.
            row['active'] = row['rate'] < -1e-12 * fastest or round_ == MOST_REFLECTIONS - 1
            approaching |= row['rate'] < -1e-12 * fastest
        if not approaching:
            break
        project_impulses(crowd)
        apply_impulses(land, balls, crowd, round_ == MOST_REFLECTIONS - 1)


@kernel
def project_impulses(crowd):
    """Least impulses (over mass) that stop all approach at the active contacts. Writes push."""
    contacts = crowd.contacts
    count = crowd.count[CONTACTS]
    active = count_contacts(crowd)
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
    for _ in range(MOST_GRADIENT_STEPS):
        apply_extrapolated(crowd)
        changed = 0.0
        largest = 0.0
        turned = 0.0
        for n in range(count):
            row = contacts[n]
            if not row['active']:
                continue
            slope = row['rate'] + rate_change(crowd, row)
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
def count_contacts(crowd):
    """Count active contacts, and those of each ball. Writes flow; returns the number of all."""
    for k in range(crowd.count[INVOLVED]):
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
def apply_extrapolated(crowd):
    """Change of velocities by the contacts' `ahead`. Writes flow."""
    for k in range(crowd.count[INVOLVED]):
        store(crowd.flow[crowd.members[k]], ZERO)
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        if row['active'] and row['ahead'] != 0.0:
            a = crowd.flow[row['a']]
            store(a, add_scaled(load(a), row['ahead'], load(row['normal'])))
            if row['b'] >= 0:
                b = crowd.flow[row['b']]
                store(b, add_scaled(load(b), -row['ahead'], load(row['normal'])))


@kernel
def rate_change(crowd, row):
    """Change of the rate of a contact by `flow`."""
    normal = load(row['normal'])
    change = dot(load(crowd.flow[row['a']]), normal)
    if row['b'] >= 0:
        change -= dot(load(crowd.flow[row['b']]), normal)
    return change


@kernel
def apply_impulses(land, balls, crowd, last):
    """Apply the pushes with restitution, unless it is the `last` round, then friction. Writes motion."""
    contacts = crowd.contacts
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            e = 0.0 if last else row['restitution']
            row['push'] *= (1.0 + e) * land.ball.mass
            apply_to_both(land, balls, row, scale(row['push'], load(row['normal'])))
    # All friction is worked out before any acts, and a ball's contacts share it: none comes first.
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            bond = ContactProperties(0.0, row['tangential'], row['friction'], row['mass'], land.ball.inertia)
            rub = friction(bond, row['push'], contact_slip(land, balls, row))
            store(row['rub'], scale(1.0 / row['shared'], rub))
    for n in range(crowd.count[CONTACTS]):
        row = contacts[n]
        if row['active']:
            apply_to_both(land, balls, row, load(row['rub']))


@kernel
def apply_to_both(land, balls, row, push):
    """Apply the impulse `push` [N s] of a contact to both sides. Writes motion and the contact's impulse."""
    normal = load(row['normal'])
    store(row['impulse'], add(load(row['impulse']), push))
    apply_impulse(balls[row['a']], push, normal, land.ball)
    if row['b'] >= 0:
        apply_impulse(balls[row['b']], scale(-1.0, push), scale(-1.0, normal), land.ball)


@kernel
def contact_slip(land, balls, row):
    """Velocity of `a`'s surface along that of what it touches."""
    a = balls[row['a']]
    velocity = load(a['velocity'])
    spin = load(a['spin'])
    if row['b'] >= 0:
        b = balls[row['b']]
        velocity = sub(velocity, load(b['velocity']))
        spin = add(spin, load(b['spin']))
    return slip(velocity, spin, load(row['normal']), land.ball.radius)
