# SPDX-License-Identifier: Apache-2.0
"""When a piece of path first touches something: advance that never steps over a contact.

A part of the ground is convex, so the gap to it is a convex function of position. Along a path of
acceleration at most A it therefore stays above the parabola

    gap(t + s) >= gap(t) + gap'(t) s - A s^2 / 2

and it is safe to advance to that parabola's root. It is Newton's method from the safe side:
it converges as fast, and can't tunnel. Where a part has hollows of curvature at most K, the gap's rate
can fall by another 2 K v^2 as long as the ball's centre is nearer than 1 / (2 K); from further away the
ball's speed bounds how fast a gap closes.

Many parts in the box around a piece are looked at stretch by stretch, each half as long as long as it
is crowded: only those on the way are asked.
"""
from math import sqrt

from .jit import kernel, shared
from .ground import surface
from .ground.flat import FLUSH
from .path import (bends, corner, greatest_acceleration, greatest_speed, height, heights,
                   least_acceleration, position, span_along, velocity)
from .state import NO_PART
from .vector import add, along, dot, length, sub, vector

TOUCH = 1e-11  # m: gaps below count as contact; 300 m have a rounding error of 6e-14 m
NEAR = 1e-7  # m: surfaces nearer than this hold a caught ball
PILE_NEAR = 5e-5  # m: the same in a pile, of balls too
GENTLE = 0.1  # m/s of approach: slower, a ball stays with the pile that it meets
SAME = 1e-9  # m: distances that differ less are those of the same point
TANGENTIAL = 1e-9  # m/s: a gap that changes slower than this does not change
RISING = 1e-12  # m/s: more than the rounding error of a rate, and less than a nanosecond's acceleration
PLAIN = 0.01  # m/s: what approaches faster, and is a microsecond away, will touch
NEVER = 1e300
MOST_STEPS = 200
FEW = 4  # steps, after which it is worth looking whether a part's nearest face is the same all along
CROWD = 8  # parts: so many in the box around a stretch of path are worth a shorter stretch
BARELY = 1e-7  # s: a ball that leaves an edge sooner has left it
SHORT = 4.0  # radii: a stretch with a box no longer than this is not worth halving
NO_HEIGHTS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
IN_THE_AIR, ON_FLAT, ON_EDGE, ON_CURVE, CAUGHT = range(5)


@kernel
def safe_advance(gap, rate, bend):
    """Time in which a gap of that `rate` can't close if its rate falls by at most `bend`."""
    gap = max(gap, 0.0)
    if bend <= 0.0:
        return gap / -rate if rate < 0.0 else NEVER
    root = sqrt(rate * rate + 2.0 * bend * gap)
    if rate < 0.0:
        return 2.0 * gap / (root - rate)
    return (rate + root) / bend


@kernel
def sees_one(ground, part, ball, normal):
    """Whether the whole piece sees one and the same `normal` of a convex `part`."""
    for i in range(6):
        _, seen = surface.nearest(ground, part, corner(ball, i))
        if dot(seen, normal) < 1.0 - 1e-15:
            return False
    return True


@kernel
def over_plane(ground, part, ball, radius):
    """Coefficients of the gap to `part`, seen with one normal all along; how fast its rate falls, rises."""
    distance, normal = surface.nearest(ground, part, corner(ball, 0))
    over = heights(ball, normal, distance - radius)
    falls, rises = bends(over, ball['span'])
    return over, falls, rises


@kernel
def past_hollows(hollow, distance, gap, rate, bend, fastest):
    """`safe_advance` over a part with hollows of curvature `hollow`, `distance` from the ball's centre."""
    sure = gap / (fastest + 1e-9)
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
        distance, normal = surface.nearest(ground, part, place)
        if distance - radius < -TOUCH:
            # Where the surface has ended meanwhile, the ball falls past it.
            return rising if surface.touchable(ground, part, place) else time
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
    if surface.in_cut(ground, part, place):
        distance, normal = surface.nearest(ground, part, place)
        room = surface.room_in_plan(ground, along(place, -distance, normal))
        least = max(least, room / (greatest_speed(ball) + 1e-9))
    if hollow > 0.0:
        return least
    left = until - time
    distance, _ = surface.nearest(ground, part, along(place, left, way))
    return max(least, safe_advance(-gap, (gap - distance + radius) / left, bend))


@kernel
def first_touch(ground, part, ball, radius, begin, until):
    """Time from `begin` to `until` up to which the piece is safe from `part`; whether it touches then."""
    hollow = surface.hollow(ground, part)
    fastest = greatest_speed(ball) if hollow > 0.0 else 0.0
    span = ball['span']
    level = surface.is_plane(ground, part)
    rises = NEVER
    if level:
        over, bend, rises = over_plane(ground, part, ball, radius)
    else:
        over = NO_HEIGHTS
        bend = greatest_acceleration(ball)
    time = begin
    for step in range(MOST_STEPS):
        if level:
            gap, rate = height(over, span, time)
        else:
            distance, normal = surface.nearest(ground, part, position(ball, time))
            gap = distance - radius
            rate = dot(normal, velocity(ball, time))
        if gap <= TOUCH:
            if not surface.touchable(ground, part, position(ball, time)):
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
            time += past_hollows(hollow, distance, gap, rate, bend, fastest)
        else:
            if step == FEW and not level and sees_one(ground, part, ball, normal):
                level = True
                over, bend, rises = over_plane(ground, part, ball, radius)
            sure = safe_advance(gap, rate, bend)
            time += sure
            if (max(bend, rises) * sure * sure < TOUCH and rate < -PLAIN and time < until
                    and surface.touchable(ground, part, position(ball, time))):
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
    """
    begin = 0.0
    stretch = until
    best = until
    while begin < until:
        end = min(begin + stretch, until)
        low, high = box(ball, begin, end, radius)
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
def box(ball, begin, end, radius):
    """Box around the ball on its piece from `begin` to `end`."""
    if begin == 0.0 and end >= 0.5 * ball['span']:
        x = span_along(ball, 0)
        y = span_along(ball, 1)
        z = span_along(ball, 2)
        return ((x[0] - radius, y[0] - radius, z[0] - radius), (x[1] + radius, y[1] + radius, z[1] + radius))
    a = position(ball, begin)
    b = position(ball, end)
    room = radius + 0.125 * greatest_acceleration(ball) * (end - begin) * (end - begin)
    return ((min(a[0], b[0]) - room, min(a[1], b[1]) - room, min(a[2], b[2]) - room),
            (max(a[0], b[0]) + room, max(a[1], b[1]) + room, max(a[2], b[2]) + room))


@kernel
def is_long(low, high, size):
    """Whether the box from `low` to `high` is longer than `size` in any direction."""
    return high[0] - low[0] > size or high[1] - low[1] > size or high[2] - low[2] > size


@kernel
def is_crowded(ground, low, high):
    """Whether many parts have a point in the box."""
    if surface.parts(ground) < CROWD:
        return False
    part = NO_PART
    for _ in range(CROWD):
        part = surface.next_part(ground, part + 1, low, high)
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
    part = surface.next_part(ground, 0, low, high)
    while part >= 0:
        if not is_passed(ground, part, ball, radius, foot, best, on):
            time, touches = first_touch(ground, part, ball, radius, begin, best)
            if touches and on == ON_FLAT:
                _, normal = surface.nearest(ground, part, position(ball, time))
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
        part = surface.next_part(ground, part + 1, low, high)
    return best, who, hit


@kernel
def is_passed(ground, part, ball, radius, foot, until, on):
    """Whether `part` is no obstacle to the ball because of what it is `on`."""
    if on == ON_FLAT:
        return surface.in_plane(ground, part, foot, vector(ball['normal']))
    if on == CAUGHT:
        return holds(ground, part, ball, radius)
    if on == ON_CURVE:
        return surface.goes_on(ground, ball['support'], part)
    if on == ON_EDGE:
        return same_edge(ground, part, ball, until)
    return False


@kernel
def holds(ground, part, ball, radius):
    """Whether `part` holds the caught ball as its piece begins, and so is no obstacle to it.

    One of a pile that another ball has just hit may be too fast to wait for the pile.
    """
    distance, normal = surface.nearest(ground, part, vector(ball['position']))
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
        distance, normal = surface.nearest(ground, part, place)
        supported, upward = surface.nearest(ground, ball['support'], place)
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


@shared
def first_border(ground, ball, radius, until):
    """First time, at most `until`, at which the piece crosses a border in plan, and whether so.

    It is the ball's foot that crosses.
    """
    best = until
    crosses = False
    bend = greatest_acceleration(ball)
    x = span_along(ball, 0)
    y = span_along(ball, 1)
    for i in range(len(ground.borders)):
        border = ground.borders[i]
        end_x = border['start'][0] + border['length'] * border['direction'][0]
        end_y = border['start'][1] + border['length'] * border['direction'][1]
        dx = -radius * ball['normal'][0]
        dy = -radius * ball['normal'][1]
        room = border['radius']
        if (x[1] + dx < min(border['start'][0], end_x) - room
                or x[0] + dx > max(border['start'][0], end_x) + room
                or y[1] + dy < min(border['start'][1], end_y) - room
                or y[0] + dy > max(border['start'][1], end_y) + room):
            continue
        time = crossing(border, ball, (dx, dy, 0.0), bend, best)
        if time < best:
            best = time
            crosses = True
    for i in range(surface.limits(ground, ball['support'])):
        point, inward = surface.limit(ground, ball['support'], i)
        time = passing(ball, along(point, radius, vector(ball['normal'])), inward, best)
        if time < best:
            best = time
            crosses = True
    return best, crosses


@kernel
def passing(ball, point, inward, until):
    """First time before `until` at which the piece passes the line through `point`, or `until`."""
    time = 0.0
    bend = max(0.0, -least_acceleration(ball, inward))
    for _ in range(MOST_STEPS):
        gap = dot(sub(position(ball, time), point), inward)
        rate = dot(velocity(ball, time), inward)
        if gap <= TOUCH:
            if rate < 0.0:  # on the line from the start: as far past it as tells what is there
                return time if time > 0.0 else min(until, 2.0 * surface.LOOK_AHEAD / -rate)
            gap = TOUCH
        time += max(safe_advance(gap, rate, bend), 1e-12)
        if time >= until:
            return until
    return until


@kernel
def crossing(border, ball, shift, bend, until):
    """First time before `until` at which the piece, moved by `shift`, meets `border`, or `until`.

    A piece that starts on the border has crossed it already.
    """
    time = 0.0
    start = add(position(ball, 0.0), shift)
    gap, direction = surface.distance_in_plan(border, start[0], start[1])
    if gap <= 2 * TOUCH:
        speed = length(velocity(ball, 0.0))
        time = 1e-8 / (speed + 1e-8)
        if time >= until:
            return until
    rate = 0.0
    for _ in range(MOST_STEPS):
        place = add(position(ball, time), shift)
        gap, direction = surface.distance_in_plan(border, place[0], place[1])
        if gap <= TOUCH:  # on the line there is no direction from it: the approach decides
            return time if rate < 0.0 else until
        rate = dot(direction, velocity(ball, time))
        time += safe_advance(gap, rate, bend)
        if time >= until:
            return until
    return until
