# SPDX-License-Identifier: Apache-2.0
"""Whether a ball in contact slides, rolls, pivots or rests, and on what."""
from ..effects import pull
from ..geometry import surfaces
from ..jit import kernel, shared
from ..mechanics.impulse import slip
from ..mechanics.vector import ZERO, add, along, cross, dot, length, put, scale, unit, vector
from ..state.ball import REST, ROLL, SLIDE
from ..trajectory.equations_of_motion import STILL, brake, material_under, rolling_needs


@kernel
def stand_on(land, ball, part, normal):
    """Let the ball stand on `part`, or on nothing (NO_PART). Writes support, material, normal."""
    ball['support'] = part
    ball['material'] = material_number(land, ball, part, normal)
    put(ball['normal'], normal)


@kernel
def material_number(land, ball, part, normal):
    """Number of the material of `part` where the ball touches it with `normal`."""
    foot = along(vector(ball['position']), -land.ball.radius, normal)
    return surfaces.material_of(land.ground, part, foot)


@kernel
def material_of(land, ball, part, normal):
    """Row of the material of `part` where the ball touches it with `normal`."""
    return land.materials[material_number(land, ball, part, normal)]


@kernel
def take_slip(land, ball):
    """Let grip take all slip at once, as an impulse. Writes velocity and spin."""
    normal = vector(ball['normal'])
    r = land.ball.radius
    k = land.ball.inertia
    push = scale(-k / (1.0 + k), slip(vector(ball['velocity']), vector(ball['spin']), normal, r))
    put(ball['velocity'], add(vector(ball['velocity']), push))
    put(ball['spin'], along(vector(ball['spin']), -1.0 / (k * r), cross(normal, push)))


@kernel
def in_tail(ball, now):
    """Whether the ball's last, tiny bounces are still going on."""
    return ball['tail_end'] > now


@kernel
def heading(land, ball):
    """Unit vector to where the ball moves, or, where it stands, to where friction and weight drive it."""
    v = vector(ball['velocity'])
    if length(v) > 0.0:
        return unit(v, ZERO)
    normal = vector(ball['normal'])
    press, driven = surfaces.slope(pull(land.effects, vector(ball['position'])), normal)
    if ball['phase'] == SLIDE:
        sliding = unit(slip(v, vector(ball['spin']), normal, land.ball.radius), ZERO)
        driven = along(driven, -material_under(land, ball)['dynamic_friction'] * press, sliding)
    return unit(driven, ZERO)


@shared
def settle(land, ball, now):
    """Decide whether a ball in contact slides, rolls, pivots or rests. Writes phase and motion.

    A ball that rolls goes on rolling while its contact grips; any other must lose its slip first.
    """
    normal = vector(ball['normal'])
    material = material_under(land, ball)
    press, downhill = surfaces.slope(pull(land.effects, vector(ball['position'])), normal)
    v = along(vector(ball['velocity']), -dot(vector(ball['velocity']), normal), normal)
    k = land.ball.inertia
    turning = dot(vector(ball['spin']), normal)
    needed = rolling_needs(downhill, k)
    grips = needed <= material['static_friction'] * press
    put(ball['velocity'], v)
    sliding = slip(v, vector(ball['spin']), normal, land.ball.radius)
    if not grips or ball['phase'] != ROLL and length(sliding) > STILL:
        ball['phase'] = SLIDE
        return
    ball['phase'] = ROLL
    holds = length(downhill) / (1.0 + k) <= brake(material, press, needed)
    if length(v) <= STILL and holds and not in_tail(ball, now):
        v = ZERO
        put(ball['velocity'], v)
        if abs(turning) * land.ball.radius <= STILL:
            turning = 0.0
        if material['pivot_friction'] == 0.0 or turning == 0.0:
            ball['phase'] = REST
    put(ball['spin'], along(scale(1.0 / land.ball.radius, cross(normal, v)), turning, normal))
