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

"""Impact with the ground: the impulse, and whether the ball flies, slides or rolls afterwards."""

import numpy as np

from . import contact_set
from .ball_impact import LEAST_LOGGED_APPROACH, resolve_contact_set, resume_motion
from .collision_log import log_impact
from .contact_solver import is_pressed_by_gravity
from .time_stepping import return_to_events
from .wedged_ball import is_wedged, RAPID, step_wedged
from ..collision.workspace import INVOLVED
from ..contact.contact_state import (
    choose_contact_mode,
    contact_material_number,
    heading,
    set_support,
    touch_down,
)
from ..effects import effective_normal, gravity_at, velocity_after
from ..effects.protocol import Hit
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, MaterialRecord, SceneRecord, Vector, WorkRecord
from ..mechanics.impulse import after_impulse, ContactProperties, impulse
from ..mechanics.vector import add_scaled, dot, length, load, scale, store, sub, tangential, ZERO
from ..properties.material import restitution
from ..state.ball import FLIGHT
from ..state.events import BOUNCE, Log
from ..state.transitions import take_off
from ..trajectory.equations_of_motion import LEAST_SPEED
from ..trajectory.shot_record import record_landing

# 1 - cosine of the angle below which one surface continues another: no impact between them
SEAM = 1e-6
# m/s: least rebound from a wall, or a ball pushed against it would impact without end
WALL_REBOUND = 1e-4
# Of the ball's speed: the same for a concave wall, around which one turn would be thousands of
# impacts.
HOLLOW_REBOUND = 0.01
ON_RELIEF = 0.1  # of the threshold of micro-bounces on a plane: that on height maps and meshes
SLOW_FOR_AIR = 8.0  # m/s: speed from which the air's share of the micro-bounces counts
# of 1 - e0: by so much restitution may grow with the approach and be summed all the same
STEADY_RATIO = 0.1
# of the threshold of micro-bounces: below this they are summed without what turf adds
LAST_SHARE = 0.1
LEAST_MICRO_BOUNCE = 1e-6  # m/s: a bounce 0.05 picometres high


@shared
def resolve_ground_impact(
    land: SceneRecord, balls: np.ndarray, i: int, now: float, work: WorkRecord, log: Log
) -> None:
    """Resolve the impact of ball `i` with its target. Writes ball, work; logs the impact.

    Other balls that touch it take part in the impact and become involved.
    """
    ball = balls[i]
    place = load(ball['position'])
    distance, normal = surfaces.nearest(land.ground, ball['target'], place)
    if distance < land.ball.radius:  # penetration within the tolerance of the time of impact
        place = add_scaled(place, land.ball.radius - distance, normal)
        store(ball['position'], place)
    supported = ball['phase'] != FLIGHT
    # A ball that rolls onto a coplanar surface changes its support and is not hit.
    if supported and dot(normal, load(ball['normal'])) > 1.0 - SEAM:
        set_support(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
        choose_contact_mode(land, ball, now)
        return
    alone = not supported and surfaces.is_alone(
        land.ground, ball['target'], place, land.ball.radius
    )
    # Of coplanar parts the latest in the course gives the material, whichever the search has found
    # first.
    if not alone:
        part, same = surfaces.touched(land.ground, place, land.ball.radius, ZERO)
        if part >= 0 and dot(same, normal) > 1.0 - 1e-9:
            ball['target'] = part
    approach_speed = -dot(load(ball['velocity']), normal)
    if approach_speed > LEAST_LOGGED_APPROACH:
        record_landing(ball, now)
        ball['bounces'] += 1
    before = load(ball['velocity']), load(ball['spin'])
    number = contact_material_number(land, ball, ball['target'], normal)
    material = land.materials[number]
    contact_set.add_ground_contact(land, ball, i, (ball['target'], normal), material, work)
    contact_set.collect_contacts(land, balls, work, now, 1 if alone else 0)
    # A single approaching contact has a closed form; several at one instant are solved together.
    if work.counts[INVOLVED] > 1 or contact_set.count_approaching(balls, work) > 1:
        resolve_contact_set(land, balls, now, work, 1, log)
        resume_motion(land, balls, now, work, 1)
    else:
        apply_bounce(land, ball, normal, material)
    rebound = max(dot(load(ball['velocity']), normal), 0.0)
    if approach_speed > LEAST_LOGGED_APPROACH:
        hit = BOUNCE, number, surfaces.sort(land.ground, ball['target']), normal
        impulse_on_ball = scale(land.ball.mass, sub(load(ball['velocity']), before[0]))
        log_impact(ball, (now, i), hit, before, impulse_on_ball, log)
    # One longer segment among many short ones does not reset the count: between two lips they come
    # in waves.
    if now - ball['begin'] < RAPID:
        ball['rapid_impacts'] += 1
    else:
        ball['rapid_impacts'] = max(ball['rapid_impacts'] - 1, 0)
    choose_after_impact(land, ball, now, (supported, approach_speed, rebound), normal, material)
    if ball['time_stepping']:
        return_to_events(ball)
    elif is_wedged(ball):
        step_wedged(land, balls, i, now, work)


@kernel
def apply_bounce(
    land: SceneRecord, ball: BallRecord, normal: Vector, material: MaterialRecord
) -> None:
    """Apply the impulse of an impact with a surface of `normal`. Writes velocity and spin."""
    motion = load(ball['velocity']), load(ball['spin'])
    velocity, spin = bounced(land, motion, normal, material)
    store(ball['velocity'], velocity)
    store(ball['spin'], spin)


@kernel
def bounced(
    land: SceneRecord, motion: tuple[Vector, Vector], normal: Vector, material: MaterialRecord
) -> tuple[Vector, Vector]:
    """Velocity and spin after an impact of a ball of that `motion`, the two before."""
    if material['ploughing'] > 0.0:
        return ploughed(land, motion, normal, material)
    before, spin = motion
    felt = effective_normal(land.effects, normal, before, material['softness'])
    bond = ContactProperties(
        restitution(material, -dot(before, felt)),
        material['tangential_restitution'],
        material['dynamic_friction'],
        land.ball.mass,
        land.ball.inertia,
    )
    given = impulse(bond, before, spin, felt, land.ball.radius)
    velocity, spin = after_impulse(before, spin, given, felt, land.ball)
    hit = Hit(
        before,
        normal,
        felt,
        scale(1.0 / land.ball.mass, given),
        restitution(material, -dot(before, normal)),
        material['softness'],
    )
    velocity = velocity_after(land.effects, hit, velocity)
    rebound = dot(velocity, normal)
    if rebound < 0.0:  # soft turf tilts the normal, which may leave velocity into the true surface
        velocity = add_scaled(velocity, -rebound, normal)
    return velocity, spin


@kernel
def ploughed(
    land: SceneRecord, motion: tuple[Vector, Vector], normal: Vector, material: MaterialRecord
) -> tuple[Vector, Vector]:
    """Velocity and spin after an impact with loose ground, into which the ball digs.

    It brakes the centre, and it rubs on the spin, each up to a stop: so it gives the ball neither
    spin from its motion nor motion from its spin.
    """
    before, spin = motion
    approach_speed = max(-dot(before, normal), 0.0)
    e = restitution(material, approach_speed)
    normal_impulse = (1.0 + e) * approach_speed
    along = shortened(tangential(before, normal), material['ploughing'] * normal_impulse)
    rubbed = material['dynamic_friction'] * normal_impulse / (land.ball.inertia * land.ball.radius)
    return add_scaled(along, e * approach_speed, normal), shortened(spin, rubbed)


@kernel
def shortened(arrow: Vector, by: float) -> Vector:
    """Vector `arrow` shortened `by` a length, to zero at most."""
    size = length(arrow)
    return scale(max(1.0 - by / size, 0.0), arrow) if size > 0.0 else ZERO


@kernel
def choose_after_impact(
    land: SceneRecord,
    ball: BallRecord,
    now: float,
    impact: tuple[bool, float, float],
    normal: Vector,
    material: MaterialRecord,
) -> None:
    """Choose between flight and contact after an impact.

    Writes phase, step, contact, micro_bounces, velocity, spin.

    The ball flies, or stays on what it hit if gravity presses it there, or on what it was on
    before.
    """
    supported, approach_speed, rebound = impact
    if is_pressed_by_gravity(land, ball, normal):
        press = -dot(gravity_at(land.effects, load(ball['position'])), normal)
        bounciness = 1.0
        if rebound < micro_bounce_threshold(land, ball):
            bounciness = effective_restitution(land, ball, normal, material, rebound)
        if bounciness < 1.0:
            # Micro-bounces of speed v, e v, e^2 v ... last 2 v / (g (1 - e)) in all; their normal
            # impulses over mass sum to v (1 + e) / (1 - e): (1 + e) / 2 of the weight on average.
            ball['micro_bounce_end'] = now + 2.0 * rebound / (press * (1.0 - bounciness))
            ball['micro_bounce_load'] = 0.5 * (1.0 + bounciness)
            set_support(land, ball, surfaces.support_of(land.ground, ball['target']), normal)
            touch_down(land, ball, now)
            return
    else:
        # A wall has no micro-bounces to sum: a least rebound bounds the number of impacts instead.
        least = min(approach_speed, wall_rebound(land, ball))
        if rebound < least:
            store(ball['velocity'], add_scaled(load(ball['velocity']), least - rebound, normal))
        if supported and abs(dot(load(ball['velocity']), load(ball['normal']))) <= LEAST_SPEED:
            touch_down(land, ball, now)
            return
    take_off(ball)
    store(ball['normal'], normal)


@kernel
def effective_restitution(
    land: SceneRecord, ball: BallRecord, normal: Vector, material: MaterialRecord, rebound: float
) -> float:
    """Constant restitution with which the remaining bounces would last as long in all.

    1 to follow them one by one.

    Restitution changes from e0 with the approach, by its own law and as soft turf throws a fast
    ball up. To first order the sum of v, e v, ... is
    v / (1 - e0) + e1 v^2 / ((1 - e0) (1 - e0^2)): that of a constant restitution, the one at an
    approach of v / (1 + e0). Where that is much more than e0, first order does not do, and bounces
    are followed one by one, and so they are where each brakes the ball in proportion. A turf law
    that does not fade with the approach has no such sum at all: of the very last bounces it is
    left out.
    """
    if rebound <= LEAST_SPEED:
        return 0.0
    e0 = restitution(material, 0.0)
    approach_speed = rebound / (1.0 + e0)
    before = add_scaled(tangential(load(ball['velocity']), normal), -approach_speed, normal)
    after, _ = bounced(land, (before, load(ball['spin'])), normal, material)
    e = dot(after, normal) / approach_speed
    if e - e0 < STEADY_RATIO * (1.0 - e0) and material['ploughing'] == 0.0:
        return e
    if rebound < LAST_SHARE * micro_bounce_threshold(land, ball):
        return restitution(material, approach_speed)
    return 1.0


@kernel
def wall_rebound(land: SceneRecord, ball: BallRecord) -> float:
    """Approach speed [m/s] up to which a wall has restitution 1."""
    if surfaces.hollow(land.ground, ball['target']) == 0.0:
        return WALL_REBOUND
    return max(WALL_REBOUND, HOLLOW_REBOUND * length(load(ball['velocity'])))


@kernel
def micro_bounce_threshold(land: SceneRecord, ball: BallRecord) -> float:
    """Restitution threshold: rebound [m/s] below which the remaining bounces are summed.

    Other engines stop the ball there; here its micro-bounces keep their time and friction.

    It is less for a fast ball. The air acts on their sum at once, a little early: an error of
    position in proportion to the square of the speed and to the square of the time that they last.
    And it is less on relief, which their sum takes for a plane.
    """
    settle = land.limits.settle / (1.0 + length(load(ball['velocity'])) / SLOW_FOR_AIR)
    if surfaces.has_relief(land.ground, ball['target']):
        settle *= ON_RELIEF
    return max(settle, LEAST_MICRO_BOUNCE)


@shared
def cross_border(land: SceneRecord, ball: BallRecord, now: float) -> None:
    """Find the support of a ball that has reached a border in plan.

    Writes motion, phase, step, contact.
    """
    ahead = heading(land, ball)
    part, normal = surfaces.touched(land.ground, load(ball['position']), land.ball.radius, ahead)
    if part < 0:  # the ground ends here
        take_off(ball)
        return
    distance, normal = surfaces.under(land.ground, part, load(ball['position']), ahead)
    store(
        ball['position'], add_scaled(load(ball['position']), land.ball.radius - distance, normal)
    )
    set_support(land, ball, part, normal)
    choose_contact_mode(land, ball, now)
