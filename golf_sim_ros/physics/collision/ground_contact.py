# SPDX-License-Identifier: Apache-2.0
"""Time of impact of a ball's segment with the ground.

Parts of the ground are convex, or have hollows of bounded curvature: conservative advancement along the
segment never steps over a contact with one (see conservative_advancement.py). Where a part has hollows of
curvature at most K, the gap's rate can fall by another 2 K v^2 as long as the ball's centre is nearer than
1 / (2 K); from further away the ball's speed bounds how fast a gap closes.

Many parts in the box around a segment are looked at stretch by stretch, each half as long as long as it
is crowded: only those on the way are asked.
"""
from ..geometry import surfaces
from ..geometry.plane_patch import FLUSH
from ..jit import kernel, shared
from ..mechanics.vector import add_scaled, dot, length, load
from ..state.ball import NO_PART
from ..trajectory.segment import (acceleration_bounds, control_point, greatest_acceleration, greatest_speed,
                                  plane_gap, plane_gap_coefficients, position, velocity)
from .conservative_advancement import (MOST_ADVANCES, NEVER, PLAIN_APPROACH, RISING, SHORT_BOX, TANGENTIAL,
                                       TOUCH, swept_box, is_long, advancement_bound)
HOLDING_GAP = 1e-7  # m: surfaces nearer than this hold a wedged ball
RESTING_GAP = 5e-5  # m: the same of a time-stepped ball, balls too
GENTLE_APPROACH = 0.1  # m/s of approach: slower, a ball joins the time-stepped ones that it meets
SAME_DISTANCE = 1e-9  # m: distances that differ less are those of the same point
ESCAPE = 1e-9  # m: so far a ball that leaves a hollow may move before it is looked at again
MANY_STEPS = 100  # after which the bound on the speed all along is taken for too rough
LOOK = 1.0 / 32.0  # of the work of a segment elsewhere: so much is a look at one part
FEW_STEPS = 4  # steps, after which it is worth looking whether a part's nearest face is the same all along
MANY_PARTS = 8  # parts: so many in the box around a stretch of path are worth a shorter stretch
LEAST_EDGE_TIME = 1e-7  # s: a ball that leaves an edge sooner has left it
NO_HEIGHTS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
IN_THE_AIR, ON_FLAT, ON_EDGE, ON_CURVE, WEDGED = range(5)


@kernel
def sees_one_normal(ground, part, ball, normal):
    """Whether the whole segment sees one and the same `normal` of a convex `part`."""
    for i in range(6):
        _, seen = surfaces.nearest(ground, part, control_point(ball, i))
        if dot(seen, normal) < 1.0 - 1e-15:
            return False
    return True


@kernel
def plane_gap_bounds(ground, part, ball, radius):
    """Coefficients of the gap to `part`, seen with one normal all along; how fast its rate falls, rises."""
    distance, normal = surfaces.nearest(ground, part, control_point(ball, 0))
    over = plane_gap_coefficients(ball, normal, distance - radius)
    falls, rises = acceleration_bounds(over, ball['span'])
    return over, falls, rises


@kernel
def advancement_over_hollows(hollow, distance, gap, rate, bend, fastest):
    """`advancement_bound` over a part with hollows of that curvature, `distance` from the ball's centre."""
    sure = (gap if gap > TOUCH else ESCAPE) / (fastest + 1e-9)
    tube = 0.5 / hollow - distance
    if tube <= 0.0:
        return sure
    bent = advancement_bound(gap, rate, bend + 2.0 * hollow * fastest * fastest)
    return max(sure, min(bent, tube / (fastest + 1e-9)))


@kernel
def separation_time(ground, part, ball, radius, until):
    """Time up to which a ball that touches `part` tangentially moves off it, or 0 if it presses on.

    A ball that flies off a flat ridge rises by less than can be told from touching before it comes down
    beyond: up to where it still rose, it is clear.
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
def penetration_exit_time(ground, part, ball, radius, time, until, gap, bend, hollow):
    """Time for which a ball in a cut of `part`, or behind a one-sided sheet, is not clear of its plane yet.

    Along a straight way a convex gap stays below its chord, and the path strays from that way by at
    most A s^2 / 2. A cut goes on up to its outline, however near to its plane the ball moves.
    """
    place = position(ball, time)
    way = velocity(ball, time)
    least = max(-gap, 1e-6) / (length(way) + bend * until + 1e-3)
    if surfaces.in_cut(ground, part, place):
        distance, normal = surfaces.nearest(ground, part, place)
        room = surfaces.room_in_plan(ground, add_scaled(place, -distance, normal))
        least = max(least, room / (greatest_speed(ball) + 1e-9))
    if hollow > 0.0:
        return least
    left = until - time
    distance, _ = surfaces.nearest(ground, part, add_scaled(place, left, way))
    return max(least, advancement_bound(-gap, (gap - distance + radius) / left, bend))


@kernel
def time_of_impact(ground, part, ball, radius, begin, until):
    """Time from `begin` to `until` up to which the segment is safe from `part`; whether it touches then.

    Writes segments_spent.
    """
    cost = LOOK * surfaces.effort(ground, part)
    hollow = surfaces.hollow(ground, part)
    fastest = greatest_speed(ball) if hollow > 0.0 else 0.0
    span = ball['span']
    level = surfaces.is_plane(ground, part)
    rises = NEVER
    if level:
        over, bend, rises = plane_gap_bounds(ground, part, ball, radius)
    else:
        over = NO_HEIGHTS
        bend = greatest_acceleration(ball)
    time = begin
    for step in range(MOST_ADVANCES):
        ball['segments_spent'] += cost
        if level:
            gap, rate = plane_gap(over, span, time)
        else:
            distance, normal = surfaces.nearest(ground, part, position(ball, time))
            gap = distance - radius
            rate = dot(normal, velocity(ball, time))
        if gap <= TOUCH:
            if not surfaces.touchable(ground, part, position(ball, time)):
                time += penetration_exit_time(ground, part, ball, radius, time, until, gap, bend, hollow)
                if time >= until:
                    return until, False
                continue
            # An edge is known to FLUSH, its direction to FLUSH over the radius: `separation_time` tells.
            grazing = TANGENTIAL + FLUSH / radius * length(velocity(ball, time))
            if rate < -grazing or time > 0.0 and rate <= 0.0:
                return time, True
            if time == 0.0 and rate <= TANGENTIAL:
                time = separation_time(ground, part, ball, radius, until)
                if time == 0.0:
                    return 0.0, True
                if time >= until:
                    return until, False
                continue
        if hollow > 0.0:
            sure = advancement_over_hollows(hollow, distance, gap, rate, bend, fastest)
            if step > MANY_STEPS:  # a slow ball on a segment at whose end it is fast
                sure = max(sure, advancement_bound(gap, -length(velocity(ball, time)), bend))
            time += sure
        else:
            if step == FEW_STEPS and not level and sees_one_normal(ground, part, ball, normal):
                level = True
                over, bend, rises = plane_gap_bounds(ground, part, ball, radius)
            sure = advancement_bound(gap, rate, bend)
            time += sure
            if (max(bend, rises) * sure * sure < TOUCH and rate < -PLAIN_APPROACH and time < until
                    and surfaces.touchable(ground, part, position(ball, time))):
                return time, True  # by then the gap is the square's half at most, either way
        if time >= until:
            return until, False
    return time, False


@shared
def first_ground_contact(ground, ball, radius, until, on):
    """First time at which the segment touches any part, which one, and whether it really does.

    `on` says what the ball keeps contact with meanwhile: IN_THE_AIR nothing; ON_FLAT the plane
    under it, where surfaces in that plane, and edges met tangentially, are seams and no obstacles;
    ON_EDGE the edge that supports it; ON_CURVE the smooth surface; CAUGHT all that holds it.
    Writes segments_spent.
    """
    begin = 0.0
    stretch = until
    best = until
    while begin < until:
        end = min(begin + stretch, until)
        low, high = swept_box(ball, begin, end, radius)
        ball['segments_spent'] += LOOK
        if is_long(low, high, SHORT_BOX * radius) and has_many_parts(ground, low, high):
            stretch = 0.5 * (end - begin)
            continue
        best, who, hit = first_in_box(ground, ball, radius, begin, end, low, high, on)
        if hit or best < end:
            return best, who, hit
        begin = end
        stretch *= 2.0
    return until, NO_PART, False


@kernel
def has_many_parts(ground, low, high):
    """Whether many parts have a point in the box."""
    if surfaces.parts(ground) < MANY_PARTS:
        return False
    part = NO_PART
    for _ in range(MANY_PARTS):
        part = surfaces.next_part(ground, part + 1, low, high)
        if part < 0:
            return False
    return True


@kernel
def first_in_box(ground, ball, radius, begin, end, low, high, on):
    """`first_ground_contact` from `begin` to `end` with what has a point in the box from `low` to `high`."""
    best = end
    who = NO_PART
    hit = False
    foot = add_scaled(load(ball['position']), -radius, load(ball['normal']))
    part = surfaces.next_part(ground, 0, low, high)
    while part >= 0:
        ball['segments_spent'] += LOOK
        if not is_ignored(ground, part, ball, radius, foot, best, on):
            time, touches = time_of_impact(ground, part, ball, radius, begin, best)
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
        part = surfaces.next_part(ground, part + 1, low, high)
    return best, who, hit


@kernel
def is_ignored(ground, part, ball, radius, foot, until, on):
    """Whether `part` is no obstacle to the ball because of what it is `on`."""
    if on == ON_FLAT:
        return surfaces.in_plane(ground, part, foot, load(ball['normal']))
    if on == WEDGED:
        return holds_wedged(ground, part, ball, radius)
    if on == ON_CURVE:
        return surfaces.goes_on(ground, ball['support'], part)
    if on == ON_EDGE:
        return is_same_edge(ground, part, ball, until)
    return False


@kernel
def holds_wedged(ground, part, ball, radius):
    """Whether `part` holds the wedged ball as its segment begins, and so is no obstacle to it.

    A time-stepped ball that another has just hit may be too fast to wait for the next time step.
    """
    distance, normal = surfaces.nearest(ground, part, load(ball['position']))
    if not ball['time_stepping']:
        return distance - radius <= HOLDING_GAP
    return distance - radius <= RESTING_GAP and dot(normal, velocity(ball, 0.0)) > -GENTLE_APPROACH


@kernel
def is_same_edge(ground, part, ball, until):
    """Whether what is nearest of `part` is what supports the ball, now and `until` the segment's end."""
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
def edge_duration(ground, part, ball, until):
    """Time, `until` at most, for which the supporting edge is that of `part` too; 0 if not at all.

    Two faces share the edge that the ball follows: one is no obstacle before the ball leaves for it.
    """
    while until > LEAST_EDGE_TIME:
        if is_same_edge(ground, part, ball, until):
            return until
        until *= 0.5
    return 0.0
