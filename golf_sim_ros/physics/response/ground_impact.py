# SPDX-License-Identifier: Apache-2.0
"""Landing and bouncing: what an impact with the ground does, and what comes after it."""
from ..collision.workspace import MEMBERS
from ..contact.contact_state import heading, material_number, settle, stand_on
from ..effects import felt_normal, pull
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.impulse import Bond, impulse, take
from ..mechanics.vector import ZERO, along, dot, length, put, scale, sub, tangential, vector
from ..properties.material import restitution
from ..state.ball import FLIGHT, SLIDE
from ..state.events import BOUNCE, next_event
from ..trajectory.equations_of_motion import STILL
from ..trajectory.shot_record import note_landing
from . import contact_set
from .ball_impact import WORTH_TELLING, collide, scatter
from .contact_solver import presses
from .time_stepping import leave
from .wedged_ball import STALL, hold, is_caught

SEAM = 1e-6  # 1 - cosine of the angle below which a surface goes on from another
WALL_REBOUND = 1e-4  # m/s: a wall gives back up to this, so that leaning on it is not endless
ROUND = 0.01  # of its speed: the same of a wall that closes around it, or one turn is thousands of bounces
SLOW = 8.0  # m/s: slower than this the air hardly matters
STEADY = 0.1  # of 1 - e: what a ratio of rebound to approach may gain by the approach
AT_LAST = 0.1  # of the speed below which bounces are summed
LEAST_SETTLE = 1e-6  # m/s: a bounce 0.05 picometres high


@shared
def meet(land, balls, i, now, crowd, log):
    """Let ball `i` collide with its target. Writes motion, phase and contact; logs the impact.

    Other balls that touch it are hit too and become members of the crowd.
    """
    ball = balls[i]
    place = vector(ball['position'])
    distance, normal = surfaces.nearest(land.ground, ball['target'], place)
    if distance < land.ball.radius:
        place = along(place, land.ball.radius - distance, normal)
        put(ball['position'], place)
    supported = ball['phase'] != FLIGHT
    if supported and dot(normal, vector(ball['normal'])) > 1.0 - SEAM:
        stand_on(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
        settle(land, ball, now)
        return
    alone = not supported and surfaces.alone(land.ground, ball['target'], place, land.ball.radius)
    if not alone:
        part, same = surfaces.touched(land.ground, place, land.ball.radius, ZERO)
        if part >= 0 and dot(same, normal) > 1.0 - 1e-9:
            ball['target'] = part
    approach = -dot(vector(ball['velocity']), normal)
    if approach > WORTH_TELLING:
        note_landing(ball, now)
        ball['bounces'] += 1
    before = vector(ball['velocity']), vector(ball['spin'])
    number = material_number(land, ball, ball['target'], normal)
    material = land.materials[number]
    contact_set.ground_contact(land, ball, i, ball['target'], normal, material, crowd)
    contact_set.gather(land, balls, crowd, now, 1 if alone else 0)
    if crowd.count[MEMBERS] > 1 or contact_set.approaching(balls, crowd) > 1:
        collide(land, balls, now, crowd, 1, log)
        scatter(land, balls, now, crowd, 1)
    else:
        bounce(land, ball, normal, material)
    rebound = max(dot(vector(ball['velocity']), normal), 0.0)
    if approach > WORTH_TELLING:
        tell(land, ball, i, now, normal, number, before, log)
    # A single longer piece among many short ones is no way out: on two lips they come in waves.
    ball['stalled'] = ball['stalled'] + 1 if now - ball['begin'] < STALL else max(ball['stalled'] - 1, 0)
    after_impact(land, ball, now, (supported, approach, rebound), normal, material)
    if ball['piled']:
        leave(ball)
    elif is_caught(ball):
        hold(land, balls, i, now, crowd)


@kernel
def bounce(land, ball, normal, material):
    """Apply the impulse of an impact with what has `normal`. Writes velocity and spin."""
    before = vector(ball['velocity'])
    felt = felt_normal(land.effects, normal, before, material['softness'])
    e = restitution(material, -dot(before, felt))
    bond = Bond(e, material['tangential_restitution'], material['dynamic_friction'],
                land.ball.mass, land.ball.inertia)
    take(ball, impulse(bond, before, vector(ball['spin']), felt, land.ball.radius), felt, land.ball)
    rebound = dot(vector(ball['velocity']), normal)
    if rebound < 0.0:  # a tilted normal may send it into the ground: the true surface holds it
        put(ball['velocity'], along(vector(ball['velocity']), -rebound, normal))


@kernel
def tell(land, ball, number, now, normal, material, before, log):
    """Log an impact."""
    event = next_event(log)
    event['time'] = now
    event['ball'] = number
    event['kind'] = BOUNCE
    event['material'] = material
    event['sort'] = surfaces.sort(land.ground, ball['target'])
    put(event['position'], vector(ball['position']))
    put(event['normal'], normal)
    put(event['velocity_before'], before[0])
    put(event['velocity_after'], vector(ball['velocity']))
    put(event['spin_before'], before[1])
    put(event['spin_after'], vector(ball['spin']))
    put(event['impulse'], scale(land.ball.mass, sub(vector(ball['velocity']), before[0])))


@kernel
def after_impact(land, ball, now, impact, normal, material):
    """Decide whether the ball flies on, or stays on what it hit or on what it was on."""
    supported, approach, rebound = impact
    if presses(land, ball, normal):
        press = -dot(pull(land.effects, vector(ball['position'])), normal)
        bounciness = 1.0
        if rebound < settle_speed(land, ball):
            bounciness = lasting_bounciness(land, ball, normal, material, rebound)
        if bounciness < 1.0:
            # Bounces of speed v, e v, e^2 v ... last 2 v / (g (1 - e)) in all and press with
            # v (1 + e) / (1 - e) on the whole: (1 + e) / 2 of the weight, on the average.
            ball['tail_end'] = now + 2.0 * rebound / (press * (1.0 - bounciness))
            ball['tail_press'] = 0.5 * (1.0 + bounciness)
            stand_on(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
            ball['phase'] = SLIDE
            settle(land, ball, now)
            return
    else:
        least = min(approach, wall_rebound(land, ball))
        if rebound < least:
            put(ball['velocity'], along(vector(ball['velocity']), least - rebound, normal))
        if supported and abs(dot(vector(ball['velocity']), vector(ball['normal']))) <= STILL:
            ball['phase'] = SLIDE
            settle(land, ball, now)
            return
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    put(ball['normal'], normal)


@kernel
def lasting_bounciness(land, ball, normal, material, rebound):
    """The constant ratio of rebound to approach with which bounces from now on would last as long in all.

    From e0 it changes with the approach, as restitution does and as soft turf throws a fast ball up. To first
    order, sum of v, e v, ... is v / (1 - e0) + e1 v^2 / ((1 - e0) (1 - e0^2)): as if the ratio were all the
    while that of an approach of v / (1 + e0). Where that is much more than e0, it is 1: bounces go on. But a
    law of turf that does not fade with the approach has no such sum at all: at last it counts no more.
    """
    if rebound <= STILL:
        return 0.0
    e0 = restitution(material, 0.0)
    approach = rebound / (1.0 + e0)
    before = along(tangential(vector(ball['velocity']), normal), -approach, normal)
    felt = felt_normal(land.effects, normal, before, material['softness'])
    into = -dot(before, felt)
    e = (1.0 + restitution(material, into)) * into * dot(felt, normal) / approach - 1.0
    if e - e0 < STEADY * (1.0 - e0):
        return e
    return restitution(material, approach) if rebound < AT_LAST * settle_speed(land, ball) else 1.0


@kernel
def wall_rebound(land, ball):
    """Speed [m/s] up to which a wall gives all of the approach back."""
    if surfaces.hollow(land.ground, ball['target']) == 0.0:
        return WALL_REBOUND
    return max(WALL_REBOUND, ROUND * length(vector(ball['velocity'])))


@kernel
def settle_speed(land, ball):
    """Rebound below which the rest of the bounces is summed: less for a fast ball.

    The air takes its share of the sum at once, a little early: that is an error of place that goes with the
    square of the speed, and of the time that the bounces last.
    """
    return max(land.limits.settle / (1.0 + length(vector(ball['velocity'])) / SLOW), LEAST_SETTLE)


@shared
def cross_border(land, ball, now):
    """Find out what the ball is on past a border in plan. Writes phase and contact."""
    ahead = heading(land, ball)
    part, normal = surfaces.touched(land.ground, vector(ball['position']), land.ball.radius, ahead)
    if part < 0:
        ball['phase'] = FLIGHT
        ball['step'] = 0.0
        return
    distance, normal = surfaces.under(land.ground, part, vector(ball['position']), ahead)
    put(ball['position'], along(vector(ball['position']), land.ball.radius - distance, normal))
    stand_on(land, ball, part, normal)
    settle(land, ball, now)
