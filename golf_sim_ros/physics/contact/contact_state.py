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

"""Contact mode of a ball, whether it slides, rolls, pivots or rests, and its support."""

from ..geometry import surfaces
from ..jit import kernel, shared
from ..kernel_types import BallRecord, MaterialRecord, SceneRecord, Vector
from ..mechanics.impulse import slip
from ..mechanics.vector import add, add_scaled, cross, dot, length, load, scale, store, unit, ZERO
from ..state.ball import ROLL, SLIDE
from ..state.transitions import begin_rolling, begin_sliding, come_to_rest
from ..trajectory.equations_of_motion import (
    external_acceleration_at,
    LEAST_SPEED,
    material_under,
    resistance_holds,
    rolling_needs,
)


@kernel
def contact_material_number(land: SceneRecord, ball: BallRecord, part: int, normal: Vector) -> int:
    """Look up the number of the material of `part` where the ball touches it with `normal`.

    On a border it is that of the side towards which the ball moves.
    """
    foot = add_scaled(load(ball['position']), -land.ball.radius, normal)
    ahead = unit(load(ball['velocity']), ZERO)
    return surfaces.material_of(land.ground, part, add_scaled(foot, surfaces.LOOK_AHEAD, ahead))


@kernel
def contact_material(
    land: SceneRecord, ball: BallRecord, part: int, normal: Vector
) -> MaterialRecord:
    """Row of the material of `part` where the ball touches it with `normal`."""
    return land.materials[contact_material_number(land, ball, part, normal)]


@kernel
def remove_slip(land: SceneRecord, ball: BallRecord) -> None:
    """Remove all slip at once by the tangential impulse of grip. Writes velocity and spin."""
    normal = load(ball['normal'])
    r = land.ball.radius
    k = land.ball.inertia
    change = scale(-k / (1.0 + k), slip(load(ball['velocity']), load(ball['spin']), normal, r))
    store(ball['velocity'], add(load(ball['velocity']), change))
    store(ball['spin'], add_scaled(load(ball['spin']), -1.0 / (k * r), cross(normal, change)))


@kernel
def in_micro_bounces(ball: BallRecord, now: float) -> bool:
    """Whether the ball's micro-bounces still go on."""
    return ball['micro_bounce_end'] > now


@kernel
def external_acceleration(land: SceneRecord, ball: BallRecord) -> Vector:
    """Acceleration of a ball in contact by its weight and by moving air."""
    return external_acceleration_at(
        land, load(ball['position']), load(ball['velocity']), load(ball['spin'])
    )


@kernel
def heading(land: SceneRecord, ball: BallRecord) -> Vector:
    """Compute the unit vector along the velocity.

    Of a ball without any it is along the one that friction and weight give it.
    """
    v = load(ball['velocity'])
    if length(v) > 0.0:
        return unit(v, ZERO)
    normal = load(ball['normal'])
    press, driven = surfaces.slope(external_acceleration(land, ball), normal)
    if ball['phase'] == SLIDE:
        sliding = unit(slip(v, load(ball['spin']), normal, land.ball.radius), ZERO)
        driven = add_scaled(
            driven, -material_under(land, ball)['dynamic_friction'] * press, sliding
        )
    return unit(driven, ZERO)


@kernel
def update_material(land: SceneRecord, ball: BallRecord) -> None:
    """Look up the material that the ball is on: on a border, what it heads for.

    Writes material.
    """
    foot = add_scaled(load(ball['position']), -land.ball.radius, load(ball['normal']))
    ahead = add_scaled(foot, surfaces.LOOK_AHEAD, heading(land, ball))
    ball['material'] = surfaces.material_of(land.ground, ball['support'], ahead)


@kernel
def set_support(land: SceneRecord, ball: BallRecord, part: int, normal: Vector) -> None:
    """Set the ball's support to `part`, or to none (NO_PART). Writes support, material, normal."""
    ball['support'] = part
    store(ball['normal'], normal)
    update_material(land, ball)


@kernel
def touch_down(land: SceneRecord, ball: BallRecord, now: float) -> None:
    """Let the ball go on along its support, where it slides at first.

    Writes phase, step, material, velocity and spin.
    """
    ball['step'] = 0.0  # that of the flight says nothing
    begin_sliding(ball)
    update_material(land, ball)
    choose_contact_mode(land, ball, now)


@shared
def choose_contact_mode(land: SceneRecord, ball: BallRecord, now: float) -> None:
    """Choose whether a ball in contact slides, rolls, pivots or rests.

    Writes phase, velocity and spin.

    A ball that rolls keeps rolling while its contact grips; any other must lose its slip first.
    """
    normal = load(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surfaces.slope(external_acceleration(land, ball), normal)
    v = add_scaled(load(ball['velocity']), -dot(load(ball['velocity']), normal), normal)
    k = land.ball.inertia
    turning = dot(load(ball['spin']), normal)
    # Friction that turns the ball as it rolls must be within the cone of static friction.
    braked = ZERO if in_micro_bounces(ball, now) else v
    needed = rolling_needs(material, press, downhill, braked, k)
    grips = needed <= material['static_friction'] * press
    store(ball['velocity'], v)
    sliding = slip(v, load(ball['spin']), normal, land.ball.radius)
    if not grips or ball['phase'] != ROLL and length(sliding) > LEAST_SPEED:
        begin_sliding(ball)
        return
    begin_rolling(ball)
    holds = resistance_holds(material, press, downhill, k)
    # Micro-bounces may still drive it: the air acts on them, and nothing resists.
    if length(v) <= LEAST_SPEED and holds and not in_micro_bounces(ball, now):
        v = ZERO
        store(ball['velocity'], v)
        if abs(turning) * land.ball.radius <= LEAST_SPEED:
            turning = 0.0
        # Without pivot friction a spinning top would never rest: its spin counts no more.
        if material['pivot_friction'] == 0.0 or turning == 0.0:
            come_to_rest(ball)
    store(
        ball['spin'], add_scaled(scale(1.0 / land.ball.radius, cross(normal, v)), turning, normal)
    )
