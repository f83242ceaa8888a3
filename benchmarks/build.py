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

"""Plays drives with the package in a folder of its own, when told to: a process that `off` starts.

Arguments: the folder, and the effects, with commas. Prints a digest of the machine code, then for
each line that it reads the time [s] that it takes to play.
"""

import hashlib
import sys
from time import process_time

SHOTS = 2000
DRIVE = (73.3, 0.0, 14.1), (0.0, -281.0, 0.0)  # m/s, rad/s


def main(folder, effects):
    """Play when told to, until there is nothing more to read."""
    sys.path.insert(0, folder)
    from golf_sim_ros.physics import Course, Material, Plane, Restitution, simulate_many
    from golf_sim_ros.physics.engine.event_loop import play_all
    from golf_sim_ros.physics.jit import compiled
    import numpy as np

    turf = Material('turf', Restitution(0.4), 0.0, 0.4, 0.3, 0.1, 0.003, softness=1.0)
    course = Course((Plane(material=turf),))
    strikes = [np.tile(part, (SHOTS, 1)) for part in DRIVE]
    effects = 'auto' if effects == 'auto' else effects.split(',')
    simulate_many(course, *strikes, effects=effects, engine='compiled')
    print(code(compiled(play_all)), flush=True)
    for _ in sys.stdin:
        began = process_time()
        simulate_many(course, *strikes, effects=effects, engine='compiled')
        print(process_time() - began, flush=True)


def code(kernel):
    """Digest of the machine code of all that a compiled kernel is made of."""
    from llvmlite.binding.object_file import ObjectFileRef

    digest = hashlib.sha256()
    for compiled in kernel.overloads.values():
        for section in ObjectFileRef.from_data(compiled.library._get_compiled_object()).sections():
            if section.is_text():
                digest.update(section.data())
    return digest.hexdigest()[:16]


if __name__ == '__main__':
    main(*sys.argv[1:])
