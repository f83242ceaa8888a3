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

"""Functions of test modules run in another process, compiled or in plain Python.

Plain Python needs no compiling, so it can try many combinations of effects and integrators, and
what is registered there is not left behind here.
"""

import json
import os
from pathlib import Path
import subprocess
import sys

import golf_sim_ros
import numpy as np

RUN = """
import importlib, json, sys
module, function, arguments = json.loads(sys.argv[1])
result = getattr(importlib.import_module(module), function)(*arguments)
print(json.dumps(result, default=lambda array: array.tolist()))
"""


def run(function, *arguments, plain=True):
    """Run `function`, of a test module, in a process of its own: what it returns.

    Numbers keep all their digits.
    """
    folders = (
        Path(golf_sim_ros.__file__).parents[1],
        Path(__file__).parent,
        Path(__file__).parents[1],
    )
    env = dict(
        os.environ,
        PYTHONPATH=os.pathsep.join([*map(str, folders), os.environ.get('PYTHONPATH', '')]),
    )
    if plain:
        env['GOLF_SIM_ROS_ENGINE'] = 'python'
    call = json.dumps(
        [function.__module__, function.__name__, arguments], default=np.ndarray.tolist
    )
    done = subprocess.run(
        [sys.executable, '-c', RUN, call], env=env, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])
