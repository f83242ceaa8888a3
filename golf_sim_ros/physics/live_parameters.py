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

"""Live parameters: what of an effect may change while balls move, by the effect's name.

A `World` hands them to `Scene` as fields of these names; its state, journals and replays carry
them all.
"""

from math import isfinite
from typing import Any, Callable, Iterable, NamedTuple

MOST_WIND = 100.0  # m/s


def checked_wind(wind: Iterable[float]) -> tuple[float, ...]:
    """Tuple of three floats of `wind`; ValueError where it is not finite or too strong."""
    wind = tuple(map(float, wind))
    if len(wind) != 3 or not all(map(isfinite, wind)):
        raise ValueError(f'wind {wind} is not three finite numbers')
    if sum(x * x for x in wind) > MOST_WIND * MOST_WIND:
        raise ValueError(f'wind {wind} is over {MOST_WIND:g} m/s')
    return wind


class Live(NamedTuple):
    """A live parameter: its default, and a check of a value for it.

    The check makes a tuple of floats of the value, or raises ValueError.
    """

    check: Callable[[Any], tuple[float, ...]]
    default: tuple[float, ...]


LIVE = {'wind': Live(checked_wind, (0.0, 0.0, 0.0))}


def checked_live(effect: str, value: Any) -> tuple[float, ...]:
    """Tuple of floats of a `value` for that `effect`.

    ValueError where there is none to set, or not this.
    """
    if effect not in LIVE:
        raise ValueError(
            f'effect {effect!r} has nothing that can be set; those that do: {", ".join(LIVE)}'
        )
    return LIVE[effect].check(value)
