# SPDX-License-Identifier: Apache-2.0
"""Its being here makes what lies in this folder, oracles.py, importable for all tests."""
import os

from golf_sim_ros.physics.engine import VARIABLE, missing

if not missing():  # tests play thousands of shots; the nodes that they start do not look at this
    os.environ.setdefault(VARIABLE, 'compiled')
