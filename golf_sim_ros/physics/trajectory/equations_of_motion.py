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

"""Equations of motion: of a ball in flight, and of one in contact with ground."""

from math import inf

from ..effects import flight_rates, gravity_at, moving_air, sinking
from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, MaterialRecord, ModelRecord, SceneRecord, Vector
from ..mechanics.impulse import slip
from ..mechanics.vector import (
    add,
    add_scaled,
    cross,
    dot,
    length,
    load,
    scale,
    store,
    sub,
    tangential,
    unit,
    ZERO,
)
from ..state.ball import FLIGHT, ROLL, SLIDE

LEAST_SPEED = 1e-9  # m/s: slower motion or slip counts as none
# A slow ball whose drive is at least DRIVING of its resistance, and which moves within ASTRAY of
# it, is turned by resistance no faster than within SETTLING: see `settled_speed`.
DRIVING = 0.9
ASTRAY = 1e-3  # rad
SETTLING = 0.01  # s
KEPT = 7  # row of ``stages`` that no stage is in
GRIP_MARGIN = 1.05  # times dynamic friction: what may slow a rolling ball's spin (an estimate)
STIFFEST_GROWTH = 100.0  # 1/m: half of the speed is lost within 7 mm; more is only stiff

# Distance [m] of a place from the surface that supports a ball, the normal there, and its rate of
# change [rad/s].
TurningSurface = tuple[float, Vector, Vector]


@kernel
def rates(
    model: ModelRecord, ball: BallRecord, position: Vector, velocity: Vector, spin: Vector
) -> tuple[Vector, Vector]:
    """Acceleration and angular acceleration of a ball, in flight, under water or in contact.

    Writes stages.
    """
    if ball['water'] > 0:
        return sinking(model.effects, position, velocity), ZERO
    if ball['phase'] == FLIGHT:
        return flight_rates(model.effects, model.land.ground, position, velocity, spin)
    force, torque, _, _, _ = contact_rates(model.land, ball, position, velocity, spin)
    return force, torque


@kernel
def material_under(land: SceneRecord, ball: BallRecord) -> MaterialRecord:
    """Row of the material that the ball is in contact with."""
    return land.materials[ball['material']]


@kernel
def rolling_deceleration(material: MaterialRecord, press: float, needed: float) -> float:
    """Deceleration [m/s^2] of a rolling ball: rolling resistance, as far as grip allows.

    Friction has to brake the ball, and to turn it as it speeds up downhill, or as long grass slows
    it, for which it is `needed`: see `rolling_needs`. The two are added as if they never opposed
    each other, so that nothing of the resistance is left where the ball begins to slip.
    """
    return min(
        material['rolling_resistance'] * press,
        max(material['static_friction'] * press - needed, 0.0),
    )


@kernel
def resistance_holds(
    material: MaterialRecord, press: float, downhill: Vector, inertia: float
) -> bool:
    """Whether rolling resistance keeps a ball that grips at rest: where (5/7) tan is within it."""
    needed = rolling_needs(material, press, downhill, ZERO, inertia)
    return length(downhill) / (1.0 + inertia) <= rolling_deceleration(material, press, needed)


@kernel
def growth_rate(material: MaterialRecord, press: float) -> float:
    """Growth of a rolling ball's deceleration with the square of its speed [1/m]."""
    growth = material['rolling_resistance'] * material['resistance_growth'] * press
    return min(growth, STIFFEST_GROWTH)


@kernel
def rolling_needs(
    material: MaterialRecord, press: float, downhill: Vector, velocity: Vector, inertia: float
) -> float:
    """Return the static friction over mass [m/s^2] that a ball needs to roll on a plane.

    It turns the ball faster down the slope, and slower as the resistance that grows with speed
    slows it.
    """
    growing = growing_needs(material, press, velocity, inertia)
    if growing == 0.0:
        return inertia / (1.0 + inertia) * length(downhill)
    faster = scale(inertia / (1.0 + inertia), downhill)
    return length(add_scaled(faster, -growing, velocity))


@kernel
def growing_needs(
    material: MaterialRecord, press: float, velocity: Vector, inertia: float
) -> float:
    """Return the static friction over mass and speed [1/s] that slows spin with the centre.

    The resistance that grows with speed slows the centre; friction, of k times that, slows the
    spin. The ball rolls while that is within GRIP_MARGIN times dynamic friction, not within static
    friction: else balls alike but for the least slip would part over a wide range of speeds. So
    the need is scaled up, by static friction over that limit.
    """
    growing = inertia * growth_rate(material, press) * length(velocity)
    if growing == 0.0:
        return 0.0
    most = GRIP_MARGIN * material['dynamic_friction']
    if most == 0.0:
        return growing
    return growing * max(material['static_friction'] / most, 1.0)


@kernel
def unwinding(material: MaterialRecord, press: float, radius: float, inertia: float) -> float:
    """Angular deceleration [rad/s^2] of spin about the normal by pivot friction."""
    return material['pivot_friction'] * press / (inertia * radius * radius)


@kernel
def pivoting(
    ball: BallRecord,
    material: MaterialRecord,
    press: float,
    drive: float,
    radius: float,
    inertia: float,
) -> float:
    """Angular deceleration [rad/s^2] by pivot friction, signed as the spin about the normal.

    The sign is that at the step's start: within a step it must not jump. A ball without such spin
    is held against the `drive` of a normal that turns, as by static friction.
    """
    most = unwinding(material, press, radius, inertia)
    about = dot(load(ball['spin']), load(ball['normal']))
    if abs(about) * radius > LEAST_SPEED:
        return most if about > 0.0 else -most
    return max(min(drive, most), -most)


@kernel
def micro_bounce_forces(
    ball: BallRecord, normal: Vector, press: float, downhill: Vector
) -> tuple[float, Vector]:
    """Mean press, and acceleration along the ground by weight and air, in micro-bounces."""
    along_ground = tangential(load(ball['micro_bounce_air']), normal)
    return ball['micro_bounce_load'] * press, add(downhill, along_ground)


@kernel
def external_acceleration_at(
    land: SceneRecord, place: Vector, velocity: Vector, spin: Vector
) -> Vector:
    """Acceleration of a ball in contact by its weight and by moving air."""
    return add(
        gravity_at(land.effects, place), moving_air(land.air, land.ground, place, velocity, spin)
    )


@kernel
def supporting_surface(land: SceneRecord, ball: BallRecord, place: Vector) -> tuple[float, Vector]:
    """Distance of `place` from the surface that supports the ball, and the normal there.

    Flat ground counts as a plane without end: it is left at a border, an event of its own.
    """
    if ball['on_flat'] == 1:
        normal = load(ball['normal'])
        return land.ball.radius + dot(sub(place, load(ball['position'])), normal), normal
    return surfaces.nearest(land.ground, ball['support'], place)


@kernel
def turning_surface(
    land: SceneRecord, ball: BallRecord, place: Vector, velocity: Vector
) -> TurningSurface:
    """`supporting_surface`, and the rate of change of its normal as the ball moves."""
    if ball['on_flat'] == 1:
        distance, normal = supporting_surface(land, ball, place)
        return distance, normal, ZERO
    return surfaces.nearest_turning(land.ground, ball['support'], place, velocity)


@kernel
def keep_surface(ball: BallRecord, surface: TurningSurface) -> None:
    """Keep what is under the ball at the latest stage, or at the segment's end. Writes stages."""
    row = ball['stages'][KEPT]
    store(row[0:3], surface[1])
    row[3] = surface[0]
    store(row[4:7], surface[2])
    row[7] = 0.0


@kernel
def kept_surface(ball: BallRecord) -> TurningSurface:
    """`turning_surface` that `keep_surface` has kept."""
    row = ball['stages'][KEPT]
    return row[3], load(row[0:3]), load(row[4:7])


@kernel
def go_on_from_kept(ball: BallRecord, now: float) -> None:
    """Let the next segment begin, at `now`, with the surface that is kept. Writes stages."""
    row = ball['stages'][KEPT]
    row[7] = 1.0
    row[8] = now


@kernel
def surface_at_start(land: SceneRecord, ball: BallRecord, now: float) -> TurningSurface:
    """`turning_surface` under the ball: the one that is kept if it goes on from there.

    Writes stages.
    """
    row = ball['stages'][KEPT]
    if row[7] == 1.0 and row[8] == now:
        row[7] = 0.0
        return kept_surface(ball)
    return turning_surface(land, ball, load(ball['position']), load(ball['velocity']))


@kernel
def contact_rates(
    land: SceneRecord, ball: BallRecord, place: Vector, velocity: Vector, spin: Vector
) -> tuple[Vector, Vector, float, float, float]:
    """`rates_on` the surface that supports the ball, which is kept. Writes stages."""
    surface = turning_surface(land, ball, place, velocity)
    keep_surface(ball, surface)
    return rates_on(land, ball, surface, (place, velocity, spin))


@kernel
def settled_speed(velocity: Vector, drive: Vector, resistance: float) -> float:
    """Speed [m/s] along its `drive` to add to a slow ball's velocity, for resistance's direction.

    Resistance opposes the velocity: it turns the motion of a ball that is slow into the direction
    of what drives it, in a time of speed over resistance, and steps must be as short. A ball that
    moves within ASTRAY of its drive, as one that has just set off does, has resistance against its
    velocity plus this along the drive: nearly the same direction, which changes within SETTLING.
    A ball that its drive does not keep going stops first: nothing is added to its speed.
    """
    speed = length(velocity)
    more = SETTLING * resistance - speed
    driven = length(drive)
    if more <= 0.0 or driven <= DRIVING * resistance:
        return 0.0
    along = dot(velocity, drive) / driven
    aside = length(add_scaled(velocity, -along / driven, drive)) / (ASTRAY * speed)
    if along <= 0.0 or aside >= 1.0:
        return 0.0
    return more * (1.0 - aside * aside)


@shared
def rates_on(
    land: SceneRecord,
    ball: BallRecord,
    surface: TurningSurface,
    motion: tuple[Vector, Vector, Vector],
) -> tuple[Vector, Vector, float, float, float]:
    """Acceleration, angular acceleration, press, friction needed to roll, and a time.

    Of a ball in contact with a `surface`; its `motion` is position, velocity and spin. A press
    below 0 means that the ground would have to pull. The time [s] is about that in which constant
    resistance stops a ball that rolls, or turns its motion; infinite where there is none.

    With n' the rate of the normal: the constraint demands v' n = -v n', so the normal force over
    mass is -(g n + v n'). Grip also couples spin about the normal, w_n, to motion: (1 + k) v'_t =
    g_t + k r w_n (n x n'). A sliding ball has dynamic friction against its slip instead, or, where
    it only begins to slip, along the friction that rolling would need. What of the resistance
    grows with speed acts on the centre: 1 + k times the deceleration that it gives a rolling ball,
    whose spin friction has to slow as well; where it can't, the ball slips.
    """
    r = land.ball.radius
    k = land.ball.inertia
    place, velocity, spin = motion
    _, normal, turn = surface
    # Micro-bounces have the force of all air already.
    micro_bouncing = ball['micro_bounce_end'] > ball['begin']
    external = (
        gravity_at(land.effects, place)
        if micro_bouncing
        else external_acceleration_at(land, place, velocity, spin)
    )
    press, downhill = surfaces.slope(external, normal)
    material = material_under(land, ball)
    pressing = press - dot(velocity, turn)
    press = max(pressing, 0.0)
    about = dot(spin, normal)
    # Single impacts do not brake a rolling ball, so neither do micro-bounces.
    pressed = press
    if micro_bouncing:
        pressed, downhill = micro_bounce_forces(ball, normal, press, downhill)
    free = scale(1.0 / (1.0 + k), add_scaled(downhill, k * r * about, cross(normal, turn)))
    growing = 0.0 if micro_bouncing else growth_rate(material, press) * length(velocity)
    turning = sub(free, downhill)
    if growing > 0.0:
        turning = add_scaled(turning, growing_needs(material, press, velocity, k), velocity)
    needed = length(turning)
    resistance = 0.0 if micro_bouncing else rolling_deceleration(material, press, needed)
    downhill = add_scaled(downhill, -(1.0 + k) * growing, velocity)
    speed = length(velocity)
    time = inf
    if speed > LEAST_SPEED:
        more = settled_speed(velocity, free, resistance)
        if resistance > 0.0:
            time = (speed + more) / resistance
        if more > 0.0:
            against = add_scaled(velocity, more / length(free), free)
            free = add_scaled(free, -resistance / length(against), against)
            free = add_scaled(free, -growing, velocity)
        else:
            free = add_scaled(free, -resistance / speed - growing, velocity)
    else:  # from rest it sets off along what drives it, if that exceeds the resistance
        free = scale(max(1.0 - resistance / max(length(free), 1e-300), 0.0), free)
    friction = sub(free, downhill)
    if ball['phase'] == SLIDE:
        against = scale(-1.0, slip(velocity, spin, normal, r))
        if length(against) <= LEAST_SPEED:
            against = friction
        friction = scale(material['dynamic_friction'] * pressed, unit(against, ZERO))
    force = add_scaled(add(downhill, friction), -dot(velocity, turn), normal)
    torque = scale(-1.0 / (k * r), cross(normal, friction))
    # no slip: the spin follows the velocity, which resistance brakes, too
    if ball['phase'] == ROLL:
        torque = add_scaled(scale(1.0 / r, cross(normal, force)), about, turn)
    if material['pivot_friction'] > 0.0 and not micro_bouncing:
        torque = add_scaled(
            torque, -pivoting(ball, material, press, dot(spin, turn), r, k), normal
        )
    return force, torque, pressing, needed, time
