# SPDX-License-Identifier: Apache-2.0
"""Balls that lean on each other for good: piles, racks, two balls in a bowl.

There impacts follow each other ever faster. Such balls are piled: they move in small steps of time, all at
the same instants. At each of them their contacts are solved together (Moreau's time stepping: projected
Gauss-Seidel on the impulses, with friction, then projected positions). A contact that is yet to close
may close just up to its gap. What has been calm for a while falls asleep, and awakes when it is touched or
when what it leans on sets off.
"""
from math import floor

from . import others
from ._compile import kernel, shared
from .caught import MANY_STALLS, is_caught, presses
from .contact import material_of, settle, stand_on
from .crowd import CONTACTS, MEMBERS, Crowd, next_node
from .detect import PILE_NEAR
from .ground import surface
from .pair import UP, place_at, velocity_at
from .state import FLIGHT, HOLED, NO_PART, REST, SLIDE, moves
from .together import bring, enlist, give, is_new, new_contact, rate_of, sliding_of
from .vector import ZERO, along, dot, length, put, scale, sub, unit, vector

PILE_STEP = 1.0 / 512.0  # s; a power of two, so that instants are the same for all
SWEEPS = 40
DONE = 1e-5  # m/s: a sweep that changes less is the last
SHIFTS = 6  # sweeps over positions
PUSHED = 1e-3  # m/s of approach wake a sleeper
CREEP = 0.02  # m/s: what moves slower in a pile is damped, for the sweeps never quite end
DAMPED = 0.9
CALM = 4e-3  # m/s
CALM_STEPS = 50
FREE = 1.0  # m/s: faster than this a ball flies on its own


@kernel
def next_instant(now):
    """The next instant at which piles are solved."""
    return (floor(now / PILE_STEP) + 1.0) * PILE_STEP


@kernel
def is_instant(now):
    """Whether piles are solved at `now`."""
    return floor(now / PILE_STEP) * PILE_STEP == now


@kernel
def pile_up(ball):
    """Make a ball one of a pile."""
    ball['piled'] = 1
    ball['stalled'] = MANY_STALLS + 1
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    ball['calm'] = 0


@shared
def leans_on_a_ball(balls, crowd, i, radius, now):
    """Whether another ball is within PILE_NEAR of ball `i`."""
    here = vector(balls[i]['position'])
    low, high = surface.around(here, radius + PILE_NEAR)
    at = next_node(crowd, 0, low, high)
    while at >= 0:
        j = crowd.nodes[at]['ball']
        if j != i and balls[j]['phase'] != HOLED and (
                length(sub(here, place_at(balls[j], now))) - 2.0 * radius <= PILE_NEAR):
            return True
        at = next_node(crowd, at + 1, low, high)
    return False


@others.lean.register(Crowd)
def _lean(crowd, land, balls, i, now):
    if balls[i]['piled']:
        if is_instant(now):
            hold_pile(land, balls, now, crowd)
        return True
    if is_caught(balls[i]) and leans_on_a_ball(balls, crowd, i, land.ball.radius, now):
        pile_up(balls[i])
        return True
    return False


@others.rouse.register(Crowd)
def _rouse(crowd, balls, radius, now):
    k = 0
    while k < crowd.count[MEMBERS]:
        i = crowd.members[k]
        k += 1
        if balls[i]['phase'] == REST:
            continue
        here = vector(balls[i]['position'])
        low, high = surface.around(here, radius + 2.0 * PILE_NEAR)
        at = next_node(crowd, 0, low, high)
        while at >= 0:
            j = crowd.nodes[at]['ball']
            at = next_node(crowd, at + 1, low, high)
            other = balls[j]
            if crowd.places[j] < 0 and other['phase'] == REST and other['leans'] and (
                    length(sub(here, vector(other['position']))) - 2.0 * radius <= 2.0 * PILE_NEAR):
                enlist(crowd, j)
                pile_up(other)


@shared
def hold_pile(land, balls, now, crowd):
    """Solve all contacts of the piled balls that are due: the members. Writes motion and phases."""
    for i in range(len(balls)):
        if balls[i]['piled'] and crowd.ends[i] == now and crowd.places[i] < 0:
            enlist(crowd, i)
            bring(balls[i], now)
    find_contacts(land, balls, crowd, now)
    for sweep in range(SWEEPS):
        if press_once(land, balls, crowd, sweep % 2 == 1) <= DONE:
            break
    for k in range(crowd.count[MEMBERS]):
        balls[crowd.members[k]]['braking'] = 0.0
        balls[crowd.members[k]]['held'] = 0
        put(balls[crowd.members[k]]['normal'], ZERO)
        balls[crowd.members[k]]['support'] = NO_PART
    for n in range(crowd.count[CONTACTS]):
        hold_up(land, balls, crowd.contacts[n])
    for sweep in range(SHIFTS):
        shift_once(land, balls, crowd)
    for k in range(crowd.count[MEMBERS]):
        let_go(land, balls[crowd.members[k]], now)


@kernel
def find_contacts(land, balls, crowd, now):
    """Contacts of the members, with what is near and what they may reach. Writes contacts, members."""
    radius = land.ball.radius
    fastest = 0.0
    for k in range(crowd.count[MEMBERS]):
        fastest = max(fastest, length(vector(balls[crowd.members[k]]['velocity'])))
    reach = PILE_NEAR + 2.0 * PILE_STEP * fastest
    k = 0
    while k < crowd.count[MEMBERS]:
        i = crowd.members[k]
        ball = balls[i]
        here = vector(ball['position'])
        find_ground(land, ball, i, crowd)
        low, high = surface.around(here, radius + reach)
        at = next_node(crowd, 0, low, high)
        while at >= 0:
            j = crowd.nodes[at]['ball']
            at = next_node(crowd, at + 1, low, high)
            other = balls[j]
            if j == i or other['phase'] == HOLED or 0 <= crowd.places[j] < k:
                continue
            apart = sub(here, place_at(other, now))
            gap = length(apart) - 2.0 * radius
            if gap > reach:
                continue
            normal = unit(apart, UP)
            rate = dot(sub(vector(ball['velocity']), velocity_at(other, now)), normal)
            if crowd.places[j] < 0 and moves(other['phase']):
                continue  # it comes by itself
            if crowd.places[j] < 0 and (rate < -PUSHED or other['leans'] and rate > PUSHED):
                enlist(crowd, j)
                pile_up(other)
            together_with = j if crowd.places[j] >= 0 else -1
            row = new_contact(crowd, i, together_with, -2, normal)
            if row >= 0:
                set_contact(crowd.contacts[row], gap, 0.5 if together_with >= 0 else 1.0,
                            (land.ball.friction, 0.0), land.ball)
        k += 1


@kernel
def find_ground(land, ball, i, crowd):
    """Contacts of a member with the ground. Writes contacts."""
    begin = crowd.count[CONTACTS]
    place = vector(ball['position'])
    low, high = surface.around(place, land.ball.radius + PILE_NEAR)
    part = surface.next_part(land.ground, 0, low, high)
    while part >= 0:
        distance, normal = surface.nearest(land.ground, part, place)
        gap = distance - land.ball.radius
        if gap <= PILE_NEAR and is_new(crowd, begin, normal) and surface.touchable(land.ground, part, place):
            row = new_contact(crowd, i, -1, part, normal)
            if row >= 0:
                material = material_of(land, ball, part, normal)
                set_contact(crowd.contacts[row], gap, 1.0,
                            (material['dynamic_friction'], material['rolling_resistance']), land.ball)
        part = surface.next_part(land.ground, part + 1, low, high)


@kernel
def set_contact(row, gap, share, material, record):
    """Fill in a contact: its gap, share of a ball's mass, friction and rolling resistance."""
    row['ahead'] = gap
    row['mass'] = share * record.mass
    row['friction'] = material[0]
    row['shared'] = material[1]
    row['push'] = 0.0
    put(row['rub'], ZERO)


@kernel
def press_once(land, balls, crowd, backward):
    """One sweep over all contacts. Writes motion and impulses; returns the greatest change [m/s]."""
    most = 0.0
    count = crowd.count[CONTACTS]
    for k in range(count):
        row = crowd.contacts[count - 1 - k if backward else k]
        room = max(row['ahead'], 0.0) / PILE_STEP
        wanted = row['push'] - row['mass'] * (rate_of(balls, row) + room)
        push = max(wanted, 0.0)
        change = push - row['push']
        row['push'] = push
        if change != 0.0:
            give(land, balls, row, scale(change, vector(row['normal'])))
            most = max(most, abs(change) / row['mass'])
        if push > 0.0:
            grip = row['mass'] * land.ball.inertia / (1.0 + land.ball.inertia)
            rub = along(vector(row['rub']), -grip, sliding_of(land, balls, row))
            size = length(rub)
            if size > row['friction'] * push:
                rub = scale(row['friction'] * push / size, rub)
            give(land, balls, row, sub(rub, vector(row['rub'])))
            put(row['rub'], rub)
    return most


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
    ball['braking'] += row['shared'] * row['push'] / land.ball.mass
    if presses(land, ball, normal) and normal[2] > ball['normal'][2]:
        stand_on(land, ball, surface.support_of(land.ground, row['part']), normal)


@kernel
def shift_once(land, balls, crowd):
    """Push apart what overlaps. Writes positions."""
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        a = balls[row['a']]
        place = vector(a['position'])
        if row['part'] >= 0:
            distance, normal = surface.nearest(land.ground, row['part'], place)
            if distance < land.ball.radius:
                put(a['position'], along(place, land.ball.radius - distance, normal))
        elif row['b'] >= 0:
            b = balls[row['b']]
            apart = sub(place, vector(b['position']))
            overlap = 2.0 * land.ball.radius - length(apart)
            if overlap > 0.0:
                normal = unit(apart, UP)
                put(a['position'], along(place, 0.5 * overlap, normal))
                put(b['position'], along(vector(b['position']), -0.5 * overlap, normal))


@kernel
def let_go(land, ball, now):
    """Let a member rest, roll away, fly away, or stay in the pile. Writes motion and phase."""
    speed = length(vector(ball['velocity']))
    left = max(speed - ball['braking'], 0.0)
    if left < CREEP and ball['held'] > 1:
        left *= DAMPED
    if speed > 0.0:
        put(ball['velocity'], scale(left / speed, vector(ball['velocity'])))
        put(ball['spin'], scale(left / speed, vector(ball['spin'])))
    turning = land.ball.radius * length(vector(ball['spin']))
    ball['calm'] = ball['calm'] + 1 if left + turning < CALM and ball['held'] > 0 else 0
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    if ball['calm'] > CALM_STEPS:
        ball['leans'] = 1 if ball['held'] > 1 else 0
        ball['piled'] = 0
        ball['stalled'] = 0
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST
    elif ball['held'] == 0 or speed > FREE:
        ball['piled'] = 0
        ball['stalled'] = 0
    elif ball['held'] == 1 and ball['support'] != NO_PART:
        ball['piled'] = 0
        ball['stalled'] = 0
        ball['phase'] = SLIDE
        settle(land, ball, now)
