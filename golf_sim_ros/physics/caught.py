# SPDX-License-Identifier: Apache-2.0
"""A ball that several surfaces hold at once: in a groove, a corner, a slot, or blown against a wall.

There impacts follow each other ever faster. After some it is caught: it moves in small steps of
time, and at each step's end whatever it touches takes away what drives it in, with friction, as
often as it takes (Moreau's time stepping, with projected Gauss-Seidel and projected positions).
"""
from math import sqrt

from ._compile import kernel, shared
from .contact import material_of, settle, stand_on
from .detect import NEAR
from .effects import pull
from .ground import surface
from .impulse import Bond, impulse, take
from .motion import STILL
from .path import greatest_acceleration
from .state import FLIGHT, NO_PART, REST, SLIDE
from .vector import ZERO, along, dot, length, put, scale, vector

STALL = 1e-6  # s between impacts: of a ball that is being caught they are less
MANY_STALLS = 20
CAUGHT_STEP = 2e-4  # s at most
SINK = 2e-7  # m: by so much may acceleration drive a ball in, in a step
SWEEPS = 50
AT_REST = 1e-4  # m/s after a step: far less than the 2e-3 that gravity gives in one
WALL = 1e-3  # least part of gravity that must press for a ball to come to rest on a surface


@kernel
def is_caught(ball):
    """Whether the ball moves in small steps, held by what it touches."""
    return ball['stalled'] > MANY_STALLS


@kernel
def caught_step(ball):
    """Length [s] of the next small step of a ball on a piece of flight."""
    return min(CAUGHT_STEP, sqrt(2.0 * SINK / max(greatest_acceleration(ball), 1e-3)))


@kernel
def presses(land, ball, normal):
    """Whether gravity presses the ball against what has `normal`, rather than lets it lean on it."""
    weight = pull(land.effects, vector(ball['position']))
    return -dot(weight, normal) > WALL * length(weight)


@shared
def hold(land, ball, now):
    """Let what the ball touches hold it. Writes position, motion, phase and contact.

    A ball left with one surface to lie on, or none, is caught no more.
    """
    put(ball['normal'], ZERO)
    ball['support'] = NO_PART
    surfaces = 0
    braking = 0.0
    for sweep in range(SWEEPS):
        found, drive, brake = hold_once(land, ball)
        surfaces = max(surfaces, found)
        braking += brake
        if drive <= 0.01 * STILL:
            break
    speed = length(vector(ball['velocity']))
    left = max(speed - braking, 0.0)
    if speed > 0.0:
        put(ball['velocity'], scale(left / speed, vector(ball['velocity'])))
        put(ball['spin'], scale(left / speed, vector(ball['spin'])))
    ball['phase'] = FLIGHT
    # What is held does not hop: else the rounding of its rise would decide the next step's length.
    ball['step'] = CAUGHT_STEP if surfaces > 0 else 0.0
    ball['rated'] = -1.0
    if surfaces == 0:
        ball['stalled'] = 0
    elif left < AT_REST and ball['support'] != NO_PART:
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
        ball['phase'] = REST
    elif surfaces == 1 and ball['support'] != NO_PART:
        ball['stalled'] = 0
        ball['phase'] = SLIDE
        settle(land, ball, now)


@kernel
def stop_approach(land, ball, part, normal):
    """Let `part` take away what drives the ball in, with friction. Returns its rolling resistance."""
    material = material_of(land, ball, part, normal)
    bond = Bond(0.0, 0.0, material['dynamic_friction'], land.ball.mass, land.ball.inertia)
    push = impulse(bond, vector(ball['velocity']), vector(ball['spin']), normal, land.ball.radius)
    take(ball, push, normal, land.ball)
    return material['rolling_resistance']


@kernel
def hold_once(land, ball):
    """One sweep over all that is touched: how many surfaces, the greatest approach, rolling resistance.

    The ball stands on what presses most. Writes position, velocity, spin and contact.
    """
    surfaces = 0
    drive = 0.0
    braking = 0.0
    last = ZERO
    low, high = surface.around(vector(ball['position']), land.ball.radius + NEAR)
    part = surface.next_part(land.ground, 0, low, high)
    while part >= 0:
        place = vector(ball['position'])
        distance, normal = surface.nearest(land.ground, part, place)
        gap = distance - land.ball.radius
        if gap <= NEAR and dot(normal, last) <= 1.0 - 1e-9 and surface.touchable(land.ground, part, place):
            last = normal
            surfaces += 1
            if gap < 0.0:
                put(ball['position'], along(place, -gap, normal))
            approach = -dot(vector(ball['velocity']), normal)
            if approach > 0.0:
                drive = max(drive, approach)
                braking += approach * stop_approach(land, ball, part, normal)
            if presses(land, ball, normal) and normal[2] > ball['normal'][2]:
                stand_on(land, ball, surface.support_of(land.ground, part), normal)
        part = surface.next_part(land.ground, part + 1, low, high)
    return surfaces, drive, braking
