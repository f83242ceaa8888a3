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

"""Sliding and rolling without a closed form: around an edge, over a crest, through long grass.

The integrator of flight steps the equations of contact as well; at a step's end the ball is
projected onto the constraint: its position to the ground, its velocity to the tangent plane, its
spin to that of rolling, if it rolls. A step ends early where the normal force vanishes. Friction
is discontinuous where slip ends and where the ball stops: steps approach such a time as a
geometric series, and what is left is removed at once when it no longer counts.
"""

from math import inf

from .contact_state import choose_contact_mode, in_micro_bounces, remove_slip
from ..effects import flight_rates, gravity_at, moving_air
from ..geometry import surfaces
from ..integrators import step
from ..integrators.runge_kutta import store_stage
from ..jit import kernel, shared
from ..kernel_types import BallRecord, ModelRecord, SceneRecord, Vector
from ..mechanics.impulse import slip
from ..mechanics.vector import add, add_scaled, cross, dot, length, load, scale, store, sub, ZERO
from ..state.ball import moves, ROLL, SLIDE
from ..state.transitions import begin_rolling, begin_sliding, take_off
from ..trajectory.equations_of_motion import (
    growth_rate,
    keep_surface,
    kept_surface,
    LEAST_SPEED,
    material_under,
    rates_on,
    supporting_surface,
    turning_surface,
    TurningSurface,
    unwinding,
)
from ..trajectory.segment import fit_segment, position

MOST_NORMAL_TURN = 0.1  # rad by which the normal may turn in a step
# of that in micro-bounces: nothing brakes, so an error between a step's ends shows as energy
UNBRAKED = 0.5
FIRST_STEP = 0.1  # s
LEAST_STEP = 1e-9  # s
SHORT_STEP = 1e-6  # s: a shorter step's end is not projected in position
CORRECTIONS = 12  # attempts at a step, each shorter than the last
# Work of an attempt, over that of planning a segment: the effort of the ground, but no more than
# MOST_EFFORT. Near the ground a search takes 9 times as long where there are several minima, and
# seldom 25 times.
MOST_EFFORT = 32
# of the press at the start: a step at whose end the ground would pull harder is shortened
LIFTS = 1e-6
APPROACH = 0.9  # of the time until friction is discontinuous: the longest step towards it
BEYOND_LIMIT = 1.25  # times the step that would have been off the ground as far as it may be
SLIDES_ON = 0.85  # of the step that its error allows: else many are tried twice near the end
UNTOLD = 1e-2  # of the limit on a path's error: less tells nothing about a longer step
# Energy over mass that a step may gain: so much for each metre that a path may be off, and so
# much besides, which lifts a ball by 20 pm, and as much of the square of its speed.
GAIN = 0.03  # m/s^2
LEAST_GAIN = 2e-10  # J/kg
# Slip is removed at once below the limit on a path's error times SLIP_COUNTS, below LEAST_SLIP,
# or below what friction takes in SLIP_TIME, which is longer than a least step.
SLIP_COUNTS = 200.0  # 1/s
LEAST_SLIP = 1e-7  # m/s
SLIP_TIME = 1e-8  # s


@shared
def curved_segment(
    model: ModelRecord, ball: BallRecord, now: float, surface: TurningSurface
) -> None:
    """Plan a step along ground of any form, or lift off where nothing presses.

    `surface` is the `turning_surface` of the ball as it is now. Writes curve, ending, integrator,
    phase, velocity, spin, segments_spent. The motion changes in small ways only: see
    `snap_small_motion`.
    """
    land = model.land
    place = load(ball['position'])
    v = load(ball['velocity'])
    w = load(ball['spin'])
    force, torque, press, needed, time = rates_on(land, ball, surface, (place, v, w))
    # The air is asked only where the weight does not hold the ball: see `press_with_air`.
    holding = press if press > 0.0 else press_with_air(model, surface, place, v, w)
    if holding <= 0.0:
        take_off(ball)
        return
    phase = ball['phase']
    grips = needed <= material_under(land, ball)['static_friction'] * press
    if ball['phase'] == ROLL and not grips:
        begin_sliding(ball)
    snap_small_motion(land, ball, force, press, grips, now)
    if not moves(ball['phase']):
        return
    changed = load(ball['velocity']) != v
    if changed:
        v = load(ball['velocity'])
        surface = turning_surface(land, ball, place, v)
    if changed or ball['phase'] != phase or load(ball['spin']) != w:
        w = load(ball['spin'])
        force, torque, press, _, time = rates_on(land, ball, surface, (place, v, w))
    store_stage(ball, 0, v, force, torque)
    change = time_to_change(land, ball, force, press, time)
    wanted = ball['step'] if ball['step'] > 0.0 and ball['phase'] == phase else FIRST_STEP
    asked = h = min(wanted, longest_contact_step(land, ball, press, surface[2], change))
    slipping = slip(v, load(ball['spin']), load(ball['normal']), land.ball.radius)
    cost = min(surfaces.effort(land.ground, ball['support']), MOST_EFFORT)
    for _ in range(CORRECTIONS):
        ball['segments_spent'] += cost
        ball['step'] = h
        step(model, ball)
        following = ball['step']
        h = ball['span']
        held, normal = project_to_ground(land, ball)
        if held <= 0.0:
            end = add_scaled(place, 1.0, load(ball['position_coefficients'][5]))
            fast = end_velocity(ball)
            ground = turning_surface(land, ball, end, fast)
            held = press_with_air(model, ground, end, fast, load(ball['spin_coefficients'][3]))
        left = step_share_to_change(land, ball, (v, slipping), (holding, held), normal)
        if left == 1.0:
            left = step_share_on_ground(land, ball)
            # What limits this step limits the next one.
            following = min(following, BEYOND_LIMIT * h * left)
            if h == asked < wanted:  # not by its error
                following = max(following, min(wanted, BEYOND_LIMIT * h * left))
            else:  # friction's direction turns the faster the nearer its change is
                most = following if h == asked else 1.5 * h
                following = min(following, most) * max(1.0 - h / change, 0.1)
                if ball['phase'] == SLIDE:
                    following *= SLIDES_ON
            if left >= 1.0:
                break
        if h * left <= LEAST_STEP:
            break
        h *= left
    ball['step'] = following


@shared
def press_with_air(
    model: ModelRecord, surface: TurningSurface, place: Vector, velocity: Vector, spin: Vector
) -> float:
    """Press [m/s^2] of weight and aerodynamic forces together.

    Topspin and wind hold a ball to a crest which its weight alone would let it leave: it would be
    back at once. Elsewhere only moving air acts on a ball on the ground: see `moving_air`.
    """
    _, normal, turn = surface
    force, _ = flight_rates(model.effects, model.land.ground, place, velocity, spin)
    return -dot(force, normal) - dot(velocity, turn)


@kernel
def off_ground(land: SceneRecord, ball: BallRecord, share: float) -> float:
    """Distance [m] that the ball is off the ground at that `share` of its segment."""
    distance, _ = supporting_surface(land, ball, position(ball, share * ball['span']))
    return abs(distance - land.ball.radius)


@shared
def step_share_on_ground(land: SceneRecord, ball: BallRecord) -> float:
    """Share of the step over which its curve stays on the ground, to the limit on a path's error.

    It is 1 or more if the step stands, without end if nothing is known of a longer one. The curve
    interpolates position, velocity and acceleration at both ends (quintic Hermite), so its error
    goes with the step's sixth power.
    """
    if ball['on_flat'] == 1:  # a step does not leave a plane
        return inf
    off = off_ground(land, ball, 0.5)
    # On a smooth surface the curve is off most near its middle.
    if off > UNTOLD * land.limits.path or not surfaces.goes_on(
        land.ground, ball['support'], ball['support']
    ):
        off = max(off_ground(land, ball, 0.25), off, off_ground(land, ball, 0.75))
    if off <= land.limits.path:
        if off <= UNTOLD * land.limits.path:
            return inf
        return max(1.0, 0.9 * (land.limits.path / off) ** (1.0 / 6.0))
    return max(0.9 * (land.limits.path / off) ** (1.0 / 6.0), 0.1)


@shared
def snap_small_motion(
    land: SceneRecord, ball: BallRecord, force: Vector, press: float, grips: bool, now: float
) -> None:
    """Remove slip, or the way to a stop, that is too small to count. Writes motion and phase.

    Slip is removed by an impulse of grip, which gains no energy.
    """
    v = load(ball['velocity'])
    normal = load(ball['normal'])
    r = land.ball.radius
    about = dot(load(ball['spin']), normal)
    pivots = material_under(land, ball)['pivot_friction'] > 0.0
    if pivots and abs(about) * r <= slip_limit(land, press):
        store(ball['spin'], add_scaled(load(ball['spin']), -about, normal))
    if ball['phase'] == SLIDE:
        u = slip(v, load(ball['spin']), normal, r)
        if grips and length(u) <= slip_limit(land, press):
            remove_slip(land, ball)
            begin_rolling(ball)
        return
    slowing = -dot(force, v)
    if (
        length(v) <= LEAST_SPEED
        or slowing <= 0.0
        or material_under(land, ball)['rolling_resistance'] == 0.0
    ):
        return
    # The way to the stop, v^2 over twice the deceleration, is within the limit on a path's error.
    if 0.5 * dot(v, v) * dot(v, v) <= land.limits.path * slowing * length(v):
        store(ball['velocity'], ZERO)
        choose_contact_mode(land, ball, now)


@kernel
def slip_limit(land: SceneRecord, press: float) -> float:
    """Slip [m/s] that is too small to count, of a ball with that `press`."""
    return max(SLIP_COUNTS * land.limits.path, LEAST_SLIP, SLIP_TIME * press)


@kernel
def time_to_unwind(land: SceneRecord, ball: BallRecord, press: float, turn: Vector) -> float:
    """Time [s] until pivot friction stops the spin about the normal; infinite where it does not.

    A normal that turns changes that spin, too: it may drive it harder than friction brakes.
    """
    r = land.ball.radius
    material = material_under(land, ball)
    about = dot(load(ball['spin']), load(ball['normal']))
    if material['pivot_friction'] == 0.0 or abs(about) * r <= LEAST_SPEED:
        return inf
    if in_micro_bounces(ball, ball['begin']):  # single impacts do not brake it
        return inf
    drive = dot(load(ball['spin']), turn)
    losing = unwinding(material, press, r, land.ball.inertia) - (drive if about > 0.0 else -drive)
    return abs(about) / losing if losing > 0.0 else inf


@kernel
def longest_contact_step(
    land: SceneRecord, ball: BallRecord, press: float, turn: Vector, change: float
) -> float:
    """Longest step [s] that does not overlook what happens to the ball.

    That is the turn of the normal, the end of micro-bounces or of spin about the normal, and
    another `change` of friction, at that time from now.
    """
    unturned = MOST_NORMAL_TURN / max(length(turn), 1e-3)
    most = min(unturned, time_to_unwind(land, ball, press, turn))
    # Never up to a discontinuity, where the method would lose its order.
    most = max(min(most, APPROACH * change), LEAST_STEP)
    if in_micro_bounces(ball, ball['begin']):
        most = min(most, UNBRAKED * unturned, ball['micro_bounce_end'] - ball['begin'])
    return most


@shared
def time_to_change(
    land: SceneRecord, ball: BallRecord, force: Vector, press: float, braking: float
) -> float:
    """Estimate of the time [s] until slip ends, or until a braked ball stops.

    `braking` is the time in which constant resistance stops a ball that rolls, or turns its
    motion, which it does even where a slope nearly balances it along the way.
    """
    v = load(ball['velocity'])
    if ball['phase'] == SLIDE:
        material = material_under(land, ball)
        u = slip(v, load(ball['spin']), load(ball['normal']), land.ball.radius)
        if length(u) <= LEAST_SPEED:
            return inf
        losing = (1.0 + 1.0 / land.ball.inertia) * material['dynamic_friction'] * press
        growing = (1.0 + land.ball.inertia) * growth_rate(material, press) * length(v)
        losing += growing * dot(v, u) / length(u)
        return length(u) / losing if losing > 0.0 else inf
    slowing = -dot(force, v)
    return min(braking, dot(v, v) / slowing) if braking < inf and slowing > 0.0 else braking


@shared
def step_share_to_change(
    land: SceneRecord,
    ball: BallRecord,
    start: tuple[Vector, Vector],
    presses: tuple[float, float],
    normal: Vector,
) -> float:
    """Share of the step that stays before a discontinuity of the equations, or 1.

    ``start``: velocity and slip at the start; ``presses``: what keeps the ball on the ground, at
    the start and at the end; ``normal``: at the end.
    """
    v, slipping = start
    holding, held = presses
    if held < -LIFTS * holding:
        return max(holding / (holding - held), 0.01)
    gain, allowed = gained(land, ball), GAIN * land.limits.path + LEAST_GAIN * (1.0 + dot(v, v))
    if gain > allowed:
        return max(0.9 * allowed / gain, 0.1)
    # Slip or velocity that has turned round within the step has passed through zero, unseen by its
    # stages.
    if ball['phase'] == SLIDE:
        turned = (
            length(slipping) > LEAST_SPEED and dot(slipping, slip_at_end(land, ball, normal)) < 0.0
        )
    else:
        turned = (
            material_under(land, ball)['rolling_resistance'] > 0.0
            and length(v) > LEAST_SPEED
            and dot(v, end_velocity(ball)) < 0.0
        )
    return 0.5 if turned else 1.0


@kernel
def gained(land: SceneRecord, ball: BallRecord) -> float:
    """Energy over mass [J/kg] that the ball gains on its segment beside weight's and air's work.

    Ground only dissipates: there is a gain where its curvature is discontinuous, as from edge to
    wall, and no stage of the step sees that.
    """
    place = load(ball['position'])
    way = load(ball['position_coefficients'][5])
    v0, v1 = load(ball['velocity']), end_velocity(ball)
    w0, w1 = load(ball['spin']), load(ball['spin_coefficients'][3])
    inertia = land.ball.inertia * land.ball.radius * land.ball.radius
    weight = scale(
        0.5, add(gravity_at(land.effects, place), gravity_at(land.effects, add(place, way)))
    )
    gain = 0.5 * (dot(v1, v1) - dot(v0, v0) + inertia * (dot(w1, w1) - dot(w0, w0))) - dot(
        weight, way
    )
    if in_micro_bounces(ball, ball['begin']):
        air_force = length(load(ball['micro_bounce_air']))
    else:
        air_force = max(
            length(moving_air(land.air, land.ground, place, v0, w0)),
            length(moving_air(land.air, land.ground, add(place, way), v1, w1)),
        )
    return gain - air_force * ball['span'] * max(length(v0), length(v1))


@shared
def project_to_ground(land: SceneRecord, ball: BallRecord) -> tuple[float, Vector]:
    """Press at the segment's end, which is projected onto the ground and its tangent plane.

    And the normal there. It is that of the step's last stage, and so is its rate: a place and a
    velocity that move along the normal change neither. The position is not projected after the
    shortest of steps: its rounding error far from the origin, 5e-14 m, over a nanosecond is speed.
    Writes curve, stages.
    """
    r = land.ball.radius
    x0 = load(ball['position'])
    way = load(ball['position_coefficients'][5])
    distance, normal, turn = kept_surface(ball)
    if ball['span'] > SHORT_STEP:
        way = add_scaled(way, r - distance, normal)
        distance = r
    end = add_scaled(x0, 1.0, way)
    velocity = end_velocity(ball)
    velocity = add_scaled(velocity, -dot(velocity, normal), normal)
    spin = load(ball['spin_coefficients'][3])
    if ball['phase'] == ROLL:
        spin = add_scaled(scale(1.0 / r, cross(normal, velocity)), dot(spin, normal), normal)
    store(ball['spin_coefficients'][3], spin)
    surface = distance, normal, turn
    keep_surface(ball, surface)
    force, torque, press, _, _ = rates_on(land, ball, surface, (end, velocity, spin))
    first = ball['stages'][0]
    fit_segment(
        ball,
        way,
        (load(ball['velocity']), velocity),
        (load(first[3:6]), force),
        (load(first[6:9]), torque),
    )
    return press, normal


@kernel
def end_velocity(ball: BallRecord) -> Vector:
    """Velocity at the end of the segment."""
    w = ball['position_coefficients']
    return scale(5.0 / ball['span'], sub(load(w[5]), load(w[4])))


@kernel
def slip_at_end(land: SceneRecord, ball: BallRecord, normal: Vector) -> Vector:
    """Slip of the ball at the end of its segment, where the ground has that `normal`."""
    return slip(end_velocity(ball), load(ball['spin_coefficients'][3]), normal, land.ball.radius)
