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

"""Planner of a ball's next segment: how it moves on, and up to which time that is safe."""

from math import inf

from ..collision.ball_gap import within_contact_reach
from ..collision.border_crossing import first_border_crossing
from ..collision.ground_contact import (
    first_ground_contact,
    IN_THE_AIR,
    ON_CURVE,
    ON_EDGE,
    ON_FLAT,
    WEDGED,
)
from ..collision.water_entry import first_water_entry
from ..contact.contact_state import (
    heading,
    in_micro_bounces,
    remove_slip,
    set_support,
    touch_down,
    update_material,
)
from ..contact.curved_motion import curved_segment
from ..contact.plane_motion import plane_segment, resists_evenly
from ..contact.straight_rolling import rolling_segment, rolls_straight
from ..effects import at_time, flight_rates, gravity_at, moving_air
from ..geometry import surfaces
from ..geometry.water_surface import water_at
from ..integrators import step
from ..jit import borrowed, entry, kernel, shared
from ..kernel_types import BallRecord, ModelRecord, SceneRecord, Vector
from ..mechanics.vector import (
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
from ..response.ground_impact import cross_border
from ..response.time_stepping import next_step_time, straight_segment
from ..response.water_impact import sinking_time
from ..response.wedged_ball import is_wedged, wedged_step_length
from ..state.ball import (
    BORDER_CROSSING,
    FLIGHT,
    GROUND_IMPACT,
    moves,
    NO_PART,
    ROLL,
    STEP_END,
    STEPPED,
    TIME_LIMIT,
    WATER_ENTRY,
)
from ..state.transitions import begin_rolling, take_off
from ..trajectory import segment
from ..trajectory.equations_of_motion import LEAST_SPEED, surface_at_start, turning_surface

LONGEST_SHOT = 300.0  # s
# After so many segments of zero length in a row every second one lasts for a MOMENT. That grows,
# if they go on, until the ball may move by the limit on a path's error, or by LEAST_STRAY.
MANY_ZERO_LENGTH = 100
MOMENT = 1e-9  # s
LEAST_STRAY = 1.5e-7  # m
LEAST_PRESS = 0.1  # of the weight: the least that lift leaves of it during micro-bounces
# s: longest segment under water: what ends there is not looked for over a longer one
SINKING_STEP = 0.02


@kernel
def plan_next_segment(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Plan the ball's next segment from its state at `now`, up to its first event.

    Writes segment, integrator, segments_spent, zero_length_segments, contact, on_flat, phase,
    motion. The last four change only where contact does.
    """
    ball['begin'] = now
    at_time(model.effects, now)
    if not moves(ball['phase']):
        segment.stay_in_place(ball)
        ball['end'] = inf
        return
    on = contact_segment(model, ball, now) if ball['phase'] != FLIGHT else IN_THE_AIR
    if not moves(ball['phase']):  # it came to rest across a border: an event at once
        segment.stay_in_place(ball)
        ball['end'] = now
        ball['ending'] = STEP_END
        return
    if ball['phase'] == FLIGHT:
        on = IN_THE_AIR
        flight_segment(model, ball, now)
    # A wedged or time-stepped ball moves as in flight; its contacts are solved at the step's end.
    if ball['time_stepping'] > 0 or is_wedged(ball):
        on = WEDGED
    until = limit_by_ground(model, ball, span_to_solve(ball, now), on)
    end_segment(model, ball, now, limit_by_water(model, ball, until))


@kernel
def flight_segment(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Plan a segment of flight: a step of the integrator, of a time-stepped ball a straight line.

    Writes curve, ending, integrator.
    """
    if ball['time_stepping'] == STEPPED:
        straight_segment(ball, next_step_time(now) - now)
    else:
        step(model, ball)


@kernel
def span_to_solve(ball: BallRecord, now: float) -> float:
    """Span of the segment, cut to when the ball's contacts are solved, if they are."""
    if ball['time_stepping']:
        return min(ball['span'], next_step_time(now) - now)
    if is_wedged(ball):
        return min(ball['span'], wedged_step_length(ball))
    return ball['span']


@kernel
def limit_by_ground(model: ModelRecord, ball: BallRecord, until: float, on: int) -> float:
    """First time, at most `until`, of a border or an impact with the ground.

    Writes ending, target, segments_spent.
    """
    # Borders first: on a mesh the next one is near, and contacts beyond it need no search.
    crosses = False
    if on == ON_FLAT or on == ON_CURVE:
        until, crosses = first_border_crossing(
            model.land.ground, ball, model.land.ball.radius, until
        )
    border = until
    part, hit = NO_PART, False
    if not within_contact_reach(ball):
        until, part, hit = first_ground_contact(
            model.land.ground, ball, model.land.ball.radius, until, on
        )
    if hit:
        ball['ending'] = GROUND_IMPACT
        ball['target'] = part
    elif crosses and until == border:
        ball['ending'] = BORDER_CROSSING
    if (
        until < ball['span']
        and ball['ending'] != GROUND_IMPACT
        and ball['ending'] != BORDER_CROSSING
    ):
        ball['ending'] = STEP_END
    return until


@kernel
def limit_by_water(model: ModelRecord, ball: BallRecord, until: float) -> float:
    """First time, at most `until`, of an entry into water, or at which a ball in it only sinks.

    Writes ending, target.
    """
    if ball['water'] > 0:
        ends = sinking_time(model.land, ball, min(until, SINKING_STEP))
        if ends < until:
            until = ends
            ball['ending'] = STEP_END
    else:
        until, water = first_water_entry(model.land.ground.waters, ball, until)
        if water > 0:
            ball['ending'] = WATER_ENTRY
            ball['target'] = water
    return until


@kernel
def end_segment(model: ModelRecord, ball: BallRecord, now: float, until: float) -> None:
    """End the segment `until` after `now`, or at a time limit.

    Writes end, ending, zero_length_segments.
    """
    ball['end'] = now + max(until, 0.0)
    if (
        ball['time_stepping']
        and ball['ending'] == STEP_END
        and ball['end'] > next_step_time(now) - 1e-9
    ):
        # to the bit: all time-stepped balls are solved at one instant
        ball['end'] = next_step_time(now)
    # Events at one instant that follow each other without end would stop time: at last it is let
    # pass.
    ball['zero_length_segments'] = ball['zero_length_segments'] + 1 if ball['end'] <= now else 0
    if ball['zero_length_segments'] > MANY_ZERO_LENGTH and ball['zero_length_segments'] % 2 == 0:
        times = ball['zero_length_segments'] - MANY_ZERO_LENGTH
        most = max(model.land.limits.path, LEAST_STRAY) / (length(load(ball['velocity'])) + 1e-3)
        ball['end'] = now + min(MOMENT * times * times, most, ball['span'])
        ball['ending'] = STEP_END
    if ball['shot_active'] and ball['end'] > ball['struck'] + LONGEST_SHOT:
        ball['end'] = ball['struck'] + LONGEST_SHOT
        ball['ending'] = TIME_LIMIT


@shared
def contact_segment(model: ModelRecord, ball: BallRecord, now: float) -> int:
    """Plan a segment of a ball in contact; what it is on, such as ON_FLAT.

    The ball may turn out to lift off. Writes motion, phase, contact, on_flat, curve, ending,
    integrator, segments_spent.
    """
    land = model.land
    if surfaces.goes_on(land.ground, ball['support'], ball['support']):
        smooth_surface_segment(model, ball, now)
        return ON_CURVE
    goes_on = flat_ground_goes_on(land, ball)
    ends = not goes_on and surfaces.flat_under(
        land.ground, ball['support'], load(ball['position'])
    )
    if ends:
        cross_border(land, ball, now)
        if not moves(ball['phase']) or ball['phase'] == FLIGHT:
            return IN_THE_AIR
    ahead = unit(load(ball['velocity']), ZERO)
    _, normal = surfaces.under(land.ground, ball['support'], load(ball['position']), ahead)
    store(ball['normal'], normal)
    if ends or ahead == ZERO:  # else it is heading where it was
        goes_on = flat_ground_goes_on(land, ball)
    ball['on_flat'] = 1 if goes_on else 0
    update_material(land, ball)
    if goes_on:
        surface = land.ball.radius, normal, ZERO
        if not is_in_still_air(land, ball, now):
            curved_segment(model, ball, now, surface)
        elif resists_evenly(land, ball, now):  # in closed form
            plane_segment(land, ball, now)
        elif rolls_straight(land, ball, now):
            rolling_segment(land, ball)
        else:
            curved_segment(model, ball, now, surface)
        return ON_FLAT
    place, v = load(ball['position']), load(ball['velocity'])
    curved_segment(model, ball, now, turning_surface(land, ball, place, v))
    return ON_EDGE


@kernel
def smooth_surface_segment(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Plan a segment of a ball that a smooth surface supports as a whole: none of it is flat.

    Writes motion, phase, contact, on_flat, curve, ending, integrator, segments_spent.
    """
    land = model.land
    ball['on_flat'] = 0
    surface = surface_at_start(land, ball, now)
    store(ball['normal'], surface[1])
    update_material(land, ball)
    curved_segment(model, ball, now, surface)


@kernel
def is_in_still_air(land: SceneRecord, ball: BallRecord, now: float) -> bool:
    """Whether no moving air pushes a ball in contact, beside what micro-bounces have of it."""
    state = load(ball['position']), load(ball['velocity']), load(ball['spin'])
    return in_micro_bounces(ball, now) or moving_air(land.air, land.ground, *state) == ZERO


@shared
def apply_air_to_micro_bounces(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Apply the air to micro-bounces. Writes micro_bounces, velocity, spin.

    Drag and torque act for their whole duration; lift makes them last longer and press less.
    """
    place = load(ball['position'])
    normal = load(ball['normal'])
    weight = gravity_at(model.effects, place)
    force, torque = flight_rates(
        model.effects, model.land.ground, place, load(ball['velocity']), load(ball['spin'])
    )
    press = -dot(weight, normal)
    longer = press / max(-dot(force, normal), LEAST_PRESS * press)
    time = longer * (ball['micro_bounce_end'] - now)
    ball['micro_bounce_end'] = now + time
    ball['micro_bounce_load'] /= longer
    store(ball['micro_bounce_air'], tangential(sub(force, weight), normal))
    store(ball['spin'], add_scaled(load(ball['spin']), time, torque))
    if ball['phase'] == ROLL:
        remove_slip(model.land, ball)


@kernel
def flat_ground_goes_on(land: SceneRecord, ball: BallRecord) -> bool:
    """Whether flat ground continues under the ball where it is heading."""
    ahead = add_scaled(load(ball['position']), surfaces.LOOK_AHEAD, heading(land, ball))
    return surfaces.flat_under(land.ground, ball['support'], ahead) and surfaces.touchable(
        land.ground, ball['support'], ahead
    )


@kernel
def launch(model: ModelRecord, ball: BallRecord, now: float) -> None:
    """Choose whether a ball sets off in flight or along the ground.

    Writes phase, step, material, velocity, spin, stepping, water, micro_bounce_end.
    """
    take_off(ball)
    ball['rapid_impacts'] = 0
    ball['time_stepping'] = ball['sleeps_on_ball'] = 0
    ball['water'] = 0
    ball['micro_bounce_end'] = now
    lift = dot(load(ball['velocity']), load(ball['normal']))
    if ball['support'] >= 0 and abs(lift) <= LEAST_SPEED:
        touch_down(model.land, ball, now)


@entry
def put_down(
    model: ModelRecord, ball: BallRecord, position: Vector, depth: float
) -> tuple[bool, float, bool]:
    """Put a ball down at `position`, lowered along z by at most `depth` until it touches.

    The ball is at rest. Returns whether it touches anything, how deep [m] it lies in the ground,
    and whether it is in water. Writes motion, contact, curve, segments_spent.
    """
    model = borrowed(model)
    store(ball['position'], position)
    store(ball['velocity'], ZERO)
    store(ball['spin'], ZERO)
    if depth > 0.0:
        # A straight segment: ground is found as by a ball in flight.
        way = (0.0, 0.0, -depth)
        ball['span'] = 1.0
        store(ball['origin'], position)
        segment.fit_segment(ball, way, (way, way), (ZERO, ZERO), (ZERO, ZERO))
        time, part, hit = first_ground_contact(
            model.land.ground, ball, model.land.ball.radius, 1.0, IN_THE_AIR
        )
        if hit:
            store(ball['position'], segment.position(ball, time))
    part, normal = surfaces.touched(
        model.land.ground, load(ball['position']), model.land.ball.radius, ZERO
    )
    set_support(model.land, ball, part, normal)
    place = load(ball['position'])
    return (
        part >= 0,
        surfaces.depth(model.land.ground, place, model.land.ball.radius),
        water_at(model.land.ground.waters, place) > 0,
    )


@kernel
def read_segment(ball: BallRecord, now: float) -> None:
    """Bring the ball to where it is at `now`, on its present segment. Writes motion."""
    if moves(ball['phase']) and now > ball['begin']:
        time = now - ball['begin']
        store(ball['position'], segment.position(ball, time))
        store(ball['velocity'], segment.velocity(ball, time))
        store(ball['spin'], segment.spin(ball, time))


@kernel
def stop_slip(model: ModelRecord, ball: BallRecord) -> None:
    """Give the ball exactly the spin of rolling, at the event that ends its slip.

    Writes spin, phase.
    """
    normal = load(ball['normal'])
    turning = dot(load(ball['spin']), normal)
    rolling = scale(1.0 / model.land.ball.radius, cross(normal, load(ball['velocity'])))
    store(ball['spin'], add_scaled(rolling, turning, normal))
    begin_rolling(ball)
