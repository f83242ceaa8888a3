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

"""Simultaneous impacts: contacts of one instant that share a ball.

The outcome is independent of their order in memory. Generalized reflections (Smith, Kaufman,
Vouga, Tamstorf, Grinspun, "Reflections on Simultaneous Impact", ACM Trans. Graph. 31 (2012) 106):
the approach of all active contacts is projected out together with non-negative impulses, each
impulse is applied 1 + e times, and that is repeated until no contact approaches. The projection is
a linear complementarity problem, solved by Nesterov's accelerated projected gradient method: every
contact is treated alike, so that neither the order in memory nor left and right count, as they
would in Gauss-Seidel sweeps.
"""

from math import sqrt

import numpy as np

from .contact_set import separation_rate
from ..collision.workspace import CONTACTS, INVOLVED
from ..jit import kernel, shared
from ..kernel_types import ContactRecord, SceneRecord, Vector, WorkRecord
from ..mechanics.impulse import apply_impulse, ContactProperties, friction, slip
from ..mechanics.vector import add, add_scaled, dot, length, load, scale, store, sub, ZERO

MOST_REFLECTIONS = 200
MOST_GRADIENT_STEPS = 3000


@shared
def solve_reflections(land: SceneRecord, balls: np.ndarray, work: WorkRecord) -> None:
    """Solve the impacts of all contacts at once.

    Writes velocity, spin, contacts, contact_counts, velocity_change.
    """
    contacts = work.contacts
    count = work.counts[CONTACTS]
    fastest = 0.0
    for k in range(work.counts[INVOLVED]):
        fastest = max(fastest, length(load(balls[work.involved[k]]['velocity'])))
    for round_ in range(MOST_REFLECTIONS):
        approaching = False
        for n in range(count):
            row = contacts[n]
            row['rate'] = separation_rate(balls, row)
            row['approach_speed'] = max(row['approach_speed'], -row['rate'])
            # The last round has no restitution and takes all contacts as active: afterwards none
            # approaches. Rounding leaves rates of about 1e-16 of the fastest ball's speed, which
            # are no approach.
            row['active'] = row['rate'] < -1e-12 * fastest or round_ == MOST_REFLECTIONS - 1
            approaching |= row['rate'] < -1e-12 * fastest
        if not approaching:
            break
        project_impulses(work)
        apply_impulses(land, balls, work, round_ == MOST_REFLECTIONS - 1)


@kernel
def project_impulses(work: WorkRecord) -> None:
    """Project out the approach of the active contacts, by impulses over mass.

    These are normal_impulse [m/s]. Writes normal_impulse, previous_impulse, extrapolated_impulse,
    contact_count, contact_counts, velocity_change.
    """
    contacts = work.contacts
    count = work.counts[CONTACTS]
    active = count_contacts(work)
    if active == 1:  # closed form: two balls share the change of the rate
        for n in range(count):
            row = contacts[n]
            row['normal_impulse'] = (
                -row['rate'] / (2.0 if row['b'] >= 0 else 1.0) if row['active'] else 0.0
            )
        return
    most = 0.0
    for n in range(count):
        row = contacts[n]
        row['normal_impulse'] = 0.0
        row['previous_impulse'] = 0.0
        row['extrapolated_impulse'] = 0.0
        if row['active']:
            # A bound on the row sums of the Delassus matrix, from impulses to rates, is one on its
            # largest eigenvalue: its inverse is a step length that always converges.
            most = max(most, (2.0 if row['b'] >= 0 else 1.0) * row['contact_count'])
    momentum = 1.0
    for _ in range(MOST_GRADIENT_STEPS):
        apply_extrapolated(work)
        changed = 0.0
        largest = 0.0
        turned = 0.0
        for n in range(count):
            row = contacts[n]
            if not row['active']:
                continue
            slope = row['rate'] + rate_change(work, row)
            projected = max(row['extrapolated_impulse'] - slope / most, 0.0)
            turned += (row['extrapolated_impulse'] - projected) * (
                projected - row['normal_impulse']
            )
            row['previous_impulse'] = row['normal_impulse']
            row['normal_impulse'] = projected
            changed = max(changed, abs(projected - row['previous_impulse']))
            largest = max(largest, projected)
        if changed <= 1e-15 * largest:  # as exact as doubles: symmetric racks must stay symmetric
            break
        following = 0.5 * (1.0 + sqrt(1.0 + 4.0 * momentum * momentum))
        weight = (momentum - 1.0) / following
        momentum = following
        if turned > 0.0:  # momentum against the gradient: adaptive restart (O'Donoghue and Candes)
            weight = 0.0
            momentum = 1.0
        for n in range(count):
            row = contacts[n]
            change = row['normal_impulse'] - row['previous_impulse']
            row['extrapolated_impulse'] = row['normal_impulse'] + weight * change


@kernel
def count_contacts(work: WorkRecord) -> int:
    """Count the active contacts. Writes contact_counts, contact_count.

    The first is that of each ball, the other that of the one of a contact's balls that has more of
    them.
    """
    for k in range(work.counts[INVOLVED]):
        work.impact.contact_counts[work.involved[k]] = 0.0
    active = 0
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        if row['active']:
            active += 1
            work.impact.contact_counts[row['a']] += 1.0
            if row['b'] >= 0:
                work.impact.contact_counts[row['b']] += 1.0
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        row['contact_count'] = work.impact.contact_counts[row['a']]
        if row['b'] >= 0:
            row['contact_count'] = max(row['contact_count'], work.impact.contact_counts[row['b']])
    return active


@kernel
def apply_extrapolated(work: WorkRecord) -> None:
    """Sum up what the contacts' `extrapolated_impulse` changes of the velocities.

    Writes velocity_change.
    """
    for k in range(work.counts[INVOLVED]):
        store(work.impact.velocity_change[work.involved[k]], ZERO)
    for n in range(work.counts[CONTACTS]):
        row = work.contacts[n]
        if row['active'] and row['extrapolated_impulse'] != 0.0:
            a = work.impact.velocity_change[row['a']]
            store(a, add_scaled(load(a), row['extrapolated_impulse'], load(row['normal'])))
            if row['b'] >= 0:
                b = work.impact.velocity_change[row['b']]
                store(b, add_scaled(load(b), -row['extrapolated_impulse'], load(row['normal'])))


@kernel
def rate_change(work: WorkRecord, row: ContactRecord) -> float:
    """Change of a contact's rate [m/s] by velocity_change."""
    normal = load(row['normal'])
    change = dot(load(work.impact.velocity_change[row['a']]), normal)
    if row['b'] >= 0:
        change -= dot(load(work.impact.velocity_change[row['b']]), normal)
    return change


@kernel
def apply_impulses(land: SceneRecord, balls: np.ndarray, work: WorkRecord, last: bool) -> None:
    """Apply normal impulses, with restitution unless it is the `last` round, then friction.

    Writes motion, friction_impulse, impulse.
    """
    contacts = work.contacts
    for n in range(work.counts[CONTACTS]):
        row = contacts[n]
        if row['active']:
            normal_impulse = applied_impulse(land, row, last)
            apply_to_both(land, balls, row, scale(normal_impulse, load(row['normal'])))
    # All tangential impulses are found before any is applied (Jacobi, not Gauss-Seidel), and the
    # contacts of a ball share its slip: so no contact comes first.
    for n in range(work.counts[CONTACTS]):
        row = contacts[n]
        if row['active']:
            bond = ContactProperties(
                0.0, row['tangential_restitution'], row['friction'], row['mass'], land.ball.inertia
            )
            normal_impulse = applied_impulse(land, row, last)
            tangent_impulse = friction(bond, normal_impulse, contact_slip(land, balls, row))
            store(row['friction_impulse'], scale(1.0 / row['contact_count'], tangent_impulse))
    for n in range(work.counts[CONTACTS]):
        row = contacts[n]
        if row['active']:
            apply_to_both(land, balls, row, load(row['friction_impulse']))


@kernel
def applied_impulse(land: SceneRecord, row: ContactRecord, last: bool) -> float:
    """Compute a contact's normal impulse [N s], with restitution unless in the `last` round."""
    e = 0.0 if last else row['restitution']
    return row['normal_impulse'] * ((1.0 + e) * land.ball.mass)


@kernel
def apply_to_both(
    land: SceneRecord, balls: np.ndarray, row: ContactRecord, impulse: Vector
) -> None:
    """Apply `impulse` [N s] to both bodies of a contact. Writes motion, impulse."""
    normal = load(row['normal'])
    store(row['impulse'], add(load(row['impulse']), impulse))
    apply_impulse(balls[row['a']], impulse, normal, land.ball)
    if row['b'] >= 0:
        apply_impulse(balls[row['b']], scale(-1.0, impulse), scale(-1.0, normal), land.ball)


@kernel
def contact_slip(land: SceneRecord, balls: np.ndarray, row: ContactRecord) -> Vector:
    """Slip [m/s] of a contact: tangential velocity of `a`'s surface, relative to the other's."""
    a = balls[row['a']]
    velocity = load(a['velocity'])
    spin = load(a['spin'])
    if row['b'] >= 0:
        b = balls[row['b']]
        velocity = sub(velocity, load(b['velocity']))
        spin = add(spin, load(b['spin']))
    return slip(velocity, spin, load(row['normal']), land.ball.radius)
