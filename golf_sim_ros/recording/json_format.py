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

"""JSON of results, collisions and balls, as it is published."""

from functools import lru_cache
import json
from math import isfinite
from typing import Any

import numpy as np

from ..physics import Collision, Result, World
from ..physics.state.ball import BALL
from ..physics.state.serialize import OF_TICK, plain_of_segment, plain_of_tick

RESULT = (
    'shot',
    'ball',
    'status',
    'carry',
    'carry_side',
    'total',
    'side',
    'apex',
    'flight_time',
    'duration',
    'to_hole',
    'lie',
    'landing_speed',
    'landing_angle',
    'bounces',
    'time',
    'position',
    'velocity',
    'spin',
    'reason',
    'stroke',
    'penalty',
)
REJECTION = ('shot', 'ball', 'status', 'velocity', 'spin', 'reason')
COLLISION = (
    'time',
    'ball',
    'kind',
    'with',
    'position',
    'normal',
    'velocity_before',
    'velocity_after',
    'spin_before',
    'spin_after',
    'impulse',
)
ENCODER = json.JSONEncoder(allow_nan=False)
TICK_BYTES = sorted(place for _, place, *_ in (BALL.fields or {}).values())[len(OF_TICK)]
DIGITS = 4  # of lengths, speeds and angles in a result; `time` has two more


def collision_text(collision: Collision) -> str:
    """Collision as a JSON object, in full precision; null in place of what is not finite."""
    values = collision._asdict()
    values['with'] = values['with_']
    return text({key: plain(values[key]) for key in COLLISION})


def result_text(result: Result, shot: int) -> str:
    """Write the result of strike number `shot` as a JSON object, rounded for people."""
    values = {**result._asdict(), 'shot': shot}
    rounded = {key: plain(values[key], DIGITS) for key in RESULT}
    return text({**rounded, 'time': plain(result.time, DIGITS + 2)})


def rejection_text(shot: int, ball: str, velocity: tuple, spin: tuple, reason: str) -> str:
    """Rejection of strike number `shot` as a JSON object."""
    values = (shot, ball, 'rejected', plain(velocity, DIGITS), plain(spin, DIGITS), reason)
    return text(dict(zip(REJECTION, values)))


class Written(str):
    """Text that is JSON already."""


def state_text(world: World) -> dict[str, Any]:
    """`world.state()`, of which the balls are `Written`."""
    state = world.state(ball_text)
    balls = ', '.join(f'"{name}": {ball}' for name, ball in state['balls'].items())
    return {**state, 'balls': Written(f'{{{balls}}}')}


def ball_text(ball: np.void) -> str:
    """`BALL` record as a JSON object, of what `physics.state.serialize.plain` gives."""
    return f'{text(plain_of_tick(ball))[:-1]}, {segment_text(ball.tobytes()[TICK_BYTES:])[1:]}'


@lru_cache(maxsize=1000)
def segment_text(record: bytes) -> str:
    """Part of `ball_text` that lasts a segment.

    `record` has the bytes after those that a tick writes.
    """
    return text(plain_of_segment(np.frombuffer(bytes(TICK_BYTES) + record, BALL)[0]))


def plain(value: Any, digits: int | None = None) -> Any:
    """`value` for JSON: None where it is not finite.

    Floats are rounded, if to `digits`, and without a negative zero.
    """
    if isinstance(value, float):
        if not isfinite(value):
            return None
        return value if digits is None else round(value, digits) + 0.0
    if isinstance(value, (tuple, list)):
        return [plain(part, digits) for part in value]
    return value


def text(values: Any) -> str:
    """`values` as JSON; numbers come back as they were, to the bit.

    What is not finite is a text: 'nan'.
    """
    try:
        return ENCODER.encode(values)
    except ValueError:
        return ENCODER.encode(spelled(values))


def spelled(value: Any) -> Any:
    """`value` with texts in place of numbers that are not finite."""
    if isinstance(value, float) and not isfinite(value):
        return str(value)
    if isinstance(value, dict):
        return {key: spelled(part) for key, part in value.items()}
    return [spelled(part) for part in value] if isinstance(value, (tuple, list)) else value
