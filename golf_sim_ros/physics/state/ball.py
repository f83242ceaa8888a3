# SPDX-License-Identifier: Apache-2.0
"""What is known of a ball: where it is, and the segment that it is on.

A ball's path is a chain of segments. A segment ends at an event or at an integrator's step, never at a
tick; ticks read it. Times are seconds on the world's clock.
"""
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from ..jit import kernel


class Phase(IntEnum):
    """What a ball is doing."""

    REST = 0
    FLIGHT = 1
    SLIDE = 2
    ROLL = 3
    HOLED = 4
    WATER = 5
    OUT = 6
    FAILED = 7


# Plain integers for kernels.
REST, FLIGHT, SLIDE, ROLL, HOLED, WATER, OUT, FAILED = (int(phase) for phase in Phase)


class Shot(NamedTuple):
    """A strike: launch velocity [m/s] and spin [rad/s] in the course frame."""

    velocity: tuple
    spin: tuple = (0.0, 0.0, 0.0)


# What ends a segment. LAUNCH: the ball was put or struck, and its own state counts. The target is the part of
# the ground, the other ball or the water that it meets.
(STEP_END, GROUND_IMPACT, BORDER_CROSSING, SLIP_STOPS, BALL_STOPS, TIME_LIMIT, LAUNCH, BALL_IMPACT,
 WATER_ENTRY) = range(9)

NO_PART = -1
JOINED, STEPPED = 1, 2  # of a time-stepped ball: only just, or for a step
MOST_STORED = 12  # contacts of a time-stepped ball whose impulses are remembered

BALL = np.dtype([
    # as of the last tick
    ('position', 'f8', 3), ('velocity', 'f8', 3), ('spin', 'f8', 3), ('phase', 'i8'),
    # the contact: part of the ground under it, its material, the normal out of it; until when its
    # bounces, too small to follow one by one, go on, how hard they press meanwhile, over m g, and the
    # acceleration along the ground that the air gives
    ('support', 'i8'), ('material', 'i8'), ('normal', 'f8', 3), ('micro_bounce_end', 'f8'),
    ('micro_bounce_load', 'f8'), ('micro_bounce_air', 'f8', 3),
    # time stepping (JOINED, STEPPED or 0), for how many steps it has been still, what holds it (1 for the
    # ground, 2 for a ball, summed), what rolling resistance takes [m/s]; how far around contacts are known,
    # and whether other balls are on their way there; asleep: whether it leans on a ball
    ('time_stepping', 'i8'), ('still_steps', 'i8'), ('held_by', 'i8'), ('rolling_loss', 'f8'),
    ('contact_reach', 'f8'), ('watches_neighbours', 'i8'), ('sleeps_on_ball', 'i8'),
    # its contacts in the last step: how many, with what, their normal and tangential impulse over mass [m/s]
    ('stored_count', 'i8'), ('stored_partners', 'i8', MOST_STORED),
    ('stored_impulses', 'f8', (MOST_STORED, 4)),
    # number of the water that it is in, from 1; 0: none
    ('water', 'i8'),
    # the segment: from `begin` to `end`; Bernstein coefficients of the way from `origin`
    # and of the spin; what ends it and on which part of the ground, or at which other ball
    ('begin', 'f8'), ('end', 'f8'), ('span', 'f8'), ('origin', 'f8', 3),
    ('position_coefficients', 'f8', (6, 3)), ('spin_coefficients', 'f8', (4, 3)),
    ('ending', 'i8'), ('target', 'i8'),
    # the integrator's next step and its stages: rates of position, velocity, spin; when the last
    # of them holds, -1 where something else has moved the ball since
    ('step', 'f8'), ('stages', 'f8', (8, 9)), ('last_stage_time', 'f8'), ('evaluations', 'i8'),
    # the shot under way; whether another ball has set it off
    ('shot_active', 'i8'), ('moved_by_ball', 'i8'), ('shot', 'i8'), ('struck', 'f8'), ('struck_at', 'f8', 3),
    ('launch', 'f8', 3), ('launch_spin', 'f8', 3), ('apex', 'f8'),
    ('landed', 'i8'), ('landing', 'f8'), ('landed_at', 'f8', 3), ('landing_velocity', 'f8', 3),
    ('bounces', 'i8'), ('rapid_impacts', 'i8'), ('zero_length_segments', 'i8'), ('ended', 'f8'),
    ('over_time', 'i8'),
    # why its shot failed; until when its segments are counted, and how many there were too many of late
    ('failed', 'i8'), ('counted_until', 'f8'), ('segments_spent', 'f8'),
    # how often it was struck since it was teed
    ('strokes', 'i8'),
], align=True)

# What is told of a ball whose shot has ended, by fields of the same names.
ENDED = np.dtype([(name, BALL[name]) for name in (
    'phase', 'support', 'material', 'position', 'struck', 'struck_at', 'launch', 'launch_spin', 'apex',
    'landed', 'landing', 'landed_at', 'landing_velocity', 'bounces', 'ended', 'over_time')], align=True)


@kernel
def moves(phase):
    """Whether a ball in `phase` moves."""
    return phase == FLIGHT or phase == SLIDE or phase == ROLL
