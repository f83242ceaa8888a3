# SPDX-License-Identifier: Apache-2.0
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
from .simulation import Play, check_hole, ground_height, simulate, simulate_many
from .state.ball import Phase, Shot
from .world import BallState, NoPlace, Rejected, World, check_tee

__all__ = [
    'ACCURACY', 'Air', 'Ball', 'BallState', 'Collision', 'Course', 'Cylinder', 'EFFECTS',
    'ENGINES', 'EngineUnavailable', 'Heightmap',
    'LogProfile', 'METHODS', 'Material', 'Mesh', 'NoPlace', 'PENNER', 'Patch', 'Phase', 'Plane', 'Play',
    'PowerProfile', 'Preset', 'Rejected', 'Restitution', 'Result', 'Shot', 'Sphere', 'UniformProfile',
    'Water', 'World', 'Zone', 'check_hole', 'check_tee', 'cycles_now',
    'ground_height', 'register_effect', 'rolling_resistance_of_stimp',
    'simulate', 'simulate_many', 'standard_atmosphere']
