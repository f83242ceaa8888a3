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

"""Narrow phase of the ground: time of impact of a ball's segment with it.

Parts of the ground are convex, or have concave regions of bounded curvature: conservative
advancement along the segment never steps over a contact with one (see
conservative_advancement.py). Where the curvature of hollows is at most K, the gap's rate can fall
by another 2 K v^2 as long as the ball's centre is nearer than 1 / (2 K); from further away the
ball's speed bounds how fast a gap closes.

Where the swept box of a segment overlaps many parts, the segment is tested stretch by stretch,
each halved until its box overlaps few: only parts near the path are tested.
"""

from typing import NamedTuple

from .conservative_advancement import (
    advancement_bound,
    is_long,
    MOST_ADVANCES,
    PLAIN_APPROACH,
    RISING,
    SHORT_BOX,
    swept_box,
    TANGENTIAL,
    TOUCH,
)
from .relief_clearance import LOOK, time_near_relief
from ..geometry import surfaces
from ..geometry.plane_patch import FLUSH
from ..geometry.surface_protocol import FACE_FORM, PLANE_FORM, RELIEF_FORM
from ..geometry.surfaces import Ground
from ..jit import kernel, shared
from ..kernel_types import BallRecord, Box, Heights, Vector
from ..mechanics.vector import add_scaled, dot, length, load
from ..state.ball import NO_PART
from ..trajectory.segment import (
    acceleration_bounds,
    control_point,
    greatest_acceleration,
    greatest_speed,
    plane_gap,
    plane_gap_coefficients,
    position,
    velocity,
)

HOLDING_GAP = 1e-7  # m: contact margin of a wedged ball
RESTING_GAP = 5e-5  # m: contact margin of a time-stepped ball, to the ground and to balls
# m/s of approach: after a slower impact with a time-stepped ball a ball joins it
GENTLE_APPROACH = 0.1
SAME_DISTANCE = 1e-9  # m: distances that differ less are those of the same point
# m: least advance of a ball that leaves a concave part, which its bound would hold back
ESCAPE = 1e-9
# advances after which the bound on the speed over the whole segment is taken for too rough
MANY_STEPS = 100
# advances after which it pays to test whether one face is nearest to the whole segment
FEW_STEPS = 4
MANY_PARTS = 8  # parts in a swept box that make it worth halving the stretch
LEAST_EDGE_TIME = 1e-7  # s: a ball that leaves an edge sooner counts as having left it
LEAST_HOLLOW = 1e-12  # 1/m: less is none

# Begin and end of a stretch of time, the box that a ball sweeps in it, and of the parts in that
# box the first, and one after which there is none.
Swept = tuple[tuple[float, float], Box, tuple[int, int]]
IN_THE_AIR, ON_FLAT, ON_EDGE, ON_CURVE, WEDGED = range(5)
# of a gap of zero: what comes next is open, it is clear for a while, or hit
OPEN, CLEAR, HIT = range(3)


class Facing(NamedTuple):
    """How a ball faces a part at one time of its segment.

    ``distance`` of its centre, ``normal`` of the part, ``gap``, its ``rate``, by how much that
    falls a second, ``bend``, and the curvature of hollows.
    """

    distance: float
    normal: Vector
    gap: float
    rate: float
    bend: float
    hollow: float


@kernel
def sees_one_normal(ground: Ground, part: int, ball: BallRecord, normal: Vector) -> bool:
    """Whether a convex `part` has the same contact `normal` along the whole segment."""
    # The points that see one face along its normal form a convex region: it contains a curve whose
    # control points it contains.
    for i in range(6):
        _, seen = surfaces.nearest(ground, part, control_point(ball, i))
        if dot(seen, normal) < 1.0 - 1e-15:
            return False
    return True


@kernel
def plane_gap_bounds(
    ground: Ground, part: int, ball: BallRecord, radius: float
) -> tuple[Heights, float, float, Vector]:
    """Bernstein coefficients of the gap to `part` of one normal.

    Also bounds on how fast its rate falls, and rises, and that normal.
    """
    distance, normal = surfaces.nearest(ground, part, control_point(ball, 0))
    over = plane_gap_coefficients(ball, normal, distance - radius)
    falls, rises = acceleration_bounds(over, ball['span'])
    return over, falls, rises, normal


@kernel
def advancement_over_hollows(
    hollow: float, distance: float, gap: float, rate: float, bend: float, fastest: float
) -> float:
    """`advancement_bound` to a part with a `hollow`, its greatest concave curvature.

    The part is at a `distance` from the ball's centre.
    """
    # The ball's speed bounds the advance from anywhere; the parabola only within the tube of
    # unique nearest points, and so only until the ball may have left that.
    sure = (gap if gap > TOUCH else ESCAPE) / (fastest + 1e-9)
    tube = 0.5 / max(hollow, LEAST_HOLLOW) - distance
    if tube <= 0.0:
        return sure
    bent = advancement_bound(gap, rate, bend + 2.0 * hollow * fastest * fastest)
    return max(sure, min(bent, tube / (fastest + 1e-9)))


@kernel
def separation_time(
    ground: Ground, part: int, ball: BallRecord, radius: float, until: float
) -> float:
    """Time by which a ball in tangential contact with `part` has separated, or 0 if it presses on.

    A ball that flies off a flat ridge rises by less than TOUCH before it comes down beyond: up to
    the last time at which it still rose, it is clear.
    """
    time = 1e-9
    rising = 0.0
    while time < until and time < 1e-2:
        place = position(ball, time)
        distance, normal = surfaces.nearest(ground, part, place)
        if distance - radius < -TOUCH:
            # Where the surface has ended meanwhile, the ball falls past it.
            return rising if surfaces.touchable(ground, part, place) else time
        rate = dot(normal, velocity(ball, time))
        if distance - radius > 10 * TOUCH and rate > 0.0:
            return time
        if rate > RISING:
            rising = time
        time *= 4.0
    return min(time, until)


@kernel
def penetration_exit_time(
    ground: Ground,
    part: int,
    ball: BallRecord,
    radius: float,
    when: tuple[float, float],
    facing: Facing,
) -> float:
    """Safe time [s] for which a ball in a cut of `part` has not left it yet.

    Or a ball behind a one-sided sheet. There the gap is negative, and no impact. Along a straight
    line a convex gap stays below its chord, and the path strays from that line by at most
    A s^2 / 2. A cut reaches up to its outline, however near to the plane the ball moves. `when`
    is as in `touch`.
    """
    time, until = when
    gap, bend, hollow = facing.gap, facing.bend, facing.hollow
    place = position(ball, time)
    way = velocity(ball, time)
    least = max(-gap, 1e-6) / (length(way) + bend * until + 1e-3)
    if surfaces.in_cut(ground, part, place):
        distance, normal = surfaces.nearest(ground, part, place)
        room = surfaces.room_in_plan(ground, add_scaled(place, -distance, normal))
        least = max(least, room / (greatest_speed(ball) + 1e-9))
    if (
        len(ground.hole) > 0
        and surfaces.is_ground(ground, part)
        and hollow * facing.distance < 0.5
    ):
        # The closest point moves faster than the ball's centre only where it is over a hollow.
        foot = add_scaled(place, -facing.distance, facing.normal)
        fastest = (greatest_speed(ball) + 1e-9) / (1.0 - hollow * max(facing.distance, 0.0))
        least = max(least, surfaces.room_in_hole(ground.hole, foot) / fastest)
    if hollow > 0.0:
        return least
    left = until - time
    distance, _ = surfaces.nearest(ground, part, add_scaled(place, left, way))
    return max(least, advancement_bound(-gap, (gap - distance + radius) / left, bend))


@kernel
def touch(
    ground: Ground,
    part: int,
    ball: BallRecord,
    radius: float,
    when: tuple[float, float],
    facing: Facing,
) -> tuple[float, int]:
    """Tell what a gap to `part` of zero comes to: OPEN, CLEAR until a later time, or HIT.

    The time comes first, the later one or now. `when`: the time of it, and that up to which it is
    asked.
    """
    time, until = when
    rate = facing.rate
    place = position(ball, time)
    if not surfaces.touchable_at(ground, part, place, facing.distance, facing.normal):
        return time + penetration_exit_time(ground, part, ball, radius, when, facing), CLEAR
    # An edge's place is exact to FLUSH, so its normal to FLUSH over the radius: a rate within that
    # may be of either sign, and `separation_time` tells which.
    grazing = TANGENTIAL + FLUSH / radius * length(velocity(ball, time))
    if rate < -grazing or time > 0.0 and rate <= 0.0:
        return time, HIT
    if time == 0.0 and rate <= TANGENTIAL:
        time = separation_time(ground, part, ball, radius, until)
        return time, HIT if time == 0.0 else CLEAR
    return time, OPEN


@kernel
def is_sure_impact(
    ground: Ground, part: int, ball: BallRecord, radius: float, rate: float, time: float
) -> bool:
    """Whether a ball that nears `part` at that `rate`, and touches it at that time, hits it."""
    return rate < -PLAIN_APPROACH and surfaces.touchable_within(
        ground, part, position(ball, time), 2.0 * radius
    )


@shared
def relief_impact_time(
    ground: Ground, part: int, ball: BallRecord, radius: float, begin: float, until: float
) -> tuple[float, bool]:
    """`time_of_impact` with a smooth surface: by its height below, and near it by its distance.

    A loop of its own, out of line: most of its advances ask for a height and no nearest point.
    Writes segments_spent.
    """
    fastest = greatest_speed(ball)
    bend = greatest_acceleration(ball)
    time = begin
    for _ in range(MOST_ADVANCES):
        time = time_near_relief(ground, part, ball, radius, time, until)
        if time >= until:
            return until, False
        ball['segments_spent'] += LOOK
        place = position(ball, time)
        distance, normal = surfaces.nearest(ground, part, place)
        # Up to `until` the closest point is nowhere else.
        reach = abs(distance) + fastest * (until - time)
        hollow = surfaces.hollow_around(ground, part, place, reach)
        bent = bend + 2.0 * hollow * fastest * fastest
        gap = distance - radius
        rate = dot(normal, velocity(ball, time))
        if gap <= TOUCH:
            facing = Facing(distance, normal, gap, rate, bend, hollow)
            time, what = touch(ground, part, ball, radius, (time, until), facing)
            if what == HIT:
                return time, True
            if what == CLEAR:
                continue
        sure = advancement_over_hollows(hollow, distance, gap, rate, bend, fastest)
        time += sure
        if time < until and bent * sure * sure < TOUCH:
            # Another advance would change less than TOUCH: the gap is within bent s^2 / 2 of zero.
            if is_sure_impact(ground, part, ball, radius, rate, time):
                return time, True
    return time, False


@kernel
def time_near_face(
    ground: Ground, part: int, ball: BallRecord, radius: float, begin: float, until: float
) -> float:
    """Time, from `begin` up to `until`, before which the ball does not reach the plane of a face.

    It is `begin` where the ball starts within that plane.
    """
    distance, normal = surfaces.face_plane(ground, part, control_point(ball, 0))
    if distance < radius - TOUCH:
        return begin
    over = plane_gap_coefficients(ball, normal, distance - radius)
    if min(over) > TOUCH:  # a Bezier curve stays between its control points
        return until
    falls, _ = acceleration_bounds(over, ball['span'])
    time = begin
    for _ in range(MOST_ADVANCES):
        gap, rate = plane_gap(over, ball['span'], time)
        if gap < -TOUCH or gap <= TOUCH and rate <= TANGENTIAL:  # beyond it, or at it
            break
        time += advancement_bound(gap, rate, falls)
        if time >= until:
            return until
    return time


@shared
def plane_impact_time(
    ground: Ground, part: int, ball: BallRecord, radius: float, begin: float, until: float
) -> tuple[float, bool]:
    """`time_of_impact` with a part whose nearest point has one normal along the whole segment.

    Writes segments_spent.
    """
    cost = LOOK * surfaces.effort(ground, part)
    span = ball['span']
    over, falls, rises, normal = plane_gap_bounds(ground, part, ball, radius)
    time = begin
    for _ in range(MOST_ADVANCES):
        ball['segments_spent'] += cost
        gap, rate = plane_gap(over, span, time)
        if gap <= TOUCH:
            facing = Facing(gap + radius, normal, gap, rate, falls, 0.0)
            time, what = touch(ground, part, ball, radius, (time, until), facing)
            if what == HIT:
                return time, True
            if what == CLEAR:
                if time >= until:
                    return until, False
                continue
        sure = advancement_bound(gap, rate, falls)
        time += sure
        if time >= until:
            return until, False
        if max(falls, rises) * sure * sure < TOUCH:
            # Another advance would change less than TOUCH: the gap is within that of zero by now.
            if is_sure_impact(ground, part, ball, radius, rate, time):
                return time, True
    return time, False


@kernel
def time_of_impact(
    ground: Ground, part: int, ball: BallRecord, radius: float, begin: float, until: float
) -> tuple[float, bool]:
    """Time of impact with `part` between `begin` and `until`, or a safe time; and which it is.

    Writes segments_spent.
    """
    form = surfaces.form(ground, part)
    if form == RELIEF_FORM:
        return relief_impact_time(ground, part, ball, radius, begin, until)
    if form == PLANE_FORM:
        return plane_impact_time(ground, part, ball, radius, begin, until)
    time = time_near_face(ground, part, ball, radius, begin, until) if form == FACE_FORM else begin
    if time >= until:
        return until, False
    cost = LOOK * surfaces.effort(ground, part)
    hollow = surfaces.hollow(ground, part)
    fastest = greatest_speed(ball) if hollow > 0.0 else 0.0
    bend = greatest_acceleration(ball)
    for step in range(MOST_ADVANCES):
        ball['segments_spent'] += cost
        distance, normal = surfaces.nearest(ground, part, position(ball, time))
        gap = distance - radius
        rate = dot(normal, velocity(ball, time))
        if gap <= TOUCH:
            facing = Facing(distance, normal, gap, rate, bend, hollow)
            time, what = touch(ground, part, ball, radius, (time, until), facing)
            if what == HIT:
                return time, True
            if what == CLEAR:
                if time >= until:
                    return until, False
                continue
        if hollow > 0.0:
            sure = advancement_over_hollows(hollow, distance, gap, rate, bend, fastest)
            if step > MANY_STEPS:  # a slow ball on a segment at whose end it is fast
                sure = max(sure, advancement_bound(gap, -length(velocity(ball, time)), bend))
            time += sure
        elif step == FEW_STEPS and sees_one_normal(ground, part, ball, normal):
            return plane_impact_time(ground, part, ball, radius, time, until)
        else:
            time += advancement_bound(gap, rate, bend)
        if time >= until:
            return until, False
    return time, False


@shared
def first_ground_contact(
    ground: Ground, ball: BallRecord, radius: float, until: float, on: int
) -> tuple[float, int, bool]:
    """Time of impact of the segment with the ground, or a safe time.

    Also the part, and whether it is an impact.

    `on` is what the ball keeps contact with meanwhile: IN_THE_AIR nothing; ON_FLAT the plane under
    it, where coplanar surfaces, and edges hit tangentially, are seams and no obstacles; ON_EDGE
    the edge that supports it; ON_CURVE the smooth surface; WEDGED all that holds it. Writes
    segments_spent.
    """
    begin = 0.0
    stretch = until
    best = until
    while begin < until:
        end = min(begin + stretch, until)
        low, high = swept_box(ball, begin, end, radius)
        ball['segments_spent'] += LOOK
        first, last, count = surfaces.parts_within(ground, low, high, MANY_PARTS)
        if count == MANY_PARTS:
            if is_long(low, high, SHORT_BOX * radius):
                stretch = 0.5 * (end - begin)
                continue
            last = surfaces.parts(ground)
        swept = (begin, end), (low, high), (first, last)
        best, who, hit = first_in_box(ground, ball, radius, swept, on)
        if hit or best < end:
            return best, who, hit
        begin = end
        stretch *= 2.0
    return until, NO_PART, False


@kernel
def first_in_box(
    ground: Ground, ball: BallRecord, radius: float, swept: Swept, on: int
) -> tuple[float, int, bool]:
    """`first_ground_contact` with the parts that overlap the box `swept` over a stretch of time.

    Writes segments_spent.
    """
    (begin, end), (low, high), (part, last) = swept
    best = end
    who = NO_PART
    hit = False
    while part >= 0:
        ball['segments_spent'] += LOOK
        if not is_ignored(ground, part, ball, radius, best, on):
            time, touches = time_of_impact(ground, part, ball, radius, begin, best)
            # Impacts that turn out to be seams, or the edge that the ball follows, are dropped.
            if touches and on == ON_FLAT:
                _, normal = surfaces.nearest(ground, part, position(ball, time))
                touches = dot(normal, load(ball['normal'])) <= 1.0 - 1e-9
                if not touches:
                    time = end
            if touches and on == ON_EDGE and time == 0.0:
                lasts = edge_duration(ground, part, ball, best)
                if lasts > 0.0:
                    time = lasts
                    touches = False
            if time < best or touches and not hit:
                best = time
                who = part
                hit = touches
        part = surfaces.part_after(ground, part, last, low, high)
    return best, who, hit


@kernel
def is_ignored(
    ground: Ground, part: int, ball: BallRecord, radius: float, until: float, on: int
) -> bool:
    """Whether `part` is no obstacle, since the ball is in lasting contact with it: `on`."""
    if on == ON_FLAT:
        foot = add_scaled(load(ball['position']), -radius, load(ball['normal']))
        return surfaces.is_below_plane(ground, part, foot, load(ball['normal']))
    if on == WEDGED:
        return holds_wedged(ground, part, ball, radius)
    if on == ON_CURVE:
        return surfaces.goes_on(ground, ball['support'], part)
    if on == ON_EDGE:
        return is_same_edge(ground, part, ball, until)
    return False


@kernel
def holds_wedged(ground: Ground, part: int, ball: BallRecord, radius: float) -> bool:
    """Whether `part` is within the contact margin of a wedged or time-stepped ball.

    Then it is no obstacle. It still is one to a time-stepped ball that another has just hit: that
    approaches too fast to wait for the next time step.
    """
    distance, normal = surfaces.nearest(ground, part, load(ball['position']))
    if not ball['time_stepping']:
        return distance - radius <= HOLDING_GAP
    return distance - radius <= RESTING_GAP and dot(normal, velocity(ball, 0.0)) > -GENTLE_APPROACH


@kernel
def is_same_edge(ground: Ground, part: int, ball: BallRecord, until: float) -> bool:
    """Whether the nearest point of `part` is that of the support, at the start and at `until`."""
    if part == ball['support']:
        return True
    for i in range(2):
        place = position(ball, i * until)
        distance, normal = surfaces.nearest(ground, part, place)
        supported, upward = surfaces.nearest(ground, ball['support'], place)
        if abs(distance - supported) > SAME_DISTANCE or dot(normal, upward) < 1.0 - 1e-12:
            return False
    return True


@kernel
def edge_duration(ground: Ground, part: int, ball: BallRecord, until: float) -> float:
    """Time, `until` at most, for which `part` shares the supporting edge; 0 if not at all.

    Two faces share the edge that a ball rolls around: a face is no obstacle before the ball leaves
    the edge.
    """
    while until > LEAST_EDGE_TIME:
        if is_same_edge(ground, part, ball, until):
            return until
        until *= 0.5
    return 0.0
