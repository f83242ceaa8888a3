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

"""The model of the report "Golf Without Friends" (KTH 2019), as a baseline to measure against.

Linear drag; wind as a force that grows with height; a ball is moved by semi-implicit Euler at 50
Hz and pushed out of whatever it has got into; an impact loses a percentage of the spin, which
friction never turns into motion or back; sand absorbs everything. The report gives no numbers for
drag, wind and loss of spin: those below are estimates.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..effects import at_time, flight_rates, protocol, Scene
from ..effects.ferguson_lift import record as lift
from ..effects.gravity import Gravity
from ..effects.linear_drag import LinearDrag
from ..effects.protocol import Flow
from ..engine.engines import best
from ..geometry import surfaces
from ..integrators.euler import SemiImplicitEuler
from ..jit import borrowed, entry, kernel
from ..kernel_types import BallRecord, MaterialRecord, ModelRecord, SceneRecord, Vector
from ..mechanics.vector import add_scaled, dot, length, load, scale, store, tangential, ZERO
from ..properties.material import restitution
from ..scene import kernel_model as model_
from ..scene.course_record import Course
from ..scene.kernel_model import Limits
from ..scene.presets import Preset
from ..simulation import checked_gusts, checked_strikes
from ..state.ball import FLIGHT
from ..state.transitions import come_to_rest, take_off
from ..trajectory.shot_record import begin_shot, record_landing
from ..world import World

REPORT_STEP = 1 / 50  # s, Unity's default physics step
SPIN_AFTER_BOUNCE = 0.7  # of the spin, in an impact
STOPPED = 0.1  # m/s on the ground
LONGEST_REPORT_SHOT = 300.0  # s


class WindForce(NamedTuple):
    """Wind as a force: `velocity`, an array of 3 [m/s], times `rate` [1/s per m] times height."""

    velocity: np.ndarray
    rate: float = 0.018


@protocol.acceleration.register(WindForce)
def _acceleration(effect: WindForce, flow: Flow) -> Vector:
    return scale(effect.rate * max(flow.position[2], 0.0), load(effect.velocity))


REPORT_2019 = Preset(SemiImplicitEuler(REPORT_STEP), Limits(STOPPED, 1.0))


def play_report_2019(
    course: Course, velocities: ArrayLike, spins: ArrayLike, wind: ArrayLike = ZERO
) -> tuple[np.ndarray, np.ndarray]:
    """Play shots as the report would have, each from the tee.

    Parameters
    ----------
    course : Course
    velocities, spins : array_like, (n, 3)
        [m/s], [rad/s]
    wind : (float, float, float) or array_like (m, 4)
        As in `simulate`; of gusts the first counts.

    Returns
    -------
    landed_at, rest : ndarray, (n, 3)
        Where the ball first touched the ground, and where it came to rest [m].
    """
    strikes, gusts = checked_strikes(velocities, spins), checked_gusts(wind)
    records = (Gravity(), LinearDrag(), lift(Scene(course)), WindForce(gusts[0, 1:].copy()))
    world = World(course)
    # Sand is what gives nothing back.
    absorbs = np.array([m.restitution.e0 == 0.0 for m in model_.materials(course)])
    ends = best(_play)(
        model_.build_model(course, records, REPORT_2019), world._balls, strikes, absorbs
    )
    return ends['landed_at'], ends['position']


@entry
def _play(
    model: ModelRecord, ball: np.ndarray, strikes: np.ndarray, absorbs: np.ndarray
) -> np.ndarray:
    model = borrowed(model)
    ends = np.empty(len(strikes), ball.dtype)
    for i in range(len(strikes)):
        ends[i] = ball[0]
        one = ends[i]
        store(one['velocity'], load(strikes[i, 0:3]))
        store(one['spin'], load(strikes[i, 3:6]))
        begin_shot(one, 0.0)
        take_off(one)
        time = 0.0
        while one['phase'] == FLIGHT and time < LONGEST_REPORT_SHOT:
            time += REPORT_STEP
            at_time(model.effects, time)
            move(model, one)
            push_out(model.land, one, time, absorbs)
    return ends


@kernel
def move(model: ModelRecord, ball: BallRecord) -> None:
    """One step of semi-implicit Euler: velocity first. Writes position and velocity."""
    x = load(ball['position'])
    v = load(ball['velocity'])
    force, _ = flight_rates(model.effects, model.land.ground, x, v, load(ball['spin']))
    v = add_scaled(v, REPORT_STEP, force)
    store(ball['velocity'], v)
    store(ball['position'], add_scaled(x, REPORT_STEP, v))


@kernel
def push_out(land: SceneRecord, ball: BallRecord, time: float, absorbs: np.ndarray) -> None:
    """Push the ball out of what it is in, and let it bounce. Writes motion, phase, landing."""
    low, high = surfaces.around(load(ball['position']), land.ball.radius)
    part = surfaces.next_part(land.ground, 0, low, high)
    while part >= 0:
        x = load(ball['position'])
        distance, normal = surfaces.nearest(land.ground, part, x)
        if distance < land.ball.radius and surfaces.touchable(land.ground, part, x):
            store(ball['position'], add_scaled(x, land.ball.radius - distance, normal))
            if dot(load(ball['velocity']), normal) < 0.0:
                record_landing(ball, time)
                number = surfaces.material_of(land.ground, part, x)
                rebound(ball, land.materials[number], absorbs[number], normal)
                if length(load(ball['velocity'])) < STOPPED:
                    come_to_rest(ball)
        part = surfaces.next_part(land.ground, part + 1, low, high)


@kernel
def rebound(ball: BallRecord, material: MaterialRecord, absorbs: bool, normal: Vector) -> None:
    """Restitution, friction against the velocity, loss of spin. Writes velocity and spin."""
    v = load(ball['velocity'])
    approach_speed = -dot(v, normal)
    sideways = tangential(v, normal)
    if absorbs:
        store(ball['velocity'], ZERO)
        store(ball['spin'], ZERO)
        return
    e = restitution(material, approach_speed)
    # Friction can only slow the ball: in the report it gives no torque.
    lost = min(material['dynamic_friction'] * (1.0 + e) * approach_speed, length(sideways))
    left = 1.0 - lost / length(sideways) if length(sideways) > 0.0 else 0.0
    store(ball['velocity'], add_scaled(scale(left, sideways), e * approach_speed, normal))
    store(ball['spin'], scale(SPIN_AFTER_BOUNCE, load(ball['spin'])))
