# SPDX-License-Identifier: Apache-2.0
"""The equations of motion: of a ball that flies, and of one that follows ground which is not flat."""
from ..effects import flight_rates, gravity_at, sinking
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.impulse import slip
from ..mechanics.vector import ZERO, add, add_scaled, cross, dot, length, scale, sub, tangential, unit, load
from ..state.ball import FLIGHT, ROLL, SLIDE

LEAST_SPEED = 1e-9  # m/s: slower than this is not moving


@kernel
def rates(model, ball, position, velocity, spin):
    """Acceleration and rate of change of spin of a ball, in flight, under water or in contact."""
    if ball['water'] > 0:
        return sinking(model.effects, position, velocity), ZERO
    if ball['phase'] == FLIGHT:
        return flight_rates(model.effects, model.land.ground, position, velocity, spin)
    force, torque, _, _ = contact_rates(model.land, ball, position, velocity, spin)
    return force, torque


@kernel
def material_under(land, ball):
    """Row of the material that the ball touches."""
    return land.materials[ball['material']]


@kernel
def rolling_deceleration(material, press, needed):
    """Deceleration of a rolling ball: what rolling resistance asks for and grip can give.

    Friction must brake, and turn the ball as it speeds up downhill, for which that much grip is `needed`:
    on a plane k/(1 + k) of the pull. So a ball holds where (5/7) tan <= rolling resistance and
    tan <= static friction.
    """
    return min(material['rolling_resistance'] * press, max(material['static_friction'] * press - needed, 0.0))


@kernel
def rolling_needs(downhill, inertia):
    """Friction over mass that turns a ball as it rolls down a plane."""
    return inertia / (1.0 + inertia) * length(downhill)


@kernel
def unwinding(material, press, radius, inertia):
    """Rate [rad/s^2] at which pivot friction takes spin about the normal."""
    return material['pivot_friction'] * press / (inertia * radius * radius)


@kernel
def pivoting(ball, material, press, drive, radius, inertia):
    """What pivot friction takes from the spin about the normal: as the step begins, so it goes on.

    It holds a ball that does not turn about the normal against the `drive` of a normal that turns.
    """
    most = unwinding(material, press, radius, inertia)
    about = dot(load(ball['spin']), load(ball['normal']))
    if abs(about) * radius > LEAST_SPEED:
        return most if about > 0.0 else -most
    return max(min(drive, most), -most)


@kernel
def micro_bounce_forces(ball, normal, press, downhill):
    """How hard a ball presses, and what drives it along the ground, while its last bounces go on."""
    along_ground = tangential(load(ball['micro_bounce_air']), normal)
    return ball['micro_bounce_load'] * press, add(downhill, along_ground)


@shared
def contact_rates(land, ball, place, velocity, spin):
    """Acceleration, rate of spin, press, and grip needed to roll, of a ball on ground which is not flat.

    A press below 0 means that the ground would have to pull.

    With n' the rate of the normal: staying on the surface demands v' n = -v n', so the ground
    presses with -(g n + v n') per mass. Grip also turns spin about the normal, w_n, into motion:
    (1 + k) v'_t = g_t + k r w_n (n x n'). A sliding ball feels dynamic friction against its slip
    instead, or, where it only begins to slip, along the grip that it lacks.
    """
    r = land.ball.radius
    k = land.ball.inertia
    _, normal = surfaces.nearest(land.ground, ball['support'], place)
    turn = surfaces.turn(land.ground, ball['support'], place, velocity)
    press, downhill = surfaces.slope(gravity_at(land.effects, place), normal)
    material = material_under(land, ball)
    pressing = press - dot(velocity, turn)
    press = max(pressing, 0.0)
    about = dot(spin, normal)
    # single impacts do not brake a rolling ball, nor does their sum
    tail = ball['micro_bounce_end'] > ball['begin']
    load = press
    if tail:
        load, downhill = micro_bounce_forces(ball, normal, press, downhill)
    free = scale(1.0 / (1.0 + k), add_scaled(downhill, k * r * about, cross(normal, turn)))
    needed = length(sub(free, downhill))
    resistance = 0.0 if tail else rolling_deceleration(material, press, needed)
    if length(velocity) > LEAST_SPEED:
        free = add_scaled(free, -resistance / length(velocity), velocity)
    else:  # it sets off as it is driven, if at all
        free = scale(max(1.0 - resistance / max(length(free), 1e-300), 0.0), free)
    friction = sub(free, downhill)
    if ball['phase'] == SLIDE:
        against = scale(-1.0, slip(velocity, spin, normal, r))
        if length(against) <= LEAST_SPEED:
            against = friction
        friction = scale(material['dynamic_friction'] * load, unit(against, ZERO))
    force = add_scaled(add(downhill, friction), -dot(velocity, turn), normal)
    torque = scale(-1.0 / (k * r), cross(normal, friction))
    if ball['phase'] == ROLL:  # the spin goes with the motion: resistance brakes it, too
        torque = add_scaled(scale(1.0 / r, cross(normal, force)), about, turn)
    if material['pivot_friction'] > 0.0 and not tail:
        torque = add_scaled(torque, -pivoting(ball, material, press, dot(spin, turn), r, k), normal)
    return force, torque, pressing, needed
