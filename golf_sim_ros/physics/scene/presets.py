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

"""Accuracy presets of a simulation: sketch, standard, reference."""

from math import inf
from typing import NamedTuple, Union

from .kernel_model import Limits
from ..integrators.dormand_prince import DormandPrince
from ..kernel_types import MethodRecord


class Preset(NamedTuple):
    """Integrator with its tolerance, limits of the contact laws, and the error that they promise.

    ``touch`` and ``rest`` [m]: bounds on the error of the place of first contact, and of rest, for
    shots of up to 90 m/s in still air: of every shot on level ground, of 99 in 100 on a height
    map. ``use``: what it is for, in a few words.
    """

    method: MethodRecord
    limits: Limits
    touch: float = inf
    rest: float = inf
    use: str = ''


ACCURACY = {
    'sketch': Preset(
        DormandPrince(2e-2),
        Limits(settle=0.5, path=1e-5),
        touch=0.5,
        rest=1.0,
        use='watching many shots at once',
    ),
    'standard': Preset(
        DormandPrince(1.5e-4), Limits(settle=0.1, path=1e-6), touch=1e-3, rest=1e-2, use='playing'
    ),
    'reference': Preset(
        DormandPrince(1e-10),
        Limits(settle=1e-3, path=1e-10),
        touch=1e-6,
        rest=1e-4,
        use='research',
    ),
}


def preset(accuracy: Union[str, Preset]) -> Preset:
    """`Preset` of that name, or the `Preset` itself.

    Raises
    ------
    ValueError
        Naming the unknown preset and the known ones.
    """
    if isinstance(accuracy, Preset):
        return accuracy
    if accuracy not in ACCURACY:
        raise ValueError(f'accuracy {accuracy!r} is unknown; known: {", ".join(ACCURACY)}')
    return ACCURACY[accuracy]
