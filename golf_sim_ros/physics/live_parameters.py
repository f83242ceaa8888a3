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

Each is the ``LIVE`` of its effect's module. A `World` takes them by these names and hands them to
`Scene`; its state, journals and replays carry them all.
"""

from typing import Any, Mapping

from .effects import LIVE


def checked_live(effect: str, value: Any) -> tuple[float, ...]:
    """Tuple of floats of a `value` for that `effect`.

    ValueError where there is none to set, or not this.
    """
    if effect not in LIVE:
        raise ValueError(
            f'effect {effect!r} has nothing that can be set; those that do: {", ".join(LIVE)}'
        )
    return LIVE[effect].check(value)


def live_values(given: Mapping[str, Any]) -> dict[str, tuple[float, ...]]:
    """Live parameters of all effects by name: what is `given` as keywords, else the defaults.

    TypeError where no effect has one of that name, ValueError where it is no value for it.
    """
    for name in given:
        if name not in LIVE:
            raise TypeError(
                f'unexpected keyword argument {name!r}; live parameters: {", ".join(LIVE)}'
            )
    return {
        name: checked_live(name, given[name]) if name in given else live.default
        for name, live in LIVE.items()
    }
