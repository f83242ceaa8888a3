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

"""State of a ball: its motion, contact, segment, and shot.

A ball's path is a chain of segments. A segment ends at an event or at an integrator's step, never
at a tick; ticks read it. Times are seconds on the world's clock.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from ..jit import kernel
from ..kernel_types import Vector


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

    velocity: Vector
    spin: Vector = (0.0, 0.0, 0.0)


# Events that end a segment. LAUNCH: the ball was put or struck, and its own state counts, not the
# segment's. The target is the part of the ground, the other ball or the water that it hits.
(
    STEP_END,
    GROUND_IMPACT,
    BORDER_CROSSING,
    SLIP_STOPS,
    BALL_STOPS,
    TIME_LIMIT,
    LAUNCH,
    BALL_IMPACT,
    WATER_ENTRY,
) = range(9)

NO_PART = -1
JOINED, STEPPED = 1, 2  # of a time-stepped ball: before, or after its first time step
MOST_STORED = 12  # contacts of a time-stepped ball whose impulses are stored for the warm start

BALL = np.dtype(
    [
        # as of the last tick
        ('position', 'f8', 3),
        ('velocity', 'f8', 3),
        ('spin', 'f8', 3),
        ('phase', 'i8'),
        # the contact: part of the ground that supports it, its material, the normal out of it,
        # whether that is the normal all along its segment; until when micro-bounces go on, their
        # mean press over that of the weight, and the acceleration along the ground by the air
        # meanwhile
        ('support', 'i8'),
        ('material', 'i8'),
        ('normal', 'f8', 3),
        ('on_flat', 'i8'),
        ('micro_bounce_end', 'f8'),
        ('micro_bounce_load', 'f8'),
        ('micro_bounce_air', 'f8', 3),
        # time stepping (JOINED, STEPPED or 0), for how many steps it has been still, what holds it
        # (1 for a contact with the ground, 2 for one with a ball, summed), the speed that rolling
        # resistance takes [m/s]; the contact margin [m], and whether other balls move within it;
        # whether it rests, asleep, on a ball
        ('time_stepping', 'i8'),
        ('still_steps', 'i8'),
        ('held_by', 'i8'),
        ('rolling_loss', 'f8'),
        ('contact_reach', 'f8'),
        ('watches_neighbours', 'i8'),
        ('sleeps_on_ball', 'i8'),
        # for the warm start, of its contacts in the last time step: how many, with what, and their
        # normal and tangential impulses over mass [m/s]
        ('stored_count', 'i8'),
        ('stored_partners', 'i8', MOST_STORED),
        ('stored_impulses', 'f8', (MOST_STORED, 4)),
        # number of the water that it is in, from 1; 0: none
        ('water', 'i8'),
        # the segment: from `begin` to `end`, of a curve over `span` seconds; Bernstein
        # coefficients of the displacement from `origin` and of the spin; the event that ends it,
        # and with what
        ('begin', 'f8'),
        ('end', 'f8'),
        ('span', 'f8'),
        ('origin', 'f8', 3),
        ('position_coefficients', 'f8', (6, 3)),
        ('spin_coefficients', 'f8', (4, 3)),
        ('ending', 'i8'),
        ('target', 'i8'),
        # the integrator's next step, 0 for a first one, and its stages: rates of position,
        # velocity, spin, and in the last row, for a ball in contact, what is under it: see
        # `keep_surface`; the time of the last stage, which the next step starts from, or -1 where
        # it can't
        ('step', 'f8'),
        ('stages', 'f8', (8, 9)),
        ('last_stage_time', 'f8'),
        ('evaluations', 'i8'),
        # the shot: whether one is under way; whether another ball has set this one off; the number
        # of the shot; time and place of the strike; launch velocity and spin; greatest height; the
        # first contact; bounces
        ('shot_active', 'i8'),
        ('moved_by_ball', 'i8'),
        ('shot', 'i8'),
        ('struck', 'f8'),
        ('struck_at', 'f8', 3),
        ('launch', 'f8', 3),
        ('launch_spin', 'f8', 3),
        ('apex', 'f8'),
        ('landed', 'i8'),
        ('landing', 'f8'),
        ('landed_at', 'f8', 3),
        ('landing_velocity', 'f8', 3),
        ('bounces', 'i8'),
        ('rapid_impacts', 'i8'),
        ('zero_length_segments', 'i8'),
        ('ended', 'f8'),
        ('over_time', 'i8'),
        # why its shot failed; until when its work is counted, and the work beyond the sustained
        # rate, in segments
        ('failed', 'i8'),
        ('counted_until', 'f8'),
        ('segments_spent', 'f8'),
        # how often it was struck since it was teed
        ('strokes', 'i8'),
    ],
    align=True,
)

# Fields of `BALL` that the result of a shot needs.
ENDED = np.dtype(
    [
        (name, BALL[name])
        for name in (
            'phase',
            'support',
            'material',
            'position',
            'struck',
            'struck_at',
            'launch',
            'launch_spin',
            'apex',
            'landed',
            'landing',
            'landed_at',
            'landing_velocity',
            'bounces',
            'ended',
            'over_time',
        )
    ],
    align=True,
)


@kernel
def moves(phase: int) -> bool:
    """Whether a ball in `phase` moves."""
    return phase == FLIGHT or phase == SLIDE or phase == ROLL
