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

"""Serialisation of `BALL` records and events as numbers and lists, and back."""

from functools import cache
from typing import Any, Mapping

import numpy as np

from .ball import BALL, FLIGHT, ROLL, SLIDE
from ..kernel_types import BallRecord

TRIPLE = np.dtype([(axis, 'f8') for axis in 'xyz'])

NAMES = BALL.names or ()
# The fields that a tick writes of a moving ball; all others last as long as its segment.
OF_TICK, OF_SEGMENT = NAMES[:3], NAMES[3:]
# The other fields that matter of a ball at rest: the rest is written when it sets off.
STANDING = (
    'phase',
    'support',
    'material',
    'normal',
    'micro_bounce_end',
    'micro_bounce_load',
    'micro_bounce_air',
    'sleeps_on_ball',
    'strokes',
)
STORED = ('stored_count', 'stored_partners', 'stored_impulses')  # only of a time-stepped ball


def plain(ball: BallRecord) -> dict[str, Any]:
    """All fields of a `BALL` record that matter, as numbers and lists by name."""
    return {**plain_of_tick(ball), **plain_of_segment(ball)}


def plain_of_tick(ball: BallRecord) -> dict[str, Any]:
    """Part of `plain` that every tick changes."""
    return {name: ball[name].tolist() for name in OF_TICK}


def plain_of_segment(ball: BallRecord) -> dict[str, Any]:
    """Part of `plain` that lasts as long as the ball's segment."""
    names = OF_SEGMENT if ball['phase'] in (FLIGHT, SLIDE, ROLL) else STANDING
    return {
        name: ball[name].tolist() for name in names if ball['time_stepping'] or name not in STORED
    }


def plain_rows(records: np.ndarray) -> list[Any]:
    """Rows of an array of records as tuples of numbers and texts, vectors as tuples of three."""
    return records.view(with_triples(records.dtype)).tolist()


@cache
def with_triples(record: np.dtype) -> np.dtype:
    """Dtype `record` with its vectors as records, which become tuples."""
    return np.dtype(
        [(name, TRIPLE if record[name].shape else record[name]) for name in record.names or ()],
        align=record.isalignedstruct,
    )


def restored(values: Mapping[str, Any]) -> BallRecord:
    """`BALL` record restored from `plain` values.

    ValueError where a name or shape is not of one.
    """
    ball = np.zeros((), BALL)
    ball['end'] = np.inf
    for name, value in values.items():
        ball[name] = np.array(value, BALL[name].base)  # 'nan' and 'inf', too, are numbers
    return ball
