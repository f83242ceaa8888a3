# SPDX-License-Identifier: Apache-2.0
"""The physics of golf: no ROS, no files, no clock, no plots."""
from .accuracy import ACCURACY, Preset
from .advance import cycles_now
from .air import Air, standard_atmosphere
from .course import Ball, Course
from .effects import EFFECTS, register_effect
from .engine import ENGINES
from .effects.wind import LogProfile, PowerProfile, UniformProfile
from .ground.heightmap import Heightmap
from .ground.mesh import Mesh
from .ground.patch import Patch
from .ground.plane import Plane
from .ground.solid import Cylinder, Sphere
from .ground.water import Water
from .ground.zone import Zone
from .integrators import METHODS
from .jit import Unavailable as EngineUnavailable
from .material import PENNER, Material, Restitution, rolling_resistance_of_stimp
from .play import Play, check_hole, ground_height, simulate, simulate_many
from .report import Collision, Result
from .state import Phase, Shot
from .world import BallState, NoPlace, Rejected, World, check_tee

__all__ = [
    'ACCURACY', 'Air', 'Ball', 'BallState', 'Collision', 'Course', 'Cylinder', 'EFFECTS',
    'ENGINES', 'EngineUnavailable', 'Heightmap',
    'LogProfile', 'METHODS', 'Material', 'Mesh', 'NoPlace', 'PENNER', 'Patch', 'Phase', 'Plane', 'Play',
    'PowerProfile', 'Preset', 'Rejected', 'Restitution', 'Result', 'Shot', 'Sphere', 'UniformProfile',
    'Water', 'World', 'Zone', 'check_hole', 'check_tee', 'cycles_now',
    'ground_height', 'register_effect', 'rolling_resistance_of_stimp',
    'simulate', 'simulate_many', 'standard_atmosphere']
