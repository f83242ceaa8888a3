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

"""The physics of golf: no ROS, no files, no clock, no plots."""

from .effects import EFFECTS, register_effect
from .effects.wind import LogProfile, PowerProfile, UniformProfile
from .engine.engines import ENGINES
from .engine.event_loop import cycles_now
from .geometry.heightmap import Heightmap
from .geometry.mesh import Mesh
from .geometry.patch import Patch
from .geometry.plane import Plane
from .geometry.solid import Cylinder, Sphere
from .geometry.water_surface import Water
from .geometry.zone import Zone
from .integrators import METHODS
from .jit import Unavailable as EngineUnavailable
from .properties.air import Air, standard_atmosphere
from .properties.material import Material, PENNER, Restitution, rolling_resistance_of_stimp
from .result import Collision, Result
from .scene.course_record import Ball, Course
from .scene.presets import ACCURACY, Preset
from .simulation import check_hole, ground_height, Play, simulate, simulate_many
from .state.ball import Phase, Shot
from .world import BallState, check_tee, NoPlace, Rejected, World

__all__ = [
    'ACCURACY',
    'Air',
    'Ball',
    'BallState',
    'Collision',
    'Course',
    'Cylinder',
    'EFFECTS',
    'ENGINES',
    'EngineUnavailable',
    'Heightmap',
    'LogProfile',
    'METHODS',
    'Material',
    'Mesh',
    'NoPlace',
    'PENNER',
    'Patch',
    'Phase',
    'Plane',
    'Play',
    'PowerProfile',
    'Preset',
    'Rejected',
    'Restitution',
    'Result',
    'Shot',
    'Sphere',
    'UniformProfile',
    'Water',
    'World',
    'Zone',
    'check_hole',
    'check_tee',
    'cycles_now',
    'ground_height',
    'register_effect',
    'rolling_resistance_of_stimp',
    'simulate',
    'simulate_many',
    'standard_atmosphere',
]
