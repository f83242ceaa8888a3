# SPDX-License-Identifier: Apache-2.0
"""What is kept of a shot on its way, for its result."""
from ..jit import entry, kernel
from ..mechanics.vector import ZERO, put, vector
from ..state.ball import FAILED, FLIGHT, LAUNCH, REST, moves
from ..state.events import GONE, LOST, SHOT_ENDS, next_event
from . import segment

NOT_FINITE, ENDLESS = 1, 2  # why a shot fails
# A path may take so many segments a second: twice what a ball takes that several surfaces hold. What goes
# beyond adds up, is made up for at that rate, and may come to so much; in `make hard` it comes to some 350.
EASY = 10_000.0
MOST_PIECES = 40_000
TOP = 1e-7  # m/s: a ball that rises no faster is at its apex but for a femtometre


@kernel
def keep_highest(ball):
    """Keep the greatest height that the ball reaches in flight before its first contact. Writes highest."""
    if ball['phase'] != FLIGHT or ball['landed']:
        return
    if segment.span_along(ball, 2)[1] <= ball['highest']:
        return
    time = ball['end'] - ball['begin']
    start = segment.position(ball, 0.0)[2]
    ball['highest'] = max(ball['highest'], max(start, segment.position(ball, time)[2]))
    low = 0.0
    high = time
    rising = segment.velocity(ball, low)[2]
    falling = segment.velocity(ball, high)[2]
    if rising <= 0.0 or falling >= 0.0:
        return
    moved = 0
    for _ in range(50):  # regula falsi; an end that stays twice loses half of its weight (Illinois)
        apex = (low * falling - high * rising) / (falling - rising)
        speed = segment.velocity(ball, apex)[2]
        if abs(speed) < TOP:
            break
        if speed > 0.0:
            falling *= 0.5 if moved > 0 else 1.0
            low = apex
            rising = speed
            moved = 1
        else:
            rising *= 0.5 if moved < 0 else 1.0
            high = apex
            falling = speed
            moved = -1
    ball['highest'] = max(ball['highest'], segment.position(ball, apex)[2])


@kernel
def keep_launch(ball):
    """Keep where a ball that nobody struck lay: there it goes back to where it is lost."""
    if not ball['playing'] and ball['phase'] == REST:
        ball['knocked'] = 1
        put(ball['struck_at'], vector(ball['position']))


@kernel
def note_landing(ball, now):
    """Keep where and how a struck ball first touches the ground. Writes landing."""
    if ball['playing'] and not ball['landed'] and ball['phase'] == FLIGHT:
        ball['landed'] = 1
        ball['landing'] = now
        put(ball['landed_at'], vector(ball['position']))
        put(ball['landing_velocity'], vector(ball['velocity']))


@kernel
def end_shot(ball, number, now, kind, log):
    """Log the end of the ball's shot, or that it is lost: `kind`. Writes playing, ended."""
    ball['ended'] = now
    if moves(ball['phase']):
        ball['over_time'] = 1
        ball['phase'] = REST
        put(ball['velocity'], ZERO)
        put(ball['spin'], ZERO)
    ball['playing'] = 0
    event = next_event(log)
    event['time'] = now
    event['ball'] = number
    event['kind'] = kind
    log.count[1] = 1


@kernel
def fault(ball, now):
    """Why the ball can't go on with the piece that it has got at `now`, or 0. Writes counted_from, pieces."""
    passed = max(now - ball['counted_from'], 0.0)
    ball['counted_from'] = now
    ball['pieces'] = max(ball['pieces'] - EASY * passed, 0.0) + 1.0
    if ball['pieces'] > MOST_PIECES:
        return ENDLESS
    w = ball['path']
    s = ball['twist']
    total = ball['end'] - ball['begin'] + ball['span']
    for k in range(3):
        total += w[1, k] + w[2, k] + w[3, k] + w[4, k] + w[5, k] + s[1, k] + s[2, k] + s[3, k]
    return 0 if total - total == 0.0 else NOT_FINITE


@kernel
def is_finite(ball):
    """Whether the ball's position, velocity and spin are numbers."""
    x = ball['position']
    v = ball['velocity']
    w = ball['spin']
    total = x[0] + x[1] + x[2] + v[0] + v[1] + v[2] + w[0] + w[1] + w[2]
    return total - total == 0.0


@kernel
def fail(ball, number, now, why, log):
    """End the way of a ball that can't go on, where it was struck. Writes motion, phase, failed; logs it."""
    ball['failed'] = why
    ball['phase'] = FAILED
    ball['knocked'] = 0
    put(ball['position'], vector(ball['struck_at']))
    put(ball['velocity'], ZERO)
    put(ball['spin'], ZERO)
    end_shot(ball, number, now, SHOT_ENDS if ball['playing'] else LOST, log)


@kernel
def keep_end(ball, end):
    """Write what is told of a ball's shot into `end`, an `ENDED` record."""
    end['phase'] = ball['phase']
    end['support'] = ball['support']
    end['material'] = ball['material']
    put(end['position'], vector(ball['position']))
    end['struck'] = ball['struck']
    put(end['struck_at'], vector(ball['struck_at']))
    put(end['launch'], vector(ball['launch']))
    put(end['launch_spin'], vector(ball['launch_spin']))
    end['highest'] = ball['highest']
    end['landed'] = ball['landed']
    end['landing'] = ball['landing']
    put(end['landed_at'], vector(ball['landed_at']))
    put(end['landing_velocity'], vector(ball['landing_velocity']))
    end['bounces'] = ball['bounces']
    end['ended'] = ball['ended']
    end['over_time'] = ball['over_time']


@kernel
def tell_gone(ball, number, now, log):
    """Log that the ball has gone out of bounds."""
    event = next_event(log)
    event['time'] = now
    event['ball'] = number
    event['kind'] = GONE
    event['material'] = ball['material'] if ball['support'] >= 0 else -1
    put(event['position'], vector(ball['position']))
    put(event['normal'], vector(ball['normal']))
    put(event['velocity_before'], vector(ball['velocity']))
    put(event['velocity_after'], vector(ball['velocity']))
    put(event['spin_before'], vector(ball['spin']))
    put(event['spin_after'], vector(ball['spin']))
    put(event['impulse'], ZERO)


@entry
def tee_off(ball, now):
    """Begin a shot with the ball's velocity and spin at `now`. Writes what is kept of a shot."""
    ball['playing'] = 1
    ball['knocked'] = 0
    ball['struck'] = now
    ball['end'] = now
    ball['ending'] = LAUNCH
    ball['highest'] = ball['position'][2]
    put(ball['struck_at'], vector(ball['position']))
    put(ball['launch'], vector(ball['velocity']))
    put(ball['launch_spin'], vector(ball['spin']))
    ball['landed'] = 0
    ball['bounces'] = 0
    ball['over_time'] = 0
    ball['failed'] = 0
    ball['counted_from'] = now
    ball['pieces'] = 0.0
