# SPDX-License-Identifier: Apache-2.0
"""Landing and bouncing: what an impact with the ground does, and what comes after it."""
from ..collision.workspace import INVOLVED
from ..contact.contact_state import heading, contact_material_number, choose_contact_mode, set_support
from ..effects import effective_normal, gravity_at
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.impulse import ContactProperties, impulse, apply_impulse
from ..mechanics.vector import ZERO, add_scaled, dot, length, store, scale, sub, tangential, load
from ..properties.material import restitution
from ..state.ball import FLIGHT, SLIDE
from ..state.events import BOUNCE, next_event
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.shot_record import record_landing
from . import contact_set
from .ball_impact import LEAST_LOGGED_APPROACH, resolve_contact_set, resume_motion
from .contact_solver import is_pressed_by_gravity
from .time_stepping import return_to_events
from .wedged_ball import RAPID, step_wedged, is_wedged

SEAM = 1e-6  # 1 - cosine of the angle below which a surface goes on from another
WALL_REBOUND = 1e-4  # m/s: a wall gives back up to this, so that leaning on it is not endless
# Of its speed: the same of a wall that closes around it, or one turn is thousands of bounces.
HOLLOW_REBOUND = 0.01
SLOW_FOR_AIR = 8.0  # m/s: slower than this the air hardly matters
STEADY_RATIO = 0.1  # of 1 - e: what a ratio of rebound to approach may gain by the approach
LAST_SHARE = 0.1  # of the speed below which bounces are summed
LEAST_MICRO_BOUNCE = 1e-6  # m/s: a bounce 0.05 picometres high


@shared
def resolve_ground_impact(land, balls, i, now, work, log):
    """Let ball `i` collide with its target. Writes motion, phase and contact; logs the impact.

    Other balls that touch it are hit too and become involved.
    """
    ball = balls[i]
    place = load(ball['position'])
    distance, normal = surfaces.nearest(land.ground, ball['target'], place)
    if distance < land.ball.radius:
        place = add_scaled(place, land.ball.radius - distance, normal)
        store(ball['position'], place)
    supported = ball['phase'] != FLIGHT
    if supported and dot(normal, load(ball['normal'])) > 1.0 - SEAM:
        set_support(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
        choose_contact_mode(land, ball, now)
        return
    alone = not supported and surfaces.is_alone(land.ground, ball['target'], place, land.ball.radius)
    if not alone:
        part, same = surfaces.touched(land.ground, place, land.ball.radius, ZERO)
        if part >= 0 and dot(same, normal) > 1.0 - 1e-9:
            ball['target'] = part
    approach = -dot(load(ball['velocity']), normal)
    if approach > LEAST_LOGGED_APPROACH:
        record_landing(ball, now)
        ball['bounces'] += 1
    before = load(ball['velocity']), load(ball['spin'])
    number = contact_material_number(land, ball, ball['target'], normal)
    material = land.materials[number]
    contact_set.add_ground_contact(land, ball, i, ball['target'], normal, material, work)
    contact_set.collect_contacts(land, balls, work, now, 1 if alone else 0)
    if work.count[INVOLVED] > 1 or contact_set.count_approaching(balls, work) > 1:
        resolve_contact_set(land, balls, now, work, 1, log)
        resume_motion(land, balls, now, work, 1)
    else:
        apply_bounce(land, ball, normal, material)
    rebound = max(dot(load(ball['velocity']), normal), 0.0)
    if approach > LEAST_LOGGED_APPROACH:
        log_ground_impact(land, ball, i, now, normal, number, before, log)
    # A single longer segment among many short ones is no way out: on two lips they come in waves.
    if now - ball['begin'] < RAPID:
        ball['rapid_impacts'] += 1
    else:
        ball['rapid_impacts'] = max(ball['rapid_impacts'] - 1, 0)
    choose_after_impact(land, ball, now, (supported, approach, rebound), normal, material)
    if ball['time_stepping']:
        return_to_events(ball)
    elif is_wedged(ball):
        step_wedged(land, balls, i, now, work)


@kernel
def apply_bounce(land, ball, normal, material):
    """Apply the impulse of an impact with what has `normal`. Writes velocity and spin."""
    before = load(ball['velocity'])
    felt = effective_normal(land.effects, normal, before, material['softness'])
    e = restitution(material, -dot(before, felt))
    bond = ContactProperties(e, material['tangential_restitution'], material['dynamic_friction'],
                             land.ball.mass, land.ball.inertia)
    apply_impulse(ball, impulse(bond, before, load(ball['spin']), felt, land.ball.radius), felt, land.ball)
    rebound = dot(load(ball['velocity']), normal)
    if rebound < 0.0:  # a tilted normal may send it into the ground: the true surface holds it
        store(ball['velocity'], add_scaled(load(ball['velocity']), -rebound, normal))


@kernel
def log_ground_impact(land, ball, number, now, normal, material, before, log):
    """Log an impact."""
    event = next_event(log)
    event['time'] = now
    event['ball'] = number
    event['kind'] = BOUNCE
    event['material'] = material
    event['sort'] = surfaces.sort(land.ground, ball['target'])
    store(event['position'], load(ball['position']))
    store(event['normal'], normal)
    store(event['velocity_before'], before[0])
    store(event['velocity_after'], load(ball['velocity']))
    store(event['spin_before'], before[1])
    store(event['spin_after'], load(ball['spin']))
    store(event['impulse'], scale(land.ball.mass, sub(load(ball['velocity']), before[0])))


@kernel
def choose_after_impact(land, ball, now, impact, normal, material):
    """Decide whether the ball flies on, or stays on what it hit or on what it was on."""
    supported, approach, rebound = impact
    if is_pressed_by_gravity(land, ball, normal):
        press = -dot(gravity_at(land.effects, load(ball['position'])), normal)
        bounciness = 1.0
        if rebound < micro_bounce_threshold(land, ball):
            bounciness = effective_restitution(land, ball, normal, material, rebound)
        if bounciness < 1.0:
            # Bounces of speed v, e v, e^2 v ... last 2 v / (g (1 - e)) in all and press with
            # v (1 + e) / (1 - e) on the whole: (1 + e) / 2 of the weight, on the average.
            ball['micro_bounce_end'] = now + 2.0 * rebound / (press * (1.0 - bounciness))
            ball['micro_bounce_load'] = 0.5 * (1.0 + bounciness)
            set_support(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
            ball['phase'] = SLIDE
            choose_contact_mode(land, ball, now)
            return
    else:
        least = min(approach, wall_rebound(land, ball))
        if rebound < least:
            store(ball['velocity'], add_scaled(load(ball['velocity']), least - rebound, normal))
        if supported and abs(dot(load(ball['velocity']), load(ball['normal']))) <= LEAST_SPEED:
            ball['phase'] = SLIDE
            choose_contact_mode(land, ball, now)
            return
    ball['phase'] = FLIGHT
    ball['step'] = 0.0
    store(ball['normal'], normal)


@kernel
def effective_restitution(land, ball, normal, material, rebound):
    """The constant ratio of rebound to approach with which bounces from now on would last as long in all.

    From e0 it changes with the approach, as restitution does and as soft turf throws a fast ball up. To first
    order, sum of v, e v, ... is v / (1 - e0) + e1 v^2 / ((1 - e0) (1 - e0^2)): as if the ratio were all the
    while that of an approach of v / (1 + e0). Where that is much more than e0, it is 1: bounces go on. But a
    law of turf that does not fade with the approach has no such sum at all: at last it counts no more.
    """
    if rebound <= LEAST_SPEED:
        return 0.0
    e0 = restitution(material, 0.0)
    approach = rebound / (1.0 + e0)
    before = add_scaled(tangential(load(ball['velocity']), normal), -approach, normal)
    felt = effective_normal(land.effects, normal, before, material['softness'])
    into = -dot(before, felt)
    e = (1.0 + restitution(material, into)) * into * dot(felt, normal) / approach - 1.0
    if e - e0 < STEADY_RATIO * (1.0 - e0):
        return e
    if rebound < LAST_SHARE * micro_bounce_threshold(land, ball):
        return restitution(material, approach)
    return 1.0


@kernel
def wall_rebound(land, ball):
    """Speed [m/s] up to which a wall gives all of the approach back."""
    if surfaces.hollow(land.ground, ball['target']) == 0.0:
        return WALL_REBOUND
    return max(WALL_REBOUND, HOLLOW_REBOUND * length(load(ball['velocity'])))


@kernel
def micro_bounce_threshold(land, ball):
    """Rebound below which the rest of the bounces is summed: less for a fast ball.

    The air takes its share of the sum at once, a little early: that is an error of place that goes with the
    square of the speed, and of the time that the bounces last.
    """
    return max(land.limits.settle / (1.0 + length(load(ball['velocity'])) / SLOW_FOR_AIR), LEAST_MICRO_BOUNCE)


@shared
def cross_border(land, ball, now):
    """Find out what the ball is on past a border in plan. Writes phase and contact."""
    ahead = heading(land, ball)
    part, normal = surfaces.touched(land.ground, load(ball['position']), land.ball.radius, ahead)
    if part < 0:
        ball['phase'] = FLIGHT
        ball['step'] = 0.0
        return
    distance, normal = surfaces.under(land.ground, part, load(ball['position']), ahead)
    store(ball['position'], add_scaled(load(ball['position']), land.ball.radius - distance, normal))
    set_support(land, ball, part, normal)
    choose_contact_mode(land, ball, now)
