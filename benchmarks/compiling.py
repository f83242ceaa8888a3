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

"""What compiling costs, with an empty cache, and what a start costs that compiles nothing."""

import os
import resource
import subprocess
import sys
import tempfile

from golf_sim_ros.physics.engine.engines import missing
from timing import Row

FIRST, SECOND = ['--only', 'one ball'], []
START = (
    'from golf_sim_ros.course import load_course; from golf_sim_ros.physics import World; '
    "World(load_course('golf_without_friends'), engine='python')"
)


def rows(quick):
    """`Row` of the first program, of the second beside it, and of a start in plain Python."""
    yield Row('a start in plain Python, no compiler', spent('-c', START), 's', most=1.0)
    if missing() or quick:
        return
    first, both = (
        spent('-m', 'golf_sim_ros.cli.compile_physics', *what) for what in (FIRST, SECOND)
    )
    yield Row('compiling the physics for one ball, any course', first, 's', most=40.0)
    yield Row('compiling it for several balls, too, beside that', both - first, 's', most=25.0)


def spent(*words):
    """Processor time [s] of Python with these words, and of its children, with an empty cache."""
    before = used()
    with tempfile.TemporaryDirectory() as cache:
        subprocess.run(
            [sys.executable, *words],
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, 'GOLF_SIM_ROS_CACHE': cache},
        )
    return used() - before


def used():
    """Processor time [s] of all children that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
