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
from ..mechanics.vector import along, dot, length, vector
from ..state.ball import NO_PART
from ..trajectory.segment import (bends, corner, greatest_acceleration, greatest_speed, height, heights,
                                  position, velocity)
from .conservative_advancement import (MOST_STEPS, NEVER, PLAIN, RISING, SHORT, TANGENTIAL, TOUCH, box,
                                       is_long, safe_advance)
NEAR = 1e-7  # m: surfaces nearer than this hold a caught ball
PILE_NEAR = 5e-5  # m: the same in a pile, of balls too
GENTLE = 0.1  # m/s of approach: slower, a ball stays with the pile that it meets
SAME = 1e-9  # m: distances that differ less are those of the same point
ESCAPE = 1e-9  # m: so far a ball that leaves a hollow may move before it is looked at again
MANY_STEPS = 100  # after which the bound on the speed all along is taken for too rough
LOOK = 1.0 / 32.0  # of the work of a segment elsewhere: so much is a look at one part
FEW = 4  # steps, after which it is worth looking whether a part's nearest face is the same all along
CROWD = 8  # parts: so many in the box around a stretch of path are worth a shorter stretch
BARELY = 1e-7  # s: a ball that leaves an edge sooner has left it
NO_HEIGHTS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
IN_THE_AIR, ON_FLAT, ON_EDGE, ON_CURVE, CAUGHT = range(5)


@kernel
def sees_one(ground, part, ball, normal):
    """Whether the whole piece sees one and the same `normal` of a convex `part`."""
    for i in range(6):
        _, seen = surfaces.nearest(ground, part, corner(ball, i))
        if dot(seen, normal) < 1.0 - 1e-15:
            return False
    return True


@kernel
def over_plane(ground, part, ball, radius):
    """Coefficients of the gap to `part`, seen with one normal all along; how fast its rate falls, rises."""
    distance, normal = surfaces.nearest(ground, part, corner(ball, 0))
    over = heights(ball, normal, distance - radius)
    falls, rises = bends(over, ball['span'])
    return over, falls, rises


@kernel
def past_hollows(hollow, distance, gap, rate, bend, fastest):
    """`safe_advance` over a part with hollows of curvature `hollow`, `distance` from the ball's centre."""
    sure = (gap if gap > TOUCH else ESCAPE) / (fastest + 1e-9)
    tube = 0.5 / hollow - distance
    if tube <= 0.0:
        return sure
    bent = safe_advance(gap, rate, bend + 2.0 * hollow * fastest * fastest)
    return max(sure, min(bent, tube / (fastest + 1e-9)))


@kernel
def leave(ground, part, ball, radius, until):
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
def submerged(ground, part, ball, radius, time, until, gap, bend, hollow):
    """Time for which a ball in a cut of `part`, or behind a one-sided sheet, is not clear of its plane yet.

    Along a straight way a convex gap stays below its chord, and the path strays from that way by at
    most A s^2 / 2. A cut goes on up to its outline, however near to its plane the ball moves.
    """
    place = position(ball, time)
    way = velocity(ball, time)
    least = max(-gap, 1e-6) / (length(way) + bend * until + 1e-3)
    if surfaces.in_cut(ground, part, place):
        distance, normal = surfaces.nearest(ground, part, place)
        room = surfaces.room_in_plan(ground, along(place, -distance, normal))
        least = max(least, room / (greatest_speed(ball) + 1e-9))
    if hollow > 0.0:
        return least
    left = until - time
    distance, _ = surfaces.nearest(ground, part, along(place, left, way))
    return max(least, safe_advance(-gap, (gap - distance + radius) / left, bend))


@kernel
def first_touch(ground, part, ball, radius, begin, until):
    """Time from `begin` to `until` up to which the piece is safe from `part`; whether it touches then.

    Writes pieces.
    """
    work = LOOK * surfaces.effort(ground, part)
    hollow = surfaces.hollow(ground, part)
    fastest = greatest_speed(ball) if hollow > 0.0 else 0.0
    span = ball['span']
    level = surfaces.is_plane(ground, part)
    rises = NEVER
    if level:
        over, bend, rises = over_plane(ground, part, ball, radius)
    else:
        over = NO_HEIGHTS
        bend = greatest_acceleration(ball)
    time = begin
    for step in range(MOST_STEPS):
        ball['pieces'] += work
        if level:
            gap, rate = height(over, span, time)
        else:
            distance, normal = surfaces.nearest(ground, part, position(ball, time))
            gap = distance - radius
            rate = dot(normal, velocity(ball, time))
        if gap <= TOUCH:
            if not surfaces.touchable(ground, part, position(ball, time)):
                time += submerged(ground, part, ball, radius, time, until, gap, bend, hollow)
                if time >= until:
                    return until, False
                continue
            # An edge is known to FLUSH, so is its direction to FLUSH over the radius: `leave` tells.
            grazing = TANGENTIAL + FLUSH / radius * length(velocity(ball, time))
            if rate < -grazing or time > 0.0 and rate <= 0.0:
                return time, True
            if time == 0.0 and rate <= TANGENTIAL:
                time = leave(ground, part, ball, radius, until)
                if time == 0.0:
                    return 0.0, True
                if time >= until:
                    return until, False
                continue
        if hollow > 0.0:
            sure = past_hollows(hollow, distance, gap, rate, bend, fastest)
            if step > MANY_STEPS:  # a slow ball on a piece at whose end it is fast
                sure = max(sure, safe_advance(gap, -length(velocity(ball, time)), bend))
            time += sure
        else:
            if step == FEW and not level and sees_one(ground, part, ball, normal):
                level = True
                over, bend, rises = over_plane(ground, part, ball, radius)
            sure = safe_advance(gap, rate, bend)
            time += sure
            if (max(bend, rises) * sure * sure < TOUCH and rate < -PLAIN and time < until
                    and surfaces.touchable(ground, part, position(ball, time))):
                return time, True  # by then the gap is the square's half at most, either way
        if time >= until:
            return until, False
    return time, False


@shared
def first_contact(ground, ball, radius, until, on):
    """First time at which the piece touches any part, which one, and whether it really does.

    `on` says what the ball keeps contact with meanwhile: IN_THE_AIR nothing; ON_FLAT the plane
    under it, where surfaces in that plane, and edges met tangentially, are seams and no obstacles;
    ON_EDGE the edge that supports it; ON_CURVE the smooth surface; CAUGHT all that holds it.
    Writes pieces.
    """
    begin = 0.0
    stretch = until
    best = until
    while begin < until:
        end = min(begin + stretch, until)
        low, high = box(ball, begin, end, radius)
        ball['pieces'] += LOOK
        if is_long(low, high, SHORT * radius) and is_crowded(ground, low, high):
            stretch = 0.5 * (end - begin)
            continue
        best, who, hit = first_in_box(ground, ball, radius, begin, end, low, high, on)
        if hit or best < end:
            return best, who, hit
        begin = end
        stretch *= 2.0
    return until, NO_PART, False


@kernel
def is_crowded(ground, low, high):
    """Whether many parts have a point in the box."""
    if surfaces.parts(ground) < CROWD:
        return False
    part = NO_PART
    for _ in range(CROWD):
        part = surfaces.next_part(ground, part + 1, low, high)
        if part < 0:
            return False
    return True


@kernel
def first_in_box(ground, ball, radius, begin, end, low, high, on):
    """`first_contact` from `begin` to `end` with what has a point in the box from `low` to `high`."""
    best = end
    who = NO_PART
    hit = False
    foot = along(vector(ball['position']), -radius, vector(ball['normal']))
    part = surfaces.next_part(ground, 0, low, high)
    while part >= 0:
        ball['pieces'] += LOOK
        if not is_passed(ground, part, ball, radius, foot, best, on):
            time, touches = first_touch(ground, part, ball, radius, begin, best)
            if touches and on == ON_FLAT:
                _, normal = surfaces.nearest(ground, part, position(ball, time))
                touches = dot(normal, vector(ball['normal'])) <= 1.0 - 1e-9
                if not touches:
                    time = end
            if touches and on == ON_EDGE and time == 0.0:
                lasts = edge_lasts(ground, part, ball, best)
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
def is_passed(ground, part, ball, radius, foot, until, on):
    """Whether `part` is no obstacle to the ball because of what it is `on`."""
    if on == ON_FLAT:
        return surfaces.in_plane(ground, part, foot, vector(ball['normal']))
    if on == CAUGHT:
        return holds(ground, part, ball, radius)
    if on == ON_CURVE:
        return surfaces.goes_on(ground, ball['support'], part)
    if on == ON_EDGE:
        return same_edge(ground, part, ball, until)
    return False


@kernel
def holds(ground, part, ball, radius):
    """Whether `part` holds the caught ball as its piece begins, and so is no obstacle to it.

    One of a pile that another ball has just hit may be too fast to wait for the pile.
    """
    distance, normal = surfaces.nearest(ground, part, vector(ball['position']))
    if not ball['piled']:
        return distance - radius <= NEAR
    return distance - radius <= PILE_NEAR and dot(normal, velocity(ball, 0.0)) > -GENTLE


@kernel
def same_edge(ground, part, ball, until):
    """Whether what is nearest of `part` is what supports the ball, now and `until` the piece's end."""
    if part == ball['support']:
        return True
    for i in range(2):
        place = position(ball, i * until)
        distance, normal = surfaces.nearest(ground, part, place)
        supported, upward = surfaces.nearest(ground, ball['support'], place)
        if abs(distance - supported) > SAME or dot(normal, upward) < 1.0 - 1e-12:
            return False
    return True


@kernel
def edge_lasts(ground, part, ball, until):
    """Time, `until` at most, for which the supporting edge is that of `part` too; 0 if not at all.

    Two faces share the edge that the ball follows: one is no obstacle before the ball leaves for it.
    """
    while until > BARELY:
        if same_edge(ground, part, ball, until):
            return until
        until *= 0.5
    return 0.0
