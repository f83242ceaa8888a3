# SPDX-License-Identifier: Apache-2.0
"""Landing and bouncing: what an impact with the ground does, and what comes after it."""
from ._compile import kernel
from .contact import STILL, settle
from .effects import felt_normal, pull
from .ground import surface
from .impulse import Bond, impulse, take
from .material import restitution
from .state import BOUNCE, FLIGHT, REST, SLIDE
from .vector import ZERO, along, dot, length, put, scale, sub, vector

WORTH_TELLING = 0.1  # m/s of approach: slower contacts are not collisions
SEAM = 1e-6  # 1 - cosine of the angle below which a surface goes on from another
WALL = 1e-3  # least part of gravity that must press for a ball to come to rest on a surface
WALL_REBOUND = 1e-4  # m/s: a wall gives back up to this, so that leaning on it is not endless
STALL = 1e-6  # s between impacts: below this a ball is caught between surfaces
MANY_STALLS = 20
CAUGHT = 2e-3  # m/s: slower than this between two surfaces is at rest


@kernel
def meet(model, ball, number, now, log):
    """Let the ball collide with its target. Writes motion, phase and contact; logs the impact."""
    place = vector(ball['position'])
    distance, normal = surface.nearest(model.ground, ball['target'], place)
    if distance < model.ball.radius:
        place = along(place, model.ball.radius - distance, normal)
        put(ball['position'], place)
    supported = ball['phase'] != FLIGHT
    if supported and dot(normal, vector(ball['normal'])) > 1.0 - SEAM:
        ball['support'] = ball['target']
        put(ball['normal'], normal)
        settle(model, ball, now)
        return
    part, same = surface.touched(model.ground, place, model.ball.radius, ZERO)
    if part >= 0 and dot(same, normal) > 1.0 - 1e-9:
        ball['target'] = part
    approach = -dot(vector(ball['velocity']), normal)
    rebound, bounciness = bounce(model, ball, number, now, normal, log)
    if approach > WORTH_TELLING:
        ball['bounces'] += 1
    ball['stalled'] = ball['stalled'] + 1 if now - ball['begin'] < STALL else 0
    after_impact(model, ball, now, (supported, approach, rebound, bounciness), normal)
    if ball['stalled'] > MANY_STALLS and length(vector(ball['velocity'])) < CAUGHT:
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST


@kernel
def bounce(model, ball, number, now, normal, log):
    """Apply the impact's impulse; return the rebound speed off `normal` and the restitution."""
    material = model.materials[surface.material_of(model.ground, ball['target'])]
    before = vector(ball['velocity'])
    spun = vector(ball['spin'])
    felt = felt_normal(model.effects, normal, before, material['softness'])
    e = restitution(material, -dot(before, felt))
    bond = Bond(e, material['tangential_restitution'], material['dynamic_friction'],
                model.ball.mass, model.ball.inertia)
    take(ball, impulse(bond, before, spun, felt, model.ball.radius), felt, model.ball)
    rebound = dot(vector(ball['velocity']), normal)
    if rebound < 0.0:  # a tilted normal may send it into the ground: the true surface holds it
        put(ball['velocity'], along(vector(ball['velocity']), -rebound, normal))
        rebound = 0.0
    if -dot(before, normal) > WORTH_TELLING:
        tell(model, ball, number, now, normal, (before, spun), log)
    return rebound, restitution(material, rebound)


@kernel
def tell(model, ball, number, now, normal, before, log):
    """Log an impact."""
    event = log.events[log.count[0]]
    log.count[0] += 1
    event['time'] = now
    event['ball'] = number
    event['kind'] = BOUNCE
    event['material'] = surface.material_of(model.ground, ball['target'])
    put(event['position'], vector(ball['position']))
    put(event['normal'], normal)
    put(event['velocity_before'], before[0])
    put(event['velocity_after'], vector(ball['velocity']))
    put(event['spin_before'], before[1])
    put(event['spin_after'], vector(ball['spin']))
    put(event['impulse'], scale(model.ball.mass, sub(vector(ball['velocity']), before[0])))


@kernel
def after_impact(model, ball, now, impact, normal):
    """Decide whether the ball flies on, or stays on what it hit or on what it was on."""
    supported, approach, rebound, bounciness = impact
    press = -dot(pull(model.effects, vector(ball['position'])), normal)
    if press > WALL * length(pull(model.effects, vector(ball['position']))):
        if rebound <= STILL or rebound < model.limits.settle and bounciness < 1.0:
            # Bounces of speed v, e v, e^2 v ... last 2 v / (g (1 - e)) in all and press with
            # v (1 + e) / (1 - e) on the whole: (1 + e) / 2 of the weight, on the average.
            ball['tail_end'] = now
            if bounciness < 1.0:
                ball['tail_end'] = now + 2.0 * rebound / (press * (1.0 - bounciness))
            ball['tail_press'] = 0.5 * (1.0 + bounciness)
            ball['support'] = ball['target']
            put(ball['normal'], normal)
            ball['phase'] = SLIDE
            settle(model, ball, now)
            return
    else:
        least = min(approach, WALL_REBOUND)
        if rebound < least:
            put(ball['velocity'], along(vector(ball['velocity']), least - rebound, normal))
        if supported and abs(dot(vector(ball['velocity']), vector(ball['normal']))) <= STILL:
            ball['phase'] = SLIDE
            settle(model, ball, now)
            return
    ball['phase'] = FLIGHT
    ball['step'] = 0.0


@kernel
def cross_border(model, ball, now):
    """Find out what the ball is on past a border in plan. Writes phase and contact."""
    velocity = vector(ball['velocity'])
    speed = length(velocity)
    ahead = scale(1.0 / speed, velocity) if speed > 0.0 else ZERO
    part, normal = surface.touched(model.ground, vector(ball['position']), model.ball.radius, ahead)
    if part < 0:
        ball['phase'] = FLIGHT
        ball['step'] = 0.0
        return
    ball['support'] = part
    distance, normal = surface.nearest(model.ground, part, vector(ball['position']))
    put(ball['position'], along(vector(ball['position']), model.ball.radius - distance, normal))
    put(ball['normal'], normal)
    settle(model, ball, now)

