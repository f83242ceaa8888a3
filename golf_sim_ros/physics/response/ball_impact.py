# SPDX-License-Identifier: Apache-2.0
"""Balls that hit balls."""
from ..collision import ball_interactions
from ..collision.ball_gap import gap_between
from ..collision.ground_contact import GENTLE
from ..collision.workspace import CONTACTS, Crowd, MEMBERS
from ..contact.contact_state import material_number, settle
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.vector import dot, length, put, vector
from ..state.ball import FLIGHT, SLIDE, moves
from ..state.events import BOUNCE, BUMP, next_event
from ..trajectory.equations_of_motion import STILL
from ..trajectory.shot_record import keep_launch
from . import contact_set, simultaneous_impact
from .time_stepping import leave, pile_up

STALL = 1e-4  # s between impacts: of balls that are coming to lean on each other they are less
MANY_MEETINGS = 8
WORTH_TELLING = 0.1  # m/s of approach: slower contacts are not collisions


@ball_interactions.bump.register(Crowd)
def _bump(crowd, land, balls, i, now, log):
    meet_ball(land, balls, i, now, crowd, log)


@shared
def meet_ball(land, balls, i, now, crowd, log):
    """Let ball `i` collide with the ball that it meets, and all that touch. Writes motion; logs impacts."""
    j = balls[i]['target']
    contact_set.enlist(crowd, j)
    contact_set.bring(balls[j], now)
    gap, rate, _ = gap_between(balls[i], balls[j], land.ball.radius, now)
    if gap > contact_set.TOGETHER:
        return  # the other one has got another path meanwhile
    stalls = now - balls[i]['begin'] < STALL
    piled = balls[i]['piled'] or balls[j]['piled']
    if piled:  # the pile passes on what it is given
        contact_set.ball_contact(land, balls, i, j, crowd, now)
    else:
        contact_set.gather(land, balls, crowd, now, 0)
    collide(land, balls, now, crowd, 0, log)
    scatter(land, balls, now, crowd, 0)
    for ball in (balls[i], balls[j]):
        if ball['piled']:
            if rate <= -GENTLE:  # it hits on, and does not wait for the pile
                leave(ball)
            continue
        ball['stalled'] = ball['stalled'] + 1 if stalls else 0
        if moves(ball['phase']) and (piled and rate > -GENTLE or ball['stalled'] > MANY_MEETINGS):
            pile_up(ball)


@shared
def collide(land, balls, now, crowd, first, log):
    """Let the members collide at all contacts. Writes motion; logs impacts, on ground from row `first` on."""
    for k in range(crowd.count[MEMBERS]):
        keep_launch(balls[crowd.members[k]])
    remember(balls, crowd)
    simultaneous_impact.reflect(land, balls, crowd)
    ball_interactions.tell_bumps(crowd, balls, now, log)
    for n in range(first, crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        if row['b'] < 0 and row['approach'] > WORTH_TELLING:
            ball = balls[row['a']]
            ball['bounces'] += 1
            event = tell(balls, now, row, crowd, log)
            event['kind'] = BOUNCE
            event['material'] = material_number(land, ball, row['part'], vector(row['normal']))
            event['sort'] = surfaces.sort(land.ground, row['part'])


@ball_interactions.tell_bumps.register(Crowd)
def _tell_bumps(crowd, balls, now, log):
    for n in range(crowd.count[CONTACTS]):
        row = crowd.contacts[n]
        if row['b'] >= 0 and row['approach'] > WORTH_TELLING:
            event = tell(balls, now, row, crowd, log)
            event['kind'] = BUMP
            event['material'] = row['b']


@kernel
def remember(balls, crowd):
    """Keep the members' motion before the impact, for telling. Writes before."""
    for k in range(crowd.count[MEMBERS]):
        i = crowd.members[k]
        put(crowd.before[i, 0:3], vector(balls[i]['velocity']))
        put(crowd.before[i, 3:6], vector(balls[i]['spin']))


@kernel
def tell(balls, now, row, crowd, log):
    """Log an impact of a contact's ball. Returns the event, which lacks what was hit."""
    ball = balls[row['a']]
    event = next_event(log)
    event['time'] = now
    event['ball'] = row['a']
    put(event['position'], vector(ball['position']))
    put(event['normal'], vector(row['normal']))
    put(event['velocity_before'], vector(crowd.before[row['a'], 0:3]))
    put(event['velocity_after'], vector(ball['velocity']))
    put(event['spin_before'], vector(crowd.before[row['a'], 3:6]))
    put(event['spin_after'], vector(ball['spin']))
    put(event['impulse'], vector(row['impulse']))
    return event


@kernel
def scatter(land, balls, now, crowd, first):
    """Let the members from number `first` on go on as they now move. Writes phases and contacts."""
    for k in range(first, crowd.count[MEMBERS]):
        ball = balls[crowd.members[k]]
        if not moves(ball['phase']):
            if length(vector(ball['velocity'])) + length(vector(ball['spin'])) == 0.0:
                continue
            ball['tail_end'] = now
            ball['leans'] = 0
        lift = dot(vector(ball['velocity']), vector(ball['normal']))
        if ball['piled']:
            ball['phase'] = FLIGHT
        elif ball['phase'] != FLIGHT and ball['support'] >= 0 and abs(lift) <= STILL:
            ball['phase'] = SLIDE
            settle(land, ball, now)
        else:
            ball['phase'] = FLIGHT
        ball['step'] = 0.0
